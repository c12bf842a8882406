"""What stands about in a town: trees, street lamps, chimneys, people. All turn to whoever looks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..texture import Grammar
from .chance import Floats, millimetres
from .faces import Faces
from .lamplight import packed, reaches
from .rings import Ints

if TYPE_CHECKING:
    from .plan import Plan

__all__ = [
    "BIRCH",
    "CHIMNEY",
    "KINDS",
    "LAMP",
    "LIME",
    "MAPLE",
    "NOTHING",
    "PEOPLE",
    "PERSON",
    "RULES",
    "SPRUCE",
    "Things",
    "stand",
]

LIME, MAPLE, BIRCH, SPRUCE, LAMP, CHIMNEY, PERSON = range(7)
"""Kinds of things; people are all kinds from `PERSON` on."""

KINDS = ("Lime", "Maple", "Birch", "Spruce", "Lamp", "Chimney", "First", "Second", "Third", "Fourth")
"""Their names, and those of their rules in the namespaces ``life`` and ``people``."""

PEOPLE = len(KINDS) - PERSON
"""How many kinds of people there are."""

_RULES = tuple(f"{'life' if kind < PERSON else 'people'}.{name}" for kind, name in enumerate(KINDS))

RULES = (*_RULES, *(f"life.Small{name}" for name in KINDS[: BIRCH + 1]), "life.Trunk")
"""All rules that things begin with."""

_LARGE = 8.6
"""A tree of that height has three crowns beside each other; a lower one is seen whole in one tile, metres."""


@dataclass(frozen=True, slots=True, eq=False)
class Things:
    """Things as flat arrays.

    Attributes
    ----------
    at
        (t, 2) where each stands, metres.
    foot
        (t,) how high that is above the ground.
    kind
        (t,) index into `KINDS`.
    tall, wide
        (t,) metres.
    """

    at: Floats
    foot: Floats
    kind: NDArray[np.uint8]
    tall: Floats
    wide: Floats

    def __len__(self) -> int:
        return len(self.at)

    @classmethod
    def of(
        cls,
        at: Floats,
        kind: Ints | int,
        tall: Floats | float,
        wide: Floats | float,
        foot: Floats | float = 0.0,
    ) -> Things:
        """Things in whole millimetres; what is the same for all may be one number."""
        count = len(at)

        def each(value: Floats | float) -> Floats:
            return millimetres(np.broadcast_to(np.asarray(value, float), (count,)))

        return cls(
            millimetres(np.asarray(at, float).reshape(-1, 2)),
            each(foot),
            np.broadcast_to(np.asarray(kind, np.uint8), (count,)).copy(),
            each(tall),
            each(wide),
        )

    def take(self, chosen: NDArray[np.bool_] | Ints) -> Things:
        """Some of them."""
        return Things(*(getattr(self, name)[chosen] for name in self.__slots__))

    def __add__(self, other: Things) -> Things:
        pairs = ((getattr(self, name), getattr(other, name)) for name in self.__slots__)
        return Things(*(np.concatenate(pair) for pair in pairs))


NOTHING = Things.of(np.zeros((0, 2)), 0, 0.0, 0.0)
"""None."""

_CROWNS = ((0.02, -0.01, 0.66, 0.78), (0.19, 0.04, 0.5, 0.6), (-0.17, -0.08, 0.55, 0.62))
"""Crowns of a large tree: where they stand beside its trunk, and how high and wide they are, as parts of its size."""


def stand(faces: Faces, things: Things, grammar: Grammar, plan: Plan) -> None:
    """Add things to a mesh. They belong to no building; the seed of people tells them apart."""
    places = dict(zip(grammar.encoding.names, grammar.encoding.positions, strict=True))
    rule = np.array([places[name] for name in _RULES], float)
    large = things.take((things.kind <= BIRCH) & (things.tall >= _LARGE))
    for x, y, up, wide in _CROWNS:
        # Every second tree the other way round, so that a row of them has no rhythm.
        turn = 1 - 2 * (np.arange(len(large)) % 2)
        at = millimetres(large.at + large.wide[:, None] * np.array([x, y]) * turn[:, None])
        size = np.column_stack([large.wide * wide, large.wide * wide])
        middle = large.foot + np.minimum(large.tall * up, large.tall - size[:, 1] / 2)
        _turning(faces, at, middle, size, rule[large.kind], upright=False)
    high = 0.55 * large.tall
    _turning(
        faces, large.at, large.foot + high / 2, np.column_stack([0.14 + 0.022 * large.tall, high]),
        np.tile(places["life.Trunk"], (len(large), 1)), upright=True,
    )  # fmt: skip
    small = (things.kind <= BIRCH) & (things.tall < _LARGE)
    rule[: BIRCH + 1] = [places[f"life.Small{name}"] for name in KINDS[: BIRCH + 1]]
    posts = things.take(small | (things.kind >= SPRUCE))
    size = np.column_stack([posts.wide, posts.tall])
    seed = np.where((posts.kind >= PERSON)[:, None], _seeds(posts.at), 0.0)
    shade = np.zeros((len(posts), 3))
    lamps = posts.kind == LAMP
    shade[lamps] = packed(reaches(plan, posts.at[lamps]))
    _turning(faces, posts.at, posts.foot + posts.tall / 2, size, rule[posts.kind], seed, shade, upright=True)


def _seeds(at: Floats) -> Floats:
    """Seeds that follow from where things stand, in steps of 1/64 m."""
    mm = np.rint(at * 1000).astype(np.int64)
    return ((mm * (7919, 104729) + mm[:, ::-1] * (15485863, 31)) % (1 << 20)) / 64.0


def _turning(
    faces: Faces,
    at: Floats,
    middle: Floats,
    size: Floats,
    start: Floats,
    seed: Floats | None = None,
    shade: Floats | None = None,
    *,
    upright: bool,
) -> None:
    """Quads that turn to whoever looks: all four corners have the place of the middle (see `VERTEX`).

    `shade`: (t, 3) what lamps have in the place of a normal (`lamplight.packed`).
    """
    count = len(at)
    normal = np.zeros((count, 3)) if shade is None else shade[:, [0, 2, 1]] * (1, -1, 1)
    size = millimetres(size)
    spots = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    corners = 4 * np.arange(count)[:, None]
    faces.loose(
        np.repeat(np.column_stack([at, millimetres(middle)]), 4, axis=0),
        (size[:, None] * spots).reshape(-1, 2),
        np.repeat(size, 4, axis=0),
        np.repeat(start, 4, axis=0),
        np.zeros((4 * count, 2)) if seed is None else np.repeat(seed, 4, axis=0),
        np.repeat(normal, 4, axis=0),
        np.tile([0.0, 0.0, 1.0 if upright else 0.0], (4 * count, 1)),
        np.full(4 * count, -1),
        np.concatenate([corners + np.array([0, 1, 2]), corners + np.array([0, 2, 3])]),
    )
