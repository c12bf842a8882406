"""Exercises of tutorial 10: a pixel by grammar."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import ceil
from typing import Any

import numpy as np

from ..render.texture import Grammar
from .exercises import Exercise, Open
from .judging import Judge, among, function, number, numbers

__all__ = ["ARCH", "EXERCISES"]

ARCH = """
    S -> Layer(Inside, Wall, Hole)
    Inside -> Mat(Color, 0, 0.20, 0.24, 0.32, 1)
    Wall -> Mat(Color, Rep:brick, 0, 0, 0.5, 0.5)
"""
"""What tutorial 10 cuts an arch into; the rule Hole is the reader's."""


def _lengths(own: Callable[..., Any], cases: list[tuple[tuple[Any, ...], list[float]]]) -> str:
    for about, right in cases:
        said = np.asarray(own(*about), dtype=float)
        if said.shape != (len(right),):
            return f"Of {', '.join(map(str, about))} you say {said.tolist()}: expected {len(right)} lengths."
        if not np.allclose(said, right, atol=1e-6):
            return f"Of {', '.join(map(str, about))} you say {said.round(3).tolist()}."
    return ""


def _repeat(repeat: Callable[..., Any]) -> str:
    cases: list[tuple[float, float]] = [(14.0, 2.5), (5.0, 2.5), (1.0, 2.5), (8.0, 2.5)]
    return _lengths(repeat, [((size, v), [size / ceil(size / v)] * ceil(size / v)) for size, v in cases])


def _split(split: Callable[..., Any]) -> str:
    return _lengths(
        split,
        [
            ((6.0, [(1, 1.0), (-1, 1.2), (1, 1.0)]), [2.4, 1.2, 2.4]),
            ((10.0, [(-1, 3.0), (1, 2.0), (1, 1.0), (-1, 1.0)]), [3.0, 4.0, 2.0, 1.0]),
            ((7.0, [(1, 5.0)]), [7.0]),
        ],
    )


def _equal(cases: list[tuple[tuple[Any, ...], object]]) -> Callable[[Callable[..., Any]], str]:
    """A judge of functions that return whole numbers."""

    def judge(own: Callable[..., Any]) -> str:
        for about, right in cases:
            if (said := own(*about)) != right:
                return f"Of {', '.join(map(str, about))} you say {said}."
        return ""

    return judge


def _composed(composed: Callable[..., Any]) -> str:
    for layers in (
        [(0.2, 1.0)],
        [(0.2, 0.5), (0.8, 0.5), (0.5, 1.0)],
        [(1.0, 0.0), (0.4, 0.25)],
        [(0.9, 1.0), (0.1, 1.0)],
    ):
        colour = alpha = 0.0
        for c, a in layers:
            colour, alpha = colour + (1 - alpha) * a * c, alpha + (1 - alpha) * a
        said = np.asarray(composed(layers), dtype=float)
        if said.shape != (2,):
            return f"Expected C and A, found {said.tolist()}."
        if not np.allclose(said, [colour, alpha], atol=1e-6):
            return f"Of {layers} you say C = {said[0]:.4g}, A = {said[1]:.4g}."
    return ""


def _rule(judge: Callable[[str], str]) -> Judge:
    """A rule as text, of which the judge makes a grammar."""

    def of(answer: object) -> str:
        if not isinstance(answer, str):
            return f"Expected a rule as a text, found {answer!r}."
        if "…" in answer or "..." in answer:
            raise Open("put your values in the place of the dots.")
        return judge(answer)

    return of


def _turned(answer: str) -> str:
    grammar = Grammar.parse(ARCH + answer)
    found = grammar.evaluate([(0.8, 1.0), (0.03, 2.75)], size=(1.6, 2.8)).rule
    inside, outside = (grammar.rules[i].name if i >= 0 else "nothing" for i in found)
    if (inside, outside) == ("Wall", "Inside"):
        return ""
    return f"In the arch one sees {inside}, and beside it {outside}."


EXERCISES: Mapping[str, Exercise] = {
    "repeat": Exercise(
        function(_repeat),
        (
            "How often does v go into the size, rounded up? math.ceil rounds up.",
            "n = ceil(size / v), and each part is size / n: [size / n] * n.",
        ),
        "⌈size / v⌉ equal parts: v is the most that a part may have.",
    ),
    "split": Exercise(
        function(_split),
        (
            "First add up the absolute sizes, and the relative ones. What is left of the size for the relative?",
            "unit = (size − sum of the absolute) / (sum of the relative); a relative part has v · unit.",
        ),
        "That is Eq. 1. What is absolute stays, what is relative shares the rest.",
    ),
    "by hand": Exercise(
        numbers((2.4, 3.9, 3.6, 5.4), ("the left", "the bottom", "the right", "the top")),
        (
            "The floors begin at 3 m: two of 3 m. The row of bays is 8 m wide: ⌈8 / 2.5⌉ parts.",
            "The bay is from 2 to 4 m, and the floor from 3 to 6 m. The column takes 1.2 m from the bay's middle; "
            "in it the window begins 0.9 m above the floor.",
        ),
        "From 2.4 to 3.6 m across, from 3.9 to 5.4 m up: you have evaluated a grammar for one pixel.",
    ),
    "part": Exercise(
        function(
            _equal(
                [
                    (([1, 2, 3], 0.5), 0),
                    (([1, 2, 3], 1.5), 1),
                    (([1, 2, 3], 5.9), 2),
                    (([1, 0, 2], 1.5), 2),
                    (([2, 2, 2, 2], 3.5), 1),
                    (([1, 2, 3], 6), 2),
                ]
            )
        ),
        (
            "Go through the sizes and add them up, until the sum is more than `at`.",
            "After the loop there is a point on the far edge, which belongs to the last part.",
        ),
        "Part after part, until one is hit. A shader that finds it among the first need not read the others.",
    ),
    "composed": Exercise(
        function(_composed),
        (
            "Begin with C = 0 and A = 0. Of what comes next, only 1 − A is still to be seen.",
            "C += (1 − A) · a · c first, and then A += (1 − A) · a.",
        ),
        "Eq. 2 and 3. Once A is 1, nothing that follows changes anything.",
    ),
    "stop": Exercise(
        number(3, "Which layer is the first that lets nothing through?"),
        (
            "An alpha of 0.4 lets 0.6 of what is below through.",
            "After the layer whose alpha is 1, A is 1.",
        ),
        "Three. The other two cost nothing, whatever they hold.",
    ),
    "hole": Exercise(
        among("Inside", ("Inside", "Wall", "Hole")),
        (
            "Layers are gone through from the last of the list to the first.",
            "l1 = 1: besides the layer of Hole itself, one more is passed over. Which is next below?",
        ),
        "Inside. Nothing was cut out of the wall: it is not asked there.",
    ),
    "turned": Exercise(
        _rule(_turned),
        (
            "In the arch the mask is 1, beside it 0. How many layers should be passed over in each case?",
            "l0 is for 0 and l1 for 1: exchange them.",
        ),
        "One number each for where the mask is 0 and where it is 1.",
    ),
    "rand": Exercise(
        function(
            _equal(
                [
                    ((0.1, [0.25, 0.5, 0.25]), 0),
                    ((0.25, [0.25, 0.5, 0.25]), 1),
                    ((0.74, [0.25, 0.5, 0.25]), 1),
                    ((0.75, [0.25, 0.5, 0.25]), 2),
                    ((0.5, [1.0]), 0),
                ]
            )
        ),
        (
            "Add up the shares, and stop where the sum is more than r.",
            "It is `part` again: the shares are lengths that add up to 1, and r is a point on them.",
        ),
        "A Rand is a split of the numbers from 0 to 1. The texture keeps the sums, so that nobody adds them up.",
    ),
    "groups": Exercise(
        numbers((0, 1, 2), ("each window for itself", "one kind a floor", "one kind for the house")),
        (
            "Say which corners are on the stack when Bay is reached. The last one put on is number 1.",
            "The house's corner was put on first, then the floor's. 0 is the scope's own.",
        ),
        "0, 1 and 2: the further down the stack, the larger the group.",
    ),
    "pixels": Exercise(
        numbers((1, 4, 4), ("RepeatX", "SplitX of three parts", "RandUni of five rules")),
        (
            "SplitX has a first pixel of its own, and one for each part.",
            "RandUni has a first pixel of its own, and after it two rules in each.",
        ),
        "1, 1 + 3, and 1 + 3, with half of the last one empty.",
    ),
    "first": Exercise(
        numbers((3, 3, 2, 1.2), ("the code", "n", "Σrel", "Σabs")),
        (
            "SplitX has the code 3 in the paper's Figure 3; then come n and the two sums.",
            "Two parts are relative, with 1 each, one is absolute.",
        ),
        "3, 3, 2, 1.2. With the sums in the first pixel, one need not read all parts to know how long the first is.",
    ),
}
