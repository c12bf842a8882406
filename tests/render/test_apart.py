"""The layers drawn apart, and the layout without its alignment: the paper's Figures 1 and 3."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise
from typing import Any
from xml.etree import ElementTree

import pytest

from facade_nb import Design, Layout, gallery, solve
from facade_nb.design import Canvas
from facade_nb.render import exploded_svg, naive_layout
from facade_nb.solver.model.layout import AxisLayout, GroupLayout, PlacedLetter, RowLayout


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


def figure_3(**fields: Any) -> Layout:
    """A wall with windows and a front layer of columns, as the paper's Figure 3 has them, on a canvas of 6 by 2 m."""
    document = {
        "format": "facade-nb/design/1",
        "canvas": {"width": 6, "height": 2},
        "symbols": {"A": {"size": 0.9}, "B": {"size": 1.0}, "C": {"size": 0.6}, "P": {"size": 2}},
        "counters": {"k": {"value": 3}},
        "patterns": {"wall": "A(BA)^k", "front": "c e c e c; c := C", "floor": "P"},
        "layers": [
            {"name": "wall", "x": {"pattern": "wall"}, "y": {"pattern": "floor"}},
            {"name": "front", "x": {"pattern": "front"}, "y": {"pattern": "floor"}, "depth": 1},
        ],
        "shapes": {"B P": {"kind": "window"}, "C P": {"kind": "column"}},
    }
    return solve(Design.from_dict(document | fields))


def test_a_window_that_is_wholly_covered_is_told_though_no_symbol_is_marked() -> None:
    symbols = {"A": {"size": 0.9}, "B": {"size": 0.5}, "C": {"size": 1.2}, "P": {"size": 2}}
    layout = figure_3(symbols=symbols, canvas={"width": 5.4, "height": 2})
    moved = replace(
        layout,
        shapes=tuple(
            replace(shape, rect=(shape.rect[0] + 90, 0, shape.rect[2] + 90, 2))
            if shape.layer == "front"
            else shape
            for shape in layout.shapes
        ),
    )
    told = [flaw.text for flaw in naive_layout(moved).flaws if flaw.kind == "occlusion"]
    assert any(text == "C P of 'front' covers B P of 'wall'" for text in told)


def test_a_word_that_ends_before_the_canvas_does_is_told() -> None:
    layout = figure_3(canvas={"width": 6.8, "height": 2})
    short = [flaw for flaw in naive_layout(layout).flaws if flaw.kind == "short"]
    ends = {flaw.text: (flaw.rect[0], flaw.rect[2]) for flaw in short}
    assert ends["The word of 'wall' on x leaves 0.20 m of the canvas empty"] == pytest.approx((6.6, 6.8))


def test_one_symbol_has_one_size_in_all_layers() -> None:
    """The front layer's only B ends beyond the canvas, and the wall has whole ones."""
    layers = [
        {"name": "wall", "x": {"pattern": "wall"}, "y": {"pattern": "floor"}},
        {"name": "front", "x": {"pattern": "long", "group": "front"}, "y": {"pattern": "floor"}, "depth": 1},
    ]
    patterns = {"wall": "ABABAB", "long": "CB", "floor": "P"}
    symbols = {"A": {"size": 1.0}, "B": {"size": 1.0}, "C": {"size": 5.5}, "P": {"size": 2}}
    layout = figure_3(patterns=patterns, layers=layers, symbols=symbols, counters={})
    sizing = [flaw.text for flaw in naive_layout(layout).flaws if flaw.kind == "sizing"]
    assert sizing == ["B of 'front' on x is 0.50 m at the canvas's end, and 1.00 m elsewhere"]


def test_neighbours_are_as_far_from_each_other() -> None:
    """In the layout D is as wide as EE; their preferred sizes are not."""
    rows = (("A", 0, 1), ("D", 1, 3), ("A", 3, 4), ("E", 4, 5), ("E", 5, 6), ("A", 6, 7))
    sizes = {"A": 1.0, "D": 2.3, "E": 1.0}
    flaws = naive_layout(placed({"wall": rows}, sizes)).flaws
    (flaw,) = [flaw for flaw in flaws if flaw.kind == "placement"]
    assert flaw.text == "Neighbours A of 'wall' on x are 2.00 m apart, and the first two 2.30 m"
    assert (flaw.rect[0], flaw.rect[2]) == pytest.approx((4.3, 6.3))


def test_layers_with_one_pattern_are_compared() -> None:
    """Two layers have words of one pattern: what stands at one place in the layout begins at two side by side."""
    lower = (("A", 0, 2), ("B", 2, 3), ("A", 3, 4))
    upper = (("D", 0, 2), ("B", 2, 3), ("A", 3, 4))
    flaws = naive_layout(placed({"lower": lower, "upper": upper}, {"A": 1.0, "B": 1.0, "D": 2.0})).flaws
    told = [flaw.text for flaw in flaws if flaw.kind == "intrinsic"]
    assert told == [
        "B on x begins at 2.00 m in 'upper' and at 1.00 m in 'lower', though both have the pattern 'one'",
        "A on x begins at 3.00 m in 'upper' and at 2.00 m in 'lower', though both have the pattern 'one'",
    ]


def placed(rows: dict[str, tuple[tuple[str, float, float], ...]], sizes: dict[str, float]) -> Layout:
    """A layout that says where the letters of each layer stand; all layers have the same two patterns."""
    document = {
        "format": "facade-nb/design/1",
        "canvas": {"width": 7, "height": 1},
        "symbols": {**{name: {"size": size} for name, size in sizes.items()}, "P": {"size": 1}},
        "patterns": {"one": "|".join(sizes), "floor": "P"},
        "layers": [{"name": name, "x": {"pattern": "one"}, "y": {"pattern": "floor"}} for name in rows],
    }
    solved = {}
    for axis, own in (("x", rows), ("y", dict.fromkeys(rows, (("P", 0, 1),)))):
        stops = sorted({float(stop) for row in own.values() for _, *ends in row for stop in ends})
        lines = tuple(
            RowLayout(name, "one", tuple((PlacedLetter(*letter),) for letter in row))
            for name, row in own.items()
        )
        solved[axis] = AxisLayout(groups={"default": GroupLayout(0.0, tuple(stops), lines)})
    return Layout("", Canvas(7, 1), x=solved["x"], y=solved["y"], design=Design.from_dict(document))


def test_shapes_that_the_layout_hides_are_laid_side_by_side_too(house: Layout) -> None:
    """The door stands before a window; side by side some of that is seen, and is no hole."""
    naive = naive_layout(house)
    (behind,) = naive.behind
    assert (behind.shape.layer, behind.shape.x, behind.shape.y) == ("base", "B", "P")
    assert behind.rect[2] - behind.rect[0] == pytest.approx(1.2)
    stacked = naive.stacked(house)
    assert len(stacked) == len(house.shapes) + 1
    assert stacked[behind.before].layer == "base" and stacked[behind.before].rect == behind.rect
    assert [shape.layer for shape in stacked] == sorted(
        (shape.layer for shape in stacked), key=["base", "columns", "door", "roof"].index
    )
    assert all(flaw.rect[0] > 5 for flaw in naive.flaws if flaw.kind == "hole")


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
