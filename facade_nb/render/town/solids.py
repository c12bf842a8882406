"""Cars and hedges as meshes of a few planes each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .chance import Floats, length, millimetres
from .faces import Faces
from .rings import Ints
from .street_life import Cars, Hedges

__all__ = ["RULES", "add_cars", "add_hedges"]

_HALF, _END, _ROOF = 0.86, 0.66, 0.62
"""Half the width of a car, of its ends, which are rounded, and of its roof, metres."""

_SILL, _FRONT, _BACK = 0.2, 0.54, 0.6
"""Heights of the lower edge of a body, and of where its ends begin to slope, in front and behind, metres."""

_ROUND = 0.17
"""So far from its ends a car has its whole width, metres."""

_WHEEL, _AXLE = 0.66, 0.14
"""How wide a wheel is, metres; which part of a side that wheels leave free lies before the first (``car.WheelRow``)."""

_TREAD, _GROUND = ((0.3, _SILL), (0.19, 0.06)), 0.005
"""Half the width of what shows of a wheel below the sill, and at which height, metres; and its lowest point
(``car.Tread``)."""

_UNDER, _ENDS, _SIDES = 0.012, 0.15, 0.06
"""How high above the ground lies what is dark below a car, and how far within its ends and sides, metres."""

_SHAPES = (
    # From the tail: where the rear window begins (metres) and ends, where the roof is highest, where the windscreen
    # ends and begins, as parts of the length; heights of the roof there, of the bonnet's end, and below the windows.
    (0.17, 0.09, 0.34, 0.53, 0.715, 1.37, 1.46, 1.38, 0.74, 0.94),
    (0.62, 0.29, 0.43, 0.55, 0.70, 1.33, 1.41, 1.34, 0.72, 0.92),
    (0.17, 0.055, 0.36, 0.55, 0.70, 1.38, 1.45, 1.37, 0.73, 0.93),
    (0.17, 0.04, 0.5, 0.745, 0.87, 1.85, 1.89, 1.79, 0.88, 1.04),
)

RULES = (
    *(
        f"car.{name}"
        for name in (
            "Side",
            "Cabin",
            "Screen",
            "Paint",
            "Corner",
            "Front",
            "Back",
            "Nose",
            "Stern",
            "Tread",
            "Under",
        )
    ),
    *(f"car.{name}" for name in ("Lamp", "Tail", "NoseLit", "SternLit", "LampLit", "TailLit")),
    "hedge.Leaves",
)
"""Rules that their planes begin with."""

Places = Mapping[str, tuple[int, int]]
Corner = tuple[Floats, Floats, Floats]
"""How far ahead, to the left, and up (c,), metres."""


def add_cars(faces: Faces, cars: Cars, places: Places, first: int) -> None:
    """Add cars; their owners are numbers from `first` downwards, below those of no one."""
    if not len(cars):
        return
    tail, back, mid, front, cowl, back_up, mid_up, front_up, nose_up, belt = np.array(_SHAPES)[cars.kind].T
    long, count = cars.long, len(cars)
    owner = first - np.arange(count)
    axes = {"x": cars.way, "y": np.column_stack([-cars.way[:, 1], cars.way[:, 0]])}
    lean = (_HALF - _ROOF) / (mid_up - belt)  # walls of the cabin are flat, also where the roof is bent

    def at(ahead: Floats | float, aside: Floats | float, up: Floats | float) -> Corner:
        """Aside and up; ahead of the tail."""
        spots = [np.broadcast_to(np.asarray(own, float), (count,)) for own in (ahead, aside, up)]
        return spots[0] - long / 2, spots[1], spots[2]

    def add(corners: list[Corner], along: str, sign: float, rule: str | tuple[str, str]) -> None:
        """A plane; of two rules the second is that of cars on their way."""
        points = [
            np.column_stack([cars.at + axes["x"] * a[:, None] + axes["y"] * b[:, None], c])
            for a, b, c in corners
        ]
        way = np.column_stack([sign * axes[along], np.zeros(count)])
        still, moving = (rule, rule) if isinstance(rule, str) else rule
        start = np.where(cars.moves[:, None], places[moving], places[still]).astype(float)
        faces.planes(millimetres(np.stack(points, axis=1)), way, start, cars.seed / 64.0, owner)

    def across(lower: tuple[Floats | float, ...], upper: tuple[Floats | float, ...]) -> list[Corner]:
        """A plane from side to side, that one sees from in front: its edges as ahead, half the width, up."""
        return [
            at(end[0], sign * end[1], end[2])
            for end, sign in ((lower, -1.0), (lower, 1.0), (upper, 1.0), (upper, -1.0))
        ]

    def half(up: Floats) -> Floats:
        return _HALF - lean * (up - belt)

    nose, axle = long - _ROUND, _ROUND + _AXLE * (long - 2 * _ROUND - 2 * _WHEEL) + _WHEEL / 2
    lamps, tails = ("car.Lamp", "car.LampLit"), ("car.Tail", "car.TailLit")
    for side in (-1.0, 1.0):
        turned = slice(None, None, 1 if side < 0 else -1)

        def wall(spots: Sequence[tuple[Floats | float, Floats | float]], side: float = side) -> list[Corner]:
            return [at(ahead, side * _HALF, up) for ahead, up in spots]

        wheels = [axle, long - axle]
        below = [(own + sign * _TREAD[0][0], _SILL) for own in wheels for sign in (-1.0, 1.0)]
        body = wall([
            (_ROUND, _SILL), *below, (nose, _SILL), (nose, _FRONT), (nose, nose_up), (cowl * long, belt), (tail, belt),
            (_ROUND, belt), (_ROUND, _BACK),
        ])  # fmt: skip
        add(body[turned], "x", -side, "car.Side")
        for own in wheels:
            left, right = ([(own + sign * aside, up) for aside, up in _TREAD] for sign in (-1.0, 1.0))
            add(wall([*left, (own, _GROUND), *right[::-1]])[turned], "x", -side, "car.Tread")
        cabin = [
            at(ahead, side * half(up), up)
            for ahead, up in (
                (tail, belt), (cowl * long, belt), (front * long, front_up), (mid * long, mid_up),
                (back * long, back_up),
            )
        ]  # fmt: skip
        add(cabin[turned], "x", -side, "car.Cabin")
        tip, edge = at(long, side * _END, _FRONT), at(nose, side * _HALF, _FRONT)
        low_tip, low_edge = at(long, side * _END, _SILL), at(nose, side * _HALF, _SILL)
        add([low_edge, low_tip, tip, edge][turned], "y", 1.0, "car.Corner")
        add([edge, tip, at(nose, side * _HALF, nose_up)][turned], "y", 1.0, lamps)
        tip, edge = at(0.0, side * _END, _BACK), at(_ROUND, side * _HALF, _BACK)
        low_tip, low_edge = at(0.0, side * _END, _SILL), at(_ROUND, side * _HALF, _SILL)
        add([low_tip, low_edge, edge, tip][turned], "y", -1.0, "car.Corner")
        add([tip, edge, at(_ROUND, side * _HALF, belt)][turned], "y", -1.0, tails)
    roof = [(own * long, half(up), up) for own, up in ((front, front_up), (mid, mid_up), (back, back_up))]
    window, screen, hood = (tail, _HALF, belt), (cowl * long, _HALF, belt), (nose, _HALF, nose_up)
    add(across((long, _END, _SILL), (long, _END, _FRONT)), "y", 1.0, "car.Front")
    add(across((long, _END, _FRONT), hood), "y", 1.0, ("car.Nose", "car.NoseLit"))
    add(across(hood, screen), "y", 1.0, "car.Paint")
    add(across(screen, roof[0]), "y", 1.0, "car.Screen")
    add(across(roof[0], roof[1]), "y", 1.0, "car.Paint")
    add(across(roof[1], roof[2]), "y", 1.0, "car.Paint")
    add(across(window, roof[2])[::-1], "y", -1.0, "car.Screen")
    add(across((_ROUND, _HALF, belt), window)[::-1], "y", -1.0, "car.Paint")
    add(across((0.0, _END, _BACK), (_ROUND, _HALF, belt))[::-1], "y", -1.0, ("car.Stern", "car.SternLit"))
    add(across((0.0, _END, _SILL), (0.0, _END, _BACK))[::-1], "y", -1.0, "car.Back")
    wide = _HALF - _SIDES
    add(across((long - _ENDS, wide, _UNDER), (_ENDS, wide, _UNDER)), "y", 1.0, "car.Under")


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
