"""The look of a drawing: paper and ink, line weights, the way light falls, and the patterns of materials."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from math import ceil
from types import MappingProxyType

from ..design.errors import nearest
from .materials import Material, mix

__all__ = ["FINE", "HEAVY", "LIGHT", "MEDIUM", "THEMES", "Style", "find_style", "num", "pattern"]

HEAVY, MEDIUM, FINE = 1.5, 0.8, 0.4
"""Line weights in pixels: the outline, edges in depth, details."""

LIGHT = (0.55, 0.75)
"""Shadow of a point 1 m in front: metres to the right, metres down. The light comes from the upper left."""


@dataclass(frozen=True, slots=True)
class Style:
    """Colours of a theme. `veil` and `dim` say towards which colour, and how far, materials are drawn."""

    name: str
    paper: str
    ink: str
    faint: str
    shadow: str
    shade: float
    accent: str
    second: str
    veil: str
    dim: float

    def tone(self, code: str) -> str:
        """A material's colour on this paper."""
        return mix(code, self.veil, self.dim) if self.dim else code


THEMES: Mapping[str, Style] = MappingProxyType(
    {
        "light": Style(
            "light", "#fbfaf6", "#3a3631", "#8f897e", "#2b2620", 0.24, "#c2410c", "#0b6e99", "#fbfaf6", 0.0
        ),
        "dark": Style(
            "dark", "#1e2227", "#0f1113", "#9aa1a9", "#050608", 0.36, "#ff9a62", "#62c6f2", "#23272d", 0.3
        ),
    }
)
"""The themes by name."""


def find_style(theme: str) -> Style:
    """The theme of that name. Raises ValueError for an unknown one."""
    if theme not in THEMES:
        raise ValueError(
            f"theme: expected one of {', '.join(THEMES)}; found {theme!r}{nearest(theme, THEMES)}"
        )
    return THEMES[theme]


def num(value: float) -> str:
    """A coordinate in pixels, to a hundredth, as short as it gets."""
    return _num(value) if value else f"{value:g}"  # to a cache both zeros are one


@lru_cache(maxsize=1 << 14)
def _num(value: float) -> str:
    return f"{round(value, 2):g}"


def pattern(name: str, material: Material, style: Style, scale: float, anchor: tuple[float, float]) -> str:
    """The SVG pattern `name` that covers a surface with a material, its joints at least some pixels apart.

    `scale` is in pixels per metre; `anchor` is the pixel where the façade's lower left corner lies.
    """
    fill, line = style.tone(material.fill), style.tone(material.line)
    w, h, body = _PATTERNS[material.pattern](scale, fill, line)
    x, y = anchor
    return (
        f'<pattern id="{name}" width="{num(w)}" height="{num(h)}" patternUnits="userSpaceOnUse" '
        f'patternTransform="translate({num(x)} {num(y)})">'
        f'<rect width="{num(w + 1)}" height="{num(h + 1)}" fill="{fill}"/>{body}</pattern>'
    )


_Tile = tuple[float, float, str]


def _coarse(size: float, scale: float, least: float) -> float:
    """`size` metres in pixels, or the smallest multiple of it that is at least `least` pixels."""
    pixels = size * scale
    return pixels * max(1, ceil(least / pixels))


def _brick(scale: float, fill: str, line: str) -> _Tile:
    course = _coarse(0.075, scale, 4.2)
    brick = 3.1 * course
    w, h = 4 * brick, 4 * course
    tints = "".join(
        f'<rect x="{num(x * brick)}" y="{num(y * course)}" width="{num(brick)}" height="{num(course)}" '
        f'fill="{mix(fill, colour, share)}"/>'
        for x, y, colour, share in (
            (0, 0, line, 0.22), (2, 0, "#ffffff", 0.06), (1.5, 1, line, 0.14), (3, 2, line, 0.22),
            (1, 2, "#ffffff", 0.08), (0.5, 3, line, 0.1), (2.5, 3, "#ffffff", 0.05),
        )
    )  # fmt: skip
    d = "".join(f"M0 {num(y * course)}H{num(w)}" for y in range(4))
    d += "".join(
        f"M{num((x + (0.5 if y % 2 else 0)) * brick)} {num(y * course)}v{num(course)}"
        for y in range(4)
        for x in range(4)
    )
    return w, h, f'{tints}<path d="{d}" stroke="{mix(fill, "#fff8ea", 0.42)}" stroke-width=".5" fill="none"/>'


def _ashlar(scale: float, fill: str, line: str) -> _Tile:
    course = _coarse(0.32, scale, 9)
    block = 2.1 * course
    w, h = 2 * block, 2 * course
    tint = f'<rect width="{num(block)}" height="{num(course)}" fill="{mix(fill, line, 0.1)}"/>'
    tint += (
        f'<rect x="{num(1.5 * block)}" y="{num(course)}" width="{num(block / 2)}" height="{num(course)}" '
        f'fill="{mix(fill, "#ffffff", 0.16)}"/>'
    )
    d = f"M0 0H{num(w)}M0 {num(course)}H{num(w)}M0 0v{num(course)}M{num(block)} 0v{num(course)}"
    d += f"M{num(block / 2)} {num(course)}v{num(course)}M{num(1.5 * block)} {num(course)}v{num(course)}"
    return w, h, f'{tint}<path d="{d}" stroke="{line}" stroke-opacity=".55" stroke-width=".45" fill="none"/>'


def _tiles(scale: float, fill: str, line: str) -> _Tile:
    course = _coarse(0.16, scale, 6)
    wide = 0.8 * course
    w, h = 2 * wide, 2 * course
    d = "".join(
        f"M{num(x * wide)} {num(y * course + 0.55 * course)}q{num(wide / 2)} {num(0.9 * course)} {num(wide)} 0"
        for y, xs in ((0, (0, 1)), (1, (-0.5, 0.5, 1.5)))
        for x in xs
    )
    tint = f'<rect width="{num(wide)}" height="{num(course)}" fill="{mix(fill, line, 0.16)}"/>'
    return w, h, f'{tint}<path d="{d}" stroke="{line}" stroke-opacity=".75" stroke-width=".55" fill="none"/>'


def _slates(scale: float, fill: str, line: str) -> _Tile:
    course = _coarse(0.16, scale, 5.5)
    wide = 1.5 * course
    w, h = 2 * wide, 2 * course
    tint = f'<rect width="{num(wide)}" height="{num(course)}" fill="{mix(fill, "#ffffff", 0.06)}"/>'
    d = f"M0 0H{num(w)}M0 {num(course)}H{num(w)}M0 0v{num(course)}M{num(wide)} 0v{num(course)}"
    d += f"M{num(wide / 2)} {num(course)}v{num(course)}M{num(1.5 * wide)} {num(course)}v{num(course)}"
    return w, h, f'{tint}<path d="{d}" stroke="{line}" stroke-opacity=".6" stroke-width=".45" fill="none"/>'


def _boards(scale: float, fill: str, line: str) -> _Tile:
    board = _coarse(0.14, scale, 5)
    w, h = 3 * board, 8 * board
    tint = f'<rect x="{num(board)}" width="{num(board)}" height="{num(h)}" fill="{mix(fill, line, 0.12)}"/>'
    d = "".join(f"M{num(i * board)} 0V{num(h)}" for i in range(3))
    return w, h, f'{tint}<path d="{d}" stroke="{line}" stroke-opacity=".6" stroke-width=".5" fill="none"/>'


def _seams(scale: float, fill: str, line: str) -> _Tile:
    seam = _coarse(0.5, scale, 8)
    light = f'<path d="M.9 0V20" stroke="{mix(fill, "#ffffff", 0.45)}" stroke-width=".7"/>'
    return seam, 20, f'{light}<path d="M0 0V20" stroke="{line}" stroke-opacity=".7" stroke-width=".7"/>'


def _speckle(scale: float, fill: str, line: str) -> _Tile:
    dots = "".join(
        f"M{x} {y}h.8"
        for x, y in (
            (2, 3),
            (9, 1.5),
            (15, 7),
            (5, 9),
            (11, 12),
            (19, 15),
            (3, 17),
            (14, 19),
            (8, 21),
            (20, 4),
        )
    )
    return 23, 23, f'<path d="{dots}" stroke="{line}" stroke-opacity=".45" stroke-width=".8"/>'


def _grain(scale: float, fill: str, line: str) -> _Tile:
    dots = "".join(
        f"M{x} {y}h.7" for x, y in ((3, 5), (17, 2), (29, 9), (9, 18), (23, 22), (35, 27), (5, 31), (16, 36))
    )
    return 39, 39, f'<path d="{dots}" stroke="{line}" stroke-opacity=".3" stroke-width=".7"/>'


_PATTERNS: Mapping[str, Callable[[float, str, str], _Tile]] = {
    "brick": _brick,
    "ashlar": _ashlar,
    "tiles": _tiles,
    "slates": _slates,
    "boards": _boards,
    "seams": _seams,
    "speckle": _speckle,
    "grain": _grain,
}
