"""Exercises of tutorial 7: iterative deepening, and what informs it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from ..solver import Objective
from ..solver.experiments import Case, check, experiment
from ..solver.experiments.cases import small_cases
from .exercises import Exercise
from .judging import among, experimental, number, numbers

__all__ = ["CENTRED", "EXERCISES", "SIGN", "TRIO"]

SIGN = Case.of("PSP", "ABABA", P=2, S=8, A=2, B=3, canvas=12)
CENTRED = Case.of("CeC", "ABABA", A=2, B=3, C=2, canvas=13)
TRIO = Case.of("AB", "BC", "AA", A=1, B=3, C=0.5, canvas=4.5)


def _nothing(node: object) -> float:
    return 0.0


def _solid() -> list[Case]:
    return [case for case in small_cases(20, 7) if all(a.size for word in case.words for a in word)]


def _judged(heuristic: Callable[..., Any], cases: Iterable[Case]) -> str:
    given = list(cases)
    verdict = check(heuristic=heuristic, cases=given)
    fault = verdict.worse or verdict.overestimate
    if fault is not None:
        return f"It says too much.\n{fault}"
    usual = check(heuristic=_nothing, cases=given).nodes
    if verdict.nodes > 0.8 * usual:
        return f"It is exact, but takes up {verdict.nodes:,} nodes; saying 0 takes up {usual:,}. It could say more."
    return ""


def _next_limit(next_limit: Callable[..., Any]) -> str:
    for case in (CENTRED, TRIO):
        told = experiment(case, heuristic=_nothing, next_limit=next_limit)
        right = experiment(case, heuristic=_nothing, next_limit=lambda own: own.beyond)
        mine, limits = told.yours[0].limits, right.yours[0].limits
        if mine != limits:
            n = next((k for k, (a, b) in enumerate(zip(mine, limits, strict=False)) if a != b), 0)
            return f"On {case} pass {n + 1} has the limit {mine[n]:.4g} m."
    return ""


def _tie(tie_break: Callable[..., Any]) -> str:
    case = Case.of("CeC", "ABABA", A=2, B=3, C=2, canvas=12, tolerance=1)
    told = experiment(case, objective=Objective.paper(), tie_break=tie_break)
    if told.yours[0].nodes != told.ours[0].nodes:
        return f"It takes up {told.yours[0].nodes} nodes; the paper's takes up {told.ours[0].nodes}."
    return ""


def _limits(answer: object) -> str:
    return numbers((0.0, 0.5), ("the first limit", "the second limit"))(answer)


EXERCISES: Mapping[str, Exercise] = {
    "limits": Exercise(
        _limits,
        (
            "The first limit is h of the first node. The next one is the least f that was not followed.",
            "Behind P/A at no cost, the column S/BAB has ω = 0; but B, A and B share an element, which is loose: "
            "0.25 · ½ · (2 + 2) m.",
        ),
        "0 m, then 0.5 m. The second pass finds S/BAB, and its J is the limit: nothing can be cheaper.",
    ),
    "nodes": Exercise(
        number(4),
        (
            "Count each node again in each pass, but not the first node of all.",
            "Pass 1 follows P/A and stops. Pass 2 follows P/A, S/BAB, P/A.",
        ),
        "1 + 3. A pass begins anew and remembers nothing: that is what it pays for needing so little memory.",
    ),
    "f": Exercise(
        numbers((0.5, 0.0, 0.5), ("g", "h", "f")),
        (
            "g is what the columns P/A and S/BAB cost. What is still to come costs nothing: P beside A.",
            "The looseness of B A B is in g now: 0.25 · ½ · (2 + 2).",
        ),
        "g = 0.5, h = 0, f = 0.5 m. On the best path a perfect heuristic has the same f everywhere.",
    ),
    "next limit": Exercise(
        experimental(_next_limit),
        (
            "The pass tells you by how much it failed: the least f that exceeded its limit.",
            "return the pass's beyond.",
        ),
        "With this rule no pass ever goes beyond J of the best.",
    ),
    "steps": Exercise(
        among("doubling", ("creeping", "doubling", "both alike")),
        (
            "Each pass begins anew, and takes up again what the passes before it have taken up.",
            "With small steps there are many passes, and in each of them most nodes are old ones.",
        ),
        "Doubling: fewer passes. It may look beyond the best in its last one, and that costs less.",
    ),
    "rests": Exercise(
        experimental(lambda heuristic: _judged(heuristic, _solid())),
        (
            "All columns are equally wide in all words. If one rest is d metres longer than another, the shorter one "
            "has to make up for d: by ω at 1 a metre, or by being empty at 0.8 / n a metre, n words.",
            "The cheaper of the two is 0.8 / n: return 0.8 / len(node.sizes) * (max(node.sizes) - min(node.sizes)).",
        ),
        "Exact on all of these words, and many nodes are saved.",
    ),
    "placeholders": Exercise(
        experimental(lambda heuristic: _judged(heuristic, small_cases(20, 7))),
        (
            "A placeholder can be as long as it likes, so a rest that has one is never too short. "
            "node.rests has the letters; each knows whether it is transparent.",
            "Take the least over the rests without a placeholder only; if each has one, return 0.",
        ),
        "Now it says no more than the truth with placeholders, too.",
    ),
    "too much": Exercise(
        number(1.883),
        (
            "A heuristic is safe as long as f = g + h is at most J of the best alignment through the node.",
            "Every alignment goes through the first node, where g = 0. The answer is in the table: J of the best.",
        ),
        "1.883 m: J of the best alignment. Whatever says more at the first node may lose it.",
    ),
    "ours": Exercise(
        number(1.05),
        (
            "First two words at a time: what do CeC and A still cost each other? Then W: what is laid, and the longest "
            "rest; both posts have to come.",
            "C/ε costs 0.8, e may be as short as it likes, C/A costs nothing. 10 m and two posts of 2 m are 14 m: "
            "a metre too much costs 0.25.",
        ),
        "0.8 + 0.25 = 1.05. It has looked ahead to the end without taking up a single node.",
    ),
    "pieces": Exercise(
        numbers((0.0, 0.5), ("8.4 m", "9.5 m")),
        (
            "Between which lengths may each of the three pieces be without making any ω larger? Add up.",
            "3, 2 to 3, and 3 m: from 8 m to 9 m together. What is beyond costs its own length.",
        ),
        "8.4 m lies within 8 to 9 m, and costs nothing more. 9.5 m is half a metre too long.",
    ),
    "table": Exercise(
        among(
            "more nodes, same answer",
            ("more nodes, same answer", "fewer nodes, same answer", "fewer nodes, worse answer"),
        ),
        (
            "What does the table do when a second path comes to a node that is known?",
            "It drops the dearer of the two, which cannot become better than the other. Without it both are followed.",
        ),
        "More nodes, and the same answer: the table only drops what cannot be better.",
    ),
    "tie": Exercise(
        experimental(_tie),
        (
            "The least comes first, and the paper prefers the edge with the lower total number of symbols.",
            "A column knows its number of letters: column.letters.",
        ),
        "42 nodes, as ours. Columns with few letters leave more columns, of which the paper wants many.",
    ),
    "ends": Exercise(
        numbers((10**8, 2 * 10**4), ("from one end", "from both ends")),
        (
            "Ten first edges, each with ten second ones: that is 100 paths of two edges.",
            "10 ** 8 from one end. From each of the two ends 10 ** 4.",
        ),
        "20,000 in place of 100 million: half the way is far less than half the paths.",
    ),
    "joined": Exercise(
        number(0.555),
        (
            "Both halves, and what W misses the canvas by: a metre costs 0.25.",
            "The columns are 2 · 0.6 + 3 · 0.9 + 2 · 1.2 = 6.3 m wide, and the canvas is 6.6 m.",
        ),
        "0.24 + 0.24 + 0.25 · 0.3: the last part belongs to neither half, and is known when they are joined.",
    ),
}
