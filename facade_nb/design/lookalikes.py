"""Signs that a text brings from elsewhere, and the signs of the pattern language that were meant.

A dead key types ˆ for ^, an input method ｜ for |, a word processor – for -. Unicode's compatibility forms
(NFKC) tell most of them. The table has those that only look alike.
"""

from __future__ import annotations

import re
from functools import lru_cache
from itertools import chain
from unicodedata import category, decomposition, normalize
from unicodedata import name as unicode_name

from .characters import MARKED, class_of

__all__ = ["described", "is_foreign", "is_unseen", "meant", "sign_classes"]

_TABLE = {
    "^": "ˆ\u0302ꞈ⌃‸⁁↑",
    "~": "˜\u0303∼〜∽⁓˷ⸯ∿〰",
    "|": "∣¦│❘⏐׀┃∥‖￤￨︱⎮⎪",
    "'": "’′‘‚‛`´\u0301\u0300\u030d\u02b9\u0374ʼʻʽˈˊˋ‵՚׳΄᾽᾿῾´`ߴߵ❛❜｀",
    '"': "“”„‟″‴ʺˮ˝״❝❞",
    ".": "∙⋅•‧・･\u0387․。｡ˑ᛫⸱⸳⦁",
    ":": "∶ː꞉˸։׃܃⁚︰°˚○◦⚬",
    ":=": "≔≝⩴",
    "=": "═⹀꞊゠",
    ";": "\u037e؛⁏",
    "@": "☉⨀◉⦿⊚◎",
    "-": "˗⁻⁃➖﹣",
    "<": "‹«˂≺⋖",
    ">": "›»˃≻⋗",
    "#": "♯",
    ",": "、،",
    "*": "×✕✖∗⁎\u00b7⨯",
    "/": "÷∕⁄",
    "ε": "∈∊∅⌀",
    "?": "؟",
}
_MEANT = {sign: own for own, signs in _TABLE.items() for sign in signs}
_BRACKETS = (("PARENTHESIS", "()"), ("CURLY BRACKET", "{}"), ("ANGLE", "<>"), ("BRACKET", "[]"))
_FORMS = ("<wide>", "<narrow>", "<font>", "<super>", "<sub>", "<circle>", "<square>", "<fraction>")
"""Tags of compatibility forms that are another way of writing a letter, not a letter of a script."""

_ACCENTS = re.compile("[\u02b9-\u02ff\u0374\u0559\u07f4\u07f5\u2e2f\ua717-\ua71f\ua788]")
"""Accents and tone marks that stand alone. Unicode counts them as letters."""

_UNSEEN = re.compile("[\u034f\u115f\u1160\u17b4\u17b5\u3164\uffa0\ufe00-\ufe0f]")
"""Letters and marks that are not seen, besides format characters (Cf)."""

_JOINERS = "\u200c\u200d"  # they shape words of Persian and of scripts of India


def meant(sign: str) -> str:
    """The sign of the language, the letter or the digit that a character stands for; empty where it is none."""
    own = _MEANT.get(sign, "")
    if own or sign.isascii():
        return own
    kind = category(sign)
    if kind in ("Ps", "Pe"):
        name = unicode_name(sign, "")
        for word, pair in _BRACKETS:
            if word in name:
                return pair[kind == "Pe"]
    if kind == "Pd" and sign != "-":
        return "-"
    plain = normalize("NFKC", sign).replace("\u2212", "-")
    return plain if plain != sign and len(plain) == 1 and plain.isprintable() and not plain.isspace() else ""


def is_unseen(sign: str) -> bool:
    """Whether nothing is seen of a character. Blanks are not meant, nor joiners, which words of some scripts need."""
    return (category(sign) == "Cf" and sign not in _JOINERS) or _UNSEEN.match(sign) is not None


def is_foreign(sign: str) -> bool:
    """Whether a letter, a mark or a digit is none of a script, but another form of one, or a lone accent."""
    return (
        decomposition(sign).startswith(_FORMS)
        or _ACCENTS.match(sign) is not None
        or category(sign) in ("No", "Nl")
        or is_unseen(sign)
    )


def described(sign: str) -> str:
    """Number and name of a character: ``U+02C6, modifier letter circumflex accent``."""
    return f"U+{ord(sign):04X}, {unicode_name(sign, 'unnamed character').lower()}"


@lru_cache(maxsize=1)
def sign_classes() -> tuple[str, str]:
    """What stands in a character class of `re`: combining marks, and word characters that no name may have bare."""
    marks: list[int] = []
    foreign: list[int] = []
    for code in chain.from_iterable(MARKED):
        sign = chr(code)
        if category(sign)[0] == "M" and not is_unseen(sign):
            marks.append(code)
        elif (sign.isalnum() and is_foreign(sign)) or _UNSEEN.match(sign):
            foreign.append(code)
    return class_of(marks), class_of(foreign)
