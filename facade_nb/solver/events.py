"""What the solver did, as frozen, typed events: the only thing that views of the solver read.

Events are made only where a trace was asked for.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

__all__ = ["CandidateJudged", "Event", "StageEnded", "SystemSolved", "Trace", "WordJudged"]


@dataclass(frozen=True, slots=True)
class Event:
    """Base of all events: the axis it belongs to."""

    axis: str


@dataclass(frozen=True, slots=True)
class WordJudged(Event):
    """A word of a pattern, and whether it can fit (Eq. 7)."""

    pattern: str
    word: str
    size: float
    counters: Mapping[str, int]
    kept: bool
    reason: str


@dataclass(frozen=True, slots=True)
class CandidateJudged(Event):
    """A candidate and its fate.

    ``best``, ``tied``, ``dearer``, ``no alignment``, ``no sizes``, or ``bound``: not aligned to the end,
    because its lower bound is no better than what is known.
    """

    words: Mapping[str, str]
    counters: Mapping[str, int]
    bound: float
    fate: str
    cost: float | None = None
    columns: int | None = None
    deviation: float | None = None


@dataclass(frozen=True, slots=True)
class SystemSolved(Event):
    """The least-squares system of the chosen alignment: names, matrix, bounds, solution and multipliers."""

    variables: tuple[str, ...]
    rows: tuple[str, ...]
    matrix: tuple[tuple[float, ...], ...]
    lower: tuple[float, ...]
    upper: tuple[float, ...]
    solution: tuple[float, ...]
    multipliers: tuple[float, ...]
    deviation: float


@dataclass(frozen=True, slots=True)
class StageEnded(Event):
    """How long a stage took, in seconds."""

    stage: str
    seconds: float


@dataclass(slots=True)
class Trace:
    """The recorded events, in order."""

    events: list[Event] = field(default_factory=list)

    def to_dict(self) -> dict[str, Any]:
        """The trace document: ``{"format": "facade-nb/trace/1", "events": [...]}``; infinite bounds become null."""
        return {
            "format": "facade-nb/trace/1",
            "events": [{"event": type(event).__name__, **_plain(asdict(event))} for event in self.events],
        }


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    if isinstance(value, float) and abs(value) >= 1e30:
        return None
    return value
