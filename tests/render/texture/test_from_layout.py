"""A layout's grammar draws what its elevation does."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb import Design, DesignError, Layout, gallery, solve
from facade_nb.design.errors import GrammarError
from facade_nb.design.model import Canvas
from facade_nb.render import elevation_svg
from facade_nb.render.geometry import find_geometry
from facade_nb.render.texture import Grammar
from facade_nb.render.texture.from_layout import LayoutGrammar, grammar_of
from facade_nb.render.tiles import TileSet
from facade_nb.solver.model.layout import PlacedShape
from tests.known import FEW

TILES = TileSet.builtin(64)
NAMES = FEW
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def solved() -> Callable[[str], Layout]:
    layouts: dict[str, Layout] = {}

    def get(name: str) -> Layout:
        if name not in layouts:
            layouts[name] = solve(gallery.load(name), time_limit=120.0)
        return layouts[name]

    return get


def _elevation(layout: Layout) -> tuple[np.ndarray, np.ndarray]:
    """Which shape the elevation shows at each of its pixels on the façade, -1 for none, and the pixels' places.

    From the drawing alone: every shape's cell covers it exactly, and later ones cover earlier ones.
    """
    root = ElementTree.fromstring(elevation_svg(layout, width_px=500))
    scale = float(root.attrib["data-scale"])
    left, bottom = map(float, root.attrib["data-origin"].split())
    width, height = round(layout.canvas.width * scale), round(layout.canvas.height * scale)
    columns = left + np.arange(width) + 0.5
    rows = bottom - layout.canvas.height * scale + np.arange(height) + 0.5
    seen = np.full((height, width), -1)
    for group in root.iter(f"{SVG}g"):
        if "data-shape" not in group.attrib:
            continue
        cell = next(rect for rect in group.iter(f"{SVG}rect") if rect.get("class") == "cell")
        x, y, w, h = (float(cell.attrib[key]) for key in ("x", "y", "width", "height"))
        across = (columns >= x) & (columns < x + w)
        down = (rows >= y) & (rows < y + h)
        seen[np.ix_(down, across)] = int(group.attrib["data-shape"])
    places = np.stack(
        np.broadcast_arrays((columns - left) / scale, ((bottom - rows) / scale)[:, None]), axis=-1
    )
    return seen, places


def _inner(seen: np.ndarray) -> np.ndarray:
    """Pixels that are not within one pixel of a boundary between two shapes."""
    padded = np.pad(seen, 1, mode="edge")
    h, w = seen.shape
    same = np.ones_like(seen, bool)
    for i in range(3):
        for j in range(3):
            same &= padded[i : i + h, j : j + w] == seen
    return same


def _seen(compiled: LayoutGrammar, places: np.ndarray) -> tuple[Grammar, np.ndarray]:
    grammar = compiled.grammar(TILES)
    found = grammar.evaluate(places.reshape(-1, 2), compiled.size, seed=(1.7, 0.4)).rule
    return grammar, found.reshape(places.shape[:2])


@pytest.mark.parametrize("name", NAMES)
def test_every_boundary_is_where_the_elevation_has_it(name: str, solved: Callable[[str], Layout]) -> None:
    """Each shape a rectangle with a rule of its own: the same shape at every pixel but those at a boundary."""
    layout = solved(name)
    compiled = grammar_of(layout, detail=False, each=True)
    expected, places = _elevation(layout)
    grammar, found = _seen(compiled, places)
    index = {rule: k for k, rule in enumerate(compiled.rules) if rule}
    assert len(index) == len([rule for rule in compiled.rules if rule])
    shape = np.array([*(index.get(rule.name, -2) for rule in grammar.rules), -1])[found]
    wrong = (shape != expected) & _inner(expected)
    assert not wrong.any(), f"{wrong.sum()} pixels of {wrong.size}"
    assert (shape == expected).mean() > 0.95
    assert len(set(expected.ravel())) > 1


@pytest.mark.parametrize("name", NAMES)
def test_with_rooms_and_tiles_it_is_the_same_facade(name: str, solved: Callable[[str], Layout]) -> None:
    """A pixel's rule belongs to the shape that the elevation has there, or to one that shows past a column."""
    layout = solved(name)
    compiled = grammar_of(layout, each=True)
    expected, places = _elevation(layout)
    grammar, found = _seen(compiled, places)
    names = [rule.name for rule in grammar.rules]
    below = _reached(grammar)
    inner = _inner(expected)
    full = [find_geometry(shape.geometry).full for shape in layout.shapes]
    for k in set(expected[inner]) - {-1}:
        at = inner & (expected == k)
        ours = below[names.index(compiled.rules[k])]
        rules = set(found[at].tolist())
        if full[k]:
            assert rules <= ours, f"{compiled.rules[k]}: {[names[r] for r in rules - ours]}"
        else:
            assert rules & ours, compiled.rules[k]
    holes = inner & (expected == -1)
    if holes.any():
        assert (found[holes] == -1).all()


def _reached(grammar: Grammar) -> list[set[int]]:
    """For each rule those that it leads to, and itself."""
    reached: list[set[int]] = []
    for k in range(len(grammar.rules)):
        seen, waiting = {k}, [k]
        while waiting:
            for target in grammar.rules[waiting.pop()].targets():
                if target not in seen:
                    seen.add(target)
                    waiting.append(target)
        reached.append(seen)
    return reached


def test_equal_shapes_share_a_rule(solved: Callable[[str], Layout]) -> None:
    layout = solved("bookshop")
    shared, each = grammar_of(layout), grammar_of(layout, each=True)
    assert len(set(shared.rules)) < len(layout.shapes) / 4
    assert len(set(each.rules)) == len(layout.shapes)
    assert len(shared.text) < len(each.text) / 2
    encoding = shared.grammar(TILES).encoding
    assert encoding.texture.dtype == np.float16
    assert encoding.bytes < 10_000


def test_lengths_that_16_bits_round_do_not_add_up() -> None:
    """60 bays of 0.3337 m: each is rounded by up to 0.12 mm, and the last begins within that of where it should."""
    design = {
        "format": "facade-nb/design/1", "name": "long", "canvas": {"width": 60 * 0.3337, "height": 1.0},
        "symbols": {"A": {"size": 0.3337}, "P": {"size": 1.0}},
        "patterns": {"x": "A^60", "y": "P"},
        "layers": [{"name": "base", "x": {"pattern": "x"}, "y": {"pattern": "P" and "y"}}],
    }  # fmt: skip
    layout = solve(Design.from_dict(design))
    compiled = grammar_of(layout, detail=False, each=True)
    grammar = compiled.grammar()
    for k, shape in enumerate(layout.shapes):
        left, _, right, _ = shape.rect
        points = [(left + 3e-4, 0.5), (right - 3e-4, 0.5)]
        found = grammar.evaluate(points, compiled.size).rule
        assert {grammar.rules[rule].name for rule in found} == {compiled.rules[k]}


@st.composite
def layouts(draw: st.DrawFn) -> Layout:
    """Layers of rectangles anywhere on a canvas, on a grid of 0.1 m: also ones that overlap, or reach the edges."""
    shapes = []
    for layer in range(draw(st.integers(1, 4))):
        for _ in range(draw(st.integers(0, 7))):
            left, right = sorted(draw(st.lists(st.integers(0, 70), min_size=2, max_size=2, unique=True)))
            bottom, top = sorted(draw(st.lists(st.integers(0, 50), min_size=2, max_size=2, unique=True)))
            rect = (left / 10, bottom / 10, right / 10, top / 10)
            shapes.append(
                PlacedShape(f"layer {layer}", draw(st.sampled_from("AB")), "P", rect, material="brick")
            )
    return Layout("random", Canvas(7.0, 5.0), shapes=tuple(shapes))


@given(layouts())
@settings(max_examples=60, deadline=None)
def test_any_rectangles_are_painted_in_their_order(layout: Layout) -> None:
    compiled = grammar_of(layout, detail=False, each=True)
    grammar = compiled.grammar()
    points = np.random.default_rng(0).integers(0, (70, 50), (400, 2)) / 10 + 0.05
    found = grammar.evaluate(points, compiled.size).rule
    for (x, y), rule in zip(points, found, strict=True):
        covering = [
            k for k, s in enumerate(layout.shapes) if s.rect[0] < x < s.rect[2] and s.rect[1] < y < s.rect[3]
        ]
        expected = compiled.rules[covering[-1]] if covering else None
        assert (grammar.rules[rule].name if rule >= 0 else None) == expected


HOUSE = {
    "format": "facade-nb/design/1", "name": "with rules", "canvas": {"width": 6.0, "height": 3.0},
    "symbols": {"A": {"size": 1.0}, "B": {"size": 2.0}, "P": {"size": 3.0}},
    "patterns": {"x": "A(BA)^k", "y": "P"},
    "layers": [{"name": "base", "x": {"pattern": "x"}, "y": {"pattern": "y"}}],
    "shapes": {"A P": {"material": "brick"}, "B P": {"material": "rule:Poster", "kind": "window"}},
}  # fmt: skip

LIBRARY = """
Poster -> SplitX(Rel, 1, Blue, Rel, 1, own.Red)
Blue -> Mat(Color, 0, 0, 0, 1, 1)
namespace own { Red -> Mat(Color, 0, 1, 0, 0, 1) }
"""


def test_a_material_may_name_a_rule() -> None:
    layout = solve(Design.from_dict(HOUSE))
    compiled = grammar_of(layout, LIBRARY)
    (poster, *_) = [k for k, shape in enumerate(layout.shapes) if shape.x == "B"]
    assert compiled.rules[poster] == "Poster"
    left, _, right, _ = layout.shapes[poster].rect
    grammar = compiled.grammar(TILES)
    quarter = (right - left) / 4
    color = grammar.evaluate([(left + quarter, 1), (right - quarter, 1)], compiled.size).color
    assert color[0, :3].tolist() == [0, 0, 1]
    assert color[1, :3].tolist() == [1, 0, 0]
    assert "rule:Poster" in elevation_svg(layout)  # everywhere else it is grey, and says so


def test_rules_of_a_namespace_may_be_named() -> None:
    layout = solve(Design.from_dict(HOUSE))
    shapes = tuple(replace(s, material="rule:own.Red") if s.x == "B" else s for s in layout.shapes)
    compiled = grammar_of(replace(layout, shapes=shapes), LIBRARY)
    grammar = compiled.grammar(TILES)
    at = next(s.rect for s in shapes if s.x == "B")
    assert grammar.evaluate([((at[0] + at[2]) / 2, 1)], compiled.size).color[0, :3].tolist() == [1, 0, 0]


def test_names_of_the_library_are_left_alone() -> None:
    """A library may have rules called as ours are, and a namespace called facade."""
    library = (
        LIBRARY
        + "Room -> Mat(Color, 0, 1, 1, 0, 1)\nOpen -> Skip(0)\nbase_A_P -> Skip(0)\nnamespace facade { X -> Skip(0) }"
    )
    layout = solve(Design.from_dict(HOUSE))
    compiled = grammar_of(layout, library)
    plain = grammar_of(layout, LIBRARY)
    assert "own_Room" not in compiled.text  # nothing of ours is called Room here
    points = np.random.default_rng(0).uniform(0, 1, (500, 2)) * compiled.size
    one, two = (g.grammar(TILES).evaluate(points, g.size).color for g in (compiled, plain))
    assert (one == two).all()


def test_a_rule_called_as_one_of_ours_is_the_librarys() -> None:
    layout = solve(Design.from_dict(HOUSE))
    shapes = tuple(
        replace(s, material="rule:Room")
        if s.x == "B"
        else replace(s, geometry="window", material="painted-wood")
        for s in layout.shapes
    )
    compiled = grammar_of(replace(layout, shapes=shapes), "Room -> Mat(Color, 0, 1, 1, 0, 1)")
    grammar = compiled.grammar(TILES)
    for shape, rule in zip(shapes, compiled.rules, strict=True):
        middle = [((shape.rect[0] + shape.rect[2]) / 2 + 0.13, 1.0)]
        yellow = grammar.evaluate(middle, compiled.size, seed=(3, 1)).color[0].tolist() == [1, 1, 0, 1]
        assert yellow == (shape.x == "B") == (rule == "Room")


def test_faults_name_the_shape() -> None:
    layout = solve(Design.from_dict(HOUSE))
    with pytest.raises(
        DesignError,
        match=r'shapes\["B P"\] in layer \'base\': material: there is no rule \'Poster\' in the grammar',
    ):
        grammar_of(layout)
    with pytest.raises(DesignError, match=r"did you mean 'Postr'\?"):
        grammar_of(layout, LIBRARY.replace("Poster", "Postr"))
    with pytest.raises(DesignError, match="library: expected a grammar without a rule 'S'"):
        grammar_of(layout, LIBRARY + "S -> Blue2(1)".replace("Blue2(1)", "Skip(0)"))
    with pytest.raises(GrammarError, match="line 1, column"):
        grammar_of(layout, "Poster -> Paint(1)")
    unknown = replace(layout, shapes=tuple(replace(s, material="brik") for s in layout.shapes))
    with pytest.raises(DesignError, match="found 'brik'; did you mean 'brick'"):
        grammar_of(unknown)


def test_an_empty_layout_is_an_empty_facade() -> None:
    layout = solve(gallery.steps("residential-house")[0])
    compiled = grammar_of(layout)
    assert (compiled.grammar().evaluate([(1, 1)], compiled.size).rule == -1).all()


def test_what_lies_back_is_an_intrusion() -> None:
    """A window 0.2 m behind the wall: seen slantwise its reveal covers it."""
    layout = solve(Design.from_dict(HOUSE))
    shapes = tuple(
        replace(s, material="painted-wood", geometry="window", offset=-0.2) if s.x == "B" else s
        for s in layout.shapes
    )
    compiled = grammar_of(replace(layout, shapes=shapes))
    grammar = compiled.grammar(TILES)
    rect = next(s.rect for s in shapes if s.x == "B")
    steps = grammar.steps((rect[0] + 0.02, 1.0), compiled.size, ray=(-1, 0, -1))
    assert "left" in {face for step in steps for face in step.faces}
    steps = grammar.steps((rect[0] + 0.02, 1.0), compiled.size)
    assert steps[-1].faces[:1] == ("back",)


def test_the_text_is_a_grammar_for_people() -> None:
    text = grammar_of(solve(Design.from_dict(HOUSE)), LIBRARY).text
    assert text.startswith("# with rules, 6 by 3 m, compiled from its layout.\nS -> Layer(facade.base_row)")
    assert re.search(r"base_row -> SplitX\(Abs, \S+, base_A_P, Abs, \S+, Poster", text)
