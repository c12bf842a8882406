"""A town is looked at from afar where it stands close together."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

from facade_nb.render.town import Town
from facade_nb.render.town.overview import town_share
from tests.render.town.places import box, collection, feature

PIXELS = (24, 15)


def lopsided(turned: bool) -> dict[str, Any]:
    """Rows of houses wall to wall, a few farms on the plain on three sides of them, and one hall."""
    rows = [(60.0 + 12 * i, 40.0 * j) for i in range(16) for j in range(9)]
    farms = [(-90.0 * k, 70.0 * (k % 3)) for k in range(1, 7)] + [(150.0, 500.0), (180.0, -300.0)]
    boxes = [box(x, y, 12, 11) for x, y in rows] + [box(x, y) for x, y in farms] + [box(-700, 300, 180, 120)]
    return collection(*(feature([(-x, -y) for x, y in ring] if turned else ring) for ring in boxes))


@pytest.mark.parametrize("turned", [False, True])
def test_most_of_what_one_sees_from_afar_is_near_a_house(turned: bool) -> None:
    town = Town.from_geojson(lopsided(turned), seed=1)
    plan, place = town.plan, town.viewpoint("distance")
    seen = place.frustum(PIXELS)
    left, bottom, right, top = seen.window
    x, y = np.meshgrid(np.linspace(left, right, PIXELS[0]), np.linspace(bottom, top, PIXELS[1]))
    rays = seen.ahead + x[..., None] * seen.right + y[..., None] * seen.up
    down = rays[rays[..., 1] < -0.02]
    spots = seen.eye + down * (seen.eye[1] / -down[:, 1:2])
    houses = shapely.union_all(plan.outlines()[: 16 * 9])
    near = shapely.distance(shapely.points(spots[:, 0], -spots[:, 2]), houses) < 20
    assert near.sum() > 0.5 * rays.shape[0] * rays.shape[1]
    # Who turns round sees the plain.
    back = type(place)(place.eye, place.yaw + 180.0, place.pitch, place.angle)
    assert town_share(plan, place) > 0.4 > 4 * town_share(plan, back)
