"""What goes along a street: people, and the wheels of cars."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .canvas import Canvas, Floats, paint

__all__ = ["FIGURES", "people", "wheel"]

Figure = tuple[str, str, str, str, str, float, bool]
FIGURES: Sequence[Figure] = (
    ("#4a4f57", "#2f333b", "#1f1d1c", "#3b2c22", "#d2a689", 1.0, False),
    ("#8a5a46", "#39424f", "#5b4433", "#6b4a2e", "#dcb49a", 0.94, True),
    ("#b9b1a1", "#55504a", "#2b2725", "#20191a", "#8d6248", 0.98, False),
    ("#5d6b4e", "#6b6357", "#3a302a", "#a58a5e", "#e0bda4", 0.9, True),
)
"""Of each figure: its coat, its trousers, shoes, hair, skin, how tall it is as a part, and whether its coat is long."""


def people(canvas: Canvas, seed: int) -> None:
    """Four figures side by side, walking, seen from in front, lit from above."""
    wide = canvas.width / len(FIGURES)
    canvas.colour[...] = 0.25
    folds = canvas.noise((0.05, 0.16), seed, 2)
    for number, figure in enumerate(FIGURES):
        _figure(canvas, (number + 0.5) * wide, figure, -1.0 if number % 2 else 1.0, folds)


def _figure(canvas: Canvas, x: float, figure: Figure, side: float, folds: Floats) -> None:
    coat, trousers, shoes, hair, skin, part, long = figure
    h = 0.985 * canvas.tall * part

    def at(*points: tuple[float, float]) -> list[tuple[float, float]]:
        return [(x + side * a * h, b * h) for a, b in points]

    def lay(distance: Floats, round_: float, colour: str, cloth: float = 1.0) -> None:
        """Something round, whose surface turns away over so many metres from its outline; cloth has folds."""
        across = 1 - np.clip(-distance / round_, 0, 1)
        shade = 0.42 + 0.64 * np.sqrt(1 - across * across) + 0.09 * cloth * folds
        colours = np.clip(paint(colour) * shade[..., None], 0, 1)
        canvas.lay(canvas.cover(distance), colours, gloss=0.05)

    def limb(points: list[tuple[float, float]], width: float, colour: str, cloth: float = 1.0) -> None:
        lay(canvas.line_distance(points, width * h), 0.5 * width * h, colour, cloth)

    def dot(a: float, b: float, radius: float, colour: str, alpha: float = 1.0) -> None:
        spot = canvas.cover(canvas.disc_distance(x + side * a * h, b * h, radius * h))
        canvas.lay(spot * np.float32(alpha), colour)

    def line(points: list[tuple[float, float]], width: float, colour: str, alpha: float = 1.0) -> None:
        canvas.lay(canvas.cover(canvas.line_distance(points, width * h)) * np.float32(alpha), colour)

    # The leg behind is lifted; feet point to whoever looks.
    limb(at((0.035, 0.47), (0.042, 0.27), (0.04, 0.11)), 0.064, trousers)
    limb(at((0.038, 0.085), (0.052, 0.07)), 0.05, shoes, 0)
    limb(at((-0.03, 0.47), (-0.035, 0.26), (-0.038, 0.06)), 0.07, trousers)
    limb(at((-0.04, 0.028), (-0.052, 0.022)), 0.05, shoes, 0)
    limb(at((0.114, 0.475), (0.112, 0.465)), 0.04, skin, 0)
    limb(at((0.09, 0.765), (0.124, 0.62), (0.115, 0.5)), 0.052, coat)
    if long:  # hair down to the shoulders, behind the neck
        limb(at((-0.03, 0.9), (-0.035, 0.83)), 0.06, hair)
        limb(at((0.03, 0.9), (0.035, 0.83)), 0.06, hair)
    limb(at((0.0, 0.81), (0.0, 0.87)), 0.052, skin, 0)
    line(at((-0.018, 0.848), (0.018, 0.848)), 0.022, "#000000", 0.3)  # the chin's shadow
    hem = 0.36 if long else 0.455
    flare = 0.085 if long else 0.07
    body = at(
        (-flare, hem), (flare, hem), (0.066, 0.6), (0.088, 0.74), (0.105, 0.785), (0.045, 0.83), (0.0, 0.79),
        (-0.045, 0.83), (-0.105, 0.785), (-0.088, 0.74), (-0.066, 0.6),
    )  # fmt: skip
    lay(canvas.polygon_distance(body), 0.05 * h, coat)
    line(at((0.0, hem), (0.0, 0.79)), 0.005, "#000000", 0.45)
    line(at((-0.045, 0.826), (0.0, 0.785), (0.045, 0.826)), 0.012, "#000000", 0.3)  # a collar
    line(at((-0.055, 0.56), (-0.025, 0.555)), 0.006, "#000000", 0.35)
    line(at((0.055, 0.56), (0.025, 0.555)), 0.006, "#000000", 0.35)
    limb(at((-0.108, 0.485), (-0.105, 0.475)), 0.042, skin, 0)
    limb(at((-0.088, 0.768), (-0.126, 0.63), (-0.11, 0.51)), 0.054, coat)
    # The head: an egg, hair around its upper half.
    lay(canvas.line_distance(at((0.0, 0.926), (0.0, 0.93)), 0.108 * h), 0.05 * h, hair)
    for a in (-0.044, 0.044):
        dot(a, 0.906, 0.009, skin)
    egg = canvas.line_distance(at((0.0, 0.893), (0.0, 0.918)), 0.084 * h)
    lay(egg, 0.05 * h, skin, 0)
    for a in (-0.016, 0.016):
        dot(a, 0.913, 0.0065, "#ded6cc", 0.5)
        dot(a, 0.913, 0.0045, "#2a211c")
        line(at((a - 0.008, 0.9255), (a, 0.927), (a + 0.008, 0.9255)), 0.0035, hair, 0.6)
    line(at((0.001, 0.912), (0.003, 0.898)), 0.006, "#000000", 0.16)
    line(at((-0.005, 0.896), (0.006, 0.896)), 0.005, "#3a1f18", 0.35)
    line(at((-0.011, 0.881), (0.011, 0.881)), 0.005, "#7a3b33", 0.75)
    fringe = at(
        (-0.046, 0.915),
        (-0.04, 0.965),
        (0.0, 0.985),
        (0.04, 0.965),
        (0.046, 0.915),
        (0.03, 0.945),
        (-0.012, 0.951),
    )
    lay(canvas.polygon_distance(fringe), 0.02 * h, hair)


def wheel(canvas: Canvas, seed: int) -> None:
    """A wheel in its arch: tyre, rim with five spokes."""
    x, y = canvas.width / 2, canvas.tall / 2
    for radius, colour, high in ((0.5, "#0e0e0f", 0.0), (0.44, "#1d1d1e", 0.03), (0.3, "#8d9093", 0.04)):
        canvas.lay(
            canvas.cover(canvas.disc_distance(x, y, radius * canvas.width)), colour, height=high, gloss=0.4
        )
    spots = ((0.0, 1.0), (0.95, 0.31), (0.59, -0.81), (-0.59, -0.81), (-0.95, 0.31))
    for a, b in spots:
        spot = canvas.disc_distance(
            x + 0.19 * a * canvas.width, y + 0.19 * b * canvas.width, 0.07 * canvas.width
        )
        canvas.lay(canvas.cover(spot), "#222325", height=0.02)
