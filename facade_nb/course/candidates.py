"""Exercises of tutorial 8: candidates, their bounds, and what is proven."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..solver.experiments import experiment
from .exercises import Exercise
from .houses import house
from .judging import experimental, number, numbers

__all__ = ["EXERCISES"]


def _bound(bound: Callable[..., Any]) -> str:
    tried = 0
    for width in (4.4, 6.6, 7.5):
        told = experiment(house(width=width), bound=bound)
        if told.counterexample is not None:
            return f"It says too much.\n{told.counterexample}"
        tried += told.yours[0].tried
    return (
        ""
        if tried <= 7
        else f"It is true, but in three houses {tried} candidates are aligned; 7 will do. It could say more."
    )


EXERCISES: Mapping[str, Exercise] = {
    "bounds": Exercise(
        numbers((0.9, 0.375, 0.15), ("k = 1", "k = 2", "k = 3")),
        (
            "Let the columns be as wide as the wall is long, and nothing else be wrong. What does the canvas cost?",
            "The walls have 3.0, 5.1 and 7.2 m; each metre by which they miss 6.6 m costs 0.25.",
        ),
        "0.9, 0.375 and 0.15 m. Wider columns would leave the wall empty somewhere, which costs more than the 0.25.",
    ),
    "aligned": Exercise(
        number(2),
        (
            "The least bound comes first. When may one be left out?",
            "k = 3 first: J = 0.75. Then k = 2, for 0.375 is less. Then the best is 0.555: what about 0.675 and 0.9?",
        ),
        "Two of four: k = 3 and k = 2. The bounds of the others exceed what is found.",
    ),
    "gap": Exercise(
        number(0.375),
        (
            "How much better could the best be? Nothing costs less than the least bound that is left.",
            "0.75 is found; the least bound of those that are left is 0.375.",
        ),
        "0.375 m: what was found, less what is proven. When the gap is 0, the answer is proven.",
    ),
    "bound": Exercise(
        experimental(_bound),
        (
            "choice.words has the words by the names of their patterns. On y the name is 'storey': use .get.",
            "0.25 * abs(word.size - choice.canvas) for the wall; 0 where there is none.",
        ),
        "True, and only the candidates that have to be are aligned.",
    ),
    "first": Exercise(
        number(1),
        (
            "In lexicographic order k = 1 comes first. Can it be aligned so that no column errs?",
            "With ε in enough columns there are no errors at all, and μ is wide: it takes the first.",
        ),
        "k = 1. Ω is 0, and nobody asks for a better one: that is why we price what is empty, and look for the best.",
    ),
}
