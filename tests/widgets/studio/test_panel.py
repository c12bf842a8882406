"""What the panel asks for: layers, names, what is unused, and the looks of cells with who says so."""

from __future__ import annotations

from typing import Any

import pytest

from facade_nb import Design, gallery
from facade_nb.design.edit import with_layer, with_pattern, with_shape
from facade_nb.widgets import FacadeModel
from facade_nb.widgets.studio.commands import COMMANDS
from facade_nb.widgets.studio.looks import describe_cell, describe_pairs
from facade_nb.widgets.studio.wire import describe_design, describe_selection

from ..houses import house


def ask(model: FacadeModel, op: str, **arguments: Any) -> Any:
    return COMMANDS[op](model, {"op": op, **arguments})


def layer(model: FacadeModel, name: str) -> Any:
    return next(own for own in model.design.layers if own.name == name)


def test_a_layer_can_be_added_to_an_empty_canvas_and_draws_once_it_has_shapes() -> None:
    model = FacadeModel()
    assert ask(model, "add", kind="layer") == {"kind": "added", "what": "layer", "name": "layer 1"}
    assert [(own.x.pattern, own.y.pattern) for own in model.design.layers] == [("P1", "P2")]
    assert model.message == "" and model.layout is not None
    model.enter("patterns.P1.text", "A^k")
    model.enter("patterns.P2.text", "Q^n")
    assert model.message == "" and model.layout is not None and model.layout.shapes == ()
    assert describe_design(model)["layers"][0]["unshaped"]
    model.enter(("layers", "layer 1", "shapes", "A Q", "material"), "brick")
    assert {shape.material for shape in model.layout.shapes} == {"brick"}
    assert not describe_design(model)["layers"][0]["unshaped"]


def test_shapes_for_all_pairs_make_a_new_layer_visible_too() -> None:
    model = FacadeModel(house())
    ask(model, "add", kind="layer")
    model.enter(("layers", "layer 1", "shapes", "* *", "material"), "glass")
    assert layer(model, "layer 1").shapes["* *"].visible is None
    assert model.layout is not None and any(shape.layer == "layer 1" for shape in model.layout.shapes)


@pytest.mark.parametrize(
    ("texts", "x", "y"),
    [
        ({}, "Bx", "By"),  # those of the top layer
        ({"New": "ABA"}, "New", "By"),
        ({"New": "PQQ"}, "Bx", "New"),  # its symbols stand in columns
        ({"Older": "Z", "Wx": "V", "Wy": "W"}, "Wx", "Wy"),
        ({"Wy": "W", "Wx": "V"}, "Wx", "Wy"),
    ],
)
def test_a_new_layer_takes_the_newest_patterns(texts: dict[str, str], x: str, y: str) -> None:
    document = house().to_dict()
    document["layers"] = document["layers"][:1]
    document["patterns"].pop("Cx")
    document["symbols"] |= {name: {"size": 1} for name in "ZVW"}
    model = FacadeModel(Design.from_dict({**document, "patterns": {**document["patterns"], **texts}}))
    ask(model, "add", kind="layer")
    assert (model.design.layers[-1].x.pattern, model.design.layers[-1].y.pattern) == (x, y)


def test_a_layer_is_doubled_and_seen_alone() -> None:
    model = FacadeModel(house())
    assert ask(model, "duplicate", name="base")["name"] == "base copy"
    assert [own.name for own in model.design.layers] == ["base", "base copy", "columns"]
    ask(model, "duplicate", name="base")
    assert layer(model, "base copy 1").x == layer(model, "base").x
    ask(model, "solo", name="columns")
    assert [own.name for own in model.design.layers if own.visible] == ["columns"]
    ask(model, "solo", name="columns")
    assert all(own.visible for own in model.design.layers)


def test_alone_no_more_a_layer_leaves_the_eyes_that_were_open_before() -> None:
    model = FacadeModel(house())
    ask(model, "duplicate", name="base")
    model.enter(("layers", "base", "visible"), False)

    def shown() -> list[str]:
        return [own.name for own in model.design.layers if own.visible]

    before = shown()
    for name in ("columns", "base copy", "base"):  # from one to the next, a hidden one too
        ask(model, "solo", name=name)
        assert shown() == [name]
    ask(model, "rename", kind="layer", name="columns", to="pillars")
    ask(model, "solo", name="base")
    assert shown() == ["pillars" if name == "columns" else name for name in before]
    ask(model, "solo", name="pillars")
    model.enter(("layers", "base", "visible"), True)  # no more alone: that is what comes back
    ask(model, "solo", name="base copy")
    ask(model, "solo", name="base copy")
    assert shown() == ["base", "pillars"]
    for name in ("base", "pillars"):
        model.enter(("layers", name, "visible"), name == "base")
    ask(model, "solo", name="base")  # alone without having been made so
    assert shown() == ["base", "base copy", "pillars"]


def test_what_is_unused_goes_in_one_step_with_its_shapes() -> None:
    start = with_shape(with_pattern(house(), "Bx", "AAAA"), "B[1] P", layer="base", kind="door")
    model = FacadeModel(start)
    unused = [own["name"] for own in describe_design(model)["symbols"] if not own["used"]]
    assert unused == ["B"]
    ask(model, "sweep")
    assert "B" not in model.design.symbols
    assert layer(model, "base").shapes == {} and set(model.design.shapes) == {"* *"}
    model.undo()
    assert model.design == start


@pytest.mark.parametrize(
    ("kind", "name", "to"),
    [
        ("symbol", "B", "bay"),
        ("counter", "k", "n"),
        ("group", "default", "main"),
        ("layer", "base", "ground"),
    ],
)
def test_a_new_name_keeps_what_is_picked_and_can_be_undone(kind: str, name: str, to: str) -> None:
    model = FacadeModel(house())
    assert model.layout is not None
    model.select(next(i for i, s in enumerate(model.layout.shapes) if s.x == "B" and s.number == (2, 1)))
    before = model.selection.number
    ask(model, "rename", kind=kind, name=name, to=f" {to} ")
    shape = model.layout.shapes[model.selection.shape or 0]
    assert (shape.layer, shape.x, shape.number) == (model.selection.layer, model.selection.x, before)
    assert to in str(model.design.to_dict())
    model.undo()
    assert model.design == house()


def test_the_same_instance_stays_picked_after_a_solve() -> None:
    model = FacadeModel(house())
    assert model.layout is not None
    pick = next(i for i, s in enumerate(model.layout.shapes) if (s.x, s.y, s.number) == ("B", "Q", (3, 1)))
    model.select(pick)
    model.enter("canvas.width", 9)
    assert model.layout.shapes[model.selection.shape or 0].number == (3, 1)
    model.enter("patterns.Bx.text", "A(BA)^2")
    assert model.layout.shapes[model.selection.shape or 0].number == (2, 1)


@pytest.mark.parametrize("name", ["residential-house", "bookshop"])
def test_what_a_cell_is_told_to_look_like_is_what_is_drawn(name: str) -> None:
    design = gallery.load(name)
    model = FacadeModel(design)
    assert model.layout is not None
    for index, shape in enumerate(model.layout.shapes[:60]):
        model.select(index)
        cell = describe_cell(model)
        assert cell is not None
        for field in ("kind", "geometry", "material", "offset", "thickness"):
            assert cell["fields"][field]["value"] == getattr(shape, field)
        assert cell["keys"][0]["key"] == f"{shape.x}[{shape.number[0]}] {shape.y}[{shape.number[1]}]"


def test_each_value_tells_its_level_and_key() -> None:
    design = with_shape(house(), "B[2] *", layer="base", thickness=0.4)
    design = with_shape(design, "* Q", pattern="By", offset=0.1)
    model = FacadeModel(design)
    assert model.layout is not None
    model.select(
        next(i for i, s in enumerate(model.layout.shapes) if (s.x, s.y, s.number[0]) == ("B", "Q", 2))
    )
    told = {
        name: (own["level"], own["key"]) for name, own in describe_selection(model)["cell"]["fields"].items()
    }
    assert told == {
        "kind": ("design", "B *"),
        "geometry": ("design", "B *"),
        "material": ("design", "B *"),
        "offset": ("y", "* Q"),
        "thickness": ("layer", "B[2] *"),
        "visible": ("", ""),
    }
    assert describe_selection(model)["cell"]["set"]["y"] == {"* Q": {"offset": 0.1}}


def test_the_table_has_every_pair_with_the_key_that_applies() -> None:
    model = FacadeModel(with_shape(house(), "C P", layer="columns", material="stone"))
    model.select(layer="columns")
    pairs = describe_pairs(model)
    assert pairs is not None
    assert (pairs["columns"], pairs["rows"]) == (["C"], ["P", "Q"])
    assert [(c["material"], c["key"], c["level"], c["shown"]) for c in pairs["cells"]] == [
        ("stone", "C P", "layer", True),
        ("brick", "* *", "design", False),  # masked
    ]


def test_shapes_are_set_at_every_level_and_for_several_pairs_at_once() -> None:
    model = FacadeModel(house())
    model.enter(("layers", "base", "shapes", "A P\nB Q", "material"), "glass")
    assert {key: own.material for key, own in layer(model, "base").shapes.items()} == {
        "A P": "glass",
        "B Q": "glass",
    }
    model.enter(("patterns", "Bx", "shapes", "A *", "visible"), False)
    model.enter(
        ("shapes", "* Q", "variants"), [{"weight": "2", "material": "stone"}, {"kind": "door", "offset": ""}]
    )
    assert model.design.patterns["Bx"].shapes["A *"].visible is False
    assert model.design.to_dict()["shapes"]["* Q"] == {
        "variants": [{"weight": 2.0, "material": "stone"}, {"kind": "door"}]
    }
    model.enter("seed", "7")
    assert model.design.seed == 7
    model.enter(("layers", "base", "shapes", "A P\nB Q", "material"), None)
    assert layer(model, "base").shapes == {} and model.drafts == {}


def test_a_renamed_pattern_and_layer_are_known_by_their_new_names() -> None:
    model = FacadeModel(with_layer(house(), "columns", name="pillars"))
    assert ask(model, "rename", kind="pattern", name="By", to="floors")["to"] == "floors"
    assert {own.y.pattern for own in model.design.layers} == {"floors"}
