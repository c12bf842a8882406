"""The light of an hour on what a view's pixels show: what the pipeline's passes do for a façade alone, in NumPy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..developing import developed, floats
from .antialias import averaged
from .daytime import Daytime, light
from .question import Question
from .shot import Painter
from .view import Sight

__all__ = ["lit"]


def lit(
    painter: Painter, question: Question, sight: Sight, daytime: Daytime, how: str = "adaptive"
) -> NDArray[np.float32]:
    """Colours (n, 4), multiplied by alpha, of a view's pixels; the façade stands alone and looks south.

    Light falls on the mean of a pixel's samples. At its outline a façade is as bright as inside, and covers less.
    """
    if any(daytime.sun):
        question = question._replace(sun=daytime.towards)  # for the shadows of relief
    shot, looks = averaged(painter, question, sight, how), sight.looks()
    color, normal, specular, _ = shot.surface
    alpha = color[:, 3:].clip(0, 1)
    count = len(color)
    rays = np.broadcast_to(floats([0, 0, -1]), (count, 3)) if looks.rays is None else looks.rays
    sunny = np.ones(count, np.float32) if shot.shade is None else 1 - shot.shade
    straight = np.concatenate([color[:, :3] / alpha.clip(1e-6), alpha], axis=1)
    found = light(straight, normal, specular, rays, daytime, sunny, looks.points[:, 1])
    return np.concatenate([developed(found, daytime.exposure) * alpha, alpha], axis=1)
