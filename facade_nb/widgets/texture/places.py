"""Where the steps of a pixel stand in space: scopes on the façade, and on the walls of the rooms behind it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import cast

from ...render import Grammar
from ...render.texture.steps import Entered, Step

__all__ = ["FACADE", "Plane", "Vector", "planes"]

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Plane:
    """A face as its scopes have it: a point (u, v) of it stands at origin + u · across + v · up.

    Attributes
    ----------
    origin
        Where its (0, 0) stands, metres; x to the right, y up, z out of the façade.
    across, up
        Unit vectors. Their cross product points to where the face is seen from.
    """

    origin: Vector
    across: Vector
    up: Vector

    @property
    def out(self) -> Vector:
        """Unit vector to where the face is seen from."""
        (a, b, c), (d, e, f) = self.across, self.up
        return (b * f - c * e, c * d - a * f, a * e - b * d)

    def at(self, u: float, v: float) -> Vector:
        """Where a point of the face stands."""
        return _sum(self.origin, (u, self.across), (v, self.up))

    def behind(self, scope: tuple[float, float, float, float], depth: float, face: str) -> Plane:
        """A face of the box behind a scope of this one; its scopes begin at the same corner (Intrusion)."""
        left, bottom, right, top = scope
        near, far = self.at(left, bottom), _sum(self.at(left, bottom), (-depth, self.out))
        into = _sum((0.0, 0.0, 0.0), (-1.0, self.out))
        corner, across, up = {
            "left": (near, into, self.up),
            "back": (far, self.across, self.up),
            "right": (_sum(far, (right - left, self.across)), self.out, self.up),
            "floor": (near, self.across, into),
            "ceiling": (_sum(far, (top - bottom, self.up)), self.across, self.out),
        }[face]
        return Plane(_sum(corner, (-left, across), (-bottom, up)), across, up)


FACADE = Plane((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


def planes(grammar: Grammar, steps: Sequence[Step]) -> Iterator[Plane]:
    """The plane on which each step of a derivation has its scope and its point."""
    within = [FACADE]  # as deep as there are rooms inside each other
    for step in steps:
        del within[len(step.faces) + 1 :]
        yield within[-1]
        if isinstance(step, Entered):
            inwards = cast(float, grammar.rules[step.rule].value("v"))  # the operator table says: a number
            depth = float(inwards)  # one that JSON can tell, too
            within.append(within[-1].behind(step.scope, depth, step.face))


def _sum(start: Vector, *added: tuple[float, Vector]) -> Vector:
    x, y, z = start
    for length, (dx, dy, dz) in added:
        x, y, z = x + length * dx, y + length * dy, z + length * dz
    return (x, y, z)
