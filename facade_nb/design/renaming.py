"""Renaming: a symbol, a counter or a group has another name everywhere, and the design means what it meant.

Each function makes a new design. Each raises `DesignError` if there is nothing of that name, if the new name is taken,
or if something in the design would then mean something else.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, MutableMapping
from typing import Any, Literal

from .document import read, write
from .errors import DesignError, Fault, listed, nearest, quoted
from .instances import Named, meanings, spell_instance
from .model import AXES, Design
from .names import nfc
from .text import clean_name, counter_fault, spell, spell_counter, symbol_fault

__all__ = ["rename_counter", "rename_group", "rename_symbol"]


def rename_symbol(design: Design, name: str, new: str) -> Design:
    """The design with a symbol under another name: in texts, masks, hidden symbols and keys of shapes, too."""
    name, new = clean_name(name), clean_name(new)
    written = _written(design, counters=False)
    _check(name, new, {**dict.fromkeys(design.symbols), **written}, "symbols", "symbol", symbol_fault(new))
    if name == new:
        return design
    document = write(design)
    _rename_member(document, "symbols", name, new)
    _respell(document, design, name, new, counters=False)
    known = {*design.symbols, *(s for p in design.patterns.values() for s in p.parsed.symbols)}
    renamed = {new if symbol == name else symbol for symbol in known}
    for owner, place in _owners(document):
        if "shapes" in owner:
            owner["shapes"] = _rename_keys(owner["shapes"], place, name, new, known, renamed)
    for owner, field in _lists(document):
        owner[field] = [new if symbol == name else symbol for symbol in owner[field]]
    return read(document)


def rename_counter(design: Design, name: str, new: str) -> Design:
    """The design with a counter under another name, in texts, too."""
    name, new = clean_name(name), clean_name(new)
    written = _written(design, counters=True)
    _check(
        name, new, {**dict.fromkeys(design.counters), **written}, "counters", "counter", counter_fault(new)
    )
    if name == new:
        return design
    document = write(design)
    _rename_member(document, "counters", name, new)
    _respell(document, design, name, new, counters=True)
    return read(document)


def rename_group(design: Design, name: str, new: str) -> Design:
    """The design with an alignment group under another name, on both axes of every layer."""
    name, new = nfc(name), nfc(new)
    groups = dict.fromkeys(layer.along(axis).group for layer in design.layers for axis in AXES)
    _check(name, new, groups, "layers", "group", "" if new.strip() else "a name has at least one character")
    document = write(design)
    for layer in document.get("layers", ()):
        for axis in AXES:
            if layer[axis].get("group", "default") == name:
                layer[axis]["group"] = new
    return read(document)


def _check(name: str, new: str, names: Collection[str], place: str, what: str, fault: str) -> None:
    """Raise unless there is such a name, and the new one can be taken."""
    if name not in names:
        known = listed(names) or "there is none"
        expected = f"expected the name of a {what} ({known}); found {quoted(name)}{nearest(name, names)}"
        raise DesignError(Fault(place, expected))
    if fault:
        raise DesignError(Fault(place, f"expected another name for {what} {quoted(name)}: {fault}"))
    if new != name and new in names:
        raise DesignError(
            Fault(place, f"expected a new name for {what} {quoted(name)}; {quoted(new)} is taken")
        )


def _written(design: Design, *, counters: bool) -> dict[str, None]:
    """The counters, or else the symbols, that stand in texts; substituted ones, too."""
    sites = (site for pattern in design.patterns.values() for site in pattern.parsed.sites)
    return dict.fromkeys(site.name for site in sites if (site.role == "counter") == counters)


def _rename_member(document: MutableMapping[str, Any], section: str, name: str, new: str) -> None:
    members = document.get(section, {})
    if name in members:
        document[section] = {new if key == name else key: member for key, member in members.items()}


def _respell(document: Mapping[str, Any], design: Design, name: str, new: str, *, counters: bool) -> None:
    """Write the new name wherever patterns write the old one."""
    from .grammar import token_ends  # imported here: it brings lark, as in `parse`

    for pattern in design.patterns.values():
        sites = [s for s in pattern.parsed.sites if s.name == name and (s.role == "counter") == counters]
        if not sites:
            continue
        text = pattern.text
        ends = token_ends(text)
        for offset in sorted({site.offset for site in sites}, reverse=True):
            end = ends[offset]
            spelled = spell(new)
            if counters:
                # In braces a minus may stand before the name.
                within = text[offset + 1 : end - 1].lstrip() if text[offset] == "{" else ""
                sign = within[:1] if within[:1] in ("-", "−") else ""
                spelled = f"{{{sign}{new}}}" if sign else spell_counter(new)
            text = text[:offset] + spelled + text[end:]
        member = document["patterns"][pattern.name]
        if isinstance(member, str):
            document["patterns"][pattern.name] = text
        else:
            member["text"] = text


def _owners(document: dict[str, Any]) -> Iterator[tuple[dict[str, Any], str]]:
    """Whatever may have shapes of its own, with its place."""
    yield document, "shapes"
    for name, pattern in document.get("patterns", {}).items():
        if isinstance(pattern, dict):
            yield pattern, f"patterns.{name}.shapes"
    for index, layer in enumerate(document.get("layers", ())):
        yield layer, f"layers.{index}.shapes"


def _lists(document: Mapping[str, Any]) -> Iterator[tuple[dict[str, Any], Literal["hidden", "mask"]]]:
    """Whatever lists symbols, with the field that does."""
    for pattern in document.get("patterns", {}).values():
        if isinstance(pattern, dict) and pattern.get("hidden"):
            yield pattern, "hidden"
    for layer in document.get("layers", ()):
        for axis in AXES:
            if layer[axis].get("mask"):
                yield layer[axis], "mask"


def _rename_keys(
    shapes: Mapping[str, Any], place: str, name: str, new: str, known: set[str], renamed: set[str]
) -> dict[str, Any]:
    """The shapes under keys that mean the same with the new name.

    A key may mean two pairs, where names have blanks, and only one of them may have the name: then it becomes two keys.
    """

    def rename(side: Named) -> Named:
        return (new if side[0] == name else side[0], side[1])

    found: dict[str, Any] = {}
    meant: dict[str, set[tuple[Named, Named]]] = {}
    for key, shape in shapes.items():
        for x, y in meanings(key, known):
            pair = rename(x), rename(y)
            own = " ".join(map(_spelled, pair))
            if found.setdefault(own, shape) != shape:
                raise _ambiguous(place, own, name, new)
            meant.setdefault(own, set()).add(pair)
    for own, pairs in meant.items():
        if set(meanings(own, renamed)) != pairs:
            raise _ambiguous(place, own, name, new)
    return found


def _spelled(side: Named) -> str:
    name, number = side
    return name if number is None else spell_instance(name, number)


def _ambiguous(place: str, key: str, name: str, new: str) -> DesignError:
    message = (
        f"expected a new name for symbol {quoted(name)} with which every key means what it means now; "
        f"with {quoted(new)} the key {quoted(key)} would mean something else, too"
    )
    return DesignError(Fault(place, message))
