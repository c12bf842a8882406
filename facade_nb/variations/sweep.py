"""A table of layouts: a design solved for every combination of given values, or designs as they are."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from typing import TYPE_CHECKING

from ..design.model import Design
from .answers import STOPPED, Answer, answers, results
from .variants import RESULTS, Variants

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["solve_each", "sweep", "table_of"]

Progress = bool | Callable[[int, int], None]


def sweep(
    design: Design,
    *,
    width: Sequence[float] | None = None,
    height: Sequence[float] | None = None,
    counters: Mapping[str, Sequence[int]] | None = None,
    sizes: Mapping[str, Sequence[float]] | None = None,
    executor: Executor | None = None,
    time_limit: float | None = 10.0,
    progress: Progress = True,
    should_stop: Callable[[], bool] | None = None,
) -> pd.DataFrame:
    """Solve a design for every combination of the values given.

    Parameters
    ----------
    design
        The design; it stays as it is.
    width, height
        Extents of the canvas, metres.
    counters
        For names of counters the values that they are fixed to.
    sizes
        For names of symbols their preferred sizes, metres.
    executor
        Where the variants are solved: any `concurrent.futures.Executor`, or what `get_executor()` of a Dask client
        gives. None: here, one after the other. The rows do not depend on it, but for `seconds`.
    time_limit
        Seconds for each variant, or None for no limit.
    progress
        True: a line on the error stream counts the variants that are done. Or a function that is called with how many
        are done and how many there are.
    should_stop
        A function that is asked after each variant. If it returns true, no more are begun.

    Returns
    -------
    pandas.DataFrame
        A row for each variant, in the order of the product: width, height, counters, sizes, the last fastest. Its
        columns are the values (`width`, `height`, and names of counters and symbols), those of them that were given;
        `x_cost`, `x_deviation`, `x_proven`, the same for y (None where there is no layout); `shapes`, `windows`: how
        many there are; `seconds`; `error`: why there is no layout, else empty; `layout`.

        An interrupt (the stop button, Ctrl+C) ends the sweep as `should_stop` does: what is solved is returned, and
        `error` of the other rows says that they were stopped.

    Raises
    ------
    ValueError
        For a counter or symbol that the design does not have, for what is no list of values or an empty one, or for
        two columns of one name. It names the nearest valid name. A value that is out of range is told in its row's
        `error`.
    """
    variants = Variants.of_product(design, width=width, height=height, counters=counters, sizes=sizes)
    return _solved(variants, executor, time_limit, progress, should_stop)


def solve_each(
    designs: Iterable[Design],
    *,
    executor: Executor | None = None,
    time_limit: float | None = 10.0,
    progress: Progress = True,
    should_stop: Callable[[], bool] | None = None,
) -> pd.DataFrame:
    """Solve designs, such as `vary` makes, into a table as that of `sweep`.

    Parameters
    ----------
    designs
        The designs: a row for each, in their order.
    executor, time_limit, progress, should_stop
        As of `sweep`.

    Returns
    -------
    pandas.DataFrame
        Its first columns are the values in which the designs differ: `seed`, `width`, `height`, and names of counters
        (what they are fixed to) and symbols (preferred sizes). The others are those of `sweep`.
    """
    return _solved(Variants.of_designs(designs), executor, time_limit, progress, should_stop)


def _solved(
    variants: Variants,
    executor: Executor | None,
    time_limit: float | None,
    progress: Progress,
    should_stop: Callable[[], bool] | None,
) -> pd.DataFrame:
    if executor is not None and not callable(getattr(executor, "submit", None)):
        hint = "; pass its get_executor()" if hasattr(executor, "get_executor") else ""
        raise ValueError(f"sweep: executor: expected an executor with submit, found {executor!r:.80}{hint}")
    report = _reporter(progress, len(variants))
    found = [Answer(error=STOPPED)] * len(variants)
    done = 0

    def told(k: int, answer: Answer) -> None:
        nonlocal done
        done += 1
        found[k] = answer
        report(done)

    report(0)
    answers(
        variants.designs,
        told,
        executor=executor,
        time_limit=time_limit,
        should_stop=should_stop or (lambda: False),
    )
    return table_of(variants, found)


def _reporter(progress: Progress, total: int) -> Callable[[int], None]:
    if callable(progress):
        return lambda done: progress(done, total)
    if not progress:
        return lambda done: None

    def tell(done: int) -> None:
        end = "\n" if done == total else ""
        print(f"\rsweep: {done} of {total}", end=end, file=sys.stderr, flush=True)

    return tell


def table_of(variants: Variants, found: Sequence[Answer]) -> pd.DataFrame:
    """The table of variants and what became of them."""
    import pandas as pd

    rows = [
        {**dict(zip(variants.columns, values, strict=True)), **results(answer)}
        for values, answer in zip(variants.values, found, strict=True)
    ]
    return pd.DataFrame(rows, columns=[*variants.columns, *RESULTS])
