"""The moment that all views of one solve share: a trace, a position in it, and what the reader has picked."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from weakref import WeakKeyDictionary, WeakValueDictionary

from traitlets import HasTraits, Instance, Int, List, Unicode

from ...design import Design, DesignError, NoLayout
from ...solver import Layout, Trace
from ..shared.turns import Turns
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
    """

    trace: Trace = Instance(Trace)
    position: int = Int(-1)
    picked: list[str] = List(Unicode())
    follows = False
    """Whether the trace is that of a model, and another one when that is edited."""

    def __init__(self, trace: Trace) -> None:
        super().__init__(trace=_whole(trace))

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

    def _follow(self, trace: Trace) -> None:
        """Another solve: stay at the same moment where there is one."""
        moment = None if self.position < 0 else self.moment
        with self.hold_trait_notifications():
            self.trace = _whole(trace)
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
    _of_model[model] = made
    return made


_of_trace: WeakValueDictionary[int, TraceModel] = WeakValueDictionary()
"""By the id of the trace, which lives as long as its model does."""
_of_model: WeakKeyDictionary[FacadeModel, TraceModel] = WeakKeyDictionary()
