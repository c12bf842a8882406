"""What goes along a street: people, and the wheels of cars."""

from __future__ import annotations

from collections.abc import Sequence

from .canvas import Canvas

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
    """Four figures side by side, walking, seen from in front, flat and without faces, as architects draw them."""
    wide = canvas.width / len(FIGURES)
    canvas.colour[...] = 0.25
    for number, figure in enumerate(FIGURES):
        _figure(canvas, (number + 0.5) * wide, figure, -1.0 if number % 2 else 1.0)


def _figure(canvas: Canvas, x: float, figure: Figure, side: float) -> None:
    coat, trousers, shoes, hair, skin, part, long = figure
    h = 0.985 * canvas.tall * part

    def at(*points: tuple[float, float]) -> list[tuple[float, float]]:
        return [(x + side * a * h, b * h) for a, b in points]

    def limb(points: list[tuple[float, float]], width: float, colour: str) -> None:
        canvas.lay(canvas.cover(canvas.line_distance(points, width * h)), colour, gloss=0.05)

    # The leg behind is lifted; feet point to whoever looks.
    limb(at((0.035, 0.47), (0.042, 0.27), (0.04, 0.11)), 0.062, trousers)
    limb(at((0.038, 0.085), (0.052, 0.07)), 0.05, shoes)
    limb(at((-0.03, 0.47), (-0.035, 0.26), (-0.038, 0.06)), 0.068, trousers)
    limb(at((-0.04, 0.028), (-0.052, 0.022)), 0.05, shoes)
    limb(at((0.105, 0.76), (0.125, 0.62), (0.115, 0.5)), 0.05, coat)
    limb(at((0.114, 0.475), (0.112, 0.465)), 0.04, skin)
    hem = 0.36 if long else 0.47
    body = at(
        (-0.075, hem), (0.075, hem), (0.072, 0.6), (0.115, 0.79), (0.06, 0.825), (-0.06, 0.825), (-0.115, 0.79),
        (-0.072, 0.6),
    )  # fmt: skip
    canvas.lay(canvas.cover(canvas.polygon_distance(body)), coat, gloss=0.05)
    canvas.lay(canvas.cover(canvas.line_distance(at((0.0, hem), (0.0, 0.8)), 0.006 * h)), "#1c1b1b")
    limb(at((-0.108, 0.77), (-0.13, 0.63), (-0.11, 0.51)), 0.054, coat)
    limb(at((-0.108, 0.485), (-0.105, 0.475)), 0.042, skin)
    limb(at((0.0, 0.82), (0.0, 0.87)), 0.055, skin)
    canvas.lay(canvas.cover(canvas.disc_distance(x, 0.925 * h, 0.07 * h)), hair, gloss=0.1)
    face = canvas.cover(canvas.disc_distance(x + side * 0.004 * h, 0.908 * h, 0.052 * h))
    canvas.lay(face, skin, gloss=0.08)
    if long:  # hair down to the shoulders
        for out in (-0.055, 0.055):
            limb(at((out, 0.93), (out * 1.1, 0.85)), 0.035, hair)


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
