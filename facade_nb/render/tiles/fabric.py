"""Curtains, blinds and panes of glass: what hangs between room and street. Each lets some of the room through."""

from __future__ import annotations

import numpy as np

from .canvas import Canvas, paint, smooth
from .glazing import drapes, reflection, sheer

__all__ = ["cafe", "curtain", "glass", "net", "shade_blind", "slats"]


def curtain(canvas: Canvas, seed: int, *, colour: str = "#b9a68c", lining: bool = True) -> None:
    """A pair of curtains drawn to the sides, below a pelmet's shadow."""
    if lining:
        sheer(canvas, seed + 5, canvas.full(), alpha=0.3)
    drapes(canvas, seed, (0.0, 0.0, canvas.width, canvas.tall), 0.27, colour)
    top = smooth(0.9 * canvas.tall, canvas.tall, canvas.y)
    canvas.shade(1 - 0.3 * top * np.ones_like(canvas.alpha))


def net(canvas: Canvas, seed: int) -> None:
    """A net curtain across the whole window, with a woven hem."""
    sheer(canvas, seed, canvas.full(), alpha=0.62, colour="#e6e3da")
    hem = canvas.box(-1, 0.03 * canvas.tall, canvas.width + 1, 0.09 * canvas.tall)
    canvas.lay(hem, "#e9e6dd", alpha=0.5)


def cafe(canvas: Canvas, seed: int) -> None:
    """A curtain on a rod across the lower half."""
    fall = 0.5 * canvas.tall
    wave = 0.008 * np.sin(canvas.x / canvas.width * 2 * np.pi * 9)
    cover = canvas.cover((canvas.y - fall + wave).astype(np.float32))
    sheer(canvas, seed, cover, alpha=0.82, colour="#e7e2d5")
    canvas.lay(canvas.box(-1, fall + 0.012, canvas.width + 1, fall + 0.026), "#8f7a4e", gloss=0.6)


def shade_blind(canvas: Canvas, seed: int, *, colour: str = "#d5cdb9") -> None:
    """A roller blind let down by two fifths."""
    fall = 0.6 * canvas.tall
    weave = (
        1
        + 0.012 * canvas.noise((0.004, 0.02), seed, 1)
        + 0.02 * np.sin(2 * np.pi * canvas.x / canvas.width * 1.5 + 1)
    )
    canvas.lay(
        canvas.box(-1, fall, canvas.width + 1, canvas.tall),
        np.clip(paint(colour) * weave[..., None], 0, 1),
        alpha=0.93,
    )
    canvas.lay(
        canvas.box(-1, fall - 0.004, canvas.width + 1, fall + 0.018),
        np.clip(paint(colour) * 0.82, 0, 1),
        height=0.01,
    )
    cord = canvas.box(0.5 * canvas.width - 0.002, fall - 0.1, 0.5 * canvas.width + 0.002, fall)
    canvas.lay(cord, "#b9b09a")


def slats(canvas: Canvas, seed: int, *, count: int = 34) -> None:
    """A venetian blind, its slats half open."""
    place = canvas.y / canvas.tall * count % 1 + 0 * canvas.x
    cover = canvas.cover((np.abs(place - 0.45) - 0.34).astype(np.float32) / count)
    tint = 0.9 + 0.13 * place + 0.01 * np.sin(3.7 * np.floor(canvas.y / canvas.tall * count) + seed)
    canvas.lay(cover, np.clip(paint("#d9d8d2") * tint[..., None], 0, 1), alpha=0.96, gloss=0.3)
    for x in (0.2, 0.8):
        canvas.lay(
            canvas.box(x * canvas.width - 0.004, 0, x * canvas.width + 0.004, canvas.tall),
            "#b9b6ac",
            alpha=0.9,
        )


def glass(canvas: Canvas, seed: int, *, dusk: bool = False) -> None:
    """A pane that mirrors the sky, more of it the higher one looks; the rest is clear."""
    colour, amount = reflection(canvas, seed, dusk=dusk)
    canvas.lay(canvas.full(), colour, alpha=amount, gloss=1.0)
