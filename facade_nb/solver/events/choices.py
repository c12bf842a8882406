"""Events of pattern analysis, words and candidates (supplement 3.1, the paper's 5.1)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from .base import Event

__all__ = [
    "CandidateJudged",
    "LetterNote",
    "PairInconsistent",
    "PatternNotAnalysed",
    "PatternsCompared",
    "SystemReduced",
    "WordJudged",
]


@dataclass(frozen=True, slots=True)
class PatternsCompared(Event):
    """Two patterns, their common ends, and the equation that follows: the fields of `findings.Equation`."""

    number: int
    patterns: tuple[str, str]
    prefix: tuple[Mapping[str, Any], ...]
    left: tuple[Mapping[str, Any], ...]
    right: tuple[Mapping[str, Any], ...]
    suffix: tuple[Mapping[str, Any], ...]
    coefficients: Mapping[str, float]
    constant: float
    text: str
    system: str
    strength: str
    symbol: str
    note: str


@dataclass(frozen=True, slots=True)
class SystemReduced(Event):
    """One of the two linear systems, ``counters`` or ``unsized``, solved: see `findings.LinearSystem`."""

    system: str
    variables: tuple[str, ...]
    equations: tuple[int, ...]
    reduced: tuple[Mapping[str, Any], ...]
    resolved: Mapping[str, float]
    free: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class PairInconsistent(Event):
    """The first equation of a system that contradicts those before: see `findings.Conflict`."""

    system: str
    equation: int
    against: tuple[int, ...]
    patterns: tuple[str, str]
    kind: str
    strength: str
    text: str


@dataclass(frozen=True, slots=True)
class PatternNotAnalysed(Event):
    """A pattern whose length is not linear in its counters, and why."""

    pattern: str
    reason: str


@dataclass(frozen=True, slots=True)
class LetterNote:
    """A letter of a word: `letters.Letter`, with ``origin`` empty for a letter that is no content."""

    symbol: str
    size: float | None
    transparent: bool = False
    opaque: bool = True
    attached: bool = False
    unoccludable: bool = False
    mirrored: bool = False
    origin: tuple[str, int] | None = None


@dataclass(frozen=True, slots=True)
class WordJudged(Event):
    """A word of a pattern, and whether it can fit (Eq. 7).

    Attributes
    ----------
    size, low, high
        Σ of the sized letters, and the bounds of Eq. 7 that it has to keep, metres. `low` allows for as much as
        opaque letters above can push aside in any candidate; None: unsized letters take what is left.
    kept, reason
        ``fits``, ``too long``, ``too short``; ``no partner``, where another pattern has no word with the same value of
        a counter; or ``left out``, where a pattern has more words than can be looked at.
    choices
        The option taken of each alternation, in the order of the text; empty where it is not known.
    """

    pattern: str
    word: str
    size: float
    counters: Mapping[str, int]
    kept: bool
    reason: str
    tolerance: float = 0.0
    low: float | None = None
    high: float = 0.0
    choices: tuple[str, ...] = ()
    letters: tuple[LetterNote, ...] = ()


@dataclass(frozen=True, slots=True)
class CandidateJudged(Event):
    """A candidate and its fate.

    Attributes
    ----------
    fate
        ``best``, ``tied``, ``dearer``, ``no alignment``, ``no sizes``, ``stopped`` (the search was cut short), or
        ``bound``: not aligned to the end, because its lower bound is no better than what is known.
    bound, floor
        Lower bound of its J from sizes alone; what was proven in the end.
    cost, omega, columns, deviation
        J, Ω, number of columns and deviation, summed over groups, where it was aligned and sized.
    networks
        Numbers of the networks it was aligned in (`NetworkOpened`), told or not.
    """

    words: Mapping[str, str]
    counters: Mapping[str, int]
    bound: float
    fate: str
    cost: float | None = None
    columns: int | None = None
    deviation: float | None = None
    number: int = 0
    tolerance: float = 0.0
    omega: float | None = None
    floor: float | None = None
    networks: tuple[int, ...] = ()

    @property
    def proven(self) -> float:
        """What has been proven of it: J is at least that, by its sizes or by what the search has gone through."""
        return max(self.bound, self.floor or 0.0)
