"""The styles of the town: walls of any size are whole, agree around a house, and have their doors on the street."""

from __future__ import annotations

import re
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from facade_nb import gallery
from facade_nb.render import Grammar
from facade_nb.render.texture.atlas import pack
from facade_nb.render.texture.program import children
from facade_nb.render.texture.steps import Chosen, Step
from facade_nb.render.tiles import TileSet
from facade_nb.render.town.solved import SOLVED, solve_text
from facade_nb.render.town.sparing import SparingTiles
from facade_nb.render.town.styles import STARTS, STYLES, Style, town_grammar, town_text
from tests.render.town.walls import DOORS, OPENINGS, parts, shows

WRITTEN = [style for style in STYLES if style.widths is None]
FRONTS = [style for style in STYLES if style.widths is not None]
WALLS = ("front", "street", "side", "court")
TILES = TileSet.builtin(16)


@pytest.fixture(scope="module")
def grammar() -> Grammar:
    """The town's grammar, with tiles that are drawn at once."""
    return Grammar.parse(town_text(), SparingTiles(TILES))


@pytest.mark.parametrize("style", STYLES, ids=lambda s: s.name)
def test_a_style_has_all_starts_and_they_are_rules(style: Style, grammar: Grammar) -> None:
    assert set(STARTS) <= set(style.starts)
    for rule in style.starts.values():
        grammar.index(rule)
    assert abs(sum(weight for _, weight in style.roofs) - 1) < 1e-9
    for what in WALLS:
        assert style.start(what, style.narrow) == style.starts[what]
        assert style.start(what, style.least - 0.01) == style.starts["plain"]


def test_the_ground_and_plain_colours_are_there(grammar: Grammar) -> None:
    for name in ("Asphalt", "Pavement", "Court", "Grass", "Field"):
        found = grammar.evaluate([(3.1, 4.7), (900, 700)], (2000, 2000), (1, 2), f"ground.{name}")
        assert (found.color[:, 3] > 0.999).all()
    for name in ("White", "Grey", "Dark", "Brick", "Stone", "Wood", "Metal", "Leaf", "Glass", "Water"):
        grammar.index(f"plain.{name}")


def test_the_grammar_keeps_within_its_bounds() -> None:
    grammar = town_grammar()
    assert grammar is town_grammar()
    names = grammar.encoding.tiles
    assert len({name.partition(".")[0] for name in names}) <= 92
    assert set(names) <= set(TILES.names)
    small = pack(SparingTiles(TileSet.builtin(32)), names).pixels.nbytes
    assert small * (256 // 32) ** 2 < 60e6
    _, (frames, seeds, _) = grammar._depths
    assert frames <= 4
    assert seeds <= 2


@pytest.mark.parametrize("style", WRITTEN, ids=lambda s: s.name)
def test_no_absolute_part_is_too_large_for_a_legal_wall(style: Style, grammar: Grammar) -> None:
    dense = [style.least + 0.15 * k for k in range(80)]  # bays are narrowest where one more begins
    for what in (*WALLS, "plain", "party"):
        for width in [60.0, *dense] if what in ("front", "court") else [0.4, style.narrow, 60.0]:
            start = style.start(what, width)
            for storeys in (1, 12) if width == 60 else (2,):
                for part in parts(grammar, start, (width, style.eaves(storeys)), alike=True):
                    name = grammar.rules[part.rule].name
                    assert part.overflow < 0.005, f"{start}, {width} m, {storeys} storeys: {name}"


@pytest.mark.parametrize("style", STYLES, ids=lambda s: s.name)
def test_walls_are_opaque_at_any_size(style: Style, grammar: Grammar) -> None:
    rng = np.random.Generator(np.random.PCG64(11))
    for what in (*WALLS, "party", "gable", "plain", "roof", "flat"):
        for width in style.widths or (style.least, style.narrow, 23.7):
            high = (
                style.eaves(int(rng.integers(1, 13))) if not style.widths else style.eaves(style.storeys[0])
            )
            points = rng.uniform((0, 0), (width, high), (60, 2))
            found = grammar.evaluate(
                points, (width, high), (float(rng.uniform(0, 999)), 5), style.start(what, width)
            )
            assert (found.color[:, 3] > 0.999).all(), (what, width, high)


@pytest.mark.parametrize("style", WRITTEN, ids=lambda s: s.name)
def test_no_opening_is_cut_by_a_corner(style: Style, grammar: Grammar) -> None:
    for what in WALLS:
        for width in (style.least, style.narrow, 17.3):
            for part in parts(grammar, style.start(what, width), (width, style.eaves(2))):
                if shows(grammar, part.rule, OPENINGS):
                    left, _, right, _ = part.scope
                    assert left >= 0.3 - 1e-6, grammar.rules[part.rule].name
                    assert right <= width - 0.3 + 1e-6, grammar.rules[part.rule].name


@pytest.mark.parametrize("style", WRITTEN, ids=lambda s: s.name)
def test_floors_and_courses_agree_around_a_house(style: Style, grammar: Grammar) -> None:
    """The scopes that a corner is in, as far as they reach up, are the same on all walls."""
    high = style.eaves(3)
    levels = np.arange(0.05, high, 0.43)
    for seed in ((3.0, 5.0), (411.0, 2.5)):
        found = {}
        for what, width, x in (
            ("front", 14.3, 14.1),
            ("side", 11.0, 0.15),
            ("court", 21.7, 0.15),
            ("plain", 2.0, 0.1),
        ):
            start = style.start(what, width)
            rows = [_floor(grammar.steps((x, y), (width, high), seed, start)) for y in levels]
            found[what] = [row for k, row in enumerate(rows) if row not in rows[:k]]
        floors = {row for row in found["front"] if row}
        assert len(floors) == 2
        assert floors == set(filter(None, found["side"])) == set(filter(None, found["court"]))


def _floor(steps: tuple[Step, ...]) -> tuple[float, float] | None:
    """The floor, above the ground floor, that a pixel is in: bottom and top."""
    for before, after in pairwise(steps):
        if before.operator == "RepeatY" and before.name.endswith("Floors"):
            return round(after.scope[1], 4), round(after.scope[3], 4)
    return None


@pytest.mark.parametrize("style", WRITTEN, ids=lambda s: s.name)
def test_the_grammar_makes_the_storeys_that_the_style_says(style: Style, grammar: Grammar) -> None:
    for storeys in (1, 2, 3, 7, 12):
        assert style.fit(style.eaves(storeys)) == storeys
        for more in (0.0, 0.3, 1.7):
            high = style.eaves(storeys) + more
            floors = {
                (round(part.scope[1], 3), round(part.scope[3], 3))
                for part in parts(grammar, style.starts["side"], (style.narrow + 1, high))
                if part.rule in _storeys(grammar) and part.scope[1] > style.ground - 0.01
            }
            assert 1 + len(floors) == style.fit(high), (storeys, more)


@lru_cache(maxsize=1)
def _storeys(grammar: Grammar) -> frozenset[int]:
    """The rules that a storey begins with."""
    return frozenset(
        rule.targets()[0]
        for rule in grammar.rules
        if rule.operator.name == "RepeatY" and rule.name.endswith("Floors")
    )


def test_the_storeys_of_a_solved_front_are_what_it_shows() -> None:
    for style, solved in zip(FRONTS, SOLVED, strict=True):
        assert style.eaves(solved.storeys) == pytest.approx(solved.height)
        assert style.fit(solved.height) == solved.storeys
        assert style.fit(solved.height * 1.2) == 0
        assert style.suits(solved.width, solved.height)
        assert not style.suits(solved.width * 1.1, solved.height)


def test_the_solved_fronts_that_ship_are_what_is_solved_now() -> None:
    assert gallery.town("solved") == solve_text(), "run scripts/fronts.py"


@pytest.mark.parametrize("style", STYLES, ids=lambda s: s.name)
def test_doors_are_on_the_front_alone(style: Style, grammar: Grammar) -> None:
    below = children(grammar.rules)
    for what, start in style.starts.items():
        reached, waiting = set(), [grammar.index(start)]
        while waiting:
            rule = waiting.pop()
            if rule not in reached and grammar.rules[rule].operator.name != "Intrusion":
                reached.add(rule)
                waiting += below[rule]
        has = any(shows(grammar, rule, DOORS) for rule in reached)
        assert has == (what in ("front", "short-front")), what


@pytest.mark.parametrize("style", WRITTEN, ids=lambda s: s.name)
def test_a_front_has_one_door(style: Style, grammar: Grammar) -> None:
    for width, seed in ((style.least, 2.0), (style.narrow, 31.5), (15.9, 63.0), (15.9, 94.5), (15.9, 180.25)):
        size = (width, style.eaves(2))
        seen = [
            any(shows(grammar, step.rule, DOORS) for step in grammar.steps((x, 1.5), size, (seed, 4), start))
            for start in [style.start("front", width)]
            for x in np.arange(0.02, width, 0.45)
        ]
        assert (np.diff(np.array(seen, int)) == 1).sum() == 1, (width, seed)


@pytest.mark.parametrize("style", WRITTEN, ids=lambda s: s.name)
def test_rooms_at_a_corner_are_the_same_from_both_walls(style: Style, grammar: Grammar) -> None:
    high = style.eaves(4)
    kinds = set()
    for seed in ((3.0, 5.0), (123.0, 7.0)):
        for floor in (1, 3):
            y = style.ground + (floor - 1) * style.storey + 0.62 * style.storey
            front = _choices(grammar, style, "street", 16.0, high, y, seed, last=True)
            side = _choices(grammar, style, "side", 12.5, high, y, seed, last=False)
            short = _choices(grammar, style, "street", style.narrow - 0.4, high, y, seed, last=False)
            assert front == side, (seed, floor)
            assert {what: short[what] for what in front} == front, (seed, floor)
            if floor == 1:
                court = _choices(grammar, style, "court", 19.0, high, y, seed, last=False)
                assert court == front
            kinds.add(tuple(sorted(front.items())))
    assert len(kinds) > 1


def _choices(
    grammar: Grammar, style: Style, what: str, width: float, high: float, y: float,
    seed: tuple[float, float], last: bool,
) -> dict[str, int]:  # fmt: skip
    """What the room next to a corner has chosen: its kind and its lamp, as the number of the part."""
    found: dict[str, int] = {}
    for away in np.arange(0.75, 2.6, 0.18):
        x = width - away if last else float(away)
        for step in grammar.steps((x, y), (width, high), seed, style.start(what, width)):
            for name in ("Kind", "Lamp("):
                if isinstance(step, Chosen) and name in step.name and step.faces == ():
                    found.setdefault(name, step.part)
    assert found
    return found


@pytest.mark.parametrize("style", STYLES, ids=lambda s: s.name)
def test_looks(style: Style, grammar: Grammar) -> None:
    """All walls and the roof of a house make the same first choice, and there are as many as the style says."""
    options = {len(grammar.rules[grammar.index(start)].parts) for start in style.starts.values()}
    if style.looks == 1:
        return
    assert options == {style.looks}
    rng = np.random.Generator(np.random.PCG64(3))
    chosen = set()
    for _ in range(30):
        seed = (float(rng.integers(0, 16000)) / 64, float(rng.integers(0, 16000)) / 64)
        per_wall = set()
        for what in ("front", "party", "roof"):
            start = style.starts[what]
            first = grammar.steps((0.1, 2.0), (12.0, style.eaves(2)), seed, start)[0]
            assert isinstance(first, Chosen)
            per_wall.add(first.part)
        assert len(per_wall) == 1
        chosen |= per_wall
    assert chosen == set(range(style.looks))


def test_the_examples_of_the_page_work(grammar: Grammar) -> None:
    page = (Path(__file__).parents[3] / "docs" / "town-styles.md").read_text("utf-8")
    (own,) = re.findall(r"```\n(namespace cabin .*?)```", page, re.DOTALL)
    cabin = Grammar.parse(gallery.town("shared") + own, SparingTiles(TILES))
    points = np.random.Generator(np.random.PCG64(5)).uniform((0, 0), (9, 5.9), (200, 2))
    assert (cabin.evaluate(points, (9, 5.9), (1, 2), "cabin.Front").color[:, 3] > 0.999).all()
    for style in WRITTEN:
        heights = f"| {style.ground:g}, {style.storey:g}, {style.top:g} m | {style.looks} |"
        assert re.search(rf"\| `{style.name}` \|.*{re.escape(heights)}", page)
