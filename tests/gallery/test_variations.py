"""Variations of the gallery's buildings, as in the paper's Figure 10: other canvases, other sizes, edited structure."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import replace

import pytest

from facade_nb import Design, DesignError, gallery, solve

BUILDINGS = [name for name in gallery.names() if not name.startswith(("figure-7", "figure-8", "qualifiers-"))]
STRUCTURE = ("patterns", "layers", "shapes")
YIELDING = {"bookshop": {"G"}, "residential-house": {"A"}}
"""Piers that take what room is left, in the designs themselves, too."""


def changed(name: str, variation: str) -> set[str]:
    """The fields of a design that a variation changes."""
    before, after = gallery.load(name), gallery.load(name, variation)
    return {
        field
        for field in ("canvas", "symbols", "counters", *STRUCTURE)
        if getattr(before, field) != getattr(after, field)
    }


@pytest.mark.parametrize("name", BUILDINGS)
def test_each_building_has_another_canvas_other_sizes_and_another_structure(name: str) -> None:
    names, titles = gallery.variations(name), gallery.variation_titles(name)
    assert len(names) == len(titles) == len(set(titles)) == 3 and all(titles)
    canvas, sizes, structure = (changed(name, variation) for variation in names)
    assert "canvas" in canvas
    assert "symbols" in sizes and not sizes & set(STRUCTURE)
    assert structure & set(STRUCTURE)


def openings(design: Design, yielding: Set[str]) -> int:
    """How many windows and doors there are, in a layout that is whole and near to the preferred sizes."""
    layout = solve(design)
    assert layout.complete and layout.x.proven and layout.y.proven
    assert layout.holes == () and layout.warnings == ()
    for symbol, size in (*layout.x.sizes.items(), *layout.y.sizes.items()):
        preferred = None if symbol in yielding else design.symbol(symbol).size
        if preferred is not None:  # a tenth more or less is seen by nobody; a post may be 0.1 m wider
            assert abs(size - preferred) <= max(0.1 * preferred, 0.1), (symbol, size, preferred)
    doors = [shape.rect for shape in layout.shapes if shape.kind in ("door", "gate") and shape.rect[1] < 0.6]
    assert doors and all(0.8 <= right - left <= 3.0 for left, _, right, _ in doors)
    return sum(shape.kind in ("window", "door") for shape in layout.shapes)


@pytest.mark.parametrize("name", BUILDINGS)
def test_each_variation_is_a_building(name: str) -> None:
    yielding = YIELDING.get(name, set())
    found = [openings(gallery.load(name, variation), yielding) for variation in gallery.variations(name)]
    assert found[0] > openings(
        gallery.load(name), yielding
    )  # a larger canvas has more windows, not larger ones


def test_the_hotels_first_floor_lines_up_only_where_it_is_in_the_group_of_the_others() -> None:
    """The intentional misalignment of the paper's section 3.5."""

    def shared(variation: str | None) -> int:
        shapes = [s for s in solve(gallery.load("hotel", variation)).shapes if s.kind == "window"]
        middle = {s.y: {round((o.rect[0] + o.rect[2]) / 2, 2) for o in shapes if o.y == s.y} for s in shapes}
        return len(middle["w"] & middle["W"]) - len(middle["w"])

    assert shared(None) < 0 == shared("aligned")


def test_what_a_variation_is_of_stays_as_it_was() -> None:
    before = gallery.load("hotel")
    gallery.load("hotel", "aligned")
    gallery.variations("hotel").clear()
    assert gallery.load("hotel") == before == replace(gallery.load("hotel", None))
    assert gallery.variations("hotel") == ["larger", "large-windows", "aligned"]


def test_unknown_names_tell_the_nearest_and_designs_without_variations_have_none() -> None:
    with pytest.raises(
        DesignError, match=r"a variation of 'hotel' \(larger, .*'alined'; did you mean 'aligned'\?"
    ):
        gallery.load("hotel", "alined")
    with pytest.raises(DesignError, match="did you mean 'hotel'"):
        gallery.variations("hotle")
    assert gallery.variations("figure-7") == gallery.variation_titles("figure-7") == []
    with pytest.raises(DesignError, match=r"a variation of 'figure-7' \(it has none\)"):
        gallery.load("figure-7", "wider")
