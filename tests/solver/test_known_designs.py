"""Known answers of the paper and its supplement, asked of `words` and of `solve`."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest

from facade_nb import Design, Layout, gallery, solve
from facade_nb.solver import words
from facade_nb.solver.model.layout import RowLayout


def spelled(row: RowLayout) -> list[str]:
    """The letters of each column of a row, pieces of cut letters told once per piece; ε for none."""
    return ["".join(letter.symbol for letter in element) or "ε" for element in row.columns]


def columns(layout: Layout, *layers: str, axis: str = "x") -> list[tuple[str, ...]]:
    solved = layout.x if axis == "x" else layout.y
    return list(zip(*(spelled(solved.row(layer)) for layer in layers), strict=True))


# --- Figure 7 ---------------------------------------------------------------------------------------------------------


def figure_7() -> tuple[list[Any], list[Any]]:
    first = words(
        "e b^s e; b := B", sizes={"B": 3}, canvas=10, tolerance=1, unsized_step=1.0, counters={"s": (1, None)}
    )
    second = words(
        "A^s C^t A^s",
        sizes={"A": 2, "C": 1.3},
        canvas=10,
        tolerance=1,
        counters={"s": (1, None), "t": (1, None)},
    )
    return first, second


def test_figure_7_words_and_sizes() -> None:
    first, second = figure_7()
    unsized = [next(letter.size for letter in word.letters if letter.symbol == "e") for word in first]
    table = {(w.counters["s"], e, str(w), round(w.size, 6)) for w, e in zip(first, unsized, strict=True)}
    assert len(first) == 4
    assert table == {(1, 4, "e B e", 11), (1, 3, "e B e", 9), (2, 2, "e B B e", 10), (3, 1, "e B B B e", 11)}
    found = {(w.counters["s"], w.counters["t"], str(w), round(w.size, 6)) for w in second}
    assert len(second) == 4
    assert found == {
        (1, 5, "A C C C C C A", 10.5),
        (1, 4, "A C C C C A", 9.2),
        (2, 2, "A A C C A A", 10.6),
        (2, 1, "A A C A A", 9.3),
    }


def test_figure_7_placeholders_are_transparent() -> None:
    first, _ = figure_7()
    assert all(letter.transparent == (letter.symbol == "e") for word in first for letter in word.letters)


def test_figure_7_has_six_candidates() -> None:
    """One word of each pattern under one value of the counter that both use (B is not opaque)."""
    first, second = figure_7()
    pairs = [(a, b) for a in first for b in second if a.counters["s"] == b.counters["s"]]
    assert len(pairs) == 6
    assert sorted({(b.counters["s"], b.counters["t"]) for _, b in pairs}) == [(1, 4), (1, 5), (2, 1), (2, 2)]


def test_figure_7_solved_is_one_of_its_candidates() -> None:
    layout = solve(gallery.load("figure-7"))
    assert (layout.counters["s"], layout.counters["t"]) in {(1, 4), (1, 5), (2, 1), (2, 2)}
    assert layout.x.proven


# --- Figure 4 ---------------------------------------------------------------------------------------------------------


def posts(name: str) -> list[tuple[str, str, str]]:
    """For each P: what stands before it in the wall, what behind it in its own column, what after it."""
    found = columns(solve(gallery.load(name)), "wall", "posts")
    at = [i for i, (_, post) in enumerate(found) if "P" in post]
    assert len(at) == 2
    return [(found[i - 1][0], found[i][0], found[i + 1][0]) for i in at]


def test_figure_4a_a_post_covers_what_fits_best() -> None:
    assert [behind for _, behind, _ in posts("qualifiers-a")] == ["D", "D"]


def test_figure_4b_what_is_unoccludable_is_left_free() -> None:
    assert [behind for _, behind, _ in posts("qualifiers-b")] == ["B", "B"]


def test_figure_4c_an_opaque_post_comes_between_frame_and_door() -> None:
    for before, behind, after in posts("qualifiers-c"):
        assert behind == "ε"
        assert {before[-1], after[0]} == {"B", "D"}


def test_figure_4d_a_door_keeps_the_frames_that_it_is_attached_to() -> None:
    for before, behind, after in posts("qualifiers-d"):
        assert behind == "ε"
        assert {before[-1], after[0]} == {"A", "D"}


@pytest.mark.parametrize("letter", "abcd")
def test_figure_4_fits_without_stretching(letter: str) -> None:
    """What is seen has its preferred size; only the room b between two posts, which is not seen, may differ."""
    layout = solve(gallery.load(f"qualifiers-{letter}"))
    sizes = {"A": 1.4, "B": 1.0, "D": 0.3, "P": 0.2}
    assert {s: layout.x.sizes[s] for s in sizes} == pytest.approx(sizes)


def test_figure_4_designs_differ_as_the_paper_says() -> None:
    """Nothing but the qualifiers it names, and the canvas that opaque posts need, changes from picture to picture."""
    a, b, c, d = (gallery.load(f"qualifiers-{letter}") for letter in "abcd")
    for design in (b, c, d):
        assert (design.patterns, design.layers, design.counters, design.shapes) == (
            a.patterns, a.layers, a.counters, a.shapes,
        )  # fmt: skip
    flags = [
        (x.symbols["D"].unoccludable, x.symbols["P"].opaque, x.symbols["B"].attached) for x in (a, b, c, d)
    ]
    assert flags == [(False, False, False), (True, False, False), (True, True, False), (True, True, True)]
    lengths = [{name: (s.size, s.min, s.max) for name, s in x.symbols.items()} for x in (a, b, c, d)]
    assert lengths == lengths[:1] * 4


# --- Supplement 3.2 ---------------------------------------------------------------------------------------------------


def balconies(walls: int | None) -> Layout:
    counters = {"k": {"value": walls}} if walls is not None else {}
    return solve(
        Design.from_dict(
            {
                "format": "facade-nb/design/1",
                "canvas": {"width": 12.0, "height": 3.0},
                "symbols": {
                    "A": {"size": 4.0},
                    "B": {"size": 4.0, "opaque": False},
                    "I": {"size": 1.0},
                    "Y": {"size": 3.0},
                },
                "counters": counters,
                "patterns": {"top": "I(BI)^l", "bottom": "A^k", "height": "Y"},
                "layers": [
                    {"name": "walls", "x": {"pattern": "bottom"}, "y": {"pattern": "height"}},
                    {"name": "balconies", "x": {"pattern": "top"}, "y": {"pattern": "height"}, "depth": 1},
                ],
            }
        )
    )


def test_opaque_columns_push_walls_apart() -> None:
    layout = balconies(2)
    assert layout.counters == {"k": 2, "l": 2}
    assert columns(layout, "balconies", "walls") == [
        ("I", "ε"),
        ("B", "A"),
        ("I", "ε"),
        ("B", "A"),
        ("I", "ε"),
    ]
    assert layout.x.groups["default"].error == pytest.approx(0.0)
    sizes = layout.x.sizes
    assert 3 * sizes["I"] + 2 * sizes["A"] == pytest.approx(12.0)
    assert sizes["B"] == pytest.approx(4.0)  # not opaque, it need not fill its column


def test_the_shorter_word_is_found_without_being_told() -> None:
    assert balconies(None).counters == {"k": 2, "l": 2}


# --- The residential house --------------------------------------------------------------------------------------------


def seen(layout: Layout) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for shape in layout.shapes:
        found.setdefault(shape.layer, set()).add(f"{shape.x} {shape.y}")
    return found


def test_house_what_is_visible_after_each_step() -> None:
    base = {"A P", "B P", "A Q", "B Q"}
    shown = [seen(solve(step)) for step in gallery.steps("residential-house")]
    assert shown[0] == shown[1] == shown[2] == {}
    assert all(s == {"base": base} for s in shown[3:7])
    assert all(s == {"base": base, "columns": {"C P"}} for s in shown[7:11])
    assert all(s == {"base": base, "columns": {"C P"}, "door": {"D P"}} for s in shown[11:16])
    assert all(s == {"base": base, "columns": {"C P"}, "door": {"D P"}, "roof": {"H R"}} for s in shown[16:])


def test_house_the_empty_canvas_solves_to_an_empty_layout() -> None:
    layout = solve(gallery.steps("residential-house")[0])
    assert (layout.shapes, layout.holes, layout.warnings, layout.complete) == ((), (), (), True)


def test_house_no_count_fits_exactly_and_the_nearest_is_taken() -> None:
    design = gallery.steps("residential-house")[3]
    sizes = {name: symbol.size for name, symbol in design.symbols.items() if symbol.size}
    widths = {w.counters["k"]: w.size for w in words("A(BA)^k", sizes=sizes, canvas=6, tolerance=6)}
    assert min(abs(width - 6) for width in widths.values()) > 0.1
    layout = solve(design)
    assert layout.counters["k"] == min(widths, key=lambda k: abs(widths[k] - 6)) == 3
    assert sum(letter.size for letter in layout.x.row("base").letters) == pytest.approx(6.0)


def test_house_columns_stand_at_the_corners_and_windows_stay_free() -> None:
    layout = solve(gallery.steps("residential-house")[8])
    assert columns(layout, "columns", "base")[0] == ("C", "A")
    assert columns(layout, "columns", "base")[-1] == ("C", "A")
    left, right = (s.rect for s in layout.shapes if s.layer == "columns")
    assert left[0] == pytest.approx(6.0 - right[2])
    windows = [s.rect for s in layout.shapes if s.x == "B"]
    assert all(w[0] >= left[2] and w[2] <= right[0] for w in windows)


def test_house_the_door_takes_the_place_of_the_middle_window() -> None:
    layout = solve(gallery.steps("residential-house")[12])
    assert ("D", "B") in columns(layout, "door", "base")
    (door,) = (s.rect for s in layout.shapes if s.layer == "door")
    assert (door[0] + door[2]) / 2 == pytest.approx(3.0)


def test_house_the_roof_is_aligned_above_both_floors() -> None:
    layout = solve(gallery.steps("residential-house")[-1])
    assert columns(layout, "roof", "base", axis="y") == [("P", "P"), ("Q", "Q"), ("R", "ε")]
    assert set(layout.x.groups) == {"default", "roof"}
    assert columns(layout, "roof") == [("H",)]


# --- The apartment house ----------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def apartments() -> Layout:
    return solve(gallery.load("apartment-house"))


def test_apartments_a_substituted_symbol_has_the_extent_of_its_content(apartments: Layout) -> None:
    sizes = apartments.x.sizes
    extent = sizes["G"] + 2 * sizes["D"] + 2 * sizes["B"]
    middle = apartments.x.row("first floor middle").letters
    assert middle[0].symbol == middle[-1].symbol == "f"
    assert [middle[0].size, middle[-1].size] == pytest.approx([extent, extent])
    corner = apartments.x.row("first floor corners").letters
    assert sum(letter.size for letter in corner if letter.symbol == "g") == pytest.approx(
        sum(letter.size for letter in middle if letter.symbol != "f")
    )


def test_apartments_first_floor_has_no_gap_where_its_layers_meet(apartments: Layout) -> None:
    rects = sorted(s.rect for s in apartments.shapes if s.layer.startswith("first floor") and s.y == "W")
    ends = [(rect[0], rect[2]) for rect in rects]
    assert ends[0][0] == pytest.approx(0.0) and ends[-1][1] == pytest.approx(21.0)
    assert all(a[1] == pytest.approx(b[0]) for a, b in pairwise(ends))


def test_apartments_groups_are_aligned_apart(apartments: Layout) -> None:
    assert set(apartments.x.groups) == {"1", "2", "3"}
    first, third = (apartments.x.groups[name].columns for name in "13")
    alone = [b for b in third[1:-1] if min(abs(b - c) for c in first) > 0.05]
    assert len(alone) > 5


def test_apartments_counters_are_within_their_bounds(apartments: Layout) -> None:
    assert set(apartments.counters) == {"j", "k", "l", "m", "n"}
    assert 1 <= apartments.counters["n"] < 3


def test_apartments_floors(apartments: Layout) -> None:
    assert columns(apartments, "first floor middle", "base", axis="y")[:3] == [
        ("Z", "Z"),
        ("Y", "Y"),
        ("XWX", "VW"),
    ]


# --- The terraced house -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("height", "floors", "odd"), [(12.6, 2, 1), (15.6, 3, 2), (18.6, 4, 2), (21.5, 5, 3)]
)
def test_terraced_house_has_a_large_balcony_on_each_odd_floor(height: float, floors: int, odd: int) -> None:
    document = gallery.load("terraced-house").to_dict()
    document["canvas"]["height"] = height
    layout = solve(Design.from_dict(document))
    assert layout.counters["m"] == floors
    assert 2 * layout.counters["p"] + layout.counters["b"] == floors
    assert odd == layout.counters["p"] + layout.counters["b"]
    base = [letter.start for letter in layout.y.row("blocks").letters if letter.symbol == "S"]
    large = [letter.start for letter in layout.y.row("large balconies").letters if letter.symbol == "Z"]
    assert large == pytest.approx(base[::2])
    assert {s.y for s in layout.shapes if s.layer == "large balconies"} == {"Z"}
