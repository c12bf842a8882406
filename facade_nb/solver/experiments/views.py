"""What a learner's function is asked about: plain values, in the paper's terms, that cannot be changed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from ..model.letters import Letter, Word

__all__ = ["Choice", "Column", "Node", "Pass", "Visit", "spelled"]


def spelled(letters: tuple[Letter, ...]) -> str:
    """Letters as a word: ``B A B``; ε for none."""
    return " ".join(map(str, letters)) or "ε"


@dataclass(frozen=True, slots=True)
class Node:
    """A node of the alignment decision network, with what has been laid to come to it (the paper's 5.2).

    Attributes
    ----------
    rests
        Per word, topmost first (equal words are one): the letters that are still to come. One that has been begun is
        among them.
    sizes
        Per word: the sum of the sizes of those, metres. Placeholders that may be cut count nothing: they take what
        length they like.
    cost
        g: J of the columns laid, at least.
    width, columns
        How wide the columns laid are together, and how many they are.
    canvas, tolerance, fit
        Length of the canvas, μ, and the price of a metre by which the columns miss the canvas.
    """

    rests: tuple[tuple[Letter, ...], ...]
    sizes: tuple[float, ...]
    cost: float
    width: float
    columns: int
    canvas: float
    tolerance: float
    fit: float
    _own: Callable[[], float] = field(repr=False, compare=False)

    @property
    def least(self) -> float:
        """What the product's own heuristic says here: metres that are still to come at least."""
        return self._own()

    def __str__(self) -> str:
        return "(" + ", ".join(map(spelled, self.rests)) + ")"


@dataclass(frozen=True, slots=True)
class Column:
    """A column: what it takes from each word.

    Attributes
    ----------
    elements
        Per word, topmost first: the letters it takes; an empty tuple is ε.
    sizes
        Size of each element that has one, metres: ε and placeholders have none.
    omega
        Its error by the product (Eq. 9, or its variant for letters that are not opaque).
    width
        The largest size.
    """

    elements: tuple[tuple[Letter, ...], ...]
    sizes: tuple[float, ...]
    omega: float
    width: float

    @property
    def letters(self) -> int:
        """How many letters it takes."""
        return sum(map(len, self.elements))

    @property
    def empty(self) -> int:
        """How many words it takes nothing from."""
        return sum(not own for own in self.elements)

    def __str__(self) -> str:
        return " / ".join(map(spelled, self.elements))


@dataclass(frozen=True, slots=True)
class Choice:
    """A candidate of an axis, ``"x"`` or ``"y"``: a word of each pattern, and the values of their counters (5.1).

    Attributes
    ----------
    least
        What the product's own bound says: J of the candidate at least, from the sizes of its words alone.
    """

    axis: str
    words: Mapping[str, Word]
    counters: Mapping[str, int]
    canvas: float
    least: float

    def __str__(self) -> str:
        return "(" + ", ".join(map(str, self.words.values())) + ")"


@dataclass(frozen=True, slots=True)
class Pass:
    """A pass of iterative deepening that has found nothing within its limit.

    Attributes
    ----------
    number
        From 1.
    limit, beyond
        Its limit; the least f = g + h that exceeded it.
    first
        The limit of the first pass: h of the first node.
    nodes
        How many nodes it took up.
    usual
        What the product would take as the next limit.
    """

    number: int
    limit: float
    beyond: float
    first: float
    nodes: int
    usual: float

    def __str__(self) -> str:
        return f"{self.number} (limit {self.limit:.4g} m, next f {self.beyond:.4g} m)"


@dataclass(frozen=True, slots=True)
class Visit:
    """A node that was taken up: in which pass, the rests of the words there, g, h, and f = g + h."""

    number: int
    node: str
    g: float
    h: float
    f: float

    def __str__(self) -> str:
        return f"pass {self.number}: {self.node}  g {self.g:.3f} + h {self.h:.3f} = f {self.f:.3f}"
