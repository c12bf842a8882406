"""The elevation: what is in it, where, and in which order."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest

from facade_nb.design.errors import DesignError
from facade_nb.design.model import Canvas
from facade_nb.render import elevation_svg, overlay_svg
from facade_nb.render.elevation import elevation_pieces
from facade_nb.render.relief import Relief
from facade_nb.render.scene import build_scene
from facade_nb.render.style import LIGHT
from facade_nb.solver.model.layout import Layout, PlacedShape

from ..work import calls
from .houses import apartment, house

SVG = "{http://www.w3.org/2000/svg}"


def shapes_of(text: str) -> list[ET.Element]:
    return [g for g in ET.fromstring(text).iter(f"{SVG}g") if "data-shape" in g.attrib]


def two_boxes(low: float = 0.0, high: float = 0.5, **looks: object) -> Layout:
    """A wall of 4 by 3 metres with one box of 1 by 1 in its middle."""
    wall = PlacedShape("wall", "A", "P", (0, 0, 4, 3), offset=low)
    box = PlacedShape("box", "B", "Q", (1.5, 1, 2.5, 2), offset=high, **looks)  # type: ignore[arg-type]
    return Layout("Two boxes", Canvas(4, 3), shapes=(wall, box))


@pytest.mark.parametrize(
    "layout", [apartment(), two_boxes(), Layout("Empty", Canvas(4, 3), holes=((0, 0, 4, 3),))]
)
def test_a_piece_is_one_element_or_a_tag_around_others(layout: Layout) -> None:
    text = elevation_svg(layout, holes=True, prefix="f")
    pieces = elevation_pieces(layout, holes=True, prefix="f")
    assert "".join(pieces) == text
    open_: list[str] = []
    for piece in pieces:
        tag = re.match(r"</?(\w+)", piece)
        assert tag is not None
        if piece.startswith("</"):
            assert open_.pop() == tag[1]
        elif "<" not in piece[1:] and not piece.endswith("/>"):
            open_.append(tag[1])
        else:
            ET.fromstring(piece)
    assert not open_


@pytest.mark.parametrize("layout", [house(), apartment()], ids=["house", "apartment"])
def test_every_shape_is_there_in_painting_order(layout: Layout) -> None:
    groups = shapes_of(elevation_svg(layout))
    assert [int(g.get("data-shape", "")) for g in groups] == list(range(len(layout.shapes)))
    for g, shape in zip(groups, layout.shapes, strict=True):
        assert (g.get("data-layer"), g.get("data-x"), g.get("data-y")) == (shape.layer, shape.x, shape.y)


@pytest.mark.parametrize("width", [None, 400.0, 1234.5])
def test_cells_lie_where_the_layout_says(width: float | None) -> None:
    layout = apartment()
    text = elevation_svg(layout, width_px=width)
    root = ET.fromstring(text)
    scale = float(root.get("data-scale", ""))
    x0, y0 = map(float, root.get("data-origin", "").split())
    if width is not None:
        assert float(root.get("width", "")) == pytest.approx(width, abs=0.01)
    for g, shape in zip(shapes_of(text), layout.shapes, strict=True):
        cell = next(e for e in g if e.get("class") == "cell")
        left, bottom, right, top = shape.rect
        wanted = (x0 + left * scale, y0 - top * scale, (right - left) * scale, (top - bottom) * scale)
        found = [float(cell.get(name, "")) for name in ("x", "y", "width", "height")]
        assert found == pytest.approx(wanted, abs=0.0101)


def test_names_are_text_not_markup() -> None:
    bad = '<b>"&'
    layout = replace(two_boxes(), name=bad)
    layout = replace(layout, shapes=tuple(replace(s, layer=bad, x="<i>", y="'&amp;") for s in layout.shapes))
    text = elevation_svg(layout)
    assert "<b>" not in text
    assert "<i>" not in text
    first = shapes_of(text)[0]
    assert first.get("data-layer") == bad
    assert first.get("data-y") == "'&amp;"
    title = first.find(f"{SVG}title")
    assert title is not None
    assert bad in (title.text or "")


def test_ids_of_two_drawings_differ_and_all_references_resolve() -> None:
    first, second = elevation_svg(house()), elevation_svg(house())
    one, two = (set(re.findall(r' id="([^"]+)"', text)) for text in (first, second))
    assert one
    assert not one & two
    for text, ids in ((first, one), (second, two)):
        assert set(re.findall(r"url\(#([^)]+)\)", text)) | set(re.findall(r'href="#([^"]+)"', text)) <= ids
        assert len(re.findall(r' id="', text)) == len(ids)


def test_a_prefix_makes_drawings_reproducible() -> None:
    assert elevation_svg(house(), prefix="p") == elevation_svg(house(), prefix="p")


def test_without_ids_nothing_to_pick_is_written() -> None:
    text = elevation_svg(house(), ids=False)
    assert "data-shape" not in text
    assert "<title" not in text


def test_equal_windows_are_drawn_once_and_used_often() -> None:
    layout = apartment()
    windows = sum(shape.geometry == "window" for shape in layout.shapes)
    uses = re.findall(r'<use href="#([^"]+)"', elevation_svg(layout))
    assert max(uses.count(name) for name in set(uses)) == windows


def test_size_and_speed_suit_a_keystroke() -> None:
    # 3 and 25 ms on a quiet machine, in which some 11,000 and 44,000 calls are made
    for layout, limit, most in ((house(), 25_000, 20_000), (apartment(), 150_000, 80_000)):
        assert len(elevation_svg(layout).encode()) < limit
        assert calls(lambda: elevation_svg(layout)) < most  # noqa: B023


def test_a_projecting_box_throws_its_shadow_to_the_lower_right() -> None:
    shadows = Relief(build_scene(two_boxes())).shadows()
    assert [len(polygons) for polygons in shadows] == [1, 0]
    (polygon,) = shadows[0]
    xs, ys = [x for x, _ in polygon], [y for _, y in polygon]
    assert (min(xs), max(xs)) == pytest.approx((1.5, 2.5 + 0.5 * LIGHT[0]))
    assert (min(ys), max(ys)) == pytest.approx((1 - 0.5 * LIGHT[1], 2))
    for x, y in polygon:  # nothing to the upper left of the diagonal through the box
        assert x >= 1.5 - 1e-9
        assert y <= 2 + 1e-9
    doubled = Relief(build_scene(two_boxes(high=1.0))).shadows()[0][0]
    assert max(x for x, _ in doubled) == pytest.approx(2.5 + LIGHT[0])


def test_shadows_are_clipped_to_what_they_fall_on() -> None:
    far = two_boxes(high=5.0)
    for polygon in Relief(build_scene(far)).shadows()[0]:
        for x, y in polygon:
            assert -1e-9 <= x <= 4 + 1e-9
            assert -1e-9 <= y <= 3 + 1e-9


def test_a_recess_takes_the_shadow_of_its_upper_and_left_side_only() -> None:
    shadows = Relief(build_scene(two_boxes(high=-0.4))).shadows()
    assert not shadows[0]
    inside = [(x, y) for polygon in shadows[1] for x, y in polygon]
    assert inside
    for x, y in inside:
        assert 1.5 - 1e-9 <= x <= 2.5 + 1e-9
        assert 1 - 1e-9 <= y <= 2 + 1e-9
    lower_right = (2.5 - 0.05, 1 + 0.05)
    assert not any(_inside(lower_right, polygon) for polygon in shadows[1])
    assert any(_inside((1.55, 1.1), polygon) for polygon in shadows[1])
    assert any(_inside((2.4, 1.95), polygon) for polygon in shadows[1])


def _inside(point: tuple[float, float], polygon: list[tuple[float, float]]) -> bool:
    turns = [
        (q[0] - p[0]) * (point[1] - p[1]) - (q[1] - p[1]) * (point[0] - p[0])
        for p, q in zip(polygon, [*polygon[1:], polygon[0]], strict=True)
    ]
    return all(t >= 0 for t in turns) or all(t <= 0 for t in turns)


def test_a_cornice_shades_the_wall_below_it() -> None:
    wall = PlacedShape("base", "A", "P", (0, 0, 4, 2.5))
    cornice = PlacedShape("base", "A", "Q", (0, 2.5, 4, 3), geometry="cornice", material="stone", offset=0.4)
    shadows = Relief(build_scene(Layout("c", Canvas(4, 3), shapes=(wall, cornice)))).shadows()[0]
    assert shadows
    ys = [y for polygon in shadows for _, y in polygon]
    assert max(ys) == pytest.approx(2.5)
    assert 2.3 < min(ys) < 2.48


def test_flush_walls_of_one_material_meet_without_a_line() -> None:
    same = [PlacedShape("w", "A", "P", (i, 0, i + 1, 3)) for i in range(3)]
    edges = Relief(build_scene(Layout("x", Canvas(3, 3), shapes=tuple(same)))).edges()[0]
    assert not edges.depth
    assert not edges.joint
    assert len(edges.outline) == 4
    other = [same[0], replace(same[1], material="brick"), replace(same[2], offset=0.2)]
    edges = Relief(build_scene(Layout("x", Canvas(3, 3), shapes=tuple(other)))).edges()[0]
    assert edges.joint == ((1.0, 0.0, 1.0, 3.0),)
    assert edges.depth == ((2.0, 0.0, 2.0, 3.0),)


def test_lines_of_a_covered_layer_stay_below_what_covers_it() -> None:
    root = ET.fromstring(elevation_svg(house()))
    layers = [g for g in root if g.tag == f"{SVG}g"]
    column = next(i for i, g in enumerate(layers) if g.find(f"{SVG}g[@data-layer='columns']") is not None)
    base = layers[column - 1]
    assert base[-1].get("fill") == "none"  # the base's lines come before the columns are painted


def test_the_empty_canvas_says_how_large_it_is() -> None:
    text = elevation_svg(Layout("Nothing", Canvas(6.5, 3.0)))
    assert "6.5 × 3 m" in text
    assert "stroke-dasharray" in text
    assert "add a layer" in text


def test_holes_show_only_when_asked_for() -> None:
    layout = replace(two_boxes(), holes=((0.0, 0.0, 1.0, 1.0),))
    assert 'class="hole"' not in elevation_svg(layout)
    assert elevation_svg(layout, holes=True).count('class="hole"') == 1
    assert 'class="hole"' not in elevation_svg(
        replace(layout, shapes=()), holes=True
    )  # an empty canvas misses nothing


def test_themes_differ_and_an_unknown_one_is_named() -> None:
    assert "#1e2227" in elevation_svg(house(), theme="dark")
    with pytest.raises(
        ValueError, match=r"theme: expected one of light, dark; found 'drak'; did you mean 'dark'"
    ):
        elevation_svg(house(), theme="drak")


def test_unknown_names_are_all_reported_with_the_nearest() -> None:
    layout = two_boxes(geometry="widnow", material="plaster")
    layout = replace(layout, shapes=(replace(layout.shapes[0], material="bricks"), layout.shapes[1]))
    with pytest.raises(DesignError) as caught:
        elevation_svg(layout)
    assert len(caught.value.faults) == 2
    assert "did you mean 'brick'" in str(caught.value)
    assert "did you mean 'window'" in str(caught.value)
    assert caught.value.faults[1].place == "shapes[\"B Q\"] in layer 'box': geometry"


def test_a_colour_is_a_material() -> None:
    assert 'fill="#c8b9a0"' in elevation_svg(two_boxes(material="#C8B9A0"))
    with pytest.raises(DesignError, match="found '#c8b9'"):
        elevation_svg(two_boxes(material="#c8b9"))


def test_every_geometry_and_mirror_draws_and_parses() -> None:
    from facade_nb.render import GEOMETRIES

    for name in GEOMETRIES:
        for mirrored in ((False, False), (True, False), (False, True)):
            for w, h in ((1.0, 1.5), (4.0, 3.0), (0.2, 0.2), (1e-5, 1.0)):
                shape = PlacedShape("l", "A", "P", (0, 0, w, h), mirrored, geometry=name, material="stone")
                text = elevation_svg(Layout("g", Canvas(5, 4), shapes=(shape,)))
                ET.fromstring(text)
                assert "nan" not in text
                assert "inf" not in text


def test_survey_moves_to_the_common_corner() -> None:
    layout = two_boxes(kind="window", geometry="window")
    survey = [{"kind": "window", "rect": [10.0, 20.0, 11.0, 21.0]}]
    text = elevation_svg(layout, survey=survey)
    rects = {e.get("class"): e for e in ET.fromstring(text).iter(f"{SVG}rect")}
    for name in ("x", "y", "width", "height"):
        assert rects["surveyed"].get(name) == rects["solved"].get(name)


def test_overlay_says_how_well_they_agree() -> None:
    layout = two_boxes(kind="window", geometry="window")
    text = overlay_svg(layout, [{"kind": "window", "rect": [0.0, 0.0, 1.0, 1.0]}])
    ET.fromstring(text)
    assert "mean intersection over union 1.000" in text
    assert "surveyed (1)" in text
    assert "0.250" in overlay_svg(layout, [], score=0.25)


def test_dimensions_add_up() -> None:
    assert re.search(r"<text[^>]*>6\.00</text>", elevation_svg(house(), dimensions=True))
