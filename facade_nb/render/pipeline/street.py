"""Façades on the ground: a square for one that stands alone; pavement, kerb and road for a street of them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import mapbox_earcut
import numpy as np
import shapely
from numpy.typing import NDArray

from ..texture.facades import Facade
from ..texture.grammar import Grammar
from .scene import Scene
from .vertices import VERTEX

__all__ = ["KERB", "PAVEMENT", "PAVING", "ground", "street"]

PAVEMENT, KERB = 3.2, 0.16
"""Width of the pavement before houses and of its kerb, metres."""

_FAR = 1500.0
"""How far the ground reaches, metres."""

PAVING = """
    Slabs -> Layer(Flags, Even, Worn, Trodden)
    Flags -> Mat(Color, Rep:paving, 0, 0, 0.28, 0.28)
    Even -> Mat(Color, 0, 0.61, 0.595, 0.57, 0.5)
    Kerb -> Layer(Stone, Worn)
    Stone -> Mat(Color, 0, 0.66, 0.65, 0.63, 1)
    Road -> Layer(Asphalt, Worn, Trodden, Grain)
    Asphalt -> Mat(Color, Rep:asphalt, 0, 0, 0.5, 0.5)
    Grain -> Mat(Normal, Rep:asphalt.normal, 0, 0, 0.5, 0.5)
    Worn -> MatAlpha(Color, 0, 0.35, 0.33, 0.30, 0.13, Rep:clouds, 0, 0, 0.11, 0.13)
    Trodden -> MatAlpha(Color, 0, 0.60, 0.58, 0.55, 0.07, Rep:clouds, 0.3, 0.6, 0.031, 0.027)
"""


@lru_cache(maxsize=1)
def _paved() -> Grammar:
    return Grammar.parse(PAVING)


def street(facades: Sequence[Facade]) -> Scene:
    """Façades as they stand on the ground. Raises `ValueError` for none."""
    flat = Facade(_paved(), (2 * _FAR, 2 * _FAR), start="Slabs")
    walls = Scene.of_facades([*facades, flat])  # the last one stands for the ground: its grammar, its seed
    kept = walls.vertices[:-4]
    own = walls.vertices[-4:-3]
    low, high = kept["position"].min(axis=0).astype(float), kept["position"].max(axis=0).astype(float)
    middle = np.round((low + high) / 2)
    grammar = walls.grammar
    first = len(grammar.rules) - len(_paved().rules)
    vertices, indices = [kept], [walls.indices[:-6]]
    count = len(kept)
    for start, (corners, triangles) in ground(facades, (middle[0], middle[2])).items():
        made = np.zeros(len(corners), VERTEX)
        made["position"][:, 0], made["position"][:, 2] = corners[:, 0], corners[:, 1]
        made["place"] = corners * (1, -1) + (_FAR - middle[0], _FAR + middle[2])
        made["size"], made["seed"] = own["size"], own["seed"]
        made["start"] = grammar.encoding.positions[first + _paved().index(start)]
        made["normal"], made["tangent"] = (0, 1, 0), (1, 0, 0)
        vertices.append(made)
        indices.append((triangles + count).astype(np.uint32).reshape(-1))
        count += len(made)
    # A low sun throws shadows some way beyond the houses.
    aside = np.array([1.0, 0.0, 1.0]) * (2.5 * (high[1] - low[1]) + 4)
    sunny = np.stack([np.minimum(low, (np.inf, 0, np.inf)) - aside, high + aside])
    return Scene(np.concatenate(vertices), np.concatenate(indices), grammar, seeds=walls.seeds, sunny=sunny)


def ground(
    facades: Sequence[Facade], middle: tuple[float, float]
) -> dict[str, tuple[NDArray[np.float64], NDArray[np.int64]]]:
    """Corners (n, 2), east and south, and triangles (t, 3), seen from above, of each kind of ground."""
    x, z = middle
    square = shapely.box(x - _FAR, z - _FAR, x + _FAR, z + _FAR)
    feet = [
        shapely.LineString([one.origin[::2], tuple(np.array(one.origin[::2]) + one.size[0] * np.array(one.right[::2]))])
        for one in facades
        if one.up[1] > 0.99 and one.origin[1] < 0.5
    ]  # fmt: skip
    if len(facades) == 1 or not feet:
        return {"Slabs": _triangles(square)}
    walls = shapely.unary_union(feet)
    paved, kerbed = (walls.buffer(reach, quad_segs=4) for reach in (PAVEMENT, PAVEMENT + KERB))
    parts = {"Slabs": paved, "Kerb": kerbed.difference(paved), "Road": square.difference(kerbed)}
    return {name: _triangles(part) for name, part in parts.items()}


def _triangles(shape: shapely.Geometry) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    corners, triangles = [np.zeros((0, 2))], [np.zeros((0, 3), np.int64)]
    count = 0
    for part in shapely.get_parts(shape):
        rings = [np.array(ring.coords)[:-1] for ring in (part.exterior, *part.interiors)]
        every = np.concatenate(rings)
        ends = np.cumsum([len(ring) for ring in rings]).astype(np.uint32)
        found = mapbox_earcut.triangulate_float64(every, ends).astype(np.int64).reshape(-1, 3)
        a, b, c = (every[found[:, k]] for k in range(3))
        turn = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
        found[turn > 0] = found[turn > 0][:, ::-1]  # south grows downwards as one looks from above
        found = found[np.abs(turn) > 1e-9]
        corners.append(every)
        triangles.append(found + count)
        count += len(every)
    return np.concatenate(corners), np.concatenate(triangles)
