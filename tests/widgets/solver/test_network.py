"""Network, Alignment and Sizing on the Python side: their pieces and static forms."""

from __future__ import annotations

import re
from base64 import b64decode
from xml.etree import ElementTree

import numpy as np
import pytest

from facade_nb import gallery, solve
from facade_nb.solver.events import (
    ActiveSetStep,
    EdgeRefused,
    EdgeWeighed,
    LetterPlaced,
    NodeTaken,
    PathChosen,
)
from facade_nb.widgets import AlignmentView, FacadeView, NetworkView, SizingView
from facade_nb.widgets.solver import chunks, networks
from facade_nb.widgets.solver.forces import forced, loads
from facade_nb.widgets.solver.sizing import said

from .pieces import TRACES
from .test_views import unpack

SVG = "{http://www.w3.org/2000/svg}"


def drawing(html: str) -> ElementTree.Element:
    """The picture in a static form."""
    return ElementTree.fromstring(b64decode(re.search(r'base64,([^"]*)', html)[1]))


def texts(html: str) -> list[str]:
    return [own.text or "" for own in drawing(html).iter(f"{SVG}text")]


class TestNetworkPiece:
    def test_every_step_comes_with_its_places_and_numbers(self) -> None:
        trace = TRACES["residential-house"]()
        told = unpack(chunks.chunk(trace, "network"))
        steps = told["steps"]
        events = [(at, e) for at, e in enumerate(trace.events) if type(e).__name__ in networks.KINDS]
        assert steps["at"].tolist() == [at for at, _ in events]
        for n, (_, e) in enumerate(events):
            assert steps["kinds"][steps["kind"][n]] == type(e).__name__
            span = slice(steps["offset"][n], steps["offset"][n + 1])
            assert tuple(steps["places"][span]) == e.places
            if isinstance(e, EdgeWeighed):
                assert steps["omega"][n] == e.omega
                assert tuple(steps["after"][span]) == e.after
                assert [bool(own) for own in e.column] == steps["filled"][span].astype(bool).tolist()
            if isinstance(e, EdgeRefused):
                assert steps["fates"][steps["fate"][n]] == e.constraint
                # what numbers say is put in words where it is shown
                assert steps["texts"][steps["text"][n]] == ("" if e.bound is not None else e.text)
                assert steps["against"][n] == e.against or (
                    e.against is None and np.isnan(steps["against"][n])
                )
                assert [own is None for own in e.column] == (steps["after"][span] < 0).tolist()
            if isinstance(e, NodeTaken):
                assert np.isnan(steps["omega"][n])

    def test_paths_know_their_network_and_their_layers(self) -> None:
        trace = TRACES["apartment-house"]()
        told = unpack(chunks.chunk(trace, "network"))
        for own, path in zip(told["paths"], trace.of_kind(PathChosen), strict=True):
            opened = next(
                n for n in told["networks"] if (n["axis"], n["network"]) == (path.axis, path.network)
            )
            assert opened["bands"][own["number"]] == own["bands"]
            assert len(own["layers"]) == sum(len(band.rows) for band in path.bands)

    def test_a_failure_has_a_piece_too(self) -> None:
        told = unpack(chunks.chunk(TRACES["contradiction"](), "network"))
        assert told["paths"] == []
        assert len(told["steps"]["at"]) == sum(
            type(e).__name__ in networks.KINDS for e in TRACES["contradiction"]().events
        )


class TestNetworkView:
    def test_the_static_form_is_figure_8(self) -> None:
        html = NetworkView(gallery.load("figure-8")).to_html()
        written = texts(html)
        assert any("4 × 6 nodes" in text for text in written)
        assert {"CeC", "ABABA", "eC", "BABA", "ε"} <= {*written}
        paths = [own for own in drawing(html).iter(f"{SVG}path") if own.get("stroke") == "#d0202c"]
        assert len(paths) == 5
        assert "/".join(written[-6:-1]) == "0/0/0/0/0"

    def test_of_many_words_the_path_is_listed(self) -> None:
        html = NetworkView(gallery.load("residential-house")).to_html()
        assert "<td>f / C / A</td>" in html
        assert "<td>D / e / B</td>" in html

    def test_a_larger_one_is_drawn_with_dots_and_its_words(self) -> None:
        html = NetworkView(gallery.load("apartment-house")).to_html()
        assert any("x, group 1: 12 × 20 nodes" in text for text in texts(html))
        assert sum(1 for _ in drawing(html).iter(f"{SVG}circle")) == 240
        red = [own for own in drawing(html).iter(f"{SVG}path") if own.get("stroke") == "#d0202c"]
        assert len(red) == 17 + 7  # x, group 1 and y, group 1
        assert "<td>1 to 19</td><td>f A B D" in html  # a word alone: nothing is decided

    def test_the_frame_is_that_of_the_edges(self) -> None:
        frame = NetworkView(gallery.load("figure-8")).frame
        assert {"omega", "fate", "constraint", "chosen"} <= {*frame.columns}


class TestAlignmentView:
    def test_the_static_form_is_the_matrix_to_scale(self) -> None:
        html = AlignmentView(gallery.load("figure-8")).to_html()
        boxes = [
            own
            for own in drawing(html).iter(f"{SVG}rect")
            if own.get("class") in {"g", "h0", "h1", "h2", "h3"}
        ]
        widths = [float(own.get("width", 0)) for own in boxes[:10]]
        assert np.allclose(widths[5:], np.multiply([2, 3, 2, 3, 2], widths[5] / 2), atol=0.1)
        assert np.allclose(widths[:5], widths[5:], atol=0.1)  # e is cut where B and A meet
        assert "Ω = 0 m, W = 12 m" in texts(html)

    def test_every_column_of_the_static_form_has_its_size_and_error(self) -> None:
        written = texts(AlignmentView(gallery.load("apartment-house")).to_html())
        first = written[written.index("x, group 1") : written.index("x, group 2")]
        sizes = first[first.index("size") + 1 : first.index("error ω")]
        assert sizes == ["0.6", "3", *["1.2", "0.817"] * 6, "1.2", "3", "0.6"]
        assert first[first.index("error ω") + 1 :].count("0.017") == 6
        assert "first floor corners" in first

    def test_the_piece_has_the_tolerance_that_the_path_keeps(self) -> None:
        told = unpack(chunks.chunk(TRACES["figure-8"](), "alignment"))
        (own,) = (path for path in told["paths"] if path["axis"] == "x")
        assert (own["tolerance"], own["canvas"]) == (6.0, 12.0)
        assert own["layers"] == ["corners", "walls"]


class TestSizingView:
    def test_the_static_form_lists_sizes_and_rows(self) -> None:
        html = SizingView(gallery.load("residential-house")).to_html()
        assert "<td>x</td><td>D</td><td>1.1</td><td>1.19</td><td>0.0081</td>" in html
        assert "<td>default: 1-4-1.t − 1-4-1.s = |D|</td><td>=</td><td>0.18</td>" in html
        assert "<td>f</td><td>free</td>" in html

    def test_the_static_form_draws_forces(self) -> None:
        view = SizingView(gallery.load("residential-house"))
        strokes = [own.get("stroke") for own in drawing(view.to_html()).iter(f"{SVG}path")]
        rows = view.frame
        sized = rows[rows.name.str.contains(r" = \|") & (rows.multiplier.abs() > 1e-6)]
        letters = sum(name.count("-") // 2 for name in sized.name)
        assert strokes.count("#2f6fb2") + strokes.count("#d0202c") >= 2 * letters > 0

    def test_the_static_facade_draws_them_too(self) -> None:
        layout = solve(gallery.load("residential-house"), trace=True)
        found = loads(layout.trace, layout)
        runs = [(own.start, own.end, own.force) for own in found if not own.held]
        letters = {e.symbol: e for e in layout.trace.of_kind(LetterPlaced, "x") if e.layer == "door"}
        assert runs[0] == pytest.approx((letters["D"].start, letters["D"].end, 0.1805), abs=1e-4)
        # What is squeezed starts where what is stretched ends; the canvas takes what is left over.
        assert [round(force, 3) for _, _, force in runs[1:]] == [0.054, -0.127, 0.054]
        assert [run[1] for run in runs[1:-1]] == pytest.approx([run[0] for run in runs[2:]])
        assert [own.force for own in found if own.held] == pytest.approx([0.0537, -0.0537], abs=1e-3)
        html = FacadeView(layout).to_html()
        assert html.count("<img ") == 2
        drawn = drawing(forced(layout.trace, layout))
        strokes = [own.get("stroke") for own in drawn.iter(f"{SVG}path")]
        arrows = [own for own in drawn.iter(f"{SVG}path") if own.get("stroke-width") == "1.6"]
        assert len(arrows) == 2 * len(runs) + 2
        assert strokes.count("#d0202c") == 2 + 1  # two arrows and the line between them

    def test_without_forces_the_static_facade_is_the_elevation(self) -> None:
        layout = solve(gallery.load("figure-8"), trace=True)
        assert forced(layout.trace, layout) == ""
        assert FacadeView(layout).to_html().count("<img ") == 1

    def test_rows_are_called_as_in_the_page(self) -> None:
        groups = ["one", "two"]
        assert said("0:0 < 0:1", groups) == "one: x0 < x1"
        assert said("1:0-2-0 = |A|", groups) == "two: 1-3-1.t − 1-3-1.s = |A|"
        assert said("0:0-1-0 + 0:0-2-0 = |e|", ["one"]) == "(1-2-1.t − 1-2-1.s) + (1-3-1.t − 1-3-1.s) = |e|"
        assert said("0:0-2-0: gap before ≥ 0", ["one"]) == "γ before 1-3-1 ≥ 0"
        assert said("0:0-2-0: gaps equal", ["one"]) == "γ before 1-3-1 = γ after it"
        assert said("0:0-3-0.s < 0:0-3-0.t", ["one"]) == "1-4-1.s < 1-4-1.t"
        assert said("extent of g = |g|", groups) == "extent of the content of g = |g|"

    def test_the_frame_is_that_of_the_equations(self) -> None:
        frame = SizingView(gallery.load("figure-8")).frame
        assert {"1:0-0-0 = |C|", "0:0-0-0 = |C|"} & {*frame.name}
        assert {"multiplier", "active"} <= {*frame.columns}

    def test_the_piece_has_every_step(self) -> None:
        trace = TRACES["residential-house"]()
        told = unpack(chunks.chunk(trace, "sizing"))["events"]
        assert [own["event"] for own in told].count("ActiveSetStep") == len(trace.of_kind(ActiveSetStep))
        assert {own["event"] for own in told} == {"SystemPosed", "ActiveSetStep", "SystemSolved"}
