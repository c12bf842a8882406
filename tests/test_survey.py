"""Comparing layouts with surveyed openings, against a brute force and against the survey itself."""

from __future__ import annotations

import json
from itertools import permutations
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facade_nb import Layout, gallery, solve
from facade_nb.design.model import Canvas
from facade_nb.solver.model.layout import PlacedShape, Rect
from facade_nb.survey import SurveyError, compare, load_survey, match

BUILDING = "4018215"


def layout_of(*rects: Rect, kind: str = "window") -> Layout:
    shapes = tuple(PlacedShape("l", "X", "Y", rect, kind=kind) for rect in rects)
    return Layout("test", Canvas(20, 20), shapes=shapes)


def openings_of(*rects: Rect) -> list[dict[str, Any]]:
    return [{"kind": "window", "rect": list(rect)} for rect in rects]


def iou(a: Rect, b: Rect) -> float:
    w, h = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
    shared = max(w, 0.0) * max(h, 0.0)
    return shared / ((a[2] - a[0]) * (a[3] - a[1]) + (b[2] - b[0]) * (b[3] - b[1]) - shared)


def by_force(solved: list[Rect], surveyed: list[Rect]) -> float:
    """Every one-to-one matching, after both were moved to their corner."""

    def moved(rects: list[Rect]) -> list[Rect]:
        x, y = min(r[0] for r in rects), min(r[1] for r in rects)
        return [(r[0] - x, r[1] - y, r[2] - x, r[3] - y) for r in rects]

    few, many = sorted((moved(solved), moved(surveyed)), key=len)
    best = max(
        sum(iou(a, b) for a, b in zip(few, choice, strict=True)) for choice in permutations(many, len(few))
    )
    return best / len(many)


rects = st.tuples(st.integers(0, 12), st.integers(0, 12), st.integers(1, 6), st.integers(1, 6)).map(
    lambda v: (v[0] / 2, v[1] / 2, (v[0] + v[2]) / 2, (v[1] + v[3]) / 2)
)
some = st.lists(rects, min_size=1, max_size=5)


@given(some, some)
def test_it_is_the_best_of_all_matchings(solved: list[Rect], surveyed: list[Rect]) -> None:
    assert compare(layout_of(*solved), openings_of(*surveyed)) == pytest.approx(by_force(solved, surveyed))


@given(some, some)
def test_pairs_add_up_to_the_figure(solved: list[Rect], surveyed: list[Rect]) -> None:
    layout, openings = layout_of(*solved), openings_of(*surveyed)
    pairs = match(layout, openings)
    assert sum(p.iou for p in pairs) / max(len(solved), len(surveyed)) == pytest.approx(
        compare(layout, openings)
    )
    assert len({p.opening for p in pairs}) == len({p.shape for p in pairs}) == len(pairs)
    assert all(0 < p.iou <= 1 + 1e-12 and p.iou == pytest.approx(iou(p.surveyed, p.solved)) for p in pairs)


def test_the_same_openings_elsewhere_agree_fully() -> None:
    found: tuple[Rect, ...] = ((1, 2, 2, 4), (3, 2, 4, 4), (1, 5, 2, 7))
    moved = tuple((r[0] + 7.5, r[1] - 2, r[2] + 7.5, r[3] - 2) for r in found)
    assert compare(layout_of(*found), openings_of(*moved)) == pytest.approx(1.0)


def test_what_is_missing_or_too_many_counts_against_it() -> None:
    two: tuple[Rect, ...] = ((0, 0, 1, 1), (2, 0, 3, 1))
    assert compare(layout_of(*two), openings_of(two[0])) == pytest.approx(0.5)
    assert compare(layout_of(two[0]), openings_of(*two)) == pytest.approx(0.5)
    assert compare(layout_of(), openings_of(*two)) == 0.0
    assert compare(layout_of(*two), []) == 0.0
    assert compare(layout_of(), []) == 1.0


def test_each_of_two_shapes_at_one_place_counts() -> None:
    assert compare(layout_of((0, 0, 1, 1), (0, 0, 1, 1)), openings_of((0, 0, 1, 1))) == pytest.approx(0.5)


def test_walls_take_no_part_and_kinds_need_not_agree() -> None:
    window = layout_of((1, 1, 2, 3)).shapes
    wall = layout_of((0, 0, 9, 9), kind="wall").shapes
    layout = Layout("test", Canvas(9, 9), shapes=wall + window)
    assert compare(layout, [{"kind": "door", "rect": [1, 1, 2, 3]}]) == pytest.approx(1.0)
    (pair,) = match(layout, [{"kind": "door", "rect": [1, 1, 2, 3]}])
    assert (pair.opening, pair.shape) == (0, 1)


@pytest.mark.parametrize(
    "opening",
    [
        {"rect": [0, 0, 1]},
        {"rect": [1, 0, 0, 1]},
        {"rect": [0, 0, float("nan"), 1]},
        {"rect": "abcd"},
        {"kind": "window"},
        [0, 0, 1, 1],
    ],
)
def test_an_improper_opening_is_named(opening: Any) -> None:
    with pytest.raises(SurveyError, match=r"openings\[1\]\.rect: expected left < right and bottom < top"):
        compare(layout_of((0, 0, 1, 1)), [{"rect": [0, 0, 1, 1]}, opening])


def survey_file(folder: Path, document: Any) -> Path:
    file = folder / "ingolstadt.json"
    file.write_text(json.dumps(document), encoding="utf-8")
    return file


SMALL = {
    "source": "made up",
    "licence": "none",
    "facades": [
        {
            "building": "17",
            "width": 2.0,
            "height": 1.0,
            "openings": [{"kind": "window", "rect": [0, 0, 2, 1]}],
        }
    ],
}


def test_a_survey_is_read_from_a_file_a_folder_or_the_environment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = survey_file(tmp_path, SMALL)
    survey = load_survey("17", file)
    assert (survey.width, survey.height, survey.source) == (2.0, 1.0, "made up")
    assert survey.openings[0]["rect"] == [0, 0, 2, 1]
    assert load_survey("17", tmp_path) == survey
    for place in (file, tmp_path):
        monkeypatch.setenv("FACADE_NB_DATA", str(place))
        assert load_survey("17") == survey


def test_missing_data_say_how_to_name_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(SurveyError, match="FACADE_NB_DATA"):
        load_survey(BUILDING, tmp_path)
    monkeypatch.setenv("FACADE_NB_DATA", str(tmp_path / "nowhere.json"))
    with pytest.raises(SurveyError, match=r"not at .*nowhere\.json"):
        load_survey(BUILDING)


def test_what_is_no_survey_is_told(tmp_path: Path) -> None:
    file = survey_file(tmp_path, SMALL)
    with pytest.raises(
        SurveyError, match=r"expected a building of the survey \(17\); found '18'; did you mean '17'"
    ):
        load_survey("18", file)
    for text in ("{", '{"facades": 3}', "[]", '{"facades": [{}]}', '{"facades": [1]}'):
        file.write_text(text, encoding="utf-8")
        with pytest.raises(SurveyError, match="expected a survey"):
            load_survey("17", file)
    survey_file(tmp_path, {"facades": [{"building": "17", "openings": [{"rect": [0, 0, 0, 1]}]}]})
    with pytest.raises(SurveyError, match=r"building 17: openings\[0\]\.rect"):
        load_survey("17", file)


def told(folder: Path, **fields: Any) -> str:
    """What is said of the small survey with some fields of its façade changed."""
    (facade,) = SMALL["facades"]
    file = survey_file(folder, {**SMALL, "facades": [{**facade, **fields}]})
    with pytest.raises(SurveyError) as error:
        load_survey("17", file)
    return str(error.value).removeprefix(f"{file}: ")


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"openings": None}, "openings: expected a list of openings; found null"),
        ({"openings": {}}, "openings: expected a list of openings; found an object"),
        ({"openings": ["x"]}, "openings[0]: expected an opening (an object with kind and rect); found 'x'"),
        ({"openings": [{"rect": [0, 0, 1, 1], "kind": 3}]}, "openings[0].kind: expected a text; found 3"),
        ({"width": "12,5"}, "width: expected a number from 0; found '12,5'"),
        ({"width": "12.5"}, "width: expected a number from 0; found '12.5'"),
        ({"height": -1}, "height: expected a number from 0; found -1"),
        ({"height": True}, "height: expected a number from 0; found true"),
        ({"width": float("nan")}, "width: expected a number from 0, and finite; found nan"),
        ({"width": float("inf")}, "width: expected a number from 0, and finite; found inf"),
        ({"width": 10**400}, "width: expected a number from 0, and finite; found a very large number"),
        ({"width": 1e308}, "width: expected a number from 0 to 1,000,000; found 1e+308"),
    ],
)
def test_each_fault_has_its_place(tmp_path: Path, fields: dict[str, Any], message: str) -> None:
    assert told(tmp_path, **fields) == f"building 17: {message}"


@pytest.mark.parametrize(
    ("rect", "found"),
    [
        (["0", 0, 1, 1], "['0', 0, 1, 1]"),
        ([0, 0, 10**400, 1], "[0, 0, a very large number, 1]"),
        ([0, 0, 1e-308, 1], "[0, 0, 1e-308, 1]"),
        ([0, 0, 1e308, 1], "[0, 0, 1e+308, 1]"),
        ([False, 0, True, 1], "[false, 0, true, 1]"),
        (list(range(10**5)), "[0, 1, 2, 3, 4]"),
        ({"a": 1}, "an object"),
        (None, "null"),
    ],
)
def test_rectangles_are_four_numbers(tmp_path: Path, rect: Any, found: str) -> None:
    expected = f"openings[0].rect: expected left < right and bottom < top in metres, found {found}"
    assert told(tmp_path, openings=[{"rect": rect}]) == f"building 17: {expected}"
    with pytest.raises(SurveyError) as error:
        compare(layout_of((0, 0, 1, 1)), [{"rect": rect}])
    assert str(error.value) == expected


def test_all_faults_are_told_at_once_and_in_a_few_lines(tmp_path: Path) -> None:
    text = told(tmp_path, width="wide", openings=[3] * 50_000)
    assert "openings[1]: expected an opening" in text and text.endswith("… and 49,981 more faults")
    assert len(text) < 2000
    assert len(told(tmp_path, building="x" * 3_000_000)) < 200


def test_a_building_stands_once(tmp_path: Path) -> None:
    (facade,) = SMALL["facades"]
    for again in ("17", 17):
        file = survey_file(
            tmp_path, {"facades": [facade, {**facade, "building": "3"}, {**facade, "building": again}]}
        )
        with pytest.raises(
            SurveyError, match=r"facades\[2\]\.building: expected a building of its own; '17' is facades\[0\]"
        ):
            load_survey("17", file)
    file.write_text('{"facades": [{"building": "17", "building": "18", "openings": []}]}')
    with pytest.raises(SurveyError, match=r"facades\[0\]\.building: this key stands twice in its object"):
        load_survey("17", file)


@pytest.mark.parametrize("building", [None, True, 1.5, "", " ", [], 10**400])
def test_a_building_has_a_name(tmp_path: Path, building: Any) -> None:
    assert "facades[0].building: expected the number of a building; found" in told(
        tmp_path, building=building
    )


def test_width_and_height_go_by_the_openings_where_they_are_not_given(tmp_path: Path) -> None:
    openings = [{"rect": [0, 0, 2, 1]}, {"rect": [3, 0, 4, 1.5]}]
    for extra in ({}, {"width": None, "height": None}):
        survey = load_survey(
            "17", survey_file(tmp_path, {"facades": [{"building": 17, "openings": openings, **extra}]})
        )
        assert (survey.width, survey.height) == (4.0, 1.5)


@pytest.mark.parametrize("coding", ["utf-8", "utf-8-sig"])
def test_a_byte_order_mark_is_read_over(tmp_path: Path, coding: str) -> None:
    file = survey_file(tmp_path, SMALL)
    file.write_text(json.dumps(SMALL), encoding=coding)
    assert load_survey("17", file).width == 2.0


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "line 1, column 1: this is not JSON: expecting value"),
        ("é".encode("utf-16"), "it is not text in UTF-8; it looks like UTF-16"),
        (b'{"facades": "\xe9"}', "it is not text in UTF-8; byte 13 is none"),
        (b"[" * 100_000, "lists and objects are nested too deeply"),
        (b'{"facades": ' + b"9" * 5000 + b"}", "a number has too many digits"),
        (b'"x"', "expected a survey (an object); found 'x'"),
        (b"{}", "facades: this field is missing"),
    ],
)
def test_files_that_are_no_survey(tmp_path: Path, data: bytes, message: str) -> None:
    file = survey_file(tmp_path, SMALL)
    file.write_bytes(data)
    with pytest.raises(SurveyError) as error:
        load_survey("17", file)
    assert "expected a survey" in str(error.value)
    assert message in str(error.value) and str(file) in str(error.value) and len(str(error.value)) < 400


anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=3),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(
            st.sampled_from(["facades", "building", "openings", "rect", "kind", "width"]), inner, max_size=4
        )
    ),
    max_leaves=12,
)


@given(anything)
def test_any_json_is_a_survey_or_told_shortly(
    tmp_path_factory: pytest.TempPathFactory, document: Any
) -> None:
    folder = tmp_path_factory.mktemp("survey")
    for one in (document, {"facades": document}, {"facades": [{"building": "17", "openings": document}]}):
        try:
            survey = load_survey("17", survey_file(folder, one))
        except SurveyError as error:
            assert len(str(error)) < 3000
        else:
            assert 0.0 <= compare(layout_of((0, 0, 1, 1)), survey.openings) <= 1.0


def test_the_design_for_ingolstadt_has_under_twelve_symbols() -> None:
    design = gallery.load("ingolstadt-4018215")
    used = {symbol for pattern in design.patterns.values() for symbol in pattern.parsed.symbols}
    placeholders = {
        symbol for pattern in design.patterns.values() for symbol, _ in pattern.parsed.substitutions
    }
    assert len(used | set(design.symbols) | placeholders) < 12
    assert len(design.layers) > 1
    assert len({layer.x.group for layer in design.layers}) > 1  # the ground floor stands apart
    assert any(pattern.parsed.counters for pattern in design.patterns.values())


HOUSES = [name for name in gallery.names() if name.startswith("ingolstadt-")]


@pytest.mark.parametrize("name", HOUSES)
def test_the_designs_for_ingolstadt_match_the_survey(name: str) -> None:
    assert len(HOUSES) == 6
    try:
        survey = load_survey(name.removeprefix("ingolstadt-"))
    except SurveyError as missing:  # the data have a licence of their own, and are not part of the repository
        pytest.skip(str(missing))
    layout = solve(gallery.load(name))
    assert len([s for s in layout.shapes if s.kind in ("window", "door")]) == len(survey.openings)
    assert compare(layout, survey.openings) >= 0.84
    assert len(match(layout, survey.openings)) == len(survey.openings)
    assert not layout.holes


@pytest.mark.parametrize("name", HOUSES)
def test_the_designs_for_ingolstadt_are_made_by_hand(name: str) -> None:
    """Fewer letters and symbols than most openings would need, and what a house has beside openings."""
    design = gallery.load(name)
    letters = sum(sum(c.isalpha() for c in pattern.text) for pattern in design.patterns.values())
    assert letters <= 60 and len(design.symbols) <= 30 and len(design.layers) <= 5
    kinds = {shape.geometry for shape in solve(design).shapes}
    assert {"window", "door", "cornice"} <= kinds
