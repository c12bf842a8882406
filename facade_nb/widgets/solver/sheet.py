"""Small drawings for the static forms: SVG in the colours of the front end's views, as images in HTML."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Sequence
from html import escape

from ...design.text import spell
from ...render.style import num
from ...solver.events import LetterNote

__all__ = ["ARC", "HUES", "INK", "MUTED", "PAPER", "PATH", "STEP", "Sheet", "shortened", "spelled", "table"]

HUES = (
    "#d9b48f", "#8fb8d8", "#b9cf8c", "#e3a1a1", "#b7a8d8", "#8ecfc0", "#ead27a", "#c9c4bb", "#e2b0d2", "#a3b1bd",
)  # fmt: skip
"""Colours of symbols on light paper, as styles/solver.css has them."""
INK, MUTED, PAPER = "#23201c", "#6f6a62", "#fbfaf6"
ACCENT, SECOND, GOOD, BAD = "#c2410c", "#0b6e99", "#388e3c", "#d32f2f"
STEP, ARC, PATH = "#e08a1e", "#2f6fb2", "#d0202c"
"""Colours of the paper's Figure 8: steps of the automaton, arcs of its closure, the path."""
_SANS, _MONO = (
    "system-ui, 'Segoe UI', Helvetica, Arial, sans-serif",
    "Menlo, Consolas, 'DejaVu Sans Mono', monospace",
)


_STYLE = (
    f"text{{font-family:{_SANS}}}.m{{font-family:{_MONO}}}.b{{font-weight:600}}.am{{text-anchor:middle}}"
    f".n{{font-size:11px;text-anchor:middle;fill:{INK}}}.q{{fill:{MUTED}}}"
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

    def arc(
        self, x0: float, y0: float, x1: float, y1: float, *, stroke: str, width: float = 1.0
    ) -> tuple[float, float]:
        """Draw a bent line; gives its middle."""
        dx, dy = x1 - x0, y1 - y0
        bend = 0.16 if not dx or not dy else 0.09
        x, y = (x0 + x1) / 2 + dy * bend, (y0 + y1) / 2 - dx * bend
        self._parts.append(
            f'<path d="M{num(x0)} {num(y0)}Q{num(x)} {num(y)} {num(x1)} {num(y1)}" fill="none" stroke="{stroke}" '
            f'stroke-width="{num(width)}"/>'
        )
        return (x0 + 2 * x + x1) / 4, (y0 + 2 * y + y1) / 4

    def boxes(self, rects: Iterable[tuple[float, float, float, float]], hue: int) -> None:
        """Draw many rectangles of one colour: x, y, width and height of each."""
        path = "".join(f"M{x:.1f} {y:.1f}h{w:.1f}v{h:.1f}h-{w:.1f}z" for x, y, w, h in rects)
        self._parts.append(f'<path class="h{hue % len(HUES)}" stroke-width=".4" d="{path}"/>')

    def arrow(self, x0: float, x1: float, y: float, *, stroke: str, upright: bool = False) -> None:
        """Draw an arrow from x0 to x1 at y; upright from y to y, at x."""
        back = 3.0 if x1 > x0 else -3.0
        points = ((x0, y), (x1, y), (x1 - back, y - 3), (x1, y), (x1 - back, y + 3))
        tail, tip, *head = (f"{num(b)} {num(a)}" if upright else f"{num(a)} {num(b)}" for a, b in points)
        self._parts.append(
            f'<path d="M{tail}L{tip}M{"L".join(head)}" fill="none" stroke="{stroke}" stroke-width="1.6"/>'
        )

    def rule(self, x0: float, x1: float, y: float, *, stroke: str, upright: bool = False) -> None:
        """Draw a line from x0 to x1 at y; upright from y to y, at x."""
        self.line(*((y, x0, y, x1) if upright else (x0, y, x1, y)), stroke=stroke)

    def dot(self, x: float, y: float, r: float, *, stroke: str = INK) -> None:
        """Draw a small circle."""
        self._parts.append(
            f'<circle cx="{num(x)}" cy="{num(y)}" r="{num(r)}" fill="{PAPER}" stroke="{stroke}"/>'
        )

    def labels(self, cells: Iterable[tuple[float, float, str]], y: float, *, muted: bool = False) -> float:
        """Write texts between two x each; those that have no room stand on a second line. Gives the last line's y."""
        last, end = y, -1e9
        for x0, x1, text in cells:
            half, middle = 3.4 * len(text), (x0 + x1) / 2
            if x1 - x0 < 2 * half:
                if middle - half < end + 3:
                    continue
                end, last = middle + half, y + 13
            at = y if x1 - x0 >= 2 * half else y + 13
            look = "n q" if muted else "n"
            self._parts.append(f'<text class="{look}" x="{num(middle)}" y="{num(at)}">{escape(text)}</text>')
        return last

    def node(self, x: float, y: float, w: float, h: float, lines: Sequence[str]) -> None:
        """Draw a box around a point, with lines of text in it."""
        self._parts.append(
            f'<rect x="{num(x - w / 2)}" y="{num(y - h / 2)}" width="{num(w)}" height="{num(h)}" rx="4" '
            f'fill="{PAPER}" stroke="{INK}"/>'
        )
        for n, line in enumerate(lines):
            at = y + 4 + 13 * (n - (len(lines) - 1) / 2)
            self.text(x, at, line, size=11, anchor="middle", mono=True)

    def badge(self, x: float, y: float, text: str, *, stroke: str) -> None:
        """Draw a short text on a line that it is about."""
        w = 7 * len(text) + 8
        self._parts.append(
            f'<rect x="{num(x - w / 2)}" y="{num(y - 8)}" width="{num(w)}" height="16" rx="8" fill="{PAPER}" '
            f'stroke="{stroke}"/>'
        )
        self.text(x, y + 4, text, size=11, fill=stroke, anchor="middle", mono=True)

    def letter(
        self, x: float, y: float, w: float, h: float, letter: LetterNote, hue: int, *, free: bool = False,
        dim: bool = False, named: bool = True,
    ) -> None:  # fmt: skip
        """Draw a letter: solid, dashed where it is transparent, and without a fill where its size is free."""
        look = "g" if letter.transparent or free else f"h{hue % len(HUES)}"
        self._parts.append(
            f'<rect class="{look}{" d" if dim else ""}" x="{num(x)}" y="{num(y)}" width="{num(w)}" height="{num(h)}"/>'
        )
        if named and w >= 8 * len(letter.symbol):
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


def shortened(text: str, most: int) -> str:
    """A text of at most so many signs."""
    return text if len(text) <= most else f"{text[: most - 1]}…"


def spelled(letters: Sequence[LetterNote]) -> str:
    """A word in short, as the front end writes it: ``A²C``, ``G(AB)³A``, a dash behind mirrored letters."""
    names = [
        (a.symbol if spell(a.symbol) == a.symbol else f"⟨{a.symbol}⟩") + "′" * a.mirrored for a in letters
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
