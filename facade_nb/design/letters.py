"""Characters of names, as regular expressions need them: the usual class leaves out the marks of many scripts."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import lru_cache

__all__ = ["letters_in"]

_MARKED = (range(0x80, 0x20000), range(0xE0000, 0xE1000))
"""Where Unicode has marks; the other planes hold whole signs, which count as letters."""


@lru_cache(maxsize=1)
def _marks() -> str:
    """What identifiers may go on with (XID_Continue) beyond letters and digits, as ranges of a character class."""
    found = (c for part in _MARKED for c in part if c <= sys.maxunicode and f"a{chr(c)}".isidentifier())
    beyond = [c for c in found if not chr(c).isalnum()]
    return "".join(f"{chr(low)}-{chr(high)}" if high > low else chr(low) for low, high in _ranges(beyond))


def _ranges(codes: list[int]) -> Iterator[tuple[int, int]]:
    """First and last of each run of neighbours."""
    start = 0
    for k in range(1, len(codes) + 1):
        if k == len(codes) or codes[k] != codes[k - 1] + 1:
            yield codes[start], codes[k - 1]
            start = k


def letters_in(pattern: str) -> str:
    """A regular expression in which ``@`` stands, inside brackets, for every character that a name may go on with."""
    return pattern.replace("@", rf"\w{_marks()}")
