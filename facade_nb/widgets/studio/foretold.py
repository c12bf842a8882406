"""What a canvas of another width would bring: a reader says it first, and is told then."""

from __future__ import annotations

from collections import Counter
from typing import Any

from ...design import Design, DesignError, NoLayout
from ...design.edit import with_canvas
from ...solver import Layout, solve

__all__ = ["foretold"]

_LIMIT = 5.0
"""Seconds that a question may take."""

_ALIKE = 5e-4
"""Metres that make no difference."""


def foretold(design: Design, layout: Layout | None, width: float) -> dict[str, Any]:
    """What the design becomes on a canvas of that width (metres), beside what it is now.

    Returns
    -------
    dict
        ``counts``: of each pattern across that counts something, which letter, how many there are ``now`` and
        ``later``, and how long its word is. ``moves``: by how many metres each symbol would differ from the
        size it likes, and how many letters of it there would be. Both are empty where there is no layout.
    """
    told: dict[str, Any] = {"kind": "foretold", "width": width, "counts": [], "moves": []}
    if layout is None:
        return told
    try:
        then = solve(with_canvas(design, width=width), time_limit=_LIMIT)
    except (DesignError, NoLayout):
        return told
    for pattern, word in then.x.words.items():
        before = layout.x.words.get(pattern)
        if not word.counters or before is None:
            continue
        seen = [letter for letter in word.letters if not letter.transparent] or list(word.letters)
        often = Counter(letter.symbol for letter in (*seen, *before.letters) if not letter.transparent)
        if not often:
            continue
        free = {letter.symbol for letter in word.letters if letter.unoccludable}
        symbol = min(often, key=lambda name: (name not in free, -often[name], name))
        told["counts"].append(
            {
                "pattern": pattern,
                "symbol": symbol,
                "now": sum(letter.symbol == symbol for letter in before.letters),
                "later": sum(letter.symbol == symbol for letter in word.letters),
                "length": [_length(before.letters), _length(word.letters)],
            }
        )
    letters = Counter(
        (letter.symbol, letter.size)
        for word in then.x.words.values()
        for letter in word.letters
        if letter.size is not None and not letter.transparent
    )
    moves = {name: then.x.sizes[name] - size for name, size in letters if name in then.x.sizes}
    most = max((abs(by) for by in moves.values()), default=0.0)
    if len(moves) > 1 and most > 2 * _ALIKE:
        told["moves"] = [
            {"symbol": name, "by": moves[name], "count": count, "most": abs(moves[name]) > most - _ALIKE}
            for (name, _), count in letters.items()
            if name in moves
        ]
    return told


def _length(letters: Any) -> float:
    """Metres at the sizes that are liked; placeholders without a size have none."""
    return round(sum(letter.size or 0.0 for letter in letters), 6)
