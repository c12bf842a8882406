"""Parts as ink: how each is drawn, and the definitions (patterns, gradients, repeated shapes) that it needs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby

from .materials import Material, find_material, mix
from .parts import Block, Moulding, Part, Point, Polyhedron, Prism, Ring, Turned, front, outline
from .scene import Solid
from .style import FINE, LIGHT, MEDIUM, Style, num, pattern

__all__ = ["Defs", "clip", "draw_parts", "hull", "polygon_path"]

_INLINE = frozenset({"arch", "panel", "hip", "pitched"})
"""Geometries whose surface continues the courses of their neighbours: drawn in place, not as a repeated symbol."""


class Defs:
    """The definitions of one drawing. Ids carry its prefix, so that drawings on one page keep theirs apart."""

    def __init__(self, prefix: str, style: Style, scale: float, anchor: Point) -> None:
        self.prefix, self.style, self.scale, self.anchor = prefix, style, scale, anchor
        self._made: dict[str, str] = {}
        self._paints: dict[tuple[str, str], str] = {}
        self._shapes: dict[tuple[object, ...], str] = {}

    def __str__(self) -> str:
        return "".join(self._made.values())

    def paint(self, material: Material) -> str:
        """A value for ``fill`` that covers a surface with the material."""
        key = ("surface", material.name)
        found = self._paints.get(key)
        if found is None:
            if material.pattern == "glass":
                found = self._gradient("glass", self._glass_stops(material), "0 0 .35 1")
            elif material.pattern:
                name = f"{self.prefix}-{material.name}"
                self._made[name] = pattern(name, material, self.style, self.scale, self.anchor)
                found = f"url(#{name})"
            else:
                found = self.style.tone(material.fill)
            self._paints[key] = found
        return found

    def round(self, material: Material) -> str:
        """A value for ``fill`` that makes a surface look round about a vertical axis."""
        key = ("round", material.name)
        if key not in self._paints:
            fill = self.style.tone(material.fill)
            dark = self.style.tone(material.line)
            stops = (
                (0, mix(fill, dark, 0.35)),
                (0.28, mix(fill, "#ffffff", 0.4)),
                (0.62, fill),
                (1, mix(fill, dark, 0.85)),
            )
            self._paints[key] = self._gradient(f"round-{material.name.lstrip('#')}", stops, "0 0 1 0")
        return self._paints[key]

    def shape(self, solid: Solid, width: float, height: float) -> str:
        """The drawing of a shape with its upper left corner at the origin, as the id of a definition, made once."""
        shape = solid.shape
        mirrored = shape.mirrored
        key = (
            shape.geometry,
            solid.materials["body"],
            num(width),
            num(height),
            num(solid.depth * 50),
            mirrored,
        )
        name = self._shapes.get(key)
        if name is None:
            name = self._shapes[key] = f"{self.prefix}-{len(self._shapes)}"
            body = draw_parts(solid, self, (0.0, height))
            self._made[name] = f'<g id="{name}">{body}</g>'
        return name

    def _glass_stops(self, material: Material) -> tuple[tuple[float, str], ...]:
        fill = self.style.tone(material.fill)
        return (
            (0, mix(fill, "#ffffff", 0.42)),
            (0.45, fill),
            (1, mix(fill, self.style.tone(material.line), 0.55)),
        )

    def _gradient(self, name: str, stops: Iterable[tuple[float, str]], line: str) -> str:
        name = f"{self.prefix}-{name}"
        x1, y1, x2, y2 = line.split()
        body = "".join(f'<stop offset="{num(at)}" stop-color="{colour}"/>' for at, colour in stops)
        self._made[name] = (
            f'<linearGradient id="{name}" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}">{body}</linearGradient>'
        )
        return f"url(#{name})"


def inline(solid: Solid) -> bool:
    """Whether the shape is drawn in place."""
    return solid.shape.geometry in _INLINE


def draw_parts(solid: Solid, defs: Defs, origin: Point) -> str:
    """All parts of a solid, back to front, with the shape's lower left corner at the pixel `origin`."""
    pen = _Pen(solid, defs, origin)
    ordered = sorted(solid.parts, key=front)
    return "".join(
        pen.draw(list(same)) for _, same in groupby(ordered, key=lambda p: (type(p), p.slot, front(p)))
    )


class _Pen:
    def __init__(self, solid: Solid, defs: Defs, origin: Point) -> None:
        self.solid, self.defs, self.style = solid, defs, defs.style
        self.scale = defs.scale
        self.x0, self.y0 = origin

    def at(self, x: float, y: float) -> Point:
        return self.x0 + x * self.scale, self.y0 - y * self.scale

    def draw(self, parts: Sequence[Part]) -> str:
        """Parts of one kind, material and depth, as one path where that can be."""
        material = find_material(self.solid.materials[parts[0].slot])
        first = parts[0]
        if isinstance(first, Turned):
            return "".join(self._turned(part, material) for part in parts if isinstance(part, Turned))
        if isinstance(first, Moulding):
            return "".join(self._moulding(part, material) for part in parts if isinstance(part, Moulding))
        d = "".join(self._outline(part) for part in parts)
        fill = self.defs.paint(material) if self._wide(parts) else self.style.tone(material.fill)
        text = self._path(d, fill, self.style.tone(material.line), rule=isinstance(first, Ring))
        if first.slot == "glass":
            text += "".join(self._reflections(part) for part in parts)
        if first.slot == "gable":
            text += self._under_the_verge(parts)
        if isinstance(first, Polyhedron):
            text += f'<path d="{d}" stroke="{self.style.ink}" stroke-width="{MEDIUM}" fill="none"/>'
        if self.solid.shape.geometry == "roof" and isinstance(first, Prism) and first.z1 > 0.1:
            text += self._verge(parts, tiled=first.slot == "body")
        return text

    def _wide(self, parts: Sequence[Part]) -> bool:
        """Whether there is room for the material's pattern: joinery, rails and verges are plain."""
        slot = parts[0].slot
        name = self.solid.shape.geometry
        return slot in ("glass", "gable") or (slot == "body" and (name in _INLINE or name == "pilaster"))

    def _path(self, d: str, fill: str, line: str, *, rule: bool = False) -> str:
        even = ' fill-rule="evenodd"' if rule else ""
        return f'<path d="{d}" fill="{fill}" stroke="{line}" stroke-width="{FINE}"{even}/>'

    def _outline(self, part: Part) -> str:
        match part:
            case Block():
                return self._rect(part.x0, part.y0, part.x1, part.y1)
            case Ring():
                t = part.width
                inner = self._rect(part.x0 + t, part.y0 + t, part.x1 - t, part.y1 - t)
                return self._rect(part.x0, part.y0, part.x1, part.y1) + inner
            case Prism():
                return polygon_path([self.at(x, y) for x, y in part.points])
            case Polyhedron():
                return "".join(
                    polygon_path([self.at(*part.points[i][:2]) for i in face])
                    for face in part.faces
                    if _area([part.points[i][:2] for i in face]) > 1e-6
                )
            case _:
                raise TypeError(f"no outline for {type(part).__name__}")

    def _rect(self, x0: float, y0: float, x1: float, y1: float) -> str:
        left, top = self.at(x0, y1)
        return f"M{num(left)} {num(top)}h{num((x1 - x0) * self.scale)}v{num((y1 - y0) * self.scale)}H{num(left)}z"

    def _reflections(self, part: Part) -> str:
        """On glass: a curtain's hint at both sides, two slanting streaks of sky, the shade of the frame."""
        if not isinstance(part, Block):
            return ""
        w, h = (part.x1 - part.x0) * self.scale, (part.y1 - part.y0) * self.scale
        x, y = self.at(part.x0, part.y1)
        text = ""
        if 12 < w < 2.6 * self.scale and h > 14 and self.solid.shape.geometry == "window":
            a, b = min(0.24 * w, 0.3 * self.scale), 0.1 * w
            d = "".join(
                f"M{num(edge)} {num(y)}h{num(way * a)}"
                f"q{num(-way * 0.2 * a)} {num(0.55 * h)} {num(-way * (a - b))} {num(0.8 * h)}"
                f"L{num(edge)} {num(y + 0.94 * h)}z"
                for edge, way in ((x, 1), (x + w, -1))
            )
            text += f'<path d="{d}" fill="#fff" fill-opacity=".34"/>'
        if w > 8 and h > 8:
            d = "".join(
                polygon_path(
                    clip(
                        [
                            (x + (s + t) * w, y),
                            (x + s * w, y),
                            (x + s * w - 0.5 * h, y + h),
                            (x + (s + t) * w - 0.5 * h, y + h),
                        ],
                        (x, y, x + w, y + h),
                    )
                )
                for s, t in ((0.62, 0.2), (0.9, 0.08))
            )
            text += f'<path d="{d}" fill="#fff" fill-opacity=".13"/>'
        deep = 0.07 * self.scale
        right, down = min(deep * LIGHT[0] * 1.6, w / 3), min(deep * LIGHT[1] * 1.6, h / 3)
        d = f"M{num(x)} {num(y)}h{num(w)}v{num(down)}h{num(right - w)}v{num(h - down)}H{num(x)}z"
        return (
            text + f'<path d="{d}" fill="{self.style.shadow}" fill-opacity="{self.style.shade * 1.1:.2f}"/>'
        )

    def _under_the_verge(self, walls: Sequence[Part]) -> str:
        """The shadow of the roof's slabs on the gable behind them."""
        text = ""
        for wall in walls:
            if not isinstance(wall, Prism):
                continue
            field = [self.at(x, y) for x, y in wall.points][::-1]
            for part in self.solid.parts:
                if isinstance(part, Prism) and part.slot == "body":
                    reach = (part.z1 - wall.z1) * self.scale
                    quad = [self.at(x, y) for x, y in part.points]
                    moved = [(x + reach * LIGHT[0], y + reach * LIGHT[1]) for x, y in quad]
                    text += polygon_path(clip_convex(hull([*quad, *moved]), field))
        return (
            f'<path d="{text}" fill="{self.style.shadow}" fill-opacity="{self.style.shade}"/>' if text else ""
        )

    def _verge(self, parts: Sequence[Part], *, tiled: bool) -> str:
        """The outline of the roof's slabs, and on the tiles their ends."""
        d = "".join(self._outline(part) for part in parts)
        text = f'<path d="{d}" stroke="{self.style.ink}" stroke-width="{MEDIUM}" stroke-linejoin="round" fill="none"/>'
        if not tiled:
            return text
        ticks = ""
        for part in parts:
            corners = [self.at(x, y) for x, y in outline(part)]
            (ax, ay), (bx, by), (cx, cy), (ex, ey) = corners
            count = max(2, round(abs(bx - ax) / max(0.2 * self.scale, 7)))
            for i in range(1, count):
                t = i / count
                x, y = ax + t * (bx - ax), ay + t * (by - ay)
                ticks += f"M{num(x)} {num(y)}L{num(ex + t * (cx - ex))} {num(ey + t * (cy - ey))}"
        return (
            text + f'<path d="{ticks}" stroke="{self.style.ink}" stroke-width="{FINE}" stroke-opacity=".6"/>'
        )

    def _turned(self, part: Turned, material: Material) -> str:
        fill, line = self.defs.round(material), self.style.tone(material.line)
        right = [self.at(part.cx + r, y) for y, r in part.profile]
        left = [self.at(part.cx - r, y) for y, r in reversed(part.profile)]
        text = self._path(polygon_path([*right, *left]), fill, line)
        radii = [r for _, r in part.profile]
        rings = ""
        for i in range(1, len(part.profile) - 1):  # a line where the profile turns sharply
            y, r = part.profile[i]
            if abs(radii[i + 1] - 2 * r + radii[i - 1]) > 0.03 * max(radii):
                (x, level), length = self.at(part.cx - r, y), 2 * r * self.scale
                rings += f"M{num(x)} {num(level)}h{num(length)}"
        return (
            text
            + f'<path d="{rings}" stroke="{line}" stroke-width="{FINE}" stroke-opacity=".7" fill="none"/>'
        )

    def _moulding(self, part: Moulding, material: Material) -> str:
        fill, line = self.style.tone(material.fill), self.style.tone(material.line)
        bands: list[str] = []
        levels = ""
        reach = 0.0  # how far the shadow of what projects above still falls, metres
        for (y0, z0), (y1, z1) in reversed(list(zip(part.profile, part.profile[1:], strict=False))):
            if y1 - y0 < 1e-9:
                reach = max(reach, (max(z0, z1) - min(z0, z1)) * LIGHT[1])
                continue
            lean = (z1 - z0) / (y1 - y0)  # positive: looks down
            colour = (
                mix(fill, line, min(0.75, 0.5 * lean))
                if lean > 0
                else mix(fill, "#ffffff", min(0.6, -0.5 * lean))
            )
            if reach > 0.2 * (y1 - y0):
                colour = mix(colour, line, 0.45)
            reach = max(0.0, reach - (y1 - y0))
            d = self._rect(part.x0, y0, part.x1, y1)
            bands.append(f'<path d="{d}" fill="{colour}" stroke="{colour}" stroke-width=".5"/>')
            x, y = self.at(part.x0, y0)
            levels += f"M{num(x)} {num(y)}h{num((part.x1 - part.x0) * self.scale)}"
        return f'{"".join(bands)}<path d="{levels}" stroke="{line}" stroke-width="{FINE}" fill="none"/>'


def polygon_path(points: Sequence[Point]) -> str:
    """A closed subpath, empty for fewer than three points."""
    if len(points) < 3:
        return ""
    first, *rest = points
    return f"M{num(first[0])} {num(first[1])}" + "".join(f"L{num(x)} {num(y)}" for x, y in rest) + "z"


def _area(points: Sequence[Sequence[float]]) -> float:
    return sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(points, [*points[1:], points[0]], strict=True)) / 2


def clip(points: Sequence[Point], box: tuple[float, float, float, float]) -> list[Point]:
    """A convex polygon cut to the box x0, y0, x1, y1 (Sutherland and Hodgman)."""
    x0, y0, x1, y1 = box
    result = list(points)
    for axis, limit, sign in ((0, x0, 1), (0, x1, -1), (1, y0, 1), (1, y1, -1)):
        if not result:
            break
        kept: list[Point] = []
        before = result[-1]
        was = sign * (before[axis] - limit)
        for point in result:
            now = sign * (point[axis] - limit)
            if (now >= 0) != (was >= 0):
                t = was / (was - now)
                kept.append((before[0] + t * (point[0] - before[0]), before[1] + t * (point[1] - before[1])))
            if now >= 0:
                kept.append(point)
            before, was = point, now
        result = kept
    return result


def clip_convex(points: Sequence[Point], window: Sequence[Point]) -> list[Point]:
    """A convex polygon cut to a convex window, whichever way its corners run."""
    result = list(points)
    inward = 1 if _area(window) > 0 else -1
    for (ax, ay), (bx, by) in zip(window, [*window[1:], window[0]], strict=True):
        kept: list[Point] = []
        for (px, py), (qx, qy) in zip([result[-1], *result[:-1]] if result else [], result, strict=True):
            was = inward * ((bx - ax) * (py - ay) - (by - ay) * (px - ax))
            now = inward * ((bx - ax) * (qy - ay) - (by - ay) * (qx - ax))
            if (now >= 0) != (was >= 0):
                t = was / (was - now)
                kept.append((px + t * (qx - px), py + t * (qy - py)))
            if now >= 0:
                kept.append((qx, qy))
        result = kept
    return result


def hull(points: Iterable[Point]) -> list[Point]:
    """The convex hull, counter-clockwise with y up (Andrew's monotone chain)."""
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return ordered

    def chain(sequence: Iterable[Point]) -> list[Point]:
        done: list[Point] = []
        for p in sequence:
            while len(done) > 1 and (
                (done[-1][0] - done[-2][0]) * (p[1] - done[-2][1])
                - (done[-1][1] - done[-2][1]) * (p[0] - done[-2][0])
                <= 0
            ):
                done.pop()
            done.append(p)
        return done[:-1]

    return chain(ordered) + chain(reversed(ordered))
