"""The styles of the town: what each needs of a building, and one grammar for all (docs/town-styles.md).

>>> from facade_nb.render.town.styles import STYLES
>>> STYLES[0].start("front", 12.0), STYLES[0].start("front", 5.0), STYLES[0].start("front", 1.0)
('gruenderzeit.Front', 'gruenderzeit.ShortFront', 'gruenderzeit.Plain')
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from math import ceil
from types import MappingProxyType

from ... import gallery
from ..texture.grammar import Grammar
from .solved import SOLVED, STRETCH, Solved, solved_text
from .sparing import town_tiles

__all__ = ["GROUND", "STARTS", "STYLES", "Style", "style_text", "town_grammar", "town_text"]

STARTS = ("front", "street", "side", "court", "party", "gable", "roof", "flat", "plain")
"""What a start rule may be for; `Style.starts` has all of them."""


@dataclass(frozen=True, slots=True)
class Style:
    """How houses of a kind look, and what size they must have for it.

    Attributes
    ----------
    name
        Of the style; its text is `style_text(name)`.
    ground
        Height of the ground floor with its base, metres: what the grammar holds back at the foot of a wall.
    storey
        Height of each storey above it.
    top
        Height of the cornice, or of the board below the eaves.
    storeys
        Least and most that suit it.
    roofs
        Kinds of roofs, with weights that add up to 1.
    starts
        For each of `STARTS`, the rule that a wall or a roof begins with; a few have a ``short-…`` beside them.
    narrow
        Metres from which a wall has room for bays of its own beside both corners. `start` knows what to do below.
    least
        Metres below which a wall has no room for a window.
    looks
        How many different façades the first choice makes, by the building's seed.
    widths, heights
        For a solved façade: from what to what its front may be stretched, metres. None: any.
    """

    name: str
    ground: float
    storey: float
    top: float
    storeys: tuple[int, int]
    roofs: tuple[tuple[str, float], ...]
    starts: Mapping[str, str]
    narrow: float
    least: float
    looks: int
    widths: tuple[float, float] | None = None
    heights: tuple[float, float] | None = None

    def eaves(self, storeys: int) -> float:
        """Height of the wall of a building with so many storeys, metres."""
        return self.ground + (storeys - 1) * self.storey + self.top

    def fit(self, eaves: float) -> int:
        """How many storeys the grammar makes on a wall of that height; 0 where a solved front does not fit."""
        if self.heights is not None:
            return self.storeys[0] if self.heights[0] <= eaves <= self.heights[1] else 0
        left = (eaves - self.ground - self.top) / self.storey
        return 1 + max(0, ceil(left - 1e-3))

    def suits(self, width: float, eaves: float) -> bool:
        """Whether a front of that size can be drawn: a solved one is stretched by a few per cent, not more."""
        if self.fit(eaves) == 0 or width < self.least:
            return False
        return self.widths is None or self.widths[0] <= width <= self.widths[1]

    def start(self, what: str, width: float) -> str:
        """The rule for a wall of that width: a short one has no bays of its own at its corners, a stub no window."""
        if what in ("front", "street", "side", "court") and width < self.narrow:
            return self.starts[f"short-{what}" if width >= self.least else "plain"]
        return self.starts[what]


def _starts(space: str, **others: str) -> Mapping[str, str]:
    """Rules of a namespace by what they are for; a side that is short has no window, a short court is as a street."""
    starts = {what: f"{space}.{what.capitalize()}" for what in STARTS}
    starts |= {
        "short-front": f"{space}.ShortFront",
        "short-street": f"{space}.ShortStreet",
        "short-side": f"{space}.Plain",
        "short-court": f"{space}.ShortStreet",
    }
    return MappingProxyType(starts | {what.replace("_", "-"): rule for what, rule in others.items()})


_FILES = ("gruenderzeit", "slab", "half-timbered", "brickworks", "detached", "shop-street")

_WRITTEN = (
    Style(
        "gruenderzeit", 4.7, 3.5, 0.9, (3, 5), (("mansard", 0.35), ("gable", 0.4), ("hip", 0.15), ("flat", 0.1)),
        _starts("gruenderzeit", short_court="gruenderzeit.ShortCourt"), 7.2, 2.6, 6,
    ),
    Style("slab", 3.3, 2.8, 0.6, (3, 12), (("flat", 0.92), ("shed", 0.08)), _starts("slab"), 7.6, 2.4, 5),
    Style(
        "half-timbered", 3.3, 2.65, 0.2, (1, 4), (("gable", 0.85), ("hip", 0.15)), _starts("timbered"), 6.7, 2.1, 4
    ),
    Style(
        "brickworks", 5.2, 3.9, 1.0, (1, 4), (("flat", 0.5), ("gable", 0.3), ("shed", 0.2)),
        _starts("brickworks"), 10.3, 3.4, 3,
    ),
    Style("detached", 3.1, 2.7, 0.25, (1, 2), (("gable", 0.6), ("hip", 0.4)), _starts("detached"), 8.3, 3.1, 5),
    Style(
        "shop-street", 4.2, 3.1, 0.55, (2, 4), (("gable", 0.45), ("hip", 0.2), ("mansard", 0.15), ("flat", 0.2)),
        _starts("shops", short_court="shops.ShortCourt"), 7.0, 2.4, 4,
    ),
)  # fmt: skip


def _solved(solved: Solved) -> Style:
    """The style of a solved front."""
    space = f"{solved.space}."
    rules = {
        what: f"{space}{what.capitalize()}" for what in ("front", "street", "party", "plain", "roof", "flat")
    }
    rules |= {"side": rules["street"], "court": rules["street"], "gable": rules["plain"]}
    rules |= {f"short-{what}": rules["plain"] for what in ("street", "side", "court")}
    rules["short-front"] = rules["front"]
    low, high = 1 - STRETCH, 1 + STRETCH
    return Style(
        solved.name, solved.ground, solved.storey, solved.top, (solved.storeys, solved.storeys), (("flat", 1.0),),
        MappingProxyType(rules), 9.8, 9.8, 1, (solved.width * low, solved.width * high),
        (solved.height * low, solved.height * high),
    )  # fmt: skip


STYLES: tuple[Style, ...] = (*_WRITTEN, *map(_solved, SOLVED))
"""Every style: those that are written in the gallery, then those whose fronts are solved."""

GROUND: Mapping[str, str] = MappingProxyType(
    {
        kind: f"ground.{kind.capitalize()}"
        for kind in ("asphalt", "pavement", "court", "grass", "line", "field")
    }
)
"""For each kind of ground, the rule that it begins with."""


def style_text(name: str) -> str:
    """The grammar of a style alone, as it stands in the town's."""
    return gallery.town(name)


@lru_cache(maxsize=1)
def town_text() -> str:
    """The text of all styles, of the ground and of plain colours."""
    return "\n".join([gallery.town("shared"), *(style_text(name) for name in _FILES), solved_text()])


@lru_cache(maxsize=1)
def town_grammar() -> Grammar:
    """All styles, the ground's rules (``ground.Asphalt``, …) and plain colours (``plain.White``, …) in one grammar."""
    return Grammar.parse(town_text(), town_tiles())
