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
    from .daylight import Daylight
    from .shading import Exposure

__all__ = ["picture", "render_png"]


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
        ``osmesa``, ``egl`` or ``cpu``; None: the first that works here.
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
        If the backend asked for does not work here; its text says what would help.
    ValueError
        For an unknown time of day, background or backend, or a size below 16 pixels.
    """
    from PIL import Image

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

    from .backends import choose_backend
    from .camera import Camera
    from .daylight import find_daylight
    from .developing import binned, developed
    from .shading import Shot, expose
    from .surroundings import building

    if background not in ("sky", "transparent"):
        raise ValueError(f"background: expected sky or transparent; found {background!r}")
    if min(size) < 16 or samples < 1 or rays < 1:
        raise ValueError(
            f"expected a size of at least 16 pixels and at least 1 sample and ray; found {size}, {samples}, {rays}"
        )
    chosen = choose_backend(backend)
    light = find_daylight(time_of_day)
    triangles = building(layout)
    canvas = [(0.0, 0.0, 0.0), (layout.canvas.width, layout.canvas.height, 0.0)]
    points = np.concatenate([np.array(canvas), triangles.positions.reshape(-1, 3)])
    large = (size[0] * samples, size[1] * samples)
    view = (camera or Camera()).look(points, large)
    seen = expose(
        Shot(
            triangles,
            view,
            large,
            light,
            rays,
            np.array([s.rect for s in layout.shapes] or [(0, 0, 1, 1)], np.float32),
        ),
        chosen,
    )
    shown = developed(seen.light, light.exposure)
    alpha = None
    if background == "sky":
        shown = _with_sky(shown, seen, view.rays(large), view.eye, light)
    else:
        cover = np.where(seen.ground, seen.shade, seen.building)[..., None].astype(np.float32)
        alpha = binned(cover, samples)
        shown = np.where(seen.ground[..., None], np.array([0.06, 0.06, 0.08], np.float32), shown) * cover
    small = binned(shown, samples)
    if alpha is not None:
        small = np.concatenate([small / np.maximum(alpha, 1e-4), alpha], axis=2)
    return (np.clip(small, 0, 1) * 255 + 0.5).astype(np.uint8)


def _with_sky(
    shown: NDArray[np.float32],
    seen: Exposure,
    rays: NDArray[np.float32],
    eye: NDArray[np.float64],
    light: Daylight,
) -> NDArray[np.float32]:
    """The sky behind, and the far ground fading into it."""
    import numpy as np

    top, low = (np.asarray(colour, np.float32) for colour in light.backdrop)
    slope = rays[..., 1] / np.linalg.norm(rays, axis=2)
    sky = low + (top - low) * np.clip(slope / 0.5, 0, 1)[..., None] ** 0.7
    distance = eye[1] / np.maximum(-rays[..., 1], 1e-4)
    reach = float(np.linalg.norm(eye))
    far = np.clip((distance - 1.3 * reach) / (7.0 * reach), 0, 1)
    share = np.where(seen.building, 0, np.where(seen.ground, far**0.6, 1))[..., None]
    return (shown * (1 - share) + sky * share).astype(np.float32)
