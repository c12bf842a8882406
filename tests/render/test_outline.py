"""What a design is made of, as a diagram."""

from __future__ import annotations

import itertools
import xml.etree.ElementTree as ET

import pytest

from facade_nb import gallery
from facade_nb.design import Design
from facade_nb.design.edit import remove_layer, with_pattern, with_symbol
from facade_nb.render import outline_svg

SVG = "{http://www.w3.org/2000/svg}"


def boxes(svg: str) -> dict[str, tuple[list[str], bool, bool]]:
    """By name: the lines of a box, whether it is pale, whether it is filled."""
    found = {}
    for group in ET.fromstring(svg).findall(f"{SVG}g"):
        name, *lines = [text.text or "" for text in group.findall(f"{SVG}text")]
        fresh = any(rect.get("class") == "new" for rect in group.findall(f"{SVG}rect"))
        found[name] = ([line for line in lines if line], "opacity" in group.attrib, fresh)
    return found


def test_everything_that_is_defined_has_a_box_with_its_fields() -> None:
    design = gallery.load("residential-house")
    found = boxes(outline_svg(design))
    names = {
        *(layer.name for layer in design.layers),
        *design.patterns,
        *(name for pattern in design.patterns.values() for name in pattern.parsed.symbols),
        *(name for pattern in design.patterns.values() for name in pattern.parsed.counters),
    }
    assert set(found) == names
    assert found["door"][0] == ["depth 2", "x: Dx", "y: By", "y mask P"]
    assert found["Bx"][0] == ["A(BA)^k"]
    assert found["B"][0] == ["1.2 m", "unoccludable"]
    assert found["e"][0] == ["takes what is left"]
    assert found["k"][0] == ["0 or more"]
    assert not any(pale or fresh for _, pale, fresh in found.values())


@pytest.mark.parametrize("name", gallery.names())
def test_every_design_has_a_diagram_in_which_nothing_lies_on_something_else(name: str) -> None:
    svg = ET.fromstring(outline_svg(gallery.load(name), theme="dark"))
    rects = [group.find(f"{SVG}rect") for group in svg.findall(f"{SVG}g")]
    places = sorted(
        (float(r.attrib["x"]), float(r.attrib["y"]), float(r.attrib["height"]))
        for r in rects
        if r is not None
    )
    for (x0, y0, h0), (x1, y1, _) in itertools.pairwise(places):
        assert x0 < x1 or y0 + h0 < y1
    assert max(y + h for _, y, h in places) <= float(svg.attrib["height"])


def test_what_an_edit_brings_is_filled() -> None:
    after = gallery.load("teaser")
    found = boxes(outline_svg(after, remove_layer(after, "hall")))
    assert {name for name, (_, _, fresh) in found.items() if fresh} == {"hall", "I", "Q", "p"}
    assert not any(fresh for _, _, fresh in boxes(outline_svg(after, after)).values())


def test_what_nothing_uses_is_pale() -> None:
    design = with_pattern(with_symbol(gallery.load("residential-house"), "W", size=1.0), "spare", "A W^n")
    found = boxes(outline_svg(design))
    assert {name for name, (_, pale, _) in found.items() if pale} == {"spare", "W", "n"}


def test_long_and_odd_names_are_text_within_their_boxes() -> None:
    document = gallery.load("residential-house").to_dict()
    document["layers"][0]["name"] = "a very long name of a layer & <more>"
    svg = outline_svg(Design.from_dict(document))
    assert "<more>" not in svg
    assert "a very long name of…" in svg


def test_an_empty_design_has_its_canvas() -> None:
    svg = outline_svg(Design())
    assert "Canvas of 6 × 3 m" in svg
    assert "Layers, 0" in svg


def test_an_unknown_theme_is_refused() -> None:
    with pytest.raises(ValueError, match="theme: expected one of light, dark"):
        outline_svg(Design(), theme="sepia")
