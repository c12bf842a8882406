"""Sweeps: rows in order, the same whatever solves them, stopped without losing anything."""

from __future__ import annotations

from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from xml.etree import ElementTree

import pandas as pd
import pytest

from facade_nb import Design, contact_sheet, gallery, solve, sweep, vary
from facade_nb.design.edit import with_canvas, with_counter, with_symbol
from facade_nb.variations.answers import STOPPED
from facade_nb.variations.variants import RESULTS

VALUES = {"width": [6.0, 0.3, 7.5], "sizes": {"B": [0.8, 1.1]}}


@pytest.fixture(scope="module")
def house() -> Design:
    return gallery.load("residential-house")


@pytest.fixture(scope="module")
def table(house: Design) -> pd.DataFrame:
    return sweep(house, **VALUES, progress=False)  # type: ignore[arg-type]


def test_a_row_for_each_combination_the_last_fastest(table: pd.DataFrame) -> None:
    assert list(table.columns) == ["width", "B", *RESULTS]
    assert list(zip(table["width"], table["B"], strict=True)) == [
        (6.0, 0.8), (6.0, 1.1), (0.3, 0.8), (0.3, 1.1), (7.5, 0.8), (7.5, 1.1),
    ]  # fmt: skip


def test_a_row_tells_what_solve_does(house: Design, table: pd.DataFrame) -> None:
    row = table.iloc[5]
    layout = solve(with_symbol(with_canvas(house, width=7.5), "B", size=1.1))
    assert row["layout"] == layout
    assert (row["x_cost"], row["x_deviation"], row["x_proven"]) == (layout.x.cost, layout.x.deviation, True)
    assert (row["y_cost"], row["y_deviation"], row["y_proven"]) == (layout.y.cost, layout.y.deviation, True)
    assert row["shapes"] == len(layout.shapes)
    assert row["windows"] == sum(shape.kind == "window" for shape in layout.shapes) > 4
    assert row["error"] == "" and row["seconds"] > 0


def test_what_has_no_layout_says_why(table: pd.DataFrame) -> None:
    for _, row in table[table["width"] == 0.3].iterrows():
        assert row["layout"] is None and row["x_proven"] is None
        assert "'Rx'" in row["error"] and "0.3 m wide" in row["error"]
        assert row["shapes"] == row["windows"] == 0


def test_all_four_kinds_of_values_in_the_order_of_the_product(house: Design) -> None:
    found = sweep(
        house, width=[6, 7], height=[4.5], counters={"k": [3, 5]}, sizes={"B": [1.0]}, progress=False
    )
    assert list(found.columns[:4]) == ["width", "height", "k", "B"]
    assert [tuple(row) for row in found[["width", "height", "k", "B"]].to_numpy()] == [
        (6, 4.5, 3, 1.0), (6, 4.5, 5, 1.0), (7, 4.5, 3, 1.0), (7, 4.5, 5, 1.0),
    ]  # fmt: skip
    assert found["layout"][3] == solve(
        with_symbol(with_counter(with_canvas(house, 7, 4.5), "k", value=5), "B", size=1.0)
    )


def test_nothing_to_change_is_one_row(house: Design) -> None:
    found = sweep(house, progress=False)
    assert list(found.columns) == list(RESULTS) and found["layout"][0] == solve(house)


@pytest.mark.parametrize("kind", ["threads", "processes", "dask"])
def test_the_same_rows_whatever_the_executor(house: Design, table: pd.DataFrame, kind: str) -> None:
    def run(executor: Executor) -> pd.DataFrame:
        return sweep(house, **VALUES, executor=executor, progress=False)  # type: ignore[arg-type]

    if kind == "threads":
        with ThreadPoolExecutor(3) as pool:
            found = run(pool)
    elif kind == "processes":
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as executor:
            found = run(executor)
    else:
        from distributed import Client, LocalCluster

        with (
            LocalCluster(
                n_workers=1, threads_per_worker=2, processes=False, dashboard_address=None
            ) as cluster,
            Client(cluster) as client,
        ):
            found = run(client.get_executor())
    rest = [name for name in table.columns if name != "seconds"]
    pd.testing.assert_frame_equal(found[rest], table[rest])
    assert list(found["layout"]) == list(table["layout"])


def test_progress_counts(house: Design) -> None:
    told: list[tuple[int, int]] = []
    sweep(house, width=[6, 7], progress=lambda done, total: told.append((done, total)))
    assert told == [(0, 2), (1, 2), (2, 2)]


def test_a_line_of_progress(house: Design, capsys: pytest.CaptureFixture[str]) -> None:
    sweep(house, width=[6, 7])
    out, error = capsys.readouterr()
    assert out == "" and error.endswith("\rsweep: 2 of 2\n")


@pytest.mark.parametrize("threads", [False, True])
@pytest.mark.parametrize("interrupted", [False, True])
def test_stopped_nothing_that_is_solved_is_lost(house: Design, threads: bool, interrupted: bool) -> None:
    done = 0

    def count(now: int, total: int) -> None:
        nonlocal done
        done = now
        if interrupted and now == 1:
            raise KeyboardInterrupt

    with ThreadPoolExecutor(1) as executor:
        found = sweep(
            house,
            width=[6.0, 6.5, 7.0, 7.5],
            executor=executor if threads else None,
            progress=count,
            should_stop=lambda: done == 1,
        )
    assert found["layout"][0] == solve(with_canvas(house, width=6.0))
    assert found["error"].iloc[-1] == STOPPED and found["layout"].iloc[-1] is None
    assert len(found) == 4


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (
            {"counters": {"K": [1]}},
            "counters: expected a counter of the design, found 'K'; did you mean 'k'?",
        ),
        ({"sizes": {"Z9": [1]}}, "sizes: expected a symbol of the design, found 'Z9'"),
        ({"width": []}, "width: expected at least one value, found none"),
        ({"width": 5}, "width: expected a list of values, found 5"),
        ({"height": "5"}, "height: expected a list of values, found '5'"),
        ({"counters": {"k": 3}}, "k: expected a list of values, found 3"),
        ({"sizes": {"B": 0.8}}, "B: expected a list of values, found 0.8"),
        ({"counters": [3]}, "counters: expected a mapping from names, found [3]"),
        ({"sizes": 3}, "sizes: expected a mapping from names, found 3"),
        ({"executor": 3}, "executor: expected an executor with submit, found 3"),
    ],
)
def test_faults(house: Design, values: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match="sweep") as told:
        sweep(house, **values, progress=False)  # type: ignore[arg-type]
    assert message in str(told.value)


def test_a_value_out_of_range_is_told_in_its_row(house: Design) -> None:
    found = sweep(house, width=[-1, 6], counters={"k": [2.5, 3]}, progress=False)  # type: ignore[list-item]
    assert "width" in found["error"][0] and found["layout"][0] is None
    assert "k" in found["error"][2] and found["layout"][3] is not None


def test_a_symbol_with_the_name_of_a_column(house: Design) -> None:
    named = with_symbol(house, "shapes", size=1.0)
    with pytest.raises(ValueError, match="rename"):
        sweep(named, sizes={"shapes": [1.0]}, progress=False)


class TestContactSheet:
    def test_all_variants_at_one_scale(self, table: pd.DataFrame) -> None:
        root = ElementTree.fromstring(contact_sheet(table, columns=3))
        drawn = root.findall("{http://www.w3.org/2000/svg}svg")
        assert len(drawn) == 4
        scales = {round(float(svg.get("data-scale", "0")), 3) for svg in drawn}
        assert len(scales) == 1
        text = " ".join("".join(root.itertext()).split())
        assert "width 7.5 · B 1.1" in text and "shortest word" in text

    def test_names_are_text(self, table: pd.DataFrame) -> None:
        text = contact_sheet(table.rename(columns={"B": "<b>"}))
        assert "<b>" not in text and "&lt;b&gt;" in text

    def test_empty(self, table: pd.DataFrame) -> None:
        ElementTree.fromstring(contact_sheet(table[:0]))

    @pytest.mark.parametrize(
        "wrong", [{"columns": 0}, {"columns": 2.5}, {"columns": "2"}, {"width_px": 100}, {"theme": "blue"}]
    )
    def test_faults(self, table: pd.DataFrame, wrong: dict[str, object]) -> None:
        with pytest.raises(ValueError, match="expected"):
            contact_sheet(table, **wrong)  # type: ignore[arg-type]

    @pytest.mark.parametrize("wrong", [[], 3, pd.DataFrame({"a": [1]})])
    def test_what_is_no_table_of_layouts(self, wrong: object) -> None:
        with pytest.raises(ValueError, match="expected a table with a column 'layout'"):
            contact_sheet(wrong)  # type: ignore[arg-type]


RANGES = {"width": (6.0, 9.0), "counters": {"k": (3, 5)}, "sizes": {"B": (0.8, 1.2)}}


class TestVary:
    @pytest.mark.parametrize(
        ("given", "told"),
        [
            ({"width": 5}, "width: expected a range (least, greatest), found 5"),
            ({"width": (1, 2, 3)}, "width: expected a range (least, greatest), found (1, 2, 3)"),
            ({"height": ("1", "2")}, "height: expected two finite numbers"),
            ({"width": (1, float("inf"))}, "width: expected two finite numbers"),
            ({"width": (float("nan"), 2)}, "width: expected two finite numbers"),
            ({"counters": {"k": (2.5, 3)}}, "counters: 'k': expected whole numbers, found (2.5, 3)"),
            ({"counters": {"k": 3}}, "counters: 'k': expected a range"),
            ({"counters": 3}, "counters: expected a mapping from names, found 3"),
            ({"sizes": [(1, 2)]}, "sizes: expected a mapping from names"),
            ({"seed": 2.5}, "seed: expected a whole number, found 2.5"),
            ({"seed": "a"}, "seed: expected a whole number, found 'a'"),
        ],
    )
    def test_what_is_no_range(self, house: Design, given: dict[str, object], told: str) -> None:
        with pytest.raises(ValueError, match="vary: ") as error:
            vary(house, **({"seed": 1} | given))  # type: ignore[arg-type]
        assert told in str(error.value)

    def test_an_end_between_two_centimetres_is_not_passed(self, house: Design) -> None:
        assert vary(house, 1, width=(6.004, 6.0045)).canvas.width == 6.004

    def test_by_seed(self, house: Design) -> None:
        first = vary(house, 4, **RANGES)  # type: ignore[arg-type]
        assert first == vary(house, 4, **RANGES)  # type: ignore[arg-type]
        assert first != vary(house, 5, **RANGES)  # type: ignore[arg-type]
        found = (first.canvas.width, first.counters["k"].value, first.symbols["B"].size, first.seed)
        assert found == (6.04, 3, 0.89, 4)  # the same on every machine, for ever

    def test_within_the_ranges_and_all_of_them(self, house: Design) -> None:
        found = [vary(house, seed, **RANGES) for seed in range(60)]  # type: ignore[arg-type]
        assert {design.counters["k"].value for design in found} == {3, 4, 5}
        widths = [design.canvas.width for design in found]
        assert min(widths) >= 6 and max(widths) <= 9 and max(widths) - min(widths) > 2
        assert all(round(width, 2) == width for width in widths)
        assert all(0.8 <= (design.symbols["B"].size or 0) <= 1.2 for design in found)

    def test_nothing_else_changes(self, house: Design) -> None:
        assert vary(house, 9) == replace(house, seed=9)

    def test_faults(self, house: Design) -> None:
        with pytest.raises(ValueError, match="least to its greatest"):
            vary(house, 1, width=(9, 6))
        with pytest.raises(ValueError, match="did you mean 'k'"):
            vary(house, 1, counters={"K": (1, 2)})
