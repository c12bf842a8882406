"""The layers drawn apart, and the layout without its alignment: the paper's Figures 1 and 3."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise
from xml.etree import ElementTree

import pytest

from facade_nb import Design, Layout, gallery, solve
from facade_nb.render import exploded_svg, naive_layout


@pytest.fixture(scope="module")
def house() -> Layout:
    return solve(gallery.load("residential-house"))


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_every_layer_has_a_sheet_from_the_bottom_up_with_its_shapes(house: Layout, theme: str) -> None:
    root = ElementTree.fromstring(exploded_svg(house, theme=theme))
    sheets = [own for own in root.iter() if "data-sheet" in own.attrib]
    assert house.design is not None
    assert [own.get("data-sheet") for own in sheets] == [layer.name for layer in reversed(house.design.stack)]
    for own in sheets:
        shown = {int(str(g.get("data-shape"))) for g in own.iter() if "data-shape" in g.attrib}
        wanted = {i for i, s in enumerate(house.shapes) if s.layer == own.get("data-sheet")}
        assert shown == wanted


def test_sheets_lie_within_the_drawing_and_apart(house: Layout) -> None:
    text = exploded_svg(house)
    root = ElementTree.fromstring(text)
    width, height = float(str(root.get("width"))), float(str(root.get("height")))
    corners = []
    for own in (own for own in root.iter() if "data-sheet" in own.attrib):
        a, b, c, d, x, y = map(float, re.findall(r"-?[\d.]+", str(own.get("transform"))))
        rect = own.find("{*}rect")
        assert rect is not None
        w, h = float(str(rect.get("width"))), float(str(rect.get("height")))
        for u, v in ((0, 0), (w, 0), (0, h), (w, h)):
            assert 0 <= a * u + c * v + x <= width and 0 <= b * u + d * v + y <= height
        corners.append((x, y))
    assert corners == sorted(corners)
    assert len(set(corners)) == len(corners)


def test_distance_is_chosen_and_names_are_escaped(house: Layout) -> None:
    near, far = (ElementTree.fromstring(exploded_svg(house, apart=apart)) for apart in (0.5, 9.0))
    assert float(str(near.get("data-scale"))) > float(str(far.get("data-scale")))
    shapes = tuple(replace(shape, layer="<&>") for shape in house.shapes[:1])
    assert "<&>" not in exploded_svg(replace(house, shapes=shapes, design=None))
    assert ElementTree.fromstring(exploded_svg(solve(Design()))) is not None


def test_side_by_side_words_have_preferred_sizes_and_begin_at_the_left(house: Layout) -> None:
    naive = naive_layout(house)
    assert house.design is not None
    for shape, rect in zip(house.shapes, naive.shapes, strict=True):
        size = house.design.symbol(shape.x).size
        if size is not None:
            assert rect[2] - rect[0] == pytest.approx(size)
    row = sorted(
        r for s, r in zip(house.shapes, naive.shapes, strict=True) if (s.layer, s.y) == ("base", "Q")
    )
    assert row[0][0] == 0
    assert all(a[2] == pytest.approx(b[0]) for a, b in pairwise(row))


def test_what_is_wrong_side_by_side_is_named(house: Layout) -> None:
    flaws = naive_layout(house).flaws
    kinds = {flaw.kind for flaw in flaws}
    assert {"misalignment", "occlusion", "hole"} <= kinds
    assert any("C P" in flaw.text and "B P" in flaw.text for flaw in flaws if flaw.kind == "occlusion")
    wide = naive_layout(solve(gallery.load("figure-7"))).flaws
    (beyond,) = [flaw for flaw in wide if flaw.kind == "beyond"]
    assert beyond.rect[0] == 10.0 and beyond.rect[2] == pytest.approx(10.6)
    (sizing,) = [flaw for flaw in wide if flaw.kind == "sizing"]
    assert (sizing.rect[0], sizing.rect[2]) == pytest.approx((8.6, 10.0))
    assert "A of 'rooms' on x is 1.40 m at the canvas's end, and 2.00 m elsewhere" in sizing.text
    (placement,) = [flaw for flaw in wide if flaw.kind == "placement"]
    assert (placement.rect[0], placement.rect[2]) == pytest.approx((8.6, 10.6))
    assert "begins +0.72 m from a letter of 'balconies'" in placement.text


def test_no_place_is_told_twice() -> None:
    uneven = [
        f.rect for f in naive_layout(solve(gallery.load("terraced-house"))).flaws if f.kind == "placement"
    ]
    assert uneven and len(set(uneven)) == len(uneven)


def test_a_layout_at_preferred_sizes_has_no_flaw() -> None:
    layers = [
        {"name": "wall", "x": {"pattern": "P"}, "y": {"pattern": "Q"}},
        {"name": "top", "depth": 1, "x": {"pattern": "P"}, "y": {"pattern": "Q"}},
    ]
    design = Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "canvas": {"width": 4, "height": 1},
            "symbols": {"A": {"size": 2}, "F": {"size": 1}},
            "patterns": {"P": {"text": "AA"}, "Q": {"text": "F"}},
            "layers": layers,
        }
    )
    layout = solve(design)
    naive = naive_layout(layout)
    assert naive.flaws == ()
    assert naive.shapes == tuple(shape.rect for shape in layout.shapes)
