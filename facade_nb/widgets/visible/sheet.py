"""Small drawings for the static forms: SVG in the colours of the front end's views, as images in HTML."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Sequence
from html import escape

from ...render.style import num
from ...solver.events import LetterNote

__all__ = ["HUES", "INK", "MUTED", "Sheet", "spelled", "table"]

HUES = (
    "#d9b48f", "#8fb8d8", "#b9cf8c", "#e3a1a1", "#b7a8d8", "#8ecfc0", "#ead27a", "#c9c4bb", "#e2b0d2", "#a3b1bd",
)  # fmt: skip
"""Colours of symbols on light paper, as styles/solver.css has them."""
INK, MUTED, PAPER = "#23201c", "#6f6a62", "#fbfaf6"
ACCENT, SECOND, GOOD, BAD = "#c2410c", "#0b6e99", "#388e3c", "#d32f2f"
_SANS, _MONO = (
    "system-ui, 'Segoe UI', Helvetica, Arial, sans-serif",
    "Menlo, Consolas, 'DejaVu Sans Mono', monospace",
)


_STYLE = (
    f"text{{font-family:{_SANS}}}.m{{font-family:{_MONO}}}.b{{font-weight:600}}.am{{text-anchor:middle}}"
    f".ae{{text-anchor:end}}.l{{font:11px {_MONO};text-anchor:middle;fill:{INK}}}.d{{opacity:.45}}"
    f".g{{fill:none;stroke:{MUTED};stroke-dasharray:3 2}}"
    + "".join(f".h{n}{{fill:{hue};stroke:{INK}}}" for n, hue in enumerate(HUES))
)


class Sheet:
    """A drawing that grows downwards. Coordinates are pixels."""

    def __init__(self, width: float) -> None:
        self.width = width
        self.height = 10.0
        self._parts: list[str] = []

    def text(
        self, x: float, y: float, text: str, *, size: float = 12, fill: str = INK, anchor: str = "start",
        mono: bool = False, bold: bool = False,
    ) -> None:  # fmt: skip
        """Write a text, its baseline at y."""
        classes = " ".join(name for name, on in (("m", mono), ("b", bold), (f"a{anchor[0]}", True)) if on)
        self._parts.append(
            f'<text class="{classes}" x="{num(x)}" y="{num(y)}" font-size="{num(size)}" fill="{fill}">'
            f"{escape(text)}</text>"
        )

    def box(
        self,
        x: float,
        y: float,
        w: float,
        h: float,
        *,
        fill: str = "none",
        stroke: str = "none",
        opacity: float = 1.0,
    ) -> None:
        """Draw a rectangle."""
        faint = f' opacity="{num(opacity)}"' if opacity < 1 else ""
        self._parts.append(
            f'<rect x="{num(x)}" y="{num(y)}" width="{num(w)}" height="{num(h)}" fill="{fill}" '
            f'stroke="{stroke}"{faint}/>'
        )

    def line(
        self, x0: float, y0: float, x1: float, y1: float, *, stroke: str = MUTED, dash: str = ""
    ) -> None:
        """Draw a line."""
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        self._parts.append(f'<path d="M{num(x0)} {num(y0)}L{num(x1)} {num(y1)}" stroke="{stroke}"{dashed}/>')

    def letter(
        self, x: float, y: float, w: float, h: float, letter: LetterNote, hue: int, *, free: bool = False,
        dim: bool = False,
    ) -> None:  # fmt: skip
        """Draw a letter: solid, dashed where it is transparent, and without a fill where its size is free."""
        look = "g" if letter.transparent or free else f"h{hue % len(HUES)}"
        self._parts.append(
            f'<rect class="{look}{" d" if dim else ""}" x="{num(x)}" y="{num(y)}" width="{num(w)}" height="{num(h)}"/>'
        )
        if w >= 8 * len(letter.symbol):
            text = letter.symbol + ("′" if letter.mirrored else "")
            self._parts.append(
                f'<text class="l{" d" if dim else ""}" x="{num(x + w / 2)}" y="{num(y + h / 2 + 4)}">'
                f"{escape(text)}</text>"
            )

    def image(self, alt: str) -> str:
        """The drawing as an image in HTML: JupyterLab shows no SVG in a notebook that is not trusted yet."""
        w, h = num(self.width), num(self.height)
        drawn = (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}">'
            f'<style>{_STYLE}</style><rect width="100%" height="100%" fill="{PAPER}"/>{"".join(self._parts)}</svg>'
        )
        data = b64encode(drawn.encode()).decode("ascii")
        return f'<img alt="{escape(alt)}" src="data:image/svg+xml;base64,{data}">'


def spelled(letters: Sequence[LetterNote]) -> str:
    """A word in short, as the front end writes it: ``A²C``, ``G(AB)³A``, a dash behind mirrored letters."""
    names = [
        (a.symbol if len(a.symbol) == 1 or a.symbol[1:].isdigit() else f"⟨{a.symbol}⟩") + "′" * a.mirrored
        for a in letters
    ]
    keys = [(a.symbol, a.mirrored, a.transparent) for a in letters]
    out, n = "", 0
    while n < len(keys):
        period, times = _run(keys, n)
        base = "".join(names[n : n + period])
        out += f"({base})" if period > 1 else base
        out += str(times).translate(_SUPER) if times > 1 else ""
        n += period * times
    return out or "ε"


def _run(keys: Sequence[object], n: int) -> tuple[int, int]:
    """The repetition that begins at `n`: so many letters, so many times. Groups count from three times on."""
    best = (1, 1)
    for period in range(1, 7):
        base, times = keys[n : n + period], 1
        while len(base) == period and keys[n + period * times : n + period * (times + 1)] == base:
            times += 1
        if times >= (2 if period == 1 else 3) and period * times > best[0] * best[1]:
            best = (period, times)
    return best


_SUPER = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def table(caption: str, head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table in plain HTML."""
    cells = "".join(f"<th>{escape(text)}</th>" for text in head)
    body = "".join("<tr>" + "".join(f"<td>{escape(text)}</td>" for text in row) + "</tr>" for row in rows)
    return f"<table><caption>{escape(caption)}</caption><thead><tr>{cells}</tr></thead><tbody>{body}</tbody></table>"
