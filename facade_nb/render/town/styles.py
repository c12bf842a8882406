"""Plain stand-ins of the styles: the same interface, walls of one colour with windows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from math import ceil

from ..texture import Grammar

__all__ = ["GROUND", "STYLES", "Style", "town_grammar"]


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
        Metres below which a wall is plain.
    looks
        How many façades that look different its first random choice makes.
    """

    name: str
    ground: float
    storey: float
    top: float
    storeys: tuple[int, int]
    roofs: tuple[tuple[str, float], ...]
    starts: Mapping[str, str] = field(hash=False)
    narrow: float = 2.5
    looks: int = 6

    def eaves(self, storeys: int) -> float:
        """Height of the wall with so many storeys, metres."""
        return self.ground + (storeys - 1) * self.storey + self.top

    def fit(self, eaves: float) -> int:
        """How many storeys the grammar makes on a wall of a height."""
        rest = round(eaves - self.ground - self.top, 6)
        return 1 + (max(1, ceil(round(rest / self.storey, 4))) if rest > 0 else 0)


_FACES = ("front", "street", "side", "court", "party", "gable", "roof", "flat", "plain")
GROUND: Mapping[str, str] = {kind: f"Ground_{kind}" for kind in ("asphalt", "pavement", "court", "grass")}
"""The rule for each kind of ground."""


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
        {face: f"{prefix}_{face}" for face in _FACES},
    )


STYLES: tuple[Style, ...] = (
    _style("gruenderzeit", 4.5, 3.6, 0.9, (3, 6), gable=5.0, mansard=4.0, flat=1.0),
    _style("slab", 3.0, 2.8, 0.6, (3, 14), flat=1.0),
    _style("half-timbered", 3.0, 2.6, 0.3, (2, 4), gable=1.0),
    _style("brickworks", 4.5, 4.0, 0.8, (1, 5), shed=3.0, flat=2.0, gable=1.0),
    _style("detached", 3.0, 2.7, 0.3, (1, 2), gable=5.0, hip=3.0, shed=0.5),
    _style("shop-street", 4.5, 3.3, 0.8, (3, 6), flat=2.0, gable=3.0, mansard=3.0),
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
        for face in _FACES:
            plain = {"roof": "Tile", "flat": "Lead"}.get(face, "Wall")
            windows = face in ("front", "street", "side", "court")
            body = f"Layer({plain}, {prefix}_rows)" if windows else f"Layer({plain})"
            lines.append(f"{prefix}_{face} -> {body}")
    for kind, tint in {
        "asphalt": "0.3, 0.3, 0.32",
        "pavement": "0.6, 0.6, 0.58",
        "court": "0.55, 0.52, 0.47",
        "grass": "0.35, 0.5, 0.25",
    }.items():
        lines.append(f"Ground_{kind} -> Mat(Color, 0, {tint}, 1)")
    return Grammar.parse("\n".join(lines))
