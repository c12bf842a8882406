"""A town that is made by several threads: the same as with one, and given up in the middle without harm."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from facade_nb.render.town import Town, stages, workers
from facade_nb.render.town.workers import Workers


def village(rows: int = 3, columns: int = 6) -> dict[str, Any]:
    """Houses of 12 by 9 m in rows, gardens between them."""
    features = []
    for k in range(rows * columns):
        west, south = 9.5 + 0.0003 * (k % columns), 47.1 + 0.00035 * (k // columns)
        corners = [(0, 0), (0.00016, 0), (0.00016, 0.00008), (0, 0.00008), (0, 0)]
        ring = [[west + x, south + y] for x, y in corners]
        features.append({"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [ring]}})
    return {"type": "FeatureCollection", "features": features}


def test_threads_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    many = Town.from_geojson(village(), seed=3)
    monkeypatch.setattr(workers, "THREADS", False)
    one = Town.from_geojson(village(), seed=3)
    assert len(one.plan) == 18 and len(one.plan.roads) and len(one.plan.ground.triangles)
    for name in ("vertices", "indices", "chunks", "building_of"):
        assert np.array_equal(getattr(one, name), getattr(many, name)), name


@pytest.mark.parametrize("threads", [True, False])
def test_a_town_can_be_stopped_before_each_stage(threads: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workers, "THREADS", threads)
    told: list[str] = []
    Town.from_geojson(village(1, 2), progress=lambda _, name: told.append(name))
    names = told[:-1]  # the last says that there is a town
    assert names[0] == "footprints" and "ground" in names and names[-1] == "mesh"
    for count, name in enumerate(names):
        asked: list[None] = []

        def enough(asked: list[None] = asked, count: int = count) -> bool:
            asked.append(None)
            return len(asked) > count

        with pytest.raises(stages.TownStopped, match=f"before its {name}"):
            Town.from_geojson(village(1, 2), should_stop=enough)


@pytest.mark.parametrize("threads", [True, False])
def test_what_work_raises_comes_where_its_result_is_wanted(
    threads: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(workers, "THREADS", threads)
    with Workers() as some:
        wrong, right = some.begin(int, "no number"), some.begin(int, "12")
        assert right() == right() == 12
        with pytest.raises(ValueError, match="no number"):
            wrong()
