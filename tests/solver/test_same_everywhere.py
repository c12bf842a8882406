"""Nothing that is told or chosen depends on the processor, on the order of a hash, or on the clock."""

from __future__ import annotations

import hashlib
import json
import os
import platform
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from facade_nb import Design, NoLayout, gallery, solve
from facade_nb.solver import Objective
from facade_nb.solver import budget as clock
from facade_nb.solver import solution as solving
from facade_nb.solver.model.sums import dot, times
from facade_nb.solver.sizing.least_squares import least_squares
from facade_nb.solver.trace import active_set as activeset
from tests.clocks import Jumping
from tests.oracle.designs import design

TELLING = ["residential-house", "figure-7", "qualifiers-b", "terraced-house"]
"""Quick to solve; in the last one several constraints are missed by as much."""
TIMES = {"seconds", "at"}
"""Fields of events that say how long something took, or when it was."""


def untimed(events: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [{name: value for name, value in own.items() if name not in TIMES} for own in events]


def told(one: Design, **options: Any) -> dict[str, Any]:
    """What comes of a design, and every event that leads to it, but for the times."""
    solving.forget()
    try:
        layout = solve(one, trace=True, time_limit=None, **options)
    except NoLayout as error:
        assert error.trace is not None
        answer: Any = [str(error), [own.text for own in error.suggestions]]
        return {"answer": answer, "events": untimed(error.trace.to_dict()["events"])}
    assert layout.complete
    return {"answer": layout.to_dict(), "events": untimed(layout.trace.to_dict()["events"])}


# In another process, with another processor


def kernel() -> str:
    """Which of its kernels numpy's OpenBLAS has taken; empty where numpy has another BLAS."""
    import ctypes

    for path in sorted(Path(np.__file__).parent.with_name("numpy.libs").glob("*openblas*")):
        library = ctypes.CDLL(str(path))
        for name in (
            "scipy_openblas_get_corename64_",
            "scipy_openblas_get_corename",
            "openblas_get_corename",
        ):
            if hasattr(library, name):
                corename = getattr(library, name)
                corename.restype = ctypes.c_char_p
                return str(corename().decode())
    return ""


def features() -> list[str]:
    """What numpy makes use of on this processor, beyond what it asks of any."""
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

    return [name for name in __cpu_dispatch__ if __cpu_features__.get(name)]


def report() -> None:
    """Print, on one line, which kernel was used, whether numpy knew any features, and what was told of each design."""
    print(json.dumps({"kernel": kernel(), "features": len(features()), "told": digests()}))


def digests() -> dict[str, str]:
    return {
        name: hashlib.sha256(json.dumps(told(gallery.load(name))).encode()).hexdigest() for name in TELLING
    }


def elsewhere(core: str, without: list[str], seed: int) -> dict[str, Any]:
    code = "from tests.solver.test_same_everywhere import report; report()"
    own = {"OPENBLAS_CORETYPE": core, "PYTHONHASHSEED": str(seed), "OPENBLAS_NUM_THREADS": "1"}
    if without:
        own["NPY_DISABLE_CPU_FEATURES"] = " ".join(without)
    root = Path(__file__).parents[2]
    ran = subprocess.run(
        [sys.executable, "-c", code], cwd=root, env={**os.environ, **own}, capture_output=True, text=True
    )
    assert ran.returncode == 0, ran.stderr
    found: dict[str, Any] = json.loads(ran.stdout)
    return found


def test_traces_are_the_same_on_every_processor() -> None:
    """Two kernels of BLAS that any processor of the last ten years can run, and numpy with and without vectors."""
    with ThreadPoolExecutor(2) as both:
        old, new = both.map(lambda own: elsewhere(*own), [("Prescott", features(), 1), ("Haswell", [], 2)])
    assert old["told"] == new["told"]
    if kernel() and platform.machine() in ("x86_64", "AMD64"):  # else there is one kernel only
        assert old["kernel"] != new["kernel"]
    assert old["features"] == 0


# The clock


@pytest.fixture
def jumping(monkeypatch: pytest.MonkeyPatch) -> Jumping:
    """Every clock that a solver could look at jumps."""
    own = Jumping(5)
    monkeypatch.setattr(clock, "time", own)
    monkeypatch.setattr(time, "monotonic", own.monotonic)
    monkeypatch.setattr(time, "perf_counter", own.monotonic)
    return own


REFUSED = design({"A": 1.0, "B": 0.7, "C": 0.45}, {"a": "(AB)^2 C", "b": "A^k B"}, ["a", "b"], 3.1)


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("figure-7", {}),
        ("figure-7", {"search": "ida"}),
        ("figure-7", {"objective": Objective.paper()}),
        ("residential-house", {"search": "ida"}),
        ("apartment-house", {}),
        ("", {"tolerances": (0.0,)}),
    ],
    ids=lambda own: own if isinstance(own, str) else "-".join(own),
)
def test_traces_are_the_same_whatever_the_clock_says(
    name: str, options: dict[str, Any], request: pytest.FixtureRequest
) -> None:
    """Also what would help, where there is no layout, and how often something was sized."""
    one = gallery.load(name) if name else REFUSED
    before = told(one, **options)
    request.getfixturevalue("jumping")
    assert told(one, **options) == before


def test_what_is_untraced_is_the_same_whatever_the_clock_says(request: pytest.FixtureRequest) -> None:
    names = ["teaser", "concert-hall", "bookshop"]
    before = [solve(gallery.load(name), time_limit=None).to_dict() for name in names]
    request.getfixturevalue("jumping")
    solving.forget()
    assert [solve(gallery.load(name), time_limit=None).to_dict() for name in names] == before


# Sums and ties


def test_sums_go_through_their_numbers_in_order() -> None:
    """A large number takes away what was added before it, not what comes after."""
    assert dot(np.array([1.0, 1e17, -1e17, 1.0]), np.ones(4)) == 1.0
    rows = np.array([[1.0, 1e17, -1e17, 1.0], [1e17, 1.0, 1.0, -1e17]])
    assert times(rows, np.ones(4)).tolist() == [1.0, 0.0]
    assert times(np.zeros((3, 0)), np.zeros(0)).tolist() == [0.0, 0.0, 0.0]
    assert dot(np.zeros(0), np.zeros(0)) == 0.0


@pytest.mark.parametrize("last", [0.0, 2e-16, -2e-16])
def test_of_constraints_missed_by_as_much_the_first_is_taken(last: float) -> None:
    """Three variables that are to be at least 1 and would like to be 0, but for the last bit of one."""
    lower = np.array([1.0 - last, 1.0, 1.0 + last, -1e30])
    upper = np.full(4, 1e30)
    run = activeset.steps(np.ones(3), np.zeros(3), np.ones((1, 3)), lower, upper)
    assert [step.entered for step in run.steps] == [(), (0,), (1,), (2,)]
    assert [step.violation for step in run.steps] == [1.0, 1.0, 1.0, 0.0]
    assert run.steps[-1].x.tolist() == [1.0, 1.0, 1.0]


@pytest.mark.parametrize("seed", range(40))
def test_the_active_set_method_comes_to_the_answer_of_the_other_code(seed: int) -> None:
    """Some variables without a weight, equations among the rows, one of them twice."""
    draw = np.random.default_rng(seed)
    n, m = 8, 6
    rows = np.round(draw.normal(size=(m, n)))
    rows[1] = rows[0]
    inside = draw.uniform(0.5, 1.5, n)
    at = np.concatenate([inside, rows @ inside])
    room = np.concatenate([draw.uniform(0.1, 1.0, n), np.zeros(2), draw.uniform(0.0, 0.5, m - 2)])
    lower, upper = at - room, at + room
    lower[n : n + 2] = upper[n : n + 2] = (rows @ inside)[0]
    weight = np.where(draw.random(n) < 0.3, 0.0, 1.0) if seed % 2 else np.ones(n)
    target = draw.uniform(-1.0, 3.0, n)
    run = activeset.steps(weight, target, rows, lower, upper)
    other = least_squares(weight, target, rows, lower, upper)
    assert run.complete and other is not None
    held = np.concatenate([run.x, rows @ run.x])
    assert max((lower - held).max(), (held - upper).max()) < 1e-7
    value, least = (float(np.sum(weight * (x - target) ** 2)) for x in (run.x, other.x))
    assert value == pytest.approx(least, abs=1e-7)
