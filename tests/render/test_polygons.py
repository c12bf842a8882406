"""Polygons that are cut and written all at once come out as one by one."""

from __future__ import annotations

import re

import numpy as np
import pytest

from facade_nb.render.annotate import Frame
from facade_nb.render.ink import clip
from facade_nb.render.polygons import clip_all, polygons_path, segments_path


def test_many_are_cut_as_each_is_by_itself() -> None:
    draw = np.random.default_rng(4)
    low, size, way = (draw.uniform(0, 4, (400, 2)) for _ in range(3))
    (x0, y0), (x1, y1) = low.T, (low + size + 0.1).T
    dx, dy = way.T
    swept = np.stack(  # boxes, and where they come to: hexagons, as shadows are
        [
            np.stack([x0, x0 + dx, x1 + dx, x1 + dx, x1, x0], axis=1),
            np.stack([y0, y0 - dy, y0 - dy, y1 - dy, y1, y1], axis=1),
        ],
        axis=2,
    )
    corner = draw.uniform(0, 4, (400, 2))
    boxes = np.concatenate([corner, corner + draw.uniform(0.1, 5, (400, 2))], axis=1)
    found = clip_all(swept, boxes)
    alone = [clip([(x, y) for x, y in own], tuple(box)) for own, box in zip(swept, boxes, strict=True)]
    assert [len(own) for own in found] == [len(own) for own in alone]
    assert {len(own) for own in found} >= {0, 3, 4, 5, 6}
    for own, one in zip(found, alone, strict=True):
        assert own == pytest.approx(np.array(one).reshape(-1, 2))
    assert clip_all(swept[:0], boxes[:0]) == []


def test_a_path_is_as_short_as_it_gets_and_exact_to_a_hundredth_of_a_pixel() -> None:
    frame = Frame.fit(4.0, 3.0, None, dimensions=False)
    square = np.array([[0.0, 0.0], [1.5, 0.0], [1.5, 1.0], [0.0, 1.0]])
    slanted = np.array([[0.0, 0.0], [1.0, 0.3], [0.2, 0.9]])
    text = polygons_path([square, slanted], frame)
    first, second = text.split("z")[:2]
    assert re.fullmatch(r"M[\d.]+ [\d.]+H[\d.]+V[\d.]+H[\d.]+", first)
    numbers = [float(one) for one in re.findall(r"-?[\d.]+", second)]
    wanted = [value for x, y in slanted.tolist() for value in frame.at(x, y)]
    assert numbers == pytest.approx(wanted, abs=0.0051)
    assert polygons_path([], frame) == ""
    assert re.fullmatch(r"M\S+ \S+V\S+M\S+ \S+H\S+", segments_path([(1, 0, 1, 2), (0, 1, 2, 1)], frame))
    left = segments_path([(-4.0, 0, -4.0, 2)], frame)  # beside the sheet
    assert float(left[1:].split()[0]) == pytest.approx(frame.at(-4.0, 0)[0], abs=0.0051)
