"""One instance of a cell: keys with numbers, variants, and which of them wins."""

from __future__ import annotations

from collections import Counter
from itertools import product
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facade_nb import Design, Layout, solve
from facade_nb.design.edit import with_canvas


def wall(shapes: dict[str, Any], **more: Any) -> Design:
    """Two floors, P below Q, of five bays ABABA, each bay 1 m; `more`: other members of the document."""
    document: dict[str, Any] = {
        "format": "facade-nb/design/1",
        "canvas": {"width": 5.0, "height": 2.0},
        "symbols": {name: {"size": 1.0} for name in "ABPQ"},
        "patterns": {"a": "A(BA)^k", "p": "(PQ)^f"},
        "layers": [{"name": "wall", "x": {"pattern": "a"}, "y": {"pattern": "p"}}],
        "shapes": shapes,
    }
    return Design.from_dict(document | more)


def materials(layout: Layout) -> dict[tuple[str, int, str, int], str]:
    return {(s.x, s.number[0], s.y, s.number[1]): s.material for s in layout.shapes}


def marked(shapes: dict[str, Any], **more: Any) -> set[tuple[str, int, str, int]]:
    """The cells that are brick."""
    return {cell for cell, own in materials(solve(wall(shapes, **more))).items() if own == "brick"}


BRICK = {"material": "brick"}


class TestInstances:
    def test_the_second_from_the_left_and_the_first_from_below(self) -> None:
        assert marked({"A[2] Q[1]": BRICK}) == {("A", 2, "Q", 1)}

    def test_negative_numbers_count_from_the_other_end(self) -> None:
        assert marked({"A[-1] *": BRICK}) == {("A", 3, "P", 1), ("A", 3, "Q", 1)}

    def test_a_number_that_there_is_not_means_nothing(self) -> None:
        assert marked({"A[9] *": BRICK, "B[-3] P": BRICK}) == set()

    def test_numbers_are_those_of_the_layers_word(self) -> None:
        narrow = {
            "name": "front",
            "x": {"pattern": "a", "mask": ["B"]},
            "y": {"pattern": "p"},
            "shapes": {"B[2] P": BRICK},
        }
        layers = [{"name": "wall", "x": {"pattern": "a"}, "y": {"pattern": "p"}}, narrow]
        assert marked({}, layers=layers) == {("B", 2, "P", 1)}

    def test_floors_are_counted_from_below(self) -> None:
        tall = solve(with_canvas(wall({"* P[2]": BRICK}), height=4.0))
        assert {s.rect[1] for s in tall.shapes if s.material == "brick"} == {2.0}

    def test_an_instance_can_be_hidden_and_makes_a_hole_that_is_told(self) -> None:
        layout = solve(wall({"B[1] Q": {"visible": False}}))
        assert layout.holes == ((1.0, 1.0, 2.0, 2.0),)
        assert "B Q of layer 'wall' stands there, but it is not visible" in str(layout.warnings)

    def test_a_trace_tells_which_instance_is_hidden(self) -> None:
        layout = solve(wall({"B[1] Q": {"visible": False}}), trace=True)
        hidden = [event for event in layout.trace.events if type(event).__name__ == "ShapeHidden"]
        assert [(e.x, e.y, e.rect[0], e.why) for e in hidden] == [("B", "Q", 1.0, "not visible")]

    def test_a_symbol_of_that_name_is_meant_by_it(self) -> None:
        more = {
            "symbols": {name: {"size": 1.0} for name in ("A", "A[2]", "P", "Q")},
            "patterns": {"a": "A <A[2]> A A A", "p": "PQ"},
        }
        assert marked({"A[2] P": BRICK}, **more) == {("A[2]", 1, "P", 1)}

    def test_layouts_keep_the_numbers(self) -> None:
        layout = solve(wall({}))
        assert Layout.from_dict(layout.to_dict()).shapes == layout.shapes
        assert [s.number for s in layout.shapes if s.x == "A" and s.y == "Q"] == [(1, 1), (2, 1), (3, 1)]


# From the least exact to the most: what stands later wins.
ORDER = [
    "* *",
    "* Q",
    "* Q[-1]",
    "* Q[1]",
    "B *",
    "B Q",
    "B Q[1]",
    "B[-1] *",
    "B[2] *",
    "B[2] Q",
    "B[2] Q[1]",
]


@pytest.mark.parametrize(("less", "more"), [(a, b) for i, a in enumerate(ORDER) for b in ORDER[i + 1 :]])
def test_the_more_exact_key_wins(less: str, more: str) -> None:
    shapes = {more: {"material": "brick"}, less: {"material": "stone", "kind": "door"}}
    looks = {(s.x, *s.number, s.y): s for s in solve(wall(shapes)).shapes}
    assert (looks["B", 2, 1, "Q"].material, looks["B", 2, 1, "Q"].kind) == ("brick", "door")


keys = st.builds(
    "{} {}".format,
    st.sampled_from(["*", "A", "B", "A[1]", "A[2]", "A[-1]", "B[1]", "B[-1]", "B[7]"]),
    st.sampled_from(["*", "P", "Q", "P[1]", "Q[-1]", "Q[2]"]),
)
looks = st.fixed_dictionaries(
    {}, optional={"material": st.sampled_from(["brick", "stone"]), "offset": st.sampled_from([0.1, 0.2])}
)


@given(st.lists(st.dictionaries(keys, looks, max_size=5), min_size=4, max_size=4))
def test_every_cell_has_what_a_naive_reading_says(levels: list[dict[str, Any]]) -> None:
    design, of_x, of_y, own = levels
    more = {
        "patterns": {"a": {"text": "A(BA)^k", "shapes": of_x}, "p": {"text": "(PQ)^f", "shapes": of_y}},
        "layers": [{"name": "wall", "x": {"pattern": "a"}, "y": {"pattern": "p"}, "shapes": own}],
    }
    for shape in solve(wall(design, **more)).shapes:
        count = {"A": 3, "B": 2, "P": 1, "Q": 1}
        # Every name that means a letter, and how exact it is.
        ranks = [
            {"*": 0, name: 1, f"{name}[{n - count[name] - 1}]": 2, f"{name}[{n}]": 3}
            for name, n in zip((shape.x, shape.y), shape.number, strict=True)
        ]
        expected: dict[str, Any] = {"material": "card", "offset": 0.0}
        for level in (design, of_x, of_y, own):
            pairs = sorted(product(*ranks), key=lambda pair: (ranks[0][pair[0]], ranks[1][pair[1]]))
            for x, y in pairs:
                expected |= level.get(f"{x} {y}", {})
        assert (shape.material, shape.offset) == (expected["material"], expected["offset"])


VARIED = {"variants": [{"weight": 3, "material": "brick"}, {"material": "stone", "kind": "window"}]}


class TestVariants:
    def many(self, seed: int, width: float = 401.0) -> dict[tuple[str, int, str, int], str]:
        return materials(solve(with_canvas(wall({"B *": VARIED}, seed=seed), width=width)))

    def test_each_is_chosen_as_often_as_it_weighs(self) -> None:
        chosen = Counter(material for cell, material in self.many(7).items() if cell[0] == "B")
        assert set(chosen) == {"brick", "stone"} and chosen.total() == 400
        assert 3 / 4 * 400 - 3 * 75**0.5 < chosen["brick"] < 3 / 4 * 400 + 3 * 75**0.5  # three deviations

    def test_a_seed_chooses_the_same_for_ever(self) -> None:
        layout = solve(wall({"* *": VARIED}, seed=1))
        assert "".join(shape.material[0] for shape in layout.shapes) == FOR_EVER

    def test_another_seed_chooses_otherwise(self) -> None:
        assert self.many(7, 41.0) != self.many(8, 41.0)

    def test_an_instance_keeps_its_variant_when_others_come(self) -> None:
        few, many = self.many(7, 41.0), self.many(7, 61.0)
        assert len(few) < len(many) and all(many[cell] == material for cell, material in few.items())

    def test_a_more_exact_key_overrides_what_was_chosen(self) -> None:
        found = materials(solve(wall({"* *": VARIED, "A[2] P": {"material": "glass"}})))
        assert found["A", 2, "P", 1] == "glass"

    def test_fields_that_a_variant_does_not_set_are_the_shapes_own(self) -> None:
        shapes = {"* *": {"kind": "door", **VARIED}}
        kinds = {(shape.material, shape.kind) for shape in solve(wall(shapes, seed=1)).shapes}
        assert kinds == {("brick", "door"), ("stone", "window")}

    def test_a_weight_of_nothing_is_never_chosen(self) -> None:
        shapes = {"* *": {"variants": [{"weight": 0, "material": "stone"}, {"weight": 1e-6, **BRICK}]}}
        assert set(materials(solve(wall(shapes))).values()) == {"brick"}


FOR_EVER = "bbbbbsbbbb"


@pytest.mark.parametrize("seed", [0, 5])
def test_words_and_sizes_do_not_depend_on_looks(seed: int) -> None:
    plain, varied = solve(wall({})), solve(wall({"B *": VARIED, "A[2] *": BRICK}, seed=seed))
    assert (plain.x, plain.y) == (varied.x, varied.y)
