"""Names and places in texts: how symbols are written, where a fault stands, the excerpt that shows it."""

from __future__ import annotations

import re
from functools import lru_cache
from unicodedata import category, combining, decomposition, east_asian_width

from .errors import Fault
from .lookalikes import described, is_foreign, is_unseen, meant
from .modes import MODES, SYNONYMS
from .names import is_identifier, nfc

__all__ = [
    "CONTROLS",
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
CONTROLS = r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufffe\uffff]"
"""What is no part of readable text or cannot be stored, as a regular expression of Python and of JavaScript."""
_CONTROL = re.compile(CONTROLS)
_EXCERPT_WIDTH = 88
_BRACKETS = ("<", ">", "{", "}")
_PIECES = re.compile("[\u1100-\u11ff\ua960-\ua97f\ud7b0-\ud7ff]")
"""Letters of which Korean syllables are made: side by side they would be one letter."""
_COUNTER = (
    "a counter's name is made of letters, digits and _, and begins with a letter, such as {floors}; nothing is "
    "computed in it: 2k copies of B are (B^2)^k, k + 1 are B^k B"
)


def clean_name(name: str) -> str:
    """The name in Unicode's composed form (NFC), without blanks around it and with single ones inside."""
    return nfc(" ".join(name.split()))


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
    if category(name[0])[0] == "M":
        return f"a name does not begin with a mark ({described(name[0])})"
    for sign in dict.fromkeys(name):
        if is_unseen(sign):
            return f"a name has no characters that are not seen ({described(sign)})"
        if decomposition(sign).startswith(("<wide>", "<narrow>")) or meant(sign) in _BRACKETS:
            return f"'{sign}' ({described(sign)}) stands in it; '{meant(sign)}' was probably meant"
    return "'*' is the wildcard of shapes" if name == "*" else ""


def counter_fault(name: str) -> str:
    """Why a cleaned name cannot name a counter, or an empty text where it can."""
    if not name or control_character(name) or name == "*":
        return symbol_fault(name)
    for sign in dict.fromkeys(name):
        if meant(sign) and is_foreign(sign):
            return f"'{sign}' ({described(sign)}) stands in it; '{meant(sign)}' was probably meant"
        if is_unseen(sign):
            return f"a name has no characters that are not seen ({described(sign)})"
    if name[0] in MODES or name[0] in SYNONYMS:
        return f"a counter's name does not begin with {name[0]!r}; a mode stands before the brace, as in ^~{{floors}}"
    if name.isdecimal():
        return "a number is no name"
    # Unicode's rule counts the middle dot in, which is a sign of multiplication here
    if not all(map(is_identifier, name.split(" "))) or "\u00b7" in name:
        return _COUNTER
    return ""


@lru_cache(maxsize=1024)  # a trace spells the same few symbols half a million times
def _is_short(name: str) -> bool:
    """Whether patterns can write the name bare: one letter with its marks, then digits; ε alone is the empty word."""
    if not name[:1].isalpha() or name == "ε" or is_foreign(name[0]) or _PIECES.match(name):
        return False
    rest = name[1:].lstrip(
        "".join(sign for sign in name[1:] if category(sign)[0] == "M" and not is_unseen(sign))
    )
    return not rest or (rest.isdecimal() and not any(map(is_foreign, rest)))


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
