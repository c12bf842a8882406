"""One height for all walls.

Each design is aligned along y as it is alone. The *spine* of a design is the row that fills its wall from bottom to
top; the spines of all designs are aligned with each other, in a group of their own. Then one least-squares problem
sizes it all: as all letters of a symbol have one size, what that group makes of a spine holds in the wall that it is
taken from. So the walls meet in the boundaries of that group.

Which words are chosen is decided over all designs together: the least J of all of them and of the spines' group, in
which loose letters are dear (`LOOSE`), as walls that meet are seen together.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from math import inf

from ..design.errors import NoLayout
from ..design.model import Counter, Design, Layer, Symbol
from ..solver.alignment.group import Group, make_group
from ..solver.alignment.pricing import Priced
from ..solver.assembly.axes import axis_layout
from ..solver.budget import Clock, Stopped
from ..solver.candidates.stream import Candidate
from ..solver.model.layout import AxisLayout
from ..solver.model.letters import Letter, Word
from ..solver.model.objective import Objective
from ..solver.model.problem import axis_problem
from ..solver.schedules.tolerances import TOLERANCES
from ..solver.selection.axis import Best, Solved
from ..solver.sizing.system import size_axis
from ..solver.solution import AxisAnswer
from ..solver.words.enumeration import words
from .choices import Case, Choices, Option
from .cuts import Ways
from .pairs import PairTable, Spine, fitting, pair_table, part_of
from .reaches import Reach
from .spines import quickly
from .vertical import SPINES, Joint, spine_of

__all__ = ["LOOSE", "Heights"]

LOOSE = 2.0
"""What a metre loose costs among spines; within a façade it is 0.25."""

_MISS = 0.25
"""Words of a spine are tried whose preferred sizes miss the height by at most so much of it."""

_SQUEEZED = 0.7
"""No symbol gets smaller by meeting others than so much of what it would be, and would like to be."""

_EPS = 1e-9

Values = Mapping[str, int]
"""Counters under their joint names."""


@dataclass
class Heights:
    """The heights of a building, to be solved.

    Attributes
    ----------
    solve_one
        Solves the heights of one design under its joint names; told what that is called in messages.
    clock
        For the spines.
    """

    joint: Joint
    objective: Objective
    solve_one: Callable[[Design, str], AxisAnswer]
    clock: Clock
    _known: dict[tuple[str, tuple[tuple[str, int], ...]], AxisAnswer | NoLayout] = field(
        default_factory=dict, init=False
    )
    _known_spines: dict[int, Spine] = field(default_factory=dict, init=False)
    _known_pairs: dict[tuple[int, int, float, float], tuple[PairTable, tuple[Spine, Spine]]] = field(
        default_factory=dict, init=False
    )

    @property
    def apart(self) -> tuple[str, ...]:
        """Façades without a spine, where others have one: their heights are their own."""
        walls = [key for key in self.joint.designs if self.joint.is_wall(key)]
        return tuple(key for key in walls if len(walls) > 1 and key not in self.spines({}))

    def spines(self, held: Values) -> dict[str, Layer]:
        """The spine of each design that shares its heights; empty where there is nobody to share them with."""
        joint, found = self.joint, {}
        if len(joint.designs) < 2:
            return {}
        for key in joint.designs:
            made = joint.part(key, self._alone(key, held)).layout
            spine = spine_of(joint.building.designs[key], made, named=not joint.is_wall(key))
            if spine is not None:
                found[key] = spine
        return found if len(found) > 1 else {}

    def solve(self, held: Values) -> AxisAnswer:
        """The best heights with some counters held. Raises `NoLayout`."""
        spines = self.spines(held)
        choices = Choices([self._options(key, spines.get(key), held) for key in self.joint.designs])
        best: _Found | None = None
        complete, floor, unseen = True, 0.0, inf
        try:
            while (floor := choices.floor) < self._enough(best):
                self.clock.check()
                case = choices.take()
                found: list[_Found] = []
                if not case.answers:
                    opened = self._opened(case, held, spines)
                    if opened is not None:
                        choices.back(opened)
                        if best is None and opened.ways is not None:
                            found = self._quick(opened, opened.ways)
                elif case.ways is not None and case.ways.limit == -inf:
                    if best is None or best.quick:
                        found = self._quick(case, case.ways)
                    enough = min([own.cost for own in (best, *found) if own is not None], default=inf)
                    if case.ways.open(enough - case.cost + _EPS):
                        choices.back(case)
                    else:
                        unseen = min(unseen, case.floor)
                else:
                    found = self._together(case, min(choices.floor, self._enough(best)))
                    if not found and case.ways is not None:
                        choices.back(case)
                for own in found:
                    best = own if best is None or own.beats(best) else best
        except Stopped as stop:
            if stop.asked and best is None:
                raise
            complete = False
        if best is None:
            raise self._none(complete)
        return self._answer(spines, best, complete, min(floor, unseen))

    @staticmethod
    def _enough(best: _Found | None) -> float:
        """Cases that cost so much are of no use. What was made quickly gives way to what is as cheap."""
        if best is None:
            return inf
        return best.cost + (_EPS if best.quick else -_EPS)

    def _opened(self, case: Case, held: Values, spines: Mapping[str, Layer]) -> Case | None:
        """The case with the designs solved by its values; None: they have no answer."""
        values = case.values(held)
        if values is None:
            return None
        answers = [self._one(key, values) for key in self.joint.designs]
        whole = [own for own in answers if isinstance(own, AxisAnswer)]
        if len(whole) < len(answers):
            return None
        return Case(case.options, tuple(whole), self._ways(spines, whole) if spines else None)

    def _none(self, complete: bool) -> NoLayout:
        failure = next((own for own in self._known.values() if isinstance(own, NoLayout)), None)
        if failure is not None and complete:
            return failure
        if not complete:
            return NoLayout(
                "The heights of all walls: the time was over before any were found. A longer time limit may find some.",
                axis="y",
                constraint="time",
            )
        return NoLayout(
            "The heights of all walls: no sizes of the symbols suit all designs. Wider bounds of sizes (`min`, `max`), "
            "or fewer `shared` names, may do.",
            axis="y",
            constraint="bounds",
        )

    def _alone(self, key: str, held: Values) -> AxisAnswer:
        own = self._one(key, held)
        if isinstance(own, NoLayout):
            raise own
        return own

    def _one(self, key: str, values: Values) -> AxisAnswer | NoLayout:
        """A design's heights with some counters held."""
        design = self.joint.own(key)
        pinned = tuple((name, values[name]) for name in design.counters if name in values)
        if (key, pinned) not in self._known:
            counters = dict(design.counters)
            counters.update({name: Counter(name, value=value) for name, value in pinned})
            try:
                answer = self.solve_one(replace(design, counters=counters), f"The heights of design {key!r}")
            except NoLayout as error:
                self._known[key, pinned] = error
            else:
                self._known[key, pinned] = answer
        return self._known[key, pinned]

    def _options(self, key: str, spine: Layer | None, held: Values) -> list[Option]:
        """The values that the counters of a design's spine may have, the least costly first."""
        alone = self._alone(key, held)
        least = alone.layout.cost - alone.layout.gap
        if spine is None:
            return [Option((), least)]
        design, canvas = self.joint.own(key), self.joint.building.height
        pattern = design.patterns[self.joint.tagged(key, spine)]
        used = pattern.parsed.counters
        ranges = {name: _range(design.counter(name), held.get(name)) for name in used}
        sizes = {name: own.size for name, own in design.symbols.items() if own.size is not None}
        fit = min(self.objective.fit, 1.0)
        floors: dict[tuple[tuple[str, int], ...], float] = {}
        for word in words(pattern.text, sizes, canvas, _MISS * canvas, ranges):
            miss = fit * abs(canvas - sum(letter.size or 0.0 for letter in word.letters))
            values = tuple((name, word.counters[name]) for name in used)
            floors[values] = min(floors.get(values, inf), max(miss, least))
        floors[tuple((name, alone.counters[name]) for name in used)] = least
        return sorted((Option(values, floor) for values, floor in floors.items()), key=lambda own: own.floor)

    def _ways(self, spines: Mapping[str, Layer], answers: Sequence[AxisAnswer]) -> Ways:
        """All ways to align the spines of some answers."""
        by_key = dict(zip(self.joint.designs, map(_solved, answers), strict=True))
        up = list(reversed(list(spines.items())))
        rows = [by_key[key].candidate.words[self.joint.tagged(key, spine)].letters for key, spine in up]
        canvas = self.joint.building.height
        objective = replace(self.objective, loose=max(LOOSE, self.objective.loose))
        group = make_group(rows, canvas, TOLERANCES[-1] * canvas, objective, check=self.clock.check)
        own = [self._spine(by_key[key], row) for (key, _), row in zip(up, rows, strict=True)]
        bands = [Spine.all([own[i] for i in band.rows]) for band in group.bands]
        return Ways(group, bands, self._tables(group, bands), self.clock.check)

    def _spine(self, solved: Solved, letters: Sequence[Letter]) -> Spine:
        """The spine of an answer, and how high its letters may be as its design allows."""
        if id(solved) not in self._known_spines:
            floors = {name: own.min or 0.0 for name, own in self._bounded([solved]).items()}
            reach = Reach.of(solved.sized.system, [a.symbol for a in letters], floors)
            self._known_spines[id(solved)] = Spine.of([a.size or 0.0 for a in letters], reach)
        return self._known_spines[id(solved)]

    def _tables(self, group: Group, spines: Sequence[Spine]) -> dict[tuple[int, int], PairTable]:
        """What each two spines cost together."""
        omega = fitting(group, spines)[1]
        loose = group.by_loose / (part_of(len(spines)) * (len(spines) - 1)) if len(spines) > 1 else 0.0
        found = {}
        for i, j in combinations(range(len(spines)), 2):
            key = id(spines[i]), id(spines[j]), omega, loose
            if key not in self._known_pairs:
                self.clock.check()
                table = pair_table(spines[i], spines[j], omega, loose, group.tolerance)
                self._known_pairs[key] = table, (spines[i], spines[j])
            found[i, j] = self._known_pairs[key][0]
        return found

    def _quick(self, case: Case, ways: Ways) -> list[_Found]:
        """A good way to align the spines, made at once."""
        solved = [_solved(own) for own in case.answers]
        found = quickly(ways, lambda priced: self._sized(solved, (ways.group, priced)), self.clock.check)
        return [] if found is None else [replace(found, quick=True)]

    def _together(self, case: Case, limit: float) -> list[_Found]:
        """The best ways to align the spines, everything sized; none yet, where they cost more than a limit."""
        solved, ways = [_solved(own) for own in case.answers], case.ways
        if ways is None:
            found = self._sized(solved, None)
            return [] if found is None else [found]
        limit = max(limit - case.cost, ways.floor) + 2 * _EPS
        return ways.advance(lambda priced: self._sized(solved, (ways.group, priced)), limit)

    def _sized(self, solved: Sequence[Solved], spines: tuple[Group, Priced] | None) -> _Found | None:
        """All groups of all designs sized together; None: they cannot be."""
        groups = [group for own in solved for group in own.groups]
        parts = [part for own in solved for part in own.parts]
        cost, columns = sum(own.cost for own in solved), sum(own.columns for own in solved)
        if spines is not None:
            group, priced = spines
            groups.append(group)
            parts.append((priced, 0))
            cost, columns = cost + priced.cost, columns + priced.columns
        symbols = self.joint.everything.symbols if spines is None else self._bounded(solved)
        sized = size_axis(
            groups,
            tuple(parts),
            self.joint.building.height,
            lambda name: symbols.get(name) or Symbol(name),
        )
        if sized is None:
            return None
        named: dict[str, Word] = {name: word for own in solved for name, word in own.candidate.words.items()}
        counters = {name: value for own in solved for name, value in own.candidate.counters.items()}
        whole = Solved(Candidate(named, counters), tuple(groups), tuple(parts), sized, cost, columns)
        return _Found(cost, whole)

    def _bounded(self, solved: Sequence[Solved]) -> Mapping[str, Symbol]:
        """The symbols, of which none may be squeezed by what its wall meets: a ledge stays a ledge."""
        found = dict(self.joint.everything.symbols)
        for own in solved:
            for name, size in own.sized.sizes.items():
                symbol = found[name]
                if symbol.size is not None:
                    least = _SQUEEZED * min(symbol.size, size)
                    found[name] = replace(symbol, min=least if symbol.min is None else max(least, symbol.min))
        return found

    def _answer(self, spines: Mapping[str, Layer], found: _Found, complete: bool, floor: float) -> AxisAnswer:
        """The layout of all heights."""
        design = self.joint.all(spines)
        problem = axis_problem(design, "y")
        order = [name for key in self.joint.designs for name in self._groups(key)] + [SPINES] * bool(spines)
        place = {name: k for k, name in enumerate(order)}
        solved = found.solved
        turned = [place[name] for name, _ in problem.groups]
        sized = replace(
            solved.sized,
            boundaries=tuple(solved.sized.boundaries[k] for k in turned),
            placements=tuple(solved.sized.placements[k] for k in turned),
        )
        whole = replace(
            solved,
            groups=tuple(solved.groups[k] for k in turned),
            parts=tuple(solved.parts[k] for k in turned),
            sized=sized,
        )
        values = solved.candidate.counters
        answers = [self._alone_with(key, values) for key in self.joint.designs]
        sure = floor >= found.cost - _EPS
        proven = complete and sure and all(own.layout.proven for own in answers)
        best = Best(whole, solved.cost if proven else min(floor, solved.cost), complete, whole=proven)
        layout: AxisLayout = axis_layout(design, problem, best, whole)
        warnings = tuple(dict.fromkeys(text for own in answers for text in own.warnings))
        if not complete:
            warnings += ("The search was cut short, as the time was over: the walls may meet better.",)
        elif not sure:
            warnings += (
                "There may be a better way for the walls to meet: there are too many to look at all of them.",
            )
        done = complete and all(own.complete for own in answers)
        return AxisAnswer(layout, dict(values), whole.columns, warnings, done)

    def _alone_with(self, key: str, values: Values) -> AxisAnswer:
        """The answer of a design that was taken."""
        for (name, pinned), own in self._known.items():
            if (
                name == key
                and isinstance(own, AxisAnswer)
                and all(values.get(counter) == value for counter, value in pinned)
                and all(values.get(counter) == value for counter, value in own.counters.items())
            ):
                return own
        raise AssertionError(f"no answer of {key!r} has these counters")

    def _groups(self, key: str) -> list[str]:
        return [name for name, _ in axis_problem(self.joint.own(key), "y").groups]


@dataclass(frozen=True, slots=True)
class _Found:
    """Heights of all, sized together."""

    cost: float
    solved: Solved
    quick: bool = False
    """Maybe not the best way to align these spines."""

    def beats(self, other: _Found) -> bool:
        """Least cost, then most columns, then least deviation."""
        if abs(self.cost - other.cost) > 1e-9:
            return self.cost < other.cost
        if self.solved.columns != other.solved.columns:
            return self.solved.columns > other.solved.columns
        return self.solved.sized.deviation < other.solved.sized.deviation - 1e-9


def _solved(answer: AxisAnswer) -> Solved:
    assert answer.best is not None and answer.best.solved is not None
    return answer.best.solved


def _range(counter: Counter, held: int | None) -> tuple[int, int | None]:
    value = held if held is not None else counter.value
    return (counter.min, counter.max) if value is None else (value, value)
