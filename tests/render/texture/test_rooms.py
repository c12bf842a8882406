"""Rooms: the parallax against ray casting into explicit boxes in the world's coordinates."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from facade_nb.render import Grammar
from facade_nb.render.texture.view import Sight

PAINT = "\n".join(f"{name} -> Mat(Color, 0, 0, 0, {k / 10}, 1)" for k, name in enumerate("LBRFC"))
FACES = "LBRFC"
Array = NDArray[np.float64]


def cast(eye: Array, directions: Array, low: Array, high: Array) -> tuple[NDArray[np.intp], Array]:
    """Where rays from an eye in front of a box, open in front, end inside it: the face (as in `FACES`), the point."""
    with np.errstate(divide="ignore", invalid="ignore"):
        planes = np.stack(
            [
                np.where(directions[:, 0] < 0, (low[0] - eye[0]) / directions[:, 0], np.inf),
                (low[2] - eye[2]) / directions[:, 2],
                np.where(directions[:, 0] > 0, (high[0] - eye[0]) / directions[:, 0], np.inf),
                np.where(directions[:, 1] < 0, (low[1] - eye[1]) / directions[:, 1], np.inf),
                np.where(directions[:, 1] > 0, (high[1] - eye[1]) / directions[:, 1], np.inf),
            ]
        )
    inside = np.where(planes * -directions[:, 2] >= eye[2] - 1e-12, planes, np.inf)  # behind the façade only
    face = np.argmin(inside, axis=0)
    return face, eye + directions * np.take_along_axis(inside, face[None], 0)[0][:, None]


def seen(
    text: str, eye: tuple[float, float, float], points: Array, size: tuple[float, float]
) -> NDArray[np.int32]:
    spots = np.concatenate([points, np.zeros((len(points), 1))], axis=1)
    return Grammar.parse(text).evaluate(points, size, rays=spots - np.array(eye)).rule


eyes = st.tuples(st.floats(-5, 9), st.floats(-4, 8), st.floats(0.3, 12))


@given(eyes, st.floats(0.2, 5))
@settings(max_examples=150)
def test_faces_of_a_room(eye: tuple[float, float, float], depth: float) -> None:
    points = np.random.Generator(np.random.PCG64(3)).random((200, 2)) * (4, 3)
    depth = float(np.float16(depth))
    rule = seen(f"S -> Intrusion({depth}, L, B, R, F, C)\n{PAINT}", eye, points, (4, 3))
    rays = np.concatenate([points, np.zeros((200, 1))], axis=1) - eye
    face, spot = cast(np.array(eye), rays, np.array([0, 0, -depth]), np.array([4.0, 3.0, 0.0]))
    box = np.array([[0, 4], [0, 3], [-depth, 0]])
    near = (
        np.sort(np.abs(spot[:, :, None] - box).reshape(200, 6), axis=1)[:, 1] < 1e-4
    )  # at an edge of the box
    assert near.mean() < 0.1
    assert (rule[~near] == face[~near] + 1).all()


LINES = """
S -> Intrusion(2, Side, Back, Side, Flat, Flat)
Side -> SplitX(Abs, 0.5, A, Rel, 1, Side2)
Side2 -> SplitY(Abs, 1, B, Rel, 1, C)
Back -> SplitX(Rel, 1, D, Rel, 1, E)
Flat -> SplitY(Abs, 0.5, F, Rel, 1, G)
""" + "\n".join(f"{name} -> Mat(Color, 0, 0, 0, {k / 10}, 1)" for k, name in enumerate("ABCDEFG"))


@pytest.mark.parametrize("eye", [(1.0, 1.6, 4.0), (3.5, 0.4, 1.0), (-2.0, 5.0, 3.0), (2.0, 1.5, 0.5)])
def test_where_things_stand_on_the_faces(eye: tuple[float, float, float]) -> None:
    """On side walls u runs to the right as one looks at them; the floor's lower edge is near, the ceiling's far."""
    points = np.random.Generator(np.random.PCG64(4)).random((2000, 2)) * (4, 3)
    names = [rule.name for rule in Grammar.parse(LINES).rules]
    rule = np.array(names)[seen(LINES, eye, points, (4, 3))]
    rays = np.concatenate([points, np.zeros((len(points), 1))], axis=1) - eye
    face, spot = cast(np.array(eye), rays, np.array([0, 0, -2.0]), np.array([4.0, 3.0, 0.0]))
    x, y, deep = spot[:, 0], spot[:, 1], -spot[:, 2]
    side = np.where(y < 1, "B", "C")
    wanted = np.choose(
        face,
        [
            np.where(deep < 0.5, "A", side),
            np.where(x < 2, "D", "E"),
            np.where(2 - deep < 0.5, "A", side),
            np.where(deep < 0.5, "F", "G"),
            np.where(2 - deep < 0.5, "F", "G"),
        ],
    )
    assert (rule != wanted).mean() < 0.003  # those within a rounding of an edge
    assert len(set(wanted)) >= 5


@given(eyes)
@settings(max_examples=60)
def test_a_room_in_the_back_wall_of_a_room(eye: tuple[float, float, float]) -> None:
    """An intrusion within an intrusion: a niche 1 m deep in a back wall 2 m behind the façade."""
    text = f"""
    S -> Intrusion(2, Skip, Wall, Skip, Skip, Skip)
    Wall -> SplitX(Abs, 1, Skip, Abs, 2, Middle, Rel, 1, Skip)
    Middle -> SplitY(Abs, 0.5, Skip, Abs, 2, Niche, Rel, 1, Skip)
    Niche -> Intrusion(1, L, B, R, F, C)
    Skip -> Skip(0)
    {PAINT}
    """
    points = np.random.Generator(np.random.PCG64(5)).random((400, 2)) * (4, 3)
    rule = seen(text, eye, points, (4, 3))
    rays = np.concatenate([points, np.zeros((400, 1))], axis=1) - eye
    outer, spot = cast(np.array(eye), rays, np.array([0, 0, -2.0]), np.array([4.0, 3.0, 0.0]))
    inner, deep = cast(np.array(eye), rays, np.array([1, 0.5, -3.0]), np.array([3.0, 2.5, -2.0]))
    x, y = spot[:, 0], spot[:, 1]
    hit = (outer == 1) & (x > 1) & (x < 3) & (y > 0.5) & (y < 2.5)
    wanted = np.where(hit, inner + 5, -1)
    edges = np.concatenate(
        [spot - [[1, 0.5, -2]], spot - [[3, 2.5, -2]], deep - [[1, 0.5, -3]], deep - [[3, 2.5, -2]]], 1
    )
    near = (np.abs(edges[:, [0, 1, 3, 4]]).min(axis=1) < 1e-3) | (
        np.sort(np.abs(edges[:, 6:]), axis=1)[:, 1] < 1e-3
    )
    assert (rule[~near] == wanted[~near]).all()


def test_orthographic_rays_are_those_given() -> None:
    rule = Grammar.parse(f"S -> Intrusion(1, L, B, R, F, C)\n{PAINT}").evaluate(
        [(1, 1)] * 5, (2, 2), rays=[(-3, 0, -1), (0.1, 0.1, -1), (3, 0, -1), (0, -3, -1), (0, 3, -1)]
    )
    assert rule.rule.tolist() == [1, 2, 3, 4, 5]
    straight = Grammar.parse(f"S -> Intrusion(1, L, B, R, F, C)\n{PAINT}").evaluate([(0.01, 0.01)], (2, 2))
    assert straight.rule.tolist() == [2]


def test_a_camera_sees_the_room_that_its_rays_do() -> None:
    size, pixels, eye = (4.0, 3.0), (60, 40), (3.0, 1.0, 2.0)
    looks = Sight.from_eye(eye, (2, 1.5), size, pixels, angle=80).looks()
    assert looks.rays is not None
    spots = np.array(eye) + looks.rays * (eye[2] / -looks.rays[:, 2:])
    assert np.abs(spots[:, :2] - looks.points).max() < 1e-5
    assert looks.inside.sum() > 500
    middle = looks.points[(20 * 60 + 30,)]
    assert np.abs(middle - (2, 1.5)).max() < 0.1


def test_normals_are_turned_to_the_facade() -> None:
    """A flat normal of a face is the face's own, in the façade's axes: towards the room."""
    text = "S -> Intrusion(1, N, N, N, N, N)\nN -> Mat(Normal, 0, 0.5, 0.5, 1, 1)"
    rays = [(-3, 0, -1), (0, 0, -1), (3, 0, -1), (0, -3, -1), (0, 3, -1)]
    normal = Grammar.parse(text).evaluate([(1, 1)] * 5, (2, 2), rays=rays).normal
    turned = (normal[:, :3] * 2 - 1).round(5).tolist()
    assert turned == [[1, 0, 0], [0, 0, 1], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]
