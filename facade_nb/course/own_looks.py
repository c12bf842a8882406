"""Exercises of tutorial 13 about looks: a geometry and an operator of one's own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ..render import Grammar, Move, trying
from ..render.parts import Block
from ..render.texture import Sight
from ..render.texture.batch import Batch
from ..render.texture.painters import PAINTERS
from .exercises import Exercise, Open
from .judging import function, number, numbers

__all__ = ["DOUBLE_DOOR", "EXERCISES"]

DOUBLE_DOOR = """
S -> SplitX(Rel, 1, Leaf, Rel, 1, Other)
Other -> MirrorX(Leaf)
Leaf -> Mat(Color, Fit:door-modern, 0, 0, 1, 1)
"""
"""A leaf, and beside it the same in a mirror."""

_ROOMS = """
S -> SplitX(Abs, 0.5, Leaf, Rel, 1, Other)
Other -> MirrorX(Room)
Room -> Intrusion(1, Left, Back, Right, Back, Back)
Left -> Mat(Color, 0, 1, 0, 0, 1)
Right -> Mat(Color, 0, 0, 0, 1, 1)
Back -> Mat(Color, Fit:door-modern, 0, 0, 1, 1)
Leaf -> Mat(Color, 0, 0, 1, 0, 1)
"""
"""A room in a mirror, which begins half a metre from the left end: a ray that is not turned meets the wrong wall."""

_SIZES = ((4.1, 1.4, 0.2), (6.2, 2.0, 0.3), (0.5, 1.0, 0.1))


def _mirror(batch: Batch, v: float) -> Batch:
    x, y, z = batch.ray
    return replace(batch, x=batch.left + batch.right - batch.x, ray=(-x, y, z))


def _battlement(make: Callable[..., Any]) -> str:
    for w, h, d in _SIZES:
        made = make(w, h, d)
        if not isinstance(made, tuple) or not all(isinstance(own, Block) for own in made):
            return f"Expected a tuple of Blocks, found {made!r}."
        for own in made:
            if not (own.x0 < own.x1 and own.y0 < own.y1 and own.z0 < own.z1):
                return f"{own} has no room in it: x0, y0 and z0 have to be the smaller ones."
        pieces = 2 * max(1, round(w / 0.8)) - 1
        for n in range(pieces):
            for y, wall in ((0.3 * h, True), (0.8 * h, n % 2 == 0)):
                x = (n + 0.5) * w / pieces
                there = any(own.x0 < x < own.x1 and own.y0 < y < own.y1 for own in made)
                if there != wall:
                    is_, expected = ("stone", "nothing") if there else ("nothing", "stone")
                    return (
                        f"On {w:g} m by {h:g} m there is {is_} {x:.2f} m from the left and {y:.2f} m up, "
                        f"where {expected} should be."
                    )
        reach = [
            (min(o.x0 for o in made), max(o.x1 for o in made), w),
            (min(o.y0 for o in made), max(o.y1 for o in made), h),
        ]
        for low, high, size in reach:
            if abs(low) > 1e-6 or abs(high - size) > 1e-6:
                return f"On {w:g} m by {h:g} m it reaches from {low:.2f} to {high:.2f} m, and not from 0 to {size:g}."
        if any(abs(own.z0 + d) > 1e-6 or abs(own.z1) > 1e-6 for own in made):
            return f"With a depth of {d:g} m each block should reach from z = {-d:g} to z = 0."
    return ""


def _seen(grammar: str, move: Move, painter: str = "cpu") -> Any:
    """What is seen through the operator, obliquely, as the painter paints it: (n, 4)."""
    with trying(move):
        question = Grammar.parse(grammar).question((3, 2))
        sight = Sight.from_eye((0.4, 1, 2), (1.5, 1), (3, 2), (60, 40), angle=80)
        return PAINTERS[painter].paint(question, sight).surface.color


def _mirrors(mirror: Callable[..., Any]) -> str:
    def checked(batch: Batch, v: float) -> Batch:
        said = mirror(batch, v)
        if not isinstance(said, Batch):
            raise TypeError(
                f"expected the batch with other values, such as replace(batch, x=…); found {said!r}"
            )
        return said

    at = np.array([2.25, 2.5], np.float32)
    left, bottom, right, top, rx, ry, rz = (np.full(1, v, np.float32) for v in (2, 0, 3, 1, 0.5, 0.25, -1))
    ray, none = (rx, ry, rz), (bottom, bottom)
    asked = Batch(np.arange(2), at, at, left, bottom, right, top, ray, bottom, none)
    said = checked(asked, 0.0)
    wanted = _mirror(asked, 0.0)
    if not np.allclose(said.x, wanted.x):
        told = ", ".join(f"{float(x):g}" for x in np.atleast_1d(said.x))
        return f"In a scope from 2 to 3, of points at 2.25 and 2.5 you make {told}."
    if not all(np.allclose(a, b) for a, b in zip(said.ray, wanted.ray, strict=True)):
        return f"Of the ray (0.5, 0.25, -1) you make ({', '.join(f'{float(v[0]):g}' for v in said.ray)})."
    if not np.allclose(_seen(_ROOMS, Move("MirrorX", checked)), _seen(_ROOMS, Move("MirrorX", _mirror))):
        return "A room in the mirror looks otherwise: only x and the ray may change."
    return ""


def _shader(answer: object) -> str:
    if not isinstance(answer, str):
        return f"Expected statements of GLSL as a text, found {answer!r}."
    if "..." in answer:
        raise Open("put your statements in the place of the dots.")
    painter = next((name for name in ("osmesa", "egl") if PAINTERS[name].available), None)
    if painter is None:
        raise Open(f"there is no OpenGL here to try it. {PAINTERS['osmesa'].why_not}")
    try:
        seen = _seen(_ROOMS, Move("MirrorX", _mirror, answer), painter)
    except Exception as error:  # the compiler's own class depends on the driver
        told = [line.strip() for line in str(error).splitlines() if "error" in line]
        return f"The GLSL compiler says: {(told or [str(error)])[0]}"
    wrong = np.abs(seen - _seen(_ROOMS, Move("MirrorX", _mirror))).max(axis=1) > 0.01
    return "" if wrong.mean() < 0.01 else f"{wrong.sum()} of {wrong.size} pixels differ from NumPy's."


EXERCISES: Mapping[str, Exercise] = {
    "teeth": Exercise(
        numbers((5, 4 / 9), ("the number of teeth", "the width of each")),
        (
            "4 / 0.8 teeth. And how many gaps are there between so many teeth?",
            "5 teeth and 4 gaps share 4 m.",
        ),
        "Five teeth and four gaps, nine pieces of 0.444 m: as Repeat does, it takes a whole number and adapts.",
    ),
    "battlement": Exercise(
        function(_battlement),
        (
            "One block for the wall; then a block for every other piece, from 0.6 h to h.",
            "With pieces = 2 * teeth - 1, tooth i goes from x = 2 * i * w / pieces to (2 * i + 1) * w / pieces.",
        ),
        "A geometry is a function from three lengths to parts. Elevation, mesh and picture are made from these.",
    ),
    "place": Exercise(
        number(2.7),
        (
            "It is 0.3 m from the left end. In the mirror it is 0.3 m from the right one.",
            "left + right - x",
        ),
        "2.7: left + right − x.",
    ),
    "mirror": Exercise(
        function(_mirrors),
        (
            "x becomes left + right - x, as above. What goes to the right goes to the left in a mirror: the ray, too.",
            "x, y, z = batch.ray; then replace(batch, x=batch.left + batch.right - batch.x, ray=(-x, y, z)).",
        ),
        "The operator works for all points of a batch at once, in NumPy.",
    ),
    "shader": Exercise(
        _shader,
        (
            "The same two things for one pixel: now.at.x and now.ray.x get new values. A statement ends with ;",
            "The ends of the scope are now.scope.x and now.scope.z. The ray: now.ray.x = -now.ray.x;",
        ),
        "The graphics card's twin agrees with NumPy, pixel by pixel.",
    ),
}
