"""Exercises: an answer is judged; a wrong one gets a hint, the next another, and then there is the solution."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from importlib import resources

from ..solver.experiments import ExperimentError

__all__ = ["Chapter", "Exercise", "Open", "solution_of"]


class Open(Exception):
    """There is no answer yet: that is no wrong one, and costs no hint."""


@dataclass(frozen=True)
class Exercise:
    """One exercise.

    Attributes
    ----------
    judge
        Of an answer: what is wrong with it, in a sentence; empty where it is right.
    hints
        The first is given for the first wrong answer, and so on.
    why
        What is said of a right one.
    """

    judge: Callable[[object], str]
    hints: Sequence[str]
    why: str


class Chapter:
    """The exercises of a tutorial; called with the name of one and an answer, it says what it thinks of it.

    Parameters
    ----------
    name
        Of the tutorial's file; its solutions have the same.
    """

    def __init__(self, name: str, exercises: Mapping[str, Exercise]) -> None:
        self.name, self.exercises = name, exercises
        self._wrong: dict[str, int] = {}
        self._right: set[str] = set()

    def __call__(self, name: str, answer: object) -> None:
        """Judge an answer, and print what there is to say."""
        exercise = self._of(name)
        if answer is ... or answer is None:
            _say("Not yet: put your answer in the place of the dots.")
            return
        try:
            fault = exercise.judge(answer)
        except Open as nothing:
            _say(f"Not yet: {nothing}")
            return
        except ExperimentError as error:
            fault = str(error)
        except Exception as error:  # a student's function may raise anything
            at = f"line {line}: " if (line := _line(answer, error)) else ""
            fault = f"{at}{type(error).__name__}: {error}"
        if not fault:
            self._right.add(name)
            _say(f"✓ {exercise.why}")
            return
        tries = self._wrong[name] = self._wrong.get(name, 0) + 1
        _say(f"Not yet. {fault}")
        if tries <= len(exercise.hints):
            _say(f"Hint {tries} of {len(exercise.hints)}: {exercise.hints[tries - 1]}")
        else:
            _say(f"No hints are left: check.solution({name!r}) shows one that works.")

    def after(self, name: str) -> bool:
        """Whether an exercise has been solved: what would give it away waits for that, and says so."""
        self._of(name)
        if name not in self._right:
            _say(f"This cell waits for the exercise {name!r}. Solve that, then run this again.")
        return name in self._right

    def solution(self, name: str) -> None:
        """Show a solution, once it has been tried."""
        exercise = self._of(name)
        if self._wrong.get(name, 0) < len(exercise.hints):
            _say("Try it first: there are hints.")
            return
        _say(solution_of(self.name, name))

    def _of(self, name: str) -> Exercise:
        if name not in self.exercises:
            near = get_close_matches(name, self.exercises, 1)
            hint = f"; did you mean {near[0]!r}?" if near else f": {', '.join(self.exercises)}"
            raise ValueError(f"{self.name} has no exercise {name!r}{hint}")
        return self.exercises[name]


def solution_of(chapter: str, name: str) -> str:
    """The code of a solution: what stands under its name in the chapter's page of solutions."""
    page = resources.files(__package__).joinpath("solutions", f"{chapter}.md").read_text("utf-8")
    found = re.search(rf"^## {re.escape(name)}\n.*?^```python\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    if found is None:
        raise LookupError(f"solutions/{chapter}.md: no code under {name!r}")
    return found.group(1).rstrip("\n")


def _say(text: str) -> None:
    sys.stdout.write(
        f"{text}\n"
    )  # at once, so that a notebook does not make two outputs of a line and its end


def _line(answer: object, error: BaseException) -> int:
    """The line of the answer's own cell in which it failed; 0 where that is not known."""
    code = getattr(answer, "__code__", None)
    line, at = 0, error.__traceback__
    while at is not None:
        if code is not None and at.tb_frame.f_code.co_filename == code.co_filename:
            line = at.tb_lineno
        at = at.tb_next
    return line
