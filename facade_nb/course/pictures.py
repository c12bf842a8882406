"""Small pictures for tutorials about textures: a façade, the scopes of a pixel, buffers side by side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from ..render.texture import Grammar, Sight, texture_pixels
from ..render.texture.steps import Divided

__all__ = ["Picture", "painted", "sheet"]

_LINES = ("#ffd23f", "#ff8552", "#f45b69", "#b07cff", "#4cc9f0", "#7ae582")


@dataclass(frozen=True)
class Picture:
    """A picture that notebooks show and keep small.

    Attributes
    ----------
    image
        What is seen.
    says
        The same in words, for who does not see it.
    """

    image: Image.Image
    says: str = "A picture"

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, object]:
        stream = BytesIO()
        self.image.convert("RGB").save(stream, "JPEG", quality=82)
        return {"image/jpeg": stream.getvalue(), "text/plain": repr(self)}

    def __repr__(self) -> str:
        width, height = self.image.size
        return f"<{self.says}, {width} × {height} pixels>"


def painted(
    grammar: Grammar | str,
    size: tuple[float, float],
    *,
    start: str | None = None,
    seed: tuple[float, float] = (1.0, 2.0),
    eye: tuple[float, float, float] | None = None,
    point: tuple[float, float] | None = None,
    width: int = 480,
) -> Picture:
    """A façade by its grammar.

    Parameters
    ----------
    grammar
        Or its text.
    size
        Width and height of the façade, metres.
    start, seed
        As of `Grammar.evaluate`.
    eye
        Where one stands, to look at the middle of the façade; None: straight on.
    point
        A point of the façade whose splits are drawn on it: each part that it lies in.
    width
        Of the picture, in pixels.
    """
    grammar = Grammar.parse(grammar) if isinstance(grammar, str) else grammar
    pixels = (width, max(1, round(width * size[1] / size[0])))
    middle = (size[0] / 2, size[1] / 2)
    sight = (
        None if eye is None else Sight.from_eye(eye, middle, size, pixels, angle=_angle(eye, middle, size))
    )
    found = texture_pixels(grammar, size=size, pixels=pixels, start=start, seed=seed, camera=sight)
    image = Image.new("RGB", pixels, "white")
    drawn = Image.fromarray(found)
    image.paste(drawn, (0, 0), drawn)
    if point is not None:
        _outlined(image, grammar, size, start, seed, point)
    return Picture(image, "A façade" if point is None else "A façade with the parts that a point lies in")


def _angle(eye: tuple[float, float, float], middle: tuple[float, float], size: tuple[float, float]) -> float:
    """Wide enough for the façade, with a rim."""
    far = float(np.hypot(eye[2], middle[0] - eye[0]))
    return float(np.degrees(2 * np.arctan(0.6 * size[0] / far)))


def _outlined(
    image: Image.Image,
    grammar: Grammar,
    size: tuple[float, float],
    start: str | None,
    seed: tuple[float, float],
    point: tuple[float, float],
) -> None:
    """Draw the parts that a point lies in, from the façade on, and the point."""
    scale = image.width / size[0]
    steps = grammar.steps(point, size, seed, start)
    divided = [own for own in steps if isinstance(own, Divided)]
    draw = ImageDraw.Draw(image)
    for number, step in enumerate(divided):
        left, bottom, right, top = step.scope
        if step.operator.endswith("X"):
            left, right = step.low, step.high
        else:
            bottom, top = step.low, step.high
        box = (left * scale, image.height - top * scale, right * scale - 1, image.height - bottom * scale - 1)
        draw.rectangle(box, outline=_LINES[number % len(_LINES)], width=3)
    x, y = point[0] * scale, image.height - point[1] * scale
    draw.ellipse((x - 4, y - 4, x + 4, y + 4), fill="#ff0000", outline="white")


def sheet(pictures: Mapping[str, Picture | NDArray[np.uint8]], columns: int = 3) -> Picture:
    """Pictures in rows, each with its name below it; smaller ones are made as wide as the widest."""
    shown: Sequence[tuple[str, Image.Image]] = [
        (name, own.image if isinstance(own, Picture) else Image.fromarray(own))
        for name, own in pictures.items()
    ]
    wide = max(own.width for _, own in shown)
    shown = [
        (name, own.resize((wide, round(own.height * wide / own.width)), Image.Resampling.NEAREST))
        for name, own in shown
    ]
    tall = max(own.height for _, own in shown)
    label, gap = 16, 6
    rows = -(-len(shown) // columns)
    columns = min(columns, len(shown))
    image = Image.new("RGB", (columns * (wide + gap) - gap, rows * (tall + label + gap) - gap), "white")
    draw = ImageDraw.Draw(image)
    for number, (name, own) in enumerate(shown):
        x, y = number % columns * (wide + gap), number // columns * (tall + label + gap)
        image.paste(own.convert("RGB"), (x, y))
        draw.text((x + 2, y + tall + 2), name, fill="black")
    return Picture(image, f"Pictures of {', '.join(pictures)}")
