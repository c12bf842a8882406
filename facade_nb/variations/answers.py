"""Variants solved one by one, wherever: an answer for each."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from typing import Any

from ..design.errors import DesignError, NoLayout
from ..design.model import AXES, Design
from ..solver import Layout, solve
from .variants import RESULTS

__all__ = ["STOPPED", "Answer", "answers", "results"]

STOPPED = "Stopped before its turn."
"""What `error` says of a variant that was not solved because the sweep was stopped."""


@dataclass(frozen=True, slots=True)
class Answer:
    """What became of one variant: its layout, or the error why there is none; and the seconds that it took."""

    layout: Layout | None = None
    error: str = ""
    seconds: float = 0.0


def answers(
    variants: Sequence[Design | str],
    told: Callable[[int, Answer], None],
    *,
    executor: Executor | None = None,
    time_limit: float | None = 10.0,
    should_stop: Callable[[], bool] = lambda: False,
    at_once: bool = False,
) -> None:
    """Solve variants in order, and tell of each which it is and what became of it.

    Parameters
    ----------
    variants
        Designs, or why there is none.
    told
        Called for each variant that was solved, and for none twice.
    executor, time_limit
        As of `sweep`.
    should_stop
        Asked after each variant. If it returns true, no more are begun.
    at_once
        Whether the variant under way ends with it, too, where it is solved here or in a thread.

    An interrupt ends it as `should_stop` does.
    """
    futures: list[Future[Answer]] = []
    heard: set[int] = set()
    stopping = should_stop if at_once else None

    def tell(k: int, answer: Answer) -> None:
        heard.add(k)
        if answer.error != STOPPED:
            told(k, answer)

    try:
        if executor is None:
            for k, variant in enumerate(variants):
                if should_stop():
                    break
                tell(k, _solve(variant, time_limit, stopping))
        else:
            futures = [executor.submit(_solve, variant, time_limit) for variant in variants]
            for k, future in enumerate(futures):
                if should_stop():
                    break
                tell(k, future.result())
    except KeyboardInterrupt:
        pass
    finally:
        for future in futures:
            future.cancel()
    for k, future in enumerate(futures):  # solved meanwhile, out of turn
        if k not in heard and future.done() and not future.cancelled() and not future.exception():
            tell(k, future.result())


def _solve(
    variant: Design | str, time_limit: float | None, should_stop: Callable[[], bool] | None = None
) -> Answer:
    """Run where the executor says: everything is handed over, nothing is kept."""
    if isinstance(variant, str):
        return Answer(error=variant)
    begin = time.perf_counter()
    try:
        layout, error = solve(variant, time_limit=time_limit, should_stop=should_stop), ""
    except (DesignError, NoLayout) as fault:
        layout, error = None, str(fault)
    if should_stop is not None and should_stop() and (layout is None or not layout.complete):
        return Answer(error=STOPPED)
    return Answer(layout, error, time.perf_counter() - begin)


def results(answer: Answer) -> dict[str, Any]:
    """The columns of the table after those of the values, `RESULTS`."""
    layout = answer.layout
    found: dict[str, Any] = dict.fromkeys(RESULTS)
    if layout is not None:
        for axis in AXES:
            solved = layout.along(axis)
            found |= {
                f"{axis}_cost": solved.cost,
                f"{axis}_deviation": solved.deviation,
                f"{axis}_proven": solved.proven,
            }
    shapes = layout.shapes if layout else ()
    return found | {
        "shapes": len(shapes),
        "windows": sum(shape.kind == "window" for shape in shapes),
        "seconds": answer.seconds,
        "error": answer.error,
        "layout": layout,
    }
