"""What the search of an axis tells whoever watches it (the recorder of a trace does)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from typing import Protocol

from ..alignment.group import Group
from ..alignment.observer import NetworkObserver
from ..model.problem import AxisProblem
from ..words.instances import Instances

__all__ = ["AxisObserver", "sizing"]

_NOTHING: AbstractContextManager[None] = nullcontext()


class AxisObserver(Protocol):
    """What the search of an axis calls; without an observer nothing is called."""

    def words(self, problem: AxisProblem, found: Mapping[str, Instances], tolerance: float) -> None:
        """The words of all patterns are listed."""

    def walk(self, axis: str, names: Sequence[str], groups: Sequence[Group], search: str) -> NetworkObserver:
        """A network is opened."""

    def sizing(self, axis: str) -> AbstractContextManager[None]:
        """Add up the time that sizing takes, which happens within the search."""


def sizing(observer: AxisObserver | None, axis: str) -> AbstractContextManager[None]:
    """Add up the time that sizing takes, if somebody watches."""
    return _NOTHING if observer is None else observer.sizing(axis)
