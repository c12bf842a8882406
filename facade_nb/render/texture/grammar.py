"""A texture grammar: read, checked, encoded, evaluated (docs/texture.md).

>>> grammar = Grammar.parse("S -> SplitX(Abs, 1, Red, Rel, 1, Blue)  Red -> Mat(Color, 0, 1, 0, 0, 1)"
...                         "  Blue -> Mat(Color, 0, 0, 0, 1, 1)")
>>> grammar.evaluate([(0.5, 1), (1.5, 1)], size=(3, 2)).rule.tolist()
[1, 2]
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...design.errors import DesignError, Fault, GrammarError, cut, nearest, quoted
from ...design.names import nfc
from .atlas import Atlas, Tiles, pack
from .checks import Finding, check_rules, check_tiles, depths
from .compiling import Places, compile_text
from .encoding import Encoding, Record, encode, read_records
from .evaluating import evaluate
from .lines import Lines
from .noise import Seed
from .program import Rule
from .question import Question, Surface

if TYPE_CHECKING:
    from .steps import Step

__all__ = ["Grammar", "shipped"]


@dataclass(frozen=True, eq=False)
class Grammar:
    """A texture grammar that was read without faults.

    Attributes
    ----------
    rules
        In file order; copies that the compiler has made for other arguments follow.
    places
        Offsets in `text` of each rule, its operator and its values.
    named
        Every tile that the text names, with its offset.
    text
        What was read.
    tiles
        The tiles that it was read with; None: those that ship.
    """

    rules: tuple[Rule, ...]
    places: tuple[Places, ...]
    named: tuple[tuple[int, str], ...]
    text: str
    tiles: Tiles | None = None

    @classmethod
    def parse(cls, text: str, tiles: Tiles | None = None) -> Grammar:
        """Read and check a grammar.

        Parameters
        ----------
        text
            The grammar, as docs/texture.md describes it.
        tiles
            The tiles that it may name; None: those that ship.

        Raises
        ------
        GrammarError
            With every fault: unknown rules, operators, tiles and parameters, wrong numbers of values, values out of
            range, probabilities that do not add up, endless recursion, stacks deeper than the shader's.
        """
        compiled = compile_text(text)
        found = [
            (_offset(finding, compiled.places), finding.message) for finding in check_rules(compiled.rules)
        ]
        if compiled.tiles:
            found += check_tiles(compiled.tiles, tiles if tiles is not None else shipped())
        faults = {(offset, fault.message): fault for offset, fault in compiled.faults}
        lines = Lines(text)
        for offset, message in found:
            faults.setdefault((offset, message), lines.fault(offset, message))
        if faults:
            raise GrammarError(faults[key] for key in sorted(faults))
        return cls(compiled.rules, compiled.places, compiled.tiles, text, tiles)

    @cached_property
    def encoding(self) -> Encoding:
        """The grammar in its texture, with the positions of its rules and the numbers of its tiles."""
        return encode(self.rules)

    def texture(self) -> NDArray[Any]:
        """The grammar as (h, w, 4) float16 (float32 where `encoding` says so). Read-only."""
        return self.encoding.texture

    def report(self) -> str:
        """How many rules, pixels and bytes, in a sentence."""
        return self.encoding.report()

    @property
    def start(self) -> int:
        """The rule to begin with: S, else the first."""
        return next((i for i, rule in enumerate(self.rules) if rule.name == "S"), 0)

    def index(self, name: str | None) -> int:
        """The rule of that name; None: the start rule. Raises `DesignError` if there is none."""
        if name is None:
            return self.start
        names = [rule.name for rule in self.rules]
        wanted = nfc(str(name))
        if wanted not in names:
            raise DesignError(Fault("start", f"there is no rule {quoted(name)}{nearest(wanted, names)}"))
        return names.index(wanted)

    def evaluate(
        self,
        points: ArrayLike,
        size: tuple[float, float],
        seed: tuple[float, float] = (0.0, 0.0),
        start: str | None = None,
        rays: ArrayLike | None = None,
        tiles: Tiles | None = None,
    ) -> Surface:
        """What the grammar gives at points of a façade.

        Parameters
        ----------
        points
            (n, 2) metres from the façade's lower left corner.
        size
            Width and height of the façade, metres.
        seed
            A shift in metres that is added to the corners by which random numbers are looked up; another seed
            makes another façade.
        start
            The rule to begin with; None: S, else the first.
        rays
            (n, 3) directions from the eye to the points: x to the right, y up, z out of the façade, so negative. Of any
            length; a positive z is taken as if it were negative. None: straight on.
        tiles
            Tiles to use in place of those that the grammar was read with.

        Returns
        -------
        Surface
            A named tuple of color (n, 4), normal (n, 4), specular (n, 4) float32 and rule (n,) int32.

        Raises
        ------
        DesignError
            If there is no such start rule, or no tile of a name in these `tiles`.
        ValueError
            For arrays of another shape, or a size that is not positive.
        """
        places = _array(points, 2, "points")
        directions = None if rays is None else _array(rays, 3, "rays")
        if directions is not None and len(directions) != len(places):
            raise ValueError(
                f"rays: expected one for each of the {len(places)} points; found {len(directions)}"
            )
        return evaluate(self.question(size, seed, start, tiles), places, directions)

    def steps(
        self,
        point: tuple[float, float],
        size: tuple[float, float],
        seed: tuple[float, float] = (0.0, 0.0),
        start: str | None = None,
        ray: tuple[float, float, float] | None = None,
        tiles: Tiles | None = None,
    ) -> tuple[Step, ...]:
        """The derivation of one point, step by step; parameters as of `evaluate`."""
        steps: list[Step] = []
        rays = None if ray is None else _array([ray], 3, "ray")
        evaluate(self.question(size, seed, start, tiles), _array([point], 2, "point"), rays, steps=steps)
        return tuple(steps)

    def question(
        self,
        size: tuple[float, float],
        seed: tuple[float, float] = (0.0, 0.0),
        start: str | None = None,
        tiles: Tiles | None = None,
        relief: bool = False,
    ) -> Question:
        """Everything that an evaluator needs, except the points. It raises what `evaluate` raises."""
        width, height = _two(size, "size", "a width and a height in metres, from 0.001 to below 100000")
        if not (1e-3 <= width < 1e5 and 1e-3 <= height < 1e5):
            raise ValueError(
                f"size: expected a width and a height in metres, from 0.001 to below 100000; found {size}"
            )
        place = _two(seed, "seed", "two numbers")
        if not max(map(abs, place)) < 2**53:
            raise ValueError(f"seed: expected two numbers below 2⁵³; found {seed}")
        names = tuple(rule.name for rule in self.rules)
        recurs, stacks = self._depths
        return Question(
            self.texture(),
            self._records,
            names,
            self.index(start),
            (width, height),
            Seed.of(place),
            self.atlas(tiles, relief),
            recurs,
            stacks[:2],
            stacks[2],
            relief,
        )

    def ready(self) -> Grammar:
        """The same, with all worked out that its first question would wait for, but for tiles."""
        _ = self._records, self._depths
        return self

    def atlas(self, tiles: Tiles | None = None, relief: bool = False) -> Atlas:
        """The tiles that the grammar names, packed, with `relief` also their heights.

        Raises `GrammarError` for one that is not in `tiles`.
        """
        if tiles is None or tiles is self.tiles:
            return self._relief_atlas if relief else self._atlas
        found = check_tiles(self.named, tiles)
        if found:
            lines = Lines(self.text)
            raise GrammarError(lines.fault(offset, message) for offset, message in found)
        return pack(tiles, self.encoding.tiles, relief)

    @cached_property
    def _records(self) -> tuple[Record, ...]:
        return read_records(self.texture())

    @cached_property
    def _depths(self) -> tuple[bool, tuple[int, int, int]]:
        return depths(self.rules)

    @cached_property
    def _atlas(self) -> Atlas:
        return self._packed(False)

    @cached_property
    def _relief_atlas(self) -> Atlas:
        return self._packed(True)

    def _packed(self, relief: bool) -> Atlas:
        names = self.encoding.tiles
        return pack((self.tiles if self.tiles is not None else shipped()) if names else None, names, relief)


def shipped() -> Tiles:
    """The tiles that ship."""
    from ..tiles import TileSet

    return TileSet.builtin()


def _offset(finding: Finding, places: Sequence[Places]) -> int:
    place = places[finding.rule]
    return place.operator if finding.value is None else place.values[finding.value]


_FAR = 1e9
"""Points are within so many metres, and rays not longer: 32-bit floats hold them and their squares."""


def _array(values: ArrayLike, columns: int, what: str) -> NDArray[np.float32]:
    try:
        array = np.asarray(values, np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{what}: expected an array of numbers of shape (n, {columns}); {error}") from None
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{what}: expected an array of shape (n, {columns}); found {array.shape}")
    if not np.isfinite(array).all():
        raise ValueError(f"{what}: expected finite numbers")
    if (np.abs(array) > _FAR).any():
        raise ValueError(f"{what}: expected numbers within ±{_FAR:g}; found {np.abs(array).max():g}")
    if columns == 3 and (np.abs(array).max(axis=1, initial=0) < 1 / _FAR).any():
        raise ValueError(f"{what}: expected directions, at least {1 / _FAR:g} long")
    return array.astype(np.float32)


def _two(values: Any, what: str, wanted: str) -> tuple[float, float]:
    try:
        first, second = (float(value) for value in values)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{what}: expected {wanted}; found {cut(repr(values))}") from None
    return first, second
