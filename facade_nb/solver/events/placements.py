"""Events of sizing and merging (the paper's 5.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .base import Event

__all__ = [
    "ActiveSetStep",
    "AxisSolved",
    "BoundariesPlaced",
    "HoleFound",
    "LetterPlaced",
    "ShapeHidden",
    "ShapeMerged",
    "SystemPosed",
    "SystemSolved",
    "VariableNote",
]


@dataclass(frozen=True, slots=True)
class VariableNote:
    """What a variable of the least-squares system is.

    ``size`` of a symbol; ``boundary`` number `column` of a group; ``start`` or ``end``: bound of the letter that
    stands at place `place` of a band's element in a column. What does not apply is -1 or empty.
    """

    kind: str
    symbol: str = ""
    group: int = -1
    band: int = -1
    column: int = -1
    place: int = -1


@dataclass(frozen=True, slots=True)
class SystemPosed(Event):
    """The least-squares system of the chosen alignments: minimise Σ weight·(x − target)² within the bounds.

    Attributes
    ----------
    variables, meaning
        Names of the variables (see `sizing.System`), and what they are.
    rows, entries
        Names of the rows, and the matrix: ``(row, variable, coefficient)``, what is not listed is 0.
    lower, upper
        Bounds of the variables, then of the rows; ±1e30 and beyond: none.
    weight, target, pull
        Per variable: of the first round; where it would like to be; of the second round, which places what the
        first has left free.
    """

    variables: tuple[str, ...]
    meaning: tuple[VariableNote, ...]
    rows: tuple[str, ...]
    entries: tuple[tuple[int, int, float], ...]
    lower: tuple[float, ...]
    upper: tuple[float, ...]
    weight: tuple[float, ...]
    target: tuple[float, ...]
    pull: tuple[float, ...]

    @property
    def matrix(self) -> np.ndarray:
        """The matrix, shape (rows, variables)."""
        made = np.zeros((len(self.rows), len(self.variables)))
        for row, variable, coefficient in self.entries:
            made[row, variable] = coefficient
        return made


@dataclass(frozen=True, slots=True)
class ActiveSetStep(Event):
    """A step of an active-set method on the system, told by our own small one (`tracing.activeset`).

    Attributes
    ----------
    round
        1: sizes; 2: places.
    entered, left
        Constraints, counted as the bounds are: variables first, then rows. Step 0 enters all equations.
    active
        How many are active after it.
    objective, violation
        Of the round, at `values`, the variables after the step; the largest by which a constraint is still missed.
    """

    round: int
    step: int
    entered: tuple[int, ...]
    left: tuple[int, ...]
    active: int
    objective: float
    violation: float
    values: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class SystemSolved(Event):
    """The answer of the least-squares system.

    Attributes
    ----------
    solution, multipliers
        Of the first round. Multipliers of the bounds, then of the rows: positive where the upper bound pulls,
        negative where the lower one does.
    placed
        The variables after the second round: where everything stands.
    deviation
        √Σ (size − preferred)² over the sized symbols, metres.
    iterations
        Of the QP code, in the first round.
    """

    solution: tuple[float, ...]
    multipliers: tuple[float, ...]
    placed: tuple[float, ...]
    deviation: float
    iterations: int


@dataclass(frozen=True, slots=True)
class BoundariesPlaced(Event):
    """Every column boundary of a group in metres, 0 first, the canvas last."""

    group: str
    boundaries: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class LetterPlaced(Event):
    """A letter, or a piece of a cut one, with its interval in metres: the `place`-th of its row in a column."""

    group: str
    layer: str
    pattern: str
    column: int
    place: int
    letter: int
    symbol: str
    start: float
    end: float
    mirrored: bool
    transparent: bool


@dataclass(frozen=True, slots=True)
class AxisSolved(Event):
    """The axis is solved: J over all groups, the gap to what is proven, and whether the search ran to its end."""

    cost: float
    gap: float
    proven: bool
    complete: bool


@dataclass(frozen=True, slots=True)
class ShapeMerged(Event):
    """A visible shape: the fields of `layout.PlacedShape`. They come in painting order, the bottom layer first."""

    layer: str
    x: str
    y: str
    rect: tuple[float, float, float, float]
    mirrored: tuple[bool, bool]
    kind: str
    geometry: str
    material: str
    offset: float
    thickness: float
    number: tuple[int, int]


@dataclass(frozen=True, slots=True)
class ShapeHidden(Event):
    """A pair of letters that makes no shape.

    `why` is ``transparent``, ``mask``, ``hidden`` (by its pattern), ``not visible``, or ``behind`` an opaque shape of
    the layer `by`; `by` is the axis where one letter is to blame.
    """

    layer: str
    x: str
    y: str
    rect: tuple[float, float, float, float]
    why: str
    by: str


@dataclass(frozen=True, slots=True)
class HoleFound(Event):
    """A rectangle of the canvas that no visible shape covers."""

    rect: tuple[float, float, float, float]
