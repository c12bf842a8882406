"""Design documents: every fault at once, round trips, files."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facade_nb.design import Canvas, Counter, Design, DesignError, LayerAxis, PatternDef, Shape, Symbol
from facade_nb.design.document import read, read_json, write, write_json

from .strategies import designs

HOUSE: dict[str, Any] = {
    "format": "facade-nb/design/1",
    "name": "Residential house",
    "canvas": {"width": 6.0, "height": 3.0},
    "symbols": {
        "A": {"size": 1.0},
        "B": {"size": 0.8, "unoccludable": True},
        "P": {"size": 1.6},
        "Q": {"size": 1.4},
        "C": {"size": 0.3, "opaque": False, "placement": "center"},
        "e": {},
    },
    "counters": {"k": {"min": 0, "max": None, "value": None}},
    "patterns": {"Bx": "A(BA)^k", "By": "PQ", "Cx": {"text": "cec; c := C", "hidden": [], "shapes": {}}},
    "layers": [
        {"name": "base", "x": {"pattern": "Bx"}, "y": {"pattern": "By"}},
        {
            "name": "columns",
            "x": {"pattern": "Cx", "group": "default"},
            "y": {"pattern": "By", "mask": ["P"]},
            "depth": 1,
            "visible": True,
            "shapes": {"C P": {"geometry": "column", "material": "stone"}},
        },
    ],
    "shapes": {"B Q": {"geometry": "box", "material": "glass", "offset": -0.05, "thickness": 0.1}},
}


def house(change: Callable[[Any], None] = lambda _: None) -> dict[str, Any]:
    document = copy.deepcopy(HOUSE)
    change(document)
    return document


def put(*path: str | int, value: Any) -> Callable[[Any], None]:
    """A change that puts a value at a path."""

    def change(document: Any) -> None:
        for key in path[:-1]:
            document = document[key]
        document[path[-1]] = value

    return change


def faults_of(document: Any) -> list[str]:
    with pytest.raises(DesignError) as error:
        read(document)
    return [str(fault) for fault in error.value.faults]


def test_the_house_is_read() -> None:
    design = read(HOUSE)
    assert design.canvas == Canvas(6, 3)
    assert design.symbols["B"] == Symbol("B", 0.8, unoccludable=True)
    assert design.symbols["C"] == Symbol("C", 0.3, opaque=False)
    assert design.symbols["e"].size is None
    assert design.counters == {"k": Counter("k")}
    assert design.patterns["Cx"] == PatternDef("Cx", "cec; c := C")
    assert design.layers[1].y == LayerAxis("By", mask=("P",))
    assert design.layers[1].shapes == {"C P": Shape(geometry="column", material="stone")}
    assert [layer.name for layer in design.stack] == ["columns", "base"]


def test_equal_depths_keep_list_order() -> None:
    design = read(house(put("layers", 1, "depth", value=0)))
    assert [layer.name for layer in design.stack] == ["columns", "base"]
    design = read(house(put("layers", 0, "depth", value=2.5)))
    assert [layer.name for layer in design.stack] == ["base", "columns"]


def test_a_bare_document_is_an_empty_design() -> None:
    assert read({"format": "facade-nb/design/1"}) == Design()
    assert write(Design()) == {
        "format": "facade-nb/design/1",
        "name": "Untitled",
        "canvas": {"width": 6.0, "height": 3.0},
    }


def test_what_is_written_leaves_out_defaults() -> None:
    document = write(read(HOUSE))
    assert document["symbols"] == {
        "A": {"size": 1.0},
        "B": {"size": 0.8, "unoccludable": True},
        "P": {"size": 1.6},
        "Q": {"size": 1.4},
        "C": {"size": 0.3, "opaque": False},
        "e": {},
    }
    assert document["patterns"] == {"Bx": "A(BA)^k", "By": "PQ", "Cx": "cec; c := C"}
    assert document["layers"][0] == {"name": "base", "x": {"pattern": "Bx"}, "y": {"pattern": "By"}}
    assert document["layers"][1]["depth"] == 1
    assert "visible" not in document["layers"][1]


@given(designs())
def test_round_trip(design: Design) -> None:
    assert read(write(design)) == design
    assert Design.from_json(design.to_json()) == design
    assert Design.from_dict(design.to_dict()) == design


def test_names_are_read_in_composed_form() -> None:
    decomposed, composed = "E\u0301", "É"
    document = house(put("symbols", decomposed, value={"size": 1}))
    document["patterns"]["By"] = composed
    document["layers"][1]["y"]["mask"] = [decomposed]
    design = read(document)
    assert design.symbols[composed].size == 1
    assert design.layers[1].y.mask == (composed,)


FAULTS: list[tuple[Callable[[Any], None], list[str]]] = [
    (
        put("format", value="facade-nb/design/2"),
        ["format: expected 'facade-nb/design/1'; found 'facade-nb/design/2'"],
    ),
    (lambda d: d.pop("format"), ["format: this field is missing"]),
    (put("laiers", value=[]), ["laiers: unknown field 'laiers'; did you mean 'layers'?"]),
    (put("name", value=3), ["name: expected a text; found 3"]),
    (put("name", value="a\nb"), ["name: expected a text without control characters; found U+000A"]),
    (put("canvas", value=[6, 3]), ["canvas: expected an object; found a list"]),
    (put("canvas", "width", value=0), ["canvas.width: expected a number greater than 0; found 0"]),
    (put("canvas", "width", value=True), ["canvas.width: expected a number greater than 0; found true"]),
    (put("canvas", "width", value="6"), ["canvas.width: expected a number greater than 0; found '6'"]),
    (
        put("canvas", "height", value=float("nan")),
        ["canvas.height: expected a number greater than 0, and finite; found nan"],
    ),
    (
        put("canvas", "height", value=10**400),
        ["canvas.height: expected a number greater than 0, and finite; found a very large number"],
    ),
    (
        put("symbols", "B", "size", value=-0.8),
        ["symbols.B.size: expected a number greater than 0; found -0.8"],
    ),
    (
        put("symbols", "B", "min", value=float("inf")),
        ["symbols.B.min: expected a number greater than 0, and finite; found inf"],
    ),
    (
        put("symbols", "B", value={"size": 1, "min": 2, "max": 1}),
        ["symbols.B.min: expected at most max, which is 1; found 2"],
    ),
    (put("symbols", "B", "opaque", value=1), ["symbols.B.opaque: expected true or false; found 1"]),
    (
        put("symbols", "B", "opake", value=True),
        ["symbols.B.opake: unknown field 'opake'; did you mean 'opaque'?"],
    ),
    (
        put("symbols", "B", "placement", value="centre"),
        ["symbols.B.placement: expected one of center, left, right; found 'centre'; did you mean 'center'?"],
    ),
    (
        put("symbols", "<door>", value={}),
        [
            "symbols[\"<door>\"]: expected a symbol's name, as it stands between '<' and '>': "
            "a name has none of < > { }"
        ],
    ),
    (
        put("counters", "k", value={"min": 3, "max": 2}),
        ["counters.k.min: expected at most max, which is 2; found 3"],
    ),
    (
        put("counters", "k", value={"min": 1, "max": 4, "value": 5}),
        ["counters.k.value: expected a value from 1 to 4 (its min and max); found 5"],
    ),
    (
        put("counters", "k", "value", value=-1),
        ["counters.k.value: expected a value from 0 on (its min and max); found -1"],
    ),
    (put("counters", "k", "value", value=1.5), ["counters.k.value: expected a whole number; found 1.5"]),
    (put("counters", "k", "max", value=False), ["counters.k.max: expected a whole number; found false"]),
    (
        put("counters", "3", value={}),
        ["counters.3: expected a counter's name, as it stands between braces: a number is no name"],
    ),
    (
        put("patterns", "Bx", value="A(BA^k"),
        [
            "patterns.Bx, line 1, column 2: this '(' is not closed: expected ')' before the end of the text\nA(BA^k\n ^"
        ],
    ),
    (put("patterns", "Bx", value=7), ["patterns.Bx: expected an object; found 7"]),
    (put("patterns", "Cx", value={"hidden": []}), ["patterns.Cx.text: this field is missing"]),
    (put("patterns", "Cx", "text", value=None), ["patterns.Cx.text: expected a pattern's text; found null"]),
    (
        put("patterns", "Cx", "hidden", value=["c"]),
        ["patterns.Cx.hidden[0]: expected a symbol of pattern 'Cx' ('e', 'C'); found 'c'; did you mean 'C'?"],
    ),
    (
        put("patterns", "Bx", value="# wall\n\tA(BX)^k X"),
        [
            "patterns.Bx, line 2, column 5: symbol 'X' has no size: expected symbols.X.size, "
            "for only placeholders of control patterns go without\n\tA(BX)^k X\n\t   ^"
        ],
    ),
    (
        put("patterns", "Cx", value="cec; c := e"),
        [
            "patterns.Cx, line 1, column 11: symbol 'e' has no size: expected symbols.e.size, "
            "for only placeholders of control patterns go without\ncec; c := e\n          ^"
        ],
    ),
    (put("layers", value={}), ["layers: expected a list of layers; found an object"]),
    (put("layers", 0, value=None), ["layers[0]: expected an object; found null"]),
    (lambda d: d["layers"][0].pop("y"), ["layers[0].y: this field is missing"]),
    (
        put("layers", 1, "name", value="base"),
        ["layers[1].name: expected a name of its own; 'base' is layers[0]"],
    ),
    (put("layers", 1, "name", value=" "), ["layers[1].name: expected a text that is not empty; found ' '"]),
    (
        put("layers", 1, "x", "pattern", value="cx"),
        [
            "layers[1].x.pattern: expected the name of a pattern ('Bx', 'By', 'Cx'); found 'cx'; did you mean 'Cx'?"
        ],
    ),
    (
        put("layers", 1, "y", "mask", value=["P", "p"]),
        ["layers[1].y.mask[1]: expected a symbol of pattern 'By' ('P', 'Q'); found 'p'; did you mean 'P'?"],
    ),
    (put("layers", 1, "y", "mask", value="P"), ["layers[1].y.mask: expected a list of symbols; found 'P'"]),
    (put("layers", 1, "depth", value="1"), ["layers[1].depth: expected a number; found '1'"]),
    (put("layers", 1, "visible", value=None), ["layers[1].visible: expected true or false; found null"]),
    (
        put("layers", 1, "shapes", "C p", value={}),
        [
            "layers[1].shapes[\"C p\"]: expected symbols that a pattern uses, or *; found 'p'; did you mean 'P'?"
        ],
    ),
    (
        put("shapes", "BQ", value={}),
        [
            "shapes.BQ: expected two symbols with a blank between them, horizontal first, such as 'A P' or 'A *'; "
            "found 'BQ'"
        ],
    ),
    (
        put("shapes", "B Q", "thickness", value=-1),
        ['shapes["B Q"].thickness: expected a number from 0; found -1'],
    ),
    (put("shapes", "B Q", "kind", value=["x"]), ['shapes["B Q"].kind: expected a text; found a list']),
    (
        put("shapes", "B Q", "geometri", value="x"),
        ["shapes[\"B Q\"].geometri: unknown field 'geometri'; did you mean 'geometry'?"],
    ),
    (
        put("shapes", "B  Q", value={}),
        ["shapes[\"B  Q\"]: 'B Q' stands twice, once in another Unicode form or with other blanks"],
    ),
    (
        put("shapes", "B[0] Q", value={}),
        ['shapes["B[0] Q"]: expected an instance from 1, the first, or -1, the last; found 0'],
    ),
    (
        put("shapes", "*[2] Q", value={}),
        ["shapes[\"*[2] Q\"]: expected an instance of a symbol, such as 'B[2]'; found '*[2]'"],
    ),
    (
        put("shapes", "B[2] q[1]", value={}),
        ["shapes[\"B[2] q[1]\"]: expected symbols that a pattern uses, or *; found 'q'; did you mean 'Q'?"],
    ),
    (
        put("shapes", "B Q", "variants", value={"material": "brick"}),
        ['shapes["B Q"].variants: expected a list of variants; found an object'],
    ),
    (
        put("shapes", "B Q", "variants", value=[{"weight": -1}, {"wight": 2}]),
        [
            'shapes["B Q"].variants[0].weight: expected a number from 0; found -1',
            "shapes[\"B Q\"].variants[1].wight: unknown field 'wight'; did you mean 'weight'?",
        ],
    ),
    (
        put("shapes", "B Q", "variants", value=[{"weight": 0}]),
        ['shapes["B Q"].variants: expected a variant with a weight greater than 0; found none'],
    ),
    (put("seed", value=1.5), ["seed: expected a whole number; found 1.5"]),
]


@pytest.mark.parametrize(("change", "messages"), FAULTS)
def test_each_fault_is_told_alone_with_its_place(change: Callable[[Any], None], messages: list[str]) -> None:
    assert faults_of(house(change)) == messages


def test_all_faults_are_told_at_once() -> None:
    document = house()
    picked = [0, 2, 5, 14, 24, 37, 40]
    for index in picked:
        FAULTS[index][0](document)
    found = faults_of(document)
    assert len(found) == len(picked)
    assert set(found) == {message for index in picked for message in FAULTS[index][1]}


@pytest.mark.parametrize("key", ["* *", "A *", "* Q", "e P", "A  P"])
def test_shape_keys_may_have_wildcards(key: str) -> None:
    shapes = read(house(put("shapes", key, value={"kind": "wall"}))).shapes
    assert shapes[" ".join(key.split())] == Shape(kind="wall")


def test_shape_keys_may_have_long_names_with_blanks() -> None:
    document = house(put("symbols", "front door", value={"size": 1}))
    document["shapes"] = {"front door P": {}, "A front door": {}}
    assert list(read(document).shapes) == ["front door P", "A front door"]
    document["shapes"] = {"back door P": {}}
    assert faults_of(document) == [
        "shapes[\"back door P\"]: expected symbols that a pattern uses, or *; found 'back door P'"
    ]


def test_a_pattern_that_cannot_be_read_casts_no_doubt_on_shapes_and_masks() -> None:
    document = house(put("patterns", "By", value="P(Q"))
    assert len(faults_of(document)) == 1


def test_an_epsilon_of_another_kind_is_pointed_out() -> None:
    (fault,) = faults_of(house(put("patterns", "Bx", value="A(B|ϵ)")))
    assert "the empty word is written ε" in fault


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            '{"format": "x",\n "name" "y"}',
            'line 2, column 9: this is not JSON: expecting \':\' delimiter\n "name" "y"}\n        ^',
        ),
        ('{"a":' * 100_000, "lists and objects are nested too deeply"),
        ("[" * 100_000, "lists and objects are nested too deeply"),
        ('{"name": ' + "1" * 5000 + "}", "a number has too many digits"),
        ("[]", "expected a design document (an object); found a list"),
        (
            '{"format": "facade-nb/design/1", "layers": [], "layers": [], "counters": {"k": {"min": 1, "min": 2}}}',
            "layers: this key stands twice in its object\ncounters.k.min: this key stands twice in its object",
        ),
        (
            '{"format": "facade-nb/design/1", "canvas": {"width": Infinity}}',
            "canvas.width: expected a number greater than 0, and finite; found inf",
        ),
    ],
)
def test_faulty_json(text: str, message: str) -> None:
    with pytest.raises(DesignError) as error:
        read_json(text)
    assert str(error.value) == message


def test_a_deep_python_document_is_a_fault() -> None:
    deep: list[Any] = []
    for _ in range(100_000):
        deep = [deep]
    assert faults_of(house(put("name", value=deep))) == ["name: expected a text; found a list"]


@given(st.data())
def test_mutated_documents_are_designs_or_design_errors(data: st.DataObject) -> None:
    text = json.dumps(HOUSE)
    start = data.draw(st.integers(0, len(text)))
    stop = data.draw(st.integers(start, min(len(text), start + 8)))
    patch = data.draw(
        st.sampled_from(["", "null", "[]", "{}", "1e999", '"', "-1", "true", '"é\\ud800"'])
        | st.text(max_size=4)
    )
    try:
        design = Design.from_json("{" + text[1:start] + patch + text[max(stop, 1) :])
    except DesignError as error:
        assert str(error)
        return
    assert read(write(design)) == design


@given(st.recursive(st.none() | st.booleans() | st.floats() | st.text(max_size=3), st.lists), st.data())
def test_any_value_anywhere_is_read_or_refused(value: Any, data: st.DataObject) -> None:
    document = house()
    target: Any = document
    while True:
        key = data.draw(
            st.sampled_from(sorted(target))
            if isinstance(target, dict)
            else st.sampled_from(range(len(target)))
        )
        if not isinstance(target[key], dict | list) or not target[key] or data.draw(st.booleans()):
            break
        target = target[key]
    target[key] = value
    try:
        design = read(document)
    except DesignError as error:
        assert all(fault.place for fault in error.faults)
        return
    assert read(write(design)) == design


def test_files(tmp_path: Path) -> None:
    path = tmp_path / "haus é.json"
    text = read(HOUSE).to_json(path)
    assert path.read_text(encoding="utf-8") == text + "\n"
    assert Design.from_json(path) == Design.from_json(str(path)) == read(HOUSE)
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]
    path.write_bytes(b"\xef\xbb\xbf" + text.encode())
    assert Design.from_json(path) == read(HOUSE)


def test_a_link_is_written_through(tmp_path: Path) -> None:
    target, link = tmp_path / "target.json", tmp_path / "link.json"
    target.write_text("old")
    link.symlink_to(target)
    read(HOUSE).to_json(link)
    assert link.is_symlink()
    assert Design.from_json(target) == read(HOUSE)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "cannot be read as a file: No such file or directory"),
        (b"\xff\xfe", "cannot be read as a design: it is not text in UTF-8; it looks like UTF-16"),
        (b"{", "line 1, column 2: this is not JSON: expecting property name enclosed in double quotes"),
    ],
)
def test_unreadable_files(tmp_path: Path, content: bytes | None, message: str) -> None:
    path = tmp_path / "house.json"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(DesignError) as error:
        Design.from_json(path)
    assert message in str(error.value)
    assert str(path) in str(error.value)


def test_text_that_is_neither_json_nor_a_file() -> None:
    with pytest.raises(
        DesignError, match=r"expected a design as JSON text, or the path of a file with one; 'hous\.json'"
    ):
        Design.from_json("hous.json")
    for source in ("", "\0", "x" * 5000):
        with pytest.raises(DesignError, match="expected a design as JSON text"):
            Design.from_json(source)


def test_an_unwritable_place_is_named_and_nothing_is_left(tmp_path: Path) -> None:
    folder = tmp_path / "folder.json"
    folder.mkdir()
    with pytest.raises(DesignError, match=r"folder\.json: cannot write this file: it is a folder"):
        read(HOUSE).to_json(folder)
    with pytest.raises(DesignError, match=r"none/x\.json: cannot write this file: No such file or directory"):
        read(HOUSE).to_json(tmp_path / "none" / "x.json")
    assert list(tmp_path.iterdir()) == [folder]
    assert list(folder.iterdir()) == []


def test_a_failed_write_keeps_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "house.json"
    path.write_text("old")

    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", fail)
    with pytest.raises(DesignError, match="No space left on device"):
        read(HOUSE).to_json(path)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_an_invalid_design_is_never_written(tmp_path: Path) -> None:
    path = tmp_path / "house.json"
    with pytest.raises(DesignError, match=r"canvas\.width"):
        write_json(Design(canvas=Canvas(float("nan"), 3)), path)
    assert list(tmp_path.iterdir()) == []
