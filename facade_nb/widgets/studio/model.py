"""The shared observable design that every widget shows and edits."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

from traitlets import Any as AnyTrait
from traitlets import Bool, Float, Instance, Int, Unicode

from ...design import Design, DesignError, FacadeError, Fault, NoLayout
from ...solver import Layout, Trace, solve
from ...solver.resized import resized
from ..shared.history import History, Undoable
from ..shared.turns import by_turns
from . import newcomers
from .background import FIRST, QUICK, Known, LatestSolver, Outcome, Solve
from .fields import Path
from .handles import Linkable
from .newcomers import Newcomers

if TYPE_CHECKING:
    from .whole import Whole

__all__ = ["Draft", "FacadeModel", "Selection"]

_SOLVE = solve


@dataclass(frozen=True, slots=True)
class Draft:
    """What was typed into a field and is not (yet) part of the design, with its faults."""

    value: Any
    faults: tuple[Fault, ...]


@dataclass(frozen=True, slots=True)
class Selection:
    """What is picked: a shape of the layout, and the layer and the two symbols it leads to.

    A layer, a symbol or a pair of symbols can be picked without a shape. Empty fields pick nothing. `number` tells
    which instances of the two symbols are picked; None: no shape was. `more` has further pairs of the same layer.
    """

    shape: int | None = None
    layer: str = ""
    x: str = ""
    y: str = ""
    number: tuple[int, int] | None = None
    more: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class _Snapshot:
    """What undo brings back."""

    design: Design
    drafts: Mapping[Path, Draft] = field(default_factory=dict)
    newcomers: Newcomers = field(default_factory=Newcomers)


class FacadeModel(Undoable[_Snapshot], Linkable):
    """A design that is being edited, with its last good layout and the messages about both.

    Parameters
    ----------
    design
        A `Design`, its JSON text or a path to it; without one, an empty canvas. Raises `DesignError` if it is at fault.
    time_limit
        Seconds after which a solve ends with the best layout found so far.
    solve
        The function that solves; `facade_nb.solve` by default.
    first
        Seconds after which a search that takes longer is shown as it stands, while it goes on; None: never.
    quick
        Seconds of the processor: where one of the last two searches took longer, an edited design is shown at once with
        the structure that it had, while it is searched.
    known
        What tells that: by default `facade_nb.solver.resized.resized`, and nothing beside another `solve`.

    Notes
    -----
    Edits from several threads come one after the other, each made from what the one before has left: while a cell
    runs, JupyterLab answers the views in a thread of its own.
    `width`, `height`, `sizes` and `counters` are traits to `link` and `interact` with (`Linkable`).
    """

    design: Design = Instance(Design)
    layout: Layout | None = Instance(Layout, allow_none=True)
    stale: bool = Bool(
        False, help="Whether `layout` is that of an earlier design, or of one without the drafts."
    )
    message: str = Unicode("", help="Why the present design has no layout.")
    blame: NoLayout | None = Instance(NoLayout, allow_none=True, help="What is to blame for that.")
    drafts: Mapping[Path, Draft] = AnyTrait({}, help="Typed values that are not part of the design, by path.")
    newcomers: Newcomers = Instance(
        Newcomers, (), help="What came by itself as patterns were typed, and was not touched since."
    )
    trace: Trace | None = Instance(
        Trace, allow_none=True, help="What the last solve did, also one without a layout; see `follow`."
    )
    busy: bool = Bool(False, help="Whether a solve is under way.")
    proving: bool = Bool(
        False, help="Whether `layout` is the best so far, and the search goes on to prove or to better it."
    )
    seconds: float = Float(0.0, help="How long the last solve took.")
    selection: Selection = Instance(Selection, ())
    trouble: Exception | None = Instance(
        Exception, allow_none=True, help="An error that should not have been."
    )
    version: int = Int(0, help="Goes up once after each consistent change of all of the above.")

    def __init__(
        self,
        design: Design | str | FilePath | None = None,
        *,
        time_limit: float = 10.0,
        solve: Solve = solve,
        first: float | None = FIRST,
        quick: float = QUICK,
        known: Known | None = None,
    ) -> None:
        super().__init__(design=_read(design) if design is not None else Design())
        self.time_limit, self._first = time_limit, first
        #: The layer that was shown alone last, and those that were shown before.
        self.alone: tuple[str, frozenset[str]] = ("", frozenset())
        #: The building that the façade is a wall of, for the 3D view; none for a façade by itself.
        self.whole: Whole | None = None
        self._history = History(_Snapshot(self.design))
        self._revision = 0
        self._reason = ""
        self._traced = False
        self._outcomes: deque[Outcome] = deque()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._begin_links()
        self._solver = LatestSolver(self._post, solve, known or (resized if solve is _SOLVE else None), quick)
        self._solve()
        self._changed()

    # ---- editing -------------------------------------------------------------------------------------------------

    @by_turns
    def edit(self, change: Design | Callable[[Design], Design], *, key: object = None) -> None:
        """Take over a new design.

        Parameters
        ----------
        change
            The new design, or a function that makes it from the present one.
        key
            What is edited; edits with one key in quick succession are one step of undo.

        Raises
        ------
        DesignError
            If the new design is not valid; the model then keeps the design it had.
        """
        design = _valid(change if isinstance(change, Design) else change(self.design))
        self._take(_settle(*newcomers.tidy(design, self.newcomers), self.drafts), key=key)

    @by_turns
    def enter(self, path: Path | str, value: Any) -> None:
        """Take over what was typed into a field; where that gives no valid design, keep it as the field's draft.

        Symbols that a pattern's text needs come by themselves, with a size; see `newcomers`.

        Parameters
        ----------
        path
            The field, as `fields` names it: ``("patterns", "Bx", "text")``, or with dots between.
        value
            What was typed or chosen: text, a truth value, a list of names, or None.
        """
        if isinstance(path, str):  # as faults name their place
            path = tuple(path.split("."))
        others = {other: draft for other, draft in self.drafts.items() if other != path}
        try:
            design, fresh = newcomers.enter(self.design, path, value, self.newcomers)
        except DesignError as error:
            drafts = {**others, path: Draft(value, error.faults)}
            snapshot = _Snapshot(self.design, drafts, self.newcomers)
        else:
            snapshot = _settle(design, fresh, others)
        self._take(snapshot, key=path)

    @by_turns
    def discard(self, path: Path) -> None:
        """Forget the draft of a field."""
        left = {other: draft for other, draft in self.drafts.items() if other != path}
        self._take(_Snapshot(self.design, left, self.newcomers), key=None)

    @by_turns
    def load(self, source: Design | str | FilePath) -> None:
        """Replace the design, as one step that can be undone.

        Parameters
        ----------
        source
            A design, its JSON text, or a path to it.

        Raises
        ------
        DesignError
            With every fault of the document; the model then keeps the design it had.
        """
        self._take(_Snapshot(_read(source)), key=None)
        self.select()

    @property
    def history(self) -> tuple[tuple[Design, ...], tuple[Design, ...]]:
        """The designs that undo goes back to, oldest first, and those that redo goes forward to, the next one last."""
        past, future = self._history.past, self._history.future
        return tuple(state.design for state in past), tuple(state.design for state in future)

    @by_turns
    def resume(self, past: Sequence[Design], design: Design, future: Sequence[Design] = ()) -> None:
        """Go on with a design and the history that it had."""
        self._history.resume([*map(_Snapshot, past)], _Snapshot(design), [*map(_Snapshot, future)])
        self._restore(self._history.present)
        self.select()

    def save(self, path: str | FilePath | None = None) -> str:
        """The design as JSON text; with `path` it is also written there, atomically. Drafts are not part of it."""
        return self.design.to_json(path)

    @by_turns
    def select(
        self,
        shape: int | None = None,
        *,
        layer: str = "",
        x: str = "",
        y: str = "",
        more: Iterable[tuple[str, str]] = (),
    ) -> None:
        """Pick a shape by its index in `layout.shapes`, or a layer, symbols or pairs; without arguments nothing."""
        if shape is not None and self.layout is not None and 0 <= shape < len(self.layout.shapes):
            placed = self.layout.shapes[shape]
            self.selection = Selection(shape, placed.layer, placed.x, placed.y, placed.number)
        else:
            self.selection = Selection(None, layer, x, y, None, tuple((a, b) for a, b in more))
        self._changed()

    @by_turns
    def toggle(self, *, layer: str = "", x: str = "", y: str = "", add: bool = False) -> None:
        """Pick a layer, a symbol or a pair, or nothing if it is what is picked.

        With `add` the pair joins the picked pairs of its layer, or leaves them.
        """
        picked = self.selection
        if add and picked.layer == layer and picked.x and picked.y:
            pairs = [(picked.x, picked.y), *picked.more]
            pairs = [pair for pair in pairs if pair != (x, y)] if (x, y) in pairs else [*pairs, (x, y)]
            first, *more = pairs or [("", "")]
            self.select(layer=layer, x=first[0], y=first[1], more=more)
        elif not add and all(
            not own or own == had for own, had in ((layer, picked.layer), (x, picked.x), (y, picked.y))
        ):
            self.select()
        else:
            self.select(layer=layer, x=x, y=y)

    # ---- solving -------------------------------------------------------------------------------------------------

    def wait(self, seconds: float | None = None) -> bool:
        """Block until the layout of the present design has come; returns whether it came within `seconds`."""
        done = self._solver.join(seconds)
        self._arrive()
        return done

    def glimpse(self, seconds: float) -> None:
        """Block until there is something to show of the present design, or for so many seconds.

        A search that goes on waits until that has been shown: see `go_on`.
        """
        self._solver.glimpse(seconds)
        with self.turn:
            if self._collect():
                self._changed()

    def go_on(self) -> None:
        """What there is of a search that goes on has been shown."""
        if self.proving:
            self._solver.go_on(self._revision)

    def stop(self) -> None:
        """End the solve under way: the best layout that it has found is taken; without one, the last one stays."""
        self._solver.stop()

    @by_turns
    def solve_for(self, seconds: float) -> None:
        """Solve again, and from now on, for so many seconds at most."""
        self.time_limit = seconds
        self._solve()
        self._changed()

    @by_turns
    def follow(self) -> None:
        """Record a `trace` of each solve from now on. Views of the solver ask for it."""
        if not self._traced:
            self._traced = True
            self._solve()
            self._changed()

    def close(self) -> None:
        """Stop solving; the model keeps what it has."""
        self._revision += 1
        self._solver.cancel(self._revision)
        self._solver.join()
        self._outcomes.clear()
        self.busy = self.proving = False

    def _take(self, snapshot: _Snapshot, *, key: object) -> None:
        self._note(snapshot, key)
        self._restore(snapshot)

    def _restore(self, snapshot: _Snapshot) -> None:
        moved = snapshot.design != self.design
        self.design, self.drafts, self.newcomers = snapshot.design, snapshot.drafts, snapshot.newcomers
        if moved:
            self._solve()
        self._judge()
        self._changed()

    def _solve(self) -> None:
        self._revision += 1
        self.busy, self.proving = True, False
        try:
            self._loop = asyncio.get_running_loop()
        except RuntimeError:
            self._loop = None
        first = None if self._loop is None else self._first
        self._solver.submit(
            self._revision, newcomers.begun(self.design), self.time_limit, self._traced, first
        )
        if self._loop is None:  # nobody will call back later
            self._solver.join()
            self._collect()

    def _post(self, outcome: Outcome) -> None:
        """Hand an outcome over to the loop (called in the worker thread)."""
        self._outcomes.append(outcome)
        if self._loop is not None:
            with suppress(RuntimeError):  # the loop was closed meanwhile: the outcome waits for `wait`
                self._loop.call_soon_threadsafe(self._arrive)

    @by_turns
    def _arrive(self) -> None:
        if self._collect():
            self._changed()
            self.go_on()

    def _collect(self) -> bool:
        """Take over the outcomes that have come, drop those of superseded solves; whether one counted."""
        fresh = False
        while self._outcomes:
            outcome = self._outcomes.popleft()
            if outcome.revision == self._revision:
                fresh = True
                self._land(outcome)
        return fresh

    def _land(self, outcome: Outcome) -> None:
        self.busy = self.proving = outcome.proving
        self.seconds = outcome.seconds
        self.blame = outcome.error if isinstance(outcome.error, NoLayout) else None
        self.trouble = None if isinstance(outcome.error, FacadeError) else outcome.error
        self._reason = str(outcome.error) if outcome.error is not None else ""
        told = outcome.layout or self.blame
        if told is not None and told.trace is not None:
            self.trace = told.trace
        if outcome.layout is not None:
            # That the search was cut short is no news while it goes on.
            self.layout = replace(outcome.layout, warnings=()) if outcome.proving else outcome.layout
            self._reselect(outcome.layout)
        self._judge()

    def _judge(self) -> None:
        """Say whether the layout shown is that of what stands in the fields, and if not, why."""
        self.message = self._reason
        self.stale = self.layout is not None and bool(self._reason or self.drafts)

    def _reselect(self, layout: Layout) -> None:
        """Keep the picked cell picked when its shape has another index, or is no more."""
        picked = self.selection
        if picked.number is None:
            return
        index = {(s.layer, s.x, s.y, s.number): i for i, s in enumerate(layout.shapes)}
        same = index.get((picked.layer, picked.x, picked.y, picked.number))
        if same is None:  # there are fewer now: the one nearest to it
            across, up = picked.number
            apart = {
                i: abs(number[0] - across) + abs(number[1] - up)
                for (*cell, number), i in index.items()
                if cell == [picked.layer, picked.x, picked.y]
            }
            same = min(apart, key=apart.__getitem__, default=None)
        number = picked.number if same is None else layout.shapes[same].number
        self.selection = replace(picked, shape=same, number=number)

    def _changed(self) -> None:
        self._follow_links()
        self.version += 1


def _read(source: Design | str | FilePath) -> Design:
    return source if isinstance(source, Design) else Design.from_json(source)


def _valid(design: Design) -> Design:
    """The design, if it is a valid document. Raises `DesignError` with all its faults."""
    return Design.from_dict(design.to_dict())


def _settle(design: Design, fresh: Newcomers, drafts: Mapping[Path, Draft]) -> _Snapshot:
    """Take over those drafts that have become valid with `design`; the rest keep their present faults."""
    left: dict[Path, Draft] = {}
    for path, draft in drafts.items():
        try:
            design, fresh = newcomers.enter(design, path, draft.value, fresh)
        except DesignError as error:
            left[path] = Draft(draft.value, error.faults)
    return _Snapshot(design, left, fresh)
