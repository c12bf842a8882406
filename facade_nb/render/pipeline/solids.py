"""A solved layout as a scene of the pipeline: its solids, the body behind them, and the ground.

Each triangle carries a façade, as all in a scene do: the surface of a material, metres along it and up it, or a pane
with the room behind it. The pipeline sees no difference (docs/pipeline.md).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...solver.model.layout import Layout
from ..scene import Triangles
from ..surfaces import surface_axes
from ..surroundings import building
from ..texture.grammar import Grammar
from .finishes import BOWED, Finishes, finishes
from .scene import CHUNK, Scene
from .vertices import VERTEX

__all__ = ["BODY", "GROUND", "Solids", "combined", "solids_of", "solids_scene"]

BODY, GROUND = -1, -2
"""What a triangle belongs to that is no shape's: the house behind its façade, or the ground."""

_FAR = 1500.0
"""How far the ground reaches, metres."""

_ROUND = 1e-3
"""A triangle is a side of a round body where the normals of its corners are so far from its own."""

_HIGHEST = 100.0
"""Metres: what would need a higher façade is hardly bowed."""

Floats = NDArray[np.float64]
Rect = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Solids:
    """A scene of solids.

    Attributes
    ----------
    scene
        What the pipeline draws.
    shapes
        (t,) for each triangle of the scene which shape of the layout it belongs to, `BODY` or `GROUND`.
    box
        Least and greatest coordinates (2, 3) of what stands on the ground, metres.
    """

    scene: Scene
    shapes: NDArray[np.int64]
    box: Floats

    @property
    def corners(self) -> Floats:
        """Corners (3 t, 3) of the triangles that stand on the ground."""
        own = self.scene.indices.reshape(-1, 3)[self.shapes != GROUND].reshape(-1)
        return self.scene.vertices["position"][own].astype(np.float64)

    def moved(self, origin: Floats, axes: Floats) -> Solids:
        """The same elsewhere: `axes` (3, 3) are where x, y and z point from there. Of solids without ground."""
        vertices = self.scene.vertices.copy()
        for name in ("normal", "tangent"):
            vertices[name] = vertices[name] @ axes
        vertices["position"] = vertices["position"].astype(np.float64) @ axes + origin
        return _whole(vertices, self.shapes, self.scene.grammar)


def solids_of(layout: Layout, *, ground: bool = True) -> Solids:
    """The scene of a layout: the façade is in the plane z = 0, its lower left corner the origin.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material.
    """
    return solids_scene(building(layout), [shape.rect for shape in layout.shapes], ground=ground)


def solids_scene(triangles: Triangles, rects: Sequence[Rect], *, ground: bool = True) -> Solids:
    """The scene of triangles; `rects`: those of the shapes that they name, metres. Rooms fill these."""
    coats = finishes(triangles.material_names, triangles.library)
    count = len(triangles.positions)
    vertices = np.zeros((count, 3), VERTEX)
    vertices["position"] = triangles.positions
    corners = triangles.positions.astype(np.float64)
    axes = surface_axes(corners)
    vertices["normal"], vertices["tangent"] = axes[:, None, 2], axes[:, None, 0]
    local = np.stack([(corners * axes[:, None, k]).sum(axis=2) for k in (0, 1)], axis=2)
    _spread(vertices, local, triangles.materials, coats)
    _rounded(vertices, local, triangles, axes, coats)
    _glazed(vertices, triangles, axes, rects, coats)
    _drawn(vertices, local, triangles, axes, rects, coats)
    shapes = triangles.shapes.astype(np.int64)
    return _whole(vertices.reshape(-1), shapes, coats.grammar, coats if ground else None)


def combined(
    parts: Sequence[Solids], materials: tuple[str, ...], library: str = "", *, ground: bool = True
) -> Solids:
    """Solids without ground as one scene: all made of triangles with these `materials`, their rules of `library`."""
    coats = finishes(materials, library)
    vertices = np.concatenate([part.scene.vertices for part in parts])
    shapes = np.concatenate([part.shapes for part in parts])
    return _whole(vertices, shapes, coats.grammar, coats if ground else None)


def _whole(
    flat: np.ndarray, shapes: NDArray[np.int64], grammar: Grammar, coats: Finishes | None = None
) -> Solids:
    """The scene of vertices, three a triangle, and with `coats` the ground around them."""
    count = len(flat) // 3
    points = flat["position"].astype(np.float64)
    box = np.stack([points.min(axis=0), points.max(axis=0)]) if count else np.zeros((2, 3))
    chunks = [(0, 3 * count, box[0], box[1])] if count else []
    indices = np.arange(3 * count, dtype=np.uint32)
    if coats is not None:
        own = _ground(box, coats)
        chunks.append((len(indices), 6, own["position"].min(axis=0), own["position"].max(axis=0)))
        square = np.array([0, 1, 2, 0, 2, 3], np.uint32) + np.uint32(len(flat))
        flat, indices = np.concatenate([flat, own]), np.concatenate([indices, square])
        shapes = np.append(shapes, [GROUND, GROUND])
    # A low sun throws shadows some way beyond the house.
    aside = np.array([1.0, 0.0, 1.0]) * (2.5 * (box[1, 1] - box[0, 1]) + 4)
    sunny = np.stack([np.minimum(box[0], (np.inf, 0, np.inf)) - aside, box[1] + aside])
    made = np.array(chunks, CHUNK)
    return Solids(Scene(flat, indices, grammar, made, sunny=sunny, solid=box), shapes, box)


def _spread(vertices: np.ndarray, local: Floats, materials: NDArray[np.int64], coats: Finishes) -> None:
    """Each material on one endless façade, whose pattern begins at the origin."""
    for number, (start, period) in enumerate(zip(coats.flat, coats.period, strict=True)):
        own = materials == number
        if not own.any():
            continue
        low = local[own].min(axis=(0, 1))
        place = local[own] + np.ceil(np.maximum(-low, 0) / period + 1) * period
        vertices["place"][own] = place
        vertices["size"][own] = np.ceil(place.max(axis=(0, 1)) + 1)
        vertices["start"][own] = start


def _rounded(
    vertices: np.ndarray, local: Floats, triangles: Triangles, axes: Floats, coats: Finishes
) -> None:
    """Sides of round bodies: each is a façade, across which its normal turns."""
    turned = triangles.normals.astype(np.float64) - axes[:, None, 2]
    own = np.flatnonzero(triangles.round & (np.abs(turned).max(axis=2) > _ROUND).all(axis=1))
    if not len(own):
        return
    # Its middle is where the normal is its own: between the corners to the left and those to the right.
    bent = (turned[own] * axes[own][:, None, 0]).sum(axis=2)
    x = local[own][:, :, 0]
    middle = _middle(x, bent)
    wide = 2 * np.abs(x - middle[:, None]).max(axis=1)
    y = local[own][:, :, 1]
    place = np.stack([x - middle[:, None] + wide[:, None] / 2, y - y.min(axis=1)[:, None]], axis=2)
    tall, start = place[:, :, 1].max(axis=1), coats.round[triangles.materials[own]]
    for rules, (lift, height) in zip(
        (coats.bulging, coats.hollow), _bowed(y, turned[own], axes[own]), strict=True
    ):
        some = np.isfinite(height)
        place[some, :, 1] = (y + lift[:, None])[some]
        tall[some], start[some] = height[some], rules[triangles.materials[own[some]]]
    vertices["place"][own] = place
    vertices["size"][own] = np.stack([wide, tall], axis=1)[:, None]
    vertices["start"][own] = start[:, None]


def _bowed(y: Floats, turned: Floats, axes: Floats) -> Iterator[tuple[Floats, Floats]]:
    """How a bulging façade, then a hollow one, lies on sides whose normals lean from their own as one goes up.

    Of each side what is added to its `y` (n, 3), and how high the façade is on which it then lies; not finite where
    the side does not lean so.
    """
    lean = (turned * axes[:, None, 1]).sum(axis=2)
    rows, low, high = np.arange(len(y)), y.argmin(axis=1), y.argmax(axis=1)
    rise = (lean[rows, high] - lean[rows, low]) / np.maximum(y[rows, high] - y[rows, low], 1e-9)
    level = lean[rows, low] - rise * y[rows, low]
    for sign in (1.0, -1.0):
        bowed = (sign * rise > 2 * BOWED / _HIGHEST) & (np.abs(lean).max(axis=1) < BOWED)
        steep = np.where(bowed, sign * rise, np.nan)
        yield (BOWED + sign * level) / steep, 2 * BOWED / steep


def _middle(x: Floats, bent: Floats) -> Floats:
    """Where on a line from the corner whose normal leans most to the left to that most to the right it does not."""
    rows = np.arange(len(x))
    left, right = bent.argmin(axis=1), bent.argmax(axis=1)
    low, high = bent[rows, left], bent[rows, right]
    share = np.clip(-low / np.maximum(high - low, 1e-9), 0, 1)
    return np.asarray(x[rows, left] + share * (x[rows, right] - x[rows, left]))


def _glazed(
    vertices: np.ndarray, triangles: Triangles, axes: Floats, rects: Sequence[Rect], coats: Finishes
) -> None:
    """Panes that look to the front: all those of a shape look into one room, which is as large as the shape."""
    if not coats.glass.any():
        return
    own = np.flatnonzero(coats.glass[triangles.materials] & (triangles.shapes >= 0) & (axes[:, 2, 2] > 0.99))
    if not len(own):
        return
    shape = triangles.shapes[own]
    every = np.array(rects, np.float64)
    vertices["place"][own] = triangles.positions[own][:, :, :2] - every[shape][:, None, :2]
    vertices["size"][own] = (every[shape, 2:] - every[shape, :2])[:, None]
    vertices["start"][own] = coats.pane
    vertices["seed"][own] = np.stack([(37 * shape + 11) % 16384, (101 * shape + 7) % 16384], axis=1)[:, None]


def _drawn(
    vertices: np.ndarray,
    local: Floats,
    triangles: Triangles,
    axes: Floats,
    rects: Sequence[Rect],
    coats: Finishes,
) -> None:
    """What a rule draws fills the rectangle of its shape; on other sides of the body it begins at their edge."""
    own = np.flatnonzero(coats.ruled[triangles.materials] & (triangles.shapes >= 0))
    if not len(own):
        return
    every = np.array(rects, np.float64)[triangles.shapes[own]]
    size = every[:, 2:] - every[:, :2]
    front = axes[own, 2, 2] > 0.5
    place = local[own]
    for shape in np.unique(triangles.shapes[own[~front]]):  # each side of a shape from its own edge
        for normal in np.unique(axes[own][(triangles.shapes[own] == shape) & ~front, 2].round(3), axis=0):
            side = ~front & (triangles.shapes[own] == shape) & (axes[own, 2].round(3) == normal).all(axis=1)
            place[side] -= place[side].min(axis=(0, 1))
    place[front] = triangles.positions[own[front]][:, :, :2] - every[front][:, None, :2]
    vertices["place"][own] = np.clip(place, 0, size[:, None])
    vertices["size"][own] = size[:, None]
    vertices["start"][own] = coats.flat[triangles.materials[own]][:, None]


def _ground(box: Floats, coats: Finishes) -> np.ndarray:
    """A square of paving around what stands there, level with its feet."""
    made = np.zeros(4, VERTEX)
    middle = np.round((box[0] + box[1]) / 2)[[0, 2]]
    spots = np.array([(-1, 1), (1, 1), (1, -1), (-1, -1)]) * _FAR
    made["position"][:, 0], made["position"][:, 2] = spots[:, 0] + middle[0], spots[:, 1] + middle[1]
    made["place"] = spots * (1, -1) + _FAR
    made["size"], made["start"] = 2 * _FAR, coats.ground
    made["normal"], made["tangent"] = (0, 1, 0), (1, 0, 0)
    return made
