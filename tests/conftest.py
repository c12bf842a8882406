"""Fixtures and settings that every test shares."""

from __future__ import annotations

import gc
import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

# `make test` must give the same answer twice, so its examples are fixed; HYPOTHESIS_PROFILE=explore looks further.
# There are no deadlines: these machines are shared.
settings.register_profile(
    "fixed", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile(
    "explore", deadline=None, max_examples=1000, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "fixed"))


def pytest_collection_finish() -> None:
    """What is there before the first test stays to the end: the collector need not go through it again and again."""
    gc.collect()
    gc.freeze()


@pytest.fixture(autouse=True)
def _counted_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """A time limit is a number of looks at the clock, for what is found within it must not depend on the machine."""
    from facade_nb.solver import budget as clock
    from tests.clocks import Counted

    monkeypatch.setattr(clock, "time", Counted())


@pytest.fixture(scope="session")
def root() -> Path:
    """Return the root of the checkout."""
    return Path(__file__).resolve().parent.parent
