"""The language of texture grammars: from text to statements (the texture paper's 3 and Figure 12; docs/texture.md).

    namespace office {
      width = 1.2                                   # a setting: a parameter of the namespace, with its default
      S -> RepeatX(2.5, Window)
      Window -> SplitX(Rel, 1, Skip, Abs, width, Pane(Fit:window1), Rel, 1, Skip)
    }
    namespace bank = office(width = 1.8)            // all its rules once more, with another width
    S -> SplitY(Abs, 4, bank.S, Rel, 1, office.S)
    Pane(tile, part = 1.0) -> Mat(Color, tile, 0, 0, 1, part)
    Skip -> Skip(0);

A statement that cannot be read is reported and left out, so that the faults of the others are found in the same go.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from lark import Lark, Token, Transformer
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from ...design.errors import Fault
from ...design.grammar import show
from ...design.text import fault_at

__all__ = [
    "Argument",
    "Binary",
    "Copy",
    "Expression",
    "Name",
    "Namespace",
    "Number",
    "Parameter",
    "Reading",
    "RuleText",
    "Setting",
    "Tile",
    "read",
]

_GRAMMAR = r"""
start: (rule | setting | namespace | copy)*
namespace: NAMESPACE NAME "{" (rule | setting)* "}" _end
copy: NAMESPACE NAME "=" NAME [named] _end
setting: NAME "=" expression _end
rule: NAME parameters ARROW NAME arguments _end
_end: ";"*

parameters: ["(" [parameter ("," parameter)*] ")"]
parameter: NAME ["=" expression]
arguments: "(" [expression ("," expression)* ","?] ")"
named: "(" [argument ("," argument)* ","?] ")"
argument: NAME "=" expression
given: "(" [(argument | expression) ("," (argument | expression))* ","?] ")"

?expression: product | expression PLUS product -> binary | expression MINUS product -> binary
?product: factor | product TIMES factor -> binary | product OVER factor -> binary
?factor: MINUS factor -> negative | PLUS factor -> positive | atom
?atom: NUMBER -> number | TILE -> tile | reference | "(" expression ")" -> inner
reference: NAME ["." NAME] [given]

NAMESPACE.2: /namespace(?=\s+[^\W\d])/
TILE.3: /(?:Fit|Rep)[^\S\r\n]*[:>][^\S\r\n]*\w(?:[\w.\-]*\w)?/
NUMBER: /(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?/
NAME: /[^\W\d]\w*/
ARROW.2: "->" | "→"
PLUS: "+"
MINUS: "-" | "−"
TIMES: "*"
OVER: "/"
%ignore /\s+/
%ignore /(?:#|\/\/)[^\r\n]*/
"""

_STATEMENT = re.compile(
    r"^[^\S\r\n]*(?:namespace\s+)?([^\W\d]\w*)[^\S\r\n]*(?:\([^()\r\n]*\)[^\S\r\n]*)?(?:->|→|=|\{)",
    re.MULTILINE,
)
_LONG = 400_000  # characters
_MANY = 40  # statements that cannot be read: then this is some other text


@dataclass(frozen=True, slots=True)
class Number:
    """A number as written."""

    value: float
    offset: int


@dataclass(frozen=True, slots=True)
class Tile:
    """``Fit:name`` or ``Rep:name``."""

    mode: str
    name: str
    offset: int


@dataclass(frozen=True, slots=True)
class Name:
    """A name: of a rule, perhaps of a namespace and with arguments, of a parameter, or a constant such as Abs."""

    text: str
    offset: int
    space: str = ""
    arguments: tuple[Argument, ...] | None = None

    def __str__(self) -> str:
        return f"{self.space}.{self.text}" if self.space else self.text


@dataclass(frozen=True, slots=True)
class Binary:
    """``left + right`` and the like; a minus sign alone is ``0 - right``."""

    sign: str
    left: Expression
    right: Expression
    offset: int


Expression = Number | Tile | Name | Binary


@dataclass(frozen=True, slots=True)
class Argument:
    """What a parameter is given: by its name, or (empty) by its place."""

    name: str
    value: Expression
    offset: int


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter of a rule, with its default."""

    name: str
    default: Expression | None
    offset: int


@dataclass(frozen=True, slots=True)
class RuleText:
    """``Rule(parameters) -> Operator(arguments)``."""

    name: str
    parameters: tuple[Parameter, ...]
    operator: str
    operator_offset: int
    arguments: tuple[Expression, ...]
    offset: int


@dataclass(frozen=True, slots=True)
class Setting:
    """``name = value``: a parameter of the grammar, or of the namespace it stands in."""

    name: str
    value: Expression
    offset: int


@dataclass(frozen=True, slots=True)
class Namespace:
    """``namespace name { … }``."""

    name: str
    items: tuple[RuleText | Setting, ...]
    offset: int


@dataclass(frozen=True, slots=True)
class Copy:
    """``namespace name = source(setting = value, …)``."""

    name: str
    source: str
    source_offset: int
    arguments: tuple[Argument, ...]
    offset: int


@dataclass(frozen=True, slots=True)
class Reading:
    """What was read.

    Attributes
    ----------
    statements
        Those that could be read, in file order.
    faults
        One for each that could not, with its offset in the text.
    unread
        Names that the others may have defined: that they are missing is no further fault.
    """

    statements: tuple[RuleText | Setting | Namespace | Copy, ...]
    faults: tuple[tuple[int, Fault], ...]
    unread: frozenset[str]


@lru_cache(maxsize=1)
def _parser() -> Lark:
    return Lark(_GRAMMAR, parser="lalr", lexer="basic", maybe_placeholders=True)


def read(text: str) -> Reading:
    """Read a grammar's text, statement by statement."""
    if len(text) > _LONG:
        fault = fault_at(text, 0, f"expected at most {_LONG} characters; found {len(text)}")
        return Reading((), ((0, fault),), frozenset())
    faults: list[tuple[int, Fault]] = []
    unread: set[str] = set()
    left = text
    while True:
        try:
            tree = _parser().parse(left)
            break
        except UnexpectedInput as error:
            fault, offset = _explain(left, error)
            faults.append((offset, fault))
            start, end, names = _statement(left, offset)
            unread |= names
            if end <= start or len(faults) >= _MANY:
                return Reading((), tuple(faults), frozenset(unread))
            left = left[:start] + re.sub(r"[^\r\n]", " ", left[start:end]) + left[end:]
    try:
        statements = tuple(_Build().transform(tree))
    except RecursionError:
        faults.append((0, fault_at(text, 0, "a value in this grammar is nested too deeply to be read")))
        statements = ()
    return Reading(statements, tuple(faults), frozenset(unread))


def _statement(text: str, offset: int) -> tuple[int, int, set[str]]:
    """The stretch of text, around a place, that is left out, and the names that it may define."""
    heads = list(_STATEMENT.finditer(text))
    before = [head for head in heads if head.start() <= offset]
    start = before[-1].start() if before else 0
    after = [head for head in heads if head.start() > max(offset, start)]
    end = after[0].start() if after else len(text)
    piece = text[start:end]
    brace = piece.find("}", max(0, offset - start))
    if (
        brace >= 0
        and (before and "{" not in piece[:brace])
        and text[:start].count("{") > text[:start].count("}")
    ):
        end = start + brace  # the end of the namespace that the statement stands in is kept
        if end <= offset:
            end = max(end, offset + 1)
    return (
        start,
        end,
        {head[1] for head in before[-1:]} | {head[1] for head in heads if start < head.start() < end},
    )


def _explain(text: str, error: UnexpectedInput) -> tuple[Fault, int]:
    """What stands where something else was expected, and a place in the statement that is to blame."""
    accepted: set[str] = set(getattr(error, "accepts", None) or ())
    if isinstance(error, UnexpectedCharacters):
        offset = error.pos_in_stream or 0
        found = text[offset]
    elif isinstance(error, UnexpectedToken) and error.token.type != "$END":
        offset, found = error.token.start_pos or 0, str(error.token)
    else:
        offset, found = len(text.rstrip()), ""
    unclosed = _unclosed(text, offset)
    if unclosed is not None:
        return fault_at(text, unclosed, "this '(' is not closed: expected ')' before the next rule"), unclosed
    if text.startswith("...", offset) or found == "…":
        message = "'...' stands for what has been left out: write it out, or leave it away"
        return fault_at(text, offset, message), offset
    what = show(found) if found else "the end of the text"
    if any(head.start(1) == offset for head in _STATEMENT.finditer(text)) and text[:offset].strip():
        what = f"the next rule, {found!r}"
        offset = len(text[:offset].rstrip())
    hint = _HINTS.get(found, "")
    return fault_at(text, offset, f"expected {_expected(accepted, error)}; found {what}{hint}"), max(
        offset - 1, 0
    )


def _unclosed(text: str, offset: int) -> int | None:
    """The parenthesis that the statement before the one at `offset` has left open, if it has."""
    heads = [head for head in _STATEMENT.finditer(text) if head.start() <= offset]
    if len(heads) < 2 or offset > heads[-1].end():
        return None
    start, end = heads[-2].start(), heads[-1].start()
    piece = re.sub(r"(?:#|//)[^\r\n]*", lambda comment: " " * len(comment[0]), text[start:end])
    opened: list[int] = []
    for place, character in enumerate(piece, start):
        if character == "(":
            opened.append(place)
        elif character == ")" and opened:
            opened.pop()
    return opened[-1] if opened else None


_HINTS = {
    ":": "; a tile is written Fit:name or Rep:name",
    ">": "; a tile is written Fit:name or Rep:name",
    "[": "; parameters stand in ( )",
    "]": "; parameters stand in ( )",
    '"': "; names stand without quotation marks",
    "'": "; names stand without quotation marks",
}
_WORDS = {
    "NAME": "a name",
    "NUMBER": "a number",
    "TILE": "Fit:tile or Rep:tile",
    "ARROW": "'->'",
    "LPAR": "'('",
    "RPAR": "')'",
    "COMMA": "','",
    "EQUAL": "'='",
    "DOT": "'.'",
    "LBRACE": "'{'",
    "RBRACE": "'}'",
    "$END": "the end",
}


def _expected(accepted: set[str], error: UnexpectedInput) -> str:
    if isinstance(error, UnexpectedCharacters):
        return "a rule, such as Wall -> Mat(Color, Rep:wall1, 0, 0, 1, 1), or a part of one"
    if {"NUMBER", "TILE", "NAME"} <= accepted:
        words = ["a number, a name, or Fit:tile"]
        if "RPAR" in accepted:
            words.append("')'")
    elif "NAME" in accepted and "$END" in accepted:
        words = ["a rule, such as Wall -> Mat(Color, Rep:wall1, 0, 0, 1, 1)"]
    else:
        words = [word for kind, word in _WORDS.items() if kind in accepted]
    return " or ".join(words) or "a rule"


class _Build(Transformer[Token, Any]):
    """From lark's tree to statements."""

    def start(self, items: list[Any]) -> list[Any]:
        return items

    def rule(self, items: list[Any]) -> RuleText:
        name, parameters, _, operator, arguments = items
        return RuleText(
            str(name), parameters, str(operator), operator.start_pos or 0, arguments, name.start_pos or 0
        )

    def setting(self, items: list[Any]) -> Setting:
        return Setting(str(items[0]), items[1], items[0].start_pos or 0)

    def namespace(self, items: list[Any]) -> Namespace:
        return Namespace(str(items[1]), tuple(items[2:]), items[1].start_pos or 0)

    def copy(self, items: list[Any]) -> Copy:
        _, name, source, arguments = items
        return Copy(str(name), str(source), source.start_pos or 0, arguments or (), name.start_pos or 0)

    def parameters(self, items: list[Any]) -> tuple[Parameter, ...]:
        return tuple(item for item in items if item is not None)

    def parameter(self, items: list[Any]) -> Parameter:
        return Parameter(str(items[0]), items[1], items[0].start_pos or 0)

    def arguments(self, items: list[Any]) -> tuple[Expression, ...]:
        return tuple(item for item in items if item is not None)

    def named(self, items: list[Any]) -> tuple[Argument, ...]:
        return tuple(item for item in items if item is not None)

    def argument(self, items: list[Any]) -> Argument:
        return Argument(str(items[0]), items[1], items[0].start_pos or 0)

    def given(self, items: list[Any]) -> tuple[Argument, ...]:
        values = (item for item in items if item is not None)
        return tuple(v if isinstance(v, Argument) else Argument("", v, v.offset) for v in values)

    def binary(self, items: list[Any]) -> Binary:
        left, sign, right = items
        return Binary(str(sign).replace("−", "-"), left, right, left.offset)

    def negative(self, items: list[Any]) -> Expression:
        sign, value = items
        if isinstance(value, Number):
            return Number(-value.value, sign.start_pos or 0)
        return Binary("-", Number(0.0, sign.start_pos or 0), value, sign.start_pos or 0)

    def positive(self, items: list[Any]) -> Expression:
        value: Expression = items[1]
        return value

    def inner(self, items: list[Any]) -> Expression:
        value: Expression = items[0]
        return value

    def number(self, items: list[Any]) -> Number:
        return Number(float(items[0]), items[0].start_pos or 0)

    def tile(self, items: list[Any]) -> Tile:
        mode, name = re.split(r"\s*[:>]\s*", str(items[0]), maxsplit=1)
        return Tile(mode, name, items[0].start_pos or 0)

    def reference(self, items: list[Any]) -> Name:
        first, second, given = items
        if second is None:
            return Name(str(first), first.start_pos or 0, "", given)
        return Name(str(second), first.start_pos or 0, str(first), given)
