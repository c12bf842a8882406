"""Names and places in texts: how symbols are written, where a fault stands, the excerpt that shows it."""

from __future__ import annotations

import re
from unicodedata import category, combining, east_asian_width, normalize

from .errors import Fault

__all__ = [
    "clean_name",
    "control_character",
    "counter_fault",
    "excerpt",
    "fault_at",
    "locate",
    "spell",
    "spell_counter",
    "symbol_fault",
]

_LINE_END = re.compile(r"\r\n|\r|\n")
_CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufffe\uffff]")
_EXCERPT_WIDTH = 88


def clean_name(name: str) -> str:
    """The name in Unicode's composed form (NFC), without blanks around it and with single ones inside."""
    return normalize("NFC", " ".join(name.split()))


def control_character(text: str) -> str:
    """The first character that is no part of readable text or cannot be stored, or an empty text."""
    found = _CONTROL.search(text)
    return found[0] if found else ""


def symbol_fault(name: str) -> str:
    """Why a cleaned name cannot name a symbol, or an empty text where it can."""
    if not name:
        return "a name has at least one character"
    if control_character(name):
        return "a name has no control characters"
    if set(name) & set("<>{}"):
        return "a name has none of < > { }"
    return "'*' is the wildcard of shapes" if name == "*" else ""


def counter_fault(name: str) -> str:
    """Why a cleaned name cannot name a counter, or an empty text where it can."""
    fault = symbol_fault(name)
    if not fault and name[0] in "-−~|.:@·∘⊙":
        return f"a counter's name does not begin with {name[0]!r}; a mode stands before the brace, as in ^~{{floors}}"
    return fault or ("a number is no name" if name.isdecimal() else "")


def _is_short(name: str) -> bool:
    """Whether patterns can write the name bare: one letter, then digits; ε alone is the empty word."""
    return name[:1].isalpha() and name != "ε" and (len(name) == 1 or name[1:].isdecimal())


def spell(symbol: str) -> str:
    """The symbol as patterns write it: long names in angle brackets."""
    return symbol if _is_short(symbol) else f"<{symbol}>"


def spell_counter(counter: str) -> str:
    """The counter as patterns write it after ``^``: long names in braces."""
    return counter if _is_short(counter) else f"{{{counter}}}"


def locate(text: str, offset: int) -> tuple[int, int]:
    """Line and column, both from 1, of an offset in a text. A line ends with LF, CR or both."""
    line, start = 1, 0
    for end in _LINE_END.finditer(text):
        if end.end() > offset:
            break
        line, start = line + 1, end.end()
    return line, offset - start + 1


def excerpt(text: str, offset: int) -> str:
    """The line around an offset and, below it, a caret under the offset.

    Tabs are kept in both lines, so the caret stands right at any tab width; wide and combining characters are
    counted as they are drawn; a long line is cut around the caret.
    """
    start = max((end.end() for end in _LINE_END.finditer(text) if end.end() <= offset), default=0)
    found = _LINE_END.search(text, offset)
    end = found.start() if found else len(text)
    head = "…" if offset - start > _EXCERPT_WIDTH - 8 else ""
    if head:
        start = offset - _EXCERPT_WIDTH // 2
    tail = "…" if end - start > _EXCERPT_WIDTH else ""
    if tail:
        end = start + _EXCERPT_WIDTH
    line = head + "".join(c if c.isprintable() or c == "\t" else "\ufffd" for c in text[start:end]) + tail
    before = head + text[start:offset]
    return f"{line}\n{''.join(map(_blank, before))}^"


def fault_at(text: str, offset: int, message: str, place: str = "") -> Fault:
    """The fault of a text at an offset, with line, column and excerpt."""
    line, column = locate(text, offset)
    return Fault(place, message, line, column, excerpt(text, offset))


def _blank(character: str) -> str:
    """Blanks as wide as the character."""
    if character == "\t":
        return "\t"
    if combining(character) or category(character) in ("Mn", "Me"):
        return ""
    return "  " if east_asian_width(character) in "WF" else " "
