"""Split grammars of layouts, read by a reader of their own, draw the layouts' rectangles."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb import Layout, gallery, solve
from facade_nb.comparison import complexity
from facade_nb.design.model import Canvas
from facade_nb.render import split_grammar
from facade_nb.solver.model.layout import PlacedShape

Drawn = tuple[str, float, float, float, float]


def drawn(text: str, width: float, height: float) -> list[Drawn]:
    """The shapes that split rules draw, in painting order: name, left, bottom, right, top."""
    rules = dict(line.split(" --> ") for line in text.splitlines())

    def parts(body: str) -> list[tuple[float, str]]:
        found: list[tuple[float, str]] = []
        tokens = re.findall(r'\{|\}\*\d+|\||[\d.]+ : (?:"[^"]*"|\w+|-)', body)

        def read() -> list[tuple[float, str]]:
            own: list[tuple[float, str]] = []
            while tokens:
                token = tokens.pop(0)
                if token == "{":
                    own += read()
                elif token.startswith("}*"):
                    return own * int(token[2:])
                elif token != "|":
                    size, name = token.split(" : ", 1)
                    own.append((float(size), name))
            return own

        found += read()
        return found

    def draw(name: str, box: tuple[float, float, float, float]) -> list[Drawn]:
        left, bottom, right, top = box
        if name == "-":
            return []
        if name.startswith('"'):
            return [(name[1:-1], *box)]
        split = re.fullmatch(r"split\((x|y)\) \{ (.*) \}", rules[name])
        if not split:
            return [d for word in re.findall(r'"[^"]*"|\S+', rules[name]) for d in draw(word, box)]
        out: list[Drawn] = []
        at = left if split[1] == "x" else bottom
        for size, child in parts(split[2]):
            out += draw(
                child, (at, bottom, at + size, top) if split[1] == "x" else (left, at, right, at + size)
            )
            at += size
        assert at == pytest.approx(right if split[1] == "x" else top, abs=1e-3)
        return out

    return draw("Facade", (0.0, 0.0, width, height)) if text else []


def expect_drawn(layout: Layout) -> None:
    """The same shapes; and where two overlap, the same one on top."""
    found = drawn(split_grammar(layout), layout.canvas.width, layout.canvas.height)
    meant = [
        (f"{s.layer}/{s.x}{chr(39) * s.mirrored[0]} {s.y}{chr(39) * s.mirrored[1]}", *s.rect)
        for s in layout.shapes
    ]
    # Sizes are written to the micrometre, so corners may be some micrometres off.
    assert len(found) == len(meant)
    order = []
    left = dict(enumerate(found))
    for name, *rect in meant:
        near = [
            k
            for k, (other, *box) in left.items()
            if other == name and np.abs(np.subtract(rect, box)).max() < 2e-4
        ]
        assert len(near) >= 1, (name, rect)
        order.append(near[0])
        del left[near[0]]
    for i, (_, *a) in enumerate(meant):
        for j, (_, *b) in enumerate(meant[:i]):
            if min(a[2], b[2]) - max(a[0], b[0]) > 1e-3 and min(a[3], b[3]) - max(a[1], b[1]) > 1e-3:
                assert order[j] < order[i]


@pytest.mark.parametrize("name", ["residential-house", "apartment-house", "bookshop", "figure-7"])
def test_the_same_rectangles(name: str) -> None:
    layout = solve(gallery.load(name))
    expect_drawn(layout)


@settings(max_examples=60, deadline=None)
@given(
    st.lists(
        st.tuples(
            st.integers(0, 7), st.integers(0, 7), st.integers(1, 4), st.integers(1, 4), st.integers(0, 2)
        ),
        max_size=8,
    )
)
def test_any_rectangles_that_overlap(boxes: list[tuple[int, int, int, int, int]]) -> None:
    """A pinwheel too, which no cut goes through."""
    shapes = tuple(
        PlacedShape(f"l{layer}", "A", f"S{k}", (0.7 * x, 0.7 * y, 0.7 * min(x + w, 8), 0.7 * min(y + h, 8)))
        for k, (x, y, w, h, layer) in enumerate(boxes)
    )
    expect_drawn(Layout("", Canvas(5.6, 5.6), shapes=shapes))


def grid(columns: str, rows: str) -> Layout:
    shapes = tuple(
        PlacedShape("l", x, y, (float(i), float(j), i + 1.0, j + 1.0))
        for j, y in enumerate(rows)
        for i, x in enumerate(columns)
    )
    return Layout("", Canvas(len(columns), len(rows)), shapes=shapes)


def test_what_repeats_is_written_once() -> None:
    assert split_grammar(grid("WBWBWBW", "GSSS")).splitlines() == [
        "Facade --> split(y) { 1 : R1 | { 1 : R2 }*3 }",
        'R1 --> split(x) { { 1 : "l/W G" | 1 : "l/B G" }*3 | 1 : "l/W G" }',
        'R2 --> split(x) { { 1 : "l/W S" | 1 : "l/B S" }*3 | 1 : "l/W S" }',
    ]


def test_overlapping_layers_are_stacked() -> None:
    wall = PlacedShape("wall", "A", "P", (0.0, 0.0, 4.0, 3.0))
    window = PlacedShape("windows", "B", "Q", (1.5, 1.0, 2.5, 2.5), (True, False))
    assert split_grammar(Layout("", Canvas(4, 3), shapes=(wall, window))).splitlines() == [
        'Facade --> "wall/A P" R1',
        "R1 --> split(y) { 1 : - | 1.5 : R2 | 0.5 : - }",
        'R2 --> split(x) { 1.5 : - | 1 : "windows/B\' Q" | 1.5 : - }',
    ]


def test_a_layout_without_shapes_has_no_rules() -> None:
    assert split_grammar(Layout("", Canvas(4, 3))) == ""


def test_noise_in_the_last_bits_makes_no_rules() -> None:
    layout = grid("WBWB", "SS")
    noisy = replace(
        layout,
        shapes=tuple(
            replace(s, rect=tuple(v * (1 + 1e-12 * k) for v in s.rect))  # type: ignore[arg-type]
            for k, s in enumerate(layout.shapes)
        ),
    )
    assert split_grammar(noisy) == split_grammar(layout)


def test_complexity_counts() -> None:
    design = gallery.load("residential-house")
    layout = solve(design)
    found = complexity(design)
    assert found == complexity(design, layout)
    assert found.layers == len(design.layers)
    assert found.split_rules == len(split_grammar(layout).splitlines()) > 3
    assert found.symbols == len("ABCDHPQR")
    assert found.counters == 1
    assert found.rules == len({p for layer in design.layers for p in (layer.x.pattern, layer.y.pattern)})
