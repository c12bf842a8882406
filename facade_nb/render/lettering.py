"""Capitals as strokes, for signs: each letter on a grid four wide and six high.

A letter with accents is its plain letter, made lower or raised, and their strokes above and below it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import hypot
from types import MappingProxyType
from unicodedata import combining, normalize

from .parts import Prism

__all__ = ["LETTERS", "MARKS", "lettered", "undrawn"]

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
        "Æ": (
            "00 26 46",
            "26 20 40",
            "13 43",
        ),
        "Œ": (
            "46 16 05 01 10 40",
            "26 20",
            "23 43",
        ),
        "Ø": (
            "10 30 41 45 36 16 05 01 10",
            "00 46",
        ),
        "Ł": (
            "16 10 40",
            "02 24",
        ),
        "Đ": (
            "10 16 26 45 41 20 10",
            "03 23",
        ),
        "Ð": (
            "10 16 26 45 41 20 10",
            "03 23",
        ),
        "Ħ": (
            "00 06",
            "40 46",
            "03 43",
            "05 45",
        ),
        "Ŋ": ("00 06 40 46", "40 31"),
        "Þ": (
            "00 06",
            "05 35 44 42 31 01",
        ),
        "ẞ": ("00 05 16 36 45 24 33 42 41 30 20",),
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
        "–": ("03 43",),
        "—": ("03 43",),
        "_": ("00 40",),
        ".": ("20 21",),
        ",": ("21 10",),
        ":": (
            "21 22",
            "24 25",
        ),
        ";": (
            "21 10",
            "24 25",
        ),
        "!": (
            "26 22",
            "20 21",
        ),
        "?": (
            "05 16 36 45 44 23 22",
            "20 21",
        ),
        "¡": (
            "20 24",
            "25 26",
        ),
        "¿": (
            "41 30 10 01 02 23 24",
            "25 26",
        ),
        "«": (
            "24 13 22",
            "44 33 42",
        ),
        "»": (
            "04 13 02",
            "24 33 22",
        ),
        "'": ("25 26",),
        "’": ("26 14",),
        "‘": ("16 24",),
        '"': (
            "16 14",
            "36 34",
        ),
        "“": (
            "06 14",
            "26 34",
        ),
        "”": (
            "16 04",
            "36 24",
        ),
        "„": (
            "12 00",
            "32 20",
        ),
        "·": ("23 24",),
        "•": ("13 33 34 14 13",),
        "/": ("00 46",),
        "(": ("36 25 21 30",),
        ")": ("16 25 21 10",),
        "+": (
            "03 43",
            "21 25",
        ),
        "=": (
            "02 42",
            "04 44",
        ),
        "*": (
            "22 26",
            "03 45",
            "05 43",
        ),
        "#": (
            "10 16",
            "30 36",
            "02 42",
            "04 44",
        ),
        "%": (
            "00 46",
            "05 06 16 15 05",
            "30 31 41 40 30",
        ),
        "@": ("31 11 02 04 15 35 44 42 32 34 24 22 32",),
        "€": (
            "46 26 15 11 20 40",
            "03 33",
        ),
        "$": (
            "45 05 03 43 41 01",
            "20 26",
        ),
        "£": (
            "45 36 26 15 11 00 40",
            "03 33",
        ),
        "×": (
            "01 45",
            "05 41",
        ),
    }
)
"""Strokes of each letter: the corners of each line, x from 0 to 4 and then y from 0 to 6."""

MARKS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "\u0300": ("16 25",),
        "\u0301": ("25 36",),
        "\u0302": ("15 26 35",),
        "\u0303": ("05 16 35 46",),
        "\u0304": ("15 35",),
        "\u0306": ("16 25 36",),
        "\u0307": ("25 26",),
        "\u0308": (
            "16 15",
            "36 35",
        ),
        "\u030a": ("15 25 26 16 15",),
        "\u030b": (
            "15 26",
            "35 46",
        ),
        "\u030c": ("16 25 36",),
        "\u0323": ("20 21",),
        "\u0326": ("21 10",),
        "\u0327": ("21 30 10",),
        "\u0328": ("31 20 40",),
    }
)
"""Strokes of each accent, on the same grid: those above a letter from 5 to 6, those below it from 0 to 1."""

_ABOVE, _BELOW = 4.4, 1.4
"""How high a plain letter is under an accent, and how far up it begins over one."""


def undrawn(text: str) -> list[str]:
    """The letters of a text that there are no strokes for, each once: they would be blanks."""
    return list(dict.fromkeys(own for own in _capitals(text) if not own.isspace() and _strokes(own) is None))


def _capitals(text: str) -> list[str]:
    """A text in capitals, each with its accents."""
    letters: list[str] = []
    for own in normalize("NFC", text.replace("ß", "ẞ").upper()).strip():
        if combining(own) and letters:
            letters[-1] += own
        else:
            letters.append(own)
    return letters


Stroke = list[tuple[float, float]]


def _strokes(letter: str) -> list[Stroke] | None:
    """The strokes of one letter, with its accents; None where some are not known."""
    if letter in LETTERS:
        return [_points(line) for line in LETTERS[letter]]
    plain, *marks = tuple(normalize("NFD", letter))
    if plain not in LETTERS or not all(mark in MARKS for mark in marks) or not marks:
        return None
    lines = [_points(line) for mark in marks for line in MARKS[mark]]
    low = _BELOW if any(y < 2 for line in lines for _, y in line) else 0.0
    high = _ABOVE if any(y > 4 for line in lines for _, y in line) else 6.0
    letters = [[(x, low + y * (high - low) / 6) for x, y in _points(line)] for line in LETTERS[plain]]
    return letters + lines


def _points(line: str) -> Stroke:
    return [(int(a), int(b)) for a, b in map(tuple, line.split())]


def lettered(
    text: str, x0: float, y0: float, x1: float, y1: float, z0: float, z1: float, slot: str
) -> Iterator[Prism]:
    """A text in capitals, as large as fits in the middle of a rectangle; what `undrawn` tells of it are blanks."""
    drawn = [_strokes(letter) for letter in _capitals(text)]
    if not drawn:
        return
    columns = sum(4 if lines is None else 6 for lines in drawn) - 2
    unit = min((x1 - x0) / (columns + 1), (y1 - y0) / 7)
    x, y = (x0 + x1 - columns * unit) / 2, (y0 + y1) / 2 - 3 * unit
    for lines in drawn:
        for line in lines or ():
            for start, end in pairwise([(x + a * unit, y + b * unit) for a, b in line]):
                yield _stroke(start, end, 0.9 * unit, z0, z1, slot)
        x += (4 if lines is None else 6) * unit


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
