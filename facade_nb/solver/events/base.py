"""Events of the call as a whole, and what all events are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

__all__ = [
    "AxisPosed",
    "Event",
    "GroupNote",
    "LeftOut",
    "NoLayoutFound",
    "StageBegun",
    "StageEnded",
    "TraceBegun",
    "TraceEnded",
    "Warned",
]


@dataclass(frozen=True, slots=True)
class Event:
    """Base of all events: the axis it belongs to; empty where it belongs to both."""

    axis: str

    registry: ClassVar[dict[str, type[Event]]] = {}
    """Every kind of event by its name, which is what a trace document calls it."""

    def __init_subclass__(cls) -> None:
        Event.registry[cls.__name__] = cls


@dataclass(frozen=True, slots=True)
class TraceBegun(Event):
    """What was asked: the design document, the objective's fields, the schedule of tolerances, the search."""

    design: Mapping[str, Any]
    objective: Mapping[str, Any]
    tolerances: tuple[float, ...]
    search: str


@dataclass(frozen=True, slots=True)
class GroupNote:
    """An alignment group: its layers and their patterns, topmost first."""

    name: str
    layers: tuple[str, ...]
    patterns: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class AxisPosed(Event):
    """An axis: its canvas in metres, and its alignment groups."""

    canvas: float
    groups: tuple[GroupNote, ...]


@dataclass(frozen=True, slots=True)
class StageBegun(Event):
    """A stage begins, so many seconds after the call.

    `stage` is ``analysis``, ``words``, ``search``, ``sizing`` or ``merging``.
    """

    stage: str
    at: float


@dataclass(frozen=True, slots=True)
class StageEnded(Event):
    """How long a stage took, in seconds, and how many times it was entered."""

    stage: str
    seconds: float
    times: int = 1


@dataclass(frozen=True, slots=True)
class LeftOut(Event):
    """So many more of something there were than the trace tells, or at least so many."""

    what: str
    count: int


@dataclass(frozen=True, slots=True)
class Warned(Event):
    """What a designer should know."""

    text: str


@dataclass(frozen=True, slots=True)
class NoLayoutFound(Event):
    """There is no layout, or none was found: the fields of `NoLayout`, of its suggestions the texts."""

    message: str
    patterns: tuple[str, ...]
    symbols: tuple[str, ...]
    counters: tuple[str, ...]
    group: str
    layers: tuple[str, ...]
    constraint: str
    suggestions: tuple[str, ...]
    stage: str


@dataclass(frozen=True, slots=True)
class TraceEnded(Event):
    """The call is over, after so many seconds."""

    seconds: float
