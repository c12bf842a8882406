"""Recipes of stonework: quoins, gables, arcades, pediments, statues, stairs."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, ceil, cos, pi, sin

from .lofts import arc, lofted, stone
from .parts import Block, Moulding, Part, Point, Prism, Turned

__all__ = ["arcade", "gable", "pediment", "quoin", "stair", "stair_stand", "statue"]


def quoin(w: float, h: float, d: float, *, course: float = 0.33, short: float = 0.62) -> tuple[Part, ...]:
    """Corner stones, long and short in turn, flush at the left; a mirrored letter has them flush at the right."""
    count = max(1, min(200, round(h / course)))
    tall = h / count
    joint = min(0.008, 0.04 * tall)
    bevel = min(0.025, 0.15 * tall, 0.1 * short * w, 0.4 * d)
    return tuple(
        stone(
            0, i * tall + joint / 2, w if i % 2 == 0 else short * w, (i + 1) * tall - joint / 2, -d, 0, bevel
        )
        for i in range(count)
    )


def gable(w: float, h: float, d: float, *, form: str = "straight", steps: int = 0) -> tuple[Part, ...]:
    """A gable wall that stands above its roof: straight, stepped or curved, under coping stones."""
    ahead = 0.05
    if form == "stepped":
        return _stepped(w, h, d, steps or max(2, min(12, round(h / 0.7))), ahead)
    half, ball = w / 2, min(0.07 * h, 0.05 * w, 0.16)
    pedestal = 1.3 * ball
    top = h - pedestal - 2 * ball  # of the coping
    tall = min(0.16, 0.09 * top)
    edge = _edge(form, half, top - tall)
    wall = [(0.0, 0.0), (w, 0.0), *((w - x, y) for x, y in edge), *reversed(edge[:-1])]
    parts: list[Part] = [Prism(tuple(_distinct(wall)), -d, 0.0)]
    for side in (False, True):
        for (xa, ya), (xb, yb) in pairwise(edge):
            quad: tuple[Point, ...] = ((xa, ya), (xb, yb), (xb, yb + tall), (xa, ya + tall))
            if side:
                quad = tuple((w - x, y) for x, y in reversed(quad))
            parts.append(Prism(quad, -d, ahead, "coping"))
    parts += _oculus(half, 0.4 * top, min(0.42, 0.14 * top, 0.1 * w), d)
    parts += [
        Block(half - 1.1 * ball, top - tall, half + 1.1 * ball, top + pedestal, -d, ahead, "coping"),
        Turned(half, ahead - 1.1 * ball, _ball(top + pedestal, ball), "coping"),
    ]
    return tuple(parts)


def _edge(form: str, half: float, top: float) -> list[Point]:
    """The left edge of a gable from its foot to its top, without the coping."""
    foot = 0.1 * top
    if form == "straight":
        return [(0.0, foot), (half, top)]
    # A hollow below, a swelling above it.
    turns = [pi / 2 * i / 9 for i in range(10)]
    shoulder = foot + 0.4 * (top - foot)
    hollow = [(0.4 * half * sin(a), foot + (shoulder - foot) * (1 - cos(a))) for a in turns]
    swelling = [(half * (1 - 0.6 * cos(a)), shoulder + (top - shoulder) * sin(a)) for a in turns]
    return [*hollow, *swelling[1:]]


def _distinct(points: list[Point]) -> list[Point]:
    return [p for k, p in enumerate(points) if p != points[k - 1]]


def _stepped(w: float, h: float, d: float, steps: int, ahead: float) -> tuple[Part, ...]:
    run, tall = w / 2 / (steps + 0.9), min(0.12, 0.25 * h / (steps + 1))
    rise = (h - tall) / (steps + 1)
    left = [p for k in range(steps) for p in ((k * run, (k + 1) * rise), ((k + 1) * run, (k + 1) * rise))]
    left += [(steps * run, h - tall)]
    wall = ((0.0, 0.0), (w, 0.0), *((w - x, y) for x, y in left), *reversed(left))
    parts: list[Part] = [Prism(wall, -d, 0.0)]
    for k in range(steps):
        y = (k + 1) * rise
        parts += [
            Block(k * run, y, (k + 1) * run, y + tall, -d, ahead, "coping"),
            Block(w - (k + 1) * run, y, w - k * run, y + tall, -d, ahead, "coping"),
        ]
    parts.append(Block(steps * run, h - tall, w - steps * run, h, -d, ahead, "coping"))
    parts += _oculus(w / 2, 0.42 * h, min(0.42, 0.12 * h, 0.1 * w), d)
    return tuple(parts)


def _oculus(cx: float, cy: float, radius: float, d: float) -> list[Part]:
    """A round window on a wall, its frame a ring of stones."""
    fine = min(1.0, d / 0.1)
    if radius < 0.1:
        return []

    def circle(r: float) -> tuple[Point, ...]:
        return tuple((cx + r * cos(2 * pi * i / 24), cy + r * sin(2 * pi * i / 24)) for i in range(24))

    bar, r = 0.06 * radius, 0.74 * radius
    return [
        Prism(circle(radius), -0.01, 0.04, "coping"),
        Prism(circle(0.78 * radius), 0.0, 0.04 + 0.002 * fine, "frame"),
        Prism(circle(0.7 * radius), 0.0, 0.04 + 0.004 * fine, "glass"),
        Block(cx - bar, cy - r, cx + bar, cy + r, 0.0, 0.05, "frame"),
        Block(cx - r, cy - bar, cx + r, cy + bar, 0.0, 0.05, "frame"),
    ]


def _ball(foot: float, radius: float) -> tuple[tuple[float, float], ...]:
    angles = (-0.94, -0.6, -0.3, 0.0, 0.3, 0.6, 0.85, 0.97)
    return tuple(
        (foot + radius * (1 + sin(pi / 2 * a)) * 0.999, max(radius * cos(pi / 2 * a), 0.02 * radius))
        for a in angles
    )


def arcade(
    w: float, h: float, d: float, *, bays: int = 0, depth: float = 2.0, pier: float = 0.2
) -> tuple[Part, ...]:
    """Arches on piers before a covered walk; `pier` is the share of a bay that its pier has."""
    count = bays or max(1, min(40, round(w / max(0.62 * h, 0.4))))
    pitch = w / count
    side = pier * pitch / 2
    span = pitch / 2 - side
    head = 0.16 * h
    rise = min(span, 0.5 * (h - head))
    spring = h - head - rise
    deep = min(0.45, 0.4 * d)
    proud = min(0.04, 0.1 * span)
    ring = min(0.16, 0.9 * side, 0.3 * head)
    impost, base = min(0.16, 0.12 * spring), min(0.3, 0.16 * spring)
    wall = min(0.1, 0.2 * d)
    parts: list[Part] = [
        Block(0, 0, w, h, -d, -d + wall, "back"),
        Block(0, h - head, w, h, -d + wall, -deep, "back"),
        Block(0, 0, w, min(0.03, 0.02 * h), -d + wall, 0.0, "floor"),
    ]
    for i in range(count):
        left = i * pitch
        middle, right = left + pitch / 2, left + pitch
        inner = arc(middle, spring, span, rise)
        front = ((left, 0.0), (left + side, 0.0), *reversed(inner), (right - side, 0.0), (right, 0.0))
        parts.append(Prism((*front, (right, h), (left, h)), -deep, 0.0))
    for i in range(count):
        left = i * pitch
        middle = left + pitch / 2
        inner, outer = (arc(middle, spring, span + r, rise + r) for r in (0.0, ring))
        parts.append(Prism((*outer, *reversed(inner)), -deep, proud, "trim"))
        key, top = 0.09 * span + 0.03, min(spring + rise + 0.8 * head, spring + rise + ring + 0.12)
        low = spring + rise - min(0.04, 0.2 * rise)
        parts.append(
            Prism(
                ((middle - 0.7 * key, low), (middle + 0.7 * key, low), (middle + key, top), (middle - key, top)),
                -deep, 1.6 * proud, "trim",
            )
        )  # fmt: skip
    for i in range(count + 1):
        x0, x1 = max(i * pitch - side, 0.0), min(i * pitch + side, w)
        parts += [
            Block(x0, spring - impost, x1, spring, -deep, 1.3 * proud, "trim"),
            Block(x0, 0, x1, base, -deep, proud, "trim"),
        ]
    parts.append(Block(0, h - 0.35 * head, w, h, -deep, 1.8 * proud, "trim"))
    return tuple(parts)


def pediment(w: float, h: float, d: float, *, form: str = "triangle") -> tuple[Part, ...]:
    """A pediment: a cornice, a field set back, raking cornices; triangular, segmental or broken."""
    base, tall = 0.2 * h, min(0.2 * h, 0.3)
    back = min(0.6 * d, 0.25)
    foot = ((0.0, -0.5 * d), (0.3 * base, -0.5 * d), (0.3 * base, -0.25 * d), (0.55 * base, -0.2 * d),
            (0.55 * base, 0.0), (base, 0.0))  # fmt: skip
    parts: list[Part] = [Moulding(0, w, foot, -d, "trim")]
    rise = h - base - tall
    if form == "segment":
        line = _bow(w, base, rise)
        runs = [line]
    else:
        gap = 0.2 * w if form == "broken" else 0.0
        crest = base + rise * (1 - gap / w)
        runs = [[(0.0, base), ((w - gap) / 2, crest)], [((w + gap) / 2, crest), (w, base)]]
        line = _distinct([*runs[0], *runs[1]])
    parts.append(Prism((*reversed(line[1:-1]), (0.0, base), (w, base)), -d, -back))
    for run in runs:
        for low, high, z in ((0.0, 0.45, -0.45 * back), (0.45, 1.0, 0.0)):
            for (xa, ya), (xb, yb) in pairwise(run):
                quad = (
                    (xa, ya + low * tall),
                    (xb, yb + low * tall),
                    (xb, yb + high * tall),
                    (xa, ya + high * tall),
                )
                parts.append(Prism(quad, -d, z, "trim"))
    if form == "broken":
        urn = min(0.075 * w, 0.3 * (h - base))
        room = h - base
        profile = ((0.0, 0.75), (0.14, 0.75), (0.2, 0.4), (0.3, 0.35), (0.42, 0.8), (0.6, 1.0), (0.7, 0.9),
                   (0.76, 0.55), (0.82, 0.6), (0.9, 0.3), (1.0, 0.08))  # fmt: skip
        parts.append(Turned(w / 2, -urn, tuple((base + t * room, r * urn) for t, r in profile), "trim"))
    return tuple(parts)


def _bow(w: float, foot: float, rise: float, steps: int = 24) -> list[Point]:
    """An arc from the left to the right over a width: of a circle where it is flat enough, else of an ellipse."""
    if rise >= w / 2:
        line = list(reversed(arc(w / 2, foot, w / 2, rise, steps)))
    else:
        radius = ((w / 2) ** 2 + rise**2) / (2 * rise)
        turn = atan2(w / 2, radius - rise)
        turns = (turn * (2 * i / steps - 1) for i in range(steps + 1))
        line = [(w / 2 + radius * sin(a), foot + rise - radius + radius * cos(a)) for a in turns]
    return [(0.0, foot), *line[1:-1], (w, foot)]


def statue(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A stand-in for a statue: a draped figure on a plinth, as large as fits; it is as deep as it is wide."""
    wide = min(w, 0.42 * h)
    cx, foot = w / 2, 0.16 * h
    tall, r = h - foot, 0.34 * wide
    half = wide / 2
    robe = ((0.0, 0.98), (0.03, 1.0), (0.12, 0.9), (0.3, 0.74), (0.44, 0.66), (0.52, 0.62), (0.6, 0.7), (0.68, 0.8),
            (0.735, 0.84), (0.765, 0.74), (0.79, 0.42), (0.805, 0.27), (0.83, 0.25))  # fmt: skip
    head = (
        (0.815, 0.16),
        (0.825, 0.26),
        (0.85, 0.36),
        (0.89, 0.42),
        (0.93, 0.41),
        (0.965, 0.31),
        (0.99, 0.15),
        (1.0, 0.04),
    )
    cz = -half

    def arm(way: int) -> list[Part]:
        """The upper arm hangs, the lower one lies before the body."""
        top = (cx + way * 0.5 * r, foot + 0.785 * tall, cz)
        shoulder = (cx + way * 0.72 * r, foot + 0.74 * tall, cz)
        elbow = (cx + way * 0.9 * r, foot + 0.56 * tall, cz + 0.2 * r)
        hand = (cx + way * 0.15 * r, foot + (0.64 if way > 0 else 0.52) * tall, cz + 0.85 * r)
        a, b = 0.2 * r, 0.16 * r
        return [_limb((top, 0.3 * a), (shoulder, a), (elbow, b)), _limb((elbow, b), (hand, 0.8 * b))]

    parts: list[Part] = [
        Block(cx - half, 0, cx + half, 0.3 * foot, -2 * half, 0, "trim"),
        Block(cx - 0.88 * half, 0.3 * foot, cx + 0.88 * half, 0.8 * foot, -1.88 * half, -0.12 * half, "trim"),
        Block(cx - half, 0.8 * foot, cx + half, foot, -2 * half, 0, "trim"),
        Turned(cx, cz, tuple((foot + t * tall, x * r) for t, x in robe)),
        Turned(cx, cz + 0.06 * r, tuple((foot + t * tall, x * r) for t, x in head)),
        *arm(-1), *arm(1),
    ]  # fmt: skip
    return tuple(parts)


def _limb(*joints: tuple[tuple[float, float, float], float]) -> Part:
    """A bar of eight sides through places, as thick at each as told, its ends level."""
    loops = [
        [(x + r * cos(pi * k / 4), y, z + r * sin(pi * k / 4)) for k in range(8)] for (x, y, z), r in joints
    ]
    return lofted(*loops, round=True)


def stair(w: float, h: float, d: float, *, risers: int = 0, cheeks: str = "yes") -> tuple[Part, ...]:
    """A flight of steps towards the viewer, between cheek walls."""
    count = risers or steps_of(h)
    side = min(0.3, 0.1 * w) if cheeks == "yes" else 0.0
    rise, tread = h / count, d / count
    lip = min(0.025, 0.15 * tread, 0.15 * rise)
    parts: list[Part] = []
    for i in range(count):
        y, z = i * rise, -i * tread
        parts += [
            Block(side, y, w - side, y + rise - lip, -d, z - lip),
            Block(side, y + rise - lip, w - side, y + rise, -d, z, "tread"),
        ]
    if side:
        foot = min(h, 1.6 * rise)
        profile = [(0.0, -d), (0.0, 0.0), (foot, 0.0), (h, -d * (1 - foot / h) * 0.98), (h, -d)]
        if foot >= h:
            profile = [(0.0, -d), (0.0, 0.0), (h, 0.0), (h, -d)]
        for x0, x1 in ((0.0, side), (w - side, w)):
            parts.append(
                lofted([(x0, y, z) for y, z in profile], [(x1, y, z) for y, z in profile], slot="cheek")
            )
    return tuple(parts)


def steps_of(h: float) -> int:
    """How many steps of usual height a flight has."""
    return max(1, min(80, ceil(h / 0.17 - 1e-6)))


def stair_stand(w: float, h: float, risers: int = 0) -> float:
    """How far a flight comes forward by itself."""
    return 0.29 * (risers or steps_of(h))
