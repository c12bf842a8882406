"""Random patterns and designs that are valid."""

from __future__ import annotations

import re
from typing import Any
from unicodedata import category

from hypothesis import strategies as st

from facade_nb.design import (
    Canvas,
    Counter,
    Design,
    Layer,
    LayerAxis,
    Pattern,
    PatternDef,
    Shape,
    Symbol,
    Variant,
    parse,
)
from facade_nb.design.modes import MODES
from facade_nb.design.pattern import Alt, Concat, Count, Empty, Mirror, Node, Sym
from facade_nb.design.text import clean_name, counter_fault, symbol_fault
from facade_nb.design.tree import alternation, concatenation

NAMES = [
    "A",
    "B",
    "e",
    "b2",
    "Δ",
    "É",
    "漢",
    "กู่",
    "कि2",
    "שָ",
    "window",
    "front door",
    "ε",
    "ε1",
    "x-1",
    "a;b#c",
]
COUNTERS = ["k", "n2", "κ", "floors", "of bays", "k_1", "ชั้น", "मंज़िल"]

names = st.sampled_from(NAMES) | st.text(min_size=1, max_size=6).map(clean_name).filter(
    lambda name: not symbol_fault(name)
)
counters = st.sampled_from(COUNTERS) | st.text(min_size=1, max_size=6).map(clean_name).filter(
    lambda name: not counter_fault(name)
)


@st.composite
def trees(draw: st.DrawFn, letters: Any = names, depth: int = 3, counted: bool = False) -> Node:
    """A tree; `counted` says that a named counter stands above it or that none may stand in it."""
    kind = draw(
        st.sampled_from(["sym", "sym", "empty", "concat", "alt", "mirror", "count"] if depth else ["sym"])
    )

    def inner(taboo: bool = counted) -> Node:
        return draw(trees(letters, depth - 1, taboo))

    match kind:
        case "sym":
            return Sym(draw(letters))
        case "empty":
            return Empty()
        case "concat":
            return concatenation([inner() for _ in range(draw(st.integers(2, 3)))])
        case "alt":
            return alternation([inner() for _ in range(draw(st.integers(2, 3)))])
        case "mirror":
            return Mirror(inner())
        case _:
            named = not counted and draw(st.booleans())
            body = inner(counted or named)
            value = draw(counters) if named else draw(st.integers(0, 3))
            return Count(body, draw(st.sampled_from(list(MODES))), draw(st.booleans()), value)


def symbols_of(node: Node) -> set[str]:
    """Symbols of a tree, found without the code under test."""
    match node:
        case Sym(name=name):
            return {name}
        case Concat(parts=nodes) | Alt(options=nodes):
            return set().union(*map(symbols_of, nodes))
        case Mirror(body=body) | Count(body=body):
            return symbols_of(body)
        case _:
            return set()


@st.composite
def patterns(draw: st.DrawFn) -> Pattern:
    """A pattern, half of them with substitutions."""
    if draw(st.booleans()):
        return Pattern(draw(trees()))
    control = draw(trees(counted=True))
    standing = sorted(symbols_of(control))
    if not standing:
        return Pattern(control)
    targets = draw(st.lists(st.sampled_from(standing), min_size=1, max_size=2, unique=True))
    contents = names.filter(lambda name: name not in targets)
    return Pattern(control, tuple((name, draw(trees(contents, 2))) for name in targets))


@st.composite
def spellings_of(draw: st.DrawFn, text: str) -> str:
    """Another spelling of a canonical text: blanks, comments, other glyphs, new lines for semicolons."""
    glyphs = {"'": "'’′", ";": ";\n", "-": "-−"}
    modes = {".": ".·", ":": ":∘", "@": "@⊙"}
    marks = "".join(sign for sign in set(text) if category(sign)[0] == "M")
    letter = rf"[^\W\d][{re.escape(marks)}]*" if marks else r"[^\W\d]"
    tokens = re.findall(rf"<[^>]*>|\{{[^}}]*\}}|:=|\^|{letter}\d*|\d+|\S", text)
    out = []
    for before, token in zip(["", *tokens], tokens, strict=False):
        spelled = draw(st.sampled_from((modes if before == "^" else glyphs).get(token, [token])))
        out.append(spelled + draw(st.sampled_from(["", "", " ", "\t"])))
        if spelled == "\n":
            out.append(draw(st.sampled_from(["", "# a; comment (\n", "\r\n;"])))
    return "".join(out)


labels = st.sampled_from(["base", "columns", "Säulen", "top floor", "a.b", 'q"uote', "<b>"])
lengths = st.floats(1e-3, 1e3, allow_nan=False)
numbers = st.floats(-10, 10, allow_nan=False)


@st.composite
def shape_maps(draw: st.DrawFn, known: list[str]) -> dict[str, Shape]:
    """Shapes keyed by pairs of known symbols, instances of them and wildcards."""
    side = st.sampled_from([*known, *(f"{name}[{n}]" for name in known for n in (-1, 2)), "*"])
    keys = st.tuples(side, side).map(" ".join)
    free = st.none() | labels
    plain = (free, free, free, st.none() | numbers, st.none() | st.floats(0, 3), st.none() | st.booleans())
    variant = st.builds(Variant, st.builds(Shape, *plain), st.floats(0.5, 9) | st.just(1.0))
    several = st.lists(variant, min_size=1, max_size=3).map(tuple)
    shape = st.builds(Shape, *plain, st.none() | several)
    return draw(st.dictionaries(keys, shape, max_size=3))


@st.composite
def designs(draw: st.DrawFn) -> Design:
    """A valid design."""
    texts = draw(st.dictionaries(labels, patterns().map(str), max_size=3))
    parsed = {name: parse(text) for name, text in texts.items()}
    used = sorted({symbol for pattern in parsed.values() for symbol in pattern.symbols})
    solid = {symbol for pattern in parsed.values() for symbol in pattern.solids}
    symbols = {}
    for name in used:
        least, most = sorted(draw(st.tuples(lengths, lengths)))
        size = draw(lengths) if name in solid else draw(st.none() | lengths)
        bounds = draw(st.sampled_from([(None, None), (least, most), (least, None), (None, most)]))
        flags = draw(st.tuples(*[st.booleans()] * 4))
        placement = draw(st.sampled_from(["center", "left", "right"]))
        symbols[name] = Symbol(name, size, *flags, placement, *bounds)
    declared = {}
    for name in draw(st.lists(counters, max_size=2, unique=True)):
        least, value, most = sorted(draw(st.tuples(*[st.integers(-5, 20)] * 3)))
        declared[name] = Counter(
            name, least, draw(st.sampled_from([None, most])), draw(st.sampled_from([None, value]))
        )
    defs = {}
    for name, text in texts.items():
        own = parsed[name].symbols
        hidden = tuple(draw(st.lists(st.sampled_from(own), unique=True))) if own else ()
        defs[name] = PatternDef(name, text, hidden, draw(shape_maps(used)))

    def axis() -> LayerAxis:
        pattern = draw(st.sampled_from(sorted(texts)))
        own = parsed[pattern].symbols
        mask = tuple(draw(st.lists(st.sampled_from(own), unique=True))) if own else ()
        return LayerAxis(
            pattern, draw(st.sampled_from(["default", "left wing"])), draw(st.sampled_from([None, mask]))
        )

    titles = draw(st.lists(labels, max_size=3, unique=True)) if texts else []
    layers = tuple(
        Layer(title, axis(), axis(), draw(numbers), draw(st.booleans()), draw(shape_maps(used)))
        for title in titles
    )
    canvas = Canvas(draw(lengths), draw(lengths))
    seed = draw(st.integers(-9, 99))
    return Design(draw(labels), canvas, symbols, declared, defs, layers, draw(shape_maps(used)), seed)
