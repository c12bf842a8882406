"""The derivation of one pixel, step by step: what a pixel inspector shows."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["FACES", "Chosen", "Divided", "Entered", "Layered", "Painted", "Passed", "Stacked", "Step"]

FACES = ("left", "back", "right", "floor", "ceiling")
"""Faces of an intrusion, in the order of their rules."""


@dataclass(frozen=True, slots=True)
class Step:
    """One operator at work.

    Attributes
    ----------
    rule, name, operator
        The rule (by its index), its name, its operator's name.
    scope
        Left, bottom, right, top before the operator has done its work, metres.
    point
        Where the pixel is, metres; on the face of an intrusion, in the face's own coordinates.
    seeds
        The seed stack, corners plus seed in steps of 1/64 m; the last one is on top.
    shift
        How often the seed is added to a corner for the random look-up.
    faces
        Faces of intrusions that it is on, the outermost first.
    layers
        For each Layer operator around it, the rule and the number of the layer, from 1.
    records
        Column and row of each pixel of the grammar texture that was read.
    """

    rule: int
    name: str
    operator: str
    scope: tuple[float, float, float, float]
    point: tuple[float, float]
    seeds: tuple[tuple[int, int], ...]
    shift: int
    faces: tuple[str, ...]
    layers: tuple[tuple[int, int], ...]
    records: tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True)
class Divided(Step):
    """Split or Repeat: part `part` (from 0) of `count`, from `low` to `high` metres along the axis."""

    part: int
    count: int
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Chosen(Step):
    """Rand or RandUni: part `part` (from 0), by the number `random` at `corner` (steps, with the seed)."""

    part: int
    random: float
    corner: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Stacked(Step):
    """RandStack: `corner` (steps, with the seed) was put on the seed stack."""

    corner: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Layered(Step):
    """Layer: layer number `layer` (from 1, the lowest) is evaluated next."""

    layer: int


@dataclass(frozen=True, slots=True)
class Passed(Step):
    """Skip or SkipMask: `levels` more layers are passed over; `mask` is the value of the mask, None without one."""

    levels: int
    mask: float | None


@dataclass(frozen=True, slots=True)
class Entered(Step):
    """Intrusion: the ray hits `face`, `depth` metres behind the scope."""

    face: str
    depth: float


@dataclass(frozen=True, slots=True)
class Painted(Step):
    """Mat or MatAlpha.

    Attributes
    ----------
    usage
        ``Color``, ``Normal`` or ``Specular``.
    value
        Red, green, blue, alpha that were added, before weighing with what lies above.
    total
        What has been gathered of this usage so far, red, green and blue multiplied by alpha (Eq. 2, 3).
    """

    usage: str
    value: tuple[float, float, float, float]
    total: tuple[float, float, float, float]
