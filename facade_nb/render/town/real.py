"""The houses of a real town: its footprints as they are, and what they do not tell inferred."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from .chance import Floats, chance, length, pick
from .characters import eaves_of, storeys_of, table_of
from .finishing import Characters, Pairs, finish, pairs_of, walls_of
from .fitting import fit_fronts, single_fronts
from .geojson import Outlines, read_outlines
from .greenery import sites_of
from .neighbours import Cut, cut_walls, with_hidden
from .openness import gaps_of, look_out, roads_before
from .passages import NO_PASSAGES, passages_of
from .plains import APRON, asphalt_of
from .plan import FLAT, GABLE, INDUSTRIAL, OUTBUILDING, PUBLIC, RESIDENTIAL, SHOP, Ground
from .rings import Ints, after, areas, polygons_of, ring_numbers, take_rings
from .roads import Roads, laid_out, told
from .roles import PARTY, STREET
from .stages import Stages
from .styles import Style
from .surroundings import Standing
from .tags import Use, has_shop, levels_of, metres_of, roof_of, use_of
from .workers import Workers

__all__ = ["real_houses"]

_TREES = 2.6
"""Trees for each house, at the most."""

_SHED = 45.0
"""Smaller buildings are sheds and garages, for which no street is laid, square metres."""

_NO_GROUND = Ground(
    np.zeros((0, 2)),
    np.zeros((0, 3), np.int64),
    np.zeros(0, np.uint8),
    np.zeros(0, np.int64),
    np.zeros(0, bool),
)

_GARDENS = ("detached", "half-timbered")
"""Styles of houses that stand in gardens."""

_WANTED: Mapping[int, Mapping[str, float]] = {
    Use.UNKNOWN: {"detached": 1},
    Use.HOUSE: {"detached": 8, "half-timbered": 0.4},
    Use.TOWNHOUSE: {"gruenderzeit": 4, "half-timbered": 2},
    Use.APARTMENTS: {"slab": 4, "gruenderzeit": 2},
    Use.COMMERCE: {"shop-street": 5, "slab": 1},
    Use.INDUSTRY: {"brickworks": 1},
    Use.PUBLIC: {"gruenderzeit": 3, "brickworks": 1},
    Use.OUTBUILDING: {"detached": 1},
}

_KINDS = {Use.COMMERCE: SHOP, Use.INDUSTRY: INDUSTRIAL, Use.PUBLIC: PUBLIC, Use.OUTBUILDING: OUTBUILDING}


def real_houses(
    source: Mapping[str, Any] | str | Path,
    seed: int,
    styles: Sequence[Style],
    stages: Stages,
    workers: Workers,
) -> Standing:
    """Houses from GeoJSON, and the streets that they look at. It raises what `read_outlines` raises."""
    stages.at(0.0, "footprints")
    outlines = read_outlines(source)
    stages.at(0.2, "neighbours")
    houses = outlines.polygons()
    index, offsets = take_rings(outlines.offsets, np.flatnonzero(~outlines.holes))
    outer = outlines.corners[index]
    roads = told(outlines.roads, houses)
    # Where one can go between houses is worked out while other things are.
    passages = None if len(roads) else workers.begin(passages_of, offsets, outer)
    building = np.asarray(outlines.ring_of)[ring_numbers(outlines.offsets)]
    cut = cut_walls(outlines.offsets, outlines.corners, building)
    owner = np.asarray(outlines.ring_of)[ring_numbers(cut.offsets)]
    cut = with_hidden(cut, owner, houses)
    gaps = gaps_of(cut)
    sizes = _sizes(outlines)
    dense = _density(outlines, sizes)
    standing = polygons_of(cut.offsets, cut.corners, ~outlines.holes)
    stages.at(0.25, "streets")
    between = passages() if passages is not None else NO_PASSAGES
    sites = workers.begin(sites_of, cut.corners, standing, seed, _TREES)
    if passages is not None:
        roads = laid_out(between, offsets, outer, houses, sizes >= _SHED)
    asphalt = workers.begin(asphalt_of, offsets, outer, roads)
    roles = look_out(cut, outlines.ring_of, outlines.holes, gaps, _apart(cut, gaps, roads))
    # Roles are found for walls that are cut already; where none is cut they hold for the whole.
    before = np.zeros(len(outlines.corners), np.uint8)
    before[cut.source[::-1]] = roles[::-1]
    walls = walls_of(cut, outlines.ring_of, outlines.holes, before)
    walls.role[:] = roles
    stages.at(0.3, "heights")
    pairs = pairs_of(walls)
    characters, tops = _characters(outlines, cut, roles, pairs, styles, sizes, dense, seed)
    given = np.array([roof_of(tags) for tags in outlines.tags])
    out = characters.kind == OUTBUILDING
    given = np.where((given < 0) & out, np.where(sizes < 60, FLAT, GABLE), given)
    stages.at(0.4, "roofs")
    plan = finish(walls, pairs, characters, styles, _NO_GROUND, seed, given, tops, outlines.left_out, stages)
    names = np.array([one.name for one in styles])[characters.style]
    gardens = np.isin(names, _GARDENS) & ~out
    wide = np.where(gardens, APRON, np.where(characters.kind == RESIDENTIAL, 2.2, 5.0))
    wide = np.where(dense > 0.33, np.maximum(wide, 2.2), np.where(out, 0.0, wide))
    return Standing(plan, offsets, outer, houses, gaps, roads, asphalt, sites, wide, gardens)


def _apart(cut: Cut, gaps: Floats, roads: Roads) -> Floats:
    """How far a road is straight before each wall, metres; `inf` where none is seen."""
    start, end = cut.corners, cut.corners[after(cut.offsets)]
    way = end - start
    out = np.column_stack([way[:, 1], -way[:, 0]]) / np.maximum(length(way), 1e-9)[:, None]
    return roads_before((start + end) / 2, out, gaps, roads)[0]


def _sizes(outlines: Outlines) -> Floats:
    """Area of each footprint without its courtyards, square metres."""
    sizes = np.zeros(len(outlines.tags))
    np.add.at(sizes, outlines.ring_of, areas(outlines.corners, outlines.offsets))
    return np.round(sizes, 3)


def _characters(
    outlines: Outlines,
    cut: Cut,
    roles: NDArray[np.uint8],
    pairs: Pairs,
    styles: Sequence[Style],
    size: Floats,
    dense: Floats,
    seed: int,
) -> tuple[Characters, Floats]:
    """Uses, styles and heights, and the height of the ridge where it is told (else 0)."""
    count = len(outlines.tags)
    random = chance(seed, 30)
    own, choice, lower = random.random((3, count))
    joined = _joined(cut, outlines, roles)
    use = np.array([use_of(tags) for tags in outlines.tags])
    known = use != Use.UNKNOWN
    # What is not told: sheds and garages are small, halls large. Where it is dense, and between neighbours, stand
    # townhouses.
    guess = np.select(
        [
            size < _SHED,
            (size > 1400) & (dense < 0.4),
            (dense > 0.3) & (size < 1400) & (joined > 0.08),
            (joined > 0.25) & (size < 600) & (dense > 0.2),
            size < 330,
            size < 900,
        ],
        [Use.OUTBUILDING, Use.INDUSTRY, Use.TOWNHOUSE, Use.TOWNHOUSE, Use.HOUSE, Use.APARTMENTS],
        Use.COMMERCE,
    )
    use = np.where(known, use, guess)
    shop = np.array([has_shop(tags) for tags in outlines.tags]) | (
        ~known & (use == Use.TOWNHOUSE) & (own < 0.3 * np.clip(dense / 0.4, 0, 1))
    )
    style = pick(choice, table_of(_WANTED, styles)[np.where(shop, Use.COMMERCE, use)]).astype(np.int32)
    wanted = np.select(
        [
            use == Use.HOUSE,
            use == Use.TOWNHOUSE,
            use == Use.APARTMENTS,
            use == Use.COMMERCE,
            use == Use.PUBLIC,
            use == Use.INDUSTRY,
        ],
        [
            1.1 + 1.1 * own + (size > 140) * 0.3,
            2.2 + 2.4 * np.clip(dense, 0, 0.6) + 1.2 * (own - 0.4),
            2.4 + 1.4 * own + (size > 500) * 0.6,
            1.6 + 1.6 * own + dense,
            2.0 + 1.2 * own,
            1.0 + 0.9 * own,
        ],
        1.0,
    )
    levels = np.array([levels_of(tags.get("building:levels")) or 0 for tags in outlines.tags])
    tops = np.array([metres_of(tags.get("height")) or 0.0 for tags in outlines.tags])
    building = np.asarray(outlines.ring_of)[ring_numbers(cut.offsets)]
    span = length(cut.corners[after(cut.offsets)] - cut.corners)
    front = single_fronts(roles == STREET, span, building, count)
    welcome = np.isin(use, (Use.TOWNHOUSE, Use.APARTMENTS)) & ~shop & (levels == 0) & (tops == 0)
    welcome &= chance(seed, 31).random(count) < 0.3
    style = fit_fronts(style, welcome, front, 3.4 * np.floor(wanted + 0.5), pairs, styles, own)
    storeys = storeys_of(style, wanted, styles, floor=3)
    storeys = np.where(use == Use.OUTBUILDING, 1, storeys).astype(np.int32)
    # A style that suits the storeys that are told, if the one chosen does not.
    style = _suiting(
        style, np.where((levels > 0) | (tops == 0), levels, np.maximum(np.rint((tops - 1) / 3.1), 1)), styles
    )
    storeys = np.where(levels > 0, levels, storeys).astype(np.int32)
    eaves = eaves_of(style, storeys, np.where(levels > 0, 0.0, lower), styles)
    low = np.round(2.3 + 0.1 * np.floor(10 * own) + (size > 60) * 0.8, 2)
    eaves = np.where((use == Use.OUTBUILDING) & (levels == 0), low, eaves)
    kind = np.zeros(count, np.uint8)
    for name, code in _KINDS.items():
        kind[use == name] = code
    kind[shop & (kind == RESIDENTIAL)] = SHOP
    return Characters(style, storeys, eaves, kind, shop), tops


def _suiting(style: NDArray[np.int32], levels: Ints, styles: Sequence[Style]) -> NDArray[np.int32]:
    """For each building the first style that suits its storeys, if its own does not; the tallest where none does."""
    changed = style.copy()
    free = [k for k, one in enumerate(styles) if one.widths is None]
    tallest = max(free, key=lambda k: (styles[k].storeys[1], -k))
    for k in np.flatnonzero(levels > 0).tolist():
        least, most = styles[style[k]].storeys
        # Solved ones have a width that suits them, too.
        if not least <= levels[k] <= most:
            fit = (
                j
                for j, one in enumerate(styles)
                if one.widths is None and one.storeys[0] <= levels[k] <= one.storeys[1]
            )
            changed[k] = next(fit, tallest if levels[k] > most else int(style[k]))
    return changed


def _density(outlines: Outlines, size: Floats) -> Floats:
    """The part of a circle of 60 m around each building that is built on."""
    outer = np.flatnonzero(~outlines.holes)
    index, offsets = take_rings(outlines.offsets, outer)
    low = np.minimum.reduceat(outlines.corners[index], offsets[:-1], axis=0)
    high = np.maximum.reduceat(outlines.corners[index], offsets[:-1], axis=0)
    middle = shapely.points((low + high) / 2)
    one, other = shapely.STRtree(middle).query(middle, predicate="dwithin", distance=60.0)
    built = np.zeros(len(size), np.int64)
    np.add.at(built, one, np.rint(size[other]).astype(np.int64))
    return np.round(built / (3.14159 * 3600), 3)


def _joined(cut: Cut, outlines: Outlines, roles: NDArray[np.uint8]) -> Floats:
    """The part of its walls that each building has in common with others."""
    building = np.asarray(outlines.ring_of)[ring_numbers(cut.offsets)]
    span = np.rint(1000 * length(cut.corners[after(cut.offsets)] - cut.corners)).astype(np.int64)
    whole = np.bincount(building, weights=span)
    shared = np.bincount(building, weights=np.where(roles == PARTY, span, 0))
    return np.round(shared / np.maximum(whole, 1), 4)
