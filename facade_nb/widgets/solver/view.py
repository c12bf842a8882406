"""What all views of a solve are: a widget of one kilobyte that names its trace channel and the view to show."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from anywidget import AnyWidget
from ipywidgets import Widget, widget_serialization
from traitlets import Bool, Dict, Instance, Unicode

from ...design import Design, NoLayout
from ...solver import Layout, Trace
from ..shared.bundled import as_run, bundle
from ..studio.model import FacadeModel
from .channel import TraceChannel
from .model import TraceModel

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["LARGEST", "TraceView"]

LARGEST = 120_000
"""Bytes of the static form up to which a saved notebook carries it."""


class TraceView(AnyWidget):
    """A view of a solve; each subclass is another view.

    Parameters
    ----------
    source
        A trace; a layout, or a `NoLayout`, with one; a `FacadeModel`, which is followed; a design, which is solved;
        or the `model` of another view. Views of one source share their moment.
    at
        The moment to begin at, written as `TraceModel.moment` is: ``x/words+12``. None: the moment of the other
        views of this source; for the first view, the end.
    player
        Whether the view has a player of its own above it.
    predict
        Whether the view begins with a question and hides the answer until the reader has predicted it.

    Attributes
    ----------
    model
        The shared moment: trace, position, what is picked. Give it to other views.
    answer
        What the reader predicted last: ``right``, ``wrong`` and ``missed``, each a list of targets; empty before.
    """

    _esm = bundle("loader.js")
    _shows: ClassVar[str] = ""
    _needs: ClassVar[tuple[str, ...]] = ()

    channel = Instance(Widget).tag(sync=True, **widget_serialization)
    part = Unicode().tag(sync=True)
    player = Bool(True).tag(sync=True)
    predict = Bool(False).tag(sync=True)
    answer = Dict().tag(sync=True)

    def __init__(
        self,
        source: TraceModel | Trace | Layout | NoLayout | FacadeModel | Design | str | Path,
        *,
        at: str | None = None,
        **traits: Any,
    ) -> None:
        self.model = TraceModel.of(source)
        if at is not None:
            self.model.moment = at
        channel = TraceChannel.of(self.model)
        channel.provide(self._needs)
        super().__init__(channel=channel, part=self._shows, **traits)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.model.name!r})"

    @property
    def frame(self) -> pd.DataFrame:
        """The table behind the view."""
        raise NotImplementedError

    def to_html(self) -> str:
        """The static form: what a page shows where no widget can run. Plain HTML, pictures within it as images."""
        raise NotImplementedError

    def _repr_mimebundle_(self, **options: Any) -> tuple[dict[str, Any], dict[str, Any]] | None:
        """The live view and, for pages where none can run, the static form.

        Where the view follows a model, which may be edited, the static form says that it is of the cell's run.
        """
        self.channel.wake()
        made = super()._repr_mimebundle_(**options)
        if made is not None:
            static = self.to_html()
            if static and self.predict:  # the static form is the answer: a reader should ask for it
                static = f"<details><summary>The answer</summary>{static}</details>"
            if static and len(static.encode()) <= LARGEST:
                made[0]["text/html"] = as_run(static) if self.model.follows else static
        return made
