"""Who evaluates a grammar for a picture: OSMesa, EGL, or NumPy alone. All agree (docs/texture.md says how closely)."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ...design.errors import nearest
from ..backends import BackendError
from .evaluating import Question, Surface, evaluate
from .view import Sight

__all__ = ["PAINTERS", "Painter", "choose_painter"]


class Painter(Protocol):
    """A way to evaluate a grammar at the pixels of a picture."""

    name: str

    @property
    def why_not(self) -> str:
        """Why it cannot be used here and the command that would help; empty if it can."""
        ...

    @property
    def available(self) -> bool:
        """Whether it can be used here."""
        ...

    def paint(
        self,
        question: Question,
        sight: Sight,
        chosen: NDArray[np.intp] | None,
        shift: tuple[float, float],
        mips: bool,
    ) -> Surface:
        """The surface at pixels of a view; where the façade is not, nothing.

        Parameters
        ----------
        chosen
            Numbers of the pixels (n,), row by row from the top; None: all.
        shift
            The place in each pixel, from its lower left corner.
        mips
            Whether tiles are read in the size that fits a pixel.
        """
        ...


class _Cpu:
    """NumPy alone: it is always there."""

    name = "cpu"
    why_not = ""
    available = True

    def paint(
        self,
        question: Question,
        sight: Sight,
        chosen: NDArray[np.intp] | None,
        shift: tuple[float, float],
        mips: bool,
    ) -> Surface:
        looks = sight.looks(chosen, shift)
        inside = looks.inside
        if inside.all():
            return evaluate(question, looks.points, looks.rays, looks.footprint if mips else None)
        found = evaluate(
            question,
            looks.points[inside],
            None if looks.rays is None else looks.rays[inside],
            looks.footprint[inside] if mips else None,
        )
        color, normal, specular = (np.zeros((len(inside), 4), np.float32) for _ in range(3))
        surface = Surface(color, normal, specular, np.full(len(inside), -1, np.int32))
        for whole, part in zip(surface, found, strict=True):
            whole[inside] = part
        return surface


PAINTERS: dict[str, Painter] = {"cpu": _Cpu()}
"""The backends by name, the preferred one first."""


def choose_painter(name: str | None = None) -> Painter:
    """The backend of that name, or the first that works here.

    Raises
    ------
    ValueError
        For an unknown name.
    BackendError
        If the one asked for cannot be used here; its text says what would help.
    """
    if name is None:
        return next(painter for painter in PAINTERS.values() if painter.available)
    if name not in PAINTERS:
        raise ValueError(
            f"backend: expected one of {', '.join(PAINTERS)}; found {name!r}{nearest(name, PAINTERS)}"
        )
    if PAINTERS[name].why_not:
        raise BackendError(PAINTERS[name].why_not)
    return PAINTERS[name]
