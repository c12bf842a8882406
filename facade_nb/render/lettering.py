"""Capitals as strokes, for signs: each letter on a grid four wide and six high."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import hypot
from types import MappingProxyType

from .parts import Prism

__all__ = ["LETTERS", "lettered"]

LETTERS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "A": (
            "00 26 40",
            "12 32",
        ),
        "B": (
            "00 06 36 45 44 33 03",
            "33 42 41 30 00",
        ),
        "C": ("45 36 16 05 01 10 30 41",),
        "D": ("00 06 26 45 41 20 00",),
        "E": (
            "46 06 00 40",
            "03 33",
        ),
        "F": (
            "46 06 00",
            "03 33",
        ),
        "G": ("45 36 16 05 01 10 30 41 43 23",),
        "H": (
            "00 06",
            "40 46",
            "03 43",
        ),
        "I": ("20 26",),
        "J": ("46 41 30 10 01",),
        "K": (
            "00 06",
            "46 02",
            "13 40",
        ),
        "L": ("06 00 40",),
        "M": ("00 06 22 46 40",),
        "N": ("00 06 40 46",),
        "O": ("10 30 41 45 36 16 05 01 10",),
        "P": ("00 06 36 45 44 33 03",),
        "Q": (
            "10 30 41 45 36 16 05 01 10",
            "22 40",
        ),
        "R": (
            "00 06 36 45 44 33 03",
            "23 40",
        ),
        "S": ("45 36 16 05 04 13 33 42 41 30 10 01",),
        "T": (
            "06 46",
            "26 20",
        ),
        "U": ("06 01 10 30 41 46",),
        "V": ("06 20 46",),
        "W": ("06 10 24 30 46",),
        "X": (
            "00 46",
            "06 40",
        ),
        "Y": (
            "06 23 46",
            "23 20",
        ),
        "Z": ("06 46 00 40",),
        "Ä": (
            "00 24 40",
            "11 31",
            "16 15",
            "36 35",
        ),
        "Ö": (
            "10 30 41 43 34 14 03 01 10",
            "16 15",
            "36 35",
        ),
        "Ü": (
            "04 01 10 30 41 44",
            "16 15",
            "36 35",
        ),
        "0": (
            "10 30 41 45 36 16 05 01 10",
            "13 33",
        ),
        "1": (
            "15 26 20",
            "10 30",
        ),
        "2": ("05 16 36 45 44 00 40",),
        "3": (
            "05 16 36 45 44 33 42 41 30 10 01",
            "13 33",
        ),
        "4": ("30 36 02 42",),
        "5": ("46 06 04 34 43 41 30 10 01",),
        "6": ("36 16 05 01 10 30 41 42 33 03",),
        "7": ("06 46 20",),
        "8": ("13 04 05 16 36 45 44 33 13 02 01 10 30 41 42 33",),
        "9": ("10 30 41 45 36 16 05 04 13 43",),
        "&": ("40 05 16 25 24 02 01 10 20 42",),
        "-": ("13 33",),
        ".": ("20 21",),
        "'": ("25 26",),
    }
)
"""Strokes of each letter: the corners of each line, x from 0 to 4 and then y from 0 to 6."""


def lettered(
    text: str, x0: float, y0: float, x1: float, y1: float, z0: float, z1: float, slot: str
) -> Iterator[Prism]:
    """A text in capitals, as large as fits in the middle of a rectangle; letters it lacks are blanks."""
    words = text.upper().strip()
    if not words:
        return
    columns = sum(6 if letter in LETTERS else 4 for letter in words) - 2
    unit = min((x1 - x0) / (columns + 1), (y1 - y0) / 7)
    x, y = (x0 + x1 - columns * unit) / 2, (y0 + y1) / 2 - 3 * unit
    for letter in words:
        for line in LETTERS.get(letter, ()):
            corners = [
                (x + int(a) * unit, y + int(b) * unit) for a, b in (tuple(spot) for spot in line.split())
            ]
            for start, end in pairwise(corners):
                yield _stroke(start, end, 0.9 * unit, z0, z1, slot)
        x += (6 if letter in LETTERS else 4) * unit


def _stroke(
    start: tuple[float, float], end: tuple[float, float], thick: float, z0: float, z1: float, slot: str
) -> Prism:
    (ax, ay), (bx, by) = start, end
    long = hypot(bx - ax, by - ay)
    ux, uy = (bx - ax) / long * thick / 2, (by - ay) / long * thick / 2
    corners = (
        (ax - ux + uy, ay - uy - ux), (bx + ux + uy, by + uy - ux),
        (bx + ux - uy, by + uy + ux), (ax - ux - uy, ay - uy + ux),
    )  # fmt: skip
    return Prism(corners, z0, z1, slot)
