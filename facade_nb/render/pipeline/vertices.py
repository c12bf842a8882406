"""What a vertex carries: all that the grammar needs to draw the façade that it belongs to (the texture paper's 6).

Only the place differs among the vertices of a façade. The rest is the same at each of them, and so at each pixel.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["SEEDS", "VERTEX", "turning"]

VERTEX = np.dtype(
    [
        ("position", np.float32, 3),
        ("place", np.float32, 2),
        ("size", np.float32, 2),
        ("start", np.float32, 2),
        ("seed", np.float32, 2),
        ("normal", np.float32, 3),
        ("tangent", np.float32, 3),
    ]
)
"""A vertex: 17 floats, 68 bytes.

position
    x east, y up, z south, metres.
place
    From the façade's lower left corner, seen from outside: along its width and its height, metres.
size
    Width and height of the whole façade, metres.
start
    Column and row of the start rule in the grammar's texture.
seed
    Of the façade, metres: whole multiples of 1/64 from 0 to below 16384, which a 32-bit float holds exactly.
normal
    Unit vector out of the façade. Zeros: it turns to whoever looks, the sun too. The four corners of such a quad have
    the position of its middle, and it is open where the tile is that the uppermost colour of its rule paints. Numbers
    below a quarter are zeros to all but lamps, whose light they bound (`town.lamplight`).
tangent
    Unit vector along the façade's width. Height runs along the cross product of normal and tangent. Of what turns: the
    axis about which it does, up, or zeros, for all ways.

Triangles are counter-clockwise where their front is seen.
"""

LAMP = np.array((0.8, 4.4), np.float32)
"""Width and height of a street lamp, metres: nothing else that turns has them."""

SEEDS = 1 << 20
"""A seed is below so many steps of 1/64 m."""


def turning(vertices: np.ndarray) -> NDArray[np.bool_]:
    """Which vertices are of what turns to whoever looks: as ``standing.glsl`` has it."""
    return np.asarray((vertices["normal"].astype(np.float64) ** 2).sum(axis=-1) < 0.25)
