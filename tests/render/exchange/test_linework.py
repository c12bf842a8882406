"""The elevation as lines: what is hidden, what is joined, and which pen."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest
import shapely

from facade_nb.render import build_scene
from facade_nb.render.exchange.linework import Linework, linework

from .samples import layout, shape, solved


def ink(drawn: Linework, weight: str) -> Any:
    """All lines of a weight as one geometry."""
    return shapely.union_all([shapely.LineString(line) for line in drawn.lines[weight]])


def box(*rect: float) -> Any:
    return shapely.box(*rect).boundary


def drawn(width: float, height: float, *shapes: Any) -> Linework:
    return linework(build_scene(layout(width, height, *shapes)))


def same(found: Any, expected: Any) -> bool:
    return bool(found.symmetric_difference(expected).length < 1e-4)


def test_flush_cells_of_one_material_meet_without_a_line() -> None:
    third = 1 / 3
    found = drawn(1, 1, *(shape((k * third, 0, (k + 1) * third, 1), material="brick") for k in range(3)))
    assert same(ink(found, "outline"), box(0, 0, 1, 1))
    assert not found.lines["edge"] and not found.lines["fine"]
    assert len(found.surfaces) == 1


def test_model_board_shows_its_cells() -> None:
    found = drawn(2, 1, shape((0, 0, 1, 1)), shape((1, 0, 2, 1)))
    assert same(ink(found, "fine"), shapely.LineString([(1, 0), (1, 1)]))


@pytest.mark.parametrize(
    ("offset", "weight"), [(0.0, "fine"), (0.02, "fine"), (0.03, "edge"), (-0.2, "edge")]
)
def test_the_pen_is_chosen_by_depth(offset: float, weight: str) -> None:
    found = drawn(
        2, 1, shape((0, 0, 1, 1), material="brick"), shape((1, 0, 2, 1), material="stone", offset=offset)
    )
    assert same(ink(found, weight), shapely.LineString([(1, 0), (1, 1)]))


def test_what_is_behind_is_hidden() -> None:
    found = drawn(
        3,
        1,
        shape((0, 0, 1.5, 1), material="brick"),
        shape((1.5, 0, 3, 1), material="stone"),
        shape((1, 0.25, 2, 0.75), layer="front", material="oak", offset=0.2),
    )
    assert same(ink(found, "edge"), box(1, 0.25, 2, 0.75))
    expected = shapely.MultiLineString([[(1.5, 0), (1.5, 0.25)], [(1.5, 0.75), (1.5, 1)]])
    assert same(ink(found, "fine"), expected)


def test_a_later_layer_is_in_front_as_in_every_elevation() -> None:
    under = shape((0, 0, 2, 1), material="tiles", offset=0.5, geometry="panel")
    over = shape((0.5, 0.25, 1.5, 0.75), layer="dormers", material="oak")
    assert same(
        ink(drawn(2, 1, under, over), "edge").intersection(box(0.5, 0.25, 1.5, 0.75)),
        box(0.5, 0.25, 1.5, 0.75),
    )


def test_the_sky_between_bars_has_no_outline() -> None:
    found = drawn(
        2, 2, shape((0, 0, 2, 1), material="brick"), shape((0, 1, 2, 2), layer="top", geometry="railing")
    )
    gaps = ink(found, "outline").length
    assert gaps < 2 * (2 + 2) + 0.5 and found.lines["edge"]


def test_a_hole_in_the_facade_is_outlined() -> None:
    found = drawn(3, 1, shape((0, 0, 1, 1), material="brick"), shape((2, 0, 3, 1), material="brick"))
    assert same(ink(found, "outline"), shapely.union(box(0, 0, 1, 1), box(2, 0, 3, 1)))


@pytest.mark.parametrize("name", ["residential-house", "qualifiers-a"])
def test_surfaces_cover_the_shapes_and_never_each_other(name: str) -> None:
    own = solved(name)
    found = linework(build_scene(own))
    parts = [surface.polygon for surface in found.surfaces]
    whole = shapely.union_all(parts)
    assert whole.area == pytest.approx(sum(part.area for part in parts), rel=1e-4)
    full = [s for s in build_scene(own).solids if s.geometry.full and s.parts]
    skin = shapely.union_all([shapely.box(*s.rect) for s in full])
    assert skin.difference(whole.buffer(1e-4)).area < 1e-6
    everything = shapely.union_all([shapely.LineString(line) for line in lines_of(found)])
    rims = shapely.union_all([part.boundary for part in parts])
    assert rims.difference(everything.buffer(1e-3)).length < 1e-3  # every boundary is drawn


def lines_of(found: Linework) -> Iterable[Any]:
    for lines in found.lines.values():
        yield from lines


def test_nothing_is_no_line() -> None:
    found = drawn(3, 2)
    assert found.bounds is None and not list(lines_of(found))
