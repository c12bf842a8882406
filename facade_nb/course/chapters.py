"""The chapters that have exercises, by the names of their files."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from .exercises import Chapter

__all__ = ["CHAPTERS"]


def _patterns() -> Chapter:
    from .patterns import EXERCISES

    return Chapter("02-patterns-and-words", EXERCISES)


def _columns() -> Chapter:
    from .columns import EXERCISES

    return Chapter("05-columns-and-constraints", EXERCISES)


def _shortest_path() -> Chapter:
    from .shortest_path import EXERCISES

    return Chapter("06-a-shortest-path", EXERCISES)


def _deepening() -> Chapter:
    from .deepening import EXERCISES

    return Chapter("07-iterative-deepening", EXERCISES)


def _candidates() -> Chapter:
    from .candidates import EXERCISES

    return Chapter("08-candidates-and-proof", EXERCISES)


def _sizes() -> Chapter:
    from .sizes import EXERCISES

    return Chapter("09-sizes", EXERCISES)


def _own_code() -> Chapter:
    from .own_code import EXERCISES

    return Chapter("13-change-the-solver", EXERCISES)


CHAPTERS: Mapping[str, Callable[[], Chapter]] = {
    "02-patterns-and-words": _patterns,
    "05-columns-and-constraints": _columns,
    "06-a-shortest-path": _shortest_path,
    "07-iterative-deepening": _deepening,
    "08-candidates-and-proof": _candidates,
    "09-sizes": _sizes,
    "13-change-the-solver": _own_code,
}
