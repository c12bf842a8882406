"""Renaming symbols, counters and groups everywhere."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from facade_nb import gallery, solve
from facade_nb.design import Design, DesignError, Shape
from facade_nb.design.edit import rename_counter, rename_group, rename_symbol, with_layer, with_pattern
from facade_nb.design.model import AXES

from .strategies import counters, designs, names


def design(**sections: Any) -> Design:
    document: dict[str, Any] = {
        "format": "facade-nb/design/1",
        "symbols": {name: {"size": 1.0} for name in ("A", "B", "P", "Q", "front door", "door")},
        "counters": {"k": {"max": 9}},
        "patterns": {
            "Bx": {
                "text": "A(B <front door>)^k # A stays",
                "hidden": ["B"],
                "shapes": {"B *": {"kind": "w"}},
            },
            "By": "PQ",
        },
        "layers": [
            {
                "name": "base",
                "x": {"pattern": "Bx", "mask": ["A", "B"]},
                "y": {"pattern": "By"},
                "shapes": {"B[2] Q[-1]": {"geometry": "box"}, "front door P": {"kind": "door"}},
            },
        ],
        "shapes": {"A P": {"material": "brick"}, "* Q": {"material": "stone"}},
    }
    return Design.from_dict({**document, **sections})


def test_a_symbol_is_renamed_everywhere() -> None:
    renamed = rename_symbol(design(), "B", "bay window")
    assert list(renamed.symbols) == ["A", "bay window", "P", "Q", "front door", "door"]
    bx = renamed.patterns["Bx"]
    assert (bx.text, bx.hidden) == ("A(<bay window> <front door>)^k # A stays", ("bay window",))
    assert list(bx.shapes) == ["bay window *"]
    assert renamed.layers[0].x.mask == ("A", "bay window")
    assert list(renamed.layers[0].shapes) == ["bay window[2] Q[-1]", "front door P"]
    assert rename_symbol(design(), "front door", "D").patterns["Bx"].text == "A(B D)^k # A stays"
    assert list(rename_symbol(design(), "front door", "D").layers[0].shapes) == ["B[2] Q[-1]", "D P"]


def test_a_counter_is_renamed_everywhere() -> None:
    several = with_pattern(design(layers=[], shapes={}), "Bx", "A(BA)^k B^{-k}", hidden=None, shapes=None)
    renamed = rename_counter(several, "k", "floors")
    assert renamed.patterns["Bx"].text == "A(BA)^{floors} B^{-floors}"
    assert renamed.counters["floors"].max == 9 and "k" not in renamed.counters
    assert rename_counter(renamed, "floors", "k").patterns["Bx"].text == "A(BA)^k B^{-k}"


def test_a_group_is_renamed_on_both_axes() -> None:
    grouped = with_layer(design(), "base", x={"group": "left"}, y={"group": "left"})
    renamed = rename_group(grouped, "left", "wing")
    assert [renamed.layers[0].along(axis).group for axis in AXES] == ["wing", "wing"]
    assert rename_group(renamed, "wing", "default") == design()


@pytest.mark.parametrize(
    ("rename", "name", "new", "message"),
    [
        (rename_symbol, "A", "B", "'B' is taken"),
        (rename_symbol, "Z", "Y", "expected the name of a symbol"),
        (rename_symbol, "A", "*", "wildcard"),
        (rename_symbol, "A", " ", "at least one character"),
        (rename_counter, "k", "2k", "counter"),
        (rename_counter, "n", "k", "expected the name of a counter"),
        (rename_group, "default", " ", "at least one character"),
        (rename_group, "left", "right", "expected the name of a group"),
    ],
)
def test_what_cannot_be_renamed_is_told(rename: Any, name: str, new: str, message: str) -> None:
    with pytest.raises(DesignError, match=message.replace("*", r"\*")):
        rename(design(), name, new)


def test_two_groups_are_never_made_one() -> None:
    with pytest.raises(DesignError, match="'left' is taken"):
        rename_group(with_layer(design(), "base", x={"group": "left"}), "default", "left")


def test_a_name_that_gives_keys_another_meaning_is_refused() -> None:
    both = design(shapes={"front door P": {"kind": "a"}, "B[2] Q": {"kind": "b"}})
    with pytest.raises(DesignError, match="would mean something else"):
        rename_symbol(both, "A", "B[2]")
    ambiguous = rename_symbol(rename_symbol(both, "A", "front"), "P", "new")
    with pytest.raises(DesignError, match="would mean something else"):
        rename_symbol(ambiguous, "B", "door new")


def test_a_key_that_means_two_pairs_becomes_two() -> None:
    sized = {name: {"size": 1.0} for name in ("A", "B C", "A B", "C", "P")}
    two = Design.from_dict(
        {"format": "facade-nb/design/1", "symbols": sized, "shapes": {"A B C": {"kind": "door"}}}
    )
    renamed = rename_symbol(two, "A B", "Z")
    assert renamed.shapes == {"A B C": Shape("door"), "Z C": Shape("door")}
    assert rename_symbol(renamed, "Z", "A B") == two


@settings(max_examples=60, suppress_health_check=list(HealthCheck))
@given(designs(), names | st.just("new name"), counters, st.data())
def test_there_and_back_is_the_same_design(design: Design, new: str, count: str, data: st.DataObject) -> None:
    written = {site for pattern in design.patterns.values() for site in pattern.parsed.sites}
    for rename, own, to in (
        (rename_symbol, {*design.symbols, *(s.name for s in written if s.role != "counter")}, new),
        (rename_counter, {*design.counters, *(s.name for s in written if s.role == "counter")}, count),
        (rename_group, {layer.along(axis).group for layer in design.layers for axis in AXES}, "other"),
    ):
        if not own or to in own:
            continue
        name = data.draw(st.sampled_from(sorted(own)))
        try:
            renamed = rename(design, name, to)
        except DesignError as error:
            assert "would mean something else" in str(error)
            continue
        assert renamed != design
        assert rename(renamed, to, name) == design


@pytest.mark.parametrize("name", ["residential-house", "apartment-house"])
def test_a_renamed_symbol_stands_where_it_stood(name: str) -> None:
    house = gallery.load(name)
    symbol = next(iter(house.symbols))
    renamed = rename_symbol(house, symbol, "Ж7")
    before, after = solve(house), solve(renamed)
    assert [shape.rect for shape in before.shapes] == [shape.rect for shape in after.shapes]
    swap = {symbol: "Ж7"}
    assert [(swap.get(s.x, s.x), swap.get(s.y, s.y)) for s in before.shapes] == [
        (s.x, s.y) for s in after.shapes
    ]
    assert [s.material for s in before.shapes] == [s.material for s in after.shapes]
