"""Room walls, floors and ceilings. Walls and ceilings are fitted to a room, and darken softly towards its corners."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .canvas import Canvas, paint, randoms, smooth
from .joinery import boxed, field_panel
from .masonry import courses

__all__ = [
    "bookshelves",
    "carpet",
    "ceiling",
    "corners",
    "herringbone",
    "office_ceiling",
    "painted",
    "papered",
    "stone_floor",
    "with_door",
    "with_window",
]


def corners(canvas: Canvas, strength: float = 0.34, reach: float = 0.55) -> None:
    """Darken towards all four edges, where walls meet and the light of the window comes less."""
    shade = np.ones_like(canvas.alpha)
    for away in (canvas.x, canvas.width - canvas.x, canvas.y, canvas.tall - canvas.y):
        shade = shade * (1 - strength * np.exp(-np.maximum(away, 0) / reach * 2.2))
    canvas.shade(shade.astype(np.float32))


def _skirting(canvas: Canvas, colour: str, high: float = 0.14) -> None:
    canvas.slab(-1, 0, canvas.width + 1, high, colour, 0.02, edge=0.01, fall=0.01, gloss=0.2)


def _picture(
    canvas: Canvas, pane: tuple[float, float, float, float], seed: int, frame: str, tones: Sequence[str]
) -> None:
    """A framed picture of hills, which at this size is all one can tell."""
    left, _, right, _ = pane
    inner = boxed(canvas, pane, frame, 0.03, 0.035, gloss=0.4)
    canvas.lay(canvas.box(*inner), "#ece7da", height=0.012)
    mat = 0.12 * (right - left)
    view = (inner[0] + mat, inner[1] + mat, inner[2] - mat, inner[3] - mat)
    box = canvas.box(*view)
    canvas.lay(box, tones[0])
    for k, tone in enumerate(tones[1:]):
        ridge = view[1] + (view[3] - view[1]) * (
            0.6 - 0.24 * k + 0.09 * np.sin((canvas.x - left) * (5 + 2 * k) + seed + 2 * k)
        )
        canvas.lay(box * canvas.cover((canvas.y - ridge).astype(np.float32)), tone)


def painted(canvas: Canvas, seed: int, colour: str, *, pictures: int = 0, rail: bool = True) -> None:
    """A painted wall with skirting board and picture rail, and pictures where wanted."""
    cloud = 1 + 0.012 * canvas.noise(0.9, seed, 2)
    canvas.lay(canvas.full(), np.clip(paint(colour) * cloud[..., None], 0, 1), gloss=0.05)
    if rail:
        canvas.slab(-1, canvas.tall - 0.32, canvas.width + 1, canvas.tall, "#ebe7dd", 0.0)
        canvas.slab(
            -1,
            canvas.tall - 0.36,
            canvas.width + 1,
            canvas.tall - 0.32,
            "#e9e4d8",
            0.03,
            edge=0.012,
            fall=0.02,
        )
    _skirting(canvas, "#ebe7dd")
    if pictures:
        tones = (
            ("#d8cdb4", "#93a08f", "#5f6f66"),
            ("#c8d1d3", "#7f95a0", "#495d68"),
            ("#e0c9a8", "#b98d67", "#7b5a45"),
        )
        width = 0.62
        for k in range(pictures):
            x = canvas.width * (k + 1) / (pictures + 1) + 0.1 * (k % 2)
            high = 0.8 if k % 2 == 0 else 0.5
            _picture(
                canvas,
                (x - width / 2, 1.68 - high / 2, x + width / 2, 1.68 + high / 2),
                seed + k,
                ("#3a322a", "#a88f5c")[k % 2],
                tones[k % 3],
            )
    corners(canvas)


def papered(
    canvas: Canvas, seed: int, colours: tuple[str, str], *, dado: str = "#e8e3d6", panels: int = 5
) -> None:
    """Striped wallpaper above a panelled dado."""
    stripes = 28
    u = canvas.x / canvas.width * stripes
    band = smooth(-0.2, 0.2, np.sin(2 * np.pi * u) + 0 * canvas.y)
    fine = 0.35 * np.exp(-((((u % 1) - 0.25) / 0.06) ** 2))
    low, high = paint(colours[0]), paint(colours[1])
    canvas.lay(canvas.full(), low + (high - low) * (band - fine)[..., None].clip(0, 1), gloss=0.06)
    top = 0.95
    canvas.slab(-1, 0, canvas.width + 1, top, dado, 0.01, gloss=0.2)
    pitch = canvas.width / panels
    for k in range(panels):
        field_panel(
            canvas, (k * pitch + 0.08, 0.24, (k + 1) * pitch - 0.08, top - 0.1), dado, 0.01, gloss=0.2
        )
    canvas.slab(-1, top - 0.02, canvas.width + 1, top + 0.035, dado, 0.045, edge=0.015, fall=0.02, gloss=0.2)
    canvas.slab(-1, canvas.tall - 0.16, canvas.width + 1, canvas.tall, "#efebe1", 0.05, edge=0.06, fall=0.06)
    _skirting(canvas, dado, 0.17)
    corners(canvas)


def bookshelves(canvas: Canvas, seed: int, *, wood: str = "#6b5138") -> None:
    """A wall of books from side to side."""
    canvas.lay(canvas.full(), "#c9bda6")
    canvas.slab(-1, 0, canvas.width + 1, canvas.tall - 0.22, wood, 0.0, gloss=0.2)
    bays, rows = 4, 6
    w, h = canvas.width / bays, (canvas.tall - 0.22 - 0.12) / rows
    spines = (
        "#7d3a32",
        "#3f5a5e",
        "#b89a62",
        "#4b4a57",
        "#8a6b4c",
        "#c8bda4",
        "#5c6b4e",
        "#92806d",
        "#2f3b46",
        "#a85f45",
    )
    table = np.stack([paint(s) for s in spines])
    for bay in range(bays):
        for row in range(rows):
            left, bottom = bay * w + 0.03, 0.12 + row * h
            canvas.lay(canvas.box(left, bottom, left + w - 0.06, bottom + h - 0.03), "#33261b", height=-0.2)
            thick = 0.022 + 0.035 * randoms(seed + bay * 31 + row * 7, 60)
            cuts = left + np.concatenate([[0.0], np.cumsum(thick)])
            place = np.clip(np.searchsorted(cuts, canvas.x[0]) - 1, 0, 59)
            tall = (0.6 + 0.32 * randoms(seed + bay * 57 + row * 3, 60)) * (h - 0.03)
            pick = (randoms(seed + bay * 17 + row * 5, 60) * len(spines)).astype(int)
            end = left + (w - 0.06) * (0.72 + 0.28 * float(randoms(seed + bay + 9 * row, 1)[0]))
            cover = np.clip((bottom + tall[place][None, :] - canvas.y) / canvas.dy + 0.5, 0, 1) * canvas.box(
                left, bottom, end, bottom + h
            )
            rim = np.minimum(canvas.x[0] - cuts[place], cuts[place + 1] - canvas.x[0])
            rounded = np.sqrt(np.clip(rim / 0.012, 0, 1))[None, :]
            colour = (
                table[pick][place][None] * (0.72 + 0.28 * rounded)[..., None] * np.ones_like(canvas.colour)
            )
            band = np.abs((canvas.y - bottom) / np.maximum(tall[place][None, :], 0.01) - 0.78) < 0.03
            colour = np.where(
                (band & (place % 3 == 0)[None, :])[..., None], colour * 0.6 + 0.35 * paint("#c9a75c"), colour
            )
            canvas.lay(cover.astype(np.float32), np.clip(colour, 0, 1), height=-0.04)
    _skirting(canvas, wood, 0.12)
    canvas.slab(
        -1,
        canvas.tall - 0.26,
        canvas.width + 1,
        canvas.tall - 0.2,
        wood,
        0.04,
        edge=0.015,
        fall=0.02,
        gloss=0.2,
    )
    corners(canvas, 0.3)


def with_door(canvas: Canvas, seed: int, colour: str) -> None:
    """A painted wall with a white door in it."""
    painted(canvas, seed, colour, rail=False)
    left = 0.58 * canvas.width
    for grow, high in ((0.11, 0.03), (0.05, 0.02)):
        canvas.slab(
            left - grow, 0, left + 0.85 + grow, 2.08 + grow, "#efebe1", high, edge=0.01, fall=0.012, gloss=0.2
        )
    canvas.slab(left, 0, left + 0.85, 2.08, "#e9e4d8", -0.02, gloss=0.2)
    for low, high in ((0.14, 0.85), (1.0, 1.95)):
        field_panel(canvas, (left + 0.12, low, left + 0.73, high), "#e9e4d8", -0.02)
    canvas.lay(
        canvas.cover(canvas.disc_distance(left + 0.07, 1.03, 0.028)), "#a58a54", height=0.04, gloss=0.8
    )


def herringbone(canvas: Canvas, seed: int, woods: Sequence[str], *, count: int = 4) -> None:
    """Herringbone parquet, its blocks four times as long as they are wide."""
    # On a lattice of block widths, turned by 45 degrees, the pattern repeats every 2 × length steps.
    width = canvas.width / (count * 8) * np.sqrt(2)
    u = ((canvas.x + canvas.y) / np.sqrt(2)) / width
    v = ((canvas.y - canvas.x) / np.sqrt(2)) / width
    n = 4
    i, j = np.floor(u).astype(int), np.floor(v).astype(int)
    k = (i - j) % (2 * n)
    flat = k < n  # a block along u begins where (i - j) is a multiple of 2 n
    along = np.where(flat, k + (u - i), (2 * n - 1 - k) + (v - j))
    across = np.where(flat, v - j, u - i)
    first_i, first_j = np.where(flat, i - k, i), np.where(flat, j, j - (2 * n - 1 - k))
    # Moving by the canvas's width goes (count * 8 / 2) steps in u and as many back in v.
    period = count * 8 // 2
    key = ((first_i - first_j) % (2 * period)) * 977 + ((first_i + first_j) % (2 * period)) * 131
    table = randoms(seed, 4096)
    pick, tint = table[key % 4096], table[(key * 7 + 13) % 4096] - 0.5
    rim = np.minimum(np.minimum(across, 1 - across), np.minimum(along, n - along)) * width
    colours = np.stack([paint(wood) for wood in woods])[
        np.minimum((pick * len(woods)).astype(int), len(woods) - 1)
    ]
    fibre = canvas.noise(0.012, seed + 1, 2)
    shade = 1 + 0.14 * tint + 0.02 * fibre
    canvas.lay(canvas.full(), paint(woods[0]) * 0.4, height=-0.002)
    canvas.lay(
        canvas.cover((0.0014 - rim).astype(np.float32)),
        np.clip(colours * shade[..., None], 0, 1),
        height=(0.0002 * fibre).astype(np.float32),
        gloss=0.35,
    )


def stone_floor(
    canvas: Canvas, seed: int, pair: tuple[str, str], *, count: int = 4, joint: float = 0.004
) -> None:
    """Square floor tiles in two colours, as on a chessboard."""
    size = canvas.width / count
    units = courses(canvas, [canvas.tall / count] * count, [np.arange(count) * size for _ in range(count)])
    odd = ((np.floor(canvas.x / size) + np.floor(canvas.y / (canvas.tall / count))) % 2)[..., None]
    base = paint(pair[0]) * (1 - odd) + paint(pair[1]) * odd
    tint = units.pick(randoms(seed, units.count)) - 0.5
    vein = canvas.noise((0.3, 0.12), seed + 1, 4)
    colour = np.clip(base * (1 + 0.05 * tint + 0.02 * vein)[..., None], 0, 1)
    canvas.lay(canvas.full(), "#8f897d", height=-0.002)
    canvas.lay(canvas.cover(units.distance(joint, 0.002)), colour, height=0.0, gloss=0.45)


def carpet(canvas: Canvas, seed: int, colour: str) -> None:
    """A plain carpet with a short pile."""
    pile = canvas.noise(0.012, seed, 2)
    cloud = canvas.noise(0.4, seed + 1, 3)
    canvas.lay(
        canvas.full(),
        np.clip(paint(colour) * (1 + 0.045 * pile + 0.02 * cloud)[..., None], 0, 1),
        height=(0.0015 * pile).astype(np.float32),
    )


def ceiling(canvas: Canvas, seed: int, *, rosette: bool = True) -> None:
    """A white ceiling with a cove, a frame of plaster and a rosette."""
    canvas.lay(canvas.full(), "#eeebe3", gloss=0.04)
    away = np.minimum(
        np.minimum(canvas.x, canvas.width - canvas.x), np.minimum(canvas.y, canvas.tall - canvas.y)
    )
    profile = np.interp(
        away,
        [0, 0.1, 0.2, 0.22, 0.26, 0.28, 0.62, 0.64, 0.68, 0.7, 9],
        [0.14, 0.1, 0.06, 0.07, 0.07, 0, 0, 0.02, 0.02, 0, 0],
    )
    canvas.height += profile.astype(np.float32)
    if rosette:
        r = np.hypot(canvas.x - canvas.width / 2, canvas.y - canvas.tall / 2)
        turn = np.arctan2(canvas.y - canvas.tall / 2, canvas.x - canvas.width / 2)
        petals = (
            (0.02 * np.abs(np.cos(6 * turn)) + 0.012) * smooth(0.05, 0.12, r) * (1 - smooth(0.26, 0.32, r))
        )
        rim = 0.022 * np.exp(-(((r - 0.38) / 0.03) ** 2)) + 0.05 * np.exp(-((r / 0.06) ** 2))
        canvas.height += (petals + rim).astype(np.float32)
    corners(canvas, 0.2)


def office_ceiling(canvas: Canvas, seed: int, *, count: int = 2) -> None:
    """Mineral boards in a white grid, one in four a lamp."""
    size = canvas.width / count
    speck = smooth(1.6, 2.2, canvas.noise(0.014, seed, 1))
    canvas.lay(canvas.full(), np.clip(paint("#e3e1da") * (1 - 0.12 * speck)[..., None], 0, 1))
    off = np.minimum(
        np.minimum(canvas.x % size, size - canvas.x % size),
        np.minimum(canvas.y % size, size - canvas.y % size),
    )
    canvas.lay(canvas.cover((off - 0.012).astype(np.float32)), "#f1f0eb", height=0.008)
    lamp = canvas.box_distance(0.03, 0.03, size - 0.03, size - 0.03)
    canvas.lay(canvas.cover(lamp), "#fffdf2", gloss=0.3)
    grid = np.minimum(canvas.x % (size / 4), size / 4 - canvas.x % (size / 4)) + 0 * canvas.y
    canvas.lay(canvas.cover(lamp) * canvas.cover((grid - 0.006).astype(np.float32)), "#dcdacd")


def with_window(canvas: Canvas, seed: int, colour: str) -> None:
    """A painted wall with two windows, and the light that comes in by them on the wall around."""
    painted(canvas, seed, colour, rail=False)
    wide, low, high = 1.15, 0.85, canvas.tall - 0.4
    for middle in (0.29 * canvas.width, 0.71 * canvas.width):
        left, right = middle - wide / 2, middle + wide / 2
        canvas.slab(left - 0.08, low - 0.06, right + 0.08, high + 0.08, "#ebe7dd", 0.02, edge=0.01, fall=0.01)
        canvas.lay(canvas.box(left, low, right, high), "#c9d9e2", height=-0.04)
        sky = smooth(low, high, canvas.y + 0 * canvas.x)
        bright = paint("#d5dde0") + (paint("#eef4f8") - paint("#d5dde0")) * sky[..., None]
        canvas.lay(canvas.box(left, low, right, high), bright)
        for x in (left, middle, right):
            canvas.slab(x - 0.03, low, x + 0.03, high, "#efece4", 0.0, edge=0.006, fall=0.008)
        bar = high - 0.31 * (high - low)
        canvas.slab(left, bar - 0.025, right, bar + 0.025, "#efece4", 0.0, edge=0.006, fall=0.008)
