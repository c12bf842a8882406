"""Exercises of tutorial 12: the pipeline and a town."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ..render.pipeline import PASSES
from .exercises import Exercise, Open
from .judging import among, function, number, numbers

__all__ = ["EXERCISES"]

STEPS = ("light", "G-buffer", "occlusion", "grammar")


def _order(answer: object) -> str:
    """What each pass reads, an earlier one of the list has to have written."""
    if not isinstance(answer, (list, tuple)):
        return f"Expected a list of {', '.join(STEPS)}; found {answer!r}."
    if ... in answer:
        raise Open("put names in the place of the dots.")
    if sorted(map(str, answer)) != sorted(STEPS):
        return f"Expected each of {', '.join(STEPS)} once; found {answer!r}."
    by_name = {own.name: own for own in PASSES}
    written = {"softened", "overhang", "shadow_near", "shadow_far", "lamp_map"}
    for name in answer:
        own = by_name[name]
        if missing := [buffer for buffer in own.reads if buffer not in written]:
            return f"{name} reads {missing[0]}, which no pass before it has written."
        written.update(own.writes)
    if answer.index("occlusion") > answer.index("light"):
        return "light reads softened, which is made of what occlusion writes."
    return ""


def _close(cases: list[tuple[tuple[Any, ...], float]]) -> Callable[[Callable[..., Any]], str]:
    """A judge of functions that return a number."""

    def judge(own: Callable[..., Any]) -> str:
        for about, right in cases:
            if abs((said := float(own(*about))) - right) > 1e-6:
                return f"Of {', '.join(map(str, about))} you say {said:.4g}."
        return ""

    return judge


def _lambert(normal: tuple[float, ...], towards: tuple[float, ...]) -> float:
    return max(0.0, float(np.dot(normal, towards)))


_SUNS = [
    ((0.0, 0.0, 1.0), (0.0, 0.6, 0.8)),
    ((0.0, 1.0, 0.0), (0.0, 0.6, 0.8)),
    ((0.0, 0.0, -1.0), (0.0, 0.6, 0.8)),
    ((0.6, 0.0, 0.8), (0.8, 0.0, 0.6)),
]


EXERCISES: Mapping[str, Exercise] = {
    "once": Exercise(
        numbers((4, 1), ("drawing house after house", "noting first")),
        (
            "Drawn from the back to the front, each house paints over the one before. Who has asked the grammar then?",
            "When all houses are noted, only one of them is left at the pixel.",
        ),
        "4 and 1. What is hidden is never asked for.",
    ),
    "vertex": Exercise(
        numbers((17, 68, 122.4), ("how many floats", "how many bytes", "how many megabytes")),
        (
            "Add up the column of floats: 3 + 2 + …",
            "A float has 4 bytes. 1.8 million times as many bytes, and a megabyte is a million.",
        ),
        "17 floats, 68 bytes, 122.4 MB: the paper says around 120.",
    ),
    "order": Exercise(
        _order,
        (
            "Which of them reads nothing? It is the first. Which can run as soon as that is done?",
            "occlusion reads specular: the grammar says there how far behind the wall a colour lies.",
        ),
        "Each reads what an earlier one has written, and nothing else: so a pass can be taken out or exchanged.",
    ),
    "hides": Exercise(
        function(
            _close(
                [
                    ((1.0, 1.0, 2.0), 0.75),
                    ((0.5, 1.0, 2.0), 0.375),
                    ((-0.5, 1.0, 2.0), 0.0),
                    ((1.0, 3.0, 2.0), 0.0),
                    ((0.6, 1.2, 2.4), 0.375),
                ]
            )
        ),
        (
            "max(0, …) keeps each of the two factors from falling below 0.",
            "max(0, above / far) · max(0, 1 − far² / reach²).",
        ),
        "Steep and near hides much. What is far in front hides nothing: it only stands in the way.",
    ),
    "dark": Exercise(
        among(
            "inner corner", ("middle of a wall", "inner corner", "edge of a roof", "ground of a wide square")
        ),
        (
            "Where has a point most of its neighbours above its own surface, and near?",
            "Walls hide nothing from a point in their own plane, and all that lies on the other plane where two meet.",
        ),
        "The inner corner: under eaves, in reveals, where a wall meets the ground.",
    ),
    "sun": Exercise(
        function(_close([((n, t), _lambert(n, t)) for n, t in _SUNS])),
        (
            "Multiply the two component by component and add up: that is the cosine of the angle between them.",
            "sum(a * b for a, b in zip(normal, towards)), but not less than 0.",
        ),
        "The cosine of the angle: Lambert's law, the first part of Phong's light, which the paper uses.",
    ),
    "shadow": Exercise(
        function(
            _close([((5.0, 5.0, 0.1), 1), ((5.0, 3.0, 0.1), 0), ((5.05, 5.0, 0.1), 1), ((9.0, 8.8, 0.1), 0)])
        ),
        (
            "If what the sun sees there is nearer to it than the point is, that stands before the point.",
            "distance <= nearest + slack.",
        ),
        "That is a shadow map. Without the slack a wall would throw shadows on itself, for the map is coarse.",
    ),
    "rules": Exercise(
        number(0, "What differs from house to house? It is in the vertices."),
        (
            "A town's grammar has the rules of all styles, however many houses have a style.",
            "A house has a start rule, a size and a seed of its own, and no rule.",
        ),
        "None. Twice the houses are twice the vertices.",
    ),
    "eleven": Exercise(
        numbers((55 / 12, 25 / 7, 40 / 12), ("distance", "street", "close-up")),
        ("Divide the milliseconds of Full by those of Simple.", "For the distance: 55 / 12."),
        "About 4.6, 3.6 and 3.3: rooms, layers, masks and chance together.",
    ),
    "compare": Exercise(
        among("ratios", ("milliseconds", "ratios", "nothing")),
        (
            "One was a graphics card, the other two processor cores that do as if they were one.",
            "What can be compared on each machine is one grammar with another.",
        ),
        "Ratios within one machine can be compared; seconds of two machines tell little of a method.",
    ),
    "twice": Exercise(
        number(655, "Only the grammar's own part becomes longer."),
        (
            "What do the other passes take of the 407 ms?",
            "407 − 248 = 159 ms stay; the grammar takes 2 · 248.",
        ),
        "655 ms: 1.6 times as long, not twice. All that is not grammar stays as it is.",
    ),
    "together": Exercise(
        function(
            _close(
                [
                    (([3, 3, 3, 12, 3, 3, 3, 3], 8), 96),
                    (([3, 3, 3, 12, 3, 3, 3, 3], 4), 60),
                    (([3, 3, 3, 12, 3, 3, 3, 3], 1), 33),
                    (([2, 5], 2), 10),
                ]
            )
        ),
        (
            "Take the pixels n by n: steps[0:n], steps[n:2 * n], … Each of such a group takes as long as the longest.",
            "sum(n * max(steps[i:i + n]) for i in range(0, len(steps), n))",
        ),
        "One pixel of a group goes another way, and all of them wait for it.",
    ),
}
