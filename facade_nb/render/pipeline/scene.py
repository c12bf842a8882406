"""What the pipeline draws: triangles that carry their façades, and the grammar that they ask."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..texture.facades import Facade
from ..texture.grammar import Grammar
from ..texture.joining import joined
from ..texture.noise import Seed
from ..texture.question import Question
from ..texture.uploads import Upload, seeds_upload
from .vertices import LAMP, VERTEX, turning

__all__ = ["CHUNK", "Scene"]

CHUNK = np.dtype(
    [("first", np.uint32), ("count", np.uint32), ("low", np.float32, 3), ("high", np.float32, 3)]
)
"""A part of a mesh: where its indices begin, how many they are, and the box around it."""


@dataclass(frozen=True, eq=False)
class Scene:
    """Triangles with their grammar.

    Attributes
    ----------
    vertices
        (v,) `VERTEX`.
    indices
        (3 t,) uint32, counter-clockwise where the front is seen.
    grammar
        Whose rules `start` names.
    chunks
        (c,) `CHUNK`: parts that are drawn, or passed over, as a whole. None: all is one.
    seeds
        Where seeds are any numbers: each once. `seed` of a vertex is then the place of its own, and 0.
    sunny
        Least and greatest coordinates (2, 3) of what is in the maps of shadows. None: all of it.
    solid
        Those of what throws shadows: all but the ground. None: as `sunny`.
    """

    vertices: np.ndarray
    indices: NDArray[np.uint32]
    grammar: Grammar
    given_chunks: np.ndarray | None = field(default=None)
    seeds: tuple[Seed, ...] = ()
    sunny: NDArray[np.float64] | None = None
    solid: NDArray[np.float64] | None = None

    def __post_init__(self) -> None:
        if self.vertices.dtype != VERTEX:
            raise ValueError(f"vertices: expected an array of VERTEX; found {self.vertices.dtype}")
        if self.indices.dtype != np.uint32 or self.indices.ndim != 1 or len(self.indices) % 3:
            raise ValueError("indices: expected (3 t,) uint32")
        if len(self.indices) and int(self.indices.max()) >= len(self.vertices):
            raise ValueError(
                f"indices: expected numbers below {len(self.vertices)}; found {self.indices.max()}"
            )

    @cached_property
    def chunks(self) -> np.ndarray:
        """Parts that are drawn, or passed over, as a whole."""
        if self.given_chunks is not None:
            return self.given_chunks
        chunks = np.zeros(1 if len(self.indices) else 0, CHUNK)
        if len(chunks):
            position = self.vertices["position"]
            chunks[0] = (0, len(self.indices), position.min(axis=0), position.max(axis=0))
        return chunks

    @cached_property
    def turning(self) -> NDArray[np.bool_]:
        """(c,) which chunks turn to whoever looks: those whose first vertex has no normal."""
        if not len(self.chunks):
            return np.zeros(0, bool)
        first = self.indices[self.chunks["first"]]
        return turning(self.vertices[first])

    @cached_property
    def has_lamps(self) -> bool:
        """Whether there are street lamps in it."""
        if not self.turning.any():
            return False
        alike = (np.abs(self.vertices["size"] - LAMP) < 1e-3).all(axis=1)
        return bool(turning(self.vertices[alike]).any())

    @cached_property
    def box(self) -> NDArray[np.float64]:
        """Least and greatest coordinates (2, 3), metres; zeros where there is nothing."""
        if not len(self.chunks):
            return np.zeros((2, 3))
        return np.stack([self.chunks["low"].min(axis=0), self.chunks["high"].max(axis=0)]).astype(np.float64)

    @property
    def solid_box(self) -> NDArray[np.float64]:
        """Least and greatest coordinates (2, 3) of what throws shadows, metres."""
        return next(own for own in (self.solid, self.sunny, self.box) if own is not None)

    @property
    def defines(self) -> tuple[str, ...]:
        """What shaders are told of it."""
        return ("SEEDS",) if self.seeds else ()

    @property
    def uploads(self) -> tuple[Upload, ...]:
        """The textures of its own, beside the grammar and its tiles."""
        return (seeds_upload(self.seeds),) if self.seeds else ()

    @cached_property
    def question(self) -> Question:
        """What the evaluator is given of the grammar."""
        return self.grammar.question((1.0, 1.0))

    @cached_property
    def relief_question(self) -> Question:
        """The same with the heights of tiles."""
        return self.grammar.question((1.0, 1.0), relief=True)

    @property
    def bytes(self) -> dict[str, int]:
        """What the graphics card holds of it, heights of tiles included."""
        from ..texture.uploads import tile_uploads

        held = {own.name: len(own.content) for own in tile_uploads(self.relief_question.atlas)}
        found = {
            "vertices": int(self.vertices.nbytes + self.indices.nbytes),
            "grammars": int(self.question.texture.nbytes),
            "tiles": held["atlas"] + held["tile_table"],
            "noise": held["noise"],
        }
        return found | {"total": sum(found.values())}

    @classmethod
    def of_facades(cls, facades: Sequence[Facade]) -> Scene:
        """Rectangles in space, each with its grammar. Raises `ValueError` for none."""
        if not facades:
            raise ValueError("expected at least one façade")
        grammars = tuple(dict.fromkeys(own.grammar for own in facades))
        grammar, firsts = joined(*grammars)
        first_of = dict(zip(grammars, firsts, strict=True))
        held = all(_held(own.seed) for own in facades)
        seeds = () if held else tuple(dict.fromkeys(Seed.of(own.seed) for own in facades))
        vertices = np.zeros((len(facades), 4), VERTEX)
        for k, own in enumerate(facades):
            (right, up, out), (width, height) = own.axes, own.size
            spots = np.array([(0, 0), (width, 0), (width, height), (0, height)], np.float32)
            vertices[k]["place"] = spots
            vertices[k]["position"] = (
                np.array(own.origin, np.float32) + spots[:, :1] * right + spots[:, 1:] * up
            )
            vertices[k]["size"] = own.size
            start = first_of[own.grammar] + own.grammar.index(own.start)
            vertices[k]["start"] = grammar.encoding.positions[start]
            vertices[k]["seed"] = (seeds.index(Seed.of(own.seed)), 0) if seeds else own.seed
            vertices[k]["normal"], vertices[k]["tangent"] = out, right
        corners = (
            np.array([0, 1, 2, 0, 2, 3], np.uint32) + 4 * np.arange(len(facades), dtype=np.uint32)[:, None]
        )
        return cls(vertices.reshape(-1), corners.reshape(-1), grammar, seeds=seeds)


def _held(seed: tuple[float, float]) -> bool:
    """Whether a vertex holds a seed as it is (see `VERTEX`)."""
    return all(0 <= value < 16384 and value * 64 % 1 == 0 for value in seed)
