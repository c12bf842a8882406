"""Characters of names, as regular expressions need them: the usual class leaves out the marks of many scripts."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

__all__ = ["MARKED", "class_of", "letters_in"]

MARKED = (
    range(0x80, 0x3400),
    range(0xA000, 0xAC00),
    range(0xD7B0, 0xD800),
    range(0xF900, 0x12000),
    range(0x16000, 0x17000),
    range(0x1AFF0, 0x20000),
    range(0xE0100, 0xE01F0),
)
"""Where Unicode has marks, and other forms of letters: not among ideographs and syllables."""


def class_of(codes: Iterable[int]) -> str:
    """What stands inside the brackets of a character class, for characters by their numbers, in order."""
    runs: list[list[int]] = []
    for code in codes:
        if runs and runs[-1][1] == code - 1:
            runs[-1][1] = code
        else:
            runs.append([code, code])
    return "".join(f"\\U{low:08x}-\\U{high:08x}" if low < high else f"\\U{low:08x}" for low, high in runs)


@lru_cache(maxsize=1)
def _marks() -> str:
    """What identifiers may go on with (XID_Continue) beyond letters and digits."""
    return class_of(
        code for part in MARKED for code in part if not chr(code).isalnum() and f"a{chr(code)}".isidentifier()
    )


def letters_in(pattern: str) -> str:
    """A regular expression in which ``@`` stands, inside brackets, for every character that a name may go on with."""
    return pattern.replace("@", rf"\w{_marks()}")
