"""The grammar as a texture: four channels of 16-bit floats (texture paper, 4 and Figure 3).

Rules stand in file order, the records of each side by side in one row. A row's end is left empty where the next rule
does not fit. Channels are those of the operator table. Sums are precomputed: of the sizes as the texture holds them,
so that the parts of a split add up.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import ceil, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .limits import MAX_EXACT, MAX_HALF
from .operators import BY_CODE, Kind, Operator, Param
from .program import Rule, Source, Value, tile_names

__all__ = ["Encoding", "Record", "decode", "encode", "read_records"]

_MAX_WIDTH = 2048
_MODES = {"Fit": 1, "Rep": -1}


@dataclass(frozen=True, slots=True, eq=False)
class Encoding:
    """A grammar in its texture.

    Attributes
    ----------
    texture
        (h, w, 4), float16, or float32 where 16 bits cannot hold every position or count. Read-only.
    positions
        Column and row of each rule's first record.
    names
        Of the rules.
    tiles
        Tile number k in the texture is ``tiles[k - 1]``; in the order in which the text names them.
    pixels
        How many pixels the records take, without empty ends of rows.
    """

    texture: NDArray[Any]
    positions: tuple[tuple[int, int], ...]
    names: tuple[str, ...]
    tiles: tuple[str, ...]
    pixels: int

    @property
    def bits(self) -> int:
        """Bits of each channel, 16 or 32."""
        return int(self.texture.dtype.itemsize) * 8

    @property
    def bytes(self) -> int:
        """Bytes that the records take."""
        return self.pixels * 4 * int(self.texture.dtype.itemsize)

    def report(self) -> str:
        """Rules, pixels and bytes, in a sentence; says so where 32 bits are needed."""
        height, width = self.texture.shape[:2]
        count = len(self.positions)
        text = (
            f"{count} rule{'s' * (count != 1)} in {self.pixels} pixel{'s' * (self.pixels != 1)}, {self.bytes} bytes, "
            f"of a texture of {width} × {height} with 4 channels of {self.bits} bits"
        )
        if self.bits == 32:
            text += f": it has whole numbers above {MAX_EXACT}, up to which 16 bits are exact,"
            text += f" or sums above {MAX_HALF:g}"
        return text


def encode(rules: Sequence[Rule]) -> Encoding:
    """Write rules into a texture."""
    counts = [rule.operator.pixels(len(rule.parts)) for rule in rules]
    tiles = tile_names(rules)
    width, positions = _places(counts)
    numbers = {tile: k for k, tile in enumerate(tiles, 1)}
    records = [list(_records(rule, positions, numbers)) for rule in rules]
    height = positions[-1][1] + 1 if positions else 1
    whole = max(width, height, *(_largest(rule, numbers) for rule in rules)) if rules else 1
    sums = max((abs(value) for channels in records for value in channels), default=0.0)
    narrow = whole <= MAX_EXACT and sums <= MAX_HALF
    texture = np.zeros((height, width, 4), np.float16 if narrow else np.float32)
    for (x, y), channels in zip(positions, records, strict=True):
        texture[y, x : x + len(channels) // 4] = np.reshape(channels, (-1, 4))
    texture.setflags(write=False)
    return Encoding(texture, tuple(positions), tuple(rule.name for rule in rules), tiles, sum(counts))


def _places(counts: Sequence[int]) -> tuple[int, list[tuple[int, int]]]:
    """Width of the texture, and where each rule begins: about square, and wide enough for the longest rule."""
    width = 1
    while width < max([*counts, ceil(sqrt(sum(counts)))], default=1):
        width *= 2
    if width > _MAX_WIDTH:
        width = max(_MAX_WIDTH, *counts)
    x = y = 0
    places = []
    for count in counts:
        if x + count > width:
            x, y = 0, y + 1
        places.append((x, y))
        x += count
    return width, places


def _largest(rule: Rule, numbers: Mapping[str, int]) -> int:
    """The largest whole number in a rule that has to be exact."""
    whole = [len(rule.parts)]
    for kind, value in rule.values():
        if isinstance(value, Source):
            whole.append(numbers.get(value.tile, 0))
        elif kind is Kind.LEVEL:
            whole.append(int(value))
    return max(whole)


def _records(rule: Rule, positions: Sequence[tuple[int, int]], numbers: Mapping[str, int]) -> Iterator[float]:
    """The channels of a rule, in order, whole pixels."""
    operator = rule.operator

    def named(params: tuple[Param, ...], values: tuple[Value, ...]) -> dict[str, float]:
        found: dict[str, float] = {"": 0.0}
        for param, value in zip(params, values, strict=True):
            if isinstance(value, Source):
                found[param.name] = _MODES[value.mode] * numbers[value.tile] if value.mode else 0
            elif param.kind is Kind.RULE:
                found[f"{param.name}.x"], found[f"{param.name}.y"] = positions[int(value)]
            else:
                found[param.name] = value
        return found

    parts = [named(operator.part, part) for part in rule.parts]
    head = named(operator.fixed, rule.fixed) | {"code": operator.code, "n": len(parts)}
    if "Σrel" in operator.head:
        held = [(part["s"], float(np.float16(part["v"]))) for part in parts]
        head["Σrel"] = sum(v for s, v in held if s > 0)
        head["Σabs"] = sum(v for s, v in held if s < 0)
        for part in parts:
            part["sv"] = part["s"] * part["v"]
    if "Σv" in operator.each:
        total = 0.0
        for part in parts:
            total += part["v"]
            part["Σv"] = total
    channels = [head[name] for name in operator.head]
    channels += [part[name] for part in parts for name in operator.each]
    yield from channels
    yield from [0.0] * (-len(channels) % 4)


# Decoding ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """A rule as the texture holds it.

    Attributes
    ----------
    operator
        Which.
    head
        The value of each named channel of its fixed records.
    parts
        For each named channel of a part, (n,) float32: its values for all parts.
    targets
        The rules that it may go on with, in order: one for each part, or the fixed ones.
    place
        Column and row of the first record.
    """

    operator: Operator
    head: Mapping[str, float]
    parts: Mapping[str, NDArray[np.float32]]
    targets: tuple[int, ...]
    place: tuple[int, int]

    @property
    def count(self) -> int:
        """How many parts there are."""
        return int(self.head["n"]) if self.operator.part else 0

    def pixels(self, first: int, last: int) -> tuple[tuple[int, int], ...]:
        """Places of the pixels that hold the parts from `first` to `last`."""
        x, y = self.place
        start, size = x + self.operator.head_pixels, len(self.operator.each)
        columns = range(start + first * size // 4, start + (last * size + size - 1) // 4 + 1)
        return tuple((column, y) for column in columns)

    @property
    def head_places(self) -> tuple[tuple[int, int], ...]:
        """Places of the fixed records."""
        x, y = self.place
        return tuple((x + k, y) for k in range(self.operator.head_pixels))


def read_records(texture: NDArray[Any]) -> tuple[Record, ...]:
    """Find the rules in a texture, in order.

    Raises
    ------
    ValueError
        Naming the pixel, if there is no rule where one should be.
    """
    pixels = np.asarray(texture, np.float32)
    starts = tuple(_starts(pixels))
    index = {place: i for i, place in enumerate(starts)}
    return tuple(_record(pixels, place, index) for place in starts)


def _starts(pixels: NDArray[np.float32]) -> Iterator[tuple[int, int]]:
    """Where rules begin."""
    height, width = pixels.shape[:2]
    for y in range(height):
        x = 0
        while x < width and pixels[y, x, 0] != 0:
            operator = BY_CODE.get(int(pixels[y, x, 0]))
            if operator is None:
                raise ValueError(f"pixel {x}, {y}: expected an operator's code; found {pixels[y, x, 0]:g}")
            yield x, y
            x += operator.pixels(int(pixels[y, x, 1]) if operator.part else 0)


def _record(
    pixels: NDArray[np.float32], place: tuple[int, int], index: Mapping[tuple[int, int], int]
) -> Record:
    x, y = place
    operator = BY_CODE[int(pixels[y, x, 0])]
    channels = pixels[y, x:].ravel()
    head = dict(zip(operator.head, map(float, channels), strict=False))
    count, size = int(head["n"]) if operator.part else 0, len(operator.each)
    start = len(operator.head)
    table = channels[start : start + count * size].reshape(count, size)
    parts = {name: table[:, k] for k, name in enumerate(operator.each)}
    named = [param.name for param in operator.fixed if param.kind is Kind.RULE]
    columns = [(head[f"{name}.x"], head[f"{name}.y"]) for name in named]
    columns += [
        (part["R.x"], part["R.y"]) for part in (dict(zip(operator.each, row, strict=True)) for row in table)
    ]
    targets = []
    for column, row in columns:
        target = index.get((int(column), int(row)))
        if target is None:
            raise ValueError(f"pixel {x}, {y}: expected the position of a rule; found {column:g}, {row:g}")
        targets.append(target)
    return Record(operator, head, parts, tuple(targets), place)


def decode(texture: NDArray[Any], names: Sequence[str] = (), tiles: Sequence[str] = ()) -> tuple[Rule, ...]:
    """Read rules from a texture: the inverse of `encode`, but for what 16 bits have rounded.

    Parameters
    ----------
    texture
        (h, w, 4).
    names, tiles
        Names of the rules and tiles, which a texture does not hold. Those that are missing are numbered.

    Raises
    ------
    ValueError
        Naming the pixel, if there is no rule where one should be.
    """
    return tuple(
        _decoded(names[i] if i < len(names) else f"R{i}", record, tiles)
        for i, record in enumerate(read_records(texture))
    )


def _decoded(name: str, record: Record, tiles: Sequence[str]) -> Rule:
    targets = iter(record.targets)

    def values(params: tuple[Param, ...], named: Mapping[str, float]) -> tuple[Value, ...]:
        found: list[Value] = []
        for param in params:
            if param.kind is Kind.RULE:
                found.append(next(targets))
            elif param.kind in (Kind.SOURCE, Kind.MASK):
                found.append(_source(int(named[param.name]), tiles))
            elif param.kind in (Kind.LEVEL, Kind.USAGE, Kind.POLICY):
                found.append(int(named[param.name]))
            else:
                found.append(named[param.name])
        return tuple(found)

    fixed = values(record.operator.fixed, record.head)
    parts, total = [], 0.0
    for i in range(record.count):
        part = {channel: float(column[i]) for channel, column in record.parts.items()}
        if "sv" in part:
            part["s"], part["v"] = (1.0 if part["sv"] > 0 else -1.0), abs(part["sv"])
        if "Σv" in part:
            part["v"], total = part["Σv"] - total, part["Σv"]
        parts.append(values(record.operator.part, part))
    return Rule(name, record.operator, fixed, tuple(parts))


def _source(number: int, tiles: Sequence[str]) -> Source:
    if not number:
        return Source()
    k = abs(number)
    return Source("Fit" if number > 0 else "Rep", tiles[k - 1] if k <= len(tiles) else f"tile{k}")
