"""Exercises of tutorial 3: what is known of counters and placeholders before any word is made."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..design import Design
from ..solver.analysis.results import Analysis
from ..solver.analysis.systems import analyse
from ..solver.model.problem import axis_problem
from .exercises import Exercise, Open
from .judging import Judge, among, function, number, numbers

__all__ = ["EXERCISES", "abreast", "known"]

_SIZES = {"A": 0.5, "B": 1.2, "C": 0.3, "D": 1.1, "Y": 3.0}


def abreast(*patterns: str) -> Design:
    """A design of patterns that all span one canvas: P, Q and so on, each in a group of its own."""
    named = dict(zip("PQRSTU", patterns, strict=False))
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": " and ".join(named),
            "canvas": {"width": 6.0, "height": 3.0},
            "symbols": {name: {"size": size} for name, size in _SIZES.items()},
            "patterns": {**named, "storey": "Y"},
            "layers": [
                {"name": name, "x": {"pattern": name, "group": name}, "y": {"pattern": "storey"}}
                for name in reversed(named)
            ],
        }
    )


def known(*patterns: str) -> Analysis:
    """What the solver knows of patterns that all span one canvas, before it makes a word."""
    return analyse(axis_problem(abreast(*patterns), "x"))


def _left_over(answer: object) -> str:
    if not isinstance(answer, (list, tuple)) or len(answer) != 2:
        return f"Expected a list of two texts, found {answer!r}."
    if ... in answer:
        raise Open("put texts in the place of the dots.")
    for given, right, where in (
        (answer[0], ("CC^mC", "C^mCC", "CCC^m", "C^(m+2)", "C^{m+2}"), "first"),
        (answer[1], ("C^l",), "second"),
    ):
        if not isinstance(given, str):
            return f"Expected texts, found {given!r}."
        if given.replace(" ", "") not in right:
            return f"{given!r} is not what is left of the {where}."
    return ""


def _trim(trim: Callable[..., Any]) -> str:
    for one, other, right in (
        (["A^k", "C", "C^m", "C", "A^k"], ["A^k", "C^l", "A^k"], (["C", "C^m", "C"], ["C^l"])),
        (["A", "B"], ["B", "A"], (["A", "B"], ["B", "A"])),
        (["A", "B", "C"], ["A", "D", "C"], (["B"], ["D"])),
        (["A", "A"], ["A"], (["A"], [])),
        (["A", "B"], ["A", "B"], ([], [])),
    ):
        given = list(one), list(other)
        said = trim(list(one), list(other))
        if not isinstance(said, (list, tuple)) or len(said) != 2:
            return f"Of {given[0]} and {given[1]} you say {said!r}; expected two lists."
        if (list(said[0]), list(said[1])) != right:
            return f"Of {given[0]} and {given[1]} you say {list(said[0])} and {list(said[1])}."
    return ""


def _line(right: Callable[[int], float], tried: Sequence[int] = (1, 3, 8)) -> Judge:
    """A function of a counter."""

    def judge(asked: Callable[..., Any]) -> str:
        for count in tried:
            said = asked(count)
            if not isinstance(said, (int, float)) or abs(said - right(count)) > 1e-6:
                return f"For {count} you say {said!r}."
        return ""

    return function(judge)


def _possible(answer: object) -> str:
    pairs = (
        ("A(BA)^k", "(AB)^j A"),
        ("(AAA)^m A", "(AAA)^l"),
        ("(AAA)^m", "(AA)^l A"),
        ("A^m B A^m", "A^l A^l B A"),
    )
    if not isinstance(answer, (list, tuple)) or len(answer) != len(pairs):
        return f"Expected a list of {len(pairs)} times True or False, found {answer!r}."
    if ... in answer:
        raise Open("put True or False in the place of the dots.")
    right = [known(*pair).blame() is None for pair in pairs]
    off = [n for n, (given, own) in enumerate(zip(answer, right, strict=True), 1) if given is not own]
    return f"Look again at pair {', '.join(map(str, off))}." if off else ""


def _mended(answer: object) -> str:
    if not isinstance(answer, str):
        return f"Expected a pattern as a text, found {answer!r}."
    beside = answer.replace(" ", "").replace("A^mA^m", "", 1)
    if not beside or set(beside) != {"A"}:
        return "Leave A^m A^m in it, and put walls A before it or after it."
    return known(answer, "A^l A^l").blame() or ""


EXERCISES: Mapping[str, Exercise] = {
    "left over": Exercise(
        _left_over,
        (
            "Both begin with A^k, and both end with A^k. Take that away from both.",
            "C C^m C is left of the first. What is left of the second?",
        ),
        "C C^m C against C^l.",
    ),
    "equation": Exercise(
        _line(lambda m: m + 2, (0, 1, 5)),
        (
            "C C^m C has one C, m more, and another one.",
            "As many C's on both sides: l = m + 2.",
        ),
        "l = m + 2. One of the two counters is not free any more.",
    ),
    "saved": Exercise(
        numbers((441, 19), ("without the equation", "with it")),
        (
            "A counter from 0 to 20 has 21 values. And with the equation: for which m is m + 2 at most 20?",
            "21 · 21 without it; m from 0 to 18 with it.",
        ),
        "19 in place of 441, and no word has been written.",
    ),
    "depends": Exercise(
        among("none", ("A", "C", "canvas", "none")),
        (
            "Let C be twice as wide. Does that change how many there must be?",
            "The walls A have gone before, and both sides have nothing but C's.",
        ),
        "None: the size of C is on both sides, and is divided out. So it holds whatever sizes come out in the end.",
    ),
    "trim": Exercise(
        function(_trim),
        (
            "Two loops: while both have terms, and the first ones are equal, drop these; then the last ones.",
            "while one and other and one[0] == other[0]: one, other = one[1:], other[1:]",
        ),
        "That is all that analysis does to a pair; then it counts what is left.",
    ),
    "middle": Exercise(
        _line(lambda k: 1.7 * k - 0.1),
        (
            "The wall is (k + 1) walls and k windows long; the columns take two times 0.3 m of that.",
            "0.5 (k + 1) + 1.2 k − 0.6.",
        ),
        "|e| = 1.7 k − 0.1, in metres.",
    ),
    "beside the door": Exercise(
        _line(lambda k: 0.85 * k - 0.3),
        (
            "Two f and a door are as long as the wall.",
            "(0.5 (k + 1) + 1.2 k − 1.1) / 2.",
        ),
        "|f| = 0.85 k − 0.3, in metres.",
    ),
    "least": Exercise(
        number(1, "For that many windows a placeholder is no longer than 0, or there is a smaller number."),
        (
            "A placeholder is longer than 0. Put k = 0 and k = 1 into both formulas.",
            "k = 0 gives −0.1 m and −0.3 m.",
        ),
        "1: a house without windows has no room for its door.",
    ),
    "new": Exercise(
        number(2, "Can one of the three be worked out from the other two?"),
        (
            "Columns and door: |e| + 0.6 = 2 |f| + 1.1. Put in what you know of |e| and |f|: is that news?",
            "Two say all: the third follows, as it does for three rods when the first two pairs are equally long.",
        ),
        "Two. n patterns have n (n − 1) / 2 pairs, but no more than n − 1 of the equations say something new.",
    ),
    "possible": Exercise(
        _possible,
        (
            "Count the letters of each side: can the two numbers be equal for any counters from 0?",
            "Odd against even is impossible, and so is a multiple of three against one more than that.",
        ),
        "The second and the fourth never fit, whatever the sizes and whatever the canvas.",
    ),
    "mend": Exercise(
        _mended,
        (
            "The number of walls must be even, whatever m is.",
            "One more A.",
        ),
        "With an even number of walls there is a solution again: m + 1 = l.",
    ),
    "strength": Exercise(
        among("preferred", ("binding", "exact", "preferred")),
        (
            "Are there preferred sizes in it?",
            "1.7 is 0.5 + 1.2: both may change a little when the façade is sized.",
        ),
        "preferred: it is as true as the sizes in it.",
    ),
}
