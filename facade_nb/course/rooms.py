"""Exercises of tutorial 11: rooms behind windows."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..render.texture import Grammar
from ..render.texture.steps import Entered
from .exercises import Exercise, Open
from .judging import among, function, number, numbers

__all__ = ["EXERCISES", "ROOM"]

FACES = ("left", "back", "right", "floor", "ceiling")

ROOM = """
    S -> Intrusion(2, Near, Middle, Near, Floor, Ceiling)
    Middle -> Layer(Rest, Furniture)
    Rest -> Intrusion(2, Far, Back, Far, Floor, Ceiling)
    Near -> Mat(Color, Fit:room-terracotta, 0, 0, 0.5, 1)
    Far -> Mat(Color, Fit:room-terracotta, 0.5, 0, 1, 1)
    Back -> Mat(Color, Fit:room-door, 0, 0, 1, 1)
    Floor -> Mat(Color, Rep:parquet, 0, 0, 0.5, 0.5)
    Ceiling -> Mat(Color, Fit:ceiling-plain, 0, 0, 1, 1)
    SofaTile -> Mat(Color, Fit:sofa-blue, 0, 0, 1, 1)
    Skip -> Skip(0)
"""
"""The room that tutorial 11 furnishes, 4 m wide and 2.6 m high; the rule Furniture is the reader's."""

_BOX = Grammar.parse(
    "S -> Intrusion(3, left, back, right, floor, ceiling)"
    + "".join(f"  {name} -> Mat(Color, 0, 0, 0, 0, 1)" for name in FACES)
)


def _hit(hit: Callable[..., Any]) -> str:
    """The product's own evaluator says what is right."""
    for point, ray in (
        ((1.0, 1.2), (1.0, 0.0, -1.0)),
        ((1.0, 1.2), (-1.0, -0.5, -0.5)),
        ((0.5, 2.0), (0.1, 0.1, -1.0)),
        ((1.0, 1.2), (0.2, -1.0, -1.0)),
        ((1.5, 1.8), (0.2, 0.9, -0.7)),
        ((1.0, 1.2), (0.0, 0.0, -1.0)),
    ):
        right = next(
            own.face for own in _BOX.steps(point, size=(2, 2.4), ray=ray) if isinstance(own, Entered)
        )
        if (said := hit(point, ray, (2.0, 2.4), 3.0)) != right:
            return f"From {point} along {ray}, in a box of 2 m by 2.4 m by 3 m, you say {said!r}."
    return ""


def _parallax(shift: Callable[..., Any]) -> str:
    for eye, distance, depth in ((1.0, 3.0, 0.0), (1.0, 3.0, 2.0), (2.0, 8.0, 4.0), (-1.0, 3.0, 6.0)):
        said = float(shift(eye, distance, depth))
        if abs(said - eye * depth / (distance + depth)) > 1e-6:
            return f"For a step of {eye:g} m, {distance:g} m before the glass, {depth:g} m deep, you say {said:.4g} m."
    return ""


def _sofa(answer: object) -> str:
    if not isinstance(answer, str):
        return f"Expected rules as a text, found {answer!r}."
    if answer.strip() == "Furniture -> Skip(0)":
        raise Open("that is the empty room. Write rules in its place.")
    grammar = Grammar.parse(ROOM + answer)
    scopes = [
        own.scope
        for own in grammar.steps((2.0, 0.4), size=(4, 2.6))
        if own.name == "SofaTile" and "back" in own.faces
    ]
    if not scopes:
        return "In the middle, 0.4 m above the floor, there is no SofaTile."
    left, bottom, right, top = scopes[0]
    if abs(right - left - 2.1) > 0.01 or abs(top - bottom - 0.9) > 0.01:
        return f"Your sofa is {right - left:.2f} m wide and {top - bottom:.2f} m high."
    if abs(left - 0.95) > 0.01 or abs(bottom) > 0.01:
        return f"Your sofa begins {left:.2f} m from the left and {bottom:.2f} m above the floor."
    beside = grammar.evaluate([(0.3, 0.5), (3.7, 0.5), (2.0, 2.0)], size=(4, 2.6)).rule
    if any(grammar.rules[k].name != "Back" for k in beside):
        return "Beside and above the sofa one should see the wall at the back."
    return ""


EXERCISES: Mapping[str, Exercise] = {
    "triangles": Exercise(
        number(2, "There are fewer than one would think."),
        (
            "The rooms are drawn by the grammar, as the bricks are. What is left for triangles?",
            "The façade is one rectangle.",
        ),
        "Two: one rectangle. All else is said by the grammar, pixel by pixel.",
    ),
    "first": Exercise(
        among("right", FACES),
        (
            "Go along the ray in steps: after s of them you are at x = 1 + s, and s metres deep.",
            "At x = 2 there is the wall on the right, and you are there after s = 1. The wall at the back is 3 m deep.",
        ),
        "The wall on the right, after s = 1. The one at the back would come after s = 3.",
    ),
    "hit": Exercise(
        function(_hit),
        (
            "For each direction: how far is it to the face ahead, divided by the speed towards it? "
            "The right wall: (width − x) / rx, if rx is above 0. The back: depth / −rz.",
            "Put the pairs (s, name) of the faces that the ray runs towards in a list, and take min(…)[1].",
        ),
        "The nearest of at most three faces: that is all of the ray casting there is.",
    ),
    "floor": Exercise(
        numbers((1.24, 1.2), ("how far to the right", "how far from the window")),
        (
            "The ray sinks by 1 m each step, and begins 1.2 m above the floor.",
            "After s = 1.2: x = 1 + 0.2 · 1.2, and 1.2 m deep.",
        ),
        "(1.24, 1.2): a point of a floor of 2 m by 3 m, as a point of a façade would be.",
    ),
    "walls": Exercise(
        numbers((2, 1), ("the wall on the right", "the wall on the left")),
        (
            "Both rays are 1 m deep when they meet a wall. Stand in the room and look at that wall: which end of it is "
            "at your left hand?",
            "At the wall on the left the window is at your left hand, on the right the far end is. Walls are 3 m long.",
        ),
        "2 m from the far end on the right, 1 m from the window on the left.",
    ),
    "parallax": Exercise(
        function(_parallax),
        (
            "Draw it from above: the eye, the glass, the thing. The line from the eye to the thing crosses the glass.",
            "Similar triangles: the shift is to the step as the depth is to distance + depth.",
        ),
        "What is far behind the glass goes along with you, what is on the glass does not. So it looks deep.",
    ),
    "deep": Exercise(
        number(4, "The wall at the back is not where the furniture is."),
        (
            "How deep is the first box? What stands at its back is a scope like any other.",
            "Rest shoots the ray into a second box behind the first one.",
        ),
        "4 m: 2 m to the furniture, and 2 m more.",
    ),
    "sofa": Exercise(
        _sofa,
        (
            "First a SplitX with a column of Abs 2.1 between two of Rel 1; then a SplitY of that column.",
            "Furniture -> SplitX(Rel, 1, Skip, Abs, 2.1, Column, Rel, 1, Skip); Column begins with Abs, 0.9, SofaTile.",
        ),
        "A sofa of cardboard, in the middle of the room. Who does not climb in will not know.",
    ),
    "rooms": Exercise(
        number(192, "Each choice is free of the others."),
        (
            "A choice for each side wall, one for the back, one for the floor, one for the ceiling.",
            "4 for the left, 4 for the right, 3, 2 and 2: multiply.",
        ),
        "4 · 4 · 3 · 2 · 2 = 192 rooms, from 11 Mat rules.",
    ),
    "geometry": Exercise(
        numbers((240, 0), ("with triangles", "by ray casting")),
        (
            "Five faces a room, two triangles a face.",
            "Casting rays, nothing is added to the mesh: see the first exercise.",
        ),
        "240 for one house. The mesh of the grammar's rooms is the wall itself.",
    ),
    "cannot": Exercise(
        among(
            "flower box", ("door in the back wall", "sofa in the room", "lamp on the ceiling", "flower box")
        ),
        (
            "A ray is asked where it meets the façade. What could it have met before?",
            "Which of the four is not behind the glass?",
        ),
        "The flower box: it is in front of the wall, and a ray that misses the wall asks no grammar.",
    ),
}
