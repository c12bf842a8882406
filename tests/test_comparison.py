"""Edits counted in layers and in split rules: those of the paper's section 6.1."""

from __future__ import annotations

from dataclasses import replace

import pytest

from facade_nb import Design
from facade_nb.comparison import Edits, edits
from facade_nb.design.edit import add_layer, with_counter, with_pattern, with_symbol


@pytest.fixture(scope="module")
def basic() -> Design:
    """One layer, as the paper begins: blocks of windows and balconies on floors, between ledges."""
    sizes = {"W": 2.0, "B": 1.5, "G": 3.0, "S": 2.8, "T": 2.5, "X": 0.3, "Y": 0.3}
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": "Terraced house",
            "canvas": {"width": 12.5, "height": 14.5},
            "symbols": {name: {"size": size} for name, size in sizes.items()},
            "patterns": {"bays": "W(BW)^n", "floors": "GXS^mYT"},
            "layers": [{"name": "blocks", "x": {"pattern": "bays"}, "y": {"pattern": "floors"}}],
        }
    )


def test_nothing_to_write(basic: Design) -> None:
    assert edits(basic, basic) == Edits(0, 0, 0)


def test_a_delimiter_is_one_pattern_and_a_rule_for_each_kind_of_row(basic: Design) -> None:
    after = with_pattern(with_symbol(basic, "Q", size=0.2), "bays", "W(QBW)^n")
    assert edits(basic, after) == Edits(patterns=1, layers=0, split_rules=5)


def test_other_sizes_and_more_repetitions_are_no_edit(basic: Design) -> None:
    wider = replace(basic, canvas=replace(basic.canvas, width=19.5))
    assert edits(basic, wider) == Edits(0, 0, 0)


def test_the_same_parts_in_another_order_are_an_edit(basic: Design) -> None:
    """A balcony block more at the right end: each kind of row ends differently."""
    after = with_pattern(basic, "bays", "W(BW)^n BB")
    assert edits(basic, after) == Edits(patterns=1, layers=0, split_rules=5)


def test_large_balconies_on_odd_floors(basic: Design) -> None:
    after = with_pattern(with_symbol(basic, "L", size=3.5, opaque=False), "large", "W l h; l := L")
    after = with_pattern(with_symbol(after, "Z", size=2.8), "odd", "GX(zS)^p z^b Y v; z := Z")
    after = with_symbol(after, "v", size=2.5)
    after = with_counter(after, "b", max=1)
    after = add_layer(after, "balconies", "large", "odd")
    found = edits(basic, after)
    assert (found.patterns, found.layers) == (2, 1)
    assert found.split_rules == 4  # the paper: twice as many as patterns
