"""The same alignments by the solver and as mixed-integer programmes by HiGHS (`tests/bench/milp.py`).

The words are those of the best candidate of each group of the large designs, and some of two to five rows given as
they are. HiGHS gets the two formulations, one after the other; its figure is the faster of those it proves, and
counts neither building the model nor handing it over. Then it gets them once more and is told the optimum: columns
that alone cost more are left out, which no modeller could do beforehand. What is not proven in time is told as such.
"""

from __future__ import annotations

import argparse
import signal
import statistics
import time
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from types import FrameType

from facade_nb import gallery
from facade_nb.solver import Letter, Objective, align
from facade_nb.solver import solution as solving
from tests.oracle.pricing import DEFAULT

from .designs import LARGE, Words, line_of, solved, words_of
from .milp import Answer, Programme, Task, TooLarge, pose_paths
from .milp_reference import pose_reference

__all__ = ["cases", "main"]

GOAL = 20.0
MOST = 20_000
"""Columns of the formulation by paths; with more, HiGHS needs minutes and does not heed its limit."""
RUNS = 5


def cases() -> Iterator[tuple[str, Words]]:
    """Alignments of two to five rows: equal letters in different order, insertions, cuts, sizes that do not fit."""
    yield "figure 8", _case("CeC ABABA", {"A": 2, "B": 3, "C": 2, "e": 8}, 12.0, "e")
    yield "cuts", _case("fAf ABABA", {"A": 2, "B": 3, "f": 5}, 12.0, "f")
    yield "free pieces", _case("xDyDx ABABABABA", {"A": 0.9, "B": 1.3, "D": 1.5}, 10.0, "xy")
    yield (
        "2 rigid rows",
        _case("ABABABABABABABA CDCDCDCDCDCDC", {"A": 0.8, "B": 1.2, "C": 1.0, "D": 1.3}, 14.5),
    )
    yield (
        "3 rows",
        _case("PQPQPQP ABABABA CCDCC", {"A": 1.1, "B": 2.0, "P": 0.9, "Q": 2.3, "C": 2.5, "D": 1.4}, 10.5),
    )
    yield (
        "3 rows, cuts",
        _case("xEx ABABABA PQPQPQP", {"A": 1.1, "B": 2.0, "P": 0.9, "Q": 2.3, "E": 2.6}, 10.5, "x"),
    )
    sizes = {"A": 1.0, "B": 2.0, "C": 3.1, "D": 1.4, "E": 1.6, "F": 4.0, "G": 0.5}
    yield "4 rows", _case("ABABAB CCC DEDEDE FFG", sizes, 9.2)
    yield "5 rows", _case("ABABAB CCC DEDEDE FFG EDCED", sizes, 9.2)
    yield "5 rows, cuts", _case("uCv ABABAB CCC DEDEDE FFG", sizes, 9.2, "uv")


def _case(rows: str, sizes: dict[str, float], canvas: float, transparent: str = "") -> Words:
    words = tuple(
        tuple(Letter(s, sizes.get(s), s in transparent, s not in transparent) for s in row)
        for row in rows.split()
    )
    return Words("", words, canvas, canvas / 2)


def main(limit: float = 30.0, ours: float = 60.0) -> None:
    """Print the table; HiGHS has `limit` seconds for each formulation, the solver `ours`."""
    print(f"{'words':30} {'rows × letters':24} {'J':>9} {'ours ms':>9}   HiGHS, ms (limit {limit:g} s)")
    found: list[_Compared] = []
    missing = []
    for name in LARGE:
        design = gallery.load(name)
        layout = solved(design, ours)
        if layout is None:
            print(f"{name:30} no layout in {ours:g} s: its words are not known")
            missing.append(name)
            continue
        for words in words_of(design, layout.counters):
            found.append(_compare(f"{name}, {words.name}", words, limit, ours))
    for name, words in cases():
        found.append(_compare(name, words, limit, ours))
    print()
    for told in (False, True):
        ratios = [ratio for one in found if (ratio := one.ratio(told)) is not None]
        label = "told the optimum" if told else "on its own"
        print(
            f"HiGHS {label}: proven for {len(ratios)} of {len(found)}, there {min(ratios, default=0):.1f} times slower "
            f"or more, median {statistics.median(ratios or [0]):.0f} (goal: {GOAL:g})"
        )
    unequal = [one.name for one in found if one.unequal]
    print(
        f"optima not equal: {', '.join(unequal) or 'none'}; without a layout: {', '.join(missing) or 'none'}"
    )


@dataclass(slots=True)
class _Compared:
    """Seconds of the solver, and of the faster formulation of those that HiGHS has proven, not told and told."""

    name: str
    ours: float | None
    best: dict[bool, float] = field(default_factory=dict)
    unequal: bool = False

    def ratio(self, told: bool) -> float | None:
        if self.ours is None or told not in self.best:
            return None
        return self.best[told] / self.ours


def _compare(name: str, words: Words, limit: float, ours: float) -> _Compared:
    """Print a line for each formulation, and how many times faster the solver was than the fastest of them."""
    sizes = " ".join(map(str, words.distinct))
    cost, seconds = _solve(words, ours)
    one = _Compared(name, None if cost is None else seconds)
    time_told = f"> {1e3 * ours:.0f}" if cost is None else f"{1e3 * seconds:.1f}"
    value = "" if cost is None else f"{cost:.4f}"
    print(line_of([(name, -30), (sizes, -24), (value, 9), (time_told, 9)]), flush=True)
    task = Task(words.rows, words.canvas, words.tolerance, DEFAULT)
    for told in (False, True) if cost is not None else (False,):
        own = replace(task, cutoff=cost + 1e-6) if told and cost is not None else task
        for label, pose in (("paths", _pose_paths), ("reference", pose_reference)):
            title = f"    {label + (', told J' if told else ''):20}"
            try:
                programme = pose(own)
            except (TooLarge, ValueError) as error:
                print(f"{title} not posed: {error}", flush=True)
                continue
            answer = programme.solve(limit)
            print(f"{title} {_told(programme, answer, cost)}", flush=True)
            if answer.proven:
                one.best[told] = min(answer.seconds, one.best.get(told, answer.seconds))
                one.unequal = one.unequal or (cost is not None and abs(answer.cost - cost) > 1e-6)
    ratios = [f"{r:.1f}{' (told J)' if told else ''} " for told in (False, True) if (r := one.ratio(told))]
    more = (
        "" if one.ratio(False) or one.ours is None else f"more than {limit / one.ours:.0f} (nothing proven) "
    )
    print(f"    times slower: {more}{''.join(ratios)}", flush=True)
    return one


def _pose_paths(task: Task) -> Programme:
    return pose_paths(task, MOST)


def _told(programme: Programme, answer: Answer, cost: float | None) -> str:
    variables, whole, rows = programme.size
    text = (
        f"{variables} variables ({whole} whole), {rows} constraints, built in {1e3 * programme.build:.0f} ms: "
        f"{1e3 * answer.seconds:.0f} ms"
    )
    if not answer.proven:
        return f"{text}, stopped with J {answer.cost:.4f}, bound {answer.bound:.4f}"
    if cost is None:
        return f"{text}, J {answer.cost:.4f}"
    return f"{text}, {'equal' if abs(answer.cost - cost) <= 1e-6 else f'NOT EQUAL: {answer.cost:.6f}'}"


def _solve(words: Words, limit: float) -> tuple[float | None, float]:
    """J by the solver and the median of the seconds it took, from nothing; None where the limit was over."""

    def stop(_signal: int, _frame: FrameType | None) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, stop)
    times: list[float] = []
    try:
        for _ in range(RUNS):
            solving.forget()
            signal.setitimer(signal.ITIMER_REAL, limit)
            begin = time.perf_counter()
            found = align(words.rows, words.canvas, words.tolerance, Objective(), search="best")
            times.append(time.perf_counter() - begin)
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            if times[-1] > limit / RUNS:
                break
    except TimeoutError:
        return None, limit
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    assert found is not None
    return found.cost, statistics.median(times)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--limit", type=float, default=30.0, help="seconds for HiGHS, for each formulation")
    parser.add_argument("--ours", type=float, default=60.0, help="seconds for the solver")
    chosen = parser.parse_args()
    main(chosen.limit, chosen.ours)
