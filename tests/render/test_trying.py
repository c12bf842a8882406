"""A geometry and an operator of one's own: seen within their block alone, and alike in NumPy and GLSL."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from facade_nb import gallery, solve
from facade_nb.design import DesignError
from facade_nb.design.edit import with_shape
from facade_nb.render import GEOMETRIES, Geometry, Grammar, Move, build_scene, elevation_svg, to_glb, trying
from facade_nb.render.parts import Block, Part
from facade_nb.render.texture import OPERATORS, Sight
from facade_nb.render.texture.batch import Batch
from facade_nb.render.texture.painters import PAINTERS
from facade_nb.render.texture.shaders import shader

TEXT = """
S -> SplitX(Rel, 1, Leaf, Rel, 1, Other)
Other -> MirrorX(Leaf)
Leaf -> SplitX(Abs, 0.3, Red, Rel, 1, Room)
Room -> Intrusion(1, Red, Back, Blue, Back, Back)
Red -> Mat(Color, 0, 1, 0, 0, 1)
Blue -> Mat(Color, 0, 0, 0, 1, 1)
Back -> Mat(Color, Fit:door-modern, 0, 0, 1, 1)
"""
GLSL = "now.at.x = now.scope.x + now.scope.z - now.at.x; now.ray.x = -now.ray.x;"


def half(w: float, h: float, d: float) -> tuple[Part, ...]:
    return (Block(0, 0, w, h / 2, -d, 0),)


def whole(w: float, h: float, d: float) -> tuple[Part, ...]:
    return (Block(0, 0, w, h, -d, 0),)


def mirror(batch: Batch, v: float) -> Batch:
    x, y, z = batch.ray
    return replace(batch, x=batch.left + batch.right - batch.x, ray=(-x, y, z))


def shifted(batch: Batch, v: float) -> Batch:
    return replace(batch, x=batch.x + np.float32(v))


def colours(text: str, painter: str) -> np.ndarray:
    question = Grammar.parse(text).question((3, 2))
    sight = Sight.from_eye((1.5, 1, 3), (1.5, 1), (3, 2), (80, 40), angle=60)
    return PAINTERS[painter].paint(question, sight).surface.color.reshape(40, 80, 4)


def apart(a: np.ndarray, b: np.ndarray) -> float:
    """The share of pixels that differ: at an edge one may."""
    return float((np.abs(a - b).max(axis=2) > 0.01).mean())


def test_a_geometry_is_known_within_its_block_and_forgotten_after_it() -> None:
    layout = solve(with_shape(gallery.load("figure-8"), "* *", geometry="half"))
    drawn = []
    for make in (half, whole, half):  # the same name again, as a cell that is run again
        with trying(Geometry("half", make, "half of it")):
            drawn.append([solid.parts for solid in build_scene(layout).solids])
            assert "<svg" in elevation_svg(layout) and to_glb(layout)
    assert drawn[0] == drawn[2] != drawn[1]
    assert "half" not in GEOMETRIES
    with pytest.raises(DesignError, match="found 'half'"):
        elevation_svg(layout)


def test_an_operator_does_the_same_in_numpy_and_in_glsl_and_is_forgotten() -> None:
    before = shader("points.frag")
    with trying(Move("MirrorX", mirror, GLSL)):
        seen = colours(TEXT, "cpu")
        assert apart(seen, seen[:, ::-1]) < 0.01  # eye in the middle: what is mirrored looks mirrored
        assert apart(seen, colours(TEXT, "osmesa")) < 0.01
        assert "MirrorX" in [step.operator for step in Grammar.parse(TEXT).steps((2.5, 1), size=(3, 2))]
    with trying(Move("MirrorX", lambda batch, v: batch)):
        assert apart(colours(TEXT, "cpu"), seen) > 0.1
        assert apart(colours(TEXT, "osmesa"), seen) > 0.1  # without statements it is no mirror there either
    assert "MirrorX" not in OPERATORS and shader("points.frag") == before
    with pytest.raises(ValueError, match="there is no operator 'MirrorX'"):
        Grammar.parse(TEXT)


def test_two_at_once_one_of_them_with_a_number() -> None:
    text = TEXT.replace("Leaf -> Split", "Leaf -> MoveX(0.25, Moved)\nMoved -> Split")
    with trying(Move("MirrorX", mirror, GLSL)), trying(Move("MoveX", shifted, "now.at.x += v;", value=True)):
        seen = colours(text, "cpu")
        assert apart(seen, colours(text, "osmesa")) < 0.01
        assert apart(seen, colours(TEXT, "cpu")) > 0.1


@pytest.mark.parametrize(
    ("own", "told"),
    [
        (Geometry("box", half, ""), "there is a geometry 'box' already"),
        (Geometry("My Box", half, ""), "such as 'battlement', found 'My Box'"),
        (Move("RandUni", mirror), "there is an operator 'RandUni' already"),
        (Move("RANDUNI", mirror), "there is an operator 'RANDUNI' already"),
        (Move("mirror", mirror), "such as 'MirrorX', found 'mirror'"),
    ],
)
def test_a_name_that_cannot_be_used_is_told(own: Geometry | Move, told: str) -> None:
    with pytest.raises(ValueError, match=told), trying(own):
        pass


def test_what_is_neither_is_told() -> None:
    with pytest.raises(TypeError, match="expected a Geometry or a Move, found str"), trying("box"):  # type: ignore[arg-type]
        pass
