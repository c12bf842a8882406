"""One height for all walls: they meet exactly, in the best way that there is."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations, pairwise

import pytest

from facade_nb import Building, NoLayout, gallery, solve
from facade_nb.building import Corner
from facade_nb.building.treatments import chamfer, quoins
from facade_nb.design import Design
from facade_nb.design.model import Canvas, Counter
from tests.building.houses import FRONT, SIDE, corner_house


def stops(layout, name):
    """The boundaries of a face's wall, along y."""
    return layout.face(name).layout.y.groups["default"].columns


def test_walls_meet_at_corners_to_the_last_digit():
    layout = corner_house()
    shared = layout.heights.groups["heights"].columns
    assert len(shared) >= 6
    for own in layout.faces:
        if own.face.design is not None:
            boundaries = {v for rect in own.layout.shapes for v in (rect.rect[1], rect.rect[3])}
            assert set(shared) <= boundaries | {0.0, 9.9}, own.face.name


def test_a_wall_that_alone_would_choose_other_heights():
    layout = Building.rectangle(9.0, 7.2, [FRONT, SIDE, FRONT, SIDE], height=9.9).solve()
    alone = solve(replace(SIDE, canvas=Canvas(7.2, 9.9)))
    assert alone.y.groups["default"].columns[1] == pytest.approx(3.97, abs=0.05)
    front, side = stops(layout, "wall 1"), stops(layout, "wall 2")
    assert front == side == layout.heights.groups["heights"].columns
    assert len(front) == 7  # ground floor, sill, window, sill, window, cornice
    # Neither has the ground floor that it would have alone: they meet in between.
    assert front[1] != pytest.approx(3.4, abs=0.05)
    assert front[1] != pytest.approx(alone.y.groups["default"].columns[1], abs=0.05)
    assert layout.proven


def by_hand(height: float) -> float:
    """The least J of both designs and of their spines, over all counters and all ways to cut them alike."""
    best = float("inf")
    for n in range(5):
        for m in range(5):
            words, cost = [], 0.0
            for design, counter, value in ((FRONT, "n", n), (SIDE, "m", m)):
                pinned = replace(
                    design,
                    canvas=Canvas(3.0, height),
                    counters={counter: Counter(counter, value=value)},
                    patterns=design.patterns | {"bays": replace(design.patterns["bays"], text="A B A")},
                )
                try:
                    solved = solve(pinned).y
                except NoLayout:
                    break
                cost += solved.cost
                letters = solved.groups["default"].rows[0].letters
                words.append([design.symbols[letter.symbol].size for letter in letters])
            if len(words) == 2:
                best = min(best, cost + least_together(*words, height))
    return best


def least_together(a: list[float], b: list[float], height: float) -> float:
    """Two rows in columns that both fill: Σ ω + 2·Λ/2 + 0.25·|W − height|."""
    best = float("inf")
    for count in range(1, min(len(a), len(b)) + 1):
        for cuts in combinations(range(1, len(a)), count - 1):
            for others in combinations(range(1, len(b)), count - 1):
                total = width = 0.0
                for (i, j), (p, q) in zip(
                    pairwise((0, *cuts, len(a))), pairwise((0, *others, len(b))), strict=True
                ):
                    one, other = sum(a[i:j]), sum(b[p:q])
                    total += abs(one - other)
                    total += sum(min(pair) for part in (a[i:j], b[p:q]) for pair in pairwise(part))
                    width += max(one, other)
                best = min(best, total + 0.25 * abs(width - height))
    return best


@pytest.mark.parametrize("height", [9.9, 12.4])
def test_the_heights_are_the_best_there_are(height):
    layout = Building.rectangle(9.0, 7.2, [FRONT, SIDE, None, None], height=height).solve()
    assert layout.heights.proven
    assert layout.heights.cost == pytest.approx(by_hand(height), abs=1e-6)


def test_a_ledge_stays_a_ledge_where_walls_meet():
    house = gallery.load("apartment-house")
    layout = Building.row([(14.0, house), (2.6, chamfer(ground=3.2, storey=2.9))], 9.0, height=10.0).solve()
    assert layout.heights.sizes["Y of Apartment house"] >= 0.7 * 0.25 - 1e-9


def test_one_design_on_all_walls_is_as_it_is_alone():
    design = gallery.load("residential-house")
    layout = Building.rectangle(6.0, 5.0, design).solve()
    alone = solve(design)
    assert stops(layout, "wall 1") == stops(layout, "wall 2") == alone.y.groups["default"].columns
    assert layout.face("wall 1").layout.shapes == alone.shapes
    assert layout.eaves == 3.0  # its own roof gives way to the one over all
    assert not any(shape.kind == "roof" for own in layout.faces for shape in own.shown.shapes)


def test_shared_names_are_one_and_others_are_not():
    def sizes(*shared):
        side = replace(SIDE, symbols=SIDE.symbols | {"K": FRONT.symbols["K"]})
        found = Building.rectangle(9.0, 7.2, [FRONT, side, None, None], height=9.9, shared=shared).solve()
        return found.heights.sizes

    assert {"K of Front", "K of Side"} <= set(sizes())
    assert "K" in sizes("K")
    with pytest.raises(ValueError, match="shared: expected 'K' to be the same in all symbols"):
        Building.rectangle(9.0, 7.2, [FRONT, SIDE, None, None], height=9.9, shared=("K",))


def test_a_counter_on_both_axes_holds_for_heights_and_widths():
    document = FRONT.to_dict()
    document["patterns"] = {"bays": "A(BA)^n", "floors": "G(VW)^nK"}
    tied = Design.from_dict(document)
    layout = Building.rectangle(9.0, 9.0, tied, height=9.9).solve()
    whole = solve(replace(tied, canvas=Canvas(9.0, 9.9)))
    assert layout.face("wall 1").layout.counters == whole.counters
    assert layout.face("wall 1").layout.x.cost + layout.heights.cost == pytest.approx(
        whole.x.cost + whole.y.cost
    )


def test_quoins_go_around_the_corner_and_end_at_the_eaves():
    layout = corner_house()
    before, after = layout.face("wall 1").layout, layout.face("wall 2").layout
    ends = [s.rect for s in before.shapes if s.kind == "quoin"]
    begins = [s.rect for s in after.shapes if s.kind == "quoin"]
    width = layout.face("wall 1").face.length
    assert {rect[2] for rect in ends} == {width}
    assert {rect[0] for rect in begins} == {0.0}
    assert [r[1::2] for r in sorted(ends, key=lambda r: r[1])] == [
        r[1::2] for r in sorted(begins, key=lambda r: r[1])
    ]
    long_here = {r[1] for r in ends if r[2] - r[0] > 0.6}
    long_there = {r[1] for r in begins if r[2] - r[0] > 0.6}
    assert long_here and long_there and not long_here & long_there
    assert max(rect[3] for rect in ends) <= layout.eaves


def test_a_party_wall_is_blind():
    layout = corner_house()
    (shape,) = layout.face("wall 5").layout.shapes
    assert shape.kind == "wall"
    with pytest.raises(
        ValueError, match=r"corners.5.kind: expected façades on both sides of a chamfer; wall 5 is blind"
    ):
        replace(layout.building, corners={5: Corner("chamfer", "Front", 2.0)})


def test_an_l_has_its_walls_where_they_are():
    layout = corner_house()
    names = [own.face.name for own in layout.faces]
    assert names == ["corner 1", "wall 1", "wall 2", "wall 3", "wall 4", "wall 5", "wall 6"]
    cut = 2.4 / 2**0.5
    lengths = [own.face.length for own in layout.faces]
    assert lengths == pytest.approx([2.4, 14 - cut, 7, 8, 5, 6, 12 - cut])
    for own, following in pairwise([*layout.faces, layout.faces[0]]):
        assert own.face.end == pytest.approx(following.face.start)
    turns = [round(own.face.turns[0], 4) for own in layout.faces]
    assert turns == [0.7854, 0.7854, 1.5708, 1.5708, -1.5708, 1.5708, 1.5708]
    assert any(shape.kind == "door" for shape in layout.face("corner 1").layout.shapes)


def test_a_row_of_houses():
    row = Building.row([(9.0, FRONT), (7.2, SIDE)], 8.0, height=9.9)
    assert row.walls == ("Front", "Side", None, None, None, None)
    layout = row.solve()
    assert stops(layout, "wall 1") == stops(layout, "wall 2")
    assert layout.face("wall 1").face.turns[1] == 0


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"plan": ((0, 0), (0, 5), (5, 5), (5, 0))}, "plan: expected corners counter-clockwise"),
        ({"plan": ((0, 0), (5, 5), (5, 0), (0, 5))}, "plan: expected walls that do not cross"),
        (
            {"walls": ("Frnt", None, None, None)},
            r"walls\[0\]: expected the name of a design; found 'Frnt'; did you mean 'Front'",
        ),
        ({"walls": ("Front",)}, "walls: expected 4"),
        ({"corners": {9: Corner("quoins", "Front")}}, "corners.9: expected the number of a corner, 0 to 3"),
        ({"corners": {0: Corner("quions", "Front")}}, "corners.0.kind: .* did you mean 'quoins'"),
        ({"corners": {0: Corner("chamfer", "Front", 12.0)}}, r"walls\[0\]: expected room for the corners"),
        ({"material": "plastr"}, "material: .*plaster"),
        ({"height": 0.0}, "height: expected a number greater than 0"),
    ],
)
def test_faults_are_told_with_their_place(change, told):
    building = Building.rectangle(5.0, 5.0, FRONT)
    with pytest.raises(ValueError, match=told):
        replace(building, **change)


def test_heights_that_cannot_be_are_told_with_the_design():
    low = replace(SIDE, counters={"m": Counter("m", max=0)})
    with pytest.raises(NoLayout, match="The heights of design 'Side'"):
        Building.rectangle(9.0, 7.2, [FRONT, low, None, None], height=30.0).solve()


def test_explain_tells_walls_and_heights():
    told = corner_house().explain()
    assert "Heights of all walls" in told and "wall 5, 6.00 m: blind." in told
    assert quoins().name not in told.split("Between them")[0]
