"""What experiments are made on: words with their sizes, and small ones at random."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from ...design.model import Design
from ..alignment.group import Group, make_group
from ..model.letters import Letter
from ..model.objective import Objective
from .views import spelled

__all__ = ["Case", "houses", "small_cases"]


@dataclass(frozen=True)
class Case:
    """Words to be aligned, topmost first.

    ``Case.of("CeC", "ABABA", A=2, B=3, C=2, canvas=12)`` makes one: a letter is a character, and a letter without a
    size is a placeholder, transparent and unsized.

    Attributes
    ----------
    canvas, tolerance
        Metres.
    cuts
        Whether placeholders may be cut between columns.
    """

    words: tuple[tuple[Letter, ...], ...]
    canvas: float
    tolerance: float
    cuts: bool = True
    name: str = ""

    @classmethod
    def of(
        cls,
        *words: str,
        canvas: float,
        tolerance: float | None = None,
        transparent: str = "",
        soft: str = "",
        attached: str = "",
        unoccludable: str = "",
        cuts: bool = True,
        name: str = "",
        **sizes: Any,
    ) -> Case:
        """A case from words and the sizes of their letters.

        Parameters
        ----------
        words
            Topmost first; spaces between letters may be left out.
        tolerance
            Default: half of the canvas, as `solve` has it.
        transparent
            Placeholders that have a size; those without one need not be named.
        soft, attached, unoccludable
            Letters that are not opaque, that are attached, or unoccludable (the paper's 3.5).
        sizes
            Metres, by letter: ``A=2, B=3``.
        """
        spelt = [word.replace(" ", "") for word in words]
        if not spelt or not all(spelt):
            raise ValueError(f"Case.of: expected words such as 'CeC', found {list(words)!r}")
        used = sorted(set("".join(spelt)))
        for given, what in (
            (transparent, "transparent"),
            (soft, "soft"),
            (attached, "attached"),
            (unoccludable, "unoccludable"),
            (sizes, "sizes"),
        ):
            for letter in given:
                if letter not in used:
                    near = get_close_matches(letter.swapcase(), used, 1)
                    hint = f"; did you mean {near[0]!r}?" if near else ""
                    raise ValueError(
                        f"Case.of: {what} names {letter!r}, and the letters are {', '.join(used)}{hint}"
                    )
        if not canvas > 0:
            raise ValueError(f"Case.of: expected a canvas of more than 0 m, found {canvas!r}")
        for letter in soft + attached + unoccludable:
            if letter not in sizes:
                raise ValueError(
                    f"Case.of: {letter!r} has no size, so it is a placeholder; qualifiers are for others"
                )
        for letter, size in sizes.items():
            if not isinstance(size, (int, float)) or not 0 < size < float("inf"):
                raise ValueError(f"Case.of: expected a size of more than 0 m, found {letter}={size!r}")
        letters = {
            a: Letter(
                a,
                None if a not in sizes else float(sizes[a]),
                transparent=a in transparent or a not in sizes,
                opaque=a not in soft,
                attached=a in attached,
                unoccludable=a in unoccludable,
            )
            for a in used
        }
        mu = 0.5 * canvas if tolerance is None else float(tolerance)
        if not mu >= 0:
            raise ValueError(f"Case.of: expected a tolerance of 0 m or more, found {tolerance!r}")
        return cls(tuple(tuple(letters[a] for a in word) for word in spelt), float(canvas), mu, cuts, name)

    def group(self, objective: Objective) -> Group:
        """Ready to be aligned."""
        return make_group(self.words, self.canvas, self.tolerance, objective, cuts=self.cuts)

    def __str__(self) -> str:
        sizes = {a.symbol: a for word in self.words for a in word}
        told = ", ".join(
            f"{name} {'no size' if a.size is None else f'{a.size:g}'}" for name, a in sorted(sizes.items())
        )
        head = f"{self.name}: " if self.name else ""
        return f"{head}({', '.join(map(spelled, self.words))}) with {told}, on {self.canvas:g} m"


def small_cases(count: int, seed: int) -> Iterator[Case]:
    """Random words of two or three rows with one to four letters; the smallest come first.

    Sizes are few, so that many columns fit and many do not. Every third case has a placeholder.
    """
    chance = random.Random(seed)
    for n in range(count):
        most = 2 + 3 * n // count
        rows = 2 if n % 4 else 3
        sizes = {a: chance.choice((0.5, 1.0, 1.5, 2.0, 3.0)) for a in "ABC"}
        words: list[str] = []
        while len(words) < rows:
            word = "".join(chance.choice("ABC") for _ in range(chance.randint(1, most)))
            words += [word] if word not in words else []
        if n % 3 == 2:
            words[0] = words[0][:1] + "e" + words[0][1:]
        used: dict[str, Any] = {a: sizes[a] for word in words for a in word if a != "e"}
        totals = [sum(used.get(a, 0.0) for a in word) for word in words]
        canvas = max(0.5, max(totals) + chance.choice((-0.5, 0.0, 0.0, 0.5, 1.0)))
        yield Case.of(*words, canvas=canvas, name=f"case {n + 1}", **used)


_HOUSE: Mapping[str, object] = {
    "format": "facade-nb/design/1",
    "symbols": {
        "A": {"size": 0.9},
        "B": {"size": 1.2, "unoccludable": True},
        "C": {"size": 0.6},
        "Y": {"size": 2.8},
    },
    "patterns": {"walls": "A(BA)^k", "front": "cec; c := C", "storey": "Y"},
    "layers": [
        {"name": "walls", "x": {"pattern": "walls"}, "y": {"pattern": "storey"}},
        {"name": "front", "x": {"pattern": "front"}, "y": {"pattern": "storey"}, "depth": 1},
    ],
}


def houses(widths: Sequence[float] = (3.3, 4.4, 6.6, 7.5)) -> list[Design]:
    """One tiny house on canvases of several widths: several candidates each."""
    return [
        Design.from_dict({**_HOUSE, "name": f"Tiny house, {w:g} m", "canvas": {"width": w, "height": 2.8}})
        for w in widths
    ]
