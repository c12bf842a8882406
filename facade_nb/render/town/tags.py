"""What is told of a footprint: use, heights, roof (OpenStreetMap's tags)."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from .plan import FLAT, GABLE, HIP, MANSARD, SHED

__all__ = ["USES", "Use", "levels_of", "metres_of", "roof_of", "use_of"]


class Use:
    """What a building is."""

    UNKNOWN, HOUSE, TOWNHOUSE, APARTMENTS, COMMERCE, INDUSTRY, PUBLIC, OUTBUILDING = range(8)


USES = ("unknown", "house", "townhouse", "apartments", "commerce", "industry", "public", "outbuilding")
"""Their names."""

_BUILDINGS: Mapping[int, str] = {
    Use.HOUSE: "house detached semidetached_house semi bungalow villa farm farmhouse cabin chalet static_caravan",
    Use.TOWNHOUSE: "terrace townhouse row_house",
    Use.APARTMENTS: "apartments dormitory hotel flats",
    Use.COMMERCE: "retail commercial office supermarket shop bank department_store mall restaurant pub",
    Use.INDUSTRY: "industrial warehouse factory manufacture hangar works storage depot transportation service",
    Use.PUBLIC: (
        "public school university college hospital kindergarten church chapel cathedral mosque synagogue temple "
        "monastery castle palace townhall civic government museum library train_station station "
        "fire_station sports_hall"
    ),
    Use.OUTBUILDING: (
        "garage garages carport shed hut roof stable barn cowshed sty farm_auxiliary greenhouse glasshouse "
        "greenhouse_horticulture outbuilding kiosk toilets boathouse bunker transformer_tower container tent ruins"
    ),
}
_USE = {name: use for use, names in _BUILDINGS.items() for name in names.split()}

_AMENITIES = frozenset(
    {
        "place_of_worship", "school", "university", "college", "hospital", "kindergarten", "townhall",
        "public_building", "library", "fire_station", "police", "courthouse", "theatre",
        "community_centre", "arts_centre",
    }
)  # fmt: skip
_SERVED = frozenset(
    {"restaurant", "cafe", "bar", "pub", "bank", "fast_food", "post_office", "pharmacy", "ice_cream"}
)

_ROOFS: Mapping[int, str] = {
    FLAT: "flat",
    GABLE: "gabled pitched saltbox double_saltbox quadruple_saltbox gabled_row",
    HIP: "hipped half-hipped half_hipped pyramidal side_hipped",
    MANSARD: "mansard gambrel",
    SHED: "skillion lean_to sawtooth shed monopitch",
}
_ROOF = {name: kind for kind, names in _ROOFS.items() for name in names.split()}

_LENGTH = re.compile(
    r"\s*(\d+(?:[.,]\d+)?)\s*(m|metres?|meters?|ft|feet|foot|'|′)?\s*(?:(\d+(?:[.,]\d+)?)\s*(?:\"|″|in))?\s*"
)
_LEVELS = re.compile(r"\s*(\d+(?:[.,]\d+)?)\s*(?:[;+-].*)?")

HIGHEST = 400.0
"""Heights above this are not believed, metres."""

TALLEST = 120
"""Storeys above this are not believed."""


def use_of(tags: Mapping[str, Any]) -> int:
    """What a building is, by its tags; UNKNOWN where they do not tell."""
    name = _word(tags.get("building"))
    if name in _USE:
        return _USE[name]
    if tags.get("shop") or _word(tags.get("amenity")) in _SERVED:
        return Use.COMMERCE
    if _word(tags.get("amenity")) in _AMENITIES or tags.get("tourism") == "museum":
        return Use.PUBLIC
    return Use.UNKNOWN


def has_shop(tags: Mapping[str, Any]) -> bool:
    """Whether there is a shop, a café or the like in it."""
    return bool(tags.get("shop")) or _word(tags.get("amenity")) in _SERVED


def metres_of(value: Any) -> float | None:
    """A height in metres: 12, ``"12"``, ``"12.5 m"``, ``"40 ft"``, feet and inches; None where it is none or absurd."""
    if isinstance(value, bool):
        return None
    if isinstance(value, int | float):
        found = float(value)
    else:
        match = _LENGTH.fullmatch(value) if isinstance(value, str) and len(value) < 40 else None
        if match is None:
            return None
        feet = match[2] is not None and match[2][0] in "f'′"
        if match[3] and not feet:
            return None
        found = float(match[1].replace(",", "."))
        if feet:
            found = (found + float((match[3] or "0").replace(",", ".")) / 12) * 0.3048
    return round(found, 3) if 1.0 <= found <= HIGHEST else None


def levels_of(value: Any) -> int | None:
    """Storeys: 3, ``"3"``, ``"2.5"`` (three), ``"3;4"`` (the first); None where it is no number, or absurd."""
    if isinstance(value, bool):
        return None
    if isinstance(value, str):
        match = _LEVELS.fullmatch(value) if len(value) < 40 else None
        if match is None:
            return None
        value = float(match[1].replace(",", "."))
    if not isinstance(value, int | float) or not 0 < value <= TALLEST:
        return None
    whole = int(value)
    return whole + (value > whole)


def roof_of(tags: Mapping[str, Any]) -> int:
    """The kind of roof; -1 where it is not told, or of a shape that is not made here."""
    return _ROOF.get(_word(tags.get("roof:shape")), -1)


def _word(value: Any) -> str:
    return value.strip().lower() if isinstance(value, str) and len(value) < 60 else ""
