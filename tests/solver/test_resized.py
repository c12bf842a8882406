"""The structure of the last answer, sized for an edited design: a layout like any other, made without a search."""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest

from facade_nb import Design, NoLayout, gallery, solve
from facade_nb.design import edit
from facade_nb.design.model import AXES
from facade_nb.solver.resized import resized
from facade_nb.solver.selection.axis import AxisSearch
from facade_nb.solver.solution import forget
from tests.oracle.designs import make_design
from tests.oracle.solving import price_of_layout

from .test_incremental import script


@pytest.fixture(autouse=True)
def nothing_known() -> Iterator[None]:
    forget()
    yield
    forget()


def _wider(design: Design, by: float) -> Design:
    return edit.with_canvas(design, width=design.canvas.width + by)


def test_a_design_that_was_made_wider_has_its_structure_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    before = gallery.load("bookshop")
    assert resized(before) is None  # nothing is known yet
    first = solve(before)
    assert resized(before) is None  # it is known to its end: `solve` answers as soon
    after = _wider(before, 0.02)

    def searched(*_: object) -> None:
        raise AssertionError("it was searched")

    with monkeypatch.context() as patched:
        patched.setattr(AxisSearch, "best", searched)
        found = resized(after)
    assert found is not None
    assert found.canvas == after.canvas
    assert found.design is after
    assert not found.complete
    assert not found.x.proven
    assert found.warnings
    assert found.y == first.y  # of which nothing was edited
    spelled = [[str(row.letters) for row in group.rows] for group in found.x.groups.values()]
    assert len(spelled) == len(first.x.groups)
    best = solve(after)
    assert found.x.cost >= best.x.cost - 1e-6
    forget()
    assert solve(after).shapes == best.shapes  # what was shown before has no say in the answer


def test_a_pattern_that_is_written_in_another_way_has_its_word_still() -> None:
    before = gallery.load("residential-house")
    count = solve(before).counters["k"]
    written = edit.with_pattern(before, "Bx", f"A(BA)^{count}")
    found = resized(written)
    assert found is not None
    assert found.shapes == solve(before).shapes
    other = edit.with_pattern(before, "Bx", f"A(BA)^{count - 1}")
    assert resized(other) is None  # that was no word of it


def test_every_layout_of_random_edits_is_admissible_and_none_changes_the_answer() -> None:
    shown = better = 0
    for seed in (7, 10, 20):
        for one in script(random.Random(seed), make_design(seed), 5):
            found = resized(one)
            try:
                best = solve(one, time_limit=None)
            except NoLayout:
                assert found is None
                continue
            if found is None:
                continue
            shown += 1
            for axis in AXES:
                own = found.along(axis)
                cost, _ = price_of_layout(one, axis, own, found.counters)
                assert cost == pytest.approx(own.cost, abs=1e-6)
                assert own.cost >= best.along(axis).cost - 1e-6
                better += own.cost > best.along(axis).cost + 1e-6
    assert shown > 3
    assert better  # it is not always the best
