"""A table of layouts: a design solved for every combination of given values."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from functools import partial
from itertools import product
from typing import TYPE_CHECKING, Any, Literal

from ..design.edit import with_canvas, with_counter, with_symbol
from ..design.errors import DesignError, NoLayout, listed, nearest, quoted
from ..design.model import AXES, Design
from ..solver import Layout, solve

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["RESULTS", "STOPPED", "Names", "known_names", "sweep"]

STOPPED = "Stopped before its turn."
"""What `error` says of a variant that was not solved because the sweep was stopped."""

RESULTS = (
    *(f"{axis}_{field}" for axis in AXES for field in ("cost", "deviation", "proven")),
    "shapes",
    "windows",
    "seconds",
    "error",
    "layout",
)
"""Columns of the table after those of the values."""

Value = float | int
Progress = bool | Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class _Parameter:
    """A column of the table: what is changed, and to which values."""

    column: str
    values: tuple[Value, ...]
    edit: Callable[[Design, Value], Design]


@dataclass(frozen=True, slots=True)
class _Answer:
    """What became of one variant."""

    layout: Layout | None = None
    error: str = ""
    seconds: float = 0.0


@dataclass(frozen=True, slots=True)
class Names:
    """The counters and symbols that a design has, declared or in its patterns."""

    counters: frozenset[str]
    sizes: frozenset[str]

    def check(self, caller: str, where: Literal["counters", "sizes"], name: str) -> None:
        """Raise ValueError for a name that there is not, with the nearest that there is."""
        known = sorted(self.counters if where == "counters" else self.sizes)
        if name not in known:
            what = "counter" if where == "counters" else "symbol"
            hint = nearest(name, known) or f"; it has {listed(known) or 'none'}"
            raise ValueError(
                f"{caller}: {where}: expected a {what} of the design, found {quoted(name)}{hint}"
            )


def known_names(design: Design) -> Names:
    """The names of a design that a value can be given to."""
    patterns = [pattern.parsed for pattern in design.patterns.values()]
    return Names(
        frozenset((*design.counters, *(name for pattern in patterns for name in pattern.counters))),
        frozenset((*design.symbols, *(name for pattern in patterns for name in pattern.symbols))),
    )


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
        For a counter or symbol that the design does not have, for no values, or for two columns of one name. It names
        the nearest valid name. A value that is out of range is told in its row's `error`.
    """
    parameters = _parameters(design, width, height, counters or {}, sizes or {})
    combinations = list(product(*(parameter.values for parameter in parameters)))
    report = _reporter(progress, len(combinations))
    answers = _answers(
        [_variant(design, parameters, values) for values in combinations],
        executor,
        time_limit,
        report,
        should_stop or (lambda: False),
    )
    return _table(parameters, combinations, answers)


def _parameters(
    design: Design,
    width: Sequence[float] | None,
    height: Sequence[float] | None,
    counters: Mapping[str, Sequence[int]],
    sizes: Mapping[str, Sequence[float]],
) -> list[_Parameter]:
    found: list[_Parameter] = []
    if width is not None:
        found.append(
            _Parameter("width", tuple(width), lambda design, value: with_canvas(design, width=value))
        )
    if height is not None:
        found.append(
            _Parameter("height", tuple(height), lambda design, value: with_canvas(design, height=value))
        )
    names = known_names(design)
    for name, counts in counters.items():
        names.check("sweep", "counters", name)
        found.append(_Parameter(name, tuple(counts), partial(_counter, name)))
    for name, lengths in sizes.items():
        names.check("sweep", "sizes", name)
        found.append(_Parameter(name, tuple(lengths), partial(_size, name)))
    seen = set(RESULTS)
    for parameter in found:
        if not parameter.values:
            raise ValueError(f"sweep: {parameter.column}: expected at least one value, found none")
        if parameter.column in seen:
            raise ValueError(
                f"sweep: two columns of the table would be called {quoted(parameter.column)}; rename the counter or "
                f"symbol (facade_nb.design.edit.rename_symbol)"
            )
        seen.add(parameter.column)
    return found


def _counter(name: str, design: Design, value: Value) -> Design:
    return with_counter(design, name, value=value)


def _size(name: str, design: Design, value: Value) -> Design:
    return with_symbol(design, name, size=value)


def _variant(design: Design, parameters: Sequence[_Parameter], values: Sequence[Value]) -> Design | str:
    """The design with these values, or why there is none."""
    try:
        for parameter, value in zip(parameters, values, strict=True):
            design = parameter.edit(design, value)
    except DesignError as error:
        return str(error)
    return design


def _solve(variant: Design | str, time_limit: float | None) -> _Answer:
    """Run where the executor says: everything is handed over, nothing is kept."""
    if isinstance(variant, str):
        return _Answer(error=variant)
    begin = time.perf_counter()
    try:
        layout, error = solve(variant, time_limit=time_limit), ""
    except (DesignError, NoLayout) as fault:
        layout, error = None, str(fault)
    return _Answer(layout, error, time.perf_counter() - begin)


def _answers(
    variants: Sequence[Design | str],
    executor: Executor | None,
    time_limit: float | None,
    report: Callable[[int], None],
    should_stop: Callable[[], bool],
) -> list[_Answer]:
    """An answer for each variant, in order, however they are solved."""
    answers = [_Answer(error=STOPPED)] * len(variants)
    futures: list[Future[_Answer]] = []
    try:
        report(0)
        if executor is None:
            for k, variant in enumerate(variants):
                if should_stop():
                    break
                answers[k] = _solve(variant, time_limit)
                report(k + 1)
        else:
            futures = [executor.submit(_solve, variant, time_limit) for variant in variants]
            for k, future in enumerate(futures):
                if should_stop():
                    break
                answers[k] = future.result()
                report(k + 1)
    except KeyboardInterrupt:
        pass
    finally:
        for future in futures:
            future.cancel()
    for k, future in enumerate(futures):  # solved meanwhile, out of turn
        if (
            answers[k].error == STOPPED
            and future.done()
            and not future.cancelled()
            and not future.exception()
        ):
            answers[k] = future.result()
    return answers


def _reporter(progress: Progress, total: int) -> Callable[[int], None]:
    if callable(progress):
        return lambda done: progress(done, total)
    if not progress:
        return lambda done: None

    def tell(done: int) -> None:
        end = "\n" if done == total else ""
        print(f"\rsweep: {done} of {total}", end=end, file=sys.stderr, flush=True)

    return tell


def _table(
    parameters: Sequence[_Parameter], combinations: Sequence[tuple[Value, ...]], answers: Sequence[_Answer]
) -> pd.DataFrame:
    import pandas as pd

    rows = [
        {**dict(zip((p.column for p in parameters), values, strict=True)), **_results(answer)}
        for values, answer in zip(combinations, answers, strict=True)
    ]
    return pd.DataFrame(rows, columns=[*(p.column for p in parameters), *RESULTS])


def _results(answer: _Answer) -> dict[str, Any]:
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
