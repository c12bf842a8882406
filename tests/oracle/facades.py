"""Surveys of façades that never were, by seed: what inference is measured on besides real ones."""

from __future__ import annotations

from random import Random
from typing import Any

__all__ = ["random_facade"]

Row = list[tuple[float, float, str]]
"""Left, width and kind of each opening of a storey."""


def random_facade(seed: int) -> tuple[list[dict[str, Any]], float, float]:
    """Openings, width and height of a façade: 3 to 12 bays, 2 to 6 storeys, of one of several characters.

    Regular bays, pairs of windows, wide and narrow ones in turn, a stair with its own rhythm; doors in the middle or at
    an end, shops that do not line up, dormers, lower attics, windows bricked up, an odd one; measured to a centimetre,
    with some centimetres of error.
    """
    random = Random(seed)
    character = random.choice(["regular", "pairs", "alternating", "stair", "three"])
    bays = random.randint(3, 10)
    window = random.choice([0.9, 1.0, 1.1, 1.3])
    wall = random.uniform(0.7, 1.9)
    margin = random.uniform(0.5, 2.0)
    upper, width = _storey(random, character, bays, window, wall, margin)
    storeys = random.randint(1, 5)
    rise = random.uniform(2.8, 3.6)
    tall = random.uniform(1.3, 1.9)
    base = random.uniform(3.2, 4.2)
    rects: list[tuple[float, float, float, float, str]] = []
    for floor in range(storeys):
        high = tall * (0.7 if floor == storeys - 1 and storeys > 2 and random.random() < 0.25 else 1.0)
        sill = base + floor * rise + 0.8
        rects += [(left, sill, left + wide, sill + high, kind) for left, wide, kind in upper]
    missing = random.choice([0, 0, 0, 1, 2])
    for _ in range(min(missing, len(rects) - 2)):
        rects.pop(random.randrange(len(rects)))
    rects += _ground(random, upper, width, window)
    top = base + storeys * rise + 0.6
    if random.random() < 0.35:
        count = random.randint(2, max(2, bays // 2))
        pitch = width / count
        rects += [
            (pitch * (i + 0.5) - 0.5, top + 0.4, pitch * (i + 0.5) + 0.5, top + 1.5, "window")
            for i in range(count)
        ]
        top += 2.2
    if random.random() < 0.2:
        rects.append((0.06, 1.6, 0.42, 2.2, "window"))
    error = random.choice([0.0, 0.01, 0.02, 0.03])
    openings = []
    for left, bottom, right, high, kind in rects:
        x, y = random.gauss(0, error), random.gauss(0, error)
        rect = [
            left + x,
            bottom + y,
            right + x + random.gauss(0, error / 2),
            high + y + random.gauss(0, error / 2),
        ]
        rect = [max(0.0, rect[0]), max(0.0, rect[1]), min(width, rect[2]), rect[3]]
        openings.append({"kind": kind, "rect": [round(v, 2) for v in rect]})
    random.shuffle(openings)
    return openings, round(width, 2), round(top, 2)


def _storey(
    random: Random, character: str, bays: int, window: float, wall: float, margin: float
) -> tuple[Row, float]:
    """The windows of an upper storey, and the façade's width."""
    gaps = [wall] * (bays - 1)
    widths = [window] * bays
    if character == "pairs":
        gaps = [0.3 if i % 2 == 0 else wall + 0.5 for i in range(bays - 1)]
    elif character == "alternating":
        widths = [window * (1.6 if i % 2 else 1.0) for i in range(bays)]
    elif character == "three" and bays > 4:
        side = bays // 3
        gaps = [wall * (1.8 if i in (side - 1, bays - side - 1) else 1.0) for i in range(bays - 1)]
    elif character == "stair":
        middle = bays // 2
        widths[middle] = window * 0.6
        gaps[middle - 1] += 0.7
        gaps[min(middle, bays - 2)] += 0.4
    row: Row = []
    left = margin
    for i, wide in enumerate(widths):
        row.append((left, wide, "window"))
        left += wide + (gaps[i] if i < len(gaps) else margin)
    return row, left


def _ground(
    random: Random, upper: Row, width: float, window: float
) -> list[tuple[float, float, float, float, str]]:
    """The openings of the ground floor."""
    manner = random.choice(["aligned", "aligned", "shops", "middle", "garage"])
    found: list[tuple[float, float, float, float, str]] = []
    if manner == "shops":
        count = max(2, round(width / 4.5))
        pitch = (width - 0.6) / count
        door = random.randrange(count)
        for i in range(count):
            left = 0.3 + i * pitch + 0.25
            if i == door:
                found.append((left + 0.2, 0.0, left + 1.4, 2.5, "door"))
            else:
                found.append((left, 0.5, left + pitch - 0.5, 2.7, "window"))
        return found
    door = len(upper) // 2 if manner == "middle" else random.choice([0, len(upper) - 1])
    wide = 2.6 if manner == "garage" else random.choice([1.1, window])
    for i, (left, own, _) in enumerate(upper):
        middle = left + own / 2
        if i == door:
            low = min(max(0.1, middle - wide / 2), width - 0.1 - wide)
            found.append((low, 0.0, low + wide, 2.4, "door"))
        else:
            found.append((left, 0.9, left + own, 2.3, "window"))
    clear = next(rect for rect in found if rect[4] == "door")
    return [r for r in found if r is clear or r[2] < clear[0] - 0.15 or r[0] > clear[2] + 0.15]
