"""Values of a model as traits: what a slider is linked to, and what `interact` calls.

Each follows the design, and changes it. What is set is an edit only where it is another value than the design's; so
nothing need be known of who has set it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from traitlets import Any as AnyTrait
from traitlets import Dict, Float, HasTraits, Int

from ...design import Design, DesignError, Fault
from ...design.errors import nearest
from ...design.model import AXES
from ..shared.turns import Turns, by_turns
from .fields import Path, apply

if TYPE_CHECKING:
    from ...solver import Layout

__all__ = ["CounterHandle", "Linkable", "SizeHandle"]

Change = Mapping[str, Any]


class Handle(HasTraits):
    """One value of a model."""

    value = AnyTrait(None, allow_none=True)

    def __init__(self, model: Linkable, name: str) -> None:
        super().__init__()
        self.name = name
        self._model = model
        self.follow()
        self.observe(self._on_value, "value")

    def follow(self) -> None:
        """Say what the model says."""
        self.value = self._held()

    def _path(self) -> Path:
        raise NotImplementedError

    def _held(self) -> Any:
        raise NotImplementedError

    def _on_value(self, change: Change) -> None:
        with self._model.turn:
            self._enter(change)

    def _enter(self, change: Change) -> None:
        if change["new"] == self._held():
            return
        try:
            self._model.edit(apply(self._model.design, self._path(), change["new"]), key=self._path())
        except DesignError:
            self.follow()
            raise


class CounterHandle(Handle):
    """A counter of a model.

    Attributes
    ----------
    value
        What it is: its fixed value, or, where it is free, what the solver has found. Setting it fixes the counter.
    fixed
        Its fixed value, or None.
    min, max
        Its bounds; `max` None: without an upper one.
    """

    fixed = Int(None, allow_none=True, read_only=True)
    min = Int(0, read_only=True)
    max = Int(None, allow_none=True, read_only=True)

    def free(self) -> None:
        """Let the solver choose its value."""
        with self._model.turn:
            self._model.edit(apply(self._model.design, self._path(), None), key=self._path())

    def follow(self) -> None:
        """Say what the model says."""
        own = self._model.design.counter(self.name)
        self.set_trait("fixed", own.value)
        self.set_trait("min", own.min)
        self.set_trait("max", own.max)
        super().follow()

    def _path(self) -> Path:
        return ("counters", self.name, "value")

    def _held(self) -> int | None:
        fixed = self._model.design.counter(self.name).value
        layout = self._model.layout
        return fixed if fixed is not None or layout is None else layout.counters.get(self.name)


class SizeHandle(Handle):
    """The size of a symbol of a model, metres.

    Attributes
    ----------
    value
        Its preferred size; None: it has none.
    solved
        What it has in the layout, by axis.
    """

    solved = Dict(read_only=True)

    def follow(self) -> None:
        """Say what the model says."""
        layout = self._model.layout
        sizes = {axis: layout.along(axis).sizes.get(self.name) for axis in AXES} if layout is not None else {}
        self.set_trait("solved", {axis: size for axis, size in sizes.items() if size is not None})
        super().follow()

    def _path(self) -> Path:
        return ("symbols", self.name, "size")

    def _held(self) -> float | None:
        return self._model.design.symbol(self.name).size


Kind = TypeVar("Kind", bound=Handle)


class Linkable(Turns, HasTraits):
    """The traits of a model that can be linked.

    A value that is not possible is refused with `DesignError`, and the trait stays what it was.

    Attributes
    ----------
    width, height
        The canvas, metres.
    sizes
        Preferred sizes by symbol, metres; None: none.
    counters
        Fixed values by counter; None: free.
    """

    width = Float()
    height = Float()
    sizes = Dict()
    counters = Dict()

    if TYPE_CHECKING:
        design: Design
        layout: Layout | None

        def edit(self, change: Design, *, key: object = None) -> None:
            """Of the model."""

    def counter(self, name: str) -> CounterHandle:
        """One counter, to be linked: ``link((slider, "value"), (model.counter("k"), "value"))``."""
        return self._handle(CounterHandle, name, self.counters, "counter")

    def size(self, name: str) -> SizeHandle:
        """The size of one symbol, to be linked: ``link((slider, "value"), (model.size("A"), "value"))``."""
        return self._handle(SizeHandle, name, self.sizes, "symbol")

    def _handle(self, kind: type[Kind], name: str, known: Mapping[str, Any], what: str) -> Kind:
        if name not in known:
            raise KeyError(f"expected a {what} of the design, found {name!r}{nearest(name, known)}")
        handle: Kind | None = self._handles.get((kind, name))
        if handle is None:
            handle = self._handles[kind, name] = kind(self, name)
        return handle

    def _begin_links(self) -> None:
        self._handles: dict[tuple[type[Handle], str], Any] = {}
        self._follow_links()
        self.observe(self._on_side, ["width", "height"])
        self.observe(self._on_table, ["sizes", "counters"])

    def _follow_links(self) -> None:
        """Have the traits say what the design says. Whoever hears of one may edit: each is asked for anew."""
        self.width = self.design.canvas.width
        self.height = self.design.canvas.height
        self.sizes = self._table("sizes")
        self.counters = self._table("counters")
        for (kind, name), handle in list(self._handles.items()):
            if name in (self.counters if kind is CounterHandle else self.sizes):
                handle.follow()

    def _table(self, which: str) -> dict[str, Any]:
        design = self.design
        patterns = [pattern.parsed for pattern in design.patterns.values()]
        if which == "sizes":
            names = dict.fromkeys((*design.symbols, *(name for own in patterns for name in own.symbols)))
            return {name: design.symbol(name).size for name in names}
        names = dict.fromkeys((*design.counters, *(name for own in patterns for name in own.counters)))
        return {name: design.counter(name).value for name in names}

    @by_turns
    def _on_side(self, change: Change) -> None:
        side = change["name"]
        if change["new"] != getattr(self.design.canvas, side):
            self._try(lambda: apply(self.design, ("canvas", side), change["new"]), side)

    @by_turns
    def _on_table(self, change: Change) -> None:
        """Take over the entries that are others than the design's; those that are missing stay as they are."""
        which, given = change["name"], change["new"]
        held = self._table(which)
        section, field, what = (
            ("symbols", "size", "symbol") if which == "sizes" else ("counters", "value", "counter")
        )
        if given == held:
            return

        def changed() -> Design:
            design = self.design
            for name, value in given.items():
                if name not in held:
                    message = f"expected a {what} of the design, found {name!r}{nearest(name, held)}"
                    raise DesignError(Fault(which, message))
                if value != held[name]:
                    design = apply(design, (section, name, field), value)
            return design

        self._try(changed, which)

    def _try(self, change: Callable[[], Design], key: str) -> None:
        """Edit, and say then what the design says: nothing else, where that is not possible."""
        try:
            self.edit(change(), key=key)
        finally:
            self._follow_links()
