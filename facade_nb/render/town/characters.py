"""What stands on the footprints of a generated town: use, style, storeys, by district, street and place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from .chance import Floats, chance, pick
from .finishing import Characters, Pairs
from .fitting import fit_fronts
from .footprints import District
from .plan import INDUSTRIAL, RESIDENTIAL, SHOP
from .rings import Ints
from .streets import AVENUE, SECOND
from .styles import Style

__all__ = ["choose_styles", "eaves_of", "of_districts", "storeys_of", "table_of"]

Weights = Mapping[str, float]

_WANTED: Mapping[int, Weights] = {
    District.MARKET: {"gruenderzeit": 1},
    District.OLD: {"half-timbered": 5, "gruenderzeit": 3},
    District.INNER: {"gruenderzeit": 6, "slab": 0.4},
    District.ROWS: {"detached": 5, "half-timbered": 0.4},
    District.DETACHED: {"detached": 8, "half-timbered": 0.3},
    District.SLABS: {"slab": 1},
    District.INDUSTRY: {"brickworks": 5, "slab": 0.6},
    District.PARK: {"gruenderzeit": 1},
}
"""Styles of each district with their weights. Solved ones are chosen by the width of a front."""

_SHOPS: Weights = {"shop-street": 6, "gruenderzeit": 1}
"""Styles of houses with a shop."""


def table_of(wanted: Mapping[int, Weights], styles: Sequence[Style]) -> Floats:
    """Weights of each style (columns) for each case (rows). All are alike where none is known by its name."""
    free = [one.widths is None for one in styles]
    rows = []
    for case in range(len(wanted)):
        row = [wanted[case].get(one.name, 0.0) * own for one, own in zip(styles, free, strict=True)]
        rows.append(row if sum(row) > 0 else [float(own) for own in free])
    return np.array(rows)


def choose_styles(
    district: Ints, shop: NDArray[np.bool_], random: Floats, styles: Sequence[Style]
) -> NDArray[np.int32]:
    """A style for each building by its district; houses with a shop have theirs."""
    table = table_of({**_WANTED, len(_WANTED): _SHOPS}, styles)
    return pick(random, table[np.where(shop, len(_WANTED), district)]).astype(np.int32)


def eaves_of(
    style: NDArray[np.int32], storeys: NDArray[np.int32], lower: Floats, styles: Sequence[Style]
) -> Floats:
    """Heights of walls: what the style says for so many storeys, up to a twelfth lower, as long as these fit.

    Parameters
    ----------
    lower
        (b,) from 0 to 1: how much of that.
    """
    most = int(storeys.max(initial=1)) + 1
    full = np.array([[one.eaves(k) for k in range(1, most)] for one in styles]).reshape(len(styles), -1)
    floors = np.array([one.storey for one in styles])
    eaves = full[style, storeys - 1]
    lowered = eaves - np.rint(lower * (storeys - 1) * floors[style] / 12 / 0.05) * 0.05
    lowered = np.round(lowered, 3)
    fit = np.array(
        [styles[s].fit(float(h)) for s, h in zip(style.tolist(), lowered.tolist(), strict=True)], int
    )
    return np.asarray(np.round(np.where(fit == storeys, lowered, eaves), 3))


def storeys_of(
    style: NDArray[np.int32], wanted: Floats, styles: Sequence[Style], floor: int = 99
) -> NDArray[np.int32]:
    """The storeys that are wanted, rounded, as far as they suit the style; its least is taken as `floor` at most."""
    least = np.array([min(one.storeys[0], floor) if one.widths is None else one.storeys[0] for one in styles])
    most = np.array([one.storeys[1] for one in styles])
    rounded = np.floor(np.round(wanted + 0.5, 6))
    return np.clip(rounded, least[style], most[style]).astype(np.int32)


def of_districts(
    district: Ints,
    block: Ints,
    reach: Floats,
    street: Ints,
    corner: NDArray[np.bool_],
    front: Floats,
    pairs: Pairs,
    styles: Sequence[Style],
    seed: int,
) -> Characters:
    """Uses, styles and heights. They fall off from the market outwards, and vary from house to house.

    Parameters
    ----------
    district, block, reach, street, corner
        (b,) where a building stands: district, block, how far out, the widest street it faces, whether at a corner.
    front, pairs
        As of `fit_fronts`.
    """
    random = chance(seed, 20)
    count = len(district)
    by_block = random.random(int(block.max()) + 1)[block]
    own, shops, choice, lower = random.random((4, count))
    dense = (district == District.OLD) | (district == District.INNER)
    odds = np.select(
        [corner & dense, dense & (street <= AVENUE), dense & (street <= SECOND)], [0.62, 0.5, 0.3], 0.03
    )
    odds = np.where(
        dense, odds * np.where(reach < 0.3, 1.2, 0.8), np.where(district == District.ROWS, 0.01, 0.0)
    )
    shop = shops < odds
    style = choose_styles(district, shop, np.where(district == District.ROWS, by_block, choice), styles)
    fall = np.clip((reach - 0.15) / 0.4, 0, 1)
    wanted = np.select(
        [
            district == District.OLD,
            district == District.INNER,
            district == District.ROWS,
            district == District.SLABS,
            district == District.INDUSTRY,
        ],
        [
            2.4 + 1.7 * own,
            5.7 - 2.0 * fall + 1.4 * (own - 0.5) + (street <= AVENUE) * 0.6,
            np.where(by_block < 0.75, 2.0, 3.0),
            np.where(by_block < 0.3, 4.0, np.where(by_block < 0.8, 6.0, 9.0))
            + np.where(own > 0.85, 2.0, 0.0),
            1.0 + 2.2 * own * own,
        ],
        1.1 + 1.1 * own,
    )
    welcome = (
        (chance(seed, 24).random(count) < 0.3) & np.isin(district, (District.INNER, District.ROWS)) & ~shop
    )
    style = fit_fronts(style, welcome, front, 3.4 * np.floor(wanted + 0.5), pairs, styles, lower)
    storeys = storeys_of(style, wanted, styles)
    # Houses of a row, and slabs of a block, are of one height.
    level = np.isin(district, (District.ROWS, District.SLABS))
    eaves = eaves_of(style, storeys, np.where(level, by_block, lower), styles)
    kind = np.where(district == District.INDUSTRY, INDUSTRIAL, np.where(shop, SHOP, RESIDENTIAL)).astype(
        np.uint8
    )
    return Characters(style, storeys, eaves, kind, shop)
