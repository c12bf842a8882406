"""Recipes of openings: windows, doors, shop windows and arches."""

from __future__ import annotations

from math import cos, pi, sin

from .lofts import arc
from .parts import Block, Part, Prism, Ring

__all__ = ["arched_window", "archway", "casement", "door", "french_window", "reveal", "shop", "window"]


def reveal(d: float) -> float:
    """How far the frame of an opening lies behind its face, metres, in a shape of thickness `d`."""
    return min(0.13, 0.6 * d)


def _fine(d: float) -> float:
    """The factor of small steps in depth: in a thin shape they are smaller, so that none goes through its back."""
    return min(1.0, d / 0.1)


def window(w: float, h: float, d: float, *, leaves: int = 0, rows: int = 0) -> tuple[Part, ...]:
    """A casement window: leaves by width, a transom where it is tall, glazing bars by size, a sill."""
    sill = min(0.07, 0.07 * h)
    panes = casement(0, sill, w, h, d, bars=True, count=leaves, panes=rows)
    return (*panes, Block(0, 0, w, sill, -d, 0.06, "sill"))


def french_window(w: float, h: float, d: float) -> tuple[Part, ...]:
    """Glazed doors from floor to head with a low railing in front."""
    head = min(0.95, 0.42 * h)
    low = min(1.0, head / 0.3)  # where there is little height the rails are closer and thinner
    rail, bar = 0.04 * low, 0.018
    foot = 0.13 * low
    count = max(2, min(40, round(w / 0.12)))
    parts: list[Part] = [
        *casement(0, 0.03, w, h, d, bars=False),
        Block(0, 0, w, 0.05, -d, 0.1, "sill"),
        Block(0, head - rail, w, head, 0.05, 0.09, "rail"),
        Block(0, 0.1 * low, w, foot, 0.05, 0.09, "rail"),
    ]
    for i in range(count + 1):
        x = min(max(i * w / count - bar / 2, 0.0), w - bar)
        parts.append(Block(x, foot, x + bar, head - rail, 0.06, 0.078, "rail"))
    return tuple(parts)


def casement(
    x0: float, y0: float, x1: float, y1: float, d: float, *, bars: bool, count: int = 0, panes: int = 0
) -> list[Part]:
    """Frame, leaves, transom and glass in a rectangle, `d` metres deep; `count` leaves with `panes` rows of panes."""
    w, h = x1 - x0, y1 - y0
    fine = _fine(d)
    set_back = reveal(d)  # of the frame behind the face
    deep = set_back + min(0.05, (d - set_back) / 2)  # of the glass
    leaf, bar = -set_back - 0.015 * fine, -deep + 0.02 * fine
    frame = min(0.07, max(0.03, 0.06 * min(w, h)))
    inner = (x0 + frame, y0 + frame, x1 - frame, y1 - frame)
    if inner[2] - inner[0] <= 2 * frame or inner[3] - inner[1] <= 2 * frame:  # a slit: glass and frame alone
        return [Block(*inner, -d, -deep, "glass"), Ring(x0, y0, x1, y1, frame, -d, -set_back)]
    most = max(1, int((inner[2] - inner[0]) / (2.5 * frame)))
    leaves = min(count, most) if count else 1 if w < 0.72 else 2 if w < 1.8 else max(3, round(w / 0.8))
    transom = inner[1] + 0.7 * (inner[3] - inner[1]) if h > 1.5 and h > 1.05 * w / leaves else None
    parts: list[Part] = [Block(*inner, -d, -deep, "glass"), Ring(x0, y0, x1, y1, frame, -d, -set_back)]
    pitch = (inner[2] - inner[0]) / leaves
    post = 0.85 * frame
    top = inner[3] if transom is None else transom - post / 2
    for i in range(leaves):  # each leaf has its own slender frame
        left, right = inner[0] + i * pitch, inner[0] + (i + 1) * pitch
        if bars:
            rows = panes or (1 if h < 0.9 else max(2, round((top - inner[1]) / 0.5)))
            rows = min(rows, max(1, int((top - inner[1]) / 0.06)))
            for j in range(1, rows):
                y = inner[1] + (top - inner[1]) * j / rows
                parts.append(Block(left, y - 0.011, right, y + 0.011, -d, bar))
        elif h > 1.2:  # a solid lower field
            y = inner[1] + 0.24 * (top - inner[1])
            parts.append(Block(left, inner[1], right, y, -d, bar))
        parts.append(Ring(left, inner[1], right, top, 0.45 * frame, -d, leaf))
        if transom is not None:
            parts.append(Ring(left, transom + post / 2, right, inner[3], 0.45 * frame, -d, leaf))
    if transom is not None:
        parts.append(Block(inner[0], transom - post / 2, inner[2], transom + post / 2, -d, -set_back))
    return parts


def shop(w: float, h: float, d: float, *, panes: int = 0) -> tuple[Part, ...]:
    """A shop window: stall riser, panes as large as they come, a row of fanlights, a sill."""
    set_back, frame, fine = reveal(d), min(0.08, 0.06 * min(w, h)), _fine(d)
    deep = set_back + min(0.05, (d - set_back) / 2)
    riser = 0.16 * h
    fan = h - 0.2 * h
    parts: list[Part] = [
        Block(frame, riser, w - frame, h - frame, -d, -deep, "glass"),
        Block(0, 0, w, riser, -d, -0.02 * fine),
        Ring(0, riser, w, h, frame, -d, -set_back),
        Block(frame, fan - frame / 2, w - frame, fan + frame / 2, -d, -set_back),
    ]
    panes = min(panes, max(1, int(w / (3 * frame)))) if panes else max(1, round(w / 1.5))
    for i in range(1, panes):
        x = w * i / panes
        parts.append(
            Block(x - frame / 2, riser + frame, x + frame / 2, h - frame, -d, -set_back - 0.01 * fine)
        )
    lights = 2 * panes
    for i in range(1, lights, 2):
        x = frame + (w - 2 * frame) * i / lights
        parts.append(Block(x - 0.012, fan + frame / 2, x + 0.012, h - frame, -d, -deep + 0.02 * fine))
    fields = max(1, round(w / 0.7))
    edge = 0.18 * min(riser, w / fields)
    for i in range(fields):
        left, right = w * i / fields, w * (i + 1) / fields
        parts.append(Ring(left + edge, edge, right - edge, riser - edge, 0.3 * edge, -d, -0.005 * fine))
    parts.append(Block(0, riser - 0.02, w, riser + 0.03, -d, 0.04, "sill"))
    return tuple(parts)


def door(w: float, h: float, d: float, *, leaves: int = 0) -> tuple[Part, ...]:
    """A panelled door: frame, one or two leaves, a step, a fanlight where there is height for it."""
    set_back = reveal(d)
    deep = set_back + min(0.04, (d - set_back) / 2)
    pane = min(deep + 0.02, (deep + d) / 2)
    frame = min(0.08, 0.08 * w)
    step = min(0.14, 0.07 * h)
    tall = h > 2.3 or h > 2.5 * w
    head = step + 0.8 * (h - step) if tall else h - frame
    parts: list[Part] = [
        Block(0, step, frame, h, -d, -set_back),
        Block(w - frame, step, w, h, -d, -set_back),
        Block(frame, h - frame, w - frame, h, -d, -set_back),
    ]
    if tall:
        parts += [
            Block(frame, head + frame / 2, w - frame, h - frame, -d, -pane, "glass"),
            Block(frame, head - frame / 2, w - frame, head + frame / 2, -d, -set_back),
        ]
        for i in range(1, max(2, round(w / 0.4))):
            x = frame + (w - 2 * frame) * i / max(2, round(w / 0.4))
            parts.append(Block(x - 0.012, head + frame / 2, x + 0.012, h - frame, -d, -deep))
        head -= frame / 2
    leaves = leaves or (2 if w > 1.25 else 1)
    pitch = (w - 2 * frame) / leaves
    for i in range(leaves):
        left = frame + i * pitch
        parts += _leaf(left, step, left + pitch, head, d, deep, handle_right=leaves == 1 or i == 0)
    parts += [Block(0, 0, w, step, -d, 0.15, "step"), Block(0, 0, w, step / 2, -d, 0.3, "step")]
    return tuple(parts)


def _leaf(
    x0: float, y0: float, x1: float, y1: float, d: float, deep: float, *, handle_right: bool
) -> list[Part]:
    parts: list[Part] = [Block(x0, y0, x1, y1, -d, -deep)]
    w, h = x1 - x0, y1 - y0
    stile = min(0.13, 0.16 * w, 0.12 * h)
    fine = _fine(d)
    heights = (0.2, 0.1, 0.48)  # of the three fields, bottom to top; the rest is rails
    rail = (1 - sum(heights)) * h / 4
    y = y0 + rail
    for share in heights:
        top = y + share * h
        parts.append(Ring(x0 + stile, y, x1 - stile, top, 0.14 * stile, -d, -deep + 0.012 * fine))
        inset = 0.4 * stile
        parts.append(
            Block(x0 + stile + inset, y + inset, x1 - stile - inset, top - inset, -d, -deep + 0.008 * fine)
        )
        y = top + rail
    knob = (x1 - 0.5 * stile) if handle_right else (x0 + 0.5 * stile)
    height = y0 + min(1.0, 0.48 * h)
    parts.append(
        Block(knob - 0.012, height - 0.07, knob + 0.012, height + 0.07, -deep, -deep + 0.05, "metal")
    )
    return parts


def archway(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A wall with a round-arched opening: a ring of frame, glass behind, a keystone."""
    side = 0.14 * w
    span = (w - 2 * side) / 2
    rise = min(span, 0.45 * h)
    spring = max(0.04 * h, h - rise - 0.1 * h)
    set_back = reveal(d)
    deep = set_back + min(0.05, (d - set_back) / 2)
    frame = min(0.07, 0.1 * span)
    fine = _fine(d)
    outer = arc(w / 2, spring, span, rise)
    inner = arc(w / 2, spring, span - frame, rise - frame)
    left, right = w / 2 - span, w / 2 + span
    wall = ((0, 0), (left, 0), *reversed(outer), (right, 0), (w, 0), (w, h), (0, h))
    glass = ((left + frame, frame), (right - frame, frame), *inner)
    rim = ((left, 0), (left + frame, 0), *reversed(inner), (right - frame, 0), (right, 0), *outer)
    parts: list[Part] = [
        Prism(glass, -d, -deep, "glass"),
        Prism(rim, -d, -set_back, "frame"),
        Block(left + frame, 0, right - frame, frame, -d, -set_back, "frame"),
        Block(
            left + frame,
            spring - frame / 2,
            right - frame,
            spring + frame / 2,
            -d,
            -set_back - 0.005 * fine,
            "frame",
        ),
    ]
    for i in range(1, max(2, round(2 * span / 0.6))):
        x = left + 2 * span * i / max(2, round(2 * span / 0.6))
        parts.append(
            Block(x - 0.02, frame, x + 0.02, spring - frame / 2, -d, -set_back - 0.01 * fine, "frame")
        )
    key = 0.16 * span
    top = min(h, spring + rise + 0.09 * h)
    parts += [
        Prism(wall, -d, 0.0),
        Prism(
            ((w / 2 - 0.7 * key, spring + rise - 0.02), (w / 2 + 0.7 * key, spring + rise - 0.02),
             (w / 2 + key, top), (w / 2 - key, top)),
            -d, 0.03,
        ),
    ]  # fmt: skip
    return tuple(parts)


def arched_window(w: float, h: float, d: float, *, rise: float = 0.5) -> tuple[Part, ...]:
    """A window whose head is an arch, `rise` times as high as it is wide; nothing of the wall comes with it."""
    half, sill = w / 2, min(0.07, 0.05 * h)
    up = min(max(rise * w, 0.04 * h), 0.6 * h)
    spring = h - up
    set_back, fine = reveal(d), _fine(d)
    deep = set_back + min(0.05, (d - set_back) / 2)
    frame = min(0.07, 0.09 * w, 0.3 * up)
    outer = arc(half, spring, half, up)
    inner = arc(half, spring, half - frame, up - frame)
    left, right = frame, w - frame
    rim = ((0.0, sill), (left, sill), *reversed(inner), (right, sill), (w, sill), *outer)
    parts: list[Part] = [
        Prism(((left, sill), (right, sill), *inner), -d, -deep, "glass"),
        Prism(rim, -d, -set_back),
        Block(left, sill, right, sill + frame, -d, -set_back),
        Block(left, spring - frame / 2, right, spring + frame / 2, -d, -set_back - 0.005 * fine),
    ]
    leaves = 1 if w < 0.72 else 2 if w < 1.8 else max(3, round(w / 0.8))
    for i in range(1, leaves):
        x = left + (right - left) * i / leaves
        parts.append(
            Block(x - frame / 3, sill + frame, x + frame / 3, spring - frame / 2, -d, -set_back - 0.01 * fine)
        )
    tall = spring - frame / 2 - sill - frame
    rows = max(1, min(30, round(tall / 0.55)))
    bar, thin = -deep + 0.02 * fine, min(0.012, 0.02 * tall)
    for j in range(1, rows):
        y = sill + frame + tall * j / rows
        parts.append(Block(left, y - thin, right, y + thin, -d, bar))
    # Rays of the fan stop short of its rim, which hides their ends.
    hub = (half, spring + frame / 2)
    for k in range(1, 6) if w > 0.8 and up > 0.3 else ():
        a = pi * k / 6
        reach = (half - 0.5 * frame) * cos(a), (up - 0.5 * frame) * sin(a) - frame / 2
        nx, ny = -sin(a) * 0.011, cos(a) * 0.011
        (px, py), (qx, qy) = hub, (hub[0] + reach[0], hub[1] + reach[1])
        ray = ((px + nx, py + ny), (px - nx, py - ny), (qx - nx, qy - ny), (qx + nx, qy + ny))
        parts.append(Prism(ray, -d, bar))
    parts.append(Block(0, 0, w, sill, -d, 0.06, "sill"))
    return tuple(parts)
