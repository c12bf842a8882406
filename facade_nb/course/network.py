"""The alignment decision network of two words as a picture (the paper's Figure 8, the supplement's Figure 6)."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from itertools import pairwise

from ..solver.experiments import Case

__all__ = ["Drawn", "drawn", "nodes_of"]

_STEP, _LEFT, _TOP = 86, 70, 56
_LATTICE, _CLOSURE, _PATH = "#d9822b", "#4a86c8", "#d0312d"


class Drawn:
    """A picture that a notebook shows."""

    def __init__(self, svg: str, text: str) -> None:
        self.svg, self.text = svg, text

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return self.text


def nodes_of(path: str) -> list[tuple[int, int]]:
    """The nodes that an alignment of two words passes, by the letters read of each: ``"C/A | e/BAB | C/A"``."""
    at = (0, 0)
    nodes = [at]
    for column in path.split("|"):
        upper, lower = (own.replace(" ", "").replace("ε", "") for own in column.split("/"))
        at = (at[0] + len(upper), at[1] + len(lower))
        nodes.append(at)
    return nodes


def drawn(
    case: Case,
    *,
    at: tuple[int, int] | None = None,
    path: str = "",
    within: float | None = None,
) -> Drawn:
    """The network of two words: to the right the upper one is read, downwards the lower one.

    Parameters
    ----------
    at
        A node, by the letters read of both words: the edges that leave it are drawn, with ω (Eq. 9) where each leads.
    path
        An alignment, as in ``"C/A | e/BAB | C/A"``: its path is drawn.
    within
        Only edges with so small an ω are drawn from `at`.
    """
    if len(case.words) != 2:
        raise ValueError(f"drawn: expected two words, found {len(case.words)}")
    upper, lower = case.words
    n, m = len(upper), len(lower)
    out = [_lattice(n, m)]
    for i, letter in enumerate(upper):
        out.append(_text(_x(i) + _STEP / 2, 24, str(letter), f"{letter.size:g} m" if letter.size else ""))
    for j, letter in enumerate(lower):
        out.append(_text(26, _y(j) + _STEP / 2 - 6, str(letter), f"{letter.size:g} m" if letter.size else ""))
    told: list[str] = []
    if at is not None:
        across = _sums([a.size or 0.0 for a in upper[at[0] :]])
        down = _sums([a.size or 0.0 for a in lower[at[1] :]])
        lines, labels = [], []
        for i, a in enumerate(across):
            for j, b in enumerate(down):
                omega = 0.0 if not i or not j else abs(a - b)
                if (not i and not j) or (within is not None and omega > within + 1e-9):
                    continue
                to = (at[0] + i, at[1] + j)
                bold = within is not None
                lines.append(_line(at, to, _CLOSURE, 2.0 if bold else 1.0, "" if bold else "opacity='0.55'"))
                labels.append(_label(to, f"{omega:.3g}"))
                told.append(f"{to}: {omega:.3g}")
        out += [*lines, *labels]
    if path:
        nodes = nodes_of(path)
        if nodes[-1] != (n, m):
            raise ValueError(f"drawn: {path!r} reads {nodes[-1]} letters; the words have {(n, m)}")
        out += [_line(a, b, _PATH, 4.0) for a, b in pairwise(nodes)]
        told.append(f"path {nodes}")
    for i in range(n + 1):
        for j in range(m + 1):
            marked = at == (i, j)
            out.append(
                f"<circle cx='{_x(i)}' cy='{_y(j)}' r='{8 if marked else 5}' fill='{_PATH if marked else '#888'}'/>"
            )
    wide, high = _x(n) + 60, _y(m) + 36
    words = " and ".join("".join(map(str, word)) for word in case.words)
    svg = (
        f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {wide} {high}' width='{wide}' role='img' "
        f"aria-label='The network of {escape(words)}' style='background: white; max-width: 100%; height: auto'>"
        f"<g font-family='sans-serif' font-size='15' text-anchor='middle' fill='#222'>{''.join(out)}</g></svg>"
    )
    return Drawn(svg, f"The network of {words}: {(n + 1) * (m + 1)} nodes. " + "; ".join(told))


def _sums(sizes: Sequence[float]) -> list[float]:
    total, out = 0.0, [0.0]
    for size in sizes:
        total += size
        out.append(total)
    return out


def _x(i: int) -> int:
    return _LEFT + i * _STEP


def _y(j: int) -> int:
    return _TOP + j * (_STEP - 14)


def _lattice(n: int, m: int) -> str:
    across = [_line((i, j), (i + 1, j), _LATTICE, 1.5) for i in range(n) for j in range(m + 1)]
    down = [_line((i, j), (i, j + 1), _LATTICE, 1.5) for i in range(n + 1) for j in range(m)]
    return "".join(across + down)


def _line(a: tuple[int, int], b: tuple[int, int], colour: str, width: float, more: str = "") -> str:
    """A line from node to node; one along a row or column of nodes is bent, so that it is seen beside others."""
    (x0, y0), (x1, y1) = (_x(a[0]), _y(a[1])), (_x(b[0]), _y(b[1]))
    bend = 0
    if (a[0] == b[0] and abs(a[1] - b[1]) > 1) or (a[1] == b[1] and abs(a[0] - b[0]) > 1):
        bend = 20
    flat = a[1] == b[1]
    mid = ((x0 + x1) / 2 + (0 if flat else bend), (y0 + y1) / 2 - (bend if flat else 0))
    return (
        f"<path d='M{x0} {y0} Q{mid[0]:g} {mid[1]:g} {x1} {y1}' fill='none' stroke='{colour}' "
        f"stroke-width='{width:g}' {more}/>"
    )


def _text(x: float, y: float, letter: str, size: str) -> str:
    return (
        f"<text x='{x:g}' y='{y:g}' font-weight='bold'>{escape(letter)}</text>"
        f"<text x='{x:g}' y='{y + 16:g}' font-size='11'>{size}</text>"
    )


def _label(node: tuple[int, int], text: str) -> str:
    x, y = _x(node[0]) + 13, _y(node[1]) - 9
    return (
        f"<rect x='{x - 13}' y='{y - 12}' width='{26}' height='16' rx='3' fill='white' opacity='0.85'/>"
        f"<text x='{x}' y='{y}' font-size='13' fill='#1d4e89'>{text}</text>"
    )
