"""Plain stand-ins of the styles: the same interface, walls of one colour with windows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from math import ceil

from ..texture import Grammar

__all__ = ["STYLES", "Style", "town_grammar"]


@dataclass(frozen=True, slots=True)
class Style:
    """How the façades of a kind of house are made.

    Attributes
    ----------
    name
        Of the style.
    ground, storey, top
        Metres: what the ground floor takes at the foot, about a floor, what a cornice takes at the top.
    storeys
        The least and the most that suit it.
    roofs
        Kinds of roofs with their weights.
    starts
        The rule to begin with on each face.
    narrow
        Metres from which a wall has room for bays of its own beside both corners.
    least
        Metres below which it has no room for a window.
    looks
        How many façades that look different its first random choice makes.
    widths, heights
        For a solved façade: from what to what its front may be stretched, metres. None: any.
    """

    name: str
    ground: float
    storey: float
    top: float
    storeys: tuple[int, int]
    roofs: tuple[tuple[str, float], ...]
    starts: Mapping[str, str] = field(hash=False)
    narrow: float = 7.0
    least: float = 2.5
    looks: int = 6
    widths: tuple[float, float] | None = None
    heights: tuple[float, float] | None = None

    def eaves(self, storeys: int) -> float:
        """Height of the wall with so many storeys, metres."""
        return self.ground + (storeys - 1) * self.storey + self.top

    def fit(self, eaves: float) -> int:
        """How many storeys the grammar makes on a wall of a height."""
        if self.heights is not None:
            return self.storeys[0] if self.heights[0] <= eaves <= self.heights[1] else 0
        rest = round(eaves - self.ground - self.top, 6)
        return 1 + (max(1, ceil(round(rest / self.storey, 4))) if rest > 0 else 0)

    def suits(self, width: float, eaves: float) -> bool:
        """Whether a front of that size can be drawn."""
        if self.fit(eaves) == 0 or width < self.least:
            return False
        return self.widths is None or self.widths[0] <= width <= self.widths[1]


_FACES = ("front", "street", "side", "court", "party", "gable", "roof", "flat", "plain")
_SHORT = ("short-front", "short-street", "short-side", "short-court")


def _style(
    name: str, ground: float, storey: float, top: float, storeys: tuple[int, int], **roofs: float
) -> Style:
    prefix = name.title().replace("-", "")
    return Style(
        name,
        ground,
        storey,
        top,
        storeys,
        tuple(roofs.items()),
        {face: f"{prefix}_{face}".replace("-", "_") for face in _FACES + _SHORT},
    )


STYLES: tuple[Style, ...] = (
    _style("gruenderzeit", 4.5, 3.6, 0.9, (3, 6), gable=5.0, mansard=4.0, flat=1.0),
    _style("slab", 3.0, 2.8, 0.6, (3, 14), flat=1.0),
    _style("half-timbered", 3.0, 2.6, 0.3, (2, 4), gable=1.0),
    _style("brickworks", 4.5, 4.0, 0.8, (1, 5), shed=3.0, flat=2.0, gable=1.0),
    _style("detached", 3.0, 2.7, 0.3, (1, 2), gable=5.0, hip=3.0, shed=0.5),
    _style("shop-street", 4.5, 3.3, 0.8, (3, 6), flat=2.0, gable=3.0, mansard=3.0),
    replace(
        _style("solved-15", 3.7, 2.9, 0.4, (6, 6), flat=1.0),
        looks=1,
        widths=(14.0, 16.0),
        heights=(17.7, 19.5),
    ),
    replace(
        _style("solved-18", 3.5, 3.1, 0.3, (3, 3), flat=1.0),
        looks=1,
        widths=(17.0, 19.0),
        heights=(9.5, 10.5),
    ),
)
"""All styles."""

_TINTS = (
    "0.8, 0.75, 0.6",
    "0.7, 0.7, 0.7",
    "0.75, 0.5, 0.4",
    "0.6, 0.65, 0.6",
    "0.85, 0.8, 0.75",
    "0.55, 0.4, 0.35",
)


@lru_cache(maxsize=1)
def town_grammar() -> Grammar:
    """All styles and the ground's rules in one grammar."""
    lines = ["Glass -> Mat(Color, 0, 0.2, 0.25, 0.3, 1)", "None -> Skip(0)"]
    lines += [f"Tint{k} -> Mat(Color, 0, {tint}, 1)" for k, tint in enumerate(_TINTS)]
    lines.append(f"Wall -> RandUni(0, {', '.join(f'Tint{k}' for k in range(len(_TINTS)))})")
    lines.append("Tile -> Mat(Color, 0, 0.5, 0.25, 0.2, 1)")
    lines.append("Lead -> Mat(Color, 0, 0.45, 0.45, 0.45, 1)")
    lines.append("Window -> SplitX(Rel, 1, None, Rel, 1, Glass, Rel, 1, None)")
    lines.append("Bay -> SplitY(Rel, 1, None, Rel, 2, Window, Rel, 1, None)")
    lines.append("Floor -> RepeatX(2, Bay)")
    for style in STYLES:
        prefix = style.name.title().replace("-", "")
        lines.append(f"{prefix}_floors -> RepeatY({style.storey}, Floor)")
        lines.append(
            f"{prefix}_rows -> SplitY(Abs, {style.ground}, Floor, Rel, 1, {prefix}_floors, Abs, {style.top}, None)"
        )
        for face in _FACES + _SHORT:
            plain = {"roof": "Tile", "flat": "Lead"}.get(face, "Wall")
            windows = face in ("front", "street", "side", "court", *_SHORT)
            body = f"Layer({plain}, {prefix}_rows)" if windows else f"Layer({plain})"
            lines.append(
                f"{prefix}_{face} -> {body}".replace("-f", "_f").replace("-s", "_s").replace("-c", "_c")
            )
    tints = {"Asphalt": "0.3, 0.3, 0.32", "Pavement": "0.6, 0.6, 0.58", "Court": "0.55, 0.52, 0.47"}
    tints["Grass"] = "0.35, 0.5, 0.25"
    ground = "\n".join(f"  {kind} -> Mat(Color, 0, {tint}, 1)" for kind, tint in tints.items())
    lines.append(f"namespace ground {{\n{ground}\n}}")
    return Grammar.parse("\n".join(lines))
