"""Pictures: a layout as a building in daylight, drawn without a screen."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from ..design.files import write_atomically
from ..solver.model.layout import Layout

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .camera import Camera
    from .pipeline.solids import Solids

__all__ = ["picture", "png_of", "render_png", "scene_picture"]

_FAR = 4000.0
"""How far one sees, metres."""

_HAZE, _CLEAR = 300.0, 8.0
"""After so many metres, at least, and so many times the way to the house, a third is left of what is seen."""


def render_png(
    layout: Layout,
    path: str | Path | None = None,
    *,
    size: tuple[int, int] = (1600, 1000),
    camera: Camera | None = None,
    time_of_day: str = "morning",
    background: str = "sky",
    backend: str | None = None,
    samples: int = 2,
    rays: int = 64,
) -> bytes:
    """Render a layout as a PNG picture.

    Parameters
    ----------
    layout
        What to show.
    path
        Where to write it, atomically; None: nowhere.
    size
        Width and height in pixels.
    camera
        Where to stand; None: a little to the right.
    time_of_day
        ``morning``, ``noon``, ``evening`` or ``overcast``.
    background
        ``sky`` or ``transparent`` (the ground then shows only the shadow that falls on it).
    backend
        Who draws: ``osmesa`` or ``egl``; None: the best that works here.
    samples
        Each pixel is the mean of `samples` × `samples` points.
    rays
        From how many directions the light of the sky is gathered; more is smoother, and slower.

    Returns
    -------
    bytes
        The PNG file.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material, or a file that cannot be written.
    BackendError
        If the backend asked for does not work here, or none does; its text says what would help.
    ValueError
        For an unknown time of day, background or backend, or a size below 16 pixels.
    """
    pixels = picture(
        layout,
        size,
        camera,
        time_of_day=time_of_day,
        background=background,
        backend=backend,
        samples=samples,
        rays=rays,
    )
    return png_of(pixels, path)


def png_of(pixels: NDArray[np.uint8], path: str | Path | None = None) -> bytes:
    """Return pixels as a PNG file, and write it to a path, if there is one, atomically."""
    from PIL import Image

    stream = BytesIO()
    Image.fromarray(pixels).save(stream, "PNG")
    data = stream.getvalue()
    if path is not None:
        write_atomically(path, data)
    return data


def picture(
    layout: Layout,
    size: tuple[int, int] = (1600, 1000),
    camera: Camera | None = None,
    *,
    time_of_day: str = "morning",
    background: str = "sky",
    backend: str | None = None,
    samples: int = 2,
    rays: int = 64,
) -> NDArray[np.uint8]:
    """As `render_png`, but the pixels: (h, w, 3) uint8, or (h, w, 4) on a transparent background."""
    import numpy as np

    from .pipeline.solids import solids_of

    solids = solids_of(layout)
    canvas = [(0.0, 0.0, 0.0), (layout.canvas.width, layout.canvas.height, 0.0)]
    return scene_picture(
        solids,
        np.concatenate([np.array(canvas), solids.corners]),
        size,
        camera,
        time_of_day=time_of_day,
        background=background,
        backend=backend,
        samples=samples,
        rays=rays,
    )


def scene_picture(
    solids: Solids,
    points: NDArray[np.float64],
    size: tuple[int, int] = (1600, 1000),
    camera: Camera | None = None,
    *,
    time_of_day: str = "morning",
    background: str = "sky",
    backend: str | None = None,
    samples: int = 2,
    rays: int = 64,
) -> NDArray[np.uint8]:
    """The pixels of a picture of solids; `points` (n, 3) are what has to be in it."""
    from dataclasses import replace

    import numpy as np

    from .camera import Camera
    from .daylight import find_daylight
    from .pipeline.device import choose_device
    from .pipeline.frame import Looks
    from .pipeline.gathering import gathered
    from .pipeline.renderer import renderer_of
    from .pipeline.stills import still
    from .pipeline.viewpoint import Frustum

    if background not in ("sky", "transparent"):
        raise ValueError(f"background: expected sky or transparent; found {background!r}")
    if min(size) < 16 or samples < 1 or rays < 1:
        raise ValueError(
            f"expected a size of at least 16 pixels and at least 1 sample and ray; found {size}, {samples}, {rays}"
        )
    daytime = find_daylight(time_of_day)
    device = choose_device(backend)
    view = (camera or Camera()).look(points, size)
    frustum = replace(Frustum.of(view), reach=(0.4 * view.reach[0], _FAR))
    cut = background == "transparent"
    apart = float(np.abs(solids.box.mean(axis=0) - view.eye).max())
    looks = Looks(haze=max(_HAZE, _CLEAR * apart), smooth=not cut, rays=rays, relief=False)
    passes, buffers = gathered(rays, cut=cut)
    with renderer_of(solids.scene, device, passes=passes, buffers=buffers) as renderer:
        return still(renderer, frustum, daytime, size, looks, samples, of="cut" if cut else None)
