"""Recipes of what stands out of a wall or lies back in it: bays, loggias, dormers, awnings, signs, rails."""

from __future__ import annotations

from itertools import pairwise
from math import pi, sin

from .lettering import lettered
from .lofts import arc, beam, inset, lofted, upright
from .openings import casement
from .parts import Block, Part, Point, Prism, Ring, moved

__all__ = ["awning", "balcony", "bay", "dormer", "loggia", "railing", "sign"]


def balcony(w: float, h: float, d: float, *, rail: float = 0.95) -> tuple[Part, ...]:
    """A slab on the cell's floor with a railing of iron bars around its front and sides."""
    slab = min(0.16, 0.12 * h)
    return (Block(0, 0, w, slab, -d, 0), *rails(w, slab, slab + min(rail, 0.5 * h), d))


def railing(w: float, h: float, d: float, *, rail: float = 1.05) -> tuple[Part, ...]:
    """The railing alone, as high as a rail should be; the rest of the cell stays open."""
    return rails(w, 0.0, min(rail, h), min(d, 0.05))


def rails(w: float, foot: float, head: float, d: float) -> tuple[Part, ...]:
    """Iron bars between rails, also at the sides where there is depth for it."""
    bar, rail = 0.018, 0.045
    inset = min(0.05, 0.06 * w)
    x0, x1, front = inset, w - inset, -min(0.05, d / 3)
    parts: list[Part] = [
        Block(x0, head - rail, x1, head, front - rail, front, "rail"),
        Block(x0, foot + 0.07, x1, foot + 0.1, front - rail, front, "rail"),
    ]
    for x in (x0, x1 - rail):
        parts.append(Block(x, foot, x + rail, head, front - rail, front, "rail"))
        if d > 0.2:  # the sides, back to the wall
            parts.append(Block(x, head - rail, x + rail, head, -d, front - rail, "rail"))
            parts.append(Block(x, foot + 0.07, x + rail, foot + 0.1, -d, front - rail, "rail"))
            count = round(d / 0.14)
            for i in range(1, count):
                z = front - rail - (d + front - rail) * i / count
                parts.append(Block(x, foot + 0.1, x + bar, head - rail, z - bar, z, "rail"))
    count = max(2, min(60, round((x1 - x0) / 0.13)))
    pitch = (x1 - x0) / count
    for i in range(1, count):
        x = x0 + i * pitch - bar / 2
        parts.append(Block(x, foot + 0.1, x + bar, head - rail, front - 0.03, front - 0.012, "rail"))
    return tuple(parts)


def bay(w: float, h: float, d: float, *, cant: float = 0.75, storeys: int = 0) -> tuple[Part, ...]:
    """A bay window: canted or square on plan, windows all around, storey by storey, a corbel and a roof."""
    count = storeys or max(1, min(20, round(h / 3.2)))
    side = min(cant * d, 0.3 * w)
    about = (w / 2, -d)
    plan: tuple[Point, ...] = (
        ((0.0, -d), (0.0, 0.0), (w, 0.0), (w, -d))
        if side < 1e-3 * w
        else ((0.0, -d), (side, 0.0), (w - side, 0.0), (w, -d))
    )
    foot, roof = min(0.6, 0.1 * h), min(0.55, 0.09 * h)
    lip = min(0.1, 0.25 * roof)
    tall = (h - foot - roof - lip) / count
    post = min(0.09, 0.05 * w, 0.3 * d)
    pane = inset(plan, about, 1 - min(0.12, 0.1 * w) / w, 1 - min(0.07, 0.3 * d) / d)
    body = inset(plan, about, 0.985, 0.985)
    parts: list[Part] = [
        upright(inset(plan, about, 0.55, 0.25), 0.0, foot, "corbel", top=inset(plan, about, 0.97, 0.96)),
    ]
    for k in range(count):
        y = foot + k * tall
        sill, head = y + 0.3 * tall, y + 0.9 * tall
        bar = min(0.05, 0.04 * tall)
        parts += [
            upright(body, y, sill - bar, "body"),
            upright(plan, sill - bar, sill, "trim"),
            upright(pane, sill, head, "glass"),
            upright(body, head, y + tall, "body"),
        ]
        parts += _panels(plan, y + 0.25 * (sill - y), sill - bar - 0.2 * (sill - y), d)
        transom = sill + 0.68 * (head - sill)
        for a, b in pairwise(plan):
            parts += _lights(a, b, about, sill, head, transom, post)
    top = foot + count * tall
    parts += [
        upright(plan, top, top + lip, "trim"),
        upright(plan, top + lip, h, "roof", top=inset(plan, about, 0.72, 0.06)),
    ]
    return tuple(parts)


def _panels(plan: tuple[Point, ...], y0: float, y1: float, d: float) -> list[Part]:
    """A sunk field under the front windows."""
    x0, x1 = plan[1][0], plan[-2][0]
    edge = 0.12 * min(x1 - x0, y1 - y0)
    if edge <= 0:
        return []
    return [Ring(x0 + 2 * edge, y0, x1 - 2 * edge, y1, edge / 2, -0.3 * d, -0.004 * min(d, 1.0), "trim")]


def _lights(
    a: Point, b: Point, about: Point, sill: float, head: float, transom: float, post: float
) -> list[Part]:
    """Posts, a transom and mullions on one side of a bay, from one corner of its plan to the next."""
    long = ((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) ** 0.5
    ux, uz = (b[0] - a[0]) / long, (b[1] - a[1]) / long
    nx, nz = uz, -ux  # inwards: the plan runs from the left back to the right back over the front

    def strip(s0: float, s1: float, y0: float, y1: float, back: float) -> Part:
        at = [(a[0] + ux * s, a[1] + uz * s) for s in (s0, s1)]
        deep = post
        quad = (
            (at[0][0] + nx * back, at[0][1] + nz * back), (at[1][0] + nx * back, at[1][1] + nz * back),
            (at[1][0] + nx * (back + deep), at[1][1] + nz * (back + deep)),
            (at[0][0] + nx * (back + deep), at[0][1] + nz * (back + deep)),
        )  # fmt: skip
        return upright(quad, y0, y1, "frame")

    step = 0.1 * post
    thin = min(0.6 * post, 0.1 * (head - sill))
    parts = [
        strip(0.0, post, sill, head, step),
        strip(long - post, long, sill, head, step),
        strip(post, long - post, sill, sill + thin, step),
        strip(post, long - post, head - thin, head, step),
        strip(post, long - post, transom - thin / 2, transom + thin / 2, step),
    ]
    lights = max(1, min(12, round(long / 0.65)))
    for i in range(1, lights):
        s = post + (long - 2 * post) * i / lights
        parts.append(strip(s - 0.3 * post, s + 0.3 * post, sill + thin, head - thin, 2 * step))
    return parts


def loggia(w: float, h: float, d: float, *, depth: float = 1.4, parapet: str = "rail") -> tuple[Part, ...]:
    """A room open to the front: a glazed wall at its back, a rail or a parapet at its front."""
    side, slab = min(0.1, 0.06 * w), min(0.16, 0.07 * h)
    wall = min(0.25, 0.4 * d)
    back = -d + wall
    x0, x1, low, high = side, w - side, slab, h - slab
    wide = min(0.72 * (x1 - x0), 4.0)
    left, right = (w - wide) / 2, (w + wide) / 2
    head = low + 0.86 * (high - low)
    parts: list[Part] = [
        Block(0, low, x0, high, -d, 0),
        Block(x1, low, w, high, -d, 0),
        Block(0, high, w, h, -d, 0),
        Block(0, 0, w, low, -d, 0),
        Block(x0, low, left, high, -d, back, "back"),
        Block(right, low, x1, high, -d, back, "back"),
        Block(left, head, right, high, -d, back, "back"),
    ]
    parts += moved(casement(left, low, right, head, wall, bars=False), 0.0, 0.0, back)
    fence = min(1.0, 0.38 * h)
    if parapet == "wall":
        parts += [
            Block(x0, low, x1, low + 0.92 * fence, -min(0.15, 0.2 * d), -0.01 * min(d, 1.0), "front"),
            Block(x0, low + 0.92 * fence, x1, low + fence, -min(0.2, 0.3 * d), 0.0, "trim"),
        ]
    elif parapet == "rail":
        parts += moved(rails(x1 - x0, low, low + fence, min(d, 0.06)), x0, 0.0, 0.0)
    return tuple(parts)


def dormer(w: float, h: float, d: float, *, roof: str = "gable") -> tuple[Part, ...]:
    """A dormer: a window in a roof between cheeks, under a roof of its own that runs back into the slope."""
    wall = min(0.16, 0.5 * h)
    run = max(d, wall + 0.02)
    eave = min(0.14, 0.08 * w)
    cheek = min(0.12, 0.1 * w)
    rise = {"gable": min(0.42 * w, 0.36 * h), "arch": min(0.24 * w, 0.26 * h)}.get(roof, min(0.16, 0.12 * h))
    top = h - rise
    x0, x1 = eave, w - eave
    sill = min(0.12, 0.06 * h)
    verge = 0.12
    parts: list[Part] = [
        Block(x0, 0, x1, top, -run, -wall, "cheek"),
        Block(x0, 0, x0 + cheek, top, -wall, 0),
        Block(x1 - cheek, 0, x1, top, -wall, 0),
        Block(x0 + cheek, 0, x1 - cheek, sill, -wall, 0),
        *casement(x0 + cheek, sill, x1 - cheek, top - 0.4 * sill, wall, bars=True),
        Block(x0 + cheek, top - 0.4 * sill, x1 - cheek, top, -wall, 0),
        Block(x0 + 0.5 * cheek, 0.6 * sill, x1 - 0.5 * cheek, sill, -wall, 0.05, "sill"),
    ]
    half, tall = w / 2, 0.3 * rise
    if roof == "gable":
        inner = rise - tall
        low = top + inner * x0 / half
        parts.append(Prism(((x0, top), (x1, top), (x1, low), (half, top + inner), (x0, low)), -run, 0.0))
        for low, high, z, slot in ((0.0, 0.5, verge - 0.03, "frame"), (0.5, 1.0, verge, "roof")):
            a, b = low * tall, high * tall
            parts += [
                Prism(
                    ((0, top + a), (half, h - tall + a), (half, h - tall + b), (0, top + b)), -run, z, slot
                ),
                Prism(
                    ((half, h - tall + a), (w, top + a), (w, top + b), (half, h - tall + b)), -run, z, slot
                ),
            ]
    elif roof == "arch":
        outer = arc(half, top, half, rise)
        inner_arc = arc(half, top, half - 0.5 * eave, rise - tall)
        parts.append(Prism(inner_arc, -run, 0.0))
        parts.append(Prism((*outer, *reversed(inner_arc)), -run, verge, "roof"))
    else:
        parts += [
            Block(0.3 * eave, top, w - 0.3 * eave, top + 0.5 * rise, -run, 0.6 * verge, "frame"),
            Block(0, top + 0.5 * rise, w, h, -run, verge, "roof"),
        ]
    return tuple(parts)


def awning(w: float, h: float, d: float, *, stripe: float = 0.28, valance: float = 0.24) -> tuple[Part, ...]:
    """A sloping awning of striped cloth with a scalloped valance, on iron arms; `stripe` 0: plain."""
    count = 1 if stripe <= 0 else max(3, min(99, 2 * round(w / stripe / 2) + 1))
    pitch = w / count
    box, drop = min(0.14, 0.14 * h), min(valance, 0.45 * h)
    cloth = min(0.015, 0.05 * h, 0.2 * d)
    high, low = h - 0.3 * box, drop
    parts: list[Part] = [
        Block(0, h - box, w, h, -d, -d + min(0.16, 0.5 * d), "box"),
        beam(
            (0.04 * w, high - 0.7 * box, -d),
            (0.04 * w, low, -0.03 * d),
            min(0.03, 0.02 * w, 0.1 * h),
            "arm",
            flat="z",
        ),
        beam(
            (0.96 * w, high - 0.7 * box, -d),
            (0.96 * w, low, -0.03 * d),
            min(0.03, 0.02 * w, 0.1 * h),
            "arm",
            flat="z",
        ),
    ]
    section = ((high, -d), (low, 0.0), (low - cloth, 0.0), (high - cloth, -d))
    for i in range(count):
        x0, x1 = i * pitch, (i + 1) * pitch
        slot = "body" if i % 2 == 0 else "stripe"
        parts.append(lofted([(x0, y, z) for y, z in section], [(x1, y, z) for y, z in section], slot=slot))
    scallops = max(1, min(200, round(w / 0.28))) if stripe <= 0 else count
    width = w / scallops
    for i in range(scallops):
        x0, x1 = i * width, (i + 1) * width
        edge = [(x0 + width * k / 8, 0.4 * drop * (1 - sin(pi * k / 8))) for k in range(9)]
        slot = "body" if stripe <= 0 or i % 2 == 0 else "stripe"
        parts.append(Prism((*edge, (x1, drop), (x0, drop)), -cloth, 0.0, slot))
    return tuple(parts)


def sign(w: float, h: float, d: float, *, text: str = "") -> tuple[Part, ...]:
    """A sign: a board in a moulded frame, with raised capitals."""
    edge = min(0.07, 0.12 * min(w, h))
    parts: list[Part] = [
        Block(0, 0, w, h, -d, 0),
        Ring(0, 0, w, h, edge, -d, 0.03, "frame"),
        Ring(edge, edge, w - edge, h - edge, 0.25 * edge, -d, 0.015, "frame"),
    ]
    room = 2.2 * edge
    parts += lettered(text, room, room, w - room, h - room, 0.0, 0.025, "letters")
    return tuple(parts)
