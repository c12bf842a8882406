"""The moment that all views of one solve share: a trace, a position in it, and what the reader has picked."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from weakref import WeakKeyDictionary, WeakValueDictionary

from traitlets import Bunch, HasTraits, Instance, Int, List, Unicode, observe, validate

from ... import gallery
from ...design import Design, DesignError, NoLayout
from ...solver import Layout, Trace, solve
from ..shared.turns import Turns
from ..studio import newcomers
from ..studio.model import FacadeModel
from .timeline import begun, locate, moment_of

__all__ = ["TraceModel"]


class TraceModel(Turns, HasTraits):
    """What the views of one solve share. `TraceModel.of` gives it: there is one for each trace, and for each
    model that is followed.

    Attributes
    ----------
    trace
        The trace that is shown. Where a model is followed, each new solve puts another trace here.
    position
        The number of the event that was played last; -1 is the end, also of a trace to come.
    picked
        The targets that the reader has picked, as the front end's links name them; most often empty.
    lesson
        The name of the lesson that is shown in place of the source (`gallery.lessons`); empty: the source is.
    stale
        Why what is shown is not the present design of the model that is followed; empty where it is.
    """

    trace: Trace = Instance(Trace)
    position: int = Int(-1)
    picked: list[str] = List(Unicode())
    lesson: str = Unicode()
    stale: str = Unicode()
    follows = False
    """Whether the trace is that of a model, and another one when that is edited."""

    def __init__(self, trace: Trace) -> None:
        super().__init__(trace=_whole(trace))
        self._own = self.trace
        self._before = -1

    @classmethod
    def of(
        cls, source: TraceModel | Trace | Layout | NoLayout | FacadeModel | Design | str | Path
    ) -> TraceModel:
        """The shared moment of a trace, of what carries one, or of a model or design, which is then solved traced.

        Raises
        ------
        DesignError
            For a layout that was solved without ``trace=True``, or a trace that is not whole.
        """
        if isinstance(source, TraceModel):
            return source
        if isinstance(source, (Design, str, Path)):
            source = FacadeModel(source)
        if isinstance(source, FacadeModel):
            return _following(source)
        trace = source if isinstance(source, Trace) else source.trace
        if trace is None:
            raise DesignError(
                "expected a layout with a trace, found one without; call solve(design, trace=True)"
            )
        made = _of_trace.get(id(trace))
        if made is None:
            made = _of_trace[id(trace)] = cls(trace)
        return made

    @property
    def name(self) -> str:
        """The name of the design."""
        return str(begun(self.trace).design["name"])

    @property
    def moment(self) -> str:
        """The position as text that survives small changes of the trace: axis, stage and offset, ``x/words+12``.

        Setting it moves all views there. A text that is no moment of this trace raises ValueError.
        """
        last = len(self.trace.events) - 1
        return moment_of(self.trace.events, last if self.position < 0 else min(self.position, last))

    @moment.setter
    def moment(self, moment: str) -> None:
        self.position = locate(self.trace.events, moment)

    def pick(self, targets: Sequence[str] = ()) -> None:
        """Pick targets in all views; without arguments nothing is picked any more."""
        self.picked = list(targets)

    @validate("lesson")
    def _known(self, proposal: Bunch) -> str:
        """Raises `DesignError` for a lesson that there is not."""
        return gallery.lesson_note(proposal["value"]).name if proposal["value"] else ""

    @observe("lesson")
    def _take(self, change: Bunch) -> None:
        """Show a lesson from where it begins; or the source again, where it was left."""
        with self.hold_trait_notifications():
            if not change["old"]:
                self._before = self.position
            if self.lesson:
                note = gallery.lesson_note(self.lesson)
                trace = solve(note.design, search=note.search, trace=True, time_limit=None).trace
                assert trace is not None
                self.trace = trace
                self.moment = note.moment
            else:
                self.trace, self.position = self._own, self._before
            self.picked = []

    def _follow(self, trace: Trace) -> None:
        """Another solve: stay at the same moment where there is one."""
        self._own = _whole(trace)
        if self.lesson:
            self._before = -1
            return
        moment = None if self.position < 0 else self.moment
        with self.hold_trait_notifications():
            self.trace = trace
            if moment is not None:
                try:
                    self.moment = moment
                except ValueError:  # the new solve has no such stage
                    self.position = -1
            self.picked = []


def _whole(trace: Trace) -> Trace:
    begun(trace)
    return trace


def _following(model: FacadeModel) -> TraceModel:
    found = _of_model.get(model)
    if found is not None:
        return found
    model.follow()
    model.wait()
    if model.trace is None:
        raise DesignError(model.message or "this design was not solved")
    made = TraceModel(model.trace)
    made.follows = True
    model.observe(lambda change: made._follow(change["new"]), "trace")

    def judge(_: object) -> None:
        made.stale = _staleness(model)

    model.observe(judge, "version")
    judge(None)
    _of_model[model] = made
    return made


def _staleness(model: FacadeModel) -> str:
    """Why the last trace of a model does not tell of its present design; empty where it does."""
    if model.busy:
        return "The design has been changed since; it is being solved."
    if model.drafts:
        return "What stands in the fields is at fault: this is the solve of the design without it."
    told = None if model.trace is None else Design.from_dict(begun(model.trace).design)
    if told != newcomers.begun(model.design):
        why = model.message or str(model.trouble or "")
        return "The design has been changed since, and was not solved" + (f": {why}" if why else ".")
    return ""


_of_trace: WeakValueDictionary[int, TraceModel] = WeakValueDictionary()
"""By the id of the trace, which lives as long as its model does."""
_of_model: WeakKeyDictionary[FacadeModel, TraceModel] = WeakKeyDictionary()
