"""Exercises of tutorial 5: what a column may hold."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..solver.experiments import Case
from .exercises import Exercise
from .judging import among, cheapest, function, number, numbers

__all__ = ["CONTROLS", "DOOR", "EXERCISES", "SLENDER", "WINDOWS"]

_SIZES: dict[str, Any] = {"A": 0.9, "B": 1.2, "C": 0.6}
SLENDER = Case.of("CeC", "ABABA", canvas=6.6, soft="C", **_SIZES)
WINDOWS = Case.of("CeC", "BABAB", canvas=5.4, soft="C", unoccludable="B", **_SIZES)
DOOR = Case.of("eCf", "FDDF", canvas=3.8, F=0.6, D=1.0, C=0.6, attached="D")
CONTROLS = Case.of("fAf", "CeC", "ABABA", A=2, B=3, C=2, e=8, f=5, transparent="ef", canvas=12)


def _c1(allowed: Callable[..., Any]) -> str:
    for column, right in (
        ([["opaque"], ["opaque", "opaque"]], True),
        ([["soft"], ["opaque"]], True),
        ([["soft"], []], False),
        ([["opaque"], []], True),
        ([["transparent"], ["opaque", "soft"]], False),
        ([["transparent"], []], False),
        ([["transparent"], ["transparent"]], True),
        ([[], ["soft"], ["opaque"]], True),
    ):
        if bool(allowed(column)) is not right:
            return f"Of {column} you say {bool(allowed(column))}."
    return ""


EXERCISES: Mapping[str, Exercise] = {
    "terms": Exercise(
        numbers((1.5, 0.45, 0.3), ("ω of C/AB", "Λ of C/AB", "E of C/ε")),
        (
            "C is 0.6 m, and AB is 0.9 + 1.2 m long. In AB there are two neighbours, A and B. C/ε is as wide as C.",
            "ω is 2.1 − 0.6. Λ is half of the smaller one, A. E is half of the width of C.",
        ),
        "1.5, 0.45 and 0.3 m: errors, looseness and room are all told in metres, so that they can be added.",
    ),
    "fewest": Exercise(
        number(3, "Think of C2: what may share an element with e?"),
        (
            "C and e may not share an element.",
            "So C, e and C stand in a column each, whatever the other word does.",
        ),
        "3: each change between a placeholder and what is seen is a boundary.",
    ),
    "C1": Exercise(
        function(_c1),
        (
            "Which rows ask for something opaque? Empty ones, and those with a soft letter. Without any it is allowed.",
            "Then some row has to have letters, all of them opaque: row and all(kind == 'opaque' for kind in row).",
        ),
        "That is C1: no holes, and nothing slender before nothing.",
    ),
    "slender": Exercise(
        cheapest(SLENDER, "C/ε | e/ABABA | C/ε"),
        (
            "A post that is not opaque needs something opaque in its column (C1): a wall, or a window.",
            "C/A at both ends, and e cut beside B, A and B.",
        ),
        "0.450 m: the posts have come in front of the walls.",
    ),
    "windows": Exercise(
        cheapest(WINDOWS, "C/B | e/A | e/B | e/A | C/B"),
        (
            "A post before a window breaks C3; a post alone breaks C1. What is left to stand before?",
            "The row above may be empty beside a window: ε/B. Then C/A.",
        ),
        "1.035 m: the posts stand before the two walls, and the outer windows are free.",
    ),
    "which": Exercise(
        among("C4", ("C1", "C2", "C3", "C4")),
        (
            "The post stands in a column in which the door's row is empty, between the two halves of the door.",
            "The one about attached letters.",
        ),
        "C4: no insertion beside an attached letter.",
    ),
    "attached": Exercise(
        cheapest(DOOR, "e/F | e/D | C/ε | f/D | f/F"),
        (
            "No column may be empty beside a D. So where can the post stand?",
            "Before one half of the door: it is opaque, and nothing forbids that.",
        ),
        "0.550 m. The door stays together, and the post stands before half of it.",
    ),
    "cut": Exercise(
        cheapest(CONTROLS, "f/C/A | f/e/B | A/e/A | f/e/BA | f/C/ε"),
        (
            "Let the lower word have a column for each of its five letters.",
            "f is cut in two on either side: f beside C, then f beside e. And e is cut in three.",
        ),
        "0 m: the last example of section 5.2, Transparent Splits. Nothing has to give way.",
    ),
}
