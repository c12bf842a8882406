"""Ground shares its corners between kinds, and shows what it showed."""

from __future__ import annotations

import numpy as np

from facade_nb.render.town.welding import shared


def test_triangles_keep_their_corners_and_end_with_one_of_their_own_face() -> None:
    """A net of squares in two triangles each, each square with corners of its own, in two faces like a chess board."""
    x, y = (v.ravel() for v in np.meshgrid(np.arange(8), np.arange(8)))
    spots = (np.stack([x, x + 1, x + 1, x], axis=1) + 9 * np.stack([y, y, y + 1, y + 1], axis=1)).ravel()
    faces = np.repeat((x + y) % 2, 4)
    triangles = (4 * np.arange(64)[:, None, None] + np.array([[0, 1, 2], [0, 2, 3]])).reshape(-1, 3)
    kept, new = shared(spots, faces, triangles)
    old_spots, new_spots = spots[triangles], spots[kept][new]
    turns = [np.roll(old_spots, k, axis=1) for k in range(3)]
    assert np.any([(new_spots == turned).all(axis=1) for turned in turns], axis=0).all()
    assert (faces[kept][new[:, 2]] == faces[triangles[:, 0]]).all()
    assert 81 <= len(kept) < 130 < len(spots)
