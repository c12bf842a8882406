"""The whole building around the wall that is edited: what the 3D view of its studio shows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...building import BuildingLayout
from ...building.scene import solids_of_building
from ...render.pipeline.solids import BODY, GROUND, Solids
from ...solver import Layout

__all__ = ["OTHER", "Whole", "solids_around"]

OTHER = -3
"""What a triangle of another wall belongs to: this, less the number of that wall among those to choose."""


@dataclass(frozen=True)
class Whole:
    """What stands around a model's façade.

    Attributes
    ----------
    walls
        The names of all walls that can be chosen.
    solids
        The scene around a layout of the model; None: there is none yet.
    choose
        Edits another wall, by its number among `walls`.
    """

    walls: Callable[[], Sequence[str]]
    solids: Callable[[Layout], Solids | None]
    choose: Callable[[int], None]


def solids_around(layout: BuildingLayout, wall: str, own: Layout, walls: Sequence[str]) -> Solids:
    """A building, seen from before one of its walls: that wall is in the plane z = 0, its lower left corner the origin.

    Parameters
    ----------
    wall
        The name of the wall, or ``quoins`` and the name of their design.
    own
        What is edited. A triangle that belongs to one of its shapes has the number of that.
    walls
        What can be chosen: the triangles of other walls have the number of theirs (see `OTHER`).
    """
    number = {(s.layer, s.x, s.y, s.number): k for k, s in enumerate(own.shapes)}
    alike = {(s.layer, s.x, s.y): k for k, s in reversed(list(enumerate(own.shapes)))}
    codes, chosen = [], []
    for face in layout.faces:
        name = face.face.name
        quoins = {f"quoins {corner.design}" for _, corner in filter(None, face.face.quoins)}
        mine = name == wall or wall in quoins
        if mine:
            chosen.append(face)
        rest = OTHER - walls.index(name) if name in walls and name != wall else BODY
        for shape in face.shown.shapes:
            key = (shape.layer, shape.x, shape.y)
            codes.append(number.get((*key, shape.number), alike.get(key, rest)) if mine else rest)
    solids = solids_of_building(layout, before=chosen[0] if chosen else None)
    every = np.array([*codes, GROUND, BODY], np.int64)  # of what is no shape's the number counts from the end
    return replace(solids, shapes=every[solids.shapes])
