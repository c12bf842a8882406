"""Exercises of tutorial 4: what goes wrong without an alignment, and without qualifiers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..design import Design, NoLayout
from ..solver import solve
from .exercises import Exercise, Open
from .flattened import porch
from .judging import Judge, among, function, number

__all__ = ["EXERCISES"]

_KINDS = ("misalignment", "placement", "sizing", "occlusion", "hole", "beyond")
_MARKS = ("opaque", "not opaque", "unoccludable", "attached")
_PLACES = ("before A", "before B", "before D", "between A and D", "between D and B")


def _each(right: Sequence[str], choices: Sequence[str], first: int = 1) -> Judge:
    """Several words, each one of some; they are numbered from `first`, as in the picture or the text."""

    def judge(answer: object) -> str:
        if not isinstance(answer, (list, tuple)) or len(answer) != len(right):
            return f"Expected a list of {len(right)} texts, found {answer!r}."
        if ... in answer:
            raise Open("put texts in the place of the dots.")
        for given in answer:
            if given not in choices:
                return f"Expected some of {', '.join(map(repr, choices))}; found {given!r}."
        off = [str(n) for n, (a, b) in enumerate(zip(answer, right, strict=True), first) if a != b]
        return f"Look again at {', '.join(off)}." if off else ""

    return judge


def _starts(starts: Callable[..., Any]) -> str:
    for sizes, right in (([0.5, 1.25, 0.5], [0.0, 0.5, 1.75]), ([0.9], [0.0]), ([], [])):
        said = starts(list(sizes))
        try:
            near = len(said) == len(right) and all(
                abs(a - b) < 1e-6 for a, b in zip(said, right, strict=True)
            )
        except TypeError:
            near = False
        if not near:
            return f"For the sizes {sizes} you say {said!r}."
    return ""


def _common(common: Callable[..., Any]) -> str:
    for a, b, right in (
        ((1.75, 2.25), (0.9, 2.1), 0.35),
        ((0.9, 2.1), (1.75, 2.25), 0.35),
        ((3.5, 4.0), (3.0, 4.2), 0.5),
        ((0.0, 0.5), (0.9, 2.1), 0.0),
        ((0.0, 0.5), (0.5, 2.1), 0.0),
    ):
        said = common(a, b)
        if not isinstance(said, (int, float)) or abs(said - right) > 1e-6:
            return f"Of {a} and {b} you say {said!r}."
    return ""


def _free(answer: object) -> str:
    """Whether no post stands before a window; hinted at by what one does."""
    if not isinstance(answer, Design):
        return f"Expected a design that porch(…) makes, found {answer!r}."
    if answer == porch():
        raise Open("that is the porch as it was. Mark a symbol.")
    try:
        layout = solve(answer)
    except NoLayout as error:
        return str(error)
    row, wall = layout.x.row("front").letters, layout.x.row("wall").letters
    posts = [own for own in row if own.symbol == "C"]
    if [own.symbol for own in wall] != list("BABAB"):
        return "The porch has to keep its three windows."
    for post in posts:
        for own in wall:
            if own.symbol == "B" and min(post.end, own.end) - max(post.start, own.start) > 1e-3:
                return f"A post still stands before the window at {own.start:.2f} to {own.end:.2f} m."
    return "There is a hole in the façade now." if layout.holes else ""


EXERCISES: Mapping[str, Exercise] = {
    "kinds": Exercise(
        _each(("misalignment", "occlusion", "placement", "hole"), _KINDS),
        (
            "What should meet and does not? What is covered? What stands now so, now so? Where is nothing?",
            "4 is the hole. 2 marks only the part of a window that is behind a column.",
        ),
        "These are four of the six kinds. Such a picture is made of any layout by flattened(…).",
    ),
    "starts": Exercise(
        function(_starts),
        (
            "The first begins at 0, each other one where the one before it ends.",
            "at = 0; for size in sizes: note at, then at = at + size.",
        ),
        "Side by side: that is all that flattening does.",
    ),
    "third": Exercise(
        number(3.5, "Two columns and two placeholders stand before it."),
        (
            "Before the third C of CeCeCeC stand C, e, C and e.",
            "0.5 + 1.25 + 0.5 + 1.25.",
        ),
        "3.50 m, before the second window, which takes 3.00 to 4.20 m.",
    ),
    "common": Exercise(
        function(_common),
        (
            "What two spans share begins at the greater of the two starts and ends at the lesser of the two ends.",
            "max(0, min(a[1], b[1]) − max(a[0], b[0])).",
        ),
        "Now you can find what is covered.",
    ),
    "other kinds": Exercise(
        _each(("sizing", "beyond"), _KINDS, first=4),
        (
            "4: the same symbol is 0.90 m wide at the left end of the façade. 5: where does the canvas end?",
            "One is about sizes that are not the same. The other is outside of the façade.",
        ),
        "The word of the wall is 7.2 m long, and the canvas has 7.0 m.",
    ),
    "a": Exercise(
        among("before D", _PLACES),
        (
            "P is 0.2 m and not opaque, so something must stand behind it. What is loose beside it costs.",
            "It is cheapest before what is nearest to it in size.",
        ),
        "D, 0.3 m wide, is nearest to P.",
    ),
    "b": Exercise(
        among("before B", _PLACES),
        (
            "D is ruled out now, and behind a P that is not opaque something must stand: A or B.",
            "The next best in size: A is 1.4 m, B is 1 m.",
        ),
        "B, the next best: a post in the middle of a door. Rules are kept to the letter.",
    ),
    "c": Exercise(
        among("between D and B", _PLACES),
        (
            "An opaque post may have a place to itself. From where to where is b just as long as it likes to be?",
            "From post to post b takes BDADB: 1 + 0.3 + 1.4 + 0.3 + 1 = 4 m.",
        ),
        "Between frame and door: a fit without an error, and an absurd door.",
    ),
    "d": Exercise(
        among("between A and D", _PLACES),
        (
            "Nothing may come between B and what is beside it. Which boundaries are left?",
            "The one on the other side of the frame D.",
        ),
        "Outside of the frame: each door keeps both of its frames.",
    ),
    "wishes": Exercise(
        _each(("unoccludable", "attached", "not opaque", "opaque"), _MARKS),
        (
            "Never covered; never torn apart; never without something behind it; allowed to stand alone.",
            "A statue does not fill its cell, so it is not opaque. A quoin does.",
        ),
        "A designer says what a thing is. What may stand where follows from that.",
    ),
    "free": Exercise(
        _free,
        (
            "Say of the windows that nothing may cover them, or of the posts that they need nothing behind them.",
            'porch(unoccludable="B").',
        ),
        "All three windows are free. (There are two ways: posts before the walls, or opaque ones at both ends.)",
    ),
    "masked": Exercise(
        among("upstairs", ("nowhere", "on the ground floor", "upstairs")),
        (
            "An opaque column has a place to itself; the wall begins beside it, on both floors alike.",
            "On the ground floor the column fills the place. What fills it where the column is masked?",
        ),
        "Upstairs: the wall makes way on both floors, and on one of them the mask hides the column.",
    ),
}
