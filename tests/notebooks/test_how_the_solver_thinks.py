"""The tutorial is true: what it says of its house holds, and its exercises can be solved, each in more than one way."""

from __future__ import annotations

import contextlib
import io
from pathlib import Path
from typing import Any

import nbformat
import pytest

from facade_nb.solver import Letter, Objective, align

PATH = Path(__file__).resolve().parents[2] / "tutorials" / "how-the-solver-thinks.ipynb"
CELLS = {cell.id: cell.source for cell in nbformat.read(PATH, as_version=4).cells}

EQ7, EQ9, MIRROR = "think-04", "think-11", "think-18"


@pytest.fixture(scope="module")
def names() -> dict[str, Any]:
    """What the first cell of code defines."""
    found: dict[str, Any] = {}
    exec(CELLS["think-01"], found)
    return found


def exercise(names: dict[str, Any], cell: str, given: str, instead: str) -> str:
    """What an exercise prints when a line of it is replaced."""
    assert CELLS[cell].count(given) == 1
    told = io.StringIO()
    with contextlib.redirect_stdout(told):
        exec(CELLS[cell].replace(given, instead), dict(names))
    return told.getvalue()


LEFT_OUT = "    return canvas - mu\n"


@pytest.mark.parametrize(
    ("code", "right"),
    [
        ("    return canvas - mu - sum(opaque_in_front)\n", True),
        (LEFT_OUT, False),
        ("    return canvas - sum(opaque_in_front)\n", False),
    ],
)
def test_the_exercise_of_eq_7(names: dict[str, Any], code: str, right: bool) -> None:
    assert ("✓" in exercise(names, EQ7, LEFT_OUT, code)) is right


@pytest.mark.parametrize(
    ("code", "right"),
    [
        ("sizes = [sum(own) for own in column if own]; return max(sizes) - min(sizes)", True),
        ("return 0.0", False),
        ("sizes = [sum(own) for own in column]; return max(sizes) - min(sizes)", False),  # ε has no size
        ("return max(max(own, default=0) for own in column) - 0.6", False),  # not the sum of an element
    ],
)
def test_the_exercise_of_eq_9(names: dict[str, Any], code: str, right: bool) -> None:
    told = exercise(names, EQ9, "return 0.0", code).splitlines()
    assert len(told) == 4
    assert all(line.startswith("✓") for line in told) is right


@pytest.mark.parametrize(
    ("pattern", "right"),
    [
        ("(AB)^|k", True),
        ("(ABA)^|k", True),
        ("m a m'; m := (AB)^k; a := A", True),
        ("A(BA)^|k", False),
        ("A(BA)^k", False),  # reads the same from both ends, but nothing is mirrored
        ("(AB)^@k", False),
        ("(BA)^|k", False),  # windows at the ends
    ],
)
def test_the_exercise_of_the_mirrored_row(names: dict[str, Any], pattern: str, right: bool) -> None:
    assert ("✓" in exercise(names, MIRROR, '"A(BA)^|k"', repr(pattern))) is right


def test_what_is_said_of_words(names: dict[str, Any]) -> None:
    words = names["solved"].trace.words()
    walls = words[words.pattern == "walls"]
    at_one = walls.low + walls.tolerance - 1.0
    assert at_one.to_list() == pytest.approx([4.4] * len(walls))
    fit = walls[(walls["size"] >= at_one) & (walls["size"] <= 7.6)]
    assert fit["counter.k"].to_list() == [2, 3]
    assert fit["size"].to_list() == pytest.approx([5.1, 7.2])
    mirrored = names["watch"](names["house"](walls="A(BA)^|k")).trace.words()
    sizes = mirrored[mirrored.pattern == "walls"].set_index("word")["size"]
    assert [word for word, size in sizes.items() if 4.4 <= size <= 7.6] == ["A B A A' B'"]
    assert 9.3 in sizes.round(6).to_list()


def test_what_is_said_of_pattern_analysis(names: dict[str, Any]) -> None:
    watch, house = names["watch"], names["house"]
    exec(CELLS["think-06"], found := dict(names))
    assert found["awnings"].trace.analysis().equation.to_list() == ["j + 2 = k"]
    red = {"walls": "A(BABA)^k", "front": "A(BA)(BABA)^j"}
    given = ", ".join(f'{name}="{text}"' for name, text in red.items())
    assert f"`house({given})`" in CELLS["think-05"]
    [told] = watch(house(**red)).trace.analysis().inconsistent
    assert "with gaps" in told


def test_what_is_said_of_candidates(names: dict[str, Any]) -> None:
    solved = names["solved"]
    told = solved.trace.candidates()
    told = told[told.axis == "x"]
    assert len(told) == 4
    assert told[told.fate == "best"]["counter.k"].to_list() == [2]
    assert solved.x.cost == pytest.approx(0.25 * 0.3 + 0.8 * 0.5 * 1.2) == pytest.approx(0.555)
    posts = [Letter("C", 0.6), Letter("e", None, transparent=True), Letter("C", 0.6)]
    wall = [Letter(name, 0.9 if name == "A" else 1.2, unoccludable=name == "B") for name in "ABABABA"]
    other = align([posts, wall], canvas=6.6, tolerance=3.3, objective=Objective())
    assert other is not None
    assert other.cost == pytest.approx(0.75)


def test_what_is_said_of_slender_posts(names: dict[str, Any]) -> None:
    exec(CELLS["think-13"], found := dict(names))
    slender = found["slender"]
    assert slender.counters == {"k": 3}
    path = slender.trace.path()
    path = path[path.axis == "x"]
    assert path[path.column == 0].element.to_list() == ["C", "A"]
    assert set(path.omega) == {0.0}


def test_what_is_said_of_sizes(names: dict[str, Any]) -> None:
    sizes = names["solved"].x.sizes
    grown = {"A": 0.3 * 3 / 17, "B": 0.3 * 2 / 17, "C": 0.3 * 2 / 17}
    assert {name: sizes[name] for name in grown} == pytest.approx(
        {"A": 0.9 + grown["A"], "B": 1.2 + grown["B"], "C": 0.6 + grown["C"]}
    )
    for number in ("0.053", "0.035"):
        assert number in CELLS["think-14"]


def test_every_question_comes_before_its_answer() -> None:
    """What explains an answer is folded away, and no view but the façade at the end begins with its answer."""
    for name, source in CELLS.items():
        if source.startswith("## ") and name != "think-00":
            question, folded = source.split("<details>")
            assert "?**" in question or "fit now**" in question, name
            assert folded.rstrip().endswith("</details>")
        for line in source.splitlines():
            if "View(" in line and "import" not in line:
                assert "predict=True" in line or line.startswith("FacadeView("), line
