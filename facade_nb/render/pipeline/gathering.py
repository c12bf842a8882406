"""Passes for stills: the sky's light gathered from many directions, and the sun's from one fine map.

The pipeline's own occlusion looks at the picture, which is quick, and knows nothing of what the picture does not show.
A still has time: it looks at the scene from many directions of the sky and asks which pixels each of them sees. So
reveals and corners darken as they do out of doors, and so does the ground beside a wall. These passes stand in the
place of the maps of shadows, occlusion and its softening; all others are as they were.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from .passes import BUFFERS, PASSES, Buffer, Pass, arranged

__all__ = ["gathered"]

_SUN, _SKY = 3072, 512
"""Texels of each side of the map of the sun, and of that of a direction of the sky."""

_BUFFERS = (
    Buffer("sun_map", 1, "depth", "How far the sun sees.", _SUN),
    Buffer("sunny", 1, "f2", "How much of the sun's disc a pixel sees."),
    Buffer("sky_map", 1, "depth", "How far one sees from one direction of the sky.", _SKY),
    Buffer("sky_seen", 4, "f4", "Light from all directions of the sky; and if nothing stood before them.", part=2),
    Buffer("cut", 4, "f1", "The picture without sky and ground, but for the shadow on it."),
)  # fmt: skip

_LEFT_OUT = frozenset({"shadow near", "shadow far", "leaves near", "leaves far", "occlusion", "soften"})


def gathered(rays: int, *, cut: bool = False) -> tuple[tuple[Pass, ...], tuple[Buffer, ...]]:
    """The passes and their buffers, for a frame whose looks have as many `rays`.

    Parameters
    ----------
    rays
        From how many directions the light of the sky is gathered.
    cut
        Whether sky and ground are to be cut away: the picture is then ``cut``, with alpha.
    """
    found: list[Pass] = []
    for own in PASSES:
        if own.name in _LEFT_OUT:
            continue
        if own.name == "light":
            found += _light(rays)
            reads = tuple(name for name in own.reads if not name.startswith("shadow_"))
            found.append(replace(own, reads=(*reads, "sunny"), defines=("GATHERED",)))
        else:
            found.append(own)
        if own.name == "tone" and cut:
            found.append(
                Pass("cut", "cut.frag", ("toned", "facing", "sunny", "softened"), ("cut",), "Cuts away sky and ground.")
            )  # fmt: skip
    buffers = (*BUFFERS, *_BUFFERS)
    return arranged(found, buffers), buffers


def _light(rays: int) -> Iterator[Pass]:
    yield Pass("sun map", "shadow.frag", (), ("sun_map",), "Draws what the sun sees.",
               "shadow.vert", "mesh", "sun_whole", both=True, when="shadow")  # fmt: skip
    yield Pass("sun leaves", "turning_shadow.frag", (), ("sun_map",), "Adds what turns.",
               "turning_shadow.vert", "mesh", "sun_whole", turning=True, adds=True, both=True,
               when="shadow")  # fmt: skip
    yield Pass("sun", "soft_sun.frag", ("facing", "sun_map"), ("sunny",), "Looks how much of the sun each pixel sees.",
               "lookup.vert", through="sun_whole", when="shadow")  # fmt: skip
    for k in range(rays):
        yield Pass(f"sky map {k}", "shadow.frag", (), ("sky_map",), "Draws what one direction of the sky sees.",
                   "shadow.vert", "mesh", f"sky_{k}", both=True, when="occlusion")  # fmt: skip
        yield Pass(f"sky {k}", "skylight.frag", ("facing", "sky_map"), ("sky_seen",), "Adds its light.",
                   "lookup.vert", through=f"sky_{k}", under=k > 0, when="occlusion")  # fmt: skip
    yield Pass("sky share", "sky_share.frag", ("sky_seen", "facing", "specular"), ("softened",),
               "Takes the mean on each plane.", when="occlusion")  # fmt: skip
