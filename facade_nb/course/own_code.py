"""Exercises of tutorial 13: other errors, rules, bounds, orders and modes in the solver."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..solver import Objective
from ..solver.experiments import Case, Column, check, experiment
from ..solver.experiments.cases import small_cases
from .exercises import Exercise
from .houses import house
from .judging import Judge, among, experimental, function, number, numbers
from .own_looks import EXERCISES as LOOKS

__all__ = ["ARCADE", "EXERCISES", "HOUSE", "TRIPLET"]

HOUSE = house()
ARCADE = Case.of("CeCeC", "BABAB", A=0.9, B=1.2, C=0.6, canvas=5.4)
TRIPLET = Case.of("ABA", "CBA", "ACC", A=1.5, B=1, C=2, canvas=6.5)

_HALVED = Case.of("ABC", "AA", A=0.5, B=1.5, C=1.5, canvas=4.5)
"""Here the heuristic that was made for Eq. 9 loses the best for half of it."""


def _half(column: Column) -> float:
    return 0.5 * (max(column.sizes) - min(column.sizes))


def _nothing(node: object) -> float:
    return 0.0


def _pairs(error: Callable[..., Any]) -> str:
    for sizes, right in (
        ((1.0, 1.0), 0.0),
        ((1.0, 3.0), 2.0),
        ((1.0, 2.0, 4.0), 6.0),
        ((2.0,), 0.0),
        ((1.0, 1.0, 2.0), 2.0),
    ):
        said = error(Column(tuple(() for _ in sizes), sizes, max(sizes) - min(sizes), max(sizes)))
        if not isinstance(said, (int, float)) or abs(said - right) > 1e-6:
            return f"Of elements of {', '.join(f'{size:g}' for size in sizes)} m you say {said!r}."
    return ""


def _faster(heuristic: Callable[..., Any]) -> str:
    cases = [*small_cases(6, 1), _HALVED]
    verdict = check(column_error=_half, heuristic=heuristic, cases=cases)
    fault = verdict.worse or verdict.overestimate
    if fault is not None:
        return f"It says too much.\n{fault}"
    usual = check(column_error=_half, heuristic=_nothing, cases=cases).nodes
    return (
        ""
        if verdict.nodes < 0.8 * usual
        else f"It is exact, but takes up {verdict.nodes:,} nodes of {usual:,}."
    )


def _windows(error: Callable[..., Any]) -> str:
    told = experiment(ARCADE, column_error=error, heuristic=_nothing)
    answer = told.yours[0].answer
    if told.yours[0].alignment is None:
        return "Nothing is found any more."
    if any("C" in column.split("/")[0] and "B" in column.split("/")[1] for column in answer.split("|")):
        return f"A post still stands before a window: {answer}"
    plain = experiment(Case.of("CeC", "ABA", A=1, B=2, C=0.5, canvas=4), column_error=error)
    if abs(plain.cost - plain.ours[0].cost) > 1e-6:
        return "It changes J of façades in which no window is covered: elsewhere the error has to be column.omega."
    return ""


def _constraint(constraint: Callable[..., Any]) -> str:
    told = experiment(ARCADE, constraint=constraint)
    answer = told.yours[0].answer
    if told.yours[0].alignment is None:
        return "Nothing is found any more: it forbids too much."
    if any("C" in column.split("/")[0] and "B" in column.split("/")[1] for column in answer.split("|")):
        return f"A post still stands before a window: {answer}"
    usual = experiment(ARCADE, column_error=_priced, heuristic=_nothing)
    if told.cost > usual.cost + 1e-6:
        return f"It forbids more than posts before windows: J is {told.cost:.3f} m, and {usual.cost:.3f} m is possible."
    return ""


def _priced(column: Column) -> float:
    upper, lower = ({letter.symbol for letter in own} for own in column.elements)
    return column.omega + (1000 if "C" in upper and "B" in lower else 0)


def _loose(answer: object) -> str:
    if not isinstance(answer, (int, float)) or isinstance(answer, bool) or not answer >= 0:
        return f"Expected a price of 0 or more, found {answer!r}."
    told = experiment(TRIPLET, objective=Objective(loose=float(answer)))
    columns = told.yours[0].answer.count("|") + 1
    return "" if columns == 2 else f"With {answer:g} the answer has {columns} columns: {told.yours[0].answer}"


def _order(order: Callable[..., Any]) -> str:
    told = experiment(HOUSE, objective=Objective.paper(), tolerances=(0.5,), candidate_order=order)
    if told.layout is None:
        return "There is no layout."
    k = told.layout.counters["k"]
    return "" if k == 2 else f"The first candidate that aligns has k = {k}."


def _middle(middle: Callable[..., Any]) -> str:
    for letters, k, right in (
        ("WP", 1, "WPW'"),
        ("WP", 2, "WPWPW'P'W'"),
        ("ABC", 2, "ABCABCB'A'C'B'A'"),
        ("A", 1, "A"),
    ):
        said = middle(list(letters), k)
        if not isinstance(said, (list, tuple)) or not all(isinstance(own, str) for own in said):
            return f"Expected a list of letters, found {said!r}."
        if "".join(said) != right:
            return f"Of {k} × {letters} you make {''.join(said) or 'ε'}."
    return ""


def _bound(answer: object) -> str:
    right: Judge = number(1.48)
    return right(round(float(answer), 2)) if isinstance(answer, (int, float)) else right(answer)


EXERCISES: Mapping[str, Exercise] = {
    "windows": Exercise(
        experimental(_windows),
        (
            "column.elements has the letters of each word, topmost first; a letter's name is letter.symbol.",
            "If a C is above and a B below, return 1000 more than column.omega, else column.omega.",
        ),
        "No post before a window, as long as there is another way.",
    ),
    "constraint": Exercise(
        experimental(_constraint),
        (
            "The two questions of your error, with another answer: True where the column may be, False where not.",
            "Find out whether a C is above and whether a B is below; then return not (posts and windows).",
        ),
        "The same alignment as with the price, and nobody had to think of how much is too much.",
    ),
    "no way": Exercise(
        among(
            "the price is paid, the constraint finds nothing",
            (
                "both find the same",
                "the price is paid, the constraint finds nothing",
                "both find nothing",
            ),
        ),
        (
            "Try to place the two posts by hand. One may stand before the wall. Where does the other one go?",
            "There is no alignment without a post before a window. Can a price of 1000 m forbid anything?",
        ),
        "A price can be paid, a constraint cannot.",
    ),
    "fewer": Exercise(
        among("still exact", ("still exact", "not exact")),
        (
            "Of fewer alignments, can the best cost less than that of all?",
            "What is true of the cheapest way in the whole network is true of a network with fewer edges.",
        ),
        "Still exact: fewer edges make no way cheaper, so what is a lower bound stays one.",
    ),
    "pairs": Exercise(
        function(_pairs),
        (
            "Go over all pairs of elements; each pair once.",
            "itertools.combinations(column.sizes, 2) has the pairs; add up abs(a - b).",
        ),
        "With two words it is Eq. 9; with more, every element that differs counts.",
    ),
    "safe": Exercise(
        among("still exact", ("still exact", "not exact")),
        (
            "Compare your error with Eq. 9 on a column of three elements: which is larger?",
            "Ours says at least what is to come by Eq. 9. If columns cost more than that, does it ever say too much?",
        ),
        "Still exact. Your error is never less than Eq. 9, so what is a lower bound of one is one of the other.",
    ),
    "half": Exercise(
        among("not exact", ("still exact", "not exact")),
        (
            "Now columns cost less than the heuristic was made for.",
            "Where all that is to come is ω, it says twice the truth.",
        ),
        "Not exact: the heuristic says too much now, and paths to the best are given up.",
    ),
    "faster": Exercise(
        experimental(_faster),
        (
            "Each part of J is at least half of what it was. So what of a lower bound of J?",
            "Half of ours is a lower bound of yours: node.least has ours.",
        ),
        "Exact again, and quicker than without a heuristic.",
    ),
    "loose": Exercise(
        _loose,
        (
            "Λ makes letters stand alone. What if they may share an element for nothing?",
            "Try 0.",
        ),
        "Two columns: what is not paid for is not avoided.",
    ),
    "factor": Exercise(
        _bound,
        (
            "It may be stretched until it says more of the best candidate than that costs: two numbers above.",
            "0.555 / 0.375",
        ),
        "1.48: beyond it the bound of the best candidate exceeds its J, and it may be passed over.",
    ),
    "order": Exercise(
        experimental(_order),
        (
            "Say how badly a candidate fills the canvas. choice.words has its words, and a word its size.",
            "abs(sum(word.size for word in choice.words.values()) - choice.canvas)",
        ),
        "k = 2, the same as the best by J: a good order makes a greedy search a good one.",
    ),
    "middle": Exercise(
        function(_middle),
        (
            "First the row of all copies: letters * k. Then its mirror image, without the letter where they meet.",
            "row = letters * k; its mirror image is mirrored(row), and the first letter of that is the pivot.",
        ),
        "The row, and its mirror image without the pivot: k copies of n letters make a word of 2 k n − 1.",
    ),
    **LOOKS,
    "core": Exercise(
        numbers((0.24, 0.225), ("C/ε", "e/BAB")),
        (
            "Of C/ε one word is empty, and high is the size of C. Of e/BAB nothing is empty; loose is 0.9 + 0.9.",
            "by_empty_ · 1 · 0.6, and by_loose_ · 1.8, with 0.4 and 0.125.",
        ),
        "0.24 and 0.225 m, as weigh has it in Python: the two say the same, or a test fails.",
    ),
    "twice": Exercise(
        among(
            "the one of a trace follows, the module does not",
            (
                "both searches follow",
                "the one of a trace follows, the module does not",
                "neither follows",
            ),
        ),
        (
            "Which of the two reads rules.py?",
            "The module was built from C++ before you came. With trace=True it is not used.",
        ),
        "The module looks for what was best before. What it hands over is priced in Python once more, so J looks "
        "right, and the answer need not be: that is why a test compares both after every step.",
    ),
}
