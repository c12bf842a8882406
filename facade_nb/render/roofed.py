"""Dormers and windows that stand in a roof: on its slope, back into it, and no higher than it covers them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

from ..design.errors import Fault
from ..solver.model.layout import PlacedShape
from .parts import Part
from .seating import FOOT, LEAST, Slope, room_up, seat
from .standing import Solid, parts_of, place_of, size_of, solid_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["before_roof", "seated"]


def seated(solids: tuple[Solid, ...], over: Slope | None) -> tuple[tuple[Solid, ...], tuple[Fault, ...]]:
    """Dormers and windows where their roof has room for them; what was made smaller or left out for that.

    `over` is the roof of a building over all: there shapes that stand above its foot before nothing else stand in it.
    """
    roofs = [solid for solid in solids if _ends_above(solid)]
    if not roofs and over is None:
        return solids, ()
    slopes: dict[str, Slope] = {}
    faults: dict[str, Fault] = {}
    done: list[Solid] = []
    for solid in solids:
        slope = None
        if before_roof(solid.shape) and _may_stand(solid, roofs, over):
            behind = _behind(solid, done)
            if behind is None:
                slope = over if over is not None and solid.rect[1] > over.foot - FOOT else None
            elif _ends_above(behind):
                layer = behind.shape.layer
                slope = slopes[layer] = slopes.get(layer) or _slope_of(layer, roofs)
        if slope is None:
            done.append(solid)
            continue
        shape, told = _in_roof(solid.shape, slope)
        if told is not None:
            faults[str(told)] = told
        if shape is not None:
            done.append(_in_slope(solid, shape, slope))
    return tuple(done), tuple(faults.values())


def _ends_above(solid: Solid) -> bool:
    """Whether what stands before a shape has to be within its outline: a roof, a gable wall."""
    return solid.geometry.roof or solid.geometry.name == "gable"


def before_roof(shape: PlacedShape) -> bool:
    """Whether a shape is an opening, which has no business where there is no roof behind it."""
    return shape.kind in ("window", "dormer") or shape.geometry.startswith("dormer")


def _may_stand(solid: Solid, roofs: Sequence[Solid], over: Slope | None) -> bool:
    """Whether a shape stands before some roof, whatever else is there; of the many windows few do."""
    above = over is not None and solid.rect[1] > over.foot - FOOT
    return above or any(_before(solid, roof) for roof in roofs)


def _behind(solid: Solid, before: Sequence[Solid]) -> Solid | None:
    """What the middle of a shape stands before: the last of other layers."""
    return next((other for other in reversed(before) if _before(solid, other)), None)


def _before(solid: Solid, other: Solid) -> bool:
    """Whether the middle of a shape lies in another of an earlier layer."""
    left, bottom, right, top = solid.rect
    x, y = (left + right) / 2, (bottom + top) / 2
    l, b, r, t = other.rect  # noqa: E741
    return l < x < r and b < y < t and other.shape.layer != solid.shape.layer and other.index < solid.index


def _slope_of(layer: str, roofs: Sequence[Solid]) -> Slope:
    """The roofs of a layer, without gutters and boards."""
    import numpy as np

    from .meshing import mesh_parts

    found = []
    for roof in roofs:
        if roof.shape.layer == layer:
            mesh = mesh_parts([part for part in roof.parts if part.slot in ("body", "upper", "gable")])
            found.append(mesh.vertices[mesh.faces] + np.array([roof.rect[0], roof.rect[1], roof.face]))
    return Slope(np.concatenate(found))


def _in_roof(shape: PlacedShape, slope: Slope) -> tuple[PlacedShape | None, Fault | None]:
    """A shape as high as the roof behind it covers it, or None where there is no room; what there is to say of it."""
    (width, height), (left, bottom, right, _) = size_of(shape), shape.rect
    room = room_up(slope, height, lambda tall: _outline(shape, width, tall))
    if room >= height:
        return shape, None
    name = "dormer" if shape.geometry.startswith("dormer") else shape.kind
    least = (
        f"{room:.2f} m of it, and so much is drawn. Further from the roof's end, or lower, it has room"
        if room
        else f"less than {LEAST:g} m of it; it is left out"
    )
    message = (
        f"the {name} from x = {left:.2f} to {right:.2f} m is {height:.2f} m high and would stand out of the roof, "
        f"which has room there for {least}"
    )
    kept = replace(shape, rect=(left, bottom, right, bottom + room)) if room else None
    return kept, Fault(f"{place_of(shape)}: geometry", message)


def _outline(shape: PlacedShape, width: float, height: float) -> NDArray[np.float64]:
    """The places of the façade that a shape takes if it is so high."""
    import numpy as np

    left, bottom = shape.rect[:2]
    corners = np.array([(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)])
    if shape.geometry.startswith("dormer"):
        parts = parts_of(shape.geometry, round(width, 6), round(height, 6), 1.0, shape.mirrored)
        points = _places(parts) if parts else corners
    else:
        points = corners
    return np.maximum(points, (-np.inf, 0.0)) + np.array([left, bottom])


@lru_cache(maxsize=64)
def _places(parts: tuple[Part, ...]) -> NDArray[np.float64]:
    """Where the corners of parts are seen, (n, 2): dormers of one size share them."""
    from .meshing import mesh_parts

    return mesh_parts(parts).vertices[:, :2]


def _in_slope(solid: Solid, shape: PlacedShape, slope: Slope) -> Solid:
    """A shape in its roof: a dormer without an offset stands on the slope, and goes back to where that covers it."""
    own = solid.materials["body"]
    if solid.geometry.name != "dormer":
        return (
            solid
            if shape is solid.shape
            else solid_of(solid.index, shape, solid.geometry, own, solid.face, solid.depth)
        )
    face, end = seat(slope, _outline(shape, *size_of(shape)))
    face = solid.face if face is None or shape.offset else face
    return solid_of(solid.index, shape, solid.geometry, own, face, max(face - end, 0.2))
