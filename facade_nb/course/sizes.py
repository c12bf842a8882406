"""Exercises of tutorial 9: sizes by least squares."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ..design import Design
from ..solver import solve
from .exercises import Exercise
from .houses import house
from .judging import among, function, number, numbers

__all__ = ["EXERCISES", "post"]


def post(width: float, most: float) -> Design:
    """A row by itself: a post C of 0.6 m, of ``most`` metres at most, between two placeholders without a size."""
    side = {"pattern": "up"}
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": "Post",
            "canvas": {"width": width, "height": 2.0},
            "symbols": {"C": {"size": 0.6, "max": most}, "Y": {"size": 2.0}},
            "patterns": {"row": "xcy; c := C", "up": "Y"},
            "layers": [{"name": "row", "x": {"pattern": "row"}, "y": side}],
            "shapes": {},
        }
    )


def _rounds(answer: object) -> str:
    sizes = solve(post(7.0, 0.5)).x.sizes
    return numbers([sizes[name] for name in "Cxy"], ("C", "x", "y"))(answer)


def _grow(grow: Callable[..., Any]) -> str:
    for counts, missing in (([3, 2, 2], 0.3), ([1, 1], 0.5), ([4, 1, 2], -0.7)):
        said = np.asarray(grow(counts, missing), dtype=float)
        n = np.asarray(counts, dtype=float)
        right = missing * n / (n @ n)
        if said.shape != n.shape:
            return f"Expected {len(counts)} numbers for the counts {counts}, found {said}."
        if abs(said @ n - missing) > 1e-6:
            return (
                f"For the counts {counts} and {missing:g} m your letters grow by {said @ n:.4g} m together."
            )
        if not np.allclose(said, right, atol=1e-6):
            squares = f"the squares of yours add up to {said @ said:.5f}"
            return f"For the counts {counts} and {missing:g} m {squares}; there are smaller ones."
    return ""


def _sized(sized: Callable[..., Any]) -> str:
    for preferred, rows, right in (
        ([0.9, 1.2, 0.6], [[3, 2, 2]], [6.6]),
        ([2.0, 3.0, 1.8], [[3, 2, 0], [1, 0, -1]], [12.6, 0.0]),
        ([1.0, 2.0], [[1, 0], [0, 1]], [1.5, 1.5]),
    ):
        p, B, d = np.array(preferred), np.array(rows, dtype=float), np.array(right)
        best = p + B.T @ np.linalg.solve(B @ B.T, d - B @ p)
        said = np.asarray(sized(p, B, d), dtype=float)
        with_these = f"With B = {rows} and d = {right} your sizes {said.round(4).tolist()}"
        if said.shape != p.shape:
            return f"Expected {len(p)} sizes, found {said}."
        if not np.allclose(B @ said, d, atol=1e-6):
            return f"{with_these} do not keep B x = d."
        if not np.allclose(said, best, atol=1e-6):
            return f"{with_these} keep B x = d, but nearer ones do, too."
    return ""


def _of_the_solver(answer: object) -> str:
    sizes = solve(house(most={"A": 0.92})).x.sizes
    return numbers([sizes[name] for name in "ABC"], ("A", "B", "C"))(answer)


EXERCISES: Mapping[str, Exercise] = {
    "missing": Exercise(
        number(0.3, "Add up all columns at the sizes that are preferred."),
        ("C, A, B, A, B, A, C stand side by side.", "2 · 0.6 + 3 · 0.9 + 2 · 1.2 = 6.3"),
        "0.3 m: so much has to be shared out.",
    ),
    "most": Exercise(
        among("A", ("A", "B", "C", "all alike")),
        (
            "A symbol counts once, however many letters it has. What does a millimetre of A give, and one of B?",
            "There are three A, two B, and two C.",
        ),
        "A: a millimetre of it makes the house three longer. So it is the cheapest to grow.",
    ),
    "grow": Exercise(
        function(_grow),
        (
            "What grows in proportion to its count is cheapest: try g = t · n, and find t.",
            "The letters grow by Σ n · g = t · Σ n², which has to be what is missing.",
        ),
        "missing · n / Σ n²: 0.053 m for A, 0.035 m for B and C, as the solver has it.",
    ),
    "equations": Exercise(
        numbers(
            (3, 2, 0, 1, 0, -1),
            (
                "the first equation",
                "the first equation",
                "the first equation",
                "the second",
                "the second",
                "the second",
            ),
        ),
        (
            "The lower row fills the façade: A B A B A. How many A, B and C are there in it?",
            "In the first column stand C and A, equally wide: A − C = 0.",
        ),
        "3 A + 2 B = 12.6 and A − C = 0. The placeholder takes what B A B leave it, and needs no equation.",
    ),
    "sized": Exercise(
        function(_sized),
        (
            "Below stand the equations, beside it their transpose: [[2 * np.eye(n), B.T], [B, np.zeros((m, m))]].",
            "The right-hand side is np.concatenate([2 * preferred, d]); the first n of the solution are the sizes.",
        ),
        "That is least squares with equations, as in section 5.3.",
    ),
    "limited": Exercise(
        _of_the_solver,
        (
            "A grows to 0.92 m and no further: that is 3 · 0.02 m of the 0.3 m. The rest is for B and C.",
            "0.24 m, shared out by counts 2 and 2: each grows by 0.24 · 2 / 8.",
        ),
        "0.92, 1.26 and 0.66 m. A rule that is met exactly is called active.",
    ),
    "active": Exercise(
        among("the second", ("the first", "the second", "both", "neither")),
        (
            "Which of them is broken by 1.235 m and 0.635 m?",
            "1.235 m is less than 1.3 m. And if C grows to 0.65 m, the others get less, not more.",
        ),
        "The second: C is held at 0.65 m. The first is kept anyway, so it does not pull.",
    ),
    "rounds": Exercise(
        _rounds,
        (
            "What is C after the first round? It is kept. How much is left for x and y, and how much did they have?",
            "6.5 m are left, and they had 3.2 m each: a decimetre more, of which each gets half, for that makes the "
            "squares least.",
        ),
        "0.5, 3.25 and 3.25 m: each placeholder gets half of the decimetre that C could not take.",
    ),
}
