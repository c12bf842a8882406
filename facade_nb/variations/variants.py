"""The variants of a design: what is changed in each, before any of them is solved."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import Any, Literal

from ..design.edit import with_canvas, with_counter, with_symbol
from ..design.errors import DesignError, listed, nearest, quoted
from ..design.model import AXES, Design

__all__ = ["RESULTS", "Names", "Value", "Variants", "checked_mapping", "edited", "known_names"]

RESULTS = (
    *(f"{axis}_{field}" for axis in AXES for field in ("cost", "deviation", "proven")),
    "shapes",
    "windows",
    "seconds",
    "error",
    "layout",
)
"""Columns of the table after those of the values."""

Value = float | int | None


@dataclass(frozen=True, slots=True)
class Variants:
    """Designs in order, and the values in which they differ.

    Attributes
    ----------
    columns
        Names of the values: ``width``, ``height``, ``seed``, and names of counters and symbols.
    values
        For each variant its value in each column.
    designs
        For each variant its design; or a text that says why there is none.
    """

    columns: tuple[str, ...]
    values: tuple[tuple[Value, ...], ...]
    designs: tuple[Design | str, ...]

    def __len__(self) -> int:
        return len(self.designs)

    @classmethod
    def of_product(
        cls,
        design: Design,
        *,
        width: Sequence[float] | None = None,
        height: Sequence[float] | None = None,
        counters: Mapping[str, Sequence[int]] | None = None,
        sizes: Mapping[str, Sequence[float]] | None = None,
    ) -> Variants:
        """Every combination of the values given, as `sweep` takes them; it raises what `sweep` raises."""
        named = [checked_mapping("sweep", k, v) for k, v in (("counters", counters), ("sizes", sizes))]
        parameters = _parameters(design, width, height, *named)
        combinations = tuple(product(*(parameter.values for parameter in parameters)))
        return cls(
            tuple(parameter.column for parameter in parameters),
            combinations,
            tuple(_variant(design, parameters, values) for values in combinations),
        )

    @classmethod
    def of_designs(cls, designs: Iterable[Design]) -> Variants:
        """Designs as they are: the columns are the seeds, sizes of canvases, counters and symbols that differ."""
        found = tuple(designs)
        columns: dict[str, list[Value]] = {"seed": [design.seed for design in found]}
        columns["width"] = [design.canvas.width for design in found]
        columns["height"] = [design.canvas.height for design in found]
        for kind in ("counters", "sizes"):
            for name in sorted({name for design in found for name in getattr(known_names(design), kind)}):
                if name not in columns and name not in RESULTS:
                    columns[name] = [_held(design, kind, name) for design in found]
        differing = {name: values for name, values in columns.items() if len(set(values)) > 1}
        return cls(
            tuple(differing), tuple(zip(*differing.values(), strict=True)) or ((),) * len(found), found
        )


@dataclass(frozen=True, slots=True)
class _Parameter:
    """A column of the table: what is changed, and to which values."""

    column: str
    values: tuple[float | int, ...]
    edit: Callable[[Design, Any], Design]


@dataclass(frozen=True, slots=True)
class Names:
    """The counters and symbols that a design has, declared or in its patterns."""

    counters: frozenset[str]
    sizes: frozenset[str]

    def check(self, caller: str, where: Literal["counters", "sizes"], name: str) -> None:
        """Raise ValueError for a name that there is not, with the nearest that there is."""
        known = sorted(self.counters if where == "counters" else self.sizes)
        if name not in known:
            what = "counter" if where == "counters" else "symbol"
            hint = nearest(name, known) or f"; it has {listed(known) or 'none'}"
            raise ValueError(
                f"{caller}: {where}: expected a {what} of the design, found {quoted(name)}{hint}"
            )


def known_names(design: Design) -> Names:
    """The names of a design that a value can be given to."""
    patterns = [pattern.parsed for pattern in design.patterns.values()]
    return Names(
        frozenset((*design.counters, *(name for pattern in patterns for name in pattern.counters))),
        frozenset((*design.symbols, *(name for pattern in patterns for name in pattern.symbols))),
    )


def checked_mapping(caller: str, where: str, given: Any) -> Mapping[str, Any]:
    """A mapping from names, or ValueError; None is an empty one."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise ValueError(f"{caller}: {where}: expected a mapping from names, found {given!r:.80}")
    return given


def _listed_values(column: str, given: Any) -> tuple[Any, ...]:
    """The values of a column, or ValueError: one number is not a list of one, and a text none of its letters."""
    if isinstance(given, (str, bytes, Mapping)) or not isinstance(given, Iterable):
        raise ValueError(f"sweep: {column}: expected a list of values, found {given!r:.80}")
    return tuple(given)


def _parameters(
    design: Design,
    width: Sequence[float] | None,
    height: Sequence[float] | None,
    counters: Mapping[str, Sequence[int]],
    sizes: Mapping[str, Sequence[float]],
) -> list[_Parameter]:
    found: list[_Parameter] = []
    if width is not None:
        found.append(
            _Parameter(
                "width",
                _listed_values("width", width),
                lambda design, value: with_canvas(design, width=value),
            )
        )
    if height is not None:
        found.append(
            _Parameter(
                "height",
                _listed_values("height", height),
                lambda design, value: with_canvas(design, height=value),
            )
        )
    names = known_names(design)
    for name, counts in counters.items():
        names.check("sweep", "counters", name)
        found.append(_Parameter(name, _listed_values(name, counts), partial(_counter, name)))
    for name, lengths in sizes.items():
        names.check("sweep", "sizes", name)
        found.append(_Parameter(name, _listed_values(name, lengths), partial(_size, name)))
    seen = set(RESULTS)
    for parameter in found:
        if not parameter.values:
            raise ValueError(f"sweep: {parameter.column}: expected at least one value, found none")
        if parameter.column in seen:
            raise ValueError(
                f"sweep: two columns of the table would be called {quoted(parameter.column)}; rename the counter or "
                f"symbol (facade_nb.design.edit.rename_symbol)"
            )
        seen.add(parameter.column)
    return found


def _counter(name: str, design: Design, value: Any) -> Design:
    return with_counter(design, name, value=value)


def _size(name: str, design: Design, value: Any) -> Design:
    return with_symbol(design, name, size=value)


def _variant(design: Design, parameters: Sequence[_Parameter], values: Sequence[Value]) -> Design | str:
    """The design with these values, or why there is none."""
    try:
        for parameter, value in zip(parameters, values, strict=True):
            design = parameter.edit(design, value)
    except DesignError as error:
        return str(error)
    return design


def _held(design: Design, kind: str, name: str) -> Value:
    """The value that a counter is fixed to, or the preferred size of a symbol; None where it has none."""
    if kind == "counters":
        return design.counters[name].value if name in design.counters else None
    return design.symbol(name).size


def edited(design: Design | None, values: Mapping[str, Value]) -> Design | str:
    """A design with the values of a row of the table; or a text that says why there is none."""
    if design is None:
        return "No row of the table has a layout, so its design is not known."
    names = known_names(design)
    try:
        for name, value in values.items():
            if value is None:
                continue
            if name in ("width", "height"):
                design = with_canvas(design, **{name: value})
            elif name == "seed":
                design = replace(design, seed=int(value))
            elif name in names.counters:
                design = with_counter(design, name, value=value)
            elif name in names.sizes:
                design = with_symbol(design, name, size=value)
    except DesignError as error:
        return str(error)
    return design
