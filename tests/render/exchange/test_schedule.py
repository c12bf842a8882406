"""The schedule, read again by `csv` and by pandas."""

from __future__ import annotations

import csv
from collections import Counter
from io import StringIO
from pathlib import Path

import pandas as pd
import pytest

from facade_nb import DesignError
from facade_nb.render import schedule, to_schedule, write_schedule

from .samples import NAMES, layout, shape, solved

HEADER = "mark,kind,geometry,material,width_m,height_m,count,area_m2,layers"


@pytest.mark.parametrize("name", NAMES)
def test_every_shape_is_counted_once(name: str) -> None:
    own = solved(name)
    text = to_schedule(own)
    assert text.splitlines()[0] == HEADER
    rows = list(csv.DictReader(StringIO(text)))
    expected = Counter(
        (
            s.kind,
            s.geometry,
            s.material,
            round(1000 * (s.rect[2] - s.rect[0])),
            round(1000 * (s.rect[3] - s.rect[1])),
        )
        for s in own.shapes
    )
    found = {
        (
            r["kind"],
            r["geometry"],
            r["material"],
            round(1000 * float(r["width_m"])),
            round(1000 * float(r["height_m"])),
        ): r
        for r in rows
    }
    assert {key: int(row["count"]) for key, row in found.items()} == expected
    assert len(found) == len(rows) == len({row["mark"] for row in rows})
    for key, row in found.items():
        same = [
            s
            for s in own.shapes
            if (s.kind, s.geometry, s.material) == key[:3]
            and abs(1000 * (s.rect[2] - s.rect[0]) - key[3]) <= 0.5001
            and abs(1000 * (s.rect[3] - s.rect[1]) - key[4]) <= 0.5001
        ]
        area = sum((s.rect[2] - s.rect[0]) * (s.rect[3] - s.rect[1]) for s in same)
        assert float(row["area_m2"]) == pytest.approx(area, abs=1e-3)
        assert set(row["layers"].split("; ")) == {s.layer for s in same}
    windows = [row["kind"] == "window" for row in rows]
    assert windows == sorted(windows, reverse=True)  # first


def test_the_table_is_what_is_written(tmp_path: Path) -> None:
    own = solved("residential-house")
    path = write_schedule(own, tmp_path / "a.csv")
    pd.testing.assert_frame_equal(pd.read_csv(path), schedule(own))


def test_sizes_to_the_millimetre_and_names_that_need_quotes() -> None:
    own = layout(
        4,
        1,
        shape((0, 0, 1.0004, 1), "window", layer='a, "b"'),
        shape((1, 0, 1.9996, 1), "window", layer="c"),
        shape((2, 0, 3.002, 1), "window"),
        shape((3, 0, 4, 1), "  "),
        shape((3, 0, 4, 1), "wing"),
        shape((3, 0, 4, 1), "wall"),
    )
    rows = list(csv.DictReader(StringIO(to_schedule(own))))
    assert [(r["mark"], r["kind"], r["width_m"], r["count"], r["layers"]) for r in rows] == [
        ("W1", "window", "1.002", "1", "base"),
        ("W2", "window", "1.0", "2", 'a, "b"; c'),
        ("O1", "other", "1.0", "1", "base"),
        ("WA1", "wall", "1.0", "1", "base"),
        ("WI1", "wing", "1.0", "1", "base"),
    ]


def test_nothing_is_a_header(tmp_path: Path) -> None:
    assert to_schedule(layout(3, 2)) == f"{HEADER}\n"
    with pytest.raises(DesignError, match="cannot write"):
        write_schedule(layout(3, 2), tmp_path / "missing" / "a.csv")
