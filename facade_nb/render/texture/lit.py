"""A painter that also lights what another one paints, so that pictures at an hour are antialiased as all others."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..daylight import floats
from ..developing import developed
from .daytime import Daytime, light
from .evaluating import Question, Surface
from .shot import Painter, Shot
from .view import Looks, Sight

__all__ = ["Lit"]


@dataclass(frozen=True, slots=True)
class Lit:
    """Paints colours in the light of an hour, ready to be shown; the façade stands alone and looks south.

    Attributes
    ----------
    painter
        Evaluates the grammar.
    daytime
        The hour.
    """

    painter: Painter
    daytime: Daytime

    @property
    def name(self) -> str:
        """That of the painter."""
        return self.painter.name

    @property
    def why_not(self) -> str:
        """That of the painter."""
        return self.painter.why_not

    @property
    def available(self) -> bool:
        """That of the painter."""
        return self.painter.available

    def paint(
        self, question: Question, sight: Sight, *, mips: bool = False, color_only: bool = False
    ) -> Shot:
        """As `Painter.paint`; normal and specular are always read, since light needs them."""
        return self._lit(self.painter.paint(self._asked(question), sight, mips=mips), sight.looks())

    def paint_at(
        self, question: Question, looks: Looks, *, mips: bool = False, color_only: bool = False
    ) -> Shot:
        """As `Painter.paint_at`."""
        return self._lit(self.painter.paint_at(self._asked(question), looks, mips=mips), looks)

    def _asked(self, question: Question) -> Question:
        """With the sun, for the shadows of relief."""
        return question._replace(sun=self.daytime.towards) if any(self.daytime.sun) else question

    def _lit(self, shot: Shot, looks: Looks) -> Shot:
        color, normal, specular, rule = shot.surface
        count = len(color)
        rays = np.broadcast_to(floats([0, 0, -1]), (count, 3)) if looks.rays is None else looks.rays
        sunny = np.ones(count, np.float32) if shot.shade is None else 1 - shot.shade
        lit = light(color, normal, specular, rays, self.daytime, sunny, looks.points[:, 1])
        shown = developed(lit, self.daytime.exposure) * (color[:, 3:] > 0)
        # Multiplied by alpha, as colours are; a highlight may not be more than that.
        shown = np.minimum(shown, color[:, 3:])
        return replace(
            shot, surface=Surface(np.concatenate([shown, color[:, 3:]], axis=1), normal, specular, rule)
        )
