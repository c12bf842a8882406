"""Sizing and placement: one least-squares problem for an axis, all groups together (the paper's 5.3,
supplement 3.4, 3.5).

Variables are the size z of every symbol, every boundary between columns, and every boundary between letters
inside an element. Stitched letters and columns share a boundary, which is how the paper's stitching
constraints are kept; what remains are the rows named here: a letter's two bounds are its symbol's size
apart, pieces of a cut letter add up to it, the gaps γ around a non-opaque element are equal in pairs, and a
substituted symbol that is left standing elsewhere has the extent of its content.

Two rounds: the first minimises Σ (z − preferred)² over the sized symbols, which fixes their sizes (the
objective is strictly convex in them); the second, with those sizes kept, brings unsized symbols and pieces
as near as can be to their sizes in the alignment.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np

from ..design.model import Symbol
from .columns import Group
from .letters import Letter
from .pricing import Priced
from .qp import FREE, Solution, least_squares

__all__ = ["Placement", "Sized", "System", "size_axis"]

Placement = tuple[tuple[tuple[tuple[float, float], ...], ...], ...]
"""Per column, per band: the intervals of the letters and pieces in it."""


@dataclass(frozen=True, slots=True)
class System:
    """The least-squares system as it was posed.

    Attributes
    ----------
    variables
        Names: ``|A|`` the size of a symbol, ``g:j`` the right edge of column j of group g, ``g:ijk.t`` the
        upper bound of letter k of row i in column j, ``g:ijk.s`` its lower bound where a gap parts it from
        the column's edge.
    rows
        Names of the equations and inequalities, then the matrix with its bounds.
    """

    variables: tuple[str, ...]
    rows: tuple[str, ...]
    matrix: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    weight: np.ndarray
    target: np.ndarray


@dataclass(frozen=True, slots=True)
class Sized:
    """The solved axis.

    Attributes
    ----------
    sizes
        Solved size of each symbol in use.
    boundaries
        Per group: every column boundary, 0 first, the canvas last.
    placements
        Per group: `Placement`.
    deviation
        √Σ (z − preferred)², metres.
    """

    sizes: Mapping[str, float]
    boundaries: tuple[tuple[float, ...], ...]
    placements: tuple[Placement, ...]
    deviation: float
    system: System
    solution: Solution


class _Builder:
    """Variables and rows, as they are met."""

    def __init__(self, canvas: float, symbol: Callable[[str], Symbol], least: float) -> None:
        self.canvas, self.symbol, self.least = canvas, symbol, least
        self.names: list[str] = []
        self.low: list[float] = []
        self.high: list[float] = []
        self.target: list[float] = []
        self.weight: list[float] = []
        self.pull: list[float] = []
        self.row_names: list[str] = []
        self.terms: list[dict[int, float]] = []
        self.row_low: list[float] = []
        self.row_high: list[float] = []
        self.size_of: dict[str, int] = {}
        self.extents: dict[tuple[int, int, int, str, int], dict[int, float]] = {}

    def variable(
        self, name: str, low: float, high: float, target: float, weight: float = 0.0, pull: float = 0.0
    ) -> int:
        self.names.append(name)
        self.low.append(low)
        self.high.append(high)
        self.target.append(target)
        self.weight.append(weight)
        self.pull.append(pull)
        return len(self.names) - 1

    def row(self, name: str, terms: Mapping[int, float], low: float, high: float) -> None:
        self.row_names.append(name)
        self.terms.append({v: c for v, c in terms.items() if c})
        self.row_low.append(low)
        self.row_high.append(high)

    def size(self, name: str, aligned: float) -> int:
        """The size variable of a symbol; an unsized one is drawn towards its size in the alignment."""
        v = self.size_of.get(name)
        if v is None:
            own = self.symbol(name)
            low, high = max(self.least, own.min or 0.0), FREE if own.max is None else own.max
            sized = own.size is not None
            target = aligned if own.size is None else own.size
            v = self.variable(f"|{name}|", low, high, target, 1.0 if sized else 0.0, 0.0 if sized else 1.0)
            self.size_of[name] = v
        return v


def size_axis(
    groups: Sequence[Group],
    parts: Sequence[tuple[Priced, int]],
    canvas: float,
    symbol: Callable[[str], Symbol],
) -> Sized | None:
    """Size and place every letter of an axis.

    Parameters
    ----------
    groups
        All alignment groups of the axis.
    parts
        Per group: the priced structure that aligns it, and the group's number there.
    canvas
        Extent in metres.
    symbol
        Symbols by name.

    Returns
    -------
    The sized axis, or None where the constraints contradict each other.
    """
    letters = sum(len(band.letters) + 1 for group in groups for band in group.bands)
    build = _Builder(canvas, symbol, min(1e-3, 0.01 * canvas / max(1, letters)))
    edges: list[list[int]] = []
    bounds: list[list[list[list[tuple[int, int]]]]] = []
    for g, (group, (priced, k)) in enumerate(zip(groups, parts, strict=True)):
        edges.append(_edges(build, g, priced, k))
        bounds.append(_letters(build, g, group, priced, k, edges[g]))
    for (_, _, _, name, _), terms in build.extents.items():
        z = build.size_of.get(name)
        if z is not None:
            build.row(f"extent of {name} = |{name}|", {**terms, z: terms.get(z, 0.0) - 1.0}, 0.0, 0.0)
    system = _system(build)
    first = least_squares(system.weight, system.target, system.matrix, system.lower, system.upper)
    if first is None:
        return None
    x = _settle(system, np.array(build.pull), first.x)
    at = np.clip(
        x, system.lower[: x.size], system.upper[: x.size]
    ).tolist()  # the ends are 0 and the canvas exactly
    return Sized(
        {name: at[v] for name, v in build.size_of.items()},
        tuple(tuple(at[v] for v in own) for own in edges),
        tuple(
            tuple(tuple(tuple((at[s], at[t]) for s, t in element) for element in column) for column in own)
            for own in bounds
        ),
        sqrt(float(np.sum(system.weight * (first.x - system.target) ** 2))),
        system,
        first,
    )


def _system(build: _Builder) -> System:
    matrix = np.zeros((len(build.terms), len(build.names)))
    for r, terms in enumerate(build.terms):
        for v, coefficient in terms.items():
            matrix[r, v] = coefficient
    return System(
        tuple(build.names),
        tuple(build.row_names),
        matrix,
        np.array([*build.low, *build.row_low]),
        np.array([*build.high, *build.row_high]),
        np.array(build.weight),
        np.array(build.target),
    )


def _settle(system: System, pull: np.ndarray, x: np.ndarray) -> np.ndarray:
    """The second round: sized symbols keep their sizes, the rest comes near to the alignment."""
    n = x.size
    kept = system.weight > 0
    lower, upper = system.lower.copy(), system.upper.copy()
    lower[:n][kept] = upper[:n][kept] = x[kept]
    second = least_squares(np.maximum(pull, 1e-6), system.target, system.matrix, lower, upper, tolerance=1e-9)
    return x if second is None else second.x


def _edges(build: _Builder, g: int, priced: Priced, k: int) -> list[int]:
    """Column boundaries, from 0 to the canvas."""
    widths = [max(sum(own) for own in column) for column in priced.pieces[k]]
    total = sum(widths)
    scale = build.canvas / total if total > 0 else 1.0
    at = 0.0
    out = [build.variable(f"{g}:0", 0.0, 0.0, 0.0)]
    for j, width in enumerate(widths):
        at += width * scale
        last = j == len(widths) - 1
        low, high = (build.canvas, build.canvas) if last else (0.0, build.canvas)
        out.append(build.variable(f"{g}:{j + 1}", low, high, at))
        build.row(f"{g}:{j} < {g}:{j + 1}", {out[-1]: 1.0, out[-2]: -1.0}, build.least, FREE)
    return out


def _letters(
    build: _Builder, g: int, group: Group, priced: Priced, k: int, edges: Sequence[int]
) -> list[list[list[tuple[int, int]]]]:
    """The bounds of every letter and piece of a group, per column and band, with the rows they must keep."""
    structure, pieces = priced.structure[k], priced.pieces[k]
    placed: list[list[list[tuple[int, int]]]] = [[[] for _ in group.bands] for _ in structure]
    for row, band in enumerate(group.bands):
        stands: dict[int, list[tuple[str, int, int, float]]] = {}
        for j, column in enumerate(structure):
            option = column[row]
            if option.empty:
                continue
            names = [f"{g}:{row}-{j}-{i}" for i in range(len(option.letters))]
            start, end = edges[j], edges[j + 1]
            if option.soft:
                start, end = _gaps(build, names, [band.letters[i] for i in option.letters], start, end)
            at = start
            for i, (letter, size) in enumerate(zip(option.letters, pieces[j][row], strict=True)):
                last = i == len(option.letters) - 1
                to = end if last else build.variable(f"{names[i]}.t", 0.0, build.canvas, 0.0)
                placed[j][row].append((at, to))
                stands.setdefault(letter, []).append((names[i], at, to, size))
                for n, origins in enumerate(
                    band.origins
                ):  # equal words may owe their letters to other contents
                    origin = origins[letter]
                    if origin is not None:  # the extent of a content takes in the gaps beside it
                        left, right = edges[j] if i == 0 else at, edges[j + 1] if last else to
                        extent = build.extents.setdefault((g, row, n, *origin), {})
                        extent[right] = extent.get(right, 0.0) + 1.0
                        extent[left] = extent.get(left, 0.0) - 1.0
                at = to
        for letter, own in stands.items():
            symbol = band.letters[letter].symbol
            z = build.size(symbol, sum(size for *_, size in own))
            total: dict[int, float] = {z: -1.0}
            for name, s, t, _ in own:
                total[t] = total.get(t, 0.0) + 1.0
                total[s] = total.get(s, 0.0) - 1.0
                if len(own) > 1:
                    build.row(f"{name}.s < {name}.t", {t: 1.0, s: -1.0}, build.least, FREE)
            build.row(" + ".join(name for name, *_ in own) + f" = |{symbol}|", total, 0.0, 0.0)
    return placed


def _gaps(
    build: _Builder, names: Sequence[str], letters: Sequence[Letter], start: int, end: int
) -> tuple[int, int]:
    """Put gap letters γ around an element with a non-opaque letter; the first such letter says how it is placed."""
    soft = next(letter for letter in letters if not letter.opaque)
    placement = build.symbol(soft.symbol).placement
    if soft.mirrored and placement != "center":
        placement = "right" if placement == "left" else "left"
    s, t = start, end
    if placement != "left":
        s = build.variable(f"{names[0]}.s", 0.0, build.canvas, build.target[start])
        build.row(f"{names[0]}: gap before ≥ 0", {s: 1.0, start: -1.0}, 0.0, FREE)
    if placement != "right":
        t = build.variable(f"{names[-1]}.t", 0.0, build.canvas, build.target[end])
        build.row(f"{names[-1]}: gap after ≥ 0", {end: 1.0, t: -1.0}, 0.0, FREE)
    if placement == "center":
        build.row(f"{names[0]}: gaps equal", {s: 1.0, start: -1.0, end: -1.0, t: 1.0}, 0.0, 0.0)
    return s, t
