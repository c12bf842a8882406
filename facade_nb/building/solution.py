"""A building, solved: the heights of all walls together, then each wall across (docs/buildings.md)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from time import monotonic

from ..design.errors import NoLayout
from ..design.model import Axis, Canvas, Counter, Design, LayerAxis, PatternDef, Symbol
from ..solver.budget import Clock
from ..solver.model.layout import AxisLayout, Layout, PlacedShape
from ..solver.model.objective import Objective
from ..solver.model.problem import axis_problem
from ..solver.schedules.tolerances import TOLERANCES
from ..solver.solution import AxisAnswer, compose, solve_axis
from ..solver.words.enumeration import across
from .faces import Face, faces, width_of
from .heights import Heights
from .layout import BuildingLayout, SolvedFace
from .model import Building
from .quoins import folded
from .roofline import eaves_of, shown
from .vertical import Joint, names_up

__all__ = ["solve"]

_HEIGHTS = 0.7
"""What part of the time the heights may take: they are one problem, and each wall across is soon done."""

_Width = tuple[str, float]
"""A design, and how wide it stands, to the micrometre."""


def solve(
    building: Building,
    *,
    objective: Objective | None = None,
    time_limit: float | None = 30.0,
    should_stop: Callable[[], bool] | None = None,
) -> BuildingLayout:
    """Solve a building.

    Along y the layers of all designs are one problem, so that walls share the boundaries of their main groups. Across,
    each wall is solved by itself; walls of one design and one width are one.

    Parameters
    ----------
    objective
        What is minimised, as for a design.
    time_limit
        Seconds for all together, or None. When they are over, the best so far is returned, and `complete` is False.
    should_stop
        Called now and then. If it returns true, the search ends.

    Raises
    ------
    NoLayout
        If there is no layout, or none was found in time. It says of which wall, or of the heights, and why.
    """
    run = _Run(building, objective, time_limit, should_stop)
    from .dormers import covered

    heights, widths = run.answers()
    parts = {key: run.joint.part(key, heights) for key in run.joint.designs}
    laid: dict[_Width, Layout] = {}
    for (key, width), answer in widths.items():
        design = replace(building.designs[key], canvas=Canvas(width, building.height))
        laid[key, width] = compose(design, answer, parts.get(key) or AxisAnswer(AxisLayout()))
    around = faces(building)
    bare = [_layout(building, face, laid) for face in around]
    eaves = eaves_of(building, bare)
    whole = [_with_quoins(building, face, own, laid, eaves) for face, own in zip(around, bare, strict=True)]
    solved = tuple(
        SolvedFace(face, layout, shown(building, face, layout, eaves))
        for face, layout in zip(around, whole, strict=True)
    )
    warnings = [f"heights: {text}" for text in heights.warnings]
    warnings += [
        f"heights: no row of design {key!r} fills its wall from bottom to top, so its heights are its own"
        for key in run.heights.apart
    ]
    warnings += [f"{own.face.name}: {text}" for own in solved for text in own.layout.warnings]
    complete = heights.complete and all(answer.complete for answer in widths.values())
    strips = {
        own.design: laid[own.design, round(width_of(building, own), 6)]
        for own in building.corners.values()
        if own.kind == "quoins"
    }
    return covered(
        BuildingLayout(
            building, solved, heights.layout, eaves, tuple(dict.fromkeys(warnings)), complete, strips
        )
    )


def _layout(building: Building, face: Face, laid: Mapping[_Width, Layout]) -> Layout:
    """Of a face, without quoins."""
    return _blind(building, face) if face.design is None else laid[face.design, round(face.length, 6)]


def _with_quoins(
    building: Building, face: Face, own: Layout, laid: Mapping[_Width, Layout], eaves: float
) -> Layout:
    """The layout with the quoins at its ends, which end at the eaves."""
    added: list[PlacedShape] = []
    for side, quoins in enumerate(face.quoins):
        if quoins is not None:
            number, corner = quoins
            strip = laid[corner.design, round(width_of(building, corner), 6)]
            added += folded(strip, f"corner {number + 1}", face.length, eaves, left=side == 0)
    return replace(own, shapes=(*own.shapes, *added)) if added else own


def _blind(building: Building, face: Face) -> Layout:
    """A wall without anything in it."""
    rect = (0.0, 0.0, face.length, building.height)
    wall = PlacedShape("wall", "wall", "wall", rect, material=building.material)
    return Layout(face.name, Canvas(face.length, building.height), shapes=(wall,))


@dataclass
class _Run:
    """One call of `solve`."""

    building: Building
    objective: Objective | None
    time_limit: float | None
    should_stop: Callable[[], bool] | None
    joint: Joint = field(init=False)
    heights: Heights = field(init=False)

    def __post_init__(self) -> None:
        self.joint = Joint(self.building)
        self._end = None if self.time_limit is None else monotonic() + self.time_limit
        own = None if self.time_limit is None else self.time_limit * _HEIGHTS
        clock = Clock(own, self.should_stop)
        self.heights = Heights(self.joint, self.objective or Objective(), self._one, clock)

    def answers(self) -> tuple[AxisAnswer, dict[_Width, AxisAnswer]]:
        """The best heights, and the best answer across for every design in every width."""
        if not self.joint.designs:
            return AxisAnswer(AxisLayout()), {wanted: AxisAnswer(AxisLayout()) for wanted in self._widths()}
        up, wide = self._solved({})
        held = self._tied()
        if not held or all(
            answer.counters.get(name) == up.counters.get(self.joint.counter(key, name))
            for (key, _), answer in wide.items()
            for name in self._tied_of(key)
        ):
            return up, wide
        return self._together(held, _cost(up, wide))

    def _together(self, held: Sequence[str], floor: float) -> tuple[AxisAnswer, dict[_Width, AxisAnswer]]:
        """Where counters tie heights to widths: the best over all values that they may have on both."""
        best: tuple[AxisAnswer, dict[_Width, AxisAnswer]] | None = None
        failure: NoLayout | None = None
        complete = True
        for values in product(*(self._values(name) for name in held)):
            try:
                found = self._solved(dict(zip(held, values, strict=True)))
            except NoLayout as error:
                complete = complete and error.constraint != "time"
                failure = failure or error
                continue
            if best is None or _rank(*found) < _rank(*best):
                best = found
            if _cost(*best) <= floor + 1e-9:
                break
        if best is None:
            raise failure or NoLayout(
                f"No value of {', '.join(held)} suits both the heights and all walls that it stands in.",
                counters=tuple(held),
            )
        up, wide = best
        return (up if complete else replace(up, complete=False)), wide

    def _solved(self, values: Mapping[str, int]) -> tuple[AxisAnswer, dict[_Width, AxisAnswer]]:
        """Heights and widths with some counters of the joint design held."""
        wanted = list(self._widths())
        up = self.heights.solve(values)
        wide: dict[_Width, AxisAnswer] = {}
        for n, (key, width) in enumerate(wanted):
            own = {
                name: values[joined]
                for name in self._tied_of(key)
                if (joined := self.joint.counter(key, name)) in values
            }
            design = _across(_held(self.building.designs[key], own), width)
            if not design.stack:  # nothing stands on it
                wide[key, width] = AxisAnswer(AxisLayout())
                continue
            where = f"Design {key!r}, {width:g} m wide"
            wide[key, width] = self._answer(design, "x", len(wanted) - n, where)
        return up, wide

    def _answer(self, design: Design, axis: Axis, share: int, where: str) -> AxisAnswer:
        """One axis, in its share of the time that is left."""
        left = None if self._end is None else max(self._end - monotonic(), 0.0)
        if left is not None:
            left /= min(share, 2)  # most are quick, and leave their time to others
        try:
            return solve_axis(
                design, axis, objective=self.objective, time_limit=left, should_stop=self.should_stop
            )
        except NoLayout as error:
            error.message = f"{where}: {error.message}"
            raise

    def _one(self, design: Design, where: str) -> AxisAnswer:
        """The heights of one design, in half of the time that is left."""
        return self._answer(design, "y", 2, where)

    def _widths(self) -> dict[_Width, None]:
        """Every design in every width that it stands in."""
        found: dict[_Width, None] = {}
        for face in faces(self.building):
            if face.design is not None:
                found.setdefault((face.design, round(face.length, 6)))
        for corner in self.building.corners.values():
            found.setdefault((corner.design, round(width_of(self.building, corner), 6)))
        return found

    def _tied_of(self, key: str) -> tuple[str, ...]:
        """The counters of a design that stand on both axes."""
        design = self.building.designs[key]
        wide = {name for layer in design.stack for name in design.patterns[layer.x.pattern].parsed.counters}
        return tuple(name for name in names_up(design)[1] if name in wide)

    def _tied(self) -> list[str]:
        """All of them, under their joint names."""
        return list(
            dict.fromkeys(
                self.joint.counter(key, name) for key in self.joint.designs for name in self._tied_of(key)
            )
        )

    def _values(self, joined: str) -> range:
        """What a tied counter may be: where the heights have words, and every width that it stands in."""
        found = [across(axis_problem(self.joint.everything, "y"), [joined], TOLERANCES[-1]).get(joined)]
        for key, width in self._widths():
            for name in self._tied_of(key):
                if self.joint.counter(key, name) == joined:
                    problem = axis_problem(_across(self.building.designs[key], width), "x")
                    found.append(across(problem, [name], TOLERANCES[-1]).get(name))
        bounds = [own for own in found if own is not None]
        return range(int(max(low for low, _ in bounds)), int(min(high for _, high in bounds)) + 1)


def _held(design: Design, values: Mapping[str, int]) -> Design:
    """The design with some counters held at a value."""
    if not values:
        return design
    counters = dict(design.counters)
    for name, value in values.items():
        counters[name] = replace(design.counters.get(name) or Counter(name), value=value)
    return replace(design, counters=counters)


def _across(design: Design, width: float) -> Design:
    """A design to be solved across alone: along y all its layers are one storey."""
    storey = "storey"
    while storey in design.symbols or storey in design.patterns:
        storey += "_"
    layers = tuple(replace(layer, y=LayerAxis(storey)) for layer in design.layers)
    return replace(
        design,
        canvas=Canvas(width, 1.0),
        symbols={**design.symbols, storey: Symbol(storey, 1.0)},
        patterns={**design.patterns, storey: PatternDef(storey, f"<{storey}>")},
        layers=layers,
    )


def _all(up: AxisAnswer, wide: Mapping[_Width, AxisAnswer]) -> Iterator[AxisAnswer]:
    yield up
    yield from wide.values()


def _cost(up: AxisAnswer, wide: Mapping[_Width, AxisAnswer]) -> float:
    return sum(own.layout.cost for own in _all(up, wide))


def _rank(up: AxisAnswer, wide: Mapping[_Width, AxisAnswer]) -> tuple[float, int, float]:
    """Least J, then most columns, then least deviation, as for a design; rounded, so that noise decides nothing."""
    return (
        round(_cost(up, wide), 6),
        -sum(own.columns for own in _all(up, wide)),
        round(sum(own.layout.deviation for own in _all(up, wide)), 6),
    )
