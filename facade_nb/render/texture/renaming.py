"""Names of a grammar with something added to them, so that it can stand in one text with other grammars."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

from .syntax import Copy, Namespace, RuleText, Setting, read, tokens_of

__all__ = ["renamed", "renamed_rule"]


@lru_cache(maxsize=32)
def renamed(text: str, ending: str) -> str:
    """The grammar with an ending to every name that it gives: of rules, settings and namespaces at its top level.

    A name is renamed wherever it stands, within namespaces and as a parameter, too: what was one name is one name.
    Operators and tiles stay as they are.

    Parameters
    ----------
    text
        A grammar without faults.
    ending
        What none of its names ends with.
    """
    given, text = _given(text), text.removeprefix("\ufeff")
    parts, at, before = list[str](), 0, ""
    for kind, name, start in tokens_of(text):
        if kind == "NAME" and name in given and before != "ARROW":
            parts += [text[at:start], name, ending]
            at = start + len(name)
        before = kind
    return "".join([*parts, text[at:]])


def renamed_rule(text: str, rule: str, ending: str) -> str:
    """What a rule of the grammar, such as ``office.Window``, is called then."""
    given = _given(text)
    return ".".join(name + ending if name in given else name for name in rule.split("."))


@lru_cache(maxsize=32)
def _given(text: str) -> frozenset[str]:
    return frozenset(_names(text))


def _names(text: str) -> Iterator[str]:
    for statement in read(text).statements:
        if isinstance(statement, RuleText | Setting | Namespace | Copy):
            yield statement.name
