"""The paper's residential house, in the 17 steps of its Section 4, and the apartment house, from an empty canvas.

Mouse and keyboard alone; `Hand` says what counts as an action. Set ``FACADE_NB_STEPS`` to a folder to have pictures of
each step there, light and dark, at three widths.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from .hand import Hand
from .jupyter import Notebook

Show = Callable[[str], Notebook]
Step = Callable[[str], None]

MOST = 120
"""Actions that the residential house may take."""

BLANK = """
from facade_nb import solve
model = FacadeModel(time_limit=600.0)
def told(layout):
    return [(s.layer, s.x, s.y, s.kind, s.geometry, s.material, s.offset, s.thickness, s.number, s.mirrored)
            for s in layout.shapes]
def apart(name):
    model.wait()
    goal = solve(gallery.load(name), time_limit=None)
    if told(model.layout) != told(goal):
        return sorted(map(str, set(told(model.layout)) ^ set(told(goal)))) or "another order"
    both = zip(model.layout.shapes, goal.shapes, strict=True)
    return max(abs(a - b) for one, other in both for a, b in zip(one.rect, other.rect, strict=True)) >= 1e-6
Studio(model)
"""


@pytest.fixture
def hand(show: Show) -> Hand:
    """A hand before an empty studio."""
    return Hand(show(BLANK))


@pytest.fixture
def step(hand: Hand, request: pytest.FixtureRequest) -> Iterator[Step]:
    """Called after each step with its name: takes pictures, where they are wanted."""
    folder = os.environ.get("FACADE_NB_STEPS", "")
    studio = hand.studio

    def pictures(name: str) -> None:
        if not folder:
            return
        path = Path(folder)
        path.mkdir(parents=True, exist_ok=True)
        studio.settle()
        for theme in ("Light", "Dark"):
            studio.theme(f"JupyterLab {theme}")  # type: ignore[arg-type]
            for width in (1600, 1200, 900):
                studio.resize(width)
                part = request.node.name.removeprefix("test_")
                studio.page.screenshot(path=path / f"{part}-{name}-{theme.lower()}-{width}.png")
        studio.theme("JupyterLab Light")
        studio.resize(1400)

    yield pictures
    print(f"{request.node.name}: {hand.count} actions")


def test_the_residential_house_in_17_steps(hand: Hand, step: Step) -> None:
    hand.begin("6", "3")
    step("00")
    hand.first_pattern("Bx", "A(BA)^k")
    hand.pattern("By", "PQ")
    step("01")
    hand.sizes(A="0.5", B="1.2", P="1.6", Q="1.4")
    hand.press("B is unoccludable")
    step("02")
    hand.layer("base")
    step("03")
    hand.look("base", ("A", "P"), material="ashlar")
    hand.look("base", ("A", "Q"), material="plaster-ochre")
    hand.look("base", ("B", "P"), geometry="arch", material="ashlar", kind="window")
    hand.look("base", ("B", "Q"), geometry="french-window", material="painted-wood", kind="window")
    step("04")
    hand.pattern("Cx", "cec; c := C")
    step("05")
    hand.sizes(C="0.3")
    hand.press("C is opaque")
    step("06")
    hand.layer("columns")
    hand.only("columns", "P")
    step("07")
    hand.look("columns", ("C", "P"), geometry="column", material="stone", kind="column")
    step("08")
    hand.pattern("Dx", "fdf; d := D")
    step("09")
    hand.sizes(D="1.1")
    step("10")
    hand.layer("door")
    hand.only("door", "P")
    step("11")
    hand.look("door", ("D", "P"), geometry="door", material="painted-green", kind="door")
    step("12")
    hand.pattern("Ry", "PQR")
    hand.sizes(R="1.5")
    step("13")
    hand.write("Canvas height in metres", "4.5")
    step("14")
    hand.pattern("Rx", "H")
    hand.sizes(H="6")
    step("15")
    hand.layer("roof")
    hand.group("roof", "roof")
    hand.only("roof", "R")
    step("16")
    hand.look("roof", ("H", "R"), geometry="roof", material="tiles", kind="roof", thickness="4")
    step("17")
    hand.studio.expect_python("apart('residential-house')", False)
    assert hand.count <= MOST


def test_the_apartment_house(hand: Hand, step: Step) -> None:
    hand.begin("21", "10")
    hand.first_pattern("Bx", "GC A(BA)^k CG")
    hand.pattern("By", "ZY (VW)^l XY")
    hand.sizes(A="0.8", B="1.2", C="2.2", G="0.6", V="1", W="1.7", X="0.5", Y="0.25", Z="3.2")
    hand.press("G is attached")
    step("01")
    hand.layer("base")
    hand.press("Show all shapes of layer base")
    step("02")
    everything, base = ("A", "V"), "base"
    hand.look(base, everything, key="everything", level="the design", material="plaster-ochre")
    hand.look(base, ("A", "Y"), key="every Y", geometry="ledge", material="stone", kind="ledge")
    hand.look(base, ("A", "Z"), key="every Z", material="ashlar")
    hand.look(base, ("G", "V"), ("G", "W"), ("G", "X"), material="ashlar", offset="0.05")
    hand.look(base, ("B", "W"), geometry="window", material="painted-wood", kind="window")
    hand.look(base, ("C", "W"), geometry="french-window", material="painted-wood", kind="window")
    step("03")
    hand.pattern("Gx", "(DE)^n D F D(ED)^m F D(ED)^n")
    hand.write("Least value of counter n", "1")
    hand.write("Greatest value of counter n", "2")
    hand.sizes(D="0.3", E="2.5", F="1.6")
    step("04")
    ground = "ground floor"
    hand.layer(ground)
    hand.group(ground, "2")
    hand.only(ground, "Z")
    hand.press(f"Show all shapes of layer {ground}")
    step("05")
    hand.look(ground, ("E", "Z"), geometry="shop", material="painted-blue", kind="window")
    hand.look(ground, ("F", "Z"), geometry="door", material="oak", kind="door")
    step("06")
    hand.pattern("Fy", "ZYts; t := XWX")
    hand.pattern("Fx", "f g f'; f := GDBDB")
    corners = "first floor corners"
    hand.layer(corners)
    hand.press(f"Show all shapes of layer {corners}")
    step("07")
    hand.look(corners, ("D", "X"), key="every X", level="layer", material="sandstone")
    hand.look(corners, ("D", "W"), key="every W", material="sandstone")
    hand.look(corners, ("G", "X"), ("G", "W"), material="ashlar")
    hand.look(corners, ("B", "W"), material="painted-wood")
    step("08")
    hand.pattern("Mx", "f g f'; g := AB(DB)^j A")
    middle = "first floor middle"
    hand.layer(middle)
    hand.group(middle, "3")
    hand.press(f"Show all shapes of layer {middle}")
    step("09")
    hand.look(middle, ("D", "X"), key="every X", material="sandstone")
    hand.look(middle, ("D", "W"), key="every W", material="sandstone")
    hand.look(middle, ("B", "W"), material="painted-wood")
    step("10")
    hand.studio.expect_python("apart('apartment-house')", False)
