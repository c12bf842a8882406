"""What the stage shows besides the elevation: made only while a view asks for it, and sent beside the design."""

from __future__ import annotations

import asyncio
import traceback
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar

from ipywidgets import Widget
from traitlets import Dict, List, Unicode

from ...design import Design
from ...design.document import spelled
from ...design.model import AXES
from ...render import elevation_svg, exploded_svg, naive_layout
from ...solver import Layout
from ...survey import Survey, compare
from ..shared.bundled import Message, ModelWire
from .beginnings import surveyed
from .exports import describe_exports
from .facts import describe_facts, remedies
from .keeping import Keeper
from .words import describe_letters, describe_words

if TYPE_CHECKING:
    from .model import FacadeModel

__all__ = ["Extras", "Snapshot"]

Json = dict[str, Any]

_WORDS = "words:"
"""What a view asks for that looks at the words of a pattern, followed by its name."""
_AFTER = 0.12
"""Seconds after an answer until words are told: what is typed on comes first."""


@dataclass(frozen=True, slots=True)
class Snapshot:
    """A design that was put aside, with its layout."""

    number: int
    design: Design
    layout: Layout | None


class Extras(ModelWire):
    """The traits of the stage, apart from the elevation."""

    model: FacadeModel

    document = Unicode().tag(sync=True)
    menus = Dict().tag(sync=True)
    stage = Dict().tag(sync=True)
    marks = Dict().tag(sync=True)
    naive = Dict().tag(sync=True)
    exploded = Unicode().tag(sync=True)
    survey = Dict().tag(sync=True)
    snapshots: List[Any] = List().tag(sync=True)
    letters = Dict().tag(sync=True)
    words = Dict().tag(sync=True)

    def __init__(self, model: FacadeModel, **traits: Any) -> None:
        self._wants: dict[str, set[str]] = {}
        self._made: dict[str, tuple[object, ...]] = {}
        self.keeper: Keeper | None = None
        self.taken: list[Snapshot] = []
        self.surveyed: Survey | None = None
        self._words_later: asyncio.TimerHandle | None = None
        menus = {"exports": describe_exports(), "surveyed": list(surveyed())}
        super().__init__(model, menus=menus, **traits)

    def want(self, what: str, client: str, on: bool) -> None:
        """Note that a view looks at one of the extras, or does no more."""
        clients = self._wants.setdefault(what, set())
        if on:
            clients.add(client)
        else:
            clients.discard(client)

    def _receive(self, _: Widget, message: Message, buffers: list[Any]) -> None:
        """A view that goes looks at nothing any more."""
        if message.get("op") == "view" and not message["here"]:
            for clients in self._wants.values():
                clients.discard(message.get("client", ""))
        super()._receive(_, message, buffers)

    def later(self, work: Callable[[], Json], tag: Json) -> Json | None:
        """The reply that `work` makes; where there is an event loop, it is made in a thread and sent then."""
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:
            return work()

        async def send() -> None:
            try:
                self.send({**await loop.run_in_executor(None, work), **tag})
            except Exception:  # as in `Channel._answer`: shown under the widget, not lost in a log
                self.trouble = traceback.format_exc()

        task = loop.create_task(send())
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return None

    _tasks: ClassVar[set[asyncio.Task[None]]] = set()  # a loop keeps no task alive by itself

    def tell_stage(self) -> None:
        """Send what is to be said of the stage: it has changed by itself."""
        if not self._asleep:
            self.stage = self._stage()

    def _stage(self) -> Json:
        model = self.model
        return {
            "facts": describe_facts(model.layout),
            "remedies": [{"warning": one.warning, "text": one.text} for one in remedies(model)],
            "limit": model.time_limit,
            "keeping": self.keeper.describe() if self.keeper is not None else {"state": "off"},
        }

    def _describe_extras(self, theme: str) -> None:
        """Bring the traits up to date; each costs something only where its cause has changed."""
        model = self.model
        design, layout = model.design, model.layout
        if self._changed("document", design):
            self.document = spelled(design)
        self.stage = self._stage()
        if self._changed("exploded", layout, theme, self._wanted("exploded")):
            shown = layout is not None and self._wanted("exploded")
            self.exploded = (
                exploded_svg(layout, theme=theme, background=False, prefix=f"x{self.model_id}")
                if shown and layout is not None
                else ""
            )
        if self._changed("letters", layout, layout and layout.design):
            self.letters = describe_letters(layout)
        self._words_soon()
        if self._changed("survey", layout, self.surveyed):
            self.survey = _survey(layout, self.surveyed)
        if self._changed("snapshots", tuple(self.taken), theme):
            self.snapshots = [_snapshot(one, theme) for one in self.taken]

    def _describe_overlays(self, theme: str) -> None:
        """Bring what lies over the picture up to date, in the same way."""
        layout = self.model.layout
        if self._changed("marks", layout, self._wanted("marks")):
            self.marks = _marks(layout) if layout is not None and self._wanted("marks") else {}
        if self._changed("naive", layout, theme, self._wanted("naive")):
            shown = layout is not None and self._wanted("naive")
            prefix = f"n{self.model_id}"
            self.naive = _naive(layout, theme, prefix) if shown and layout is not None else {}

    def _words_soon(self) -> None:
        """Tell the words of the patterns that are looked at, after all else: no edit waits for them."""
        self._forget_words()
        if self.model.busy:
            return  # they come with the layout
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:
            self._tell_words()
        else:
            if self.words or any(what.startswith(_WORDS) for what in self._wants if self._wanted(what)):
                self._words_later = loop.call_later(_AFTER, self._tell_words)

    def _tell_words(self) -> None:
        self._words_later = None
        model = self.model
        wanted = tuple(
            sorted(
                what[len(_WORDS) :] for what in self._wants if what.startswith(_WORDS) and self._wanted(what)
            )
        )
        if self._asleep or not self._changed("words", model.design, model.layout, model.message, wanted):
            return
        try:
            self.words = {name: told for name in wanted if (told := describe_words(model, name))}
        except Exception:  # as in `Channel.publish`: shown under the widget, not lost in a log
            self.trouble = traceback.format_exc()

    def _forget_words(self) -> None:
        if self._words_later is not None:
            self._words_later.cancel()
            self._words_later = None

    def _empty_extras(self) -> None:
        """Drop what is large while nobody looks."""
        self._forget_words()
        self._wants.clear()
        self._made.clear()
        self.document = self.exploded = ""
        self.marks = {}
        self.naive = {}
        self.letters = {}
        self.words = {}
        self.snapshots = []

    def _wanted(self, what: str) -> bool:
        return bool(self._wants.get(what))

    def _changed(self, what: str, *cause: object) -> bool:
        """Whether one of the causes is another object than the last time."""
        before = self._made.get(what)
        if before is not None and all(a is b or a == b for a, b in zip(before, cause, strict=True)):
            return False
        self._made[what] = cause
        return True


def _marks(layout: Layout) -> Json:
    """Where the columns of each group and the letters of each row stand, metres."""
    return {
        axis: [
            {
                "group": name,
                "columns": [_rounded(stop) for stop in group.columns],
                "rows": [
                    {
                        "layer": row.layer,
                        "pattern": row.pattern,
                        "letters": [
                            [one.symbol, _rounded(one.start), _rounded(one.end), one.transparent]
                            for one in row.letters
                        ],
                    }
                    for row in group.rows
                ],
            }
            for name, group in layout.along(axis).groups.items()
        ]
        for axis in AXES
    }


def _naive(layout: Layout, theme: str, prefix: str) -> Json:
    found = naive_layout(layout)
    hidden = replace(layout, shapes=tuple(own.shape for own in found.behind), holes=())
    return {
        "shapes": [[_rounded(side) for side in rect] for rect in found.shapes],
        "behind": [
            {"before": own.before, "rect": [_rounded(side) for side in own.rect]} for own in found.behind
        ],
        "drawing": elevation_svg(hidden, theme=theme, background=False, prefix=prefix)
        if found.behind
        else "",
        "flaws": [
            {"kind": flaw.kind, "rect": [_rounded(side) for side in flaw.rect], "text": flaw.text}
            for flaw in found.flaws
        ],
    }


def _survey(layout: Layout | None, survey: Survey | None) -> Json:
    """Surveyed openings, moved so that their common corner is that of the layout's own, and how well they agree."""
    if survey is None:
        return {}
    openings = [[float(side) for side in one["rect"]] for one in survey.openings]
    own = [shape.rect for shape in layout.shapes if shape.kind in ("window", "door")] if layout else []
    left = min((rect[0] for rect in own), default=1.0) - min((rect[0] for rect in openings), default=0.0)
    foot = min((rect[1] for rect in own), default=1.0) - min((rect[1] for rect in openings), default=0.0)
    moved = [[_rounded(a + (left if i % 2 == 0 else foot)) for i, a in enumerate(rect)] for rect in openings]
    score = compare(layout, survey.openings) if layout is not None and own else 0.0
    return {"building": survey.building, "openings": moved, "score": _rounded(score), "source": survey.source}


def _snapshot(one: Snapshot, theme: str) -> Json:
    told: Json = {"number": one.number, "name": one.design.name, "svg": "", "facts": [], "shapes": 0}
    told["canvas"] = {"width": one.design.canvas.width, "height": one.design.canvas.height}
    if one.layout is not None:
        told["svg"] = elevation_svg(one.layout, theme=theme, ids=False, background=False)
        told["facts"] = describe_facts(one.layout)
        told["shapes"] = len(one.layout.shapes)
    return told


def _rounded(value: float) -> float:
    """Tenths of a millimetre."""
    return round(value, 4)
