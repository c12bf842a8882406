"""The views of a texture grammar: widgets of one kilobyte that name the channel and the part to show."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from math import cos, radians, sin, tan
from typing import Any, ClassVar, Self

from traitlets import Bool, Enum, Float, List

from ...render import Grammar
from ...render.texture.view import Sight
from ..shared.pictured import PartView, check_side
from .channel import TextureChannel
from .model import TextureModel
from .packet import grammar_table, step_text
from .still import image

__all__ = ["GrammarEditor", "GrammarTable", "PixelInspector", "TextureStudio", "TextureView"]

ANGLE = 50.0
"""Width of the view, degrees."""


ANTIALIAS = ("adaptive", "none")


def _table(rows: Iterable[Iterable[str]]) -> str:
    """A plain table in HTML."""
    cells = ("".join(f"<td>{escape(cell)}</td>" for cell in row) for row in rows)
    return f"<table>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>"


class _TextureWidget(PartView):
    """A view of a texture model; which one, says the class.

    Parameters
    ----------
    source
        A grammar, its text, or the `model` of another view. Views of one model follow each other.
    size, seed, hour, lit, tiles
        As of `TextureModel`, for a grammar or a text.
    """

    _pictured: ClassVar[bool] = False

    def __init__(self, source: TextureModel | Grammar | str = "", **options: Any) -> None:
        own = {
            name: options.pop(name)
            for name in tuple(options)
            if name in ("size", "seed", "hour", "lit", "tiles")
        }
        self.model = source if isinstance(source, TextureModel) else TextureModel(source, **own)
        super().__init__(channel=TextureChannel.of(self.model), part=self._shows, **options)

    def keep(self, side: int = 64) -> Self:
        """Give the page no tile with a longer side, in pixels: the saved notebook stays small, and its view alive.

        All views of the model follow. What is drawn in Python has the tiles as they are.

        Returns
        -------
        The view itself.

        Raises
        ------
        ValueError
            For a side that is no number of pixels.
        """
        self.channel.keep(check_side(side))
        return self

    def __repr__(self) -> str:
        rules = 0 if self.model.grammar is None else len(self.model.grammar.rules)
        return f"{type(self).__name__}({rules} rules)"

    def to_html(self) -> str:
        """The static form: a picture for pages where no widget can run; empty where there is none."""
        return image(self.model, self.channel.draw_still()) if self._pictured else ""


class TextureView(_TextureWidget):
    """The façade, drawn in the browser: orbit, dolly, sliders for seed, size and hour; click looks into a pixel.

    Attributes
    ----------
    turn, rise
        Where the eye stands, degrees to the right of and above the point looked at.
    distance
        From the eye to that point, metres.
    target
        The point of the façade that is in the middle; empty: its centre.
    flat
        Straight on, without perspective.
    controls
        Whether sliders are shown.
    antialias
        What the picture at rest becomes: ``adaptive``, more samples at boundaries, as offscreen; or ``none``.
    """

    _shows = "view"
    _pictured = True

    turn = Float(0.0).tag(sync=True)
    rise = Float(0.0).tag(sync=True)
    distance = Float(0.0, help="0: as far as the façade fills the view.").tag(sync=True)
    target = List(Float()).tag(sync=True)
    flat = Bool(True).tag(sync=True)
    controls = Bool(True).tag(sync=True)
    antialias = Enum(ANTIALIAS, "adaptive").tag(sync=True)

    def sight(self, pixels: tuple[int, int]) -> Sight:
        """What a picture of so many pixels shows, as the browser draws it."""
        width, height = self.model.size
        x, y = self.target or (width / 2, height / 2)
        half = tan(radians(ANGLE) / 2)
        margin = 1.04 if self.flat else 1.35
        distance = self.distance or margin * max(width, height * pixels[0] / pixels[1]) / 2 / half
        if self.flat:
            wide = distance * half
            tall = wide * pixels[1] / pixels[0]
            return Sight(self.model.size, pixels, (x - wide, y - tall, x + wide, y + tall))
        turn, rise = radians(self.turn), radians(self.rise)
        eye = (
            x + distance * sin(turn) * cos(rise),
            y + distance * sin(rise),
            distance * cos(turn) * cos(rise),
        )
        return Sight.from_eye(eye, (x, y), self.model.size, pixels, ANGLE)


class GrammarEditor(_TextureWidget):
    """The text of the grammar, with faults at their place."""

    _shows = "editor"

    def to_html(self) -> str:
        """The text, a row for each line."""
        lines = enumerate(self.model.text.split("\n"), 1)
        return _table((str(number), line) for number, line in lines)


class PixelInspector(_TextureWidget):
    """How the pixel that was clicked came about, step by step."""

    _shows = "inspector"

    def to_html(self) -> str:
        """The steps."""
        return _table((step.name, step.operator, step_text(step)) for step in self.model.derivation)


class GrammarTable(_TextureWidget):
    """The grammar texture, channel by channel, with names (the paper's Figure 3)."""

    _shows = "table"

    def to_html(self) -> str:
        """Every rule, its pixels one after the other."""
        if self.model.grammar is None:
            return ""
        return _table(
            (
                row["name"],
                row["operator"],
                *(
                    " · ".join(f"{label} {value}" if label else "–" for label, value in pixel["channels"])
                    for pixel in row["pixels"]
                ),
            )
            for row in grammar_table(self.model.grammar)
        )


class TextureStudio(TextureView):
    """Picture, editor, inspector and table in one."""

    _shows = "studio"
