"""Materials that are rules, baked: the picture of a rule over the face of a shape, for programs that know no grammar.

The picture is drawn once for each rule and size of a face. It repeats beyond the face, so that sides and joinery
continue it.
"""

from __future__ import annotations

from functools import lru_cache
from io import BytesIO
from math import log2
from typing import TYPE_CHECKING

from .ruled import is_rule, rule_fault, rule_pixels

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..solver.model.layout import Rect
    from .meshing import Mesh

__all__ = ["SHARP", "baked", "baked_png", "drawable", "face_places", "face_size"]

SHARP = 128.0
"""Pixels a metre of the picture of a rule."""


def drawable(library: str, material: str) -> bool:
    """Whether a material is a rule that a grammar can draw."""
    return is_rule(material) and rule_fault(library, material, "") is None


def face_size(rect: Rect) -> tuple[float, float]:
    """How large the face of a shape is, metres."""
    left, bottom, right, top = rect
    return round(right - left, 4), round(top - bottom, 4)


def face_places(mesh: Mesh, size: tuple[float, float]) -> NDArray[np.float64]:
    """Texture coordinates (m, 3, 2) of a mesh in its shape's own frame: 0 to 1 over the face, and on beyond it."""
    from numpy import maximum

    return mesh.places / maximum(size, 1e-4)


def baked(library: str, material: str, size: tuple[float, float], most: int = 0) -> NDArray[np.uint8]:
    """A rule drawn over a face: (h, w, 3) sRGB, row 0 at the top; its sides are powers of two.

    Some programs repeat no other pictures, or draw no others small. `most` pixels along a side; 0: no such limit.
    """
    import numpy as np
    from PIL import Image

    scale = SHARP if not most else min(SHARP, most / max(size))
    picture = Image.fromarray(rule_pixels(library, material, size, scale))
    sides = [2 ** max(2, round(log2(side))) for side in picture.size]
    return np.asarray(picture.resize([min(side, most) if most else side for side in sides]))


@lru_cache(maxsize=128)
def baked_png(library: str, material: str, size: tuple[float, float]) -> bytes:
    """The same as a PNG file."""
    from PIL import Image

    stream = BytesIO()
    Image.fromarray(baked(library, material, size)).save(stream, "PNG", optimize=True)
    return stream.getvalue()
