"""Exercises of tutorial 1: a façade is a stack of layers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from .. import gallery
from ..design import Design, DesignError, NoLayout
from ..design.edit import add_layer, with_canvas, with_pattern, with_symbol
from ..solver import Layout, solve
from .exercises import Exercise, Open
from .judging import among, function, numbers

__all__ = ["EXERCISES", "higher_house", "house_with_lamp"]


def house_with_lamp(pattern: str, floors: list[str]) -> Design:
    """The residential house with a layer for a lamp L: its pattern across, and the floors that its mask shows."""
    lamp = with_symbol(gallery.load("residential-house"), "L", size=0.2, opaque=False)
    lamp = with_pattern(lamp, "Lx", pattern)
    return add_layer(lamp, "lamp", "Lx", {"pattern": "By", "mask": floors}, depth=4)


def higher_house(patterns: Mapping[str, str]) -> Design:
    """The residential house on a canvas that is higher by an upper floor, with other patterns."""
    house = with_canvas(gallery.load("residential-house"), height=5.9)
    for name, text in patterns.items():
        house = with_pattern(house, name, text)
    return house


def _product(shapes: Callable[..., Any]) -> str:
    for across, up, right in (
        ("AB", "P", ["A P", "B P"]),
        ("ABA", "PQ", ["A P", "B P", "A P", "A Q", "B Q", "A Q"]),
        ("", "PQ", []),
    ):
        said = shapes(across, up)
        if not isinstance(said, list):
            return f"Expected a list of texts such as 'A P', found {said!r}."
        if said != right:
            return f"For {across!r} across and {up!r} up you say {said}."
    return ""


def _drawn(answer: object) -> str:
    if not isinstance(answer, list):
        return f"Expected a list of texts such as 'C P', found {answer!r}."
    if ... in answer:
        raise Open("put texts in the place of the dots.")
    over = [own for own in answer if own != "C P"]
    if over:
        return f"{over[0]!r} is not drawn by this layer."
    return "" if answer else "Something is drawn by this layer."


def _solved(design: Callable[[], Design]) -> Layout | str:
    try:
        return solve(design())
    except (DesignError, NoLayout) as error:
        return str(error)


def _lamp(answer: object) -> str:
    if not isinstance(answer, (list, tuple)) or len(answer) != 2:
        return f"Expected a pattern and a list of floors, found {answer!r}."
    pattern, floors = answer
    if pattern is ... or floors is ... or (isinstance(floors, list) and ... in floors):
        raise Open("put a pattern and a list of floors in the place of the dots.")
    if not isinstance(pattern, str) or not isinstance(floors, list):
        return f"Expected a text and a list of texts, found {answer!r}."
    layout = _solved(lambda: house_with_lamp(pattern, floors))
    if isinstance(layout, str):
        return layout
    lamps = [own for own in layout.shapes if own.layer == "lamp" and own.x == "L"]
    if [own.y for own in lamps] != ["Q"]:
        told = ", ".join(own.y for own in lamps) or "no floor"
        return f"There should be one lamp, on Q. The lamps of your layer are on: {told}."
    left = lamps[0].rect[0]
    return "" if left > layout.canvas.width - 1 else f"The lamp stands {left:.2f} m from the left end."


def _storey(answer: object) -> str:
    if not isinstance(answer, dict):
        return f"Expected a dictionary of patterns, found {answer!r}."
    if any(own is ... for own in answer.values()):
        raise Open("put patterns in the place of the dots.")
    layout = _solved(lambda: higher_house(answer))
    if isinstance(layout, str):
        return layout
    if layout.holes:
        return "There is a hole in it now."
    floors = "".join(own.symbol for own in layout.y.row("base").letters)
    if floors[:3] != "PQQ":
        return f"The floors of the base are {floors} now, from the ground up."
    roofs = [own for own in layout.shapes if own.layer == "roof"]
    under = max(own.rect[3] for own in layout.shapes if own.layer == "base")
    if not roofs or abs(roofs[0].rect[1] - under) > 1e-3:
        return "The roof does not stand on the uppermost floor."
    return ""


EXERCISES: Mapping[str, Exercise] = {
    "behind": Exercise(
        among("a window", ("a hole", "a wall", "a window")),
        (
            "Each layer covers the whole canvas. So what does the base have there?",
            "Look at the base, farthest back: what stands in the middle of its upper floor stands below, too.",
        ),
        "The base goes on behind the door: a layer knows nothing of the others.",
    ),
    "cells": Exercise(
        numbers((14, 4), ("the number of cells", "the number of different shapes")),
        (
            "ABABABA has seven letters, PQ has two.",
            "Seven by two cells. Different shapes are the pairs of A or B with P or Q.",
        ),
        "14 cells of 4 kinds: m symbols across and n up give m·n shapes.",
    ),
    "product": Exercise(
        function(_product),
        (
            "Two loops, one in the other: the outer one goes up, for the lowest row comes first.",
            'A list of f"{x} {y}" for y in up, and in it for x in across.',
        ),
        "The outer product of two words. The solver does no more, once it knows the words and their sizes.",
    ),
    "windows": Exercise(
        numbers((2, 5, 7), ("4.3 m", "9.4 m", "12.8 m")),
        (
            "With k windows the wall is 0.5 + 1.7 k metres long: for k = 3 that is 5.6 m, on a canvas of 6 m.",
            "Take 0.5 off the width, divide by 1.7, and round to the nearest whole number.",
        ),
        "2, 5 and 7. What is left over is shared out among all sizes.",
    ),
    "masked": Exercise(
        numbers((4, 2), ("without a mask", "with the mask P")),
        (
            "The words of the layer are CeC across and PQ up. e is a placeholder: it draws nothing.",
            "Two letters C, on each floor that is shown.",
        ),
        "Four without the mask; with it, the two on the ground floor.",
    ),
    "drawn": Exercise(
        _drawn,
        (
            "What has an e in it is never drawn, and what has a Q in it is masked.",
            "One of the four is left.",
        ),
        "C P only: one shape, which stands in the façade twice.",
    ),
    "lamp": Exercise(
        _lamp,
        (
            "A placeholder before the lamp pushes it to the right. Write it as 'cec; c := C' is written: two small "
            "letters, and after a semicolon which of them is L.",
            "'xl; l := L' across. And the mask shows the upper floor only, as that of the columns shows ['P'].",
        ),
        "One lamp, at the right, on the upper floor. No other layer had to be touched.",
    ),
    "depth": Exercise(
        among("no", ("yes", "no")),
        (
            "Which of the layers is the one farthest back then?",
            "The base would stand in front of it, and has no gap on the upper floor.",
        ),
        "Behind the base, which is wall or window everywhere, there is nothing to be seen.",
    ),
    "storey": Exercise(
        _storey,
        (
            "By is PQ, Ry is PQR. The new floor is like Q, and stands between Q and the roof.",
            "PQQ, and PQQR.",
        ),
        "One letter in each pattern: and walls, windows, columns, door and roof are where they belong.",
    ),
}
