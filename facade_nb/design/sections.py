"""The sections of a design document, read one after the other, every fault noted (docs/documents.md)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from typing import Any, TypeVar

from .errors import PatternError, listed, quoted
from .fields import Faults, at
from .inputs import Members
from .instances import split_instance
from .limits import nearest_zero
from .model import Canvas, Counter, Design, Layer, LayerAxis, PatternDef, Placement, Shape, Symbol, Variant
from .names import nfc
from .pattern import Pattern, parse
from .text import clean_name, counter_fault, fault_at, symbol_fault
from .tree import MAX_LETTERS, too_long

__all__ = [
    "DESIGN_FIELDS",
    "FLAGS",
    "FORMAT",
    "PLACEMENTS",
    "SHAPE_FIELDS",
    "SYMBOL_FIELDS",
    "VARIANT_FIELDS",
    "DocumentReader",
]

FORMAT = "facade-nb/design/1"
"""What a document's `format` says."""

T = TypeVar("T")

DESIGN_FIELDS = (
    *("format", "name", "canvas", "seed", "grammar"),
    *("symbols", "counters", "patterns", "layers", "shapes"),
)
SHAPE_FIELDS = tuple(field.name for field in fields(Shape))
VARIANT_FIELDS = ("weight", *(name for name in SHAPE_FIELDS if name != "variants"))
SYMBOL_FIELDS = tuple(field.name for field in fields(Symbol))[1:]
FLAGS = {"opaque": True, "attached": False, "unoccludable": False, "transparent": False}
PLACEMENTS: tuple[Placement, ...] = ("center", "left", "right")  # the first is the default
_MAX_BLANKS = 40
"""Most blanks at which the key of a shape may be parted into two names."""
_LOOKALIKES = "ϵєɛ"  # letters that a text copied from a paper may have for ε


class DocumentReader:
    """Reads a document section by section; what later sections refer to is kept as it is read."""

    def __init__(self) -> None:
        self.faults = Faults()
        self.symbols: dict[str, Symbol] = {}
        self.patterns: dict[str, Pattern | None] = {}  # None: its text is at fault
        self.doubtful: set[str] = set()  # symbols whose size is at fault, and told so already
        self.keys: list[tuple[str, str]] = []  # place and key of every shape

    def repeated_keys(self, document: object) -> None:
        """Note keys that stand twice in one JSON object; not recursive, so that depth cannot matter."""
        pending: list[tuple[object, str]] = [(document, "")]
        while pending:
            value, place = pending.pop()
            if isinstance(value, Members):
                for key in value.repeated:
                    self.faults.add(at(place, key), "this key stands twice in its object")
                pending.extend((member, at(place, key)) for key, member in reversed(value.items()))
            elif isinstance(value, list):
                pending.extend(
                    (member, at(place, index)) for index, member in reversed(list(enumerate(value)))
                )

    def design(self, document: object) -> Design:
        """The whole document."""
        faults = self.faults
        if not isinstance(document, Mapping):
            faults.expected("", "a design document (an object)", document)
            return Design()
        values = faults.record(document, "", DESIGN_FIELDS, ("format",))
        if "format" in values and values["format"] != FORMAT:
            faults.expected("format", repr(FORMAT), values["format"])
        name = faults.text(values.get("name", "Untitled"), "name", "Untitled", empty=True)
        canvas = self.canvas(values.get("canvas", {}))
        seed = faults.integer(values.get("seed", 0), "seed", 0)
        grammar = values.get("grammar", "")
        if not isinstance(grammar, str):
            faults.expected("grammar", "the text of a texture grammar", grammar)
            grammar = ""
        self.symbols = self.named(values, "symbols", self.symbol, self.symbol_name)
        counters = self.named(values, "counters", self.counter, self.counter_name)
        patterns = self.named(values, "patterns", self.pattern, self.pattern_name)
        layers = self.layers(values.get("layers", ()))
        shapes = self.shapes(values.get("shapes", {}), "shapes")
        self.check_sizes()
        self.check_letters(counters)
        self.check_keys()
        return Design(name, canvas, self.symbols, counters, patterns, layers, shapes, seed, grammar)

    def named(
        self,
        values: Mapping[str, Any],
        section: str,
        member: Callable[[str, Any, str], T],
        naming: Callable[[str, str], str],
    ) -> dict[str, T]:
        """A section that maps names to members."""
        found: dict[str, T] = {}
        for key, value in self.faults.mapping(values.get(section, {}), section).items():
            place = at(section, key)
            name = naming(key, place)
            if name in found:
                self.faults.add(
                    place, f"{quoted(name)} stands twice, once in another Unicode form or with other blanks"
                )
            found[name] = member(name, value, place)
        return found

    def symbol_name(self, key: str, place: str) -> str:
        """A symbol's name in composed form."""
        name = clean_name(key)
        fault = symbol_fault(name)
        if fault:
            self.faults.add(place, f"expected a symbol's name, as it stands between '<' and '>': {fault}")
        return name

    def counter_name(self, key: str, place: str) -> str:
        """A counter's name in composed form."""
        name = clean_name(key)
        fault = counter_fault(name)
        if fault:
            self.faults.add(place, f"expected a counter's name, as it stands between braces: {fault}")
        return name

    def pattern_name(self, key: str, place: str) -> str:
        """A pattern's name in composed form."""
        return nfc(self.faults.text(key, place, key))

    def canvas(self, value: object) -> Canvas:
        """The canvas; what is missing has its default."""
        values = self.faults.record(value, "canvas", ("width", "height"))
        default = Canvas()
        return Canvas(
            self.faults.number(
                values.get("width", default.width), "canvas.width", default.width, positive=True
            ),
            self.faults.number(
                values.get("height", default.height), "canvas.height", default.height, positive=True
            ),
        )

    def length(self, values: Mapping[str, Any], key: str, place: str) -> float | None:
        """An optional length greater than 0."""
        value = values.get(key)
        return None if value is None else self.faults.number(value, at(place, key), None, positive=True)

    def symbol(self, name: str, value: object, place: str) -> Symbol:
        """A symbol."""
        values = self.faults.record(value, place, SYMBOL_FIELDS)
        opaque, attached, unoccludable, transparent = (
            self.faults.flag(values.get(key, default), at(place, key), default)
            for key, default in FLAGS.items()
        )
        placement: Placement = self.faults.choice(
            values.get("placement", "center"), at(place, "placement"), PLACEMENTS
        )
        size, least, most = (self.length(values, key, place) for key in ("size", "min", "max"))
        if size is None and values.get("size") is not None:
            self.doubtful.add(name)
        if least is not None and most is not None and least > most:
            self.faults.add(at(place, "min"), f"expected at most max, which is {most:g}; found {least:g}")
        return Symbol(name, size, opaque, attached, unoccludable, transparent, placement, least, most)

    def counter(self, name: str, value: object, place: str) -> Counter:
        """A counter; its value must lie within its bounds."""
        values = self.faults.record(value, place, ("min", "max", "value"))
        default = Counter(name)
        least = default.min
        if values.get("min") is not None:
            least = self.faults.integer(values["min"], at(place, "min"), least)
        most, fixed = (
            None if values.get(key) is None else self.faults.integer(values[key], at(place, key), None)
            for key in ("max", "value")
        )
        if most is not None and least > most:
            self.faults.add(at(place, "min"), f"expected at most max, which is {most}; found {least}")
        elif fixed is not None and (fixed < least or (most is not None and fixed > most)):
            bounds = f"from {least} to {most}" if most is not None else f"from {least} on"
            self.faults.add(at(place, "value"), f"expected a value {bounds} (its min and max); found {fixed}")
        return Counter(name, least, most, fixed)

    def pattern(self, name: str, value: object, place: str) -> PatternDef:
        """A pattern, given as its text or as an object; its symbols are kept for what refers to it."""
        values: Mapping[str, Any] = {"text": value}
        if not isinstance(value, str):
            values = self.faults.record(value, place, ("text", "hidden", "shapes"), ("text",))
        text = values.get("text")
        self.patterns[name] = None
        if isinstance(text, str):
            try:
                self.patterns[name] = parse(text)
            except PatternError as error:
                self.faults.found.append(replace(error.fault, place=place))
        elif "text" in values:
            self.faults.expected(at(place, "text"), "a pattern's text", text)
        hidden = self.symbol_list(values.get("hidden"), at(place, "hidden"), name)
        shapes = self.shapes(values.get("shapes", {}), at(place, "shapes"))
        return PatternDef(name, text if isinstance(text, str) else "", hidden or (), shapes)

    def symbol_list(self, value: object, place: str, pattern: str) -> tuple[str, ...] | None:
        """Symbols of a pattern, each once; None where there is no list."""
        if value is None:
            return None
        parsed = self.patterns.get(pattern)
        known = frozenset(parsed.symbols if parsed else ())
        found: dict[str, None] = {}
        for index, item in enumerate(self.faults.sequence(value, place, "a list of symbols")):
            name = self.faults.text(item, at(place, index), None)
            if name is None:
                continue
            name = clean_name(name)
            found[name] = None
            if parsed is not None and name not in known:
                names = listed(parsed.symbols) or "none, it has no symbols"
                expected = f"a symbol of pattern {quoted(pattern)} ({names})"
                hint = self.faults.nearest(name, parsed.symbols)
                self.faults.expected(at(place, index), expected, name, hint)
        return tuple(found)

    def layers(self, value: object) -> tuple[Layer, ...]:
        """The layers, bottom first; their names are unique."""
        layers: list[Layer] = []
        places: dict[str, str] = {}
        for index, item in enumerate(self.faults.sequence(value, "layers", "a list of layers")):
            place = at("layers", index)
            layer = self.layer(item, place)
            if layer.name in places:
                self.faults.add(
                    at(place, "name"),
                    f"expected a name of its own; {quoted(layer.name)} is {places[layer.name]}",
                )
            elif layer.name:
                places[layer.name] = place
            layers.append(layer)
        return tuple(layers)

    def layer(self, value: object, place: str) -> Layer:
        """A layer."""
        faults = self.faults
        known = ("name", "x", "y", "depth", "visible", "shapes")
        values = faults.record(value, place, known, ("name", "x", "y"))
        name = nfc(faults.text(values["name"], at(place, "name"), "")) if "name" in values else ""
        x, y = (
            self.axis(values[key], at(place, key)) if key in values else LayerAxis("") for key in ("x", "y")
        )
        depth = faults.number(values.get("depth", 0), at(place, "depth"), 0)
        visible = faults.flag(values.get("visible", True), at(place, "visible"), True)
        return Layer(name, x, y, depth, visible, self.shapes(values.get("shapes", {}), at(place, "shapes")))

    def axis(self, value: object, place: str) -> LayerAxis:
        """An axis of a layer."""
        values = self.faults.record(value, place, ("pattern", "group", "mask"), ("pattern",))
        pattern = ""
        if "pattern" in values:
            pattern = nfc(self.faults.text(values["pattern"], at(place, "pattern"), ""))
            if pattern and pattern not in self.patterns:
                names = listed(self.patterns) or "there is none"
                hint = self.faults.nearest(pattern, self.patterns)
                self.faults.expected(at(place, "pattern"), f"the name of a pattern ({names})", pattern, hint)
        default = LayerAxis(pattern)
        group = self.faults.text(values.get("group", default.group), at(place, "group"), default.group)
        return LayerAxis(
            pattern, nfc(group), self.symbol_list(values.get("mask"), at(place, "mask"), pattern)
        )

    def shapes(self, value: object, place: str) -> dict[str, Shape]:
        """Shapes by key; whether the keys name symbols is checked once all symbols are known."""
        shapes: dict[str, Shape] = {}
        for raw, item in self.faults.mapping(value, place).items():
            inside = at(place, raw)
            key = clean_name(raw)
            if key in shapes:
                self.faults.add(
                    inside, f"{quoted(key)} stands twice, once in another Unicode form or with other blanks"
                )
            self.keys.append((inside, key))
            shapes[key] = self.shape(item, inside)
        return shapes

    def shape(self, value: object, place: str) -> Shape:
        """A shape; null is as good as missing."""
        return self.looks(self.faults.record(value, place, SHAPE_FIELDS), place)

    def variants(self, value: object, place: str) -> tuple[Variant, ...] | None:
        """Variants of a shape, each with its fields and its weight; null and an empty list are as good as missing."""
        found: list[Variant] = []
        for index, item in enumerate(self.faults.sequence(value, place, "a list of variants")):
            inside = at(place, index)
            values = dict(self.faults.record(item, inside, VARIANT_FIELDS))
            weight = values.pop("weight", None)
            if weight is not None:
                weight = self.faults.number(weight, at(inside, "weight"), None, least=0)
            found.append(Variant(self.looks(values, inside), 1.0 if weight is None else weight))
        if found and not any(variant.weight for variant in found):
            self.faults.add(place, "expected a variant with a weight greater than 0; found none")
        return tuple(found) or None

    def looks(self, values: Mapping[str, Any], place: str) -> Shape:
        """The fields of a shape, or of a variant."""
        given = {key: member for key, member in values.items() if member is not None}
        found: dict[str, Any] = {}
        for key, member in given.items():
            inside = at(place, key)
            match key:
                case "offset":
                    found[key] = self.faults.number(member, inside, None)
                case "thickness":
                    found[key] = self.faults.number(member, inside, None, least=0)
                case "visible":
                    found[key] = self.faults.flag(member, inside, None)
                case "variants":
                    found[key] = self.variants(member, inside)
                case _:
                    found[key] = self.faults.text(member, inside, None)
        return Shape(**found)

    def check_sizes(self) -> None:
        """Unsized symbols stand only in control patterns."""
        sized = {name for name, symbol in self.symbols.items() if symbol.size is not None}
        for name, pattern in self.patterns.items():
            if pattern is None:
                continue
            told = sized | self.doubtful
            for site in pattern.sites:
                symbol = site.name
                if site.role != "solid" or symbol in told:
                    continue
                told.add(symbol)
                message = (
                    f"symbol {quoted(symbol)} has no size: expected {at(at('symbols', symbol), 'size')}, "
                    "for only placeholders of control patterns go without"
                )
                hint = (
                    "; the empty word is written ε"
                    if symbol in _LOOKALIKES
                    else self.faults.nearest(symbol, sized)
                )
                self.faults.found.append(
                    fault_at(pattern.text, site.offset, message + hint, at("patterns", name))
                )

    def check_letters(self, counters: Mapping[str, Counter]) -> None:
        """Every pattern has a word that is not too long with its counters as near to 0 as they may be."""
        least = {name: nearest_zero(own) for name, own in counters.items()}
        for name, pattern in self.patterns.items():
            if pattern is None or not any(map(least.get, pattern.counters)):
                continue  # words that are too long whatever the counters are were refused with their text
            letters = pattern.fewest_letters(least)
            if letters > MAX_LETTERS:
                counter = max(pattern.counters, key=lambda own: abs(least.get(own, 0)))
                own = counters[counter]
                field = "value" if own.value is not None else "min" if own.min > 0 else "max"
                self.faults.add(
                    at(at("counters", counter), field),
                    f"expected a count with which pattern {quoted(name)} can be written out; "
                    f"found {getattr(own, field):,}: {too_long(letters)}",
                )

    def check_keys(self) -> None:
        """Shapes are keyed by two symbols that some pattern uses, or that are declared; either may be ``*``.

        A symbol may have the number of an instance: ``B[2]``.
        """
        used = (symbol for pattern in self.patterns.values() if pattern for symbol in pattern.symbols)
        known = dict.fromkeys((*used, *self.symbols))
        unsure = None in self.patterns.values()  # a pattern that cannot be read may use any symbol
        for place, key in self.keys:
            words = key.split(" ", _MAX_BLANKS)
            pairs = [(" ".join(words[:cut]), " ".join(words[cut:])) for cut in range(1, len(words))]
            if not pairs:
                expected = "two symbols with a blank between them, horizontal first, such as 'A P' or 'A *'"
                self.faults.expected(place, expected, key)
                continue
            parted = [tuple(split_instance(name, known) for name in pair) for pair in pairs]
            good = [
                pair for pair in parted if all(name == "*" or unsure or name in known for name, _ in pair)
            ]
            if not good:
                for name, _ in parted[0] if len(parted) == 1 else ((key, None),):
                    if name != "*" and name not in known:
                        hint = self.faults.nearest(name, known)
                        self.faults.expected(place, "symbols that a pattern uses, or *", name, hint)
            elif any(name == "*" and number is not None for name, number in good[0]):
                star = next(f"*[{number}]" for name, number in good[0] if name == "*" and number is not None)
                self.faults.expected(place, "an instance of a symbol, such as 'B[2]'", star)
            elif any(number == 0 for _, number in good[0]):
                expected = "an instance from 1, the first, or -1, the last"
                self.faults.expected(place, expected, 0)
