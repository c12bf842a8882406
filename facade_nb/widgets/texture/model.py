"""The shared state of the views of one texture grammar. It needs no notebook."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from operator import ne
from typing import Any

from traitlets import Bool, Float, HasTraits, Instance, TraitError, Tuple, Unicode, validate

from ...design import DesignError
from ...render import Grammar
from ...render.texture.atlas import Tiles
from ...render.texture.steps import Step
from ..shared.history import History, Undoable
from .places import Plane, planes

__all__ = ["TextureModel"]

_WIDEST = 1000.0
_EDITED = ("text", "size", "seed", "hour", "lit")


@dataclass(frozen=True, slots=True)
class _Snapshot:
    """What undo brings back."""

    text: str
    read: str | None
    """The text of the grammar that is shown: `text`, or, if that has faults, one before it."""
    size: tuple[float, float]
    seed: tuple[float, float]
    hour: float
    lit: bool


class TextureModel(Undoable[_Snapshot], HasTraits):
    """A grammar that is being edited, the façade it is shown on, and the pixel that is looked into.

    Parameters
    ----------
    grammar
        A grammar, or its text; a text with faults is kept, with its faults.
    size
        Width and height of the façade, metres.
    seed
        Of the façade, metres.
    hour
        Of the day, 0 to 24.
    lit
        Whether the light of the hour falls on it; else colours are as the grammar gives them.
    tiles
        The tiles that the text may name; None: those of the grammar, or those that ship.

    Attributes
    ----------
    text
        What was typed last. Nothing typed is lost.
    grammar
        The grammar of the last text without faults; None until there was one.
    faults
        Faults of the text; empty if `grammar` is what it says.
    point, ray
        The pixel that is looked into: metres on the façade, direction from the eye; None: none.
    derivation
        How it came about, step by step.
    places
        For each step, the plane its scope stands on: the façade, or a face of a room.

    Notes
    -----
    Every change of `text`, `size`, `seed`, `hour` and `lit` can be undone, whoever makes it.
    """

    text = Unicode()
    grammar = Instance(Grammar, allow_none=True)
    faults = Tuple()
    size = Tuple(Float(), Float(), default_value=(12.0, 9.0))
    seed = Tuple(Float(), Float(), default_value=(0.0, 0.0))
    hour = Float(11.0)
    lit = Bool(True)
    point = Tuple(Float(), Float(), allow_none=True, default_value=None)
    ray = Tuple(Float(), Float(), Float(), allow_none=True, default_value=None)
    derivation = Tuple()

    def __init__(self, grammar: Grammar | str = "", *, tiles: Tiles | None = None, **traits: Any) -> None:
        super().__init__(**traits)
        self.tiles = tiles
        if isinstance(grammar, Grammar):
            self.tiles = tiles if tiles is not None else grammar.tiles
            grammar = grammar.text
        self._key: Hashable | None = None
        self.enter(grammar)
        self._history = History(self._snapshot())
        self.observe(self._record, list(_EDITED))
        self.observe(self._derive, ["grammar", "size", "seed", "point", "ray"])
        self._derive()

    def enter(self, text: str) -> None:
        """Take a text as it was typed. With faults, the grammar stays what it last was; nothing is raised.

        Texts in quick succession are one step of undo.
        """
        with self._editing("text"):
            self._read(text)

    def adjust(self, name: str, value: Any) -> None:
        """Set `size`, `seed` or `hour` as a slider does, step by step, or `lit`.

        Values in quick succession are one step of undo, as those of an assignment are not.

        Raises
        ------
        TraitError
            If the value is not a possible one; the model then keeps the value it had.
        """
        now = getattr(self, name)
        both = isinstance(now, tuple) and isinstance(value, tuple)
        moved = tuple(map(ne, now, value)) if both else ()  # width and height are two sliders
        with self._editing(None if name == "lit" else (name, moved)):
            setattr(self, name, value)

    @contextmanager
    def _editing(self, key: Hashable | None) -> Iterator[None]:
        """Say what is edited: what has one key, in quick succession, is one step."""
        with self.turn:
            self._key = key
            try:
                yield
            finally:
                self._key = None

    @property
    def _shown(self) -> str | None:
        return None if self.grammar is None else self.grammar.text

    def _snapshot(self) -> _Snapshot:
        return _Snapshot(self.text, self._shown, self.size, self.seed, self.hour, self.lit)

    def _record(self, _: Any) -> None:
        self._note(self._snapshot(), self._key)

    def _restore(self, state: _Snapshot) -> None:
        with self.hold_trait_notifications():
            if state.read is None:
                self.grammar = None
            elif self._shown != state.read:
                self._read(state.read)
            if self.text != state.text:
                self._read(state.text)
            for name in _EDITED[1:]:
                setattr(self, name, getattr(state, name))

    def _read(self, text: str) -> None:
        with self.hold_trait_notifications():
            self.text = text
            try:
                self.grammar = Grammar.parse(text, self.tiles)
            except DesignError as error:
                self.faults = error.faults
            else:
                self.faults = ()

    def pick(self, point: Sequence[float] | None, ray: Sequence[float] | None = None) -> tuple[Step, ...]:
        """Choose the point that is looked into, straight on or along a ray; None: no point. Returns its steps."""
        with self.hold_trait_notifications():
            self.set_trait("point", None if point is None else tuple(map(float, point)))
            self.set_trait("ray", None if point is None or ray is None else tuple(map(float, ray)))
        return self.derivation

    def _derive(self, _: Any = None) -> None:
        inside = self.point is not None and all(
            0 <= at <= end for at, end in zip(self.point, self.size, strict=True)
        )
        steps: tuple[Step, ...] = ()
        self.places: tuple[Plane, ...] = ()
        if self.grammar is not None and inside:
            steps = self.grammar.steps(self.point, self.size, self.seed, ray=self.ray)
            self.places = tuple(planes(self.grammar, steps))
        self.derivation = steps

    @validate("size")
    def _check_size(self, proposal: Any) -> Any:
        if not all(0 < value <= _WIDEST for value in proposal["value"]):
            raise TraitError(
                f"size: expected a width and a height above 0, at most {_WIDEST:g} m; found {proposal['value']}"
            )
        return proposal["value"]

    @validate("seed")
    def _check_seed(self, proposal: Any) -> Any:
        if not all(abs(value) < 2**53 for value in proposal["value"]):
            raise TraitError(f"seed: expected two numbers; found {proposal['value']}")
        return proposal["value"]

    @validate("hour")
    def _check_hour(self, proposal: Any) -> Any:
        if not 0 <= proposal["value"] <= 24:
            raise TraitError(f"hour: expected 0 to 24; found {proposal['value']}")
        return proposal["value"]
