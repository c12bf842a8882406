"""Solids of a layout as a scene: places on façades, materials as rules, which shape a triangle belongs to."""

from __future__ import annotations

import numpy as np
import pytest

from facade_nb.design.errors import DesignError
from facade_nb.design.model import Canvas
from facade_nb.render.materials import MATERIALS, rgb
from facade_nb.render.pipeline.finishes import finishes
from facade_nb.render.pipeline.solids import BODY, GROUND, Solids, solids_of
from facade_nb.render.scene import build_scene
from facade_nb.render.surroundings import building
from facade_nb.solver.model.layout import Layout, PlacedShape

from ..houses import house


@pytest.fixture(scope="module")
def solids() -> Solids:
    return solids_of(house())


def rules(solids: Solids) -> np.ndarray:
    """The name of the rule of each triangle."""
    grammar = solids.scene.grammar
    names = dict(zip(grammar.encoding.positions, grammar.encoding.names, strict=True))
    first = solids.scene.vertices["start"][solids.scene.indices[::3]]
    return np.array([names[tuple(map(int, place))] for place in first])


def test_each_triangle_knows_its_shape(solids: Solids) -> None:
    layout = house()
    corners = solids.scene.vertices["position"][solids.scene.indices].reshape(-1, 3, 3)
    assert len(solids.shapes) == len(corners)
    assert set(solids.shapes) == {
        GROUND,
        BODY,
        *(solid.index for solid in build_scene(layout).solids if solid.parts),
    }
    for index in (0, len(layout.shapes) - 2):
        left, bottom, right, top = layout.shapes[index].rect
        own = corners[solids.shapes == index].reshape(-1, 3)
        assert own[:, 0].min() >= left - 0.1
        assert own[:, 0].max() <= right + 0.1
        assert own[:, 1].min() >= bottom - 0.1
        assert own[:, 1].max() <= top + 0.1


def test_a_place_is_in_metres_on_the_triangle(solids: Solids) -> None:
    """Positions differ as places do: along the tangent, and along the cross product of normal and tangent."""
    vertices = solids.scene.vertices[solids.scene.indices].reshape(-1, 3)
    normal, tangent = vertices["normal"][:, 0].astype(float), vertices["tangent"][:, 0].astype(float)
    up = np.cross(normal, tangent)
    for k in (1, 2):
        moved = (vertices["position"][:, k] - vertices["position"][:, 0]).astype(float)
        place = (vertices["place"][:, k] - vertices["place"][:, 0]).astype(float)
        assert np.abs((moved * normal).sum(axis=1)).max() < 1e-4
        assert np.abs((moved * tangent).sum(axis=1) - place[:, 0]).max() < 1e-3
        assert np.abs((moved * up).sum(axis=1) - place[:, 1]).max() < 1e-3
    assert (vertices["place"] >= -1e-4).all()
    assert (vertices["place"] <= vertices["size"] + 1e-4).all()
    turn = np.cross(*(vertices["position"][:, k] - vertices["position"][:, 0] for k in (1, 2)))
    assert ((turn * normal).sum(axis=1) > 0).all()  # seen from its front


def test_a_course_begins_at_the_foot_of_the_wall(solids: Solids) -> None:
    """The joints of a material run on around the corner: where they are depends on the height alone."""
    own = rules(solids) == "Flat" + str(list(dict.fromkeys(_names())).index("brick"))
    vertices = solids.scene.vertices[solids.scene.indices].reshape(-1, 3)[own]
    upright = np.abs(vertices["normal"][:, 0, 1]) < 1e-3
    assert upright.any()
    period = finishes(_names()).period[_names().index("brick"), 1]
    phase = (vertices["place"][upright][..., 1] - vertices["position"][upright][..., 1]) / period
    assert np.abs(phase - np.round(phase)).max() < 1e-4


def _names() -> tuple[str, ...]:
    from facade_nb.render.surroundings import building

    return building(house()).material_names


def test_panes_have_a_room_as_large_as_their_window(solids: Solids) -> None:
    panes = np.flatnonzero(rules(solids) == "Behind")
    assert len(panes) > 10
    layout = house()
    vertices = solids.scene.vertices[solids.scene.indices].reshape(-1, 3)
    for triangle in panes:
        left, bottom, right, top = layout.shapes[solids.shapes[triangle]].rect
        assert vertices["size"][triangle, 0] == pytest.approx((right - left, top - bottom), abs=1e-5)
    rooms = {tuple(vertices["seed"][k, 0]) for k in panes}
    assert len(rooms) == len({int(solids.shapes[k]) for k in panes})


def test_columns_are_round(solids: Solids) -> None:
    """Across a side of a shaft the normal turns as far as its corners' do, from the place 0 to the width."""
    own = [k for k, name in enumerate(rules(solids)) if name.startswith("Round")]
    assert len(own) > 100
    vertices = solids.scene.vertices[solids.scene.indices].reshape(-1, 3)[own]
    share = vertices["place"][..., 0] / vertices["size"][..., 0]
    assert (np.minimum(share, 1 - share).min(axis=1) < 0.05).all()
    spots = [(0.03, 0.5), (0.97, 0.5)]
    lean = solids.scene.grammar.evaluate(spots, (1, 1), start="Round0").normal[:, 0]
    assert lean[0] < 0.5 < lean[1]
    assert lean[0] + lean[1] == pytest.approx(1, abs=1e-3)


@pytest.mark.parametrize("kind", ["Bulging", "Hollow"])
def test_bowed_profiles_are_round_too(kind: str) -> None:
    """At the corners of each side of a column, torus to capital, the normal leans up as that of the mesh does."""
    own = PlacedShape("l", "A", "P", (0, 0, 0.5, 2), geometry="column")
    layout = Layout("Column", Canvas(0.5, 2), shapes=(own,))
    made, triangles = solids_of(layout, ground=False), building(layout)
    some = np.flatnonzero(np.char.startswith(rules(made).astype(str), kind))
    assert len(some) > 60
    found, wanted = [], []
    for k in some[:: max(1, len(some) // 40)].tolist():
        corners = made.scene.vertices[3 * k : 3 * k + 3]
        up = np.cross(corners["normal"][0], corners["tangent"][0])
        wanted += (triangles.normals[k] @ up).tolist()
        for spot, size in zip(corners["place"], corners["size"], strict=True):
            at = np.clip(spot, 1e-4, size - 1e-4)
            found.append(made.scene.grammar.evaluate([at], size, start=rules(made)[k]).normal[0, 1] * 2 - 1)
    assert np.abs(wanted).max() > 0.2
    assert np.abs(np.array(found) - wanted).max() < 0.75 / 30 + 0.01  # half a strip, and rounding


def test_every_material_is_a_rule() -> None:
    names = (*MATERIALS, "#c8b9a0", "rule:Anything")
    coats = finishes(names)
    assert len({tuple(place) for place in coats.flat}) == len(names)
    assert coats.glass.sum() == 1
    paint = coats.grammar.evaluate([(4, 4)], (9, 9), start=f"Plain{names.index('#c8b9a0')}").color[0]
    assert paint[:3] * 255 == pytest.approx((0xC8, 0xB9, 0xA0), abs=0.6)


def test_materials_have_their_pattern_and_their_colour() -> None:
    """Those with a pattern differ from place to place, with a tile of their name or without one."""
    names = tuple(MATERIALS)
    coats = finishes(names)
    across, up = np.meshgrid(np.linspace(1.03, 2.97, 24), np.linspace(1.01, 2.93, 24))
    spots = np.column_stack([across.ravel(), up.ravel()])
    for number, name in enumerate(names):
        color = coats.grammar.evaluate(spots, (9, 9), start=f"Flat{number}").color[:, :3]
        base = np.array(rgb(MATERIALS[name].base)) / 255
        assert np.abs(color.mean(axis=0) - base).max() < 0.14, name
        if MATERIALS[name].pattern not in ("", "glass"):
            assert color.std(axis=0).max() > 0.001, name


def test_an_unknown_material_is_named() -> None:
    wall = PlacedShape("wall", "A", "P", (0, 0, 1, 1), material="brik")
    with pytest.raises(DesignError, match="did you mean 'brick'"):
        solids_of(Layout("Wall", Canvas(1, 1), shapes=(wall,)))


def test_the_ground_is_left_out_if_asked() -> None:
    bare = solids_of(house(), ground=False)
    assert GROUND not in bare.shapes
    assert len(bare.scene.chunks) == 1
