"""The lessons: each has in its trace what its sentence says."""

from __future__ import annotations

import pytest

from facade_nb import Design, DesignError, Layout, gallery, solve
from facade_nb.solver.events import (
    ActiveSetStep,
    CandidateJudged,
    EdgeRefused,
    EdgeWeighed,
    LimitRaised,
    NodeTaken,
    PathChosen,
    StructurePriced,
    WaysMet,
)


def told(name: str) -> Layout:
    note = gallery.lesson_note(name)
    return solve(note.design, search=note.search, trace=True)


def path_of(layout: Layout) -> PathChosen:
    return layout.trace.of_kind(PathChosen, "x")[0]


def column(path: PathChosen, letters: tuple[tuple[int, ...], ...]) -> str:
    return " / ".join(
        "".join(band.letters[i].symbol for i in own) or "ε"
        for band, own in zip(path.bands, letters, strict=True)
    )


def test_every_lesson_is_a_small_design_with_a_sentence() -> None:
    assert len(gallery.lessons()) >= 8
    for name in gallery.lessons():
        note = gallery.lesson_note(name)
        assert gallery.lesson(name) == note.design == Design.from_json(note.design.to_json())
        assert note.title and note.look.endswith(".") and note.search in ("best", "ida")
        assert len(told(name).trace.events) < 400


def test_an_unknown_lesson_tells_the_nearest() -> None:
    with pytest.raises(DesignError, match=r"found 'attatched'; did you mean 'attached'\?"):
        gallery.lesson("attatched")


def test_weights() -> None:
    assert [round(own.omega, 6) for own in path_of(told("weights")).columns] == [0.4, 0.1, 0.1, 0.4]


def test_trap_and_twins() -> None:
    """Of two edges that leave a node the path takes the dearer; of two that cost the same, that with the less bound."""
    layout = told("trap")
    path = path_of(layout)
    edges = {column(path, e.column): e for e in layout.trace.of_kind(EdgeWeighed, "x") if e.places == (2, 0)}
    light, taken = edges["C / A"], edges["CC / ABA"]
    assert (round(light.cost, 6), round(taken.cost, 6)) == (0.3, 0.65)
    assert light.bound > taken.bound and taken.path in path.nodes
    layout = told("twins")
    path = path_of(layout)
    one, other = [e for e in layout.trace.of_kind(EdgeWeighed, "x") if e.places == (0, 0)][:2]
    assert column(path, one.column) == column(path, other.column) == "e / A"
    assert one.cost == other.cost == 0 and (round(one.bound, 6), round(other.bound, 6)) == (0.3, 0.6)
    assert one.path in path.nodes


def test_deepening_table_incumbent() -> None:
    """Passes under growing limits; edges that are pruned by another path; alignments that get better."""
    trace = told("deepening").trace
    network = trace.of_kind(PathChosen, "x")[0].network
    limits = [e.limit for e in trace.of_kind(LimitRaised, "x") if e.network == network]
    assert len(limits) == 6 and limits == sorted(limits) and len(set(limits)) == 6
    met = [n for n, e in enumerate(trace.events) if isinstance(e, WaysMet) and e.axis == "x"]
    assert [round(trace.events[n].cost, 6) for n in met] == [1.8, 1.55]
    last = max(n for n, e in enumerate(trace.events) if isinstance(e, LimitRaised) and e.axis == "x")
    assert min(met) > last
    pruned = [e for e in trace.of_kind(EdgeRefused, "x") if e.constraint == "bound"]
    assert pruned and all(e.bound > e.against for e in pruned)

    edges = told("table").trace.of_kind(EdgeWeighed, "x")
    gone = [e for e in edges if e.fate != "open"]
    assert (len(edges), len(gone)) == (41, 24)
    laid = {e.path: e.cost for e in edges} | {None: 0.0}
    parents = {e.path: e.parent for e in edges}

    def cost(path: int) -> float:
        return laid[path] + (cost(parents[path]) if path in parents and parents[path] in laid else 0.0)

    ends = {e.path: (e.after, e.group) for e in edges}
    assert all(e.rival is not None and ends[e.rival] == ends[e.path] for e in gone)
    assert all(cost(e.rival) <= cost(e.path) + 1e-9 for e in gone)

    costs = [e.cost for e in told("incumbent").trace.of_kind(StructurePriced, "x")]
    best = [c for n, c in enumerate(costs) if c < min(costs[:n], default=9.0)]
    assert len(costs) == 4 and [round(c, 6) for c in best] == [2.0, 1.46, 1.1]


def test_searches_without_a_part_come_to_the_same_answer_and_take_more_nodes() -> None:
    for name in ("table", "heuristic"):
        design, nodes, bounds = gallery.lesson(name), {}, {}
        for search in ("best", "no-table", "no-heuristic", "ida"):
            layout = solve(design, search=search, trace=True)
            assert layout.x.cost == pytest.approx(solve(design).x.cost) and layout.x.proven
            taken = layout.trace.of_kind(NodeTaken, "x")
            nodes[search], bounds[search] = len(taken), [e.bound - e.cost for e in taken]
            for e in layout.trace.of_kind(EdgeRefused, "x"):
                assert e.constraint != "bound" or e.bound is None or e.bound > e.against
        assert nodes["best"] < nodes["no-table"] < nodes["no-heuristic"]
        assert max(bounds["best"]) > 0.5 and max(bounds["no-heuristic"]) < 1e-9


def test_attached_matters() -> None:
    layout = told("attached")
    document = gallery.lesson("attached").to_dict()
    del document["symbols"]["A"]["attached"]
    free = solve(Design.from_dict(document), trace=True)
    assert round(layout.x.cost, 6) == 1.615 and len(path_of(layout).columns) == 3
    assert round(free.x.cost, 6) == 1.18 and len(path_of(free).columns) == 4
    assert any(e.constraint == "C4" for e in layout.trace.of_kind(EdgeRefused, "x"))


def test_candidates_active_set_heuristic() -> None:
    judged = told("candidates").trace.of_kind(CandidateJudged, "x")
    assert min(judged, key=lambda e: e.bound).number == 0
    assert [(e.number, e.fate) for e in judged] == [(0, "bound"), (1, "best"), (2, "bound"), (3, "bound")]
    steps = [e for e in told("active-set").trace.of_kind(ActiveSetStep, "x") if e.round == 1]
    assert [len(e.entered) for e in steps[1:]] == [1, 1, 1] and steps[0].violation > 0.05
    layout = told("heuristic")
    assert all(own.omega > 0.05 for own in path_of(layout).columns)
    assert len(layout.trace.of_kind(NodeTaken, "x")) > 20
