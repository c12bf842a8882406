"""Where the steps of a pixel stand in space, against the viewing ray."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb.render import Grammar
from facade_nb.render.texture.steps import Entered, Step
from facade_nb.widgets.texture.places import FACADE, planes

# Rooms behind windows; in each face but the back, another room, so that every face is entered from every other.
ROOMS = Grammar.parse("""
S -> Layer(Wall, Bays)
Wall -> Mat(Color, 0, 0.5, 0.5, 0.5, 1)
Bays -> RepeatX(3, Bay)
Bay -> SplitX(Rel, 1, Skip, Abs, 2, Window, Rel, 1, Skip)
Window -> SplitY(Abs, 1, Skip, Abs, 2, Room, Rel, 1, Skip)
Room -> Intrusion(2.5, Inner, Back, Inner, Inner, Inner)
Back -> Layer(Blue, Niche)
Niche -> SplitX(Rel, 1, Skip, Abs, 1, Deep, Rel, 1, Skip)
Inner -> SplitX(Rel, 1, Deep, Rel, 1, Glass)
Glass -> Layer(Deep, Skip)
Deep -> Intrusion(0.75, Red, Blue, Green, Red, Green)
Red -> Mat(Color, 0, 1, 0, 0, 1)
Green -> Mat(Color, 0, 0, 1, 0, 1)
Blue -> Mat(Color, 0, 0, 0, 1, 1)
Skip -> Skip(0)
""")
SIZE = (9.0, 4.0)


def offset(step: Step, at: tuple[float, float, float], point: np.ndarray, ray: np.ndarray) -> float:
    """How far a place is from the viewing ray, metres."""
    return float(np.linalg.norm(np.cross(np.array(at) - point, ray)) / np.linalg.norm(ray))


@settings(max_examples=150, deadline=None)
@given(
    x=st.floats(0.01, 8.99),
    y=st.floats(1.05, 2.95),
    dx=st.floats(-3, 3),
    dy=st.floats(-3, 3),
)
def test_the_points_of_all_steps_lie_on_the_viewing_ray(x: float, y: float, dx: float, dy: float) -> None:
    steps = ROOMS.steps((x, y), SIZE, ray=(dx, dy, -1.0))
    point, ray = np.array([x, y, 0.0]), np.array([dx, dy, -1.0])
    for step, plane in zip(steps, planes(ROOMS, steps), strict=True):
        assert offset(step, plane.at(*step.point), point, ray) < 2e-4
        assert np.dot(plane.out, ray) < 1e-6  # it is seen from inside
        # The place is on the scope that is drawn.
        left, bottom, right, top = step.scope
        assert left - 1e-4 <= step.point[0] <= right + 1e-4
        assert bottom - 1e-4 <= step.point[1] <= top + 1e-4


def test_all_faces_are_met_and_rooms_lie_within_rooms() -> None:
    faces = set()
    random = np.random.default_rng(5)
    for x, y, dx, dy in random.uniform((1, 1.05, -3, -3), (8, 2.95, 3, 3), (400, 4)).tolist():
        for step in ROOMS.steps((x, y), SIZE, ray=(dx, dy, -1.0)):
            if isinstance(step, Entered):
                faces.add((*step.faces, step.face))
    assert {face for (face, *_) in faces} == {"left", "back", "right", "floor", "ceiling"}
    assert len({pair for pair in faces if len(pair) == 2}) >= 12


def test_a_room_by_hand() -> None:
    """A box 2 m deep behind (1, 1) to (4, 3)."""
    scope = (1.0, 1.0, 4.0, 3.0)
    corners = {
        face: [
            tuple(FACADE.behind(scope, 2.0, face).at(1.0 + u, 1.0 + v))
            for u, v in ((0, 0), (wide, 0), (wide, tall), (0, tall))
        ]
        for face, (wide, tall) in {
            "left": (2, 2), "back": (3, 2), "right": (2, 2), "floor": (3, 2), "ceiling": (3, 2),
        }.items()
    }  # fmt: skip
    assert corners == {
        "left": [(1, 1, 0), (1, 1, -2), (1, 3, -2), (1, 3, 0)],
        "back": [(1, 1, -2), (4, 1, -2), (4, 3, -2), (1, 3, -2)],
        "right": [(4, 1, -2), (4, 1, 0), (4, 3, 0), (4, 3, -2)],
        "floor": [(1, 1, 0), (4, 1, 0), (4, 1, -2), (1, 1, -2)],
        "ceiling": [(1, 3, -2), (4, 3, -2), (4, 3, 0), (1, 3, 0)],
    }
