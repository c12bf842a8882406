"""Cars and hedges as meshes of a few planes each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .chance import Floats, length, millimetres
from .faces import Faces
from .rings import Ints
from .street_life import Cars, Hedges

__all__ = ["RULES", "add_cars", "add_hedges"]

_HALF, _ROOF, _BELT, _NOSE, _LOW = 0.86, 0.6, 0.93, 0.74, 0.02
"""Half the width of a car and of its roof; its height below the windows, at its nose, and of its lower edge, metres."""

_SHAPES = (
    # From the tail: where the rear window begins and ends, where the windscreen ends and begins, as parts of the
    # length; height of the roof, metres.
    (0.015, 0.13, 0.55, 0.70, 1.46),
    (0.14, 0.30, 0.58, 0.71, 1.42),
    (0.01, 0.05, 0.72, 0.84, 1.85),
)

RULES = (
    *(f"car.{name}" for name in ("Side", "Cabin", "Screen", "Paint", "Front", "Back")),
    "hedge.Leaves",
)
"""Rules that their planes begin with."""

Places = Mapping[str, tuple[int, int]]
Corner = tuple[Floats, Floats, Floats]


def add_cars(faces: Faces, cars: Cars, places: Places, first: int) -> None:
    """Add cars; their owners are numbers from `first` downwards, below those of no one."""
    if not len(cars):
        return
    tail, back, front, cowl, top = np.array(_SHAPES)[cars.kind].T
    long = cars.long

    def x(part: Floats | float) -> Floats:
        return (np.broadcast_to(part, long.shape) - 0.5) * long

    def z(height: float) -> Floats:
        return np.full(len(cars), height)

    def profile(points: Sequence[tuple[Floats, Floats, float]], side: float) -> list[Corner]:
        """Corners (along, aside, up) on one side, from (along, up, half the width)."""
        return [(a, np.full(len(cars), side * half), up) for a, up, half in points]

    body = [
        (x(0.0), z(_LOW), _HALF), (x(1.0), z(_LOW), _HALF), (x(1.0), z(_NOSE), _HALF), (x(cowl), z(_BELT), _HALF),
        (x(0.0), z(_BELT), _HALF),
    ]  # fmt: skip
    cabin = [
        (x(tail), z(_BELT), _HALF),
        (x(cowl), z(_BELT), _HALF),
        (x(front), top, _ROOF),
        (x(back), top, _ROOF),
    ]
    tail_, cowl_, front_, back_ = cabin
    owner = first - np.arange(len(cars))
    axes = {"x": cars.way, "y": np.column_stack([-cars.way[:, 1], cars.way[:, 0]])}
    seed = cars.seed / 64.0

    def add(corners: list[Corner], along: str, sign: float, rule: str) -> None:
        points = [
            np.column_stack([cars.at + axes["x"] * a[:, None] + axes["y"] * b[:, None], c])
            for a, b, c in corners
        ]
        way = np.column_stack([sign * axes[along], np.zeros(len(cars))])
        start = np.tile(np.array(places[rule], float), (len(cars), 1))
        faces.planes(millimetres(np.stack(points, axis=1)), way, start, seed, owner)

    def across(lower: tuple[Floats, Floats, float], upper: tuple[Floats, Floats, float]) -> list[Corner]:
        """A plane from side to side, that one sees from in front: its lower edge and its upper one."""
        return [
            *profile([lower], -1.0),
            *profile([lower], 1.0),
            *profile([upper], 1.0),
            *profile([upper], -1.0),
        ]

    for side, sign in ((-1.0, 1.0), (1.0, -1.0)):
        for shape, rule in ((body, "car.Side"), (cabin, "car.Cabin")):
            corners = profile(shape, side)
            add(corners if side < 0 else corners[::-1], "x", sign, rule)
    add(across(body[1], body[2]), "y", 1.0, "car.Front")
    add(across(body[2], cowl_), "y", 1.0, "car.Paint")
    add(across(cowl_, front_), "y", 1.0, "car.Screen")
    add(across(front_, back_), "y", 1.0, "car.Paint")
    add(across(tail_, back_)[::-1], "y", -1.0, "car.Screen")
    add(across(body[4], tail_)[::-1], "y", -1.0, "car.Paint")
    add(across(body[0], body[4])[::-1], "y", -1.0, "car.Back")


def add_hedges(faces: Faces, hedges: Hedges, places: Places, first: int) -> None:
    """Add hedges: boxes without a floor. Owners as of `add_cars`."""
    if not len(hedges):
        return
    way = hedges.end - hedges.start
    unit = way / np.maximum(length(way), 1e-9)[:, None]
    aside = np.column_stack([-unit[:, 1], unit[:, 0]]) * (hedges.wide / 2)[:, None]
    ring = [hedges.start - aside, hedges.end - aside, hedges.end + aside, hedges.start + aside]
    low = [np.column_stack([at, np.zeros(len(hedges))]) for at in ring]
    high = [np.column_stack([at, hedges.tall]) for at in ring]
    owner: Ints = first - np.arange(len(hedges))
    seed = np.zeros((len(hedges), 2))
    start = np.tile(np.array(places["hedge.Leaves"], float), (len(hedges), 1))
    level = np.zeros((len(hedges), 1))
    for k in range(4):
        corners = [low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k]]
        along = np.column_stack([ring[(k + 1) % 4] - ring[k], level])
        faces.planes(millimetres(np.stack(corners, axis=1)), along, start, seed, owner)
    faces.planes(millimetres(np.stack(high, axis=1)), np.column_stack([unit, level]), start, seed, owner)
