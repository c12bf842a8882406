"""What can be wrong with rules as a whole: probabilities, endless recursion, stacks, values out of range."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from ...design.errors import cut, nearest, quoted
from .atlas import Tiles
from .limits import MAX_FACES, MAX_FRAMES, MAX_SEEDS, MAX_STEPS
from .operators import Kind
from .program import Rule, Source, children

__all__ = ["Finding", "check_rules", "check_tiles", "depths"]

_MANY = 50
"""Faults that say what may have been meant; nobody reads more."""

_WAY = 12
"""Rules that are named on a way back."""

_SLACK = 1e-3
"""By how much probabilities may miss 1: so 0.333 three times is fine."""


@dataclass(frozen=True, slots=True)
class Finding:
    """A fault of a rule: of value number `value`, or (None) of the whole, then its operator is pointed at."""

    rule: int
    value: int | None
    message: str


def check_rules(rules: Sequence[Rule]) -> list[Finding]:
    """Everything that is wrong with the values and the structure of rules that are whole by themselves."""
    found = [finding for i, rule in enumerate(rules) for finding in (*_sums(i, rule), *_ranges(i, rule))]
    return found + _structure(tuple(rules))


def check_tiles(named: Sequence[tuple[int, str]], tiles: Tiles) -> list[tuple[int, str]]:
    """Offset and fault of every tile that a text names and the tile set does not have, or cannot read."""
    names = set(tiles.names)
    unusable: Mapping[str, str] = getattr(tiles, "unusable", {})
    found = []
    for offset, name in named:
        if name in unusable:
            found.append((offset, f"the tile {quoted(name)} cannot be used: {unusable[name]}"))
        elif name not in names:
            hint = nearest(name, sorted(names)) if len(found) < _MANY else ""
            found.append((offset, f"there is no tile {quoted(name)}{hint}"))
    return found


def depths(rules: Sequence[Rule]) -> tuple[bool, tuple[int, int, int]]:
    """Whether some rule can come back to itself, and how high the stacks of layers, seeds and rooms can become.

    It holds from whichever rule one begins.
    """
    below = children(rules)
    groups = _components(below)
    frames, seeds, rooms = (
        max(_heights(rules, below, groups, pushes), default=0) for _, _, pushes in _STACKS
    )
    return bool(_circles(below, groups)), (frames, seeds, rooms)


def _heights(
    rules: Sequence[Rule],
    below: Sequence[Sequence[int]],
    groups: Sequence[Sequence[int]],
    pushes: Callable[[Rule], frozenset[int]],
) -> list[int]:
    """How high a stack can be where each rule begins."""
    height = [0] * len(rules)
    for group in groups:  # rules that lead to others come first
        top = max(height[i] for i in group)
        for i in group:
            height[i] = top
            pushed = pushes(rules[i])
            for to in below[i]:
                height[to] = max(height[to], top + (to in pushed))
    return height


def _sums(i: int, rule: Rule) -> list[Finding]:
    if rule.operator.name != "Rand":
        return []
    total = sum(float(weight) for weight, _ in rule.parts if not isinstance(weight, Source))
    if abs(total - 1) <= _SLACK * (1 + 1e-9):
        return []
    return [Finding(i, None, f"expected probabilities that add up to 1; found {total:.6g}")]


def _ranges(i: int, rule: Rule) -> list[Finding]:
    """Values of materials: constants and parts of tiles lie between 0 and 1, and scales are not 0."""
    found: list[Finding] = []
    values = list(rule.values())
    for k, (kind, source) in enumerate(values):
        if kind is not Kind.SOURCE or not isinstance(source, Source):
            continue
        own = [value for _, value in values[k + 1 : k + 5]]
        numbers = [float(value) for value in own if not isinstance(value, Source)]
        if source.mode == "Rep":
            found += [
                Finding(i, k + 3 + j, "expected repeats per metre other than 0; found 0")
                for j, number in enumerate(numbers[2:])
                if number == 0
            ]
            continue
        what = "the part of the tile" if source.mode else "the constant"
        found += [
            Finding(i, k + 1 + j, f"expected a number from 0 to 1 for {what}; found {number:g}")
            for j, number in enumerate(numbers)
            if not 0 <= number <= 1
        ]
        if source.mode and (numbers[0] == numbers[2] or numbers[1] == numbers[3]):
            found.append(Finding(i, k + 1, "expected left, bottom, right, top of a part that is not empty"))
    return found


# Structure --------------------------------------------------------------------------------------------------


def _structure(rules: tuple[Rule, ...]) -> list[Finding]:
    """Recursion that does not end, and stacks that grow too high."""
    below = [
        [to for to in onward if to >= 0] for onward in children(rules)
    ]  # -1: one that has a fault of its own
    smaller = [_smaller(rule) for rule in rules]
    stuck = [[to for to in onward if to not in smaller[i]] for i, onward in enumerate(below)]
    circles = _circles(stuck, _components(stuck))
    if circles:
        return [_endless(rules, stuck, group) for group in circles]
    groups = _components(below)
    found = []
    for what, limit, pushes in _STACKS:
        found += _too_high(rules, below, groups, what, limit, pushes)
    return found or _too_long(rules, below, groups)


def _smaller(rule: Rule) -> set[int]:
    """The rules that it goes on with in a smaller scope always, by some least part of it.

    A split does: a relative part beside any other part, and an absolute one that another absolute one stands before
    (the first may be all that fits). Nothing else does: a scope that is not larger than `v` is repeated as it is.
    """
    if not rule.operator.name.startswith("Split"):
        return set()
    absolute = False
    smaller: set[int] = set()
    same: set[int] = set()
    for policy, _, target in rule.parts:
        shrinks = absolute or (policy == 1 and len(rule.parts) > 1)
        (smaller if shrinks else same).update([target] if isinstance(target, int) else [])
        absolute = absolute or policy == -1
    return smaller - same


def _endless(rules: Sequence[Rule], edges: Sequence[Sequence[int]], group: Sequence[int]) -> Finding:
    first = min(group)
    way = _way_back(first, edges, set(group))
    shown = [cut(rules[i].name) for i in way]
    if len(shown) > _WAY:
        shown = [*shown[: _WAY // 2], "…", *shown[-_WAY // 2 :]]
    names = " → ".join(shown)
    return Finding(
        first,
        None,
        f"the rule {quoted(rules[first].name)} comes back to itself without its scope getting smaller: {names}",
    )


def _way_back(start: int, edges: Sequence[Sequence[int]], group: set[int]) -> list[int]:
    """The shortest way from a rule back to itself."""
    came: dict[int, int] = {}
    queue = [start]
    for at in queue:
        for to in edges[at]:
            if to == start:
                way = [start]
                while at != start:
                    way.append(at)
                    at = came[at]
                return [start, *reversed(way)]
            if to in group and to not in came:
                came[to] = at
                queue.append(to)
    raise AssertionError("a rule of a circle comes back to itself")


def _layers(rule: Rule) -> frozenset[int]:
    """Where layers stand below when the rule goes on: the lowest one needs no place on the stack."""
    return frozenset(rule.targets()[1:]) if rule.operator.name == "Layer" else frozenset()


def _seeds(rule: Rule) -> frozenset[int]:
    return frozenset(rule.targets()) if rule.operator.name == "RandStack" else frozenset()


def _faces(rule: Rule) -> frozenset[int]:
    return frozenset(rule.targets()) if rule.operator.name == "Intrusion" else frozenset()


_STACKS: tuple[tuple[str, int, Callable[[Rule], frozenset[int]]], ...] = (
    ("Layer operators", MAX_FRAMES, _layers),
    ("RandStack operators", MAX_SEEDS, _seeds),
    ("Intrusion operators", MAX_FACES, _faces),
)
"""What a stack is of, how much it holds, and with which rules a rule goes on with one more on it."""


def _too_high(
    rules: Sequence[Rule],
    below: Sequence[Sequence[int]],
    groups: Sequence[Sequence[int]],
    what: str,
    limit: int,
    pushes: Callable[[Rule], frozenset[int]],
) -> list[Finding]:
    """The first rule at which a stack has grown higher than the shader's, and those that make it grow in a circle."""
    home = {i: g for g, group in enumerate(groups) for i in group}
    found = [
        Finding(
            i,
            None,
            f"the rule {quoted(rules[i].name)} can come back to itself, and its {what} then stand inside "
            f"each other without end: expected at most {limit}",
        )
        for i in range(len(rules))
        if any(home.get(to) == home[i] for to in pushes(rules[i]))
    ]
    if found:
        return found
    height = _heights(rules, below, groups, pushes)
    high = [i for i in range(len(rules)) if height[i] > limit]
    if not high:
        return []
    at = min(high, key=lambda i: (height[i], i))
    return [Finding(at, None, f"{height[at]} {what} inside each other lead here: expected at most {limit}")]


def _too_long(
    rules: Sequence[Rule], below: Sequence[Sequence[int]], groups: Sequence[Sequence[int]]
) -> list[Finding]:
    """Layers of layers of layers can make more steps than a pixel may take. Recursion is not counted here."""
    steps = [1] * len(rules)
    for group in reversed(groups):
        if len(group) > 1:
            continue
        (i,) = group
        onward = [steps[to] for to in rules[i].targets() if to not in (i, -1)]
        steps[i] = 1 + (sum(onward) if rules[i].operator.name == "Layer" else max(onward, default=0))
    long = [i for i in range(len(rules)) if steps[i] > MAX_STEPS]
    if not long:
        return []
    at = min(long, key=lambda i: (steps[i], i))
    return [Finding(at, None, f"a pixel may take {steps[at]} steps from here: expected at most {MAX_STEPS}")]


def _circles(edges: Sequence[Sequence[int]], groups: Sequence[list[int]]) -> list[list[int]]:
    """Those of the `_components` in which rules lead to each other, or to themselves."""
    return [group for group in groups if len(group) > 1 or group[0] in edges[group[0]]]


def _components(edges: Sequence[Sequence[int]]) -> list[list[int]]:
    """Strongly connected components (Tarjan), those that lead to others before them."""
    number: dict[int, int] = {}
    low: dict[int, int] = {}
    open_: list[int] = []
    is_open: set[int] = set()
    groups: list[list[int]] = []
    for root in range(len(edges)):
        if root in number:
            continue
        walk = [(root, iter(edges[root]))]
        number[root] = low[root] = len(number)
        open_.append(root)
        is_open.add(root)
        while walk:
            at, rest = walk[-1]
            to = next(rest, None)
            if to is None:
                walk.pop()
                if walk:
                    low[walk[-1][0]] = min(low[walk[-1][0]], low[at])
                if low[at] == number[at]:
                    group = [open_.pop()]
                    while group[-1] != at:
                        group.append(open_.pop())
                    group.reverse()
                    groups.append(group)
                    is_open.difference_update(group)
            elif to not in number:
                number[to] = low[to] = len(number)
                open_.append(to)
                is_open.add(to)
                walk.append((to, iter(edges[to])))
            elif to in is_open:
                low[at] = min(low[at], number[to])
    groups.reverse()
    return groups
