"""Letters and words: what patterns become once symbols have sizes and qualifiers (paper 3.2)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import fsum

from ...design.text import spell

__all__ = ["Letter", "Word"]


@dataclass(frozen=True, slots=True)
class Letter:
    """An instance of a symbol in a word.

    Attributes
    ----------
    symbol
        The symbol's name.
    size
        Preferred size in metres; None: unsized.
    transparent
        A placeholder: draws nothing, may be cut between columns.
    opaque, attached, unoccludable
        The alignment qualifiers of the symbol (paper 3.5). A transparent letter is never opaque.
    mirrored
        Whether it is drawn as in a mirror.
    origin
        ``(symbol, n)`` if a substitution put it into the word, as content of the n-th instance of that symbol.
        Words that differ in their letters' origins alone are equal.
    """

    symbol: str
    size: float | None
    transparent: bool = False
    opaque: bool = True
    attached: bool = False
    unoccludable: bool = False
    mirrored: bool = False
    origin: tuple[str, int] | None = field(default=None, compare=False)

    def __post_init__(self) -> None:
        if self.transparent and self.opaque:
            object.__setattr__(self, "opaque", False)

    def __hash__(self) -> int:
        return hash(
            (self.symbol, self.size)
        )  # words are hashed often, and what else there is follows from the symbol

    def __str__(self) -> str:
        return spell(self.symbol) + ("'" if self.mirrored else "")


@dataclass(frozen=True, slots=True)
class Word:
    """One word of a pattern, with the values of the counters in it."""

    letters: tuple[Letter, ...]
    counters: Mapping[str, int] = field(default_factory=dict, hash=False)

    @property
    def size(self) -> float:
        """Sum of the sizes of the sized letters, in metres."""
        return fsum(letter.size or 0.0 for letter in self.letters)

    def __str__(self) -> str:
        return " ".join(map(str, self.letters)) or "ε"

    def __len__(self) -> int:
        return len(self.letters)
