"""What is told of a pattern's words: those it can make at this canvas, and where in its text each letter stands."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

from ...design import Design, DesignError
from ...design.model import AXES, Axis
from ...design.modes import MODES
from ...design.occurrences import occurrences
from ...design.pattern import Pattern, parse
from ...solver import Layout
from ...solver.model.letters import Letter, Word
from ...solver.schedules.tolerances import TOLERANCES
from ...solver.words.neighbours import Choice, choices
from .model import FacadeModel
from .newcomers import begun

__all__ = ["describe_letters", "describe_modes", "describe_words"]

Json = dict[str, Any]

MOST = 4
"""So many words that fit are told on each axis; beside them stands the nearest of each other kind."""
LETTERS = 80
"""So many letters of a word are told."""
_PLACED = 2_000
"""Words with more letters are not joined with their text."""
_MOMENT = 0.1
"""Seconds that the words of one pattern may take, where the solver has not listed them."""
_COPIES = (-2, -1, 0, 1, 2, 3)


class _TooLong(Exception):
    """The words of a pattern take too long to list."""


def describe_words(model: FacadeModel, name: str) -> Json:
    """The words of a pattern, a few of them, on each axis where it stands; why there are none, where that is so."""
    design = begun(model.design)
    definition = design.patterns.get(name)
    if definition is None:
        return {}
    layout = model.layout if not (model.message or model.busy) else None
    solved = {axis: layout.along(axis).words.get(name) for axis in AXES} if layout is not None else {}
    chosen = {axis: word for axis, word in solved.items() if word is not None}
    until = time.monotonic() + _MOMENT

    def check() -> None:
        if time.monotonic() > until:
            raise _TooLong

    try:
        found = choices(design, name, TOLERANCES[-1], MOST, chosen, check)
    except _TooLong:
        return {
            "text": _shown(definition.text),
            "axes": [],
            "note": "There are too many words to list them here.",
        }
    except DesignError as error:
        return {"text": _shown(definition.text), "axes": [], "note": str(error)}
    note = ""
    if not found:
        letters = definition.parsed.symbols
        note = "No visible layer uses it." if letters else "It has no letters yet."
    axes = []
    for own in found:
        best = next((one for one in own.words if _same(one.word, chosen.get(own.axis))), None)
        told = [_word(definition.parsed, one, best) for one in own.words]
        axes.append(
            {
                "axis": own.axis,
                "canvas": _rounded(own.canvas),
                "low": _rounded(own.low),
                "high": _rounded(own.high),
                "words": told,
                "more": own.fits - sum(one["reason"] in ("chosen", "fits", "looser") for one in told),
            }
        )
    return {"text": _shown(definition.text), "axes": axes, "note": note}


def _same(word: Word, other: Word | None) -> bool:
    return other is not None and word == other and dict(word.counters) == dict(other.counters)


def _word(pattern: Pattern, choice: Choice, chosen: Choice | None) -> Json:
    word = choice.word
    reason: str = choice.reason
    if choice is chosen:
        reason = "chosen"
    elif reason == "fits" and chosen is not None and choice.miss > chosen.miss + 1e-6:
        reason = "looser"
    letters = word.letters[:LETTERS]
    places = _places(pattern, word)
    return {
        "letters": [
            [letter.symbol, _flags(letter), places[n] if places else -1] for n, letter in enumerate(letters)
        ],
        "left": len(word) - len(letters),
        "size": _rounded(word.size),
        "open": any(letter.size is None for letter in word.letters),
        "miss": _rounded(choice.miss),
        "reason": reason,
        "bound": choice.bound,
        "counters": dict(word.counters),
    }


def _flags(letter: Letter) -> str:
    """``m``: mirrored; ``t``: transparent."""
    return ("m" if letter.mirrored else "") + ("t" if letter.transparent else "")


def describe_letters(layout: Layout | None) -> Json:
    """Per axis and pattern: its text, and of each letter of its word the place in it, where it begins and ends."""
    if layout is None or layout.design is None:
        return {}
    return {axis: _solved(layout, layout.design, axis) for axis in AXES}


def _solved(layout: Layout, design: Design, axis: Axis) -> Json:
    solved = layout.along(axis)
    told: Json = {}
    for group in solved.groups.values():
        for row in group.rows:
            word = solved.words.get(row.pattern)
            definition = design.patterns.get(row.pattern)
            if row.pattern in told or word is None or definition is None or len(word) > _PLACED:
                continue
            places = _places(definition.parsed, word)
            if not places:
                continue
            spans: dict[int, tuple[float, float]] = {}
            for one in row.letters:  # pieces of a cut letter follow each other
                start, _ = spans.get(one.index, (one.start, one.end))
                spans[one.index] = start, one.end
            told[row.pattern] = {
                "text": _shown(definition.text),
                "letters": [
                    [letter.symbol, places[n], *map(_rounded, spans[n]), _flags(letter)]
                    for n, letter in enumerate(word.letters)
                    if n in spans
                ],
            }
    return told


def _places(pattern: Pattern, word: Word) -> Sequence[int]:
    """Of each letter its place in the text as a browser counts; empty where that is not known."""
    written = tuple((one.symbol, one.mirrored, one.origin is not None) for one in word.letters)
    found = occurrences(pattern, word.counters, written)
    if found is None:
        return ()
    text = pattern.text
    if text.isascii() and "\r" not in text:
        return found
    at = {place: len(_shown(text[:place]).encode("utf-16-le")) // 2 for place in dict.fromkeys(found)}
    return [at[place] for place in found]


def _shown(text: str) -> str:
    """A text as a browser's field has it."""
    return text.replace("\r\n", "\n").replace("\r", "\n")


def describe_modes() -> list[Json]:
    """What each reflection mode makes of the word EkG, for a few counts: the card of the syntax draws it."""
    told = []
    for sign, name in MODES.items():
        words = {}
        for copies in _COPIES:
            (word,) = parse(f"(EkG)^{sign}{copies}").words({})
            words[str(copies)] = " ".join(map(str, word))
        told.append({"sign": sign, "name": name, "words": words})
    return told


def _rounded(value: float) -> float:
    """Tenths of a millimetre."""
    return round(value, 4)
