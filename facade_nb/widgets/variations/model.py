"""Variants that are solved beside the event loop, row by row, and the design that one of them is opened as."""

from __future__ import annotations

import asyncio
import threading
import traceback
from collections import deque
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from traitlets import Bool, HasTraits, Int, Unicode

from ...design import Design, DesignError
from ...design.errors import Fault
from ...solver import Layout
from ...variations.answers import STOPPED, Answer, answers
from ...variations.sweep import table_of
from ...variations.variants import RESULTS, Variants, edited
from ..shared.turns import Turns
from ..studio.model import FacadeModel

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["VariationsModel", "told"]


class VariationsModel(Turns, HasTraits):
    """Variants, those that are solved with their layouts, and the façade that one of them is opened in.

    Parameters
    ----------
    variants
        What is solved, in order.
    facade
        The shared model of the studio; without one, one is made when a variant is first opened.
    base
        What that one begins with; by default the first variant.
    found
        What is solved already, by row.
    executor, time_limit
        As of `sweep`.

    Notes
    -----
    Solving goes on in one thread. Its outcomes are handed to the event loop that was running when it began; without one
    (a script, a test) whoever begins it waits.
    """

    running = Bool(False, help="Whether variants are being solved.")
    opened = Int(-1, help="The row whose design is that of the façade now; -1: none is.")
    trouble = Unicode("", help="An error that should not have been.")
    version = Int(0, help="Goes up once after each change.")

    def __init__(
        self,
        variants: Variants,
        facade: FacadeModel | None = None,
        *,
        base: Design | None = None,
        found: Mapping[int, Answer] | None = None,
        executor: Executor | None = None,
        time_limit: float | None = 10.0,
    ) -> None:
        super().__init__()
        self.variants = variants
        #: What became of each row that is not waiting.
        self.answers: dict[int, Answer] = dict(found or {})
        self.executor, self.time_limit = executor, time_limit
        self._facade: FacadeModel | None = None
        self._base = base
        self._news: deque[tuple[int, Answer] | str | None] = deque()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()
        if facade is not None:
            self._follow(facade)

    @property
    def facade(self) -> FacadeModel:
        """The model of the studio that variants are opened in."""
        if self._facade is None:
            first = (own for own in self.variants.designs if isinstance(own, Design))
            self._follow(FacadeModel(self._base or next(first, None)))
        assert self._facade is not None
        return self._facade

    @property
    def table(self) -> pd.DataFrame:
        """What there is so far, as `sweep` returns it."""
        found = [self.answers.get(k, Answer(error=STOPPED)) for k in range(len(self.variants))]
        return table_of(self.variants, found)

    # ---- solving -------------------------------------------------------------------------------------------------

    def run(self) -> None:
        """Solve what is not solved yet; does nothing while that is under way."""
        self._arrive()
        left = [k for k in range(len(self.variants)) if k not in self.answers]
        if self.running or not left:
            return
        try:
            self._loop = asyncio.get_running_loop()
        except RuntimeError:
            self._loop = None
        self._stop.clear()
        self.running = True
        self._thread = threading.Thread(target=self._work, args=(left,), daemon=True, name="variations")
        self._thread.start()
        self._changed()
        if self._loop is None:  # nobody will call back later
            self.wait()

    def stop(self) -> None:
        """End it: the variant under way is given up, what is solved stays. `run` goes on with the rest."""
        self._stop.set()

    def wait(self, seconds: float | None = None) -> bool:
        """Block until all is solved or stopped; returns whether that was so within `seconds`."""
        if self._thread is not None:
            self._thread.join(seconds)
        self._arrive()
        return not self.running

    def close(self) -> None:
        """Stop solving; what is solved stays."""
        self.stop()
        self.wait()

    def _work(self, rows: Sequence[int]) -> None:
        try:
            answers(
                [self.variants.designs[k] for k in rows],
                lambda k, answer: self._post((rows[k], answer)),
                executor=self.executor,
                time_limit=self.time_limit,
                should_stop=self._stop.is_set,
                at_once=True,
            )
        except Exception:  # of an executor that has failed: told where it is seen, not lost in a thread
            self._post(traceback.format_exc())
        self._post(None)

    def _post(self, news: tuple[int, Answer] | str | None) -> None:
        """Hand over to the loop (called in the worker thread)."""
        self._news.append(news)
        if self._loop is not None:
            with suppress(RuntimeError):  # the loop was closed meanwhile: the news wait for `wait`
                self._loop.call_soon_threadsafe(self._arrive)

    def _arrive(self) -> None:
        """Take over what has come."""
        fresh = False
        while self._news:
            fresh = True
            news = self._news.popleft()
            if news is None:
                self.running = False
            elif isinstance(news, str):
                self.trouble = news
            else:
                self.answers[news[0]] = news[1]
        if fresh:
            self._changed()

    # ---- opening -------------------------------------------------------------------------------------------------

    def open(self, row: int) -> None:
        """Make the design of a row that of the façade, as one step that can be undone there.

        Raises
        ------
        DesignError
            Where the row has no design, for a value that a design cannot have.
        """
        design = self.variants.designs[row]
        if isinstance(design, str):
            raise DesignError(Fault("", f"row {row + 1} has no design to open: {design}"))
        self.facade.load(design)

    def _follow(self, facade: FacadeModel) -> None:
        self._facade = facade
        facade.observe(self._look, "design")
        self._look(None)

    def _look(self, _: object) -> None:
        design = self._facade.design if self._facade is not None else None
        now = next((k for k, own in enumerate(self.variants.designs) if own == design), -1)
        if now != self.opened:
            self.opened = now
            self._changed()

    def _changed(self) -> None:
        self.version += 1


def told(table: pd.DataFrame, base: Design | None) -> tuple[Variants, dict[int, Answer]]:
    """The variants of a table that `sweep` or `solve_each` returned, or some of its rows, and what became of them.

    A row without a layout has the design of another one, or `base`, with its own values.

    Raises
    ------
    ValueError
        If it is no such table.
    """
    lacks = [name for name in ("layout", "error", "seconds") if name not in table.columns]
    if lacks:
        raise ValueError(
            f"VariationsView: expected a table that sweep or solve_each returned; it lacks the column {lacks[0]!r}"
        )
    columns = tuple(str(name) for name in table.columns if name not in RESULTS)
    rows: list[dict[str, Any]] = table.to_dict("records")
    layouts = [row["layout"] for row in rows]
    base = base or next((own.design for own in layouts if isinstance(own, Layout) and own.design), None)
    values: list[tuple[Any, ...]] = []
    designs: list[Design | str] = []
    found: dict[int, Answer] = {}
    for k, row in enumerate(rows):
        own = {name: _value(row[name]) for name in columns}
        values.append(tuple(own.values()))
        layout, error = row["layout"], str(row["error"] or "")
        if isinstance(layout, Layout):
            designs.append(layout.design or edited(base, own))
            found[k] = Answer(layout, "", float(row["seconds"]))
        else:
            designs.append(edited(base, own))
            if error != STOPPED:
                found[k] = Answer(None, error, float(row["seconds"] or 0.0))
    return Variants(columns, tuple(values), tuple(designs)), found


def _value(value: Any) -> Any:
    """A number as Python has it; what a table has for none is None."""
    if value is None or value != value:
        return None
    number = float(value)
    return int(number) if number.is_integer() else number
