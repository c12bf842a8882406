"""What an edit of a façade touches in the split grammar that draws it (the layer paper's section 6.1)."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import SequenceMatcher

from .splits import Node, Shape, Split, Stack, children, repeated, rules_of

__all__ = ["touched"]


def touched(before: Node, after: Node) -> tuple[set[Node], set[Node]]:
    """The rules that an edit touches, given both derivations.

    Rules are paired from the axiom on, each with the one in its place. A rule is touched if it has no partner, or if
    its parts are not those of its partner; sizes and numbers of repetitions are no edit.

    Returns
    -------
    tuple
        Rules that are new or have changed, as they are after the edit; rules that have gone.
    """
    partner: dict[Node, Node] = {}  # of rules after the edit, and what it was before
    waiting = [(before, after)]
    taken = {before}
    partner[after] = before
    for old, new in waiting:
        for was, now in _pairs(list(dict.fromkeys(children(old))), list(dict.fromkeys(children(new)))):
            both = isinstance(was, Split | Stack) and isinstance(now, Split | Stack)
            if both and now not in partner and was not in taken:
                partner[now] = was
                taken.add(was)
                waiting.append((was, now))
    number: dict[Node, int] = {}
    changed = {
        new
        for new, old in partner.items()
        if _written([partner.get(child, child) for child in children(new)], number)
        != _written(list(children(old)), number)
        or _kind(old) != _kind(new)
    }
    return changed | (set(rules_of(after)) - set(partner)), set(rules_of(before)) - taken


def _written(parts: list[Node], number: dict[Node, int]) -> str:
    """A rule's right side as it is written, without sizes and numbers of repetitions; `number` names the parts."""
    words = [str(number.setdefault(part, len(number))) for part in parts]
    return re.sub(r"\}\*\d+", "}*", " | ".join(repeated(words)))


def _kind(node: Node) -> str:
    return (
        node.axis
        if isinstance(node, Split)
        else node.name
        if isinstance(node, Shape)
        else type(node).__name__
    )


def _pairs(old: list[Node], new: list[Node]) -> Iterator[tuple[Node, Node]]:
    """Parts that are in each other's place: equal ones first, then those of one kind."""
    same = set(old) & set(new)
    yield from ((node, node) for node in new if node in same)
    old, new = ([node for node in nodes if node not in same] for nodes in (old, new))
    matcher = SequenceMatcher(
        None, [_kind(node) for node in old], [_kind(node) for node in new], autojunk=False
    )
    for i, j, count in matcher.get_matching_blocks():
        yield from zip(old[i : i + count], new[j : j + count], strict=True)
