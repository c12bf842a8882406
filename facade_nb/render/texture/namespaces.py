"""The definitions of a grammar's text, by namespace (texture paper, 6)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from ...design.errors import quoted
from .bound import Bound
from .findings import Findings
from .limits import MAX_RULES
from .syntax import Copy, Namespace, RuleText, Setting

__all__ = ["Namespaces", "Space"]


@dataclass(slots=True)
class Space:
    """A namespace: its rules and settings, the values that a copy has changed, and those worked out so far.

    A setting that is at fault has None.
    """

    rules: dict[str, RuleText] = field(default_factory=dict)
    settings: dict[str, Setting] = field(default_factory=dict)
    changed: dict[str, Bound] = field(default_factory=dict)
    known: dict[str, Bound | None] = field(default_factory=dict)


class Namespaces:
    """All namespaces of a text; ``""`` is the one outside of any.

    Attributes
    ----------
    spaces
        Each namespace by its name.
    order
        All rules with the name of their namespace, in file order.
    unread
        Names whose definitions had a fault: who uses them is not told of another one.
    """

    def __init__(self, findings: Findings, unread: frozenset[str]) -> None:
        self.findings, self.unread = findings, unread
        self.spaces: dict[str, Space] = {"": Space()}
        self.order: list[tuple[str, RuleText]] = []

    def collect(self, statements: Iterable[RuleText | Setting | Namespace | Copy]) -> list[Copy]:
        """Sort definitions into their namespaces; copies of namespaces stand where they are written."""
        copies = []
        for statement in statements:
            match statement:
                case Namespace() | Copy():
                    name = statement.name
                    if name in self.spaces:
                        self.findings.note(
                            statement.offset,
                            f"the namespace {quoted(name)} is there already: give this one another",
                        )
                        continue
                    if isinstance(statement, Namespace):
                        self.spaces[name] = Space()
                        for item in statement.items:
                            self._define(name, item)
                    elif (source := self.spaces.get(statement.source)) is None or not statement.source:
                        known = [space for space in self.spaces if space]
                        self.findings.note(
                            statement.source_offset,
                            f"expected a namespace that stands above; found {quoted(statement.source)}"
                            f"{self.findings.hint(statement.source, known)}",
                        )
                        self.unread |= {name}
                    elif len(self.order) + len(source.rules) > MAX_RULES:
                        self.findings.note(statement.offset, f"this copy makes more than {MAX_RULES} rules")
                        self.unread |= {name}
                    else:
                        copy = Space(dict(source.rules), dict(source.settings))
                        self.spaces[name] = copy
                        self.order += [(name, rule) for rule in copy.rules.values()]
                        copies.append(statement)
                case _:
                    self._define("", statement)
        return copies

    def _define(self, space: str, item: RuleText | Setting) -> None:
        home = self.spaces[space]
        there = home.rules.get(item.name) or home.settings.get(item.name)
        if there is not None:
            line = self.findings.line(there.offset)
            self.findings.note(
                item.offset,
                f"{quoted(item.name)} is defined already, on line {line}: give this one another name",
            )
        elif len(self.order) >= MAX_RULES:
            self.findings.note(item.offset, f"expected at most {MAX_RULES} rules")
        elif isinstance(item, Setting):
            home.settings[item.name] = item
        else:
            home.rules[item.name] = item
            self.order.append((space, item))
            names: set[str] = set()
            for i, parameter in enumerate(item.parameters):
                if parameter.name in names:
                    self.findings.note(
                        parameter.offset, f"the parameter {quoted(parameter.name)} is there twice"
                    )
                names.add(parameter.name)
                if parameter.default is None and i and item.parameters[i - 1].default is not None:
                    self.findings.note(
                        parameter.offset,
                        f"expected a default for {quoted(parameter.name)}, since one before it has one",
                    )
