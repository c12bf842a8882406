"""Designs of one building with grammars of their own: the rules of all of them are drawn, in pictures and drawings."""

from __future__ import annotations

import base64
import io
import re

import numpy as np
from PIL import Image

from facade_nb import Building
from facade_nb.building.rules import Rules
from facade_nb.design import Design
from facade_nb.render.ruled import rule_pixels

TEXT = """
# Both grammars have a rule Flag, a setting and a namespace of the same names.
level = 1
Flag -> SplitX(Rel, 1, Left, Rel, 1, paint.Right)
Left -> Mat(Color, 0, {}, 1)
namespace paint {{
    Right -> Mat(Color, 0, {}, 1)
}}
"""
FLAGS = TEXT.format("level, 0, 0", "0, 0, level")
OTHERS = TEXT.format("0, level, 0", "level, level, 0")
RED, BLUE, GREEN, YELLOW = (255, 0, 0), (0, 0, 255), (0, 255, 0), (255, 255, 0)


def design(name: str, grammar: str) -> Design:
    """One wall, drawn by a rule."""
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": name,
            "canvas": {"width": 4.0, "height": 3.0},
            "symbols": {"A": {"size": 4.0}, "P": {"size": 3.0}},
            "patterns": {"x": "A", "y": "P"},
            "layers": [{"name": "wall", "x": {"pattern": "x"}, "y": {"pattern": "y"}}],
            "shapes": {"* *": {"kind": "wall", "material": "rule:Flag", "thickness": 0.3}},
            "grammar": grammar,
        }
    )


def colours(pixels: np.ndarray) -> set[tuple[int, ...]]:
    return {tuple(row) for row in pixels.reshape(-1, pixels.shape[-1])[:, :3].tolist()}


def test_grammars_of_the_same_names_stand_in_one_text():
    rules = Rules.of([FLAGS, "", OTHERS, FLAGS, "Flag -> Broken("])
    for grammar, left, right in ((FLAGS, RED, BLUE), (OTHERS, GREEN, YELLOW)):
        for name, wanted in (("rule:Flag", {left, right}), ("rule:paint.Right", {right})):
            told = rules.material(grammar, name)
            assert colours(rule_pixels(rules.text, told, (4.0, 3.0), 4.0)) == wanted
    assert rules.material(FLAGS, "rule:Flag") == "rule:Flag"  # the names of the first stay
    assert rules.material(OTHERS, "brick") == "brick"
    assert not rules.material("Flag -> Broken(", "rule:Flag").startswith("rule:")
    assert Rules.of([FLAGS]).text == FLAGS


def test_the_rules_of_all_walls_are_drawn():
    walls = [design("Flags", FLAGS), design("Others", OTHERS), None, None]
    layout = Building.rectangle(4.0, 4.0, walls).solve()
    pictures = [
        np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB"))
        for data in re.findall(r"data:image/png;base64,([^\"]+)", layout.elevation_svg())
    ]
    assert [colours(own) for own in pictures] == [{RED, BLUE}, {GREEN, YELLOW}]
    png = layout.render_png(size=(240, 160), rays=1, samples=1)
    pixels = np.asarray(Image.open(io.BytesIO(png)).convert("RGB")).astype(int)
    strong = pixels[(pixels.max(axis=2) - pixels.min(axis=2)) > 90]
    hues = {tuple((row > row.max() / 2).astype(int).tolist()) for row in strong}
    assert {(1, 0, 0), (0, 0, 1), (0, 1, 0), (1, 1, 0)} <= hues
