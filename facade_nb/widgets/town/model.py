"""The shared state of the views of one town, or of one scene. It needs no notebook."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from traitlets import Float, HasTraits, Instance, Int, TraitError, Tuple, Unicode, observe, validate

from ...design import DesignError
from ...design.errors import nearest
from ...render import Grammar
from ...render.pipeline.scene import Scene
from ...render.pipeline.viewpoint import CameraPath, Viewpoint
from ...render.town import Town
from ..shared.history import History, Undoable
from .places import views_of
from .restyling import Starts
from .sections import joined, located, section_of, sections

__all__ = ["TownModel"]


@dataclass(frozen=True, slots=True)
class _Snapshot:
    """What undo brings back."""

    texts: tuple[str, ...]
    styles: tuple[tuple[int, int], ...]
    hour: float


class TownModel(Undoable[_Snapshot], HasTraits):
    """A town that is looked at, and whose grammar is edited.

    Parameters
    ----------
    source
        A town, or a scene of façades.

    Attributes
    ----------
    hour
        Of the day, 0 to 24.
    viewpoint
        Where one stands.
    path
        A way through the town; None: there is none.
    chosen
        The building that is looked into; -1: none.
    section
        The part of the grammar that is edited: the name of a style, ``shared`` or ``solved``.
    text
        What was typed last in it. Nothing typed is lost.
    faults
        Of that text; empty if `grammar` is what it says.
    grammar
        Of the last text without faults.
    tile_megabytes
        What tiles may take of the graphics card: those that are finer than that allows are left out.
    restyled
        Buildings with another style than the plan's: pairs of building and number of the style.

    Notes
    -----
    Every change of text, styles and hour can be undone, whoever makes it.
    """

    hour = Float(11.0)
    viewpoint = Instance(Viewpoint)
    path = Instance(CameraPath, allow_none=True)
    chosen = Int(-1)
    tile_megabytes = Float(64.0)
    section = Unicode()
    text = Unicode()
    faults = Tuple()
    grammar = Instance(Grammar)
    restyled = Tuple()

    def __init__(self, source: Town | Scene, **traits: Any) -> None:
        if not isinstance(source, Town | Scene):
            raise TypeError(f"source: expected a Town or a Scene; found {type(source).__name__}")
        self.source = source
        self.town = source if isinstance(source, Town) else None
        self.views = views_of(source)
        self._parts = self._read_parts = sections(source.grammar.text)
        self._vertices = source.vertices
        self._key: Hashable | None = None
        traits.setdefault("viewpoint", next(iter(self.views.values())))
        first = section_of(self.town.styles[0].name, self._parts) if self.town else next(iter(self._parts))
        super().__init__(grammar=source.grammar, section=first, text=self._parts[first], **traits)
        self._history = History(self._snapshot())
        self.observe(self._record, ["text", "restyled", "hour"])

    # What is drawn

    @property
    def vertices(self) -> np.ndarray:
        """As the grammar that is shown has them."""
        return self._vertices

    @cached_property
    def starts(self) -> Starts | None:
        """With which rule each vertex begins; None for a scene."""
        return None if self.town is None else Starts(self.town.vertices, self.town.grammar, self.town.styles)

    @property
    def scene(self) -> Scene:
        """What the pipeline draws."""
        return Scene(self.vertices, self.source.indices, self.grammar, self.source.chunks)

    @property
    def parts(self) -> tuple[str, ...]:
        """Names of the parts of the grammar."""
        return tuple(self._parts)

    def style_of(self, building: int) -> int:
        """Number of a building's style."""
        if self.town is None or not 0 <= building < len(self.town.plan):
            count = 0 if self.town is None else len(self.town.plan)
            raise IndexError(f"building: expected a number from 0 to below {count}; found {building}")
        return dict(self.restyled).get(building, int(self.town.plan.style[building]))

    def vertices_of(self, building: int) -> tuple[int, int]:
        """First and last but one vertex of a building."""
        town = self.source
        assert isinstance(town, Town)
        own = town.indices.reshape(-1, 3)[town.building_of == building]
        return (int(own.min()), int(own.max()) + 1) if len(own) else (0, 0)

    # Editing

    def edit(self, section: str) -> None:
        """Choose the part of the grammar that is edited. A text with faults that was typed elsewhere is let go."""
        if section not in self._parts:
            raise TraitError(
                f"section: expected one of {', '.join(self._parts)}; found {section!r}{nearest(section, self._parts)}"
            )
        if section == self.section:
            return
        with self.hold_trait_notifications():
            if self.faults:
                self._parts = self._read_parts
                self.faults = ()
            self.section = section
            self.text = self._parts[section]

    def enter(self, text: str) -> None:
        """Take a text as it was typed. With faults, the town stays what it last was; nothing is raised."""
        with self._editing(("text", self.section)):
            self._read(self.section, text)

    def adjust(self, hour: float) -> None:
        """Set the hour as a slider does: values in quick succession are one step of undo."""
        with self._editing("hour"):
            self.hour = hour

    def restyle(self, building: int, style: str | int) -> None:
        """Give one building another style: its walls and roof begin with that style's rules. Its form stays.

        Raises
        ------
        IndexError, ValueError
            For a building or a style that there is not.
        """
        old = self.style_of(building)
        assert self.town is not None
        names = [one.name for one in self.town.styles]
        if isinstance(style, str):
            if style not in names:
                raise ValueError(f"style: {_unknown(style, names)}")
            style = names.index(style)
        if not 0 <= style < len(names):
            raise ValueError(f"style: expected a number below {len(names)}; found {style}")
        if style == old:
            return
        changed = {**dict(self.restyled), building: style}
        if changed[building] == int(self.town.plan.style[building]):
            del changed[building]
        with self._editing(("style", building)):
            self.restyled = tuple(sorted(changed.items()))

    @observe("restyled")
    def _on_restyled(self, change: Any) -> None:
        before, now = dict(change["old"] or ()), dict(change["new"])
        for building in {own for own, _ in set(before.items()) ^ set(now.items())}:
            self._begin_anew(building)

    def _begin_anew(self, building: int) -> None:
        """Let the vertices of a building begin with the rules of its style."""
        assert self.town is not None and self.starts is not None
        first, end = self.vertices_of(building)
        at = np.arange(first, end)
        owned = self._original[first:end]
        self.starts.rules[first:end] = owned
        style = self.style_of(building)
        if style != int(self.town.plan.style[building]):
            self.starts.rules[first:end] = self.starts.restyled(
                at, self.town.vertices["size"][first:end, 0], style
            )
        self._own()["start"][first:end] = self.starts.places(self.grammar)[self.starts.rules[first:end]]

    @cached_property
    def _original(self) -> np.ndarray:
        assert self.starts is not None
        return self.starts.rules.copy()

    def _own(self) -> np.ndarray:
        """Vertices that are this model's alone."""
        if self._vertices is self.source.vertices:
            self._vertices = self.source.vertices.copy()
        return self._vertices

    def _read(self, section: str, text: str) -> None:
        with self.hold_trait_notifications():
            self._parts = {**self._parts, section: text}
            self.section, self.text = section, text
            try:
                grammar = Grammar.parse(joined(self._parts), self.source.grammar.tiles)
                if self.starts is not None:
                    places = self.starts.places(grammar)
                    self._original  # noqa: B018 (kept before the rules change)
                    self._own()["start"] = places[self.starts.rules]
            except DesignError as error:
                self.faults = tuple(located(error.faults, self._parts, section))
            else:
                self._read_parts = self._parts
                self.faults = ()
                self.grammar = grammar

    # Undo

    @contextmanager
    def _editing(self, key: Hashable) -> Iterator[None]:
        with self.turn:
            self._key = key
            try:
                yield
            finally:
                self._key = None

    def _snapshot(self) -> _Snapshot:
        return _Snapshot(tuple(self._parts.values()), self.restyled, self.hour)

    def _record(self, _: Any) -> None:
        self._note(self._snapshot(), self._key)

    def _restore(self, state: _Snapshot) -> None:
        with self.hold_trait_notifications():
            before, self._parts = self._parts, dict(zip(self._parts, state.texts, strict=True))
            changed = [name for name, text in self._parts.items() if text != before[name]]
            section = self.section if not changed or self.section in changed else changed[0]
            if joined(self._parts) != self.grammar.text or self.faults:
                self._read(section, self._parts[section])
            self.section, self.text = section, self._parts[section]
            self.restyled, self.hour = state.styles, state.hour

    @validate("hour")
    def _check_hour(self, proposal: Any) -> Any:
        if not 0 <= proposal["value"] <= 24:
            raise TraitError(f"hour: expected 0 to 24; found {proposal['value']}")
        return proposal["value"]

    @validate("tile_megabytes")
    def _check_megabytes(self, proposal: Any) -> Any:
        if not 1 <= proposal["value"] <= 4096:
            raise TraitError(f"tile_megabytes: expected 1 to 4096; found {proposal['value']:g}")
        return proposal["value"]

    @validate("chosen")
    def _check_chosen(self, proposal: Any) -> Any:
        count = 0 if self.town is None else len(self.town.plan)
        if not -1 <= proposal["value"] < count:
            raise TraitError(f"chosen: expected -1, or a building below {count}; found {proposal['value']}")
        return proposal["value"]

    def look(self, name: str) -> Viewpoint:
        """Go to one of `views`: ``distance``, ``street`` or ``close-up``."""
        if name not in self.views:
            raise ValueError(
                f"view: expected one of {', '.join(self.views)}; found {name!r}{nearest(name, list(self.views))}"
            )
        self.viewpoint = self.views[name]
        return self.viewpoint

    def travel(self, rows: Sequence[dict[str, object]]) -> None:
        """Take a path from the browser; an empty one ends it."""
        self.path = CameraPath.from_dict(rows) if rows else None


def _unknown(name: object, known: Iterable[str]) -> str:
    names = list(known)
    return f"expected one of {', '.join(names)}; found {name!r}{nearest(str(name), names)}"
