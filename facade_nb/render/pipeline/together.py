"""Several scenes as one: façades by grammar beside solids by mesh, under one sun."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..texture.joining import joined
from ..texture.noise import Seed
from .scene import Scene

__all__ = ["together"]


def together(*scenes: Scene) -> Scene:
    """All that is in these scenes: one mesh, one grammar, one image of tiles. Raises `ValueError` for none."""
    if not scenes:
        raise ValueError("expected at least one scene")
    if len(scenes) == 1:
        return scenes[0]
    grammars = tuple(dict.fromkeys(own.grammar for own in scenes))
    grammar, firsts = joined(*grammars)
    first_of = dict(zip(grammars, firsts, strict=True))
    vertices, indices, chunks = [], [], []
    count, index = 0, 0
    seeds = _seeds(scenes)
    for own in scenes:
        moved = own.vertices.copy()
        moved["start"] = _starts(own, grammar.encoding.positions[first_of[own.grammar] :])
        if seeds:
            moved["seed"] = _rows(own, seeds)
        parts = own.chunks.copy()
        parts["first"] += np.uint32(index)
        vertices.append(moved)
        indices.append(own.indices + np.uint32(count))
        chunks.append(parts)
        count, index = count + len(moved), index + len(own.indices)

    def around(boxes: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
        return np.stack(
            [np.min([own[0] for own in boxes], axis=0), np.max([own[1] for own in boxes], axis=0)]
        )

    return Scene(
        np.concatenate(vertices),
        np.concatenate(indices),
        grammar,
        np.concatenate(chunks),
        seeds,
        around([own.box if own.sunny is None else own.sunny for own in scenes]),
        around([own.solid_box for own in scenes]),
    )


def _starts(scene: Scene, positions: Sequence[tuple[int, int]]) -> NDArray[np.float32]:
    """Where the start rules of a scene's vertices are in the grammar of all; `positions`: those of its rules there."""
    own = {tuple(place): number for number, place in enumerate(scene.grammar.encoding.positions)}
    known, row = np.unique(scene.vertices["start"], axis=0, return_inverse=True)
    places = [positions[own[tuple(map(int, place))]] for place in known]
    return np.array(places, np.float32).reshape(-1, 2)[row.reshape(-1)]


def _seeds(scenes: Sequence[Scene]) -> tuple[Seed, ...]:
    """All seeds, each once, where one of the scenes has a table of them; else none: vertices hold them."""
    if not any(own.seeds for own in scenes):
        return ()
    return tuple(dict.fromkeys(seed for own in scenes for seed in _own(own)[0]))


def _own(scene: Scene) -> tuple[list[Seed], NDArray[np.intp]]:
    """The seeds of a scene, and for each vertex which it has."""
    if scene.seeds:
        return list(scene.seeds), scene.vertices["seed"][:, 0].astype(np.intp)
    known, row = np.unique(scene.vertices["seed"], axis=0, return_inverse=True)
    return [Seed.of((float(x), float(y))) for x, y in known], row.reshape(-1)


def _rows(scene: Scene, seeds: Sequence[Seed]) -> NDArray[np.float32]:
    """What vertices carry in place of their seeds: the row of each in the table."""
    own, row = _own(scene)
    places = np.array([(seeds.index(seed), 0) for seed in own], np.float32).reshape(-1, 2)
    return places[row]
