"""Places in a grammar's text, for many faults: the ends of its lines are looked for once."""

from __future__ import annotations

import re
from bisect import bisect_right
from functools import cached_property

from ...design.errors import Fault
from ...design.text import excerpt

__all__ = ["Lines"]

_LINE_END = re.compile(r"\r\n|\r|\n")


class Lines:
    """A text whose faults are wanted."""

    def __init__(self, text: str) -> None:
        self.text = text

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *(end.end() for end in _LINE_END.finditer(self.text))]

    def line(self, offset: int) -> int:
        """The line, from 1, that a place is in."""
        return bisect_right(self._starts, offset)

    def fault(self, offset: int, message: str) -> Fault:
        """A fault at a place, as `fault_at` makes it."""
        line = self.line(offset)
        start = self._starts[line - 1]
        end = self._starts[line] if line < len(self._starts) else len(self.text)
        column = offset - start
        return Fault("", message, line, column + 1, excerpt(self.text[start:end].rstrip("\r\n"), column))
