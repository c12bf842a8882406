"""Paths some piece of which nothing is left for wait until all others are known."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from facade_nb import gallery
from facade_nb.solver import Objective
from facade_nb.solver.alignment.found import Found
from facade_nb.solver.alignment.group import Group, make_group
from facade_nb.solver.alignment.reference.best_first import BestFirst
from facade_nb.solver.alignment.reference.network import Network
from facade_nb.solver.alignment.reference.paths import Path
from tests.bench.designs import solved, words_of
from tests.solver.ida_cases import case_group, random_case

KEEP = 64


def search(group: Group) -> Found:
    run = BestFirst([group], keep=KEEP, nodes=20_000)
    step = 0.01 * group.canvas
    while not run.done:
        run.advance(run.found.bound + step)
        step *= 1.6
    return run.found


def without(children: Callable[..., list[tuple[float, Path]]]) -> Callable[..., list[tuple[float, Path]]]:
    """The same children, none of which is said to be pinched."""

    def made(self: Network, *arguments: Any) -> list[tuple[float, Path]]:
        found = children(self, *arguments)
        for _, path in found:
            path.pinched = path.late = False
        return found

    return made


@pytest.mark.parametrize("seed", range(80))
def test_nothing_is_lost(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    case = random_case(60_000 + seed)
    found = search(case_group(case))
    monkeypatch.setattr(Network, "children", without(Network.children))
    all_ = search(case_group(case))
    if found.cut or all_.cut or found.best is None or all_.best is None:
        assert found.cut or all_.cut or found.best is all_.best
        return
    assert found.best.cost == pytest.approx(all_.best.cost, abs=1e-9)
    assert (found.best.proper, found.best.columns) >= (all_.best.proper, all_.best.columns)


def test_a_plateau_of_improper_structures_is_not_searched() -> None:
    """Two rows that end in the same cut letters: hundreds of structures cost the least, one has all pieces."""
    design = gallery.load("teaser")
    layout = solved(design, 10.0)
    assert layout is not None
    (hall,) = (words for words in words_of(design, layout.counters) if words.name == "x hall")
    found = search(make_group(hall.rows, hall.canvas, hall.tolerance, Objective()))
    assert found.best is not None
    assert found.best.proper
    assert found.best.cost == pytest.approx(0.46875)
    assert found.nodes < 400
