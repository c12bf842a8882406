"""Parts as ink: how each is drawn, and the definitions (patterns, gradients, repeated shapes) that it needs."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING, Any

from .materials import DEFAULT_MATERIAL, Material, mix
from .parts import Block, Loft, Moulding, Part, Point, Polyhedron, Prism, Ring, Turned, front, outline
from .ruled import is_rule, material_of, rule_fault, rule_png
from .scene import Solid
from .silhouette import covered, shade_on, silhouette
from .style import FINE, LIGHT, MEDIUM, Style, num, pattern

if TYPE_CHECKING:
    from .annotate import Frame

__all__ = ["Defs", "clip", "draw_parts", "hull", "polygon_path"]

_SLOPES = frozenset({"hip", "pitched"})
"""Roofs of a single slope in front: drawn flat, their faces unshaded."""

_IN_ORDER = frozenset({"bay", "hipped", "mansard"})
"""Geometries that list their parts back to front: their surfaces lean, so where one comes nearest tells nothing."""

_SUN = (-0.404, 0.551, 0.730)
"""Direction to the light of the drawing: surfaces that lean get their tone from it. A wall has its material's."""

_MANY = 60
"""From so many faces on a body is drawn with tones, and with lines along its sharp edges alone."""

_SHARP = 0.8
"""Cosine of the angle between faces that meet at a sharp edge."""

_SHADED = frozenset({"body", "back", "glass", "front"})
"""Slots of surfaces on which parts in front throw shadow."""


class Defs:
    """The definitions of one drawing. Ids carry its prefix, so that drawings on one page keep theirs apart."""

    def __init__(self, prefix: str, style: Style, scale: float, anchor: Point, library: str = "") -> None:
        self.library = library
        self.prefix, self.style, self.scale, self.anchor = prefix, style, scale, anchor
        self._made: dict[str, str] = {}
        self._paints: dict[tuple[str, str], str] = {}
        self._blocks: dict[str, str] = {}
        self._shapes: dict[tuple[object, ...], str] = {}

    def __iter__(self) -> Iterator[str]:
        return iter(self._made.values())

    def __str__(self) -> str:
        return "".join(self)

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

    def material(self, name: str) -> Material:
        """A material by its name; a rule has its mean colour."""
        return material_of(self.library, name)

    def drawable(self, name: str) -> bool:
        """Whether a material is a rule that can be drawn."""
        return is_rule(name) and rule_fault(self.library, name, "") is None

    def ruled(self, solid: Solid, origin: Point) -> str:
        """A value for ``fill`` that draws the rule of a solid in its rectangle, whose lower left corner is given."""
        left, bottom, right, top = solid.rect
        size = (round(right - left, 4), round(top - bottom, 4))
        name = solid.materials["body"]
        key = ("rule", name, size, num(origin[0]), num(origin[1]))
        if key not in self._shapes:
            self._shapes[key] = own = f"{self.prefix}-rule{len(self._shapes)}"
            w, h = num(size[0] * self.scale), num(size[1] * self.scale)
            x, y = num(origin[0]), num(origin[1] - size[1] * self.scale)
            place = f'patternUnits="userSpaceOnUse" x="{x}" y="{y}" width="{w}" height="{h}"'
            self._made[own] = f'<pattern id="{own}" {place}>{self._picture(name, size)}</pattern>'
        return f"url(#{self._shapes[key]})"

    def _picture(self, name: str, size: tuple[float, float]) -> str:
        """The picture of a rule with its upper left corner at the origin; it is held once."""
        key = ("picture", name, size)
        if key not in self._shapes:
            self._shapes[key] = own = f"{self.prefix}-picture{len(self._shapes)}"
            data = b64encode(rule_png(self.library, name, size, round(1.5 * self.scale, 3))).decode()
            w, h = num(size[0] * self.scale), num(size[1] * self.scale)
            veil = ""
            if self.style.dim:
                veil = f'<rect width="{w}" height="{h}" fill="{self.style.veil}" fill-opacity="{self.style.dim}"/>'
            self._made[own] = (
                f'<g id="{own}"><image width="{w}" height="{h}" preserveAspectRatio="none" '
                f'href="data:image/png;base64,{data}"/>{veil}</g>'
            )
        return f'<use href="#{self._shapes[key]}"/>'

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

    def plain(self, solid: Solid, frame: Frame) -> str:
        """What a plain block is filled with, and its seam: values of attributes, the first without its name."""
        name = solid.materials["body"]
        if is_rule(name) and self.drawable(name) and solid.parts:
            return f'"{self.ruled(solid, frame.at(*solid.rect[:2]))}"{self._seam(self.material(name))}'
        found = self._blocks.get(name)
        if found is None:
            material = self.material(name)
            found = self._blocks[name] = f'"{self.paint(material)}"{self._seam(material)}'
        return found

    def _seam(self, material: Material) -> str:
        if (
            material.name == DEFAULT_MATERIAL
        ):  # nothing was said yet: the grid of the layer is all there is to see
            return f' stroke="{self.style.tone(material.line)}" stroke-width=".8"'
        return (
            ""
            if material.pattern == "glass"
            else f' stroke="{self.style.tone(material.fill)}" stroke-width=".5"'
        )

    def shape(self, solid: Solid, width: str, height: str) -> str:
        """The drawing of a shape with its upper left corner at the origin, as the id of a definition, made once.

        Width and height are in pixels, as they are written.
        """
        shape = solid.shape
        key = (shape.geometry, solid.materials["body"], width, height, num(solid.depth * 50), shape.mirrored)
        name = self._shapes.get(key)
        if name is None:
            name = self._shapes[key] = f"{self.prefix}-{len(self._shapes)}"
            body = draw_parts(solid, self, (0.0, (shape.rect[3] - shape.rect[1]) * self.scale))
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
    return solid.geometry.runs_on


def draw_parts(solid: Solid, defs: Defs, origin: Point) -> str:
    """All parts of a solid, back to front, with the shape's lower left corner at the pixel `origin`."""
    pen = _Pen(solid, defs, origin)
    ordered = list(solid.parts) if solid.geometry.name in _IN_ORDER else sorted(solid.parts, key=front)
    drawn = "".join(
        pen.draw(list(same)) for _, same in groupby(ordered, key=lambda p: (type(p), p.slot, front(p)))
    )
    return drawn + pen.outlined() if solid.geometry.modelled else drawn


class _Pen:
    def __init__(self, solid: Solid, defs: Defs, origin: Point) -> None:
        self.solid, self.defs, self.style = solid, defs, defs.style
        self.scale = defs.scale
        self.x0, self.y0 = origin

    def at(self, x: float, y: float) -> Point:
        return self.x0 + x * self.scale, self.y0 - y * self.scale

    def draw(self, parts: Sequence[Part]) -> str:
        """Parts of one kind, material and depth, as one path where that can be."""
        material = self.defs.material(self.solid.materials[parts[0].slot])
        first = parts[0]
        if isinstance(first, Turned):
            return "".join(self._turned(part, material) for part in parts if isinstance(part, Turned))
        if isinstance(first, Moulding):
            return "".join(self._moulding(part, material) for part in parts if isinstance(part, Moulding))
        modelled = self.solid.geometry.modelled
        if isinstance(first, Loft | Polyhedron) and self.solid.geometry.name not in _SLOPES:
            return self._facets([part for part in parts if isinstance(part, Loft | Polyhedron)], material)
        merged = modelled and isinstance(first, Prism) and first.slot in ("body", "trim") and len(parts) > 1
        d = self._shapes(covered(parts)) if merged else "".join(self._outline(part) for part in parts)
        fill = self._surface(material) if self._wide(parts) else self.style.tone(material.fill)
        text = self._path(d, fill, self.style.tone(material.line), rule=merged or isinstance(first, Ring))
        if merged and first.slot == "body":
            text += f'<path d="{d}" stroke="{self.style.ink}" stroke-width="{MEDIUM}" fill="none"/>'
        if first.slot == "glass":
            text += "".join(self._reflections(part) for part in parts)
        if first.slot == "gable":
            text += self._under_the_verge(parts)
        if modelled and first.slot in _SHADED:
            text += self._shade(parts)
        if isinstance(first, Loft | Polyhedron):
            text += f'<path d="{d}" stroke="{self.style.ink}" stroke-width="{MEDIUM}" fill="none"/>'
        if self.solid.geometry.name == "roof" and isinstance(first, Prism) and first.z1 > 0.1:
            text += self._verge(parts, tiled=first.slot == "body")
        return text

    def _wide(self, parts: Sequence[Part]) -> bool:
        """Whether there is room for the material's pattern: joinery, rails and verges are plain."""
        slot = parts[0].slot
        geometry = self.solid.geometry
        if self.defs.drawable(self.solid.materials[slot]):
            return True
        if slot in ("glass", "gable", "upper"):
            return True
        return slot in ("body", "back") and (geometry.runs_on or geometry.name == "pilaster")

    def _surface(self, material: Material) -> str:
        """What covers a surface: the material's pattern, or the rule that the shape is drawn by."""
        if self.defs.drawable(material.name):
            return self.defs.ruled(self.solid, (self.x0, self.y0))
        return self.defs.paint(material)

    def _facets(self, parts: Sequence[Loft | Polyhedron], material: Material) -> str:
        """Bodies with plane faces: each face toned by how it lies to the light."""
        fill, line = self.style.tone(material.fill), self.style.tone(material.line)
        text = ""
        for part in parts:
            if len(part.faces) > _MANY:
                text += self._carving(part, material)
                continue
            for face in part.faces:
                spots = [part.points[i] for i in face]
                if _area([spot[:2] for spot in spots]) <= 1e-6:
                    continue
                lit = sum(a * b for a, b in zip(_normal(spots), _SUN, strict=True)) - _SUN[2]
                d = polygon_path([self.at(x, y) for x, y, _ in spots])
                if self._wide(parts):
                    text += self._path(d, self._surface(material), line)
                    veil = ("#ffffff", 0.5 * lit) if lit > 0 else (self.style.shadow, -0.38 * lit)
                    text += f'<path d="{d}" fill="{veil[0]}" fill-opacity="{num(min(veil[1], 0.6))}"/>'
                else:
                    tone = (
                        mix(fill, "#ffffff", min(1.1 * lit, 0.6))
                        if lit > 0
                        else mix(fill, line, min(-lit, 0.8))
                    )
                    text += self._path(d, tone, line)
        return text

    def _carving(self, part: Loft | Polyhedron, material: Material) -> str:
        """A body of many faces, far ones first: tones by how they lie to the light, lines along its sharp edges."""
        fill, line = self.style.tone(material.fill), self.style.tone(material.line)
        normals = [_normal([part.points[i] for i in face]) for face in part.faces]
        across: dict[frozenset[int], list[int]] = {}
        for k, face in enumerate(part.faces):
            for edge in zip(face, [*face[1:], face[0]], strict=True):
                across.setdefault(frozenset(edge), []).append(k)
        seen = [k for k, normal in enumerate(normals) if normal[2] > 1e-6]
        seen.sort(key=lambda k: sum(part.points[i][2] for i in part.faces[k]) / len(part.faces[k]))
        text, lines, before = "", "", ""
        d = ""
        for k in seen:
            face = part.faces[k]
            lit = round(12 * (sum(a * b for a, b in zip(normals[k], _SUN, strict=True)) - _SUN[2])) / 12
            tone = mix(fill, "#ffffff", min(1.1 * lit, 0.6)) if lit > 0 else mix(fill, line, min(-lit, 0.8))
            sharp = [
                edge
                for edge in zip(face, [*face[1:], face[0]], strict=True)
                if any(
                    sum(a * b for a, b in zip(normals[k], normals[other], strict=True)) < _SHARP
                    for other in across[frozenset(edge)]
                )
            ]
            if before and (tone != before or sharp):
                text += self._path_of(d, before)
                d = ""
            before = tone
            d += polygon_path([self.at(*part.points[i][:2]) for i in face])
            if sharp:
                text, d = text + self._path_of(d, tone), ""
                lines = "".join(
                    "M{}L{}".format(*(" ".join(map(num, self.at(*part.points[i][:2]))) for i in edge))
                    for edge in sharp
                )
                text += f'<path d="{lines}" stroke="{line}" stroke-width="{FINE}" fill="none"/>'
        return text + (self._path_of(d, before) if d else "")

    @staticmethod
    def _path_of(d: str, tone: str) -> str:
        return f'<path d="{d}" fill="{tone}" stroke="{tone}" stroke-width=".4"/>' if d else ""

    def _shade(self, parts: Sequence[Part]) -> str:
        """The shadow of what is in front within the shape, on parts of one depth."""
        opening = None
        if self.solid.geometry.cuts and not self.solid.geometry.full:
            opening = max(silhouette(self.solid.parts), key=len) if self._lies_back() else None
        shade = self._shapes(shade_on(tuple(parts), self.solid.parts, LIGHT, opening))
        if not shade:
            return ""
        opacity = min(1.3 * self.style.shade, 0.6)
        return (
            f'<path d="{shade}" fill="{self.style.shadow}" fill-opacity="{opacity:.2f}" fill-rule="evenodd"/>'
        )

    def _lies_back(self) -> bool:
        """Whether the surface of the shape lies behind its face, in a hole of the wall."""
        return self.solid.geometry.recess(self.solid.depth) > 0

    def _shapes(self, whole: Any) -> str:
        """A shapely geometry as a path; fill it with the even-odd rule."""
        return "".join(
            polygon_path([self.at(x, y) for x, y in ring.coords[:-1]])
            for piece in getattr(whole, "geoms", [whole])
            if piece.geom_type == "Polygon" and not piece.is_empty
            for ring in (piece.exterior, *piece.interiors)
        )

    def outlined(self) -> str:
        """The line around all that is seen of the shape."""
        d = self._shapes(covered(self.solid.parts))
        return f'<path d="{d}" stroke="{self.style.ink}" stroke-width="{MEDIUM}" stroke-linejoin="round" fill="none"/>'

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
            case Loft() | Polyhedron():
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
        if 12 < w < 2.6 * self.scale and h > 14 and self.solid.geometry.name in ("window", "dormer"):
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
    return "M" + "L".join([f"{num(x)} {num(y)}" for x, y in points]) + "z"


def _normal(spots: Sequence[tuple[float, float, float]]) -> tuple[float, float, float]:
    """The unit normal of a plane polygon (Newell)."""
    total = [0.0, 0.0, 0.0]
    for p, q in zip(spots, [*spots[1:], spots[0]], strict=True):
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            total[k] += (p[i] - q[i]) * (p[j] + q[j])
    size = sum(v * v for v in total) ** 0.5 or 1.0
    x, y, z = (v / size for v in total)
    return x, y, z


def _area(points: Sequence[Sequence[float]]) -> float:
    return sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(points, [*points[1:], points[0]], strict=True)) / 2


def clip(points: Sequence[Point], box: tuple[float, float, float, float]) -> list[Point]:
    """A convex polygon cut to the box x0, y0, x1, y1 (Sutherland and Hodgman)."""
    x0, y0, x1, y1 = box
    result = list(points)
    for axis, limit, sign in ((0, x0, 1), (0, x1, -1), (1, y0, 1), (1, y1, -1)):
        if not result:
            break
        values = [point[axis] for point in result]
        if min(values) >= limit if sign > 0 else max(values) <= limit:
            continue  # all of it is on this side
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
