"""What a wall of the town's grammar is divided into, found by walking its rules: no pixel, no chance, no tile."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil

from facade_nb.render import Grammar
from facade_nb.render.texture.program import Source

OPENINGS = ("frame-", "window", "door", "gate", "curtain", "glass", "room-", "shutter-roller")
"""How names of tiles begin that mean a window, a door or a room."""

DOORS = ("door", "gate", "shutter-roller")


@dataclass(frozen=True, slots=True)
class Part:
    """A rule in its scope (left, bottom, right, top), and whether some parts before it did not fit there."""

    rule: int
    scope: tuple[float, float, float, float]
    overflow: float


def parts(grammar: Grammar, start: str, size: tuple[float, float], *, alike: bool = False) -> Iterator[Part]:
    """Everything that a wall may be divided into, by every choice.

    Rooms are not entered. Of equal parts side by side the first and the last come, of storeys each.
    `alike`: of parts with one rule and one size only one comes, wherever they are.
    """
    waiting = [Part(grammar.index(start), (0.0, 0.0, *size), 0.0)]
    seen = set()
    while waiting:
        part = waiting.pop()
        left, bottom, right, top = part.scope
        place = (right - left, top - bottom) if alike else part.scope
        key = (part.rule, part.overflow, *(round(v, 5) for v in place))
        if key in seen:
            continue
        seen.add(key)
        yield part
        rule = grammar.rules[part.rule]
        name = rule.operator.name
        if name in ("SplitX", "SplitY", "RepeatX", "RepeatY"):
            waiting += _divided(grammar, part, 0 if name.endswith("X") else 1)
        elif name != "Intrusion":
            waiting += [Part(target, part.scope, 0.0) for target in rule.targets()]


def _divided(grammar: Grammar, part: Part, axis: int) -> Iterator[Part]:
    rule = grammar.rules[part.rule]
    low, high = part.scope[axis], part.scope[axis + 2]
    if rule.operator.name.startswith("Repeat"):
        size = float(rule.value("v"))  # type: ignore[arg-type]
        count = max(1, ceil((high - low) / size - 1e-3))
        pieces = [((high - low) / count, rule.targets()[0])] * count
        lost = 0.0
    else:
        signs = [(float(s), float(v), int(r)) for s, v, r in rule.parts]  # type: ignore[arg-type]
        fixed = sum(v for s, v, _ in signs if s < 0)
        shares = sum(v for s, v, _ in signs if s > 0)
        rest = max(high - low - fixed, 0.0)
        lost = max(fixed - (high - low), 0.0)
        pieces = [(v if s < 0 else rest * v / shares, r) for s, v, r in signs]
    side_by_side = rule.operator.name == "RepeatX"
    at = low
    for k, (length, target) in enumerate(pieces):
        end = min(at + length, high)
        if side_by_side and 0 < k < len(pieces) - 1:
            at = end
            continue
        scope = list(part.scope)
        scope[axis], scope[axis + 2] = at, end
        if end - at > 1e-6:
            yield Part(target, (scope[0], scope[1], scope[2], scope[3]), lost)
        at = end


def tiles(grammar: Grammar, rule: int) -> set[str]:
    """The tiles that a rule paints with itself."""
    return {
        value.tile for _, value in grammar.rules[rule].values() if isinstance(value, Source) and value.tile
    }


def shows(grammar: Grammar, rule: int, what: tuple[str, ...]) -> bool:
    """Whether a rule paints with a tile of these, or is a room."""
    if grammar.rules[rule].operator.name == "Intrusion":
        return what is OPENINGS
    return any(tile.startswith(what) for tile in tiles(grammar, rule))
