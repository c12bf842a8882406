"""Glass and what is seen in it and behind it: sky, the houses across the street, a dark room, curtains."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .canvas import Canvas, Floats, paint, randoms, smooth

__all__ = ["Pane", "drapes", "folds", "glaze", "reflection", "sheer"]

Pane = tuple[float, float, float, float]
"""Left, bottom, right and top of a pane, metres."""


def reflection(
    canvas: Canvas, seed: int, shift: Floats | float = 0.0, *, dusk: bool = False
) -> tuple[Floats, Floats]:
    """What glass mirrors: its colour (h, w, 3), and how much of it (h, w). `shift` moves it up, pane by pane."""
    v = np.broadcast_to(canvas.y / canvas.tall - shift, (canvas.size, canvas.size))
    ridge = 0.34 + _roofs(canvas, seed)
    sky_share = smooth(-0.045, 0.045, v - ridge)
    if dusk:
        low, high, street = paint("#e2b48f"), paint("#6d7f9e"), paint("#3b3a41")
    else:
        low, high, street = paint("#dde5e8"), paint("#93b2c8"), paint("#a3a39e")
    rise = np.clip((v - 0.3) / 0.8, 0, 1)[..., None] ** 0.8
    sky = low + (high - low) * rise + 0.012 * canvas.noise((0.6, 0.3), seed + 2, 3)[..., None]
    colour = street + (sky - street) * sky_share[..., None]
    amount = 0.12 + sky_share * (0.13 + 0.27 * np.clip(v - 0.2, 0, 1))
    return np.clip(colour, 0, 1).astype(np.float32), amount.astype(np.float32)


def _roofs(canvas: Canvas, seed: int) -> Floats:
    """The line of the roofs across the street, (1, size), as a share of the height above the lowest eaves."""
    house = 0.62
    place = canvas.x / house + float(randoms(seed, 1)[0])
    number = np.floor(place).astype(int)
    values = randoms(seed + 1, 64)
    eaves, pitch = 0.06 * values[number % 64], 0.03 + 0.03 * values[(number + 17) % 64]
    across = np.abs(2 * (place - number) - 1)
    gable = np.where(values[(number + 29) % 64] > 0.45, 1 - across, 0.65 * np.clip(1.6 * (1 - across), 0, 1))
    return (eaves + pitch * gable).astype(np.float32)


def folds(canvas: Canvas, seed: int, pitch: float, gather: float = 0.0) -> Floats:
    """Shade of hanging cloth, -1 to 1: soft folds from top to bottom that sway a little."""
    sway = 0.5 * canvas.noise((0.35, 0.9), seed, 2)
    u = (canvas.x + gather * (canvas.y - canvas.tall) * (canvas.x - canvas.width / 2)) / pitch + 0.55 * sway
    deep = np.sin(2 * np.pi * u + 1.3 * np.sin(2 * np.pi * u * 0.37 + seed))
    return (0.75 * deep + 0.25 * np.sin(4.7 * np.pi * u)).astype(np.float32)


def sheer(canvas: Canvas, seed: int, cover: Floats, *, alpha: float = 0.6, colour: str = "#dcd9cf") -> None:
    """Hang a net curtain where `cover` says."""
    fold = folds(canvas, seed, 0.07)
    cloth = np.clip(paint(colour) * (0.93 + 0.07 * fold)[..., None], 0, 1)
    canvas.lay(cover, cloth, alpha=alpha * (0.92 + 0.08 * fold))


def drapes(canvas: Canvas, seed: int, pane: Pane, share: float, colour: str, alpha: float = 1.0) -> None:
    """Hang a pair of curtains drawn back to both sides of a rectangle, each `share` of its width."""
    left, bottom, right, top = pane
    width = (right - left) * share
    sway = 0.012 * canvas.noise((4.0, 0.5), seed, 1)
    taper = width * (0.86 + 0.14 * np.cos(2.6 * (canvas.y - bottom) / (top - bottom))) + sway
    inside = canvas.box(left, bottom, right, top)
    cloth = np.clip(paint(colour) * (0.86 + 0.14 * folds(canvas, seed, 0.075))[..., None], 0, 1)
    for edge in (canvas.x - left - taper, right - taper - canvas.x):
        canvas.lay(canvas.cover(edge.astype(np.float32)) * inside, cloth, alpha=alpha)


def glaze(
    canvas: Canvas,
    panes: Sequence[Pane],
    seed: int,
    *,
    depth: float = -0.1,
    behind: str = "dark",
    within: Pane | None = None,
    cover: Floats | None = None,
) -> None:
    """Put glass with a room behind it into panes.

    Parameters
    ----------
    canvas
        What to draw on.
    panes
        Where there is glass.
    seed
        Of what is mirrored: each pane hangs a little differently in its putty.
    depth
        Height of the glass.
    behind
        ``empty``, ``dark`` (curtains that one hardly sees), ``sheer`` (net curtains), ``drapes``, ``blind``, ``half``
        (a curtain across the lower half) or ``shop`` (goods).
    within
        The whole opening that the curtains belong to; None: around all panes.
    cover
        Coverage of the glass where panes are not rectangles; None: the panes themselves.
    """
    left, bottom, right, top = within or (
        min(p[0] for p in panes), min(p[1] for p in panes), max(p[2] for p in panes), max(p[3] for p in panes),
    )  # fmt: skip
    tilts = 0.09 * (randoms(seed + 40, len(panes)) - 0.5)
    shift = np.zeros((canvas.size, canvas.size), np.float32)
    whole = np.zeros((canvas.size, canvas.size), np.float32)
    for pane, tilt in zip(panes, tilts, strict=True):
        box = canvas.box(*pane)
        shift = np.where(box > 0, tilt, shift)
        whole = np.maximum(whole, box)
    if cover is not None:
        whole = cover
    room = Canvas(canvas.size, canvas.width, canvas.tall, colour="#363c3f")
    up = np.clip((canvas.y - bottom) / (top - bottom), 0, 1)
    room.shade((0.82 + 0.3 * up) * np.ones_like(whole))
    opening = room.box(left, bottom, right, top)
    if behind == "dark":  # not empty: the far wall is lighter than the floor, and curtains hang at the sides
        drapes(room, seed + 3, (left, bottom, right, top), 0.2, "#77756d", 0.42)
    elif behind == "shop":  # lit, with goods on a board along the back
        room.lay(opening, "#6d5f4c", alpha=0.75 * np.ones_like(whole) * (0.5 + 0.5 * up))
        for k, (wide, high, tone) in enumerate(
            zip(*(randoms(seed + j, 14) for j in (60, 61, 62)), strict=True)
        ):
            x = left + (k + 0.5) * (right - left) / 14
            base = bottom + 0.12 * (top - bottom)
            box = room.box(x - 0.05 - 0.05 * wide, base, x + 0.05 + 0.05 * wide, base + 0.12 + 0.3 * high)
            room.lay(box, paint("#3d352c") + (paint("#b59c74") - paint("#3d352c")) * tone, alpha=0.45)
        room.lay(room.box(left, bottom, right, bottom + 0.12 * (top - bottom)), "#3a3027")
    elif behind == "sheer":
        drapes(room, seed + 3, (left, bottom, right, top), 0.36, "#c9c6bb", 0.8)
    elif behind == "drapes":
        sheer(room, seed + 2, opening, alpha=0.28)
        drapes(room, seed + 3, (left, bottom, right, top), 0.23, "#8f7a66", 0.9)
    elif behind == "half":
        sheer(room, seed + 2, room.box(left, bottom, right, bottom + 0.52 * (top - bottom)), alpha=0.72)
    elif behind == "blind":
        fall = bottom + 0.38 * (top - bottom)
        cloth = np.clip(paint("#cfc9b9") * (0.97 + 0.03 * np.sin(canvas.y * 60))[..., None], 0, 1)
        room.lay(room.box(left, fall, right, top), np.broadcast_to(cloth, room.colour.shape), alpha=0.9)
    room.shade(np.float32(0.74) + 0.1 * up * np.ones_like(whole))
    mirrored, amount = reflection(canvas, seed, shift)
    glass = room.colour + (mirrored - room.colour) * amount[..., None]
    canvas.lay(whole, np.clip(glass, 0, 1), height=depth, gloss=1.0)
