"""What is asked of a grammar's evaluators, and what they answer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .atlas import Atlas
from .batch import Floats
from .encoding import Record
from .noise import Seed

__all__ = ["Question", "Surface"]


class Surface(NamedTuple):
    """What a grammar gives at n points.

    Attributes
    ----------
    color
        (n, 4) float32: red, green and blue multiplied by alpha, and alpha, as Eq. 2 and 3 add them up.
    normal
        (n, 4) float32: the same of the normal, written as (n + 1) / 2: x to the right, y up, z out of the
        façade, also where it comes from a face of an intrusion.
    specular
        (n, 4) float32: the same of the specular value.
    rule
        (n,) int32: the topmost terminal rule that gave colour with alpha above 0; -1 where there is none.
    """

    color: Floats
    normal: Floats
    specular: Floats
    rule: NDArray[np.int32]


class Question(NamedTuple):
    """What is asked of a grammar, but for the points.

    Attributes
    ----------
    texture
        The grammar's texture.
    records
        The rules, read from it.
    names
        Of the rules.
    start
        The rule to begin with.
    size
        Of the façade, metres.
    seed
        Of the façade.
    atlas
        The tiles.
    recurs
        Whether a rule can come back to itself: only then steps are counted, for otherwise there are few enough.
    stacks
        How many Layer operators, and how many RandStack ones, can stand inside each other: room that the shader needs.
    rooms
        How many Intrusion operators can.
    relief
        Whether tiles with heights in the atlas are seen with their relief.
    sun
        Towards the sun: x to the right, y up, z out of the façade. The relief throws shadows if z is above 0.
    """

    texture: NDArray[Any]
    records: Sequence[Record]
    names: Sequence[str]
    start: int
    size: tuple[float, float]
    seed: Seed
    atlas: Atlas
    recurs: bool
    stacks: tuple[int, int]
    rooms: int
    relief: bool = False
    sun: tuple[float, float, float] = (0.0, 0.0, 0.0)
