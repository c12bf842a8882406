"""Solving again after an edit: the same answer as from scratch, and nothing done again that the edit leaves alone."""

from __future__ import annotations

import random
import threading
from collections.abc import Callable, Iterator
from math import inf
from typing import Any

import pytest

from facade_nb import Design, DesignError, NoLayout, gallery, solve
from facade_nb.design import edit
from facade_nb.design.model import AXES
from facade_nb.solver import Objective, tuning
from facade_nb.solver import solution as solving
from facade_nb.solver.cache import CACHE, Kept
from facade_nb.solver.schedules import apart
from facade_nb.solver.selection import clusters as running
from facade_nb.solver.selection.axis import AxisSearch, Best
from tests.oracle.designs import CONTENT, CONTROL, SOLID, design, make_design

Outcome = dict[str, Any] | tuple[str, ...]


@pytest.fixture(autouse=True)
def nothing_kept(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setattr(tuning, "REMEDIES", 0.0)  # what would help is not what is at stake here
    solving.forget()
    yield
    solving.forget()


def outcome(one: Design, time_limit: float = 5.0, **options: Any) -> Outcome | None:
    """What became of a design; None: the time was over."""
    try:
        layout = solve(one, time_limit=time_limit, **options)
    except NoLayout as error:  # what would help depends on how much time there is to try
        cut = error.constraint in ("time", "memory")
        return (
            None if cut else (error.axis, error.constraint, *error.patterns, *error.counters, *error.symbols)
        )
    return layout.to_dict() if layout.complete else None


def edits(draw: random.Random, one: Design) -> Design:
    """The design after one edit, of any kind that a studio offers."""
    symbol = draw.choice(sorted(one.symbols))
    pattern = draw.choice(sorted(one.patterns))
    layer = draw.choice(one.layers)
    counter = draw.choice(sorted(one.counters) or ["k"])
    side = draw.choice(AXES)
    along = layer.along(side)
    size, own_symbols = one.symbol(symbol).size, one.patterns[along.pattern].parsed.symbols
    text = draw.choice([*SOLID, draw.choice(CONTROL).format(e="u", f="v", c=draw.choice(CONTENT))])
    own: list[Callable[[], Design]] = [
        lambda: edit.with_canvas(one, width=round(one.canvas.width * draw.uniform(0.8, 1.25), 2)),
        lambda: edit.with_canvas(one, height=round(one.canvas.height * draw.uniform(0.8, 1.25), 2)),
        lambda: edit.with_symbol(one, symbol, size=None if size is None else round(size * draw.uniform(0.8, 1.2), 2)),
        lambda: edit.with_symbol(one, symbol, opaque=not one.symbol(symbol).opaque),
        lambda: edit.with_symbol(one, symbol, attached=not one.symbol(symbol).attached),
        lambda: edit.with_counter(one, counter, min=draw.choice([0, 1, 2]), max=draw.choice([None, 3, 5]), value=None),
        lambda: edit.with_counter(one, counter, value=draw.choice([None, 1, 2, 3]), min=None, max=None),
        lambda: edit.with_pattern(one, pattern, text),
        lambda: edit.with_layer(one, layer.name, visible=not layer.visible),
        lambda: edit.with_layer(one, layer.name, **{side: {"group": draw.choice("abg")}}),
        lambda: edit.with_layer(one, layer.name, **{side: {"mask": list(own_symbols)[:1]}}),
        lambda: edit.move_layer(one, layer.name, draw.randrange(len(one.layers))),
        lambda: edit.with_shape(one, f"{symbol} *", kind="window", visible=draw.choice([None, False])),
    ]  # fmt: skip
    return draw.choice(own)()


def script(draw: random.Random, one: Design, length: int) -> Iterator[Design]:
    """A design and what becomes of it, edit by edit; now and then an edit is undone."""
    past = [one]
    yield one
    while len(past) <= length:
        try:
            changed = past[-2] if len(past) > 1 and draw.random() < 0.2 else edits(draw, past[-1])
        except DesignError:
            continue
        past.append(changed)
        yield changed


def check(designs: list[Design], **options: Any) -> int:
    """How many of the designs, solved one after the other, have a layout; each is the one found from scratch."""
    one_after_the_other = [outcome(one, **options) for one in designs]
    solved = 0
    for one, found in zip(designs, one_after_the_other, strict=True):
        solving.forget()
        alone = outcome(one, **options)
        if found is not None and alone is not None:
            assert found == alone
            solved += isinstance(found, dict)
    return solved


@pytest.mark.parametrize("seed", [2, 3, 5, 6, 7, 8, 9, 10, 12, 13])
def test_random_edits_of_random_designs(seed: int) -> None:
    draw = random.Random(seed)
    assert check(list(script(draw, make_design(seed), 6))) > 0


@pytest.mark.parametrize("seed", range(3))
def test_and_in_the_order_of_the_paper(seed: int) -> None:
    draw = random.Random(100 + seed)
    check(list(script(draw, make_design(100 + seed), 4)), objective=Objective.paper())


@pytest.mark.parametrize("name", ["residential-house", "apartment-house", "qualifiers-a", "figure-7"])
def test_random_edits_of_the_gallery(name: str) -> None:
    draw = random.Random(name)
    assert check(list(script(draw, gallery.load(name), 5))) > 0


@pytest.mark.parametrize("name", ["residential-house", "qualifiers-c", "figure-7"])
def test_away_and_back(name: str) -> None:
    """A dragged edge that is let go where it was, and a slider put back, leave no mark."""
    one = gallery.load(name)
    before = outcome(one)
    for factor in (1.02, 0.97, 1.1):
        outcome(edit.with_canvas(one, width=one.canvas.width * factor))
        outcome(edit.with_canvas(one, height=one.canvas.height * factor))
        assert outcome(one) == before
    for symbol in one.symbols.values():
        if symbol.size is not None:
            outcome(edit.with_symbol(one, symbol.name, size=symbol.size * 1.03))
            assert outcome(one) == before


class TestBefore:
    """What the last answer costs now bounds the next search, and nothing else."""

    NAMES = ("residential-house", "apartment-house", "bookshop")

    @pytest.fixture
    def bounds(self, monkeypatch: pytest.MonkeyPatch) -> list[float]:
        """The bounds that searches were given."""
        real, seen = apart.upper_bound, list[float]()

        def spy(*args: Any) -> float:
            seen.append(real(*args))
            return seen[-1]

        monkeypatch.setattr(apart, "upper_bound", spy)
        return seen

    @pytest.mark.parametrize("name", NAMES)
    def test_a_symbol_dragged_along(self, name: str, bounds: list[float]) -> None:
        one = gallery.load(name)
        draw = random.Random(name)
        sized = sorted(n for n, own in one.symbols.items() if own.size is not None)
        steps = [one]
        for symbol in draw.sample(sized, 3):
            size = steps[-1].symbol(symbol).size or 1.0
            steps += [edit.with_symbol(steps[-1], symbol, size=size * f) for f in (1.02, 1.05, 0.97)]
        assert check(steps) == len(steps)
        assert sum(bound < inf for bound in bounds) > len(steps) / 2

    def test_it_is_what_the_same_structure_costs(self, bounds: list[float]) -> None:
        one = TestReuse.ONE
        solve(one)
        changed = solve(edit.with_symbol(one, "A", size=1.0001))
        assert bounds == [pytest.approx(changed.x.cost)]

    @pytest.mark.parametrize("wrong", [0.0, 1e-3, 1e9])
    def test_a_wrong_bound_does_no_harm(self, wrong: float, monkeypatch: pytest.MonkeyPatch) -> None:
        """Where nothing can be sized within it, the search begins again without."""
        monkeypatch.setattr(apart, "upper_bound", lambda *_: wrong)
        one = gallery.load("residential-house")
        name = next(n for n, own in one.symbols.items() if own.size is not None)
        assert check([one, edit.with_symbol(one, name, size=(one.symbol(name).size or 1.0) * 1.05)]) == 2

    def test_groups_that_can_only_be_sized_apart(self, bounds: list[float]) -> None:
        """What the groups cost one by one is less than what they cost together."""
        one = design(
            {"A": 1.425, "B": 1.05, "C": {"size": 1.05, "max": 1.1}},
            {"x0": "A(A|B)A", "x1": "CC|AB|B^3", "x2": "e2m; m := B^k", "x3": "ACA"},
            [("x3", "b"), ("x2", "a"), ("x1", "a"), ("x0", "b")],
            3.566,
        )
        changed = edit.with_symbol(one, "C", size=1.0)
        assert check([one, changed, edit.with_symbol(changed, "B", size=1.04)]) == 3
        solving.forget()
        assert min(bounds) < solve(changed).x.cost - 0.1

    def test_words_that_no_longer_fit(self, bounds: list[float]) -> None:
        one = TestReuse.ONE
        assert check([one, edit.with_counter(one, "k", value=5), edit.with_symbol(one, "A", size=1.9)]) > 1
        assert inf in bounds

    def test_when_the_time_is_up_it_is_the_answer(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """A design that takes long can be dragged: what there was is better than nothing."""
        one = gallery.load("apartment-house")
        solve(one)
        name = next(n for n, own in one.symbols.items() if own.size is not None)
        changed = edit.with_symbol(one, name, size=(one.symbol(name).size or 1.0) * 1.001)
        with monkeypatch.context() as patched:
            patched.setattr(AxisSearch, "best", lambda *_: Best(bound=0.0, complete=False))
            cut = solve(changed)
        solving.forget()
        whole = solve(changed)
        assert not cut.complete and whole.complete
        assert (cut.x.cost, cut.y.cost) == pytest.approx((whole.x.cost, whole.y.cost))


class TestReuse:
    """What is done again, and what is not."""

    ONE = design(
        {"A": 1.0, "B": 0.6, "P": 1.0, "Q": 0.5},
        {"a": "A^k", "b": "B^l", "c": "A(BA)^m", "p": "P^n Q^n"},
        [("a", "g", "p"), ("b", "g", "p"), ("c", "f", "p")],
        6.0,
        3.0,
    )

    @pytest.fixture
    def listed(self, monkeypatch: pytest.MonkeyPatch) -> list[str]:
        """The patterns whose words are listed."""
        words = __import__("importlib").import_module("facade_nb.solver.words.enumeration")
        real, seen = words.instances, []

        def spy(pattern: Any, *args: Any, **named: Any) -> Any:
            seen.append(str(pattern))
            return real(pattern, *args, **named)

        monkeypatch.setattr(words, "instances", spy)
        return seen

    @pytest.fixture
    def searched(self, monkeypatch: pytest.MonkeyPatch) -> list[str]:
        """The axes that are searched."""
        real, seen = AxisSearch.best, []

        def spy(walk: Any, *args: Any) -> Any:
            seen.append(walk.problem.axis)
            return real(walk, *args)

        monkeypatch.setattr(AxisSearch, "best", spy)
        return seen

    def test_the_other_axis(self, listed: list[str], searched: list[str]) -> None:
        solve(self.ONE)
        assert searched == ["x", "y"]
        for changed in (
            edit.with_canvas(self.ONE, height=3.1),
            edit.with_symbol(self.ONE, "P", size=1.1),
            edit.with_pattern(self.ONE, "p", "PQP"),
        ):
            searched.clear(), listed.clear()
            solve(changed)
            assert searched == ["y"]
            assert len(listed) == 1

    def test_what_is_not_solved_at_all(self, listed: list[str], searched: list[str]) -> None:
        """Looks, names, masks and the order of groups are nothing to the search."""
        solve(self.ONE)
        searched.clear(), listed.clear()
        solve(edit.with_shape(self.ONE, "A P", kind="door"))
        solve(edit.with_layer(self.ONE, "L0", x={"mask": ["A"]}))
        solve(edit.with_layer(self.ONE, "L0", name="front"))
        solve(edit.with_symbol(self.ONE, "unused", size=3.0))
        assert (searched, listed) == ([], [])

    def test_words_of_unchanged_patterns(self, listed: list[str]) -> None:
        solve(self.ONE)
        assert sorted(listed) == sorted(str(p.parsed) for p in self.ONE.patterns.values() if p.name != "h")
        listed.clear()
        solve(edit.with_pattern(self.ONE, "c", "A(BBA)^m"))
        assert listed == ["A(BBA)^m"]
        listed.clear()
        solve(edit.with_counter(self.ONE, "l", max=20))
        assert listed == ["B^l"]

    def test_groups_that_an_edit_leaves_alone(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """The search that gave a group's answer is not done again, though another group has changed."""
        real, seen = running.best_first, set[tuple[str, ...]]()

        def spy(groups: Any, **options: Any) -> Any:
            seen.add(tuple("".join(map(str, band.letters)) for group in groups for band in group.bands))
            return real(groups, **options)

        monkeypatch.setattr(running, "best_first", spy)
        solve(self.ONE)
        assert ("A" * 6, "B" * 10) in seen
        seen.clear()
        solve(edit.with_pattern(self.ONE, "c", "B(AB)^m"))
        assert ("A" * 6, "B" * 10) not in seen  # nor ("BABABAB",), which stands alone and is never searched
        seen.clear()
        solve(edit.with_symbol(self.ONE, "A", size=1.01))
        assert ("A" * 6, "B" * 10) in seen

    def test_after_forgetting(self, listed: list[str], searched: list[str]) -> None:
        solve(self.ONE)
        before = len(listed)
        solving.forget()
        solve(self.ONE)
        assert (len(listed), searched) == (2 * before, ["x", "y", "x", "y"])

    def test_an_answer_that_was_cut_short_is_not_kept(self, searched: list[str]) -> None:
        calls = iter(range(10**6))
        for _ in range(2):
            try:
                solve(self.ONE, should_stop=lambda: next(calls) % 40 == 39)
            except NoLayout:
                continue
        assert solve(self.ONE).complete
        solving.forget()
        assert solve(self.ONE).complete

    def test_trials_push_nothing_out(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """What is tried in order to say what would help is not kept."""
        monkeypatch.setattr(tuning, "REMEDIES", 2.0)
        monkeypatch.setattr(tuning, "REMEDY", 1.0)
        solve(self.ONE)
        before = len(CACHE.answers)
        with pytest.raises(NoLayout) as caught:
            solve(edit.with_counter(self.ONE, "k", value=30))
        assert caught.value.suggestions
        assert len(CACHE.answers) == before

    def test_from_several_threads(self) -> None:
        """Two studios in one kernel share what is kept."""
        designs = [edit.with_canvas(self.ONE, width=6.0 + n / 50) for n in range(3)]
        alone = [outcome(one, 60.0) for one in designs]
        solving.forget()
        found: dict[int, list[Outcome | None]] = {}

        def work(n: int) -> None:
            found[n] = [outcome(one, 60.0) for one in (designs if n % 2 else designs[::-1])]

        threads = [threading.Thread(target=work, args=(n,)) for n in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert all(found[n] == (alone if n % 2 else alone[::-1]) for n in range(4))


class TestKept:
    def test_the_oldest_goes(self) -> None:
        kept: Kept[str] = Kept(2)
        kept.put(1, "a")
        kept.put(2, "b")
        assert kept.get(1) == "a"
        kept.put(3, "c")
        assert (kept.get(2), kept.get(1), kept.get(3)) == (None, "a", "c")
        assert (kept.hits, kept.misses) == (3, 1)

    def test_by_weight(self) -> None:
        kept: Kept[str] = Kept(10)
        kept.put(1, "a", 6)
        kept.put(1, "b", 4)
        kept.put(2, "c", 6)
        assert (kept.get(1), kept.get(2)) == ("b", "c")
        kept.put(3, "d", 11)  # would push everything else out
        assert kept.get(3) is None and len(kept) == 2
        kept.put(4, "e", 7)
        assert len(kept) == 1 and kept.get(4) == "e"
        kept.clear()
        assert len(kept) == 0 and (kept.hits, kept.misses) == (0, 0)
