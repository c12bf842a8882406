"""A geometry or an operator of one's own, for as long as a ``with`` block lasts.

So a notebook can try one before it gets a place in the tables: CONTRIBUTING.md has the recipes for that.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass

from . import geometry as geometries
from . import ruled, standing
from .geometry import GEOMETRIES, Geometry
from .texture import operators
from .texture.batch import Batch
from .texture.operators import OPERATORS
from .texture.shaders import shader

__all__ = ["Move", "trying"]


@dataclass(frozen=True, slots=True)
class Move:
    """An operator of a texture grammar that moves points or their scope, and goes on with one rule.

    It is written ``Name(R)``, or ``Name(v, R)`` with a number v.

    Attributes
    ----------
    name
        As the grammar writes it.
    numpy
        Given points (`Batch`) and v, the points as they go on: ``replace(batch, x=…)``.
    glsl
        The same as statements of GLSL, on ``now``, the state of one pixel, and on ``v``: ``now.at.x = …;``. Empty:
        where OpenGL draws, it goes on with the rule as if nothing had been done.
    value
        Whether it is written with a number.
    """

    name: str
    numpy: Callable[[Batch, float], Batch]
    glsl: str = ""
    value: bool = False


@contextmanager
def trying(own: Geometry | Move) -> Iterator[None]:
    """Let designs name a geometry, or grammars an operator, until the block ends.

    Pictures have to be made within the block. It holds for the whole process, and is meant for one thread.

    Parameters
    ----------
    own
        A `Geometry` with a name that is not in `GEOMETRIES`, or a `Move` with one that is not an operator's.

    Raises
    ------
    ValueError
        For a name that is taken, or cannot be written in a design or a grammar.
    TypeError
        For anything else.
    """
    block: AbstractContextManager[object]
    if isinstance(own, Geometry):
        _check(own.name, GEOMETRIES, "[a-z][a-z0-9-]*", "a geometry", "battlement")
        block = geometries.held(own)
    elif isinstance(own, Move):
        _check(own.name, OPERATORS, "[A-Z][A-Za-z0-9]*", "an operator", "MirrorX")
        block = operators.held(own.name, own.numpy, own.glsl, own.value)
    else:
        raise TypeError(f"trying: expected a Geometry or a Move, found {type(own).__name__}")
    _forget()
    try:
        with block:
            yield
    finally:
        _forget()


def _check(name: str, taken: Collection[str], form: str, what: str, such: str) -> None:
    if not re.fullmatch(form, name):
        raise ValueError(f"trying: expected the name of {what} such as {such!r}, found {name!r}")
    if name.upper() in {known.upper() for known in taken}:  # the shader has them in capitals
        raise ValueError(f"trying: there is {what} {name!r} already; give yours another name")


def _forget() -> None:
    """Let go of what was made by name: a name may mean something else now."""
    standing.forget()
    ruled.forget()
    shader.cache_clear()
