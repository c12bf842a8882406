"""Which pairs of letters make no shape, and why (docs/problem.md)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...design.model import AXES, Design, Layer
from ..assembly.looks import Instance, Looks, instances
from ..events import ShapeHidden
from ..model.layout import AxisLayout, PlacedLetter, PlacedShape

__all__ = ["hidden"]

_NEAR = 1e-6


def hidden(
    design: Design, x: AxisLayout, y: AxisLayout, shapes: Sequence[PlacedShape]
) -> Iterator[ShapeHidden]:
    """Every pair of letters that makes no shape, the topmost layer first.

    `shapes` are those that `merging.merge` made. The reason is the first that holds of ``transparent``, ``mask``,
    ``hidden`` (then it is by the axis of the letter to blame), ``not visible`` (by the layer itself), ``behind`` (by
    the layer of the shape in front).
    """
    own: dict[str, list[PlacedShape]] = {}
    for shape in shapes:
        own.setdefault(shape.layer, []).append(shape)
    covers: list[PlacedShape] = []
    for layer in design.stack:
        low, high = _rects(covers)
        looks = Looks(design, layer)
        across, up = ({id(a): own for a, own in instances(axis, layer)} for axis in (x, y))
        for v in y.row(layer.name).letters:
            for h in x.row(layer.name).letters:
                rect = (h.start, v.start, h.end, v.end)
                reason = _unseen(design, layer, h, v)
                if reason is None and not _is_visible(looks, across[id(h)], up[id(v)]):
                    reason = ("not visible", layer.name)
                if reason is None:
                    over = (low <= np.array(rect[:2]) + _NEAR) & (high >= np.array(rect[2:]) - _NEAR)
                    front = np.flatnonzero(over.all(axis=1))
                    if not front.size:
                        continue
                    reason = ("behind", covers[int(front[0])].layer)
                yield ShapeHidden("", layer.name, h.symbol, v.symbol, rect, *reason)
        covers += [
            s for s in own.get(layer.name, ()) if design.symbol(s.x).opaque and design.symbol(s.y).opaque
        ]


def _rects(shapes: Sequence[PlacedShape]) -> tuple[np.ndarray, np.ndarray]:
    """Lower left and upper right corners, shape (n, 2) each."""
    corners = np.array([s.rect for s in shapes]).reshape(-1, 4)
    return corners[:, :2], corners[:, 2:]


def _unseen(design: Design, layer: Layer, h: PlacedLetter, v: PlacedLetter) -> tuple[str, str] | None:
    letters = tuple(zip(AXES, (h, v), strict=True))
    for axis, letter in letters:
        if letter.transparent:
            return "transparent", axis
    for axis, letter in letters:
        mask = layer.along(axis).mask
        if mask is not None and letter.symbol not in mask:
            return "mask", axis
    for axis, letter in letters:
        if letter.symbol in design.patterns[layer.along(axis).pattern].hidden:
            return "hidden", axis
    return None


def _is_visible(looks: Looks, x: Instance, y: Instance) -> bool:
    return bool(looks.of(looks.sort(x), looks.sort(y)).visible)
