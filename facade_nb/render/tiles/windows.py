"""Windows of several periods. Each is drawn twice: glazed, and as a frame whose panes are open to the room behind.

They fill their rectangle, so that no room shows beside them; around an arch goes `mask-arch`.
"""

from __future__ import annotations

import numpy as np

from .canvas import Canvas, Floats, paint
from .glazing import Pane, glaze
from .joinery import Wood, bars, boxed, leaf, reveal, sill, surround

__all__ = ["arched", "casement", "gothic", "modern", "sash", "shop", "steel", "works"]

WHITE = "#efece4"
STONE = "#d3cbba"


def _close(
    canvas: Canvas,
    panes: list[Pane],
    seed: int,
    behind: str | None,
    depth: float,
    cover: Floats | None = None,
    within: Pane | None = None,
) -> None:
    """Glaze the panes, or open them where nothing is `behind`."""
    if behind is not None:
        glaze(canvas, panes, seed, depth=depth, behind=behind, within=within, cover=cover)
        return
    if cover is None:
        cover = np.zeros((canvas.size, canvas.size), np.float32)
        for pane in panes:
            cover = np.maximum(cover, canvas.box(*pane))
    canvas.cut(cover, height=depth - 0.06)


def casement(
    canvas: Canvas,
    seed: int,
    behind: str | None,
    *,
    wood: str = WHITE,
    stone: str = STONE,
    transom: float = 0.31,
    crown: bool = True,
) -> None:
    """Two leaves below a transom and two above it, in a moulded surround: a town house of about 1890."""
    w, h = canvas.width, canvas.tall
    edge, foot = 0.1 * w, 0.075 * h
    canvas.lay(canvas.full(), stone, gloss=0.08)
    inner = (edge, foot, w - edge, h - (0.13 if crown else 0.08) * h)
    top = inner[3] + 0.08 * w if crown else h
    surround(canvas, (0.0, foot, w, top), inner, stone, height=0.035, steps=3)
    if crown:
        canvas.slab(0.0, top, w, h - 0.035 * h, stone, 0.05, edge=0.012, fall=0.02, gloss=0.08)
        canvas.slab(0.0, h - 0.035 * h, w, h, stone, 0.085, edge=0.01, fall=0.015, gloss=0.08)
    reveal(canvas, inner, "#b9b1a1", 0.1)
    box = boxed(canvas, (inner[0] + 0.012, inner[1], inner[2] - 0.012, inner[3] - 0.012), wood, -0.075, 0.028)
    bar_y = box[3] - transom * (box[3] - box[1])
    timber = Wood(wood, 0.042, 0.07, 0.022)
    middle = w / 2
    panes = []
    for left, right in ((box[0], middle), (middle, box[2])):
        panes += leaf(canvas, (left, box[1], right, bar_y - 0.028), timber, -0.062)
        panes += leaf(canvas, (left, bar_y + 0.028, right, box[3]), timber, -0.062, rail=0.042)
    canvas.slab(
        box[0], bar_y - 0.034, box[2], bar_y + 0.034, wood, -0.045, edge=0.012, fall=0.012, gloss=0.35
    )
    canvas.slab(
        middle - 0.03, box[1], middle + 0.03, bar_y - 0.03, wood, -0.05, edge=0.01, fall=0.01, gloss=0.35
    )
    _close(canvas, panes, seed, behind, -0.1, within=box)
    sill(canvas, 0.0, w, foot, stone, thick=foot, out=0.08)


def sash(
    canvas: Canvas,
    seed: int,
    behind: str | None,
    *,
    columns: int = 3,
    rows: int = 2,
    wood: str = WHITE,
    stone: str = "#d9d4c7",
) -> None:
    """Two sliding sashes, the upper in front, with fine bars, below a flat arch: Georgian."""
    w, h = canvas.width, canvas.tall
    foot = 0.07 * h
    inner = (0.06 * w, foot, 0.94 * w, h - 0.135 * h)
    reveal(canvas, (0.0, 0.0, w, h), "#d0c9ba", 0.0)
    _voussoirs(canvas, (0.0, inner[3], w, h), stone, seed)
    reveal(canvas, inner, "#cfc8b9", 0.11)
    box = boxed(
        canvas, (inner[0] + 0.01, inner[1], inner[2] - 0.01, inner[3] - 0.01), wood, -0.085, 0.035, foot=0.03
    )
    middle = (box[1] + box[3]) / 2
    timber = Wood(wood, 0.038, 0.06, 0.02)
    panes = leaf(canvas, (box[0], box[1], box[2], middle + 0.018), timber, -0.098, columns=columns, rows=rows)
    panes += leaf(
        canvas,
        (box[0], middle - 0.018, box[2], box[3]),
        timber,
        -0.07,
        columns=columns,
        rows=rows,
        rail=0.036,
    )
    _close(canvas, panes, seed, behind, -0.125, within=box)
    sill(canvas, 0.0, w, foot, stone, thick=foot, out=0.06)


def _voussoirs(canvas: Canvas, pane: Pane, stone: str, seed: int) -> None:
    """A flat arch of rubbed stones whose joints point to one centre, with a keystone."""
    left, bottom, right, top = pane
    count = 9
    w = right - left
    apex = bottom - 2.2 * w
    slope = (canvas.x - (left + right) / 2) / (canvas.y - apex) * (top - apex)
    unit = w * 1.02 / count
    place = slope / unit + count / 2
    index = np.floor(place)
    rim = np.minimum(place - index, 1 - place + index) * unit
    tint = 1 + 0.05 * np.sin(12.9 * index + seed)
    colour = paint(stone) * (tint * (1 + 0.012 * canvas.noise(0.015, seed, 2)))[..., None]
    box = canvas.box(*pane)
    canvas.lay(box, paint(stone) * 0.72, height=-0.004, gloss=0.05)
    stones = canvas.cover((0.0035 - rim).astype(np.float32)) * canvas.box(left, bottom + 0.003, right, top)
    key = np.broadcast_to(np.abs(place - count / 2) < 0.5, stones.shape)
    rounded = 0.004 * (1 - np.clip((rim - 0.0035) / 0.006, 0, 1))
    canvas.lay(
        stones,
        np.clip(colour, 0, 1),
        height=(np.where(key, 0.03, 0.008) - rounded).astype(np.float32),
        gloss=0.08,
    )


def modern(
    canvas: Canvas, seed: int, behind: str | None, *, metal: str = "#3d4144", split: float = 0.36
) -> None:
    """A fixed light beside a narrow leaf, in slim dark aluminium."""
    w, h = canvas.width, canvas.tall
    canvas.slab(0.0, 0.0, w, h, metal, 0.004, edge=0.004, fall=0.004, gloss=0.5)
    inner = (0.028, 0.04, w - 0.028, h - 0.028)
    reveal(canvas, inner, "#34383a", 0.12)
    box = boxed(canvas, inner, metal, -0.095, 0.022, gloss=0.5)
    cut = box[0] + split * (box[2] - box[0])
    panes = leaf(canvas, (box[0], box[1], cut, box[3]), Wood(metal, 0.042, 0.042, gloss=0.5), -0.085)
    canvas.slab(cut - 0.006, box[1], cut + 0.02, box[3], metal, -0.09, edge=0.004, fall=0.004, gloss=0.5)
    panes.append((cut + 0.02, box[1] + 0.008, box[2] - 0.008, box[3] - 0.008))
    _close(canvas, panes, seed, behind, -0.112, within=box)
    canvas.slab(0.0, 0.0, w, 0.034, "#4a4f52", 0.035, edge=0.006, fall=0.01, gloss=0.55)
    if split:  # a lever handle on the leaf
        y = box[1] + 0.45 * (box[3] - box[1])
        canvas.slab(
            cut - 0.03, y - 0.05, cut - 0.016, y + 0.05, "#a9adae", -0.06, edge=0.003, fall=0.004, gloss=0.8
        )


def arched(
    canvas: Canvas, seed: int, behind: str | None, *, wood: str = "#4a3c31", stone: str = "#cfc4ad"
) -> None:
    """A round-headed window in a stone arch with a keystone; transparent around it."""
    w, h = canvas.width, canvas.tall
    foot, band = 0.06 * h, 0.1 * w
    outer_r = w / 2 - 0.012
    spring = h - outer_r - 0.02 * h
    outer = canvas.arch_distance(0.012, 0.0, w - 0.012, spring)  # on behind the sill
    inner = canvas.arch_distance(band, foot, w - band, spring)
    angle = np.arctan2(canvas.y - spring, canvas.x - w / 2)
    stones = 11
    place = angle / np.pi * stones
    rim = np.where(
        canvas.y > spring,
        np.minimum(place % 1, 1 - place % 1) * np.pi / stones * np.hypot(canvas.x - w / 2, canvas.y - spring),
        np.abs((canvas.y - foot + 0.17) % 0.34 - 0.17),
    )
    tint = 1 + 0.035 * np.sin(
        9.1 * np.where(canvas.y > spring, np.floor(place) + 20, np.floor((canvas.y - foot) / 0.34))
    )
    colour = np.clip(paint(stone) * (tint * (1 + 0.015 * canvas.noise(0.015, seed, 2)))[..., None], 0, 1)
    joint = canvas.cover((rim - 0.0035).astype(np.float32))
    bevel = np.clip(-outer / 0.012, 0, 1) * np.clip(inner / 0.02, 0, 1)
    canvas.lay(
        canvas.cover(outer), colour, height=(0.03 * bevel - 0.006 * joint).astype(np.float32), gloss=0.08
    )
    canvas.shade(1 - 0.22 * joint)
    key = canvas.polygon_distance([
        (w / 2 - 0.045 * w, spring + w / 2 - band - 0.02), (w / 2 + 0.045 * w, spring + w / 2 - band - 0.02),
        (w / 2 + 0.07 * w, h - 0.004), (w / 2 - 0.07 * w, h - 0.004),
    ])  # fmt: skip
    canvas.lay(
        canvas.cover(key),
        stone,
        height=(0.07 - 0.02 * (1 - np.clip(-key / 0.012, 0, 1))).astype(np.float32),
        gloss=0.08,
    )
    canvas.lay(canvas.cover(inner), "#8d8069", height=-0.11)
    canvas.lay(canvas.cover(inner + 0.008), wood, height=(-0.085 + 0.0 * inner).astype(np.float32), gloss=0.3)
    clear = inner + 0.055
    left, right, base, bar = band + 0.055, w - band - 0.055, foot + 0.075, 0.034
    panes = bars((left, base, right, spring - bar / 2), 2, 2, bar)
    cover = np.zeros_like(canvas.alpha)
    for p in panes:
        cover = np.maximum(cover, canvas.box(*p))
    head = canvas.cover(clear) * canvas.box(0, spring + bar / 2, w, h)
    hub = np.hypot(canvas.x - w / 2, canvas.y - spring)
    spokes = np.minimum(np.abs(canvas.x - w / 2), np.minimum(
        np.abs((canvas.x - w / 2) * 0.5 - (canvas.y - spring) * 0.866),
        np.abs((canvas.x - w / 2) * 0.5 + (canvas.y - spring) * 0.866)
    ))  # fmt: skip
    ring = np.abs(hub - 0.15 * w)
    spokes = np.where(hub < 0.15 * w, bar, spokes)
    head *= canvas.cover((0.012 - spokes).astype(np.float32)) * canvas.cover(
        (0.012 - ring).astype(np.float32)
    )
    cover = np.maximum(cover, head)
    _close(
        canvas,
        [*panes, (left, spring, right, h)],
        seed,
        behind,
        -0.105,
        cover,
        within=(left, base, right, h - 0.1),
    )
    sill(canvas, 0.0, w, foot, stone, thick=foot, out=0.07)


def gothic(canvas: Canvas, seed: int, behind: str | None) -> None:
    """Leaded lights in a stone cross: four openings with small panes, before 1600."""
    w, h = canvas.width, canvas.tall
    stone = "#c9bda3"
    canvas.slab(
        0,
        0,
        w,
        h,
        np.clip(paint(stone) * (1 + 0.015 * canvas.noise(0.015, seed, 2))[..., None], 0, 1),
        0.01,
        edge=0.008,
        fall=0.01,
        gloss=0.08,
    )
    edge, cross = 0.1, 0.085
    panes = []
    high = 0.4 * h
    for left, right in ((edge, w / 2 - cross / 2), (w / 2 + cross / 2, w - edge)):
        for bottom, top in ((edge * 0.9, h - high - cross / 2), (h - high + cross / 2, h - edge)):
            chamfer = 0.035
            inward = np.clip(-canvas.box_distance(left, bottom, right, top) / chamfer, 0, 1)
            canvas.lay(
                canvas.box(left, bottom, right, top),
                canvas.colour * 0.93,
                height=(0.0 - 0.05 * inward).astype(np.float32),
            )
            pane = (left + chamfer, bottom + chamfer, right - chamfer, top - chamfer)
            canvas.lay(canvas.box(*pane), "#3f4244", height=-0.07, gloss=0.3)
            panes += bars(
                (pane[0] + 0.012, pane[1] + 0.012, pane[2] - 0.012, pane[3] - 0.012),
                3,
                5 if bottom < 0.2 else 3,
                0.009,
            )
    _close(canvas, panes, seed, behind, -0.075)


def steel(
    canvas: Canvas, seed: int, behind: str | None, *, columns: int = 5, rows: int = 5, metal: str = "#39413f"
) -> None:
    """Thin steel sections in a grid with a tilting part: a factory of about 1910."""
    w, h = canvas.width, canvas.tall
    sill_h = 0.05
    canvas.slab(0, 0, w, h, "#b3aca0", 0.0, gloss=0.05)
    inner = (0.0, sill_h, w, h)
    reveal(canvas, inner, "#8f877b", 0.09)
    box = boxed(canvas, (0.012, sill_h, w - 0.012, h - 0.012), metal, -0.07, 0.026, gloss=0.4)
    panes = bars(box, columns, rows, 0.018)
    for p in panes:
        depth = np.clip(
            -canvas.box_distance(p[0] - 0.005, p[1] - 0.005, p[2] + 0.005, p[3] + 0.005) / 0.005, 0, 1
        )
        canvas.lay(
            canvas.box(p[0] - 0.005, p[1] - 0.005, p[2] + 0.005, p[3] + 0.005),
            metal,
            height=(-0.072 - 0.01 * depth).astype(np.float32),
        )
    # The tilting part has a frame of its own.
    a, b = panes[columns * 2 + 1], panes[columns * (rows - 2) + columns - 2]
    tilt = (a[0] - 0.016, a[1] - 0.016, b[2] + 0.016, b[3] + 0.016)
    inside = [
        p
        for p in panes
        if p[0] >= a[0] - 1e-6 and p[2] <= b[2] + 1e-6 and p[1] >= a[1] - 1e-6 and p[3] <= b[3] + 1e-6
    ]
    canvas.slab(*tilt, metal, -0.055, edge=0.005, fall=0.008, gloss=0.4)
    smaller = [
        (max(p[0], a[0] + 0.012), max(p[1], a[1] + 0.012), min(p[2], b[2] - 0.012), min(p[3], b[3] - 0.012))
        for p in inside
    ]
    rest = [p for p in panes if p not in inside]
    _close(canvas, rest + smaller, seed, behind, -0.085, within=box)
    sill(canvas, 0, w, sill_h, "#a39a8b", thick=sill_h, out=0.05)


def shop(canvas: Canvas, seed: int, behind: str | None, *, wood: str = "#2f4a43") -> None:
    """A shop front: stall riser, large panes, fanlights, and a fascia above."""
    w, h = canvas.width, canvas.tall
    canvas.slab(0, 0, w, h, wood, -0.01, gloss=0.35)
    riser, fascia = 0.45, 0.42
    for k in range(3):
        x = 0.14 + k * (w - 0.28) / 3
        canvas.slab(
            x + 0.03,
            0.09,
            x + (w - 0.28) / 3 - 0.03,
            riser - 0.06,
            wood,
            -0.03,
            edge=0.02,
            fall=-0.02,
            gloss=0.35,
        )
    canvas.slab(0, riser - 0.05, w, riser, wood, 0.05, edge=0.01, fall=0.015, gloss=0.35)
    inner = (0.14, riser, w - 0.14, h - fascia)
    canvas.lay(canvas.box(*inner), wood, height=-0.06)
    bar_y = inner[3] - 0.42
    panes = bars((inner[0] + 0.035, inner[1] + 0.035, inner[2] - 0.035, bar_y - 0.025), 3, 1, 0.05)
    panes += bars((inner[0] + 0.035, bar_y + 0.025, inner[2] - 0.035, inner[3] - 0.03), 6, 1, 0.035)
    _close(canvas, panes, seed, behind, -0.1, within=inner)
    for x in (0.0, w - 0.14):  # pilasters
        canvas.slab(x, 0, x + 0.14, h - fascia, wood, 0.02, edge=0.008, fall=0.01, gloss=0.35)
        canvas.slab(
            x + 0.03, 0.2, x + 0.11, h - fascia - 0.1, wood, 0.01, edge=0.008, fall=-0.008, gloss=0.35
        )
        canvas.slab(x, 0, x + 0.14, 0.12, wood, 0.035, edge=0.008, fall=0.01, gloss=0.35)
    canvas.slab(0, h - fascia, w, h - 0.1, wood, 0.02, edge=0.01, fall=0.012, gloss=0.35)
    canvas.slab(0.12, h - fascia + 0.05, w - 0.12, h - 0.15, wood, 0.0, edge=0.012, fall=-0.01, gloss=0.35)
    canvas.slab(0, h - 0.1, w, h, wood, 0.1, edge=0.02, fall=0.03, gloss=0.35)


def works(
    canvas: Canvas, seed: int, behind: str | None, *, metal: str = "#3a423f", brick: str = "#96604c"
) -> None:
    """A window of a works: steel sections below a segmental arch of bricks on end, which fills its rectangle."""
    w, h = canvas.width, canvas.tall
    foot, rise = 0.05 * h, 0.1 * w
    spring = h - 0.14 * h - rise
    radius = (w * w / 4 + rise * rise) / (2 * rise)
    middle = spring + rise - radius
    angle = np.arctan2(canvas.x - w / 2, canvas.y - middle)
    unit = 0.075 / radius
    place = angle / unit
    rim = np.minimum(place % 1, 1 - place % 1) * 0.075
    tint = 1 + 0.11 * np.sin(12.9898 * np.floor(place) + seed)
    ring = np.hypot(canvas.x - w / 2, canvas.y - middle)
    joint = np.maximum(
        canvas.cover((rim - 0.005).astype(np.float32)), canvas.cover(np.abs(ring - radius - 0.24) - 0.006)
    )
    colour = np.clip(paint(brick) * (tint * (1 + 0.03 * canvas.noise(0.02, seed, 2)))[..., None], 0, 1)
    colour = colour + (paint("#b9ae9d") - colour) * joint[..., None]
    canvas.lay(canvas.full(), colour, height=(0.012 - 0.006 * joint).astype(np.float32), gloss=0.06)
    opening = canvas.arch_distance(0.0, foot, w, spring, rise)
    canvas.lay(canvas.cover(opening), "#6e665b", height=-0.14)
    canvas.lay(canvas.cover(opening + 0.03), metal, height=-0.1, gloss=0.35)
    box = (0.055, foot + 0.05, w - 0.055, h)
    panes = bars(box, 6, 7, 0.028)
    cover = np.zeros_like(canvas.alpha)
    for pane in panes:
        cover = np.maximum(cover, canvas.box(*pane))
    cover *= canvas.cover(opening + 0.06)
    for x in (w / 3, 2 * w / 3):  # mullions
        cover *= 1 - canvas.box(x - 0.03, foot, x + 0.03, h)
        canvas.lay(
            canvas.box(x - 0.03, foot, x + 0.03, h) * canvas.cover(opening + 0.02),
            metal,
            height=-0.07,
            gloss=0.35,
        )
    cover *= 1 - canvas.box(0, spring - 0.32 * h, w, spring - 0.32 * h + 0.06)
    _close(canvas, [(box[0], box[1], box[2], spring + rise)], seed, behind, -0.12, cover, within=box)
    sill(canvas, 0, w, foot, "#a79c8c", thick=foot, out=0.05)
