"""The texture grammars that ship: each is read, encoded, decoded and drawn; rooms are where rays say they are."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from facade_nb import DesignError, gallery
from facade_nb.cli import main
from facade_nb.render.texture import Grammar, decode
from facade_nb.render.texture.painters import choose_painter
from facade_nb.render.texture.view import Looks
from facade_nb.render.tiles import TileSet
from scripts.docs.exhibits import EXHIBITS
from tests.render.texture.figure_12 import FIGURE_12

NAMES = gallery.grammars()


def test_every_figure_has_its_counterpart() -> None:
    assert [f"figure-{n}" for n in ("1", "6", "7", "8", "9", "10", "12", "13a", "13b")] == NAMES


def test_an_unknown_name_is_told_with_the_nearest() -> None:
    with pytest.raises(
        DesignError, match=r"found 'figure-13'; did you mean 'figure-13a'\?|did you mean 'figure-13b'"
    ):
        gallery.grammar("figure-13")


def test_figure_12_is_the_printed_one() -> None:
    def bare(text: str) -> str:
        return re.sub(r"\s|#.*", "", text)

    assert bare(gallery.grammar("figure-12")) == bare(FIGURE_12)


@pytest.mark.parametrize("name", NAMES)
def test_a_grammar_survives_its_texture(name: str) -> None:
    grammar = Grammar.parse(gallery.grammar(name))
    encoding = grammar.encoding
    assert encoding.texture.dtype == np.float16
    names = [rule.name for rule in grammar.rules]
    back = decode(encoding.texture, names, encoding.tiles)
    assert [(rule.name, rule.operator, rule.targets()) for rule in back] == [
        (rule.name, rule.operator, rule.targets()) for rule in grammar.rules
    ]


@pytest.mark.parametrize("name", NAMES)
def test_every_rule_of_a_grammar_is_used(name: str) -> None:
    """From the start rules (those that no other rule names) everything is reached, so nothing was left behind."""
    grammar = Grammar.parse(gallery.grammar(name))
    named = {target for rule in grammar.rules for target in rule.targets()}
    starts = {rule.name for k, rule in enumerate(grammar.rules) if k not in named}
    meant = {
        "figure-6": {"Every", "ByFloor", "ByPart"},
        "figure-8": {"S", "WallOnly", "Masked", "MaskOnly"},
        "figure-10": {"S", "Side", "Gable", "Roof"},
    }.get(name, {"S"})
    assert starts == meant


@pytest.mark.parametrize("name", NAMES)
def test_a_grammar_covers_its_facade(name: str) -> None:
    grammar = Grammar.parse(gallery.grammar(name))
    generator = np.random.default_rng(5)
    size = (17.0, 16.5)
    points = generator.uniform(0, 1, (3000, 2)) * size
    for seed in ((0.0, 0.0), (3.7, 1.3), (1e6, -4.2)):
        surface = grammar.evaluate(points, size, seed)
        assert surface.color[:, 3].min() > 0.99
        assert (surface.rule >= 0).all()
        assert np.isfinite(np.concatenate([surface.color, surface.normal, surface.specular])).all()


@pytest.mark.parametrize("name", NAMES)
def test_a_grammar_runs_on_the_command_line(name: str, tmp_path: Path) -> None:
    file, picture, rules = tmp_path / "g.txt", tmp_path / "g.png", tmp_path / "r.npy"
    file.write_text(gallery.grammar(name), "utf-8")
    words = f"render {file} --size 12x13.5 --pixels 48x54 --seed 3.7,1.3 --backend cpu --out {picture} --rules {rules}"
    assert main(words.split()) == 0
    assert picture.read_bytes()[:4] == b"\x89PNG"
    assert np.load(rules).shape == (54, 48)


@pytest.mark.parametrize("name", NAMES)
def test_the_shader_draws_what_numpy_does(name: str) -> None:
    """In software GL, slantwise: only pixels within 1e-4 m of a boundary may differ, and so few are hardly met."""
    grammar = Grammar.parse(gallery.grammar(name), TileSet.builtin(64))
    points = (np.random.default_rng(8).uniform(0, 1, (20_000, 2)) * (17.0, 16.5)).astype(np.float32)
    looks = Looks(
        points,
        np.tile(np.float32([0.3, 0.15, -1]), (len(points), 1)),
        np.full(len(points), 0.01, np.float32),
        0.002,
        np.ones(len(points), bool),
    )
    question = grammar.question((17.0, 16.5), (3.7, 1.3))
    here, there = (choose_painter(k).paint_at(question, looks, mips=True).surface for k in ("cpu", "osmesa"))
    differing = (here.rule != there.rule) | (np.abs(here.color - there.color).max(axis=1) > 1e-3)
    print(f"{name}: {differing.mean():.3%} of pixels differ")
    assert differing.mean() < 5e-4


def test_another_seed_makes_another_facade_where_there_is_chance() -> None:
    for name in NAMES:
        grammar = Grammar.parse(gallery.grammar(name))
        points = np.random.default_rng(1).uniform(0, 1, (2000, 2)) * (15, 13)
        first, second = (grammar.evaluate(points, (15, 13), seed).rule for seed in ((1, 2), (7.3, 4.1)))
        chance = any(
            rule.operator.name.startswith("RandU") or rule.operator.name == "Rand" for rule in grammar.rules
        )
        assert bool((first != second).any()) == chance, name


# Rooms -----------------------------------------------------------------------------------------------------


def _faces(
    points: np.ndarray, rays: np.ndarray, size: tuple[float, float], depth: float
) -> tuple[np.ndarray, np.ndarray]:
    """Which plane of a box behind the façade rays meet first, each plane on its own, and where in space."""
    width, height = size
    start = np.concatenate([points, np.zeros((len(points), 1))], axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        times = np.stack([
            np.where(rays[:, 0] < 0, (0 - start[:, 0]) / rays[:, 0], np.inf),
            (-depth - start[:, 2]) / rays[:, 2],
            np.where(rays[:, 0] > 0, (width - start[:, 0]) / rays[:, 0], np.inf),
            np.where(rays[:, 1] < 0, (0 - start[:, 1]) / rays[:, 1], np.inf),
            np.where(rays[:, 1] > 0, (height - start[:, 1]) / rays[:, 1], np.inf),
        ], axis=1)  # fmt: skip
    face = times.argmin(axis=1)
    return face, start + times[np.arange(len(face)), face][:, None] * rays


@pytest.mark.parametrize("eye", [(2.0, 1.7, 6.0), (-5.0, 1.2, 3.0), (9.0, 6.0, 2.0), (1.0, -3.0, 8.0), None])
def test_the_room_of_figure_8_moves_with_the_eye(eye: tuple[float, float, float] | None) -> None:
    """Two boxes and the furniture between them, against ray casting into explicit boxes; eye None: parallel rays."""
    size, near, far = (4.0, 4.0), 2.0, 2.0
    grammar = Grammar.parse(gallery.grammar("figure-8"))
    names = [rule.name for rule in grammar.rules]
    points = np.random.default_rng(3).uniform(0.001, 3.999, (4000, 2))
    start = np.concatenate([points, np.zeros((len(points), 1))], axis=1)
    rays = np.tile([0.35, -0.2, -1.0], (len(points), 1)) if eye is None else start - np.array(eye)
    face, hit = _faces(points, rays, size, near)
    expected = np.array(["NearLeft", "", "NearRight", "Floor", "Ceiling"], object)[face]
    # Through the plane of the furniture: a second box begins there.
    through = np.flatnonzero(face == 1)
    again, end = _faces(hit[through, :2], rays[through], size, far)
    expected[through] = np.array(["FarLeft", "End", "FarRight", "Floor", "Ceiling"], object)[again]
    # Eq. 1: what is left of 4 m after 2.1, 0.25 and 0.8 m is shared 1 : 0.4.
    spare = (4 - 2.1 - 0.25 - 0.8) / 1.4
    sofa, plant = (spare, spare + 2.1), (spare + 2.35, spare + 3.15)
    x, y = hit[through, 0], hit[through, 1]
    here = (x > sofa[0]) & (x < sofa[1]) & (y < 0.9) | (x > plant[0]) & (x < plant[1]) & (y < 1.5)
    margin = np.min(np.abs(x[:, None] - np.array([*sofa, *plant])), axis=1) < 1e-3
    found = np.array(names, object)[grammar.evaluate(points, size, start="Box", rays=rays).rule]
    clear = np.ones(len(points), bool)
    clear[through] = ~here & ~margin
    edges = np.abs(np.concatenate([hit[:, :2], 4 - hit[:, :2]], axis=1))
    corner = np.sort(edges, axis=1)[:, 0] > 1e-3  # not where two faces meet
    corner |= face != 1
    sure = clear & (np.abs(hit[:, 2] + near) > 1e-3) | (clear & (face == 1) & corner)
    deep = np.ones(len(points), bool)
    deep[through] = np.abs(end[:, 2] + far) > 1e-3
    deep[through] |= again == 1
    sure &= deep
    assert sure.mean() > 0.5
    assert (found[sure] == expected[sure]).mean() > 0.999
    assert set(found[through][here]) <= {"SofaTile", "PlantTile", *expected[through][here]}
    if eye is not None and here.any():
        assert {"SofaTile", "PlantTile"} & set(found[through][here])


def test_the_walls_of_a_room_are_one_choice_and_rooms_differ() -> None:
    """In Figure 10 every room has one kind of wall on all its faces, and neighbours do not all have the same."""
    grammar = Grammar.parse(gallery.grammar("figure-10"))
    names = [rule.name for rule in grammar.rules]
    size, seed = (17.5, 15.0), (4.6, 2.1)
    start = "ochre.Room"
    kinds = set()
    for left in np.arange(0, 17.5, 2.5):
        points = left * 1.0 + np.random.default_rng(2).uniform(0.05, 2.45, 300)
        at = np.stack([points, np.full(300, 1.4)], axis=1)
        rays = np.random.default_rng(4).uniform(-1, 1, (300, 3)) * (1.2, 0.4, 0) - (0, 0, 1)
        grammar_of_bays = _bays(start)
        rules = Grammar.parse(grammar_of_bays)
        found = rules.evaluate(at, size, seed, rays=rays).rule
        walls = {
            wall
            for wall in (
                "room-sage",
                "room-books",
                "room-terracotta",
                "room-blue",
                "room-paper",
                "room-white",
            )
            for rule in found
            if wall in rules.rules[rule].name
        }
        kinds.add(frozenset(walls))
        assert len(walls - {"room-white", "room-books"}) <= 1
    assert len(kinds) >= 3
    assert names[grammar.index("S")] == "S"


def _bays(room: str) -> str:
    """Figure 10 with a start rule that lays rooms side by side without a wall before them."""
    text = gallery.grammar("figure-10")
    return text.replace(
        "S -> RandUni(0, ochre.S,", f"S -> RepeatX(2.5, {room})\nFormer -> RandUni(0, ochre.S,", 1
    )


def test_the_page_tells_the_sizes_of_the_grammars() -> None:
    page = (Path(__file__).parents[2] / "docs" / "grammars.md").read_text("utf-8")
    for name in NAMES:
        grammar = Grammar.parse(gallery.grammar(name))
        row = f"| `{name}` | {EXHIBITS[name].title} | {len(grammar.rules)} | {grammar.encoding.bytes} |"
        assert row in page
        assert f"img/{name}.jpg" in page
        assert (Path(__file__).parents[2] / "docs" / "img" / f"{name}.jpg").stat().st_size < 300_000
