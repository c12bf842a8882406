"""Patterns from text: lark's parse tree made a `Pattern`, and the checks that no grammar can make."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from lark import Token, Tree

from .errors import DesignError, listed, nearest, quoted
from .grammar import read_tree, refuse
from .lookalikes import is_foreign
from .modes import MODES, SYNONYMS
from .pattern import Pattern, Site
from .text import clean_name, counter_fault, symbol_fault
from .tree import (
    MAX_LETTERS,
    MAX_WORDS,
    Count,
    Empty,
    Mirror,
    Node,
    Sym,
    alternation,
    concatenation,
    longest,
    too_long,
)

__all__ = ["MAX_DEPTH", "MAX_TEXT", "read_pattern"]

MAX_DEPTH = 50
"""Most levels of nested groups and chained postfix operators in a text."""

MAX_TEXT = 20_000
"""Most characters of a pattern text."""


_Item: TypeAlias = Tree[Token] | Token


def read_pattern(text: str) -> Pattern:
    """The pattern that a text writes. Raises `PatternError` with line, column and a caret if it writes none."""
    if len(text) > MAX_TEXT:
        raise refuse(
            text, MAX_TEXT, f"a pattern's text has at most {MAX_TEXT:,} characters; found {len(text):,}"
        )
    return _Reader(text).pattern()


class _Reader:
    """Makes a `Pattern` of lark's parse tree, notes where names stand, and checks what no grammar can."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.sites: list[Site] = []
        self.counted: dict[
            int, str
        ] = {}  # index of a symbol's site -> the named counter that it stands under

    def pattern(self) -> Pattern:
        control, *rest = read_tree(self.text).children
        node = self.node(control, 0)
        if not rest:
            self.check_length(node, {}, 0)
            return self.checked(Pattern(node, (), self.text, tuple(self.sites)))
        statements = [_two(statement) for statement in rest]
        targets = [self.name(target) for target, _ in statements]
        sites = self._control_sites(targets)
        contents: dict[str, Node] = {}
        for (name, offset), (_, content) in zip(targets, statements, strict=True):
            self.sites.append(Site(name, "substituted", offset))
            start = len(self.sites)
            contents[name] = self.node(content, 0)
            self._check_content(name, start, sites)
        lengths = {name: longest(content, {}) for name, content in contents.items()}
        self.check_length(
            node, lengths, next(site.offset for site in self.sites if site.role == "substituted")
        )
        return self.checked(Pattern(node, tuple(contents.items()), self.text, tuple(self.sites)))

    def checked(self, pattern: Pattern) -> Pattern:
        """The pattern, if it does not have too many words."""
        if pattern.most_ways() > MAX_WORDS:
            try:
                pattern.ways()  # equal ones are counted once
            except DesignError as error:
                raise refuse(self.text, 0, error.faults[0].message) from None
        return pattern

    def _control_sites(self, targets: list[tuple[str, int]]) -> list[Site]:
        """Give the control pattern's sites their roles; each target must stand there and have one content."""
        control = dict.fromkeys(site.name for site in self.sites if site.role == "solid")
        names: set[str] = set()
        for name, offset in targets:
            if name in names:
                raise refuse(
                    self.text, offset, f"{quoted(name)} is already substituted; a symbol has one content"
                )
            if name not in control:
                one_of = listed(control) or "none, it has no symbols"
                raise refuse(
                    self.text,
                    offset,
                    f"expected a symbol of the control pattern ({one_of}); found {quoted(name)}"
                    + nearest(name, control),
                )
            names.add(name)
        for index, site in enumerate(self.sites):
            if site.role == "solid":
                self.sites[index] = site._replace(role="substituted" if site.name in names else "placeholder")
        return list(self.sites)

    def _check_content(self, name: str, start: int, control: list[Site]) -> None:
        """Check the content from site `start` on: no substituted symbols, no counter where the control has one."""
        substituted = {site.name for site in control if site.role == "substituted"}
        for site in self.sites[start:]:
            if site.role == "solid" and site.name in substituted:
                message = (
                    f"the content of {name!r} uses {site.name!r}, which is substituted in this pattern itself"
                )
                raise refuse(self.text, site.offset, f"expected other symbols; {message}")
        inner = next((site for site in self.sites[start:] if site.role == "counter"), None)
        if inner is None:
            return
        for index, site in enumerate(control):
            if site.name == name and index in self.counted:
                message = (
                    f"{name!r} is repeated by counter {self.counted[index]!r}, but its content has counter "
                    f"{inner.name!r}: a counter cannot stand inside a counter"
                )
                raise refuse(self.text, site.offset, message)

    def node(self, item: _Item, depth: int) -> Node:
        """The tree of one item of lark's parse tree, `depth` levels of groups and postfix operators down."""
        if depth > MAX_DEPTH:
            message = (
                f"nested too deeply: at most {MAX_DEPTH} levels of groups and postfix operators are possible"
            )
            raise refuse(self.text, _start(item), message)
        if isinstance(item, Token):
            return self.symbol(item)
        children = item.children
        match item.data:
            case "alternation":
                return alternation([self.node(child, depth) for child in children[::2]])
            case "sequence":
                parts = [
                    child for child in children if not (isinstance(child, Token) and child.type == "DOT")
                ]
                return concatenation([self.node(child, depth) for child in parts])
            case "group":
                return self.node(children[0], depth + 1) if children else Empty()
            case _:
                first = len(self.sites)
                node = self.node(children[0], depth + len(children) - 1)
                for suffix in children[1:]:
                    node = Mirror(node) if isinstance(suffix, Token) else self.count(suffix, node, first)
                return node

    def symbol(self, token: Token) -> Node:
        if token.type == "EPSILON":
            return Empty()
        name, offset = self.name(token)
        self.sites.append(Site(name, "solid", offset))
        return Sym(name)

    def count(self, tree: Tree[Token], body: Node, first: int) -> Node:
        """A count of the body whose sites begin at index `first`."""
        *signs, token = (child for child in tree.children if isinstance(child, Token))
        mode = next((SYNONYMS.get(str(sign), str(sign)) for sign in signs if sign.type != "MINUS"), "")
        negative = any(sign.type == "MINUS" for sign in signs)
        text, offset = str(token), token.start_pos or 0
        if token.type == "BRACED":
            text = clean_name(text[1:-1])
            if text[:1] in ("-", "−"):
                if negative:
                    raise refuse(
                        self.text, offset, "expected one minus sign, before the brace or in it; found two"
                    )
                negative, text = True, text[1:].lstrip()
        if text.isdecimal() and not any(map(is_foreign, text)):
            found = Count(body, mode, negative, self.number(text, offset))
            self.check_length(found, {}, offset)
            return found
        if token.type == "BRACED":
            self.check_counter(text, offset)
        else:
            text, _ = self.name(token)
        for site in self.sites[first:]:
            if site.role == "counter":
                message = (
                    f"counter {site.name!r} stands inside counter {text!r}: expected a number for one of them"
                )
                raise refuse(self.text, site.offset, message)
        self.counted.update(dict.fromkeys(range(first, len(self.sites)), text))
        self.sites.append(Site(text, "counter", offset))
        return Count(body, mode, negative, text)

    def check_counter(self, name: str, offset: int) -> None:
        """Check what stands in braces, which is no number."""
        if not name:
            raise refuse(
                self.text, offset, "expected a number or a counter between '{' and '}'; found nothing"
            )
        fault = counter_fault(name)
        if fault:
            found = "" if name[0] in MODES else f"expected a number or a counter; found {quoted(name)}: "
            raise refuse(self.text, offset, found + fault)

    def check_length(self, node: Node, contents: Mapping[str, int], offset: int) -> None:
        """Refuse words that are too long whatever the counters are."""
        letters = longest(node, contents)
        if letters > MAX_LETTERS:
            raise refuse(self.text, offset, too_long(letters))

    def number(self, digits: str, offset: int) -> int:
        digits = digits.lstrip("0")
        if len(digits) > len(str(MAX_LETTERS)) or int(digits or "0") > MAX_LETTERS:
            raise refuse(
                self.text, offset, f"expected a count of at most {MAX_LETTERS:,}; found {digits[:12]}"
            )
        return int(digits or "0")

    def name(self, token: Token) -> tuple[str, int]:
        """The name that a token of a symbol or a counter writes, and its offset."""
        text, offset = str(token), token.start_pos or 0
        if token.type == "LONG":
            name = clean_name(text[1:-1])
            fault = symbol_fault(name)
            if fault:
                raise refuse(self.text, offset, f"expected a name between '<' and '>': {fault}")
            return name, offset
        return clean_name(text), offset


def _two(statement: _Item) -> tuple[Token, _Item]:
    """Target and content of a substitution."""
    assert isinstance(statement, Tree)
    target, content = statement.children
    assert isinstance(target, Token)
    return target, content


def _start(item: _Item) -> int:
    """Offset of the first token of a tree; not recursive, for it is asked of trees that are too deep."""
    while isinstance(item, Tree):
        if not item.children:
            return 0
        item = item.children[0]
    return item.start_pos or 0
