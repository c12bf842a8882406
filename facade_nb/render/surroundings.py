"""What a façade needs to read as a building: a body behind it, its side walls in the façade's materials."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

from ..solver.model.layout import Layout
from .materials import DEFAULT_MATERIAL
from .meshing import Mesh, mesh_parts
from .parts import Block, Part
from .ruled import is_rule
from .scene import Solid, Triangles, build_scene, triangles_of, without

__all__ = ["building"]


def building(layout: Layout, depth: float | None = None) -> Triangles:
    """All that stands in a picture: the scene with roofs as deep as the house, and a body `depth` metres deep."""
    width = layout.canvas.width
    deep = depth if depth is not None else min(12.0, max(4.0, 0.75 * width))
    scene = build_scene(layout, roof_depth=deep + 0.25)
    bodies: list[tuple[int, Mesh, Mapping[str, str]]] = [
        (solid.index, solid.mesh(), solid.materials) for solid in scene.solids
    ]
    roofs = [solid.rect for solid in scene.solids if solid.geometry.roof]
    walls = [
        solid
        for solid in scene.solids
        if solid.geometry.full
        and not solid.geometry.roof
        and not any(_within(solid.rect, roof) for roof in roofs)  # a dormer is no wall of the house
    ]
    if walls:
        back = min(solid.face - solid.depth for solid in walls)
        behind = [*_lining(walls, back).items(), *_body(walls, width, back, deep).items()]
        # What a rule draws is one wall; the house behind it has its mean colour.
        bodies += [
            _mesh(-1, parts, scene.material(name).fill if is_rule(name) else name) for name, parts in behind
        ]
    if not bodies:  # an empty canvas: a blank panel of its size
        bodies.append(_mesh(-1, [Block(0, 0, width, layout.canvas.height, -0.05, 0)], "plaster-white"))
    return triangles_of(bodies, scene.library)


def _mesh(index: int, parts: Sequence[Part], material: str) -> tuple[int, Mesh, Mapping[str, str]]:
    return index, mesh_parts(parts), {"body": material}


def _within(rect: Sequence[float], outer: Sequence[float]) -> bool:
    return all(a >= b - 1e-6 for a, b in zip(rect[:2], outer[:2], strict=True)) and all(
        a <= b + 1e-6 for a, b in zip(rect[2:], outer[2:], strict=True)
    )


def _lining(walls: Sequence[Solid], back: float) -> dict[str, list[Part]]:
    """What fills the gap between the backs of walls that differ in depth and the body, so that no light leaks in."""
    found: dict[str, list[Part]] = {}
    for solid in walls:
        behind = solid.face - solid.depth
        if behind > back + 1e-6:
            name = solid.materials["body"]
            deeper = [other.rect for other in walls if other.face - other.depth < behind - 1e-6]
            found.setdefault(name, []).extend(
                Block(*rect, back, behind) for rect in without(solid.rect, deeper)
            )
    return found


def _body(walls: Sequence[Solid], width: float, back: float, deep: float) -> dict[str, list[Part]]:
    """A block behind the walls, in bands of the material that stands at the façade's left and right edge."""
    found: dict[str, list[Part]] = {}
    low, high = min(solid.rect[1] for solid in walls), max(solid.rect[3] for solid in walls)
    middle = (back - deep) / 2 + back / 2
    for edge, x0, x1 in ((0.0, 0.0, width / 2), (width, width / 2, width)):
        touching = [s for s in walls if abs((s.rect[0] if edge == 0.0 else s.rect[2]) - edge) < 1e-3]
        stops = sorted({low, high, *(y for s in touching for y in s.rect[1::2])})
        for y0, y1 in pairwise(stops):
            here = [s for s in touching if s.rect[1] < (y0 + y1) / 2 < s.rect[3]]
            name = here[-1].materials["body"] if here else walls[0].materials["body"]
            if name in ("glass", DEFAULT_MATERIAL):
                name = "plaster"
            found.setdefault(name, []).append(Block(x0, y0, x1, y1, middle - deep / 2, back))
    return found
