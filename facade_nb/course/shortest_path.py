"""Exercises of tutorial 6: an alignment as a path through a network, and the cheapest one."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping
from math import prod
from typing import Any

from ..solver import Letter, Objective, align
from ..solver.experiments import Case
from .exercises import Exercise, Open
from .judging import cheapest, function, metres, number, numbers
from .network import nodes_of

__all__ = ["EXERCISES", "POSTS"]

POSTS = Case.of("CeC", "ABABA", A=0.9, B=1.2, C=0.6, canvas=6.6)


def _omega(omega: Callable[..., Any]) -> str:
    for column, right in (
        ([[2], [2]], 0.0),
        ([[2], [2, 3]], 3.0),
        ([[8], [3, 2, 3], [2]], 6.0),
        ([[2], []], 0.0),
        ([[], [2, 3], [1]], 4.0),
        ([[], [1], []], 0.0),
    ):
        said = omega(column)
        if abs(said - right) > 1e-6:
            return f"Of the column {column} you say {metres(said)}."
    return ""


def _states(states: Callable[..., Any]) -> str:
    for words in (("CeC", "ABABA"), ("A", "B"), ("AB", "ABA", "ABAB")):
        said, right = states(words), prod(len(word) + 1 for word in words)
        if said != right:
            return f"For {words} you say {said}."
    return ""


def _path(answer: object) -> str:
    right = nodes_of("C/ε | e/ABABA | C/ε")
    try:
        given = [tuple(node) for node in answer]  # type: ignore[attr-defined]
    except TypeError:
        return f"Expected a list of nodes, each two numbers; found {answer!r}."
    if any(... in node for node in given):
        raise Open("put numbers in the place of the dots.")
    if len(given) != len(right):
        return f"A path of three edges has four nodes; yours has {len(given)}."
    for n, (a, b) in enumerate(zip(given, right, strict=True)):
        if a != b:
            return f"Node {n + 1} is not {a}."
    return ""


def _edges(edges: Callable[..., Any]) -> str:
    for rests in ((3, 5), (1, 1), (0, 2), (0, 0), (2, 2, 2)):
        said, right = edges(rests), prod(n + 1 for n in rests) - 1
        if said != right:
            return f"With {rests} letters still to come you say {said}."
    return ""


def _shortest(shortest: Callable[..., Any]) -> str:
    chance = random.Random(6)
    objective = Objective(empty=0.8, loose=0.0, fit=0.0)
    for n in range(8):
        words = [[float(chance.choice((1, 1.5, 2, 3))) for _ in range(1 + (n + k) // 2)] for k in range(2)]
        rows = [[Letter(f"s{size:g}", size) for size in word] for word in words]
        best = align(rows, canvas=50.0, tolerance=50.0, objective=objective, search="best")
        assert best is not None
        said = shortest(*words)
        if not isinstance(said, (int, float)):
            return f"Expected metres, found {said!r}."
        if abs(said - best.cost) > 1e-6:
            two = f"{words[0]} above {words[1]}"
            return f"For the sizes {two} you say {metres(said)}; the solver says {best.cost:.4g} m."
    return ""


EXERCISES: Mapping[str, Exercise] = {
    "by hand": Exercise(
        cheapest(POSTS, "C/A | e/BAB | C/A"),
        (
            "What costs most in your ledger? ε leaves room empty in one word; a post beside a wall is no error at all.",
            "Cut e: let it stand beside each A and B in a column of its own, so that nothing is loose. "
            "Then try the posts in front of the wall, and beside it.",
        ),
        "0.555 m: the posts stand beside the wall, and e goes along with it letter by letter. Nothing costs less.",
    ),
    "omega": Exercise(
        function(_omega),
        (
            "Add up the sizes of each element first; then take the largest and the smallest sum.",
            "ε is an empty list. It fits any size, so leave it out: [sum(element) for element in column if element].",
        ),
        "That is Eq. 9.",
    ),
    "by eye": Exercise(
        numbers((6, 4, 0), ("the first", "the second", "the third")),
        (
            "Per column: the larger sum less the smaller one; ε is left out. Then add up the columns.",
            "The first has Ce = 10 m above ABA = 7 m, and C = 2 m above BA = 5 m.",
        ),
        "Ω is 6, 4 and 0 m: by Eq. 9 the third is the best.",
    ),
    "states": Exercise(
        function(_states),
        (
            "One head can stand before each letter of its word, and behind the last one.",
            "So a word of n letters has n + 1 places; the heads move independently of each other.",
        ),
        "4 · 6 = 24 for Figure 8. (The supplement prints the product of the lengths, and forgets its end marker #.)",
    ),
    "path": Exercise(
        _path,
        (
            "The first node is (0, 0). The column C/ε reads one letter of the upper word, and none of the lower one.",
            "e/ABABA reads one letter of the upper word and all five of the lower one.",
        ),
        "Each column is one edge, and each path one alignment.",
    ),
    "edges": Exercise(
        function(_edges),
        (
            "A column takes 0, 1, … or all of the letters that are left of a word, of each word as it likes.",
            "One of these choices takes nothing at all. That is no column.",
        ),
        "(n + 1)(m + 1) − 1, and so on for more words: 23 from the first node of Figure 8.",
    ),
    "free": Exercise(
        number(0.0, "There is an alignment with less."),
        (
            "Eq. 9 leaves ε out. What is ω of a column with one letter in it, and ε?",
            "Give each letter of both words a column of its own.",
        ),
        "0 m, for any words: every letter alone beside ε.",
    ),
    "shortest": Exercise(
        function(_shortest),
        (
            "Your line compares best with another way on: the edge's price, and what is ahead of where it leads.",
            "The edge to (k, l) takes upper[i:k] and lower[j:l]; from there on it costs ahead(k, l).",
        ),
        "Eight pairs of words, and the solver says the same each time. That is a shortest path.",
    ),
    "widths": Exercise(
        numbers((1.25, 1.1), ("the first path", "the second path")),
        (
            "How wide is each at the end, and by how much does it miss 12 m?",
            "The first is 6 + 5 = 11 m wide, and pays 0.25 for the metre that is missing; the second fits.",
        ),
        "1.25 and 1.1 m: whoever had dropped the dearer path at the node would have lost the best.",
    ),
    "many": Exercise(
        number(21**5 - 1),
        (
            "It is the exercise of the edges again, with five words of 20 letters each.",
            "21 · 21 · 21 · 21 · 21, and one of these takes nothing.",
        ),
        "4,084,100 edges from one node: too many to look at, let alone to keep in a queue.",
    ),
    "region": Exercise(
        number(3),
        (
            "Look for numbers of at most 1, where both words give something: not in the first row or column.",
            "C beside A, Ce beside ABAB, and one more.",
        ),
        "Three of 15: C beside A, Ce beside ABAB, all beside all. They lie along the diagonal.",
    ),
}
