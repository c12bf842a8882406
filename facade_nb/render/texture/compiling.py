"""From statements to rules: names are looked up, namespaces and rules with parameters are copied (texture paper, 6).

The evaluators know nothing of parameters. A rule that is used with two different arguments becomes two rules; a
namespace that is copied becomes a second set of rules.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from math import isfinite

from ...design.errors import Fault, cut, quoted
from .bound import Bound, Key, Word, checked, plain, told
from .findings import Findings
from .limits import MAX_PARTS, MAX_RULES
from .namespaces import Namespaces
from .operators import OPERATORS, POLICIES, USAGES, Kind, Operator, Param
from .program import Rule, Source, Value
from .syntax import (
    Binary,
    Copy,
    Expression,
    Name,
    Number,
    Parameter,
    RuleText,
    Tile,
    read,
)

__all__ = ["Compiled", "compile_text"]

_MAX_COPIES = 64  # of one rule inside each other
_MAX_NESTED = 100  # values that another value needs, one inside the other
_MAX_NAME = 120  # characters of the name of a copy


@dataclass(frozen=True, slots=True)
class _Scope:
    """Where a name is looked up: parameters of the rule first, then settings of its namespace, then global ones."""

    space: str
    parameters: Mapping[str, Bound] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Compiled:
    """What a text was compiled into.

    Attributes
    ----------
    rules
        In file order; copies with other arguments follow at the end.
    places
        For each rule, where in the text the rule, its operator, and every value of it stand.
    tiles
        Every tile that is named, with its offset, also where its rule has a fault.
    faults
        All that were found, in the order of the text.
    """

    rules: tuple[Rule, ...]
    places: tuple[Places, ...]
    tiles: tuple[tuple[int, str], ...]
    faults: tuple[tuple[int, Fault], ...]


@dataclass(frozen=True, slots=True)
class Places:
    """Offsets in the text of a rule, its operator, and its values in the order written."""

    rule: int
    operator: int
    values: tuple[int, ...] = ()


def compile_text(text: str) -> Compiled:
    """Compile a grammar's text. Faults are returned, not raised."""
    return _Compiler(text).run()


class _Compiler:
    def __init__(self, text: str) -> None:
        self.findings = Findings(text)
        reading = read(text)
        for offset, message in reading.faults:
            self.findings.note(offset, message)
        self.statements = reading.statements
        self.definitions = Namespaces(self.findings, reading.unread)
        self.spaces, self.order = self.definitions.spaces, self.definitions.order
        self.slots: dict[tuple[str, str], int] = {}  # where a rule stands in file order
        self.keys: dict[tuple[str, str, tuple[object, ...]], Key] = {}
        self.index: dict[Key, int] = {}
        self.defaults: dict[tuple[str, int], Bound | None] = {}
        self.spelled: dict[Key, str] = {}
        self.nested = 0
        self.working: set[tuple[str, int]] = set()
        self.rules: list[Rule | None] = []
        self.places: list[Places | None] = []
        self.waiting: deque[tuple[Key, int]] = deque()
        self.taken: set[int] = set()
        self.tiles: set[tuple[int, str]] = set()
        self.depth: dict[Key, int] = {}  # how many copies of rules stand around a copy
        self.here = 0
        self.settling: set[tuple[str, str]] = set()

    def run(self) -> Compiled:
        copies = self.definitions.collect(self.statements)
        for space, rule in self.order:
            self.slots[space, rule.name] = len(self.rules)
            self.rules.append(None)
            self.places.append(None)
        self._change(copies)
        for name in ("", *(name for name in self.spaces if name)):
            for setting in self.spaces[name].settings.values():
                self._setting(name, setting.name, setting.offset)
        for space, rule in self.order:
            if all(parameter.default is not None for parameter in rule.parameters):
                self._use(Name(rule.name, rule.offset, space), _Scope(space), depth=0)
        self._work()
        if not self.order and not self.findings:
            self.findings.note(0, "expected at least one rule, such as S -> Mat(Color, 0, 1, 1, 1, 1)")
        return self._finished()

    def _finished(self) -> Compiled:
        """Drop rules with parameters that nobody uses, and number the others."""
        kept = [i for i, rule in enumerate(self.rules) if rule is not None]
        number = {old: new for new, old in enumerate(kept)}
        rules = []
        for i in kept:
            rule = self.rules[i]
            if rule is not None:
                rules.append(_renumbered(rule, number))
        places = tuple(place for place in self.places if place is not None)
        return Compiled(tuple(rules), places, tuple(sorted(self.tiles)), tuple(self.findings.in_order()))

    def _change(self, copies: Iterable[Copy]) -> None:
        """Set what copies of namespaces change; a copy of a copy has the changes of both."""
        for copy in copies:
            space = self.spaces[copy.name]
            space.changed |= self.spaces[copy.source].changed
            seen: set[str] = set()
            for argument in copy.arguments:
                if argument.name not in space.settings:
                    self.findings.note(
                        argument.offset,
                        f"the namespace {quoted(copy.source)} has no setting {quoted(argument.name)}"
                        f"{self.findings.hint(argument.name, space.settings)}",
                    )
                    continue
                if argument.name in seen:
                    self.findings.note(argument.offset, f"the setting {quoted(argument.name)} is there twice")
                seen.add(argument.name)
                value = self._value(argument.value, _Scope(""))
                if value is not None:
                    space.changed[argument.name] = value

    # Values -----------------------------------------------------------------------------------------------

    def _setting(self, space: str, name: str, offset: int) -> Bound | None:
        """The value of a setting: looked up in its namespace; settings may use each other, but not in a circle.

        What a setting uses is worked out before it, so that no chain of them, however long, is a depth of calls.
        """
        home = self.spaces[space]
        if name in home.changed:
            return home.changed[name]
        if name in home.known:
            return home.known[name]
        if (space, name) in self.settling:
            self.findings.note(offset, f"the setting {quoted(name)} needs itself for its own value")
            return None
        waiting = [(space, name, False)]
        begun: set[tuple[str, str]] = set()
        while waiting:
            where, what, ready = waiting.pop()
            home = self.spaces[where]
            if what in home.changed or what in home.known or (where, what) in self.settling:
                continue
            value = home.settings[what].value
            if ready:
                self.settling.add((where, what))
                home.known[what] = self._value(value, _Scope(where))
                self.settling.discard((where, what))
            elif (where, what) in begun:
                continue  # a circle: the one that is waiting finds it
            else:
                begun.add((where, what))
                waiting.append((where, what, True))
                waiting += [(*used, False) for used in self._used(value, where)]
        return self.spaces[space].known[name]

    def _used(self, value: Expression, space: str) -> Iterator[tuple[str, str]]:
        """The settings that an expression names."""
        waiting = [value]
        while waiting:
            match waiting.pop():
                case Binary(left=left, right=right):
                    waiting += [left, right]
                case Name(text=text, space="", arguments=None):
                    home = next((s for s in (space, "") if text in self.spaces[s].settings), None)
                    if home is not None:
                        yield home, text
                case Name(arguments=arguments):
                    waiting += [argument.value for argument in arguments or ()]

    def _value(self, expression: Expression, scope: _Scope) -> Bound | None:
        """What an expression stands for; None after a fault."""
        if self.nested >= _MAX_NESTED:
            self.findings.note(
                expression.offset, f"this value is needed by more than {_MAX_NESTED} others in a row"
            )
            return None
        self.nested += 1
        try:
            return self._made(expression, scope)
        finally:
            self.nested -= 1

    def _made(self, expression: Expression, scope: _Scope) -> Bound | None:
        match expression:
            case Number(value=value, text=text):
                if text:
                    self.findings.note(
                        expression.offset, f"expected a number that can be calculated with; found {cut(text)}"
                    )
                    return None
                return value
            case Tile(mode=mode, name=name):
                self.tiles.add((expression.offset, name))
                return Source(mode, name)
            case Binary():
                return self._binary(expression, scope)
            case Name():
                bound = self._bound(expression, scope)
                if bound is not None:
                    return bound
                if expression.text in (*POLICIES, *USAGES) and not self._is_rule(expression, scope):
                    return Word(expression.text)
                return self._use(expression, scope)

    def _binary(self, expression: Binary, scope: _Scope) -> float | None:
        """A sum or a product: of however many numbers, from the left."""
        chain = [expression]
        while isinstance(left := chain[-1].left, Binary):
            chain.append(left)
        value = self._number(chain[-1].left, scope)
        for step in reversed(chain):
            right = None if value is None else self._number(step.right, scope)
            if value is None or right is None:
                return None
            if step.sign == "/" and right == 0:
                self.findings.note(step.right.offset, "expected a divisor other than 0")
                return None
            match step.sign:
                case "+":
                    value += right
                case "-":
                    value -= right
                case "±":
                    value = -right
                case "*":
                    value *= right
                case _:
                    value /= right
            if not isfinite(value):
                self.findings.note(
                    step.offset, "expected a result that can be calculated with; it is too large"
                )
                return None
        return value

    def _number(self, expression: Expression, scope: _Scope) -> float | None:
        value = self._value(expression, scope)
        if value is None or isinstance(value, float):
            return value
        self.findings.note(expression.offset, f"expected a number to calculate with; found {told(value)}")
        return None

    def _is_rule(self, name: Name, scope: _Scope) -> bool:
        return name.text in self.spaces[scope.space].rules or name.text in self.spaces[""].rules

    def _bound(self, name: Name, scope: _Scope) -> Bound | None:
        """The value of the parameter or setting that a name stands for; None if it stands for neither."""
        if name.space or name.arguments is not None:
            return None
        if name.text in scope.parameters:
            return scope.parameters[name.text]
        for space in dict.fromkeys((scope.space, "")):
            if name.text in self.spaces[space].settings:
                return self._setting(space, name.text, name.offset)
        return None

    # Rules ------------------------------------------------------------------------------------------------

    def _use(self, name: Name, scope: _Scope, depth: int | None = None) -> Key | None:
        """The copy of a rule that a name asks for, made where it is new; None after a fault."""
        found = self._find(name, scope)
        if found is None:
            return None
        space, rule = found
        given = self._given(name, space, rule, scope)
        if given is None:
            return None
        key = self.keys.setdefault((space, rule.name, given), Key(space, rule.name, given))
        if key not in self.index:
            below = depth if depth is not None else self.here + 1
            if len(self.rules) >= MAX_RULES or below > _MAX_COPIES:
                self.findings.note(
                    name.offset,
                    f"{quoted(name)} makes copies of itself without end"
                    if below > _MAX_COPIES
                    else f"{quoted(name)} makes more than {MAX_RULES} rules",
                )
                return None
            slot = self.slots[space, rule.name]
            if slot in self.taken:
                slot = len(self.rules)
                self.rules.append(None)
                self.places.append(None)
            self.taken.add(slot)
            self.index[key] = slot
            self.depth[key] = below if rule.parameters else 0
            self.waiting.append((key, slot))
        return key

    def _find(self, name: Name, scope: _Scope) -> tuple[str, RuleText] | None:
        if name.space:
            if name.space not in self.spaces:
                if name.space not in self.definitions.unread:
                    known = [space for space in self.spaces if space]
                    self.findings.note(
                        name.offset,
                        f"there is no namespace {quoted(name.space)}{self.findings.hint(name.space, known)}",
                    )
                return None
            places: tuple[str, ...] = (name.space,)
        else:
            places = (scope.space, "")
        for space in places:
            if name.text in self.spaces[space].rules:
                return space, self.spaces[space].rules[name.text]
        settings = any(name.text in self.spaces[space].settings for space in places)
        if settings and not name.space:
            if name.arguments is not None:
                self.findings.note(
                    name.offset, f"{quoted(name.text)} is a setting: it takes no values in parentheses"
                )
            return None  # else its value has had a fault of its own
        if name.text not in self.definitions.unread:
            hint = self.findings.hint(name.text, self._known(name, scope, places))
            if not hint and name.text in OPERATORS:
                hint = f"; {name.text!r} is an operator: give a rule of that name, such as Skip -> Skip(0)"
            self.findings.note(name.offset, f"there is no rule {quoted(name)}{hint}")
        return None

    def _known(self, name: Name, scope: _Scope, places: Iterable[str]) -> Iterator[str]:
        """Names that could stand where one is unknown."""
        for space in dict.fromkeys(places):
            yield from self.spaces[space].rules
        if not name.space:
            yield from scope.parameters
            yield from self.spaces[scope.space].settings

    def _given(self, name: Name, space: str, rule: RuleText, scope: _Scope) -> tuple[Bound, ...] | None:
        """The values of a rule's parameters: as given, else the defaults."""
        given: dict[str, Bound | None] = {}
        names = {parameter.name: k for k, parameter in enumerate(rule.parameters)}
        order = tuple(names)
        place = 0
        for argument in name.arguments or ():
            to = argument.name or (order[place] if place < len(order) else "")
            place += not argument.name
            if argument.name and argument.name not in names:
                self.findings.note(
                    argument.offset,
                    f"the rule {quoted(rule.name)} has no parameter {quoted(argument.name)}"
                    f"{self.findings.hint(argument.name, names)}",
                )
            elif not to:
                has = f"{len(names)} parameter{'s' * (len(names) != 1)}" if names else "no parameters"
                self.findings.note(
                    argument.offset,
                    f"the rule {quoted(rule.name)} has {has}; found {len(name.arguments or ())}",
                )
                return None
            elif to in given:
                self.findings.note(argument.offset, f"the parameter {quoted(to)} is given twice")
            else:
                given[to] = self._value(argument.value, scope)
        values = []
        for parameter in rule.parameters:
            value = (
                given[parameter.name]
                if parameter.name in given
                else self._default(name, space, rule, parameter)
            )
            if value is None:
                return None
            values.append(value)
        return tuple(values)

    def _default(self, name: Name, space: str, rule: RuleText, parameter: Parameter) -> Bound | None:
        if parameter.default is None:
            self.findings.note(
                name.offset,
                f"the rule {quoted(rule.name)} needs a value for its parameter {quoted(parameter.name)}",
            )
            return None
        return self._worked_out(space, parameter.default)

    def _worked_out(self, space: str, default: Expression) -> Bound | None:
        """The value of a default, which is worked out once."""
        place = (space, default.offset)
        if place in self.working:
            self.findings.note(default.offset, "this default needs itself for its own value")
            return None
        if place not in self.defaults:
            self.working.add(place)
            self.defaults[place] = self._value(default, _Scope(space))
            self.working.discard(place)
        return self.defaults[place]

    def _work(self) -> None:
        """Make every copy that is asked for, and those that they ask for."""
        while self.waiting:
            key, slot = self.waiting.popleft()
            self.here = self.depth[key]
            rule = self.spaces[key.space].rules[key.name]
            names = (parameter.name for parameter in rule.parameters)
            scope = _Scope(key.space, dict(zip(names, key.given, strict=True)))
            made = self._rule(self._spelled(key), rule, scope)
            self.rules[slot], self.places[slot] = made

    def _spelled(self, key: Key) -> str:
        """A copy's name: arguments are named where they are not the defaults."""
        if key in self.spelled:
            return self.spelled[key]
        said = []
        for parameter, value in zip(
            self.spaces[key.space].rules[key.name].parameters, key.given, strict=True
        ):
            if parameter.default is None or value != self._worked_out(key.space, parameter.default):
                text = self._spelled(value) if isinstance(value, Key) else plain(value)
                said.append(f"{parameter.name}={text}")
        name = f"{key.space}.{key.name}" if key.space else key.name
        self.spelled[key] = f"{name}({cut(', '.join(said), _MAX_NAME)})" if said else name
        return self.spelled[key]

    def _rule(self, name: str, rule: RuleText, scope: _Scope) -> tuple[Rule | None, Places | None]:
        operator = OPERATORS.get(rule.operator)
        if operator is None:
            hint = self.findings.hint(rule.operator, OPERATORS)
            if any(rule.operator in self.spaces[space].rules for space in (scope.space, "")):
                short = cut(rule.operator)
                hint = f"; {short!r} is a rule: write Layer({short}) to go on with it alone"
            self.findings.note(rule.operator_offset, f"there is no operator {quoted(rule.operator)}{hint}")
            for argument in rule.arguments:  # so that faults in it are found as well
                if isinstance(argument, Name) and argument.text not in (*POLICIES, *USAGES):
                    self._value(argument, scope)
            return None, None
        params = self._params(operator, rule)
        if params is None:
            return None, None
        values = [
            self._argument(param, argument, scope)
            for param, argument in zip(params, rule.arguments, strict=True)
        ]
        if any(value is None for value in values):
            return None, None
        whole = [value for value in values if value is not None]
        fixed, size = len(operator.fixed), len(operator.part)
        parts = [tuple(whole[i : i + size]) for i in range(fixed, len(whole), size)] if size else []
        places = Places(
            rule.offset, rule.operator_offset, tuple(argument.offset for argument in rule.arguments)
        )
        return Rule(name, operator, tuple(whole[:fixed]), tuple(parts)), places

    def _params(self, operator: Operator, rule: RuleText) -> list[Param] | None:
        """What each argument is for; None, after a fault, if there are too few or too many."""
        count, fixed, size = len(rule.arguments), len(operator.fixed), len(operator.part)
        further = count - fixed
        if size and further // size > MAX_PARTS:
            self.findings.note(
                rule.operator_offset, f"expected at most {MAX_PARTS} parts; found {further // size}"
            )
            return None
        if (not size and not further) or (size and further >= size and further % size == 0):
            return [*operator.fixed, *(operator.part * (further // size if size else 0))]
        if not size:
            wanted = f"{fixed} value{'s' * (fixed != 1)}"
        elif size == 1:
            wanted = f"{f'{fixed} value, then ' if fixed else ''}one rule or more"
        else:
            names = ", ".join(param.kind.value for param in operator.part)
            wanted = f"{f'{fixed} value, then ' if fixed else ''}{size} values for each part ({names})"
        self.findings.note(
            rule.operator_offset,
            f"{operator.signature} takes {wanted}; found {count}",
        )
        return None

    def _argument(self, param: Param, argument: Expression, scope: _Scope) -> Value | None:
        """The value of one argument, as its kind asks; None after a fault."""
        if param.kind is Kind.RULE and isinstance(argument, Name) and self._bound(argument, scope) is None:
            key = self._use(argument, scope)
            return (
                -1 if key is None else self.index[key]
            )  # its fault is noted: the other values are looked at
        words = {Kind.POLICY: POLICIES, Kind.USAGE: USAGES}.get(param.kind)
        if words is not None and isinstance(argument, Name) and self._bound(argument, scope) is None:
            if argument.text not in words or argument.space or argument.arguments is not None:
                self.findings.note(
                    argument.offset,
                    f"expected {param.kind.value}; found {quoted(argument)}{self.findings.hint(argument.text, words)}",
                )
                return None
            return words[argument.text]
        value = self._value(argument, scope)
        if value is None:
            return None
        made, problem = checked(param, value, self.index)
        if problem:
            self.findings.note(argument.offset, f"expected {problem}; found {told(value)}")
        return made


def _renumbered(rule: Rule, number: Mapping[int, int]) -> Rule:
    """The rule with other indices of rules; a rule that could not be made has had its fault."""

    def new(params: tuple[Param, ...], values: tuple[Value, ...]) -> tuple[Value, ...]:
        return tuple(
            number.get(int(value), -1) if param.kind is Kind.RULE and not isinstance(value, Source) else value
            for param, value in zip(params, values, strict=True)
        )

    operator = rule.operator
    return Rule(
        rule.name,
        operator,
        new(operator.fixed, rule.fixed),
        tuple(new(operator.part, part) for part in rule.parts),
    )
