"""Points on their way through a grammar: where they are, in which scope, and what they carry along."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Batch", "Floats", "joined"]

Floats = NDArray[np.float32]
Steps = NDArray[np.int32]


@dataclass(frozen=True, slots=True, eq=False)
class Batch:
    """Points that have reached the same rule on the same way.

    What is the same for all points of a batch is held once, in an array of shape (1,): scopes until a Repeat makes them
    different, rays that look straight on.

    Attributes
    ----------
    index
        (n,) which of the points asked for they are.
    x, y
        (n,) place of the points, metres.
    left, bottom, right, top
        (n,) or (1,) the scope, metres.
    ray
        Three of (n,) or (1,): direction of the viewing ray; x and y along the scope, z out of it.
    footprint
        (n,) or (1,) metres that a pixel covers there, across the ray; 0 where nobody asks.
    slack
        For x and for y, (n,) or (1,): how far the scope's extent may be from what was meant, metres (`dividing`).
    seeds
        The seed stack: corners in whole steps of the noise texture, the last one on top.
    shift
        How often the seed has been added to the scope's corner (once for the façade, i more for layer i and face i).
    faces
        Faces of intrusions on the way, 1 to 5, the outermost first.
    layers
        For each Layer operator on the way that it is inside of, the rule and the number of the layer, from 1.
    """

    index: NDArray[np.intp]
    x: Floats
    y: Floats
    left: Floats
    bottom: Floats
    right: Floats
    top: Floats
    ray: tuple[Floats, Floats, Floats]
    footprint: Floats
    slack: tuple[Floats, Floats]
    seeds: tuple[tuple[Steps, Steps], ...] = ()
    shift: int = 1
    faces: tuple[int, ...] = ()
    layers: tuple[tuple[int, int], ...] = ()

    def __len__(self) -> int:
        return len(self.index)

    @property
    def way(self) -> tuple[int, int, tuple[int, ...], tuple[tuple[int, int], ...]]:
        """What points need to have in common to go on as one batch, but for the rule."""
        return len(self.seeds), self.shift, self.faces, self.layers

    def take(self, chosen: NDArray[Any]) -> Batch:
        """Some of the points: a mask or indices into the batch."""

        def of(values: NDArray[Any]) -> NDArray[Any]:
            return values[chosen] if len(values) == len(self.index) and len(values) > 1 else values

        return Batch(
            self.index[chosen],
            self.x[chosen],
            self.y[chosen],
            of(self.left),
            of(self.bottom),
            of(self.right),
            of(self.top),
            (of(self.ray[0]), of(self.ray[1]), of(self.ray[2])),
            of(self.footprint),
            (of(self.slack[0]), of(self.slack[1])),
            tuple((of(x), of(y)) for x, y in self.seeds),
            self.shift,
            self.faces,
            self.layers,
        )

    def span(self, axis: int) -> tuple[Floats, Floats, Floats]:
        """Place of the points, lower and upper end of the scope along an axis (0: x, 1: y)."""
        return (self.x, self.left, self.right) if axis == 0 else (self.y, self.bottom, self.top)

    def within(self, axis: int, low: Floats, high: Floats, slack: Floats) -> Batch:
        """The same points in a part of their scope."""
        if axis == 0:
            return replace(self, left=low, right=high, slack=(slack, self.slack[1]))
        return replace(self, bottom=low, top=high, slack=(self.slack[0], slack))


def joined(batches: Sequence[Batch]) -> Batch:
    """Points that have come to the same rule on the same way, but through other parts, as one batch."""
    first = batches[0]

    def of(each: Callable[[Batch], NDArray[Any]]) -> NDArray[Any]:
        return np.concatenate([np.broadcast_to(each(batch), len(batch)) for batch in batches])

    return Batch(
        of(lambda batch: batch.index),
        of(lambda batch: batch.x),
        of(lambda batch: batch.y),
        of(lambda batch: batch.left),
        of(lambda batch: batch.bottom),
        of(lambda batch: batch.right),
        of(lambda batch: batch.top),
        (of(lambda batch: batch.ray[0]), of(lambda batch: batch.ray[1]), of(lambda batch: batch.ray[2])),
        of(lambda batch: batch.footprint),
        (of(lambda batch: batch.slack[0]), of(lambda batch: batch.slack[1])),
        tuple((of(partial(_seed, k, 0)), of(partial(_seed, k, 1))) for k in range(len(first.seeds))),
        first.shift,
        first.faces,
        first.layers,
    )


def _seed(k: int, axis: int, batch: Batch) -> Steps:
    """One coordinate of a corner on the seed stack."""
    return batch.seeds[k][axis]
