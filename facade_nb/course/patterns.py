"""Exercises of tutorial 2: patterns, and the words that fit."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..design import Design, DesignError, NoLayout
from ..solver import solve
from .exercises import Exercise, Open
from .houses import house
from .judging import Judge, function, numbers
from .words import listed

__all__ = ["EXERCISES"]


def _spelt(right: Sequence[str]) -> Judge:
    def judge(answer: object) -> str:
        if isinstance(answer, list) and ... in answer:
            raise Open("put words in the place of the dots.")
        if not isinstance(answer, list) or not all(isinstance(word, str) for word in answer):
            return f"Expected a list of words, as texts; found {answer!r}."
        given = [word.replace(" ", "").replace("′", "'") for word in answer]
        if len(given) != len(right):
            return f"There are {len(right)} words, not {len(given)}."
        return next(
            (
                f"{word!r} is not the word there."
                for word, own in zip(given, right, strict=True)
                if word != own
            ),
            "",
        )

    return judge


def _pattern(right: Sequence[str], **most: int) -> Judge:
    """A pattern with just these words; it is told which one is missing, or too many."""

    def judge(answer: object) -> str:
        if not isinstance(answer, str):
            return f"Expected a pattern as a text, found {answer!r}."
        try:
            found = listed(answer, **most)
        except DesignError as error:
            return str(error)
        over = [word for word in found if word not in right]
        if over:
            return (
                f"It makes {over[0]}, which is not wanted."
                if len(over[0]) < 40
                else "It makes words without end."
            )
        missing = [word for word in right if word not in found]
        return f"It does not make {missing[0]}." if missing else ""

    return judge


def _row(answer: object) -> str:
    if not isinstance(answer, str):
        return f"Expected a pattern as a text, found {answer!r}."
    try:
        design: Design = house(walls=answer)
        row = solve(design).x.row("walls").letters
    except (DesignError, NoLayout) as error:
        return str(error)
    told = "".join(own.symbol + "'" * own.mirrored for own in row)
    for left, right in zip(row[: len(row) // 2], reversed(row), strict=False):  # from the ends inwards
        if left.symbol != right.symbol:
            return f"In {told} {left.symbol} is opposite {right.symbol}."
        if left.mirrored or not right.mirrored:
            return f"In {told} {right.symbol} on the right is no mirrored {left.symbol}."
    return "" if row[0].symbol == "A" else f"{told} has no wall at its left end."


def _lower(bound: Callable[..., Any]) -> str:
    for canvas, mu, opaque, right in (
        (6.6, 1.0, [], 5.6),
        (6.6, 1.0, [0.6, 0.6], 4.4),
        (10.0, 0.0, [3.0], 7.0),
    ):
        said = bound(canvas, mu, opaque)
        if not isinstance(said, (int, float)) or abs(said - right) > 1e-6:
            return f"For a canvas of {canvas:g} m, μ = {mu:g} m and {opaque} m of opaque letters you say {said!r}."
    return ""


def _fits(answer: object) -> str:
    if isinstance(answer, (list, tuple)) and any(own is ... for own in answer):
        raise Open("put lists of values of k in the place of the dots.")
    if not isinstance(answer, (list, tuple)) or len(answer) != 2:
        return f"Expected two lists of values of k, found {answer!r}."
    for given, right, where in zip(answer, ([3], [2, 3]), ("alone", "behind the posts"), strict=True):
        if list(given) != right:
            return f"Look again at the wall {where}."
    return ""


EXERCISES: Mapping[str, Exercise] = {
    "pairs": Exercise(
        _pattern(["A", "ABBA", "ABBABBA"], k=2),
        (
            "A(BA)^k repeats B A. What has to be repeated instead?",
            "Two windows and a wall: B B A.",
        ),
        "A(BBA)^k, or the like: A, ABBA, ABBABBA and so on.",
    ),
    "by sight": Exercise(
        _spelt(["D", "EFD", "EFEFD"]),
        (
            "Write the word for k = 0 first: X to the power of 0 is the empty word.",
            "What stands behind the count, D, is there each time.",
        ),
        "D, EFD and EFEFD.",
    ),
    "choice": Exercise(
        _pattern(["ABA", "ACA"]),
        (
            "| separates what may be chosen, and binds less than anything else. So it needs brackets here.",
            "A( … | … )A",
        ),
        "A(B|C)A. Without the brackets it would be a choice of AB or CA.",
    ),
    "counters": Exercise(
        numbers((4, 16), ("the first", "the second")),
        (
            "A counter has one value wherever it stands.",
            "In the first there is one choice of k; in the second each of four values of j goes with each of k.",
        ),
        "4 and 16. AB, AABB, AAABBB: no regular expression can say that, which is why patterns count.",
    ),
    "centred": Exercise(
        _pattern(["yAy", "yABAy", "yABABAy"], k=2),
        (
            "Write the control pattern first, with a letter m for the content; then ; and m := with its pattern.",
            "y m y; m := A(BA)^k",
        ),
        "The content between two placeholders y, equally long since they are the same symbol: that centres it.",
    ),
    "mirrors": Exercise(
        _spelt(["ABCC'B'A'", "ABCB'A'"]),
        (
            "Mirroring turns the order round and mirrors each letter: (ABC)' is C'B'A'.",
            "Outer: a copy, then a mirrored one. At a pivot the letter where they meet stands once, not mirrored.",
        ),
        "Table 1 of the supplement has all the modes.",
    ),
    "row": Exercise(
        _row,
        (
            "A count mirrors what it repeats, and nothing outside of it. So what must stand inside?",
            "(AB)^|k: A B, then B' A'.",
        ),
        "The right half mirrors the left, walls at both ends.",
    ),
    "lower": Exercise(
        function(_lower),
        (
            "What is in front and opaque can push the wall aside: then the wall may be shorter by that.",
            "Take the sum of the opaque letters off, too.",
        ),
        "That is the lower bound of Eq. 7. (The paper prints the second case without μ; with it is Figure 7.)",
    ),
    "fits": Exercise(
        _fits,
        (
            "The words have 0.9, 3.0, 5.1, 7.2, 9.3 m for k = 0, 1, 2, 3, 4. The upper bound is 7.6 m.",
            "Alone the lower bound is 5.6 m; behind the posts it is 4.4 m.",
        ),
        "Alone only k = 3; behind two posts k = 2 as well, though it misses the canvas by more than μ.",
    ),
}
