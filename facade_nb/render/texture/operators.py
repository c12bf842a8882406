"""The operator table (texture paper, Figure 3): everything else about operators is derived from it.

The parser checks arguments against it, the encoder and the decoder follow its channels, the evaluators find values by
the names of its channels, the shader gets its constants from it, and the documentation prints it.

A channel is named by what stands in it:

========== ==========================================================================================
``code``   the operator's code
``n``      how many parts follow
``v``      a parameter of that name, as a number
``R.x``    the column of the position of the rule in parameter ``R``; ``R.y``: its row
``sv``     the size of a part with its policy as sign: negative for an absolute size (Eq. 1)
``Σrel``   sum of the relative sizes of all parts; ``Σabs``: of the absolute ones, positive
``Σv``     sum of the weights up to and with this part
(empty)    not used, zero
========== ==========================================================================================
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum, unique
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .batch import Batch

__all__ = ["BY_CODE", "OPERATORS", "POLICIES", "USAGES", "Kind", "Operator", "Param", "held"]


@unique
class Kind(Enum):
    """What a parameter may be; the value says it in a sentence."""

    SIZE = "a size in metres above 0"
    WEIGHT = "a probability above 0, at most 1"
    NUMBER = "a number"
    LEVEL = "a whole number, 0 or more"
    RULE = "the name of a rule"
    POLICY = "Abs or Rel"
    USAGE = "Color, Normal or Specular"
    SOURCE = "0, Fit:tile or Rep:tile"
    MASK = "Fit:tile"


POLICIES: Mapping[str, int] = {"Abs": -1, "Rel": 1}
USAGES: Mapping[str, int] = {"Color": 1, "Normal": 2, "Specular": 3}


@dataclass(frozen=True, slots=True)
class Param:
    """One parameter: its name in this table, and what it may be."""

    name: str
    kind: Kind


@dataclass(frozen=True, slots=True)
class Operator:
    """One operator.

    Attributes
    ----------
    name, code
        As the language and the texture write it.
    fixed
        Parameters that it always has, in order.
    part
        Parameters that each further part has; empty where there are no parts. One part at least.
    head
        Names of the channels of its first records, four to a pixel.
    each
        Names of the channels that a part takes: four, or two (then two parts share a pixel).
    doc
        What it does, in a sentence or two.
    move
        Of an operator that is being tried (`held`): what it does to points and their scope before it goes on with R,
        in NumPy. It is given the points and the value v. None for those of the table.
    glsl
        The same as statements of GLSL, on `now` (`glsl/texture/state.glsl`) and on the number `v`.
    """

    name: str
    code: int
    fixed: tuple[Param, ...]
    part: tuple[Param, ...]
    head: tuple[str, ...]
    each: tuple[str, ...]
    doc: str
    move: Callable[[Batch, float], Batch] | None = None
    glsl: str = ""

    @property
    def head_pixels(self) -> int:
        """How many pixels the fixed records take."""
        return len(self.head) // 4

    def pixels(self, parts: int) -> int:
        """How many pixels the operator takes with so many parts."""
        return self.head_pixels + -(-len(self.each) * parts // 4)

    @property
    def signature(self) -> str:
        """How it is written, such as ``RandUni(l, R1, …, Rn)``."""
        words = [param.name for param in self.fixed]
        if self.part:
            words += [f"{param.name}1" for param in self.part]
            words.append("…")
            words += [f"{param.name}n" for param in self.part]
        return f"{self.name}({', '.join(words)})"


_SIZE, _RULE, _LEVEL = Param("v", Kind.SIZE), Param("R", Kind.RULE), Param("l", Kind.LEVEL)
_SOURCE = (Param("m1", Kind.SOURCE), *(Param(f"m{i}", Kind.NUMBER) for i in range(2, 6)))
_FACTOR = (Param("a1", Kind.SOURCE), *(Param(f"a{i}", Kind.NUMBER) for i in range(2, 6)))
_FACES = ("left", "back", "right", "floor", "ceiling")


def _repeat(axis: str, code: int) -> Operator:
    return Operator(
        f"Repeat{axis}",
        code,
        (_SIZE, _RULE),
        (),
        ("code", "v", "R.x", "R.y"),
        (),
        f"Divides the scope along {axis.lower()} into ⌈size / v⌉ equal parts, at least one, with R in each. What fits "
        "by the decimals that were written fits.",
    )


def _split(axis: str, code: int) -> Operator:
    return Operator(
        f"Split{axis}",
        code,
        (),
        (Param("s", Kind.POLICY), _SIZE, _RULE),
        ("code", "n", "Σrel", "Σabs"),
        ("sv", "R.x", "R.y", ""),
        f"Divides the scope along {axis.lower()} into parts of absolute size (metres) or relative size "
        "(shares of what the absolute ones leave, Eq. 1).",
    )


_TABLE = (
    _repeat("X", 1),
    _repeat("Y", 2),
    _split("X", 3),
    _split("Y", 4),
    Operator(
        "Rand",
        5,
        (_LEVEL,),
        (Param("v", Kind.WEIGHT), _RULE),
        ("code", "n", "l", ""),
        ("Σv", "R.x", "R.y", ""),
        "Goes on with one of the rules, chosen with the probabilities v, by the random number of the scope (l = 0) "
        "or of the l-th last corner on the seed stack.",
    ),
    Operator(
        "RandUni",
        6,
        (_LEVEL,),
        (_RULE,),
        ("code", "n", "l", ""),
        ("R.x", "R.y"),
        "As Rand, with equal probabilities.",
    ),
    Operator(
        "RandStack",
        7,
        (_RULE,),
        (),
        ("code", "R.x", "R.y", ""),
        (),
        "Puts the scope's lower left corner on the seed stack and goes on with R.",
    ),
    Operator(
        "Layer",
        8,
        (),
        (_RULE,),
        ("code", "n", "", ""),
        ("R.x", "R.y"),
        "Lays the rules over one another, the last one on top, until colour is opaque (Eq. 2, 3).",
    ),
    Operator(
        "Skip",
        9,
        (_LEVEL,),
        (),
        ("code", "l", "", ""),
        (),
        "Leaves the layer transparent and passes over l more below it.",
    ),
    Operator(
        "SkipMask",
        10,
        (Param("m", Kind.MASK), Param("l0", Kind.LEVEL), Param("l1", Kind.LEVEL)),
        (),
        ("code", "m", "l0", "l1"),
        (),
        "Skip(l1) where the tile's mask, stretched over the scope, is at least 0.5, else Skip(l0).",
    ),
    Operator(
        "Intrusion",
        11,
        (_SIZE, *(Param(face, Kind.RULE) for face in _FACES)),
        (),
        ("code", "v", *(f"{face}.{axis}" for face in _FACES for axis in "xy")),
        (),
        "Shoots the viewing ray into a box of depth v behind the scope; goes on with the rule of the face hit.",
    ),
    Operator(
        "Mat",
        12,
        (Param("u", Kind.USAGE), *_SOURCE),
        (),
        ("code", "u", "m1", "", "m2", "m3", "m4", "m5"),
        (),
        "Adds a colour, a normal or a specular value: a constant (source 0: red, green, blue, alpha), a tile "
        "stretched over the scope (Fit: left, bottom, right, top of the part shown), or one repeated over the façade "
        "(Rep: offset in tiles, then repeats per metre).",
    ),
    Operator(
        "MatAlpha",
        13,
        (Param("u", Kind.USAGE), *_SOURCE, *_FACTOR),
        (),
        ("code", "u", "m1", "a1", "m2", "m3", "m4", "m5", "a2", "a3", "a4", "a5"),
        (),
        "As Mat, its alpha multiplied by the mask of a second source.",
    ),
)

_BY_NAME = {operator.name: operator for operator in _TABLE}
_BY_CODE = {operator.code: operator for operator in _TABLE}

OPERATORS: Mapping[str, Operator] = _BY_NAME
"""The operators by name, in the order of their codes."""

BY_CODE: Mapping[int, Operator] = _BY_CODE
"""The operators by code."""

FIRST_TRIED = 50
"""The code of the first operator that is being tried; the table's are less."""


@contextmanager
def held(name: str, move: Callable[[Batch, float], Batch], glsl: str, value: bool) -> Iterator[Operator]:
    """An operator ``Name(R)``, or ``Name(v, R)`` with a value, that is in the table until the block ends."""
    fixed = (Param("v", Kind.NUMBER), _RULE) if value else (_RULE,)
    code = max(FIRST_TRIED, *(known + 1 for known in _BY_CODE))
    head = ("code", "v" if value else "", "R.x", "R.y")
    operator = Operator(name, code, fixed, (), head, (), "An operator that is being tried.", move, glsl)
    _BY_NAME[name] = _BY_CODE[code] = operator
    try:
        yield operator
    finally:
        del _BY_NAME[name], _BY_CODE[code]
