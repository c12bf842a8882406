"""Events as plain data and back: the trace document (``docs/trace.md``)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from math import isfinite
from types import NoneType, UnionType
from typing import Any, ClassVar, Union, get_args, get_origin, get_type_hints

from ...design.errors import DesignError, Fault, nearest
from ..events import Event

__all__ = ["FORMAT", "from_plain", "to_plain"]

FORMAT = "facade-nb/trace/1"

_Read = Callable[[Any, str], Any]


def to_plain(event: Event) -> dict[str, Any]:
    """Return an event as JSON has it: its kind under ``event``, then its fields; sequences become lists."""
    return {"event": type(event).__name__, **{f.name: _plain(getattr(event, f.name)) for f in fields(event)}}


def _plain(value: Any) -> Any:
    if isinstance(value, (str, int, float, NoneType)):
        return value
    if isinstance(value, (tuple, list)):
        return [_plain(own) for own in value]
    if isinstance(value, Mapping):
        return {key: _plain(own) for key, own in value.items()}
    return {f.name: _plain(getattr(value, f.name)) for f in fields(value)}


def from_plain(document: Any, place: str) -> Event:
    """Read what `to_plain` wrote.

    Raises
    ------
    DesignError
        With the place in the document, what was expected there, and what was found.
    """
    if not isinstance(document, Mapping):
        _fail(place, "an event", document)
    kind = document.get("event")
    if not isinstance(kind, str) or kind not in Event.registry:
        near = nearest(kind, Event.registry) if isinstance(kind, str) else ""
        raise DesignError(Fault(f"{place}.event", f"expected a kind of event, found {_brief(kind)}{near}"))
    event: Event = _record(Event.registry[kind], {k: v for k, v in document.items() if k != "event"}, place)
    return event


@cache
def _readers(cls: type[object]) -> dict[str, _Read]:
    hints = get_type_hints(cls)
    return {name: _reader(hints[name]) for name in hints if get_origin(hints[name]) is not ClassVar}


def _record(cls: Any, document: Mapping[str, Any], place: str) -> Any:
    """Make a frozen record of its fields; those with a default may be missing."""
    readers = _readers(cls)
    for name in document:
        if name not in readers:
            raise DesignError(Fault(f"{place}.{name}", f"no such field{nearest(name, readers)}"))
    try:
        return cls(
            **{name: readers[name](document[name], f"{place}.{name}") for name in readers if name in document}
        )
    except TypeError:
        missing = next((name for name in readers if name not in document), "")
        raise DesignError(Fault(f"{place}.{missing}", "expected a value, found none")) from None


def _reader(hint: Any) -> _Read:
    """What reads, and checks, a value of a type."""
    origin, args = get_origin(hint), get_args(hint)
    if origin in (Union, UnionType):
        (inner,) = (arg for arg in args if arg is not NoneType)
        some = _reader(inner)
        return lambda value, place: None if value is None else some(value, place)
    if origin is tuple:
        return _repeated(_reader(args[0])) if args[-1] is Ellipsis else _fixed([_reader(own) for own in args])
    if isinstance(origin, type) and issubclass(origin, Mapping):
        inner_read = _reader(args[1])
        return lambda value, place: (
            {str(k): inner_read(v, f"{place}.{k}") for k, v in value.items()}
            if isinstance(value, Mapping)
            else _fail(place, "an object", value)
        )
    if is_dataclass(hint) and isinstance(hint, type):
        return lambda value, place: (
            _record(hint, value, place) if isinstance(value, Mapping) else _fail(place, "an object", value)
        )
    return _SIMPLE[hint]


def _repeated(inner: _Read) -> _Read:
    return lambda value, place: (
        tuple([inner(own, f"{place}[{n}]") for n, own in enumerate(value)])
        if isinstance(value, (list, tuple))
        else _fail(place, "a list", value)
    )


def _fixed(inner: list[_Read]) -> _Read:
    def read(value: Any, place: str) -> Any:
        if not isinstance(value, (list, tuple)) or len(value) != len(inner):
            _fail(place, f"a list of {len(inner)}", value)
        return tuple([own(v, f"{place}[{n}]") for n, (own, v) in enumerate(zip(inner, value, strict=True))])

    return read


def _number(value: Any, place: str) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not isfinite(value):
        _fail(place, "a number", value)
    return float(value)


def _exactly(kind: type[Any], what: str) -> _Read:
    return lambda value, place: value if type(value) is kind else _fail(place, what, value)


def _anything(value: Any, place: str) -> Any:
    """Plain data as it is, sequences as tuples."""
    if isinstance(value, (list, tuple)):
        return tuple([_anything(own, f"{place}[{n}]") for n, own in enumerate(value)])
    if isinstance(value, Mapping):
        return {str(key): _anything(own, f"{place}.{key}") for key, own in value.items()}
    return _number(value, place) if isinstance(value, float) else value


_SIMPLE: dict[Any, _Read] = {
    float: _number,
    int: _exactly(int, "a whole number"),
    str: _exactly(str, "a text"),
    bool: _exactly(bool, "true or false"),
    Any: _anything,
}


def _fail(place: str, expected: str, found: Any) -> Any:
    raise DesignError(Fault(place, f"expected {expected}, found {_brief(found)}"))


def _brief(value: Any) -> str:
    shown = repr(value)
    return shown if len(shown) <= 60 else f"{shown[:57]}…"
