"""The faults that are found while a grammar is compiled."""

from __future__ import annotations

from collections.abc import Iterable

from ...design.errors import Fault, nearest
from .lines import Lines

__all__ = ["Findings"]

_MAX_FAULTS = 1000  # that are looked for
_MAX_HINTS = 50  # of them that name what may have been meant


class Findings:
    """Faults by their place in a text."""

    def __init__(self, text: str) -> None:
        self._lines = Lines(text)
        self._found: dict[tuple[int, str], None] = {}

    def __bool__(self) -> bool:
        return bool(self._found)

    def note(self, offset: int, message: str) -> None:
        """Note a fault; the same one at the same place counts once (copies of a rule share its text)."""
        if len(self._found) < _MAX_FAULTS:
            self._found.setdefault((offset, message), None)

    def hint(self, name: str, valid: Iterable[str]) -> str:
        """The nearest valid name, as long as there are not too many faults for anyone to read."""
        return nearest(name, valid) if len(self._found) < _MAX_HINTS else ""

    def line(self, offset: int) -> int:
        """The line, from 1, that a place is in."""
        return self._lines.line(offset)

    def in_order(self) -> list[tuple[int, Fault]]:
        """All faults with their offsets, in the order of the text."""
        return [(offset, self._lines.fault(offset, message)) for offset, message in sorted(self._found)]
