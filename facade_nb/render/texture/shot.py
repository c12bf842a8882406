"""What pixels show, and who paints them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .question import Question, Surface
from .view import Looks, Sight

__all__ = ["Painter", "Shot", "spread"]


@dataclass(frozen=True, slots=True, eq=False)
class Shot:
    """What n pixels show.

    Attributes
    ----------
    surface
        Of each.
    margin
        (n,) float32, how near each came to a boundary, in pixels.
    fetches
        (n,) int32, how many texels the shader has read for each, where that was asked for.
    shade
        (n,) float32, how much of the sun the relief takes from each, where there is relief.
    """

    surface: Surface
    margin: NDArray[np.float32]
    fetches: NDArray[np.int32] | None = None
    shade: NDArray[np.float32] | None = None

    def first(self, number: int) -> Shot:
        """The first pixels alone."""
        color, normal, specular, rule = self.surface
        surface = Surface(color[:number], normal[:number], specular[:number], rule[:number])
        fetches = None if self.fetches is None else self.fetches[:number]
        return Shot(
            surface, self.margin[:number], fetches, None if self.shade is None else self.shade[:number]
        )


class Painter(Protocol):
    """A way to evaluate a grammar at the pixels of a picture."""

    @property
    def name(self) -> str:
        """By which it is chosen."""
        ...

    @property
    def why_not(self) -> str:
        """Why it cannot be used here and the command that would help; empty if it can."""
        ...

    @property
    def available(self) -> bool:
        """Whether it can be used here."""
        ...

    def paint(
        self, question: Question, sight: Sight, *, mips: bool = False, color_only: bool = False
    ) -> Shot:
        """Every pixel of a view, row by row from the top, at its centre; where the façade is not, nothing.

        With `mips` tiles are read in the size that fits a pixel; with `color_only` normals and specular values are
        passed over.
        """
        ...

    def paint_at(
        self, question: Question, looks: Looks, *, mips: bool = False, color_only: bool = False
    ) -> Shot:
        """Points with their rays; where the façade is not, nothing."""
        ...


def spread(shot: Shot, inside: NDArray[np.bool_]) -> Shot:
    """A shot of some pixels as one of all: those that are not `inside` show nothing."""
    if inside.all():
        return shot

    def of(part: NDArray[Any], empty: float) -> NDArray[Any]:
        whole = np.full((len(inside), *part.shape[1:]), empty, part.dtype)
        whole[inside] = part
        return whole

    color, normal, specular, rule = shot.surface
    surface = Surface(of(color, 0), of(normal, 0), of(specular, 0), of(rule, -1))
    fetches, shade = (None if own is None else of(own, 0) for own in (shot.fetches, shot.shade))
    return Shot(surface, of(shot.margin, 1e9), fetches, shade)
