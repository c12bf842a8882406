"""The designs that ship: each can be read, written, solved and drawn; the steps of the house tell its making."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from importlib import resources
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import pytest

from facade_nb import Design, DesignError, Layout, gallery, solve
from facade_nb.render import build_scene, elevation_svg

NAMES = gallery.names()


@pytest.fixture(scope="module")
def solved() -> Callable[[str], Layout]:
    layouts: dict[str, Layout] = {}

    def get(name: str) -> Layout:
        if name not in layouts:
            layouts[name] = solve(gallery.load(name), time_limit=120.0)
        return layouts[name]

    return get


def test_the_designs_of_the_paper_are_there() -> None:
    expected = {
        "residential-house", "apartment-house", "terraced-house", "teaser", "bookshop", "concert-hall", "figure-7",
        "figure-8", "figure-2", "hotel", "kongresshaus", "ingolstadt-4018215", "ingolstadt-4018128",
        "ingolstadt-4018154", "ingolstadt-4018204c", "ingolstadt-4018257", "ingolstadt-4018262",
        "qualifiers-a", "qualifiers-b", "qualifiers-c", "qualifiers-d",
    }  # fmt: skip
    assert expected <= set(NAMES)
    assert sorted(NAMES) == NAMES


def test_an_unknown_name_tells_the_nearest() -> None:
    with pytest.raises(DesignError, match=r"found 'residental-house'; did you mean 'residential-house'\?"):
        gallery.load("residental-house")


@pytest.mark.parametrize("name", ["../gallery/teaser", "steps/residential-house", "", "teaser.json"])
def test_only_names_are_taken(name: str) -> None:
    with pytest.raises(DesignError, match="expected the name of a design of the gallery"):
        gallery.load(name)


@pytest.mark.parametrize("name", NAMES)
def test_each_survives_a_round_trip(name: str) -> None:
    design = gallery.load(name)
    assert Design.from_json(design.to_json()) == design
    assert Design.from_dict(design.to_dict()) == design


@pytest.mark.parametrize("name", NAMES)
def test_each_solves_to_the_proven_optimum(name: str, solved: Callable[[str], Layout]) -> None:
    layout = solved(name)
    assert layout.complete and layout.x.proven and layout.y.proven
    assert layout.holes == ()
    assert layout.warnings == ()


@pytest.mark.parametrize("name", NAMES)
def test_each_layout_survives_a_round_trip(name: str, solved: Callable[[str], Layout]) -> None:
    layout = solved(name)
    assert Layout.from_dict(json.loads(json.dumps(layout.to_dict()))) == layout


@pytest.mark.parametrize("name", NAMES)
def test_each_can_be_drawn_and_built(name: str, solved: Callable[[str], Layout]) -> None:
    """An unknown material or geometry would raise."""
    layout = solved(name)
    drawing = ElementTree.fromstring(elevation_svg(layout))
    drawn = [group for group in drawing.iter() if group.get("data-shape") is not None]
    assert len(drawn) == len(layout.shapes)
    assert len({solid.index for solid in build_scene(layout).solids}) == len(layout.shapes)


@pytest.mark.parametrize("name", NAMES)
def test_no_material_or_geometry_is_declared_for_nothing(name: str, solved: Callable[[str], Layout]) -> None:
    """Every shape a layer or the design describes by an exact key is of symbols that meet in some layer."""
    design = gallery.load(name)
    met = {
        (x, y)
        for layer in design.layers
        for x in design.patterns[layer.x.pattern].parsed.symbols
        for y in design.patterns[layer.y.pattern].parsed.symbols
    }
    exact = [
        tuple(re.sub(r"\[-?\d+\]", "", key).split(" "))
        for owner in (design, *design.layers)
        for key in owner.shapes
        if "*" not in key
    ]
    assert [key for key in exact if key not in met] == []


@pytest.mark.parametrize("name", NAMES)
def test_every_symbol_pattern_and_counter_is_used(name: str) -> None:
    design = gallery.load(name)
    used = {axis.pattern for layer in design.layers for axis in (layer.x, layer.y)}
    parsed = [pattern.parsed for pattern in design.patterns.values()]
    assert set(design.patterns) == used
    assert set(design.symbols) <= {symbol for pattern in parsed for symbol in pattern.symbols}
    assert set(design.counters) <= {counter for pattern in parsed for counter in pattern.counters}


def test_steps_begin_with_the_empty_canvas_and_end_with_the_house() -> None:
    steps = gallery.steps("residential-house")
    titles = gallery.step_titles("residential-house")
    assert len(steps) == len(titles) == 18
    assert len(set(titles)) == 18 and all(titles)
    assert (steps[0].canvas.width, steps[0].canvas.height, steps[0].layers) == (6.0, 3.0, ())
    assert steps[-1] == gallery.load("residential-house")
    assert all(before != after for before, after in pairwise(steps))


def test_each_step_is_a_valid_design_of_its_own() -> None:
    for step in gallery.steps("residential-house"):
        assert Design.from_json(step.to_json()) == step


def test_designs_without_steps_say_which_have_them() -> None:
    for ask in (gallery.steps, gallery.step_titles):
        with pytest.raises(
            DesignError, match=r"expected a design with steps \(residential-house\); 'teaser' has none"
        ):
            ask("teaser")
        with pytest.raises(DesignError, match="did you mean 'residential-house'"):
            ask("residential-hous")


def test_what_is_returned_is_the_callers_own_list() -> None:
    gallery.steps("residential-house").clear()
    gallery.names().clear()
    assert len(gallery.steps("residential-house")) == 18
    assert gallery.names() == NAMES


def test_the_files_are_where_an_installed_package_finds_them() -> None:
    files = {file.name for file in resources.files("facade_nb.gallery").iterdir()}
    assert {f"{name}.json" for name in NAMES} <= files


def test_the_house_is_symmetrical(solved: Callable[[str], Layout]) -> None:
    layout = solved("residential-house")
    width = layout.canvas.width

    def key(x: str, y: str, rect: tuple[float, ...]) -> tuple[str, str, tuple[float, ...]]:
        return (x, y, tuple(round(v, 6) + 0.0 for v in rect))

    shapes = {key(s.x, s.y, s.rect) for s in layout.shapes}
    mirrored = {
        key(s.x, s.y, (width - s.rect[2], s.rect[1], width - s.rect[0], s.rect[3])) for s in layout.shapes
    }
    assert shapes == mirrored


def test_the_house_looks_as_a_designer_would_draw_it(solved: Callable[[str], Layout]) -> None:
    layout = solved("residential-house")
    assert layout.counters == {"k": 3}
    by_kind = {
        kind: [s.rect for s in layout.shapes if s.kind == kind]
        for kind in ("window", "door", "column", "roof")
    }
    (door,) = by_kind["door"]
    (roof,) = by_kind["roof"]
    left, right = sorted(by_kind["column"])
    assert door[1] == 0.0 and 0.9 < door[2] - door[0] < 1.3
    assert all(1.1 <= w[2] - w[0] <= 1.3 for w in by_kind["window"])
    assert len(by_kind["window"]) == 5  # the door took the place of the sixth
    assert all(
        min(w[2], door[2]) <= max(w[0], door[0]) + 1e-6 or w[1] >= door[3] - 1e-6 for w in by_kind["window"]
    )
    assert left[0] < 0.2 and right[2] > 5.8 and left[2] - left[0] == pytest.approx(0.3)
    assert roof == pytest.approx((0.0, 3.0, 6.0, 4.5))
    assert layout.y.sizes["Q"] < layout.y.sizes["P"]


def test_the_documentation_tells_of_every_design(root: Path) -> None:
    """docs/gallery.md: a row of the table with the number of layers and symbols, and a section."""
    text = (root / "docs" / "gallery.md").read_text(encoding="utf-8")
    rows = {
        m[1]: (int(m[2]), int(m[3]))
        for m in re.finditer(r"^\| `([\w-]+)`.*? \| (\d+) \| (\d+) \|", text, re.M)
    }
    counted = {}
    for name in NAMES:
        design = gallery.load(name)
        parsed = [pattern.parsed for pattern in design.patterns.values()]
        symbols = {s for p in parsed for s in (*p.symbols, *(symbol for symbol, _ in p.substitutions))}
        counted[name] = (len(design.layers), len(symbols))
    assert len({counted[f"qualifiers-{letter}"] for letter in "abcd"}) == 1  # they share a row
    assert rows == {
        name: counts for name, counts in counted.items() if name not in {f"qualifiers-{c}" for c in "bcd"}
    }
    for name in rows:
        assert re.search(rf"^## {name}\b", text, re.M), name
