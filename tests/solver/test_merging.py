"""From two solved axes to shapes: what is shown, what it looks like, what hides what, and holes."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facade_nb import Design, Layout, solve
from facade_nb.design import Canvas
from facade_nb.solver.assembly.looks import Looks
from facade_nb.solver.assembly.shapes import find_holes
from facade_nb.solver.model.layout import PlacedShape, Rect
from tests.oracle.designs import design


def layer(name: str, x: str, y: str, **fields: Any) -> dict[str, Any]:
    """A layer; ``x_mask``, ``y_mask``: the symbols that stay."""
    axes: dict[str, Any] = {"x": {"pattern": x}, "y": {"pattern": y}}
    for axis, own in axes.items():
        if f"{axis}_mask" in fields:
            own["mask"] = fields.pop(f"{axis}_mask")
    return {"name": name, **axes, **fields}


SYMBOLS = {"A": {"size": 1.0}, "B": {"size": 2.0}, "P": {"size": 1.0}, "Q": {"size": 1.0}}
PATTERNS: dict[str, Any] = {"a": "ABA", "p": "PQ"}


def stack(
    *layers: dict[str, Any],
    patterns: dict[str, Any] | None = None,
    symbols: dict[str, Any] | None = None,
    shapes: dict[str, Any] | None = None,
) -> Design:
    """A canvas of 4 by 2 m; layers bottom first."""
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "canvas": {"width": 4.0, "height": 2.0},
            "symbols": SYMBOLS | (symbols or {}),
            "patterns": PATTERNS | (patterns or {}),
            "layers": list(layers),
            "shapes": shapes or {},
        }
    )


def cells(layout: Layout, layer: str = "") -> list[tuple[str, str]]:
    """Symbol pairs of the shapes, of one layer."""
    return [(s.x, s.y) for s in layout.shapes if not layer or s.layer == layer]


def area(rect: Rect) -> float:
    return (rect[2] - rect[0]) * (rect[3] - rect[1])


class TestWhatIsShown:
    def test_every_pair_of_letters(self) -> None:
        layout = solve(stack(layer("wall", "a", "p")))
        assert [(s.x, s.y, s.rect) for s in layout.shapes] == [
            ("A", "P", (0, 0, 1, 1)), ("B", "P", (1, 0, 3, 1)), ("A", "P", (3, 0, 4, 1)),
            ("A", "Q", (0, 1, 1, 2)), ("B", "Q", (1, 1, 3, 2)), ("A", "Q", (3, 1, 4, 2)),
        ]  # fmt: skip
        assert layout.holes == () and layout.warnings == ()

    def test_masks(self) -> None:
        layout = solve(stack(layer("wall", "a", "p", x_mask=["B"], y_mask=["P"])))
        assert cells(layout) == [("B", "P")]
        assert [letter.symbol for letter in layout.x.row("wall").letters] == ["A", "B", "A"]

    def test_an_empty_mask_hides_everything(self) -> None:
        assert solve(stack(layer("wall", "a", "p", x_mask=[]))).shapes == ()

    def test_hidden_symbols_of_a_pattern(self) -> None:
        layout = solve(stack(layer("wall", "a", "p"), patterns={"a": {"text": "ABA", "hidden": ["A"]}}))
        assert cells(layout) == [("B", "P"), ("B", "Q")]

    def test_invisible_layers_take_no_part(self) -> None:
        hidden = layer("front", "long", "p", visible=False)
        layout = solve(stack(layer("wall", "a", "p"), hidden, patterns={"long": "B^9"}))
        assert {s.layer for s in layout.shapes} == {"wall"}
        with pytest.raises(KeyError, match="front"):
            layout.x.row("front")

    def test_placeholders_make_no_shape(self) -> None:
        layout = solve(
            stack(layer("wall", "a", "p"), layer("front", "w", "p"), patterns={"w": "e m e; m := B"})
        )
        assert cells(layout, "front") == [("B", "P"), ("B", "Q")]

    def test_transparent_symbols_make_no_shape(self) -> None:
        parts = {"T": {"size": 1.0, "transparent": True}}
        layout = solve(
            stack(layer("wall", "a", "p"), layer("front", "t", "p"), symbols=parts, patterns={"t": "TBT"})
        )
        assert cells(layout, "front") == [("B", "P"), ("B", "Q")]

    def test_shapes_that_are_not_visible(self) -> None:
        layout = solve(stack(layer("wall", "a", "p"), shapes={"B P": {"visible": False}}))
        assert ("B", "P") not in cells(layout) and len(layout.shapes) == 5
        assert layout.holes == ((1, 0, 3, 1),)

    def test_cut_letters_make_a_shape_for_each_solid_letter_only(self) -> None:
        """e is cut by the boundaries behind it; what is solid is whole and covers the same columns."""
        layout = solve(
            stack(layer("wall", "a", "p"), layer("front", "w", "p"), patterns={"w": "e m; m := A"})
        )
        pieces = [c for c in layout.x.row("front").columns if c and c[0].symbol == "e"]
        assert len(pieces) == 2
        assert cells(layout, "front") == [("A", "P"), ("A", "Q")]

    def test_mirrored_letters_are_told(self) -> None:
        layout = solve(stack(layer("wall", "a", "p"), patterns={"a": "A(BA)'", "p": "P Q'"}))
        assert [(s.x, s.y, s.mirrored) for s in layout.shapes] == [
            ("A", "P", (False, False)), ("A", "P", (True, False)), ("B", "P", (True, False)),
            ("A", "Q", (False, True)), ("A", "Q", (True, True)), ("B", "Q", (True, True)),
        ]  # fmt: skip


class TestWhatItLooksLike:
    def look(self, **sections: Any) -> PlacedShape:
        """The shape of B P."""
        own = layer("wall", "a", "p", **sections.pop("layer", {}))
        layout = solve(stack(own, **sections))
        return next(s for s in layout.shapes if (s.x, s.y) == ("B", "P"))

    def test_defaults(self) -> None:
        shape = self.look()
        assert (shape.kind, shape.geometry, shape.material) == ("wall", "box", "card")
        assert (shape.offset, shape.thickness) == (0.0, 0.2)

    def test_the_more_exact_key_wins_whatever_its_place(self) -> None:
        shapes = {
            "B P": {"kind": "door"},
            "B *": {"kind": "window", "material": "glass"},
            "* P": {"kind": "sill", "material": "wood", "geometry": "panel"},
            "* *": {"kind": "wall", "material": "brick", "geometry": "box", "thickness": 0.5},
        }
        for given_shapes in (shapes, dict(reversed(shapes.items()))):
            shape = self.look(shapes=given_shapes)
            assert shape.kind == "door" and shape.material == "glass"
            assert shape.geometry == "panel" and shape.thickness == 0.5

    def test_layers_override_patterns_which_override_the_design(self) -> None:
        patterns = {
            "a": {
                "text": "ABA",
                "shapes": {"B P": {"kind": "across", "material": "across", "geometry": "across"}},
            },
            "p": {"text": "PQ", "shapes": {"B P": {"kind": "up", "material": "up"}}},
        }
        shapes = {"B P": {"kind": "design", "geometry": "design", "offset": 0.5}}
        shape = self.look(patterns=patterns, shapes=shapes, layer={"shapes": {"B P": {"kind": "layer"}}})
        assert (shape.kind, shape.material, shape.geometry, shape.offset) == ("layer", "up", "across", 0.5)

    def test_a_wildcard_of_a_layer_overrides_an_exact_key_of_the_design(self) -> None:
        shape = self.look(shapes={"B P": {"kind": "door"}}, layer={"shapes": {"* *": {"kind": "window"}}})
        assert shape.kind == "window"

    def test_nothing_and_zero_are_not_missing(self) -> None:
        shapes = {"* *": {"thickness": 0.5, "offset": 0.1}, "B P": {"thickness": 0.0, "offset": 0.0}}
        shape = self.look(shapes=shapes)
        assert shape.thickness == 0.0 and shape.offset == 0.0

    def test_a_layer_can_show_what_the_design_hides(self) -> None:
        shape = self.look(shapes={"* *": {"visible": False}}, layer={"shapes": {"B P": {"visible": True}}})
        assert shape.kind == "wall"

    def test_all_fields_are_filled(self) -> None:
        one = stack(layer("wall", "a", "p"))
        looks = Looks(one, one.stack[0])
        shape = looks.of(looks.sort(("A", 1, 2)), looks.sort(("P", 1, 1)))
        assert None not in (
            shape.kind,
            shape.geometry,
            shape.material,
            shape.offset,
            shape.thickness,
            shape.visible,
        )


class TestWhatHidesWhat:
    def test_paint_order_is_bottom_first(self) -> None:
        layout = solve(
            stack(layer("wall", "a", "p"), layer("front", "b", "p", x_mask=["B"]), patterns={"b": "ABA"})
        )
        names = [s.layer for s in layout.shapes]
        assert names == sorted(names, key=["wall", "front"].index)

    def test_depth_goes_before_the_order_of_the_list(self) -> None:
        one = stack(layer("near", "a", "p", depth=1), layer("far", "a", "p"))
        assert [own.name for own in one.stack] == ["near", "far"]
        assert {s.layer for s in solve(one).shapes} == {"near"}

    def test_equal_depths_keep_the_order_of_the_list(self) -> None:
        one = stack(layer("below", "a", "p", depth=2), layer("above", "a", "p", depth=2))
        assert {s.layer for s in solve(one).shapes} == {"above"}

    def test_only_what_is_wholly_behind_goes(self) -> None:
        layout = solve(stack(layer("wall", "a", "p"), layer("front", "a", "p", x_mask=["B"], y_mask=["Q"])))
        assert ("B", "Q") not in cells(layout, "wall")
        assert len(cells(layout, "wall")) == 5

    def test_several_that_cover_together_hide_nothing(self) -> None:
        layout = solve(stack(layer("wall", "w", "p"), layer("front", "a", "p"), patterns={"w": "BB"}))
        assert len(cells(layout, "wall")) == 4

    @pytest.mark.parametrize("clear", ["", "B", "Q"])
    def test_both_symbols_must_be_opaque(self, clear: str) -> None:
        """B Q stands before C R, which has the same rectangle."""
        symbols: dict[str, Any] = {"C": {"size": 2.0}, "R": {"size": 1.0}}
        if clear:
            symbols[clear] = {**SYMBOLS[clear], "opaque": False}
        front = layer("front", "a", "p", x_mask=["B"], y_mask=["Q"])
        layout = solve(
            stack(layer("wall", "w", "v"), front, symbols=symbols, patterns={"w": "ACA", "v": "PR"})
        )
        assert cells(layout, "front") == [("B", "Q")]
        assert (("C", "R") in cells(layout, "wall")) == bool(clear)
        assert len(cells(layout, "wall")) == 5 + bool(clear)

    def test_what_is_not_seen_hides_nothing(self) -> None:
        front = layer("front", "a", "p", shapes={"* *": {"visible": False}})
        assert len(solve(stack(layer("wall", "a", "p"), front)).shapes) == 6


class TestHoles:
    def test_a_mask_makes_one_and_the_warning_names_letter_and_layer(self) -> None:
        """The columns push the wall aside; on floor P they are masked."""
        parts = {"C": {"size": 1.0}}
        one = stack(
            layer("wall", "w", "p"),
            layer("columns", "c", "p", y_mask=["Q"]),
            symbols=parts,
            patterns={"w": "ABA B", "c": {"text": "e d e; d := C"}},
        )
        one = Design.from_dict(one.to_dict() | {"canvas": {"width": 7.0, "height": 2.0}})
        layout = solve(one)
        left, right = next((a.start, a.end) for a in layout.x.row("columns").letters if a.symbol == "C")
        assert layout.holes == (pytest.approx((left, 0.0, right, 1.0)),)
        assert layout.warnings == (
            f"A hole at {left:.2f} to {right:.2f} m across, 0.00 to 1.00 m up: C P of layer 'columns' stands there and "
            "pushed the others aside, but its y mask hides P.",
        )

    def test_a_layer_of_another_group_has_pushed_nothing(self) -> None:
        """A veil lies over wall and columns, in a group of its own: who pushed is told; alone, it pushed nobody."""
        parts = {"patterns": {"w": "ABA B", "c": {"text": "e d e; d := C"}, "v": "BBBA"}}
        veil = layer("veil", "v", "p", x_mask=[])
        for line in ("x", "y"):
            veil[line]["group"] = "veil"
        layers = [layer("wall", "w", "p"), layer("columns", "c", "p", y_mask=["Q"]), veil]
        wide = {"canvas": {"width": 7.0, "height": 2.0}}
        one = stack(*layers, symbols={"C": {"size": 1.0}}, **parts)
        (told,) = solve(Design.from_dict(one.to_dict() | wide)).warnings
        assert (
            "C P of layer 'columns' stands there and pushed the others aside, but its y mask hides P" in told
        )
        bare = stack(
            layers[0],
            veil,
            symbols={"C": {"size": 1.0}},
            patterns={**parts["patterns"], "w": {"text": "e d e; d := B"}},
        )
        warnings = solve(Design.from_dict(bare.to_dict() | wide)).warnings
        assert any("of layer 'veil' stands there, but its x mask hides" in warning for warning in warnings)
        assert "pushed" not in " ".join(warnings)

    def test_hidden_by_the_pattern(self) -> None:
        layout = solve(stack(layer("wall", "a", "p"), patterns={"a": {"text": "ABA", "hidden": ["B"]}}))
        assert layout.holes == ((1.0, 0.0, 3.0, 2.0),)
        assert "B P of layer 'wall'" in layout.warnings[0] and "pattern 'a' hides B" in layout.warnings[0]

    def test_made_by_a_shape_that_is_not_visible(self) -> None:
        layout = solve(stack(layer("wall", "a", "p"), shapes={"B *": {"visible": False}}))
        assert layout.holes == ((1.0, 0.0, 3.0, 2.0),)
        assert "it is not visible" in layout.warnings[0]

    def test_nothing_there_at_all(self) -> None:
        layout = solve(stack(layer("front", "e", "p"), patterns={"e": "e m; m := B"}))
        assert sum(map(area, layout.holes)) == pytest.approx(4.0)
        assert layout.warnings[-1].startswith("Nothing covers the canvas at ")


lengths = st.integers(0, 12).map(lambda n: n / 4)


@st.composite
def rects(draw: st.DrawFn) -> Rect:
    """A rectangle with corners on a quarter grid, partly off the canvas of 2.5 by 2 m at times."""
    left, right = sorted(draw(st.tuples(lengths, lengths)))
    bottom, top = sorted(draw(st.tuples(lengths, lengths)))
    return (left, bottom, right, top)


@given(st.lists(rects(), max_size=7))
def test_holes_are_a_partition_of_what_is_not_covered(found: list[Rect]) -> None:
    canvas = Canvas(2.5, 2.0)
    shapes = [PlacedShape("wall", "A", "P", rect) for rect in found]
    holes = find_holes(canvas, shapes)
    for i in range(10):
        for j in range(8):
            x, y = 0.25 * i + 0.125, 0.25 * j + 0.125
            covered = any(r[0] < x < r[2] and r[1] < y < r[3] for r in found)
            over = sum(h[0] < x < h[2] and h[1] < y < h[3] for h in holes)
            assert over == (0 if covered else 1), (x, y)
    assert all(0 <= h[0] < h[2] <= 2.5 and 0 <= h[1] < h[3] <= 2.0 for h in holes)
    free = sum(
        not any(r[0] < 0.25 * i + 0.125 < r[2] and r[1] < 0.25 * j + 0.125 < r[3] for r in found)
        for i in range(10)
        for j in range(8)
    )
    assert sum(map(area, holes)) == pytest.approx(free / 16)
    assert list(holes) == sorted(holes)


def test_rounding_makes_no_slivers() -> None:
    third = 1.0 / 3.0
    shapes = [
        PlacedShape("wall", "A", "P", (0.0, 0.0, third, 1.0)),
        PlacedShape("wall", "A", "P", (third + 1e-9, 0.0, 2 * third, 1.0)),
        PlacedShape("wall", "A", "P", (2 * third - 1e-9, 0.0, 1.0 - 1e-9, 1.0)),
    ]
    assert find_holes(Canvas(1.0, 1.0), shapes) == ()


def test_merging_of_two_axes_by_hand() -> None:
    """A design with both axes pushed: what a shape measures is what its letters measure."""
    one = design({"A": 1.0, "B": 2.0}, {"a": "ABA"}, ["a"], width=4.4)
    layout = solve(one)
    letters = layout.x.row("L0").letters
    assert [s.rect for s in layout.shapes] == [(a.start, 0.0, a.end, 2.0) for a in letters]
