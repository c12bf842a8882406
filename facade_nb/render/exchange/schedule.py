"""The schedule: what a façade is made of, one row for each kind, geometry, material and size."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from ...design.files import write_atomically
from ...solver.model.layout import Layout, PlacedShape

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["COLUMNS", "OTHER", "Item", "items", "items_on", "schedule", "to_schedule", "write_schedule"]

COLUMNS = ("mark", "kind", "geometry", "material", "width_m", "height_m", "count", "area_m2", "layers")
"""The header."""

OTHER = "other"
"""The kind of a shape that has none."""

_FIRST = ("window", "door")


@dataclass(frozen=True, slots=True)
class Item:
    """A row: shapes of one kind, geometry, material and size.

    Attributes
    ----------
    mark
        What the row is called on a drawing: ``W1`` is the first window.
    width, height
        Metres, to the millimetre.
    shapes
        Indices into `Layout.shapes`.
    area
        Of all of them, square metres.
    layers
        The layers that they stand in, bottom first.
    """

    mark: str
    kind: str
    geometry: str
    material: str
    width: float
    height: float
    shapes: tuple[int, ...]
    area: float
    layers: tuple[str, ...]


def items_on(sheet: Layout, whole: Layout) -> tuple[Item, ...]:
    """The rows of one sheet of several, with the marks that they have on all."""
    marks = {_key(whole.shapes[item.shapes[0]]): item.mark for item in items(whole)}
    return tuple(replace(item, mark=marks[_key(sheet.shapes[item.shapes[0]])]) for item in items(sheet))


def items(layout: Layout) -> tuple[Item, ...]:
    """The rows: windows first, then doors, then the other kinds by name; within a kind the largest first."""
    groups: dict[tuple[str, str, str, int, int], list[int]] = {}
    for index, shape in enumerate(layout.shapes):
        groups.setdefault(_key(shape), []).append(index)
    kinds = sorted({key[0] for key in groups}, key=lambda kind: (_rank(kind), kind))
    prefixes = _prefixes(kinds)
    numbers: dict[str, int] = {}
    result = []
    for key in sorted(groups, key=lambda k: (kinds.index(k[0]), -k[3] * k[4], *k)):
        kind, geometry, material, width, height = key
        numbers[kind] = numbers.get(kind, 0) + 1
        shapes = [layout.shapes[index] for index in groups[key]]
        result.append(
            Item(
                f"{prefixes[kind]}{numbers[kind]}",
                kind,
                geometry,
                material,
                width / 1000,
                height / 1000,
                tuple(groups[key]),
                sum((s.rect[2] - s.rect[0]) * (s.rect[3] - s.rect[1]) for s in shapes),
                tuple(dict.fromkeys(s.layer for s in shapes)),
            )
        )
    return tuple(result)


def schedule(layout: Layout) -> pd.DataFrame:
    """The schedule as a table, with the columns of `COLUMNS`; `layers` is joined by semicolons."""
    import pandas as pd

    return pd.DataFrame(
        [
            (
                item.mark,
                item.kind,
                item.geometry,
                item.material,
                item.width,
                item.height,
                len(item.shapes),
                round(item.area, 4),
                "; ".join(item.layers),
            )
            for item in items(layout)
        ],
        columns=list(COLUMNS),
    )


def to_schedule(layout: Layout) -> str:
    """The schedule as CSV."""
    return str(schedule(layout).to_csv(index=False, lineterminator="\n"))


def write_schedule(layout: Layout, path: str | Path) -> Path:
    """Write the schedule as CSV, atomically, and return the path.

    Raises
    ------
    DesignError
        If the file cannot be written.
    """
    write_atomically(path, to_schedule(layout))
    return Path(path)


def _key(shape: PlacedShape) -> tuple[str, str, str, int, int]:
    left, bottom, right, top = shape.rect
    size = round(1000 * (right - left)), round(1000 * (top - bottom))
    return (shape.kind.strip() or OTHER, shape.geometry, shape.material, *size)


def _rank(kind: str) -> int:
    return _FIRST.index(kind) if kind in _FIRST else len(_FIRST)


def _prefixes(kinds: Iterable[str]) -> dict[str, str]:
    """As few letters of each kind as tell it from those before it: window W, wall WA."""
    found: dict[str, str] = {}
    for kind in kinds:
        letters = "".join(c for c in kind.upper() if c.isalpha()) or "X"
        options = [letters[:n] for n in range(1, len(letters) + 1)]
        options += [f"{letters}{'X' * n}" for n in range(1, len(found) + 2)]
        found[kind] = next(option for option in options if option not in found.values())
    return found
