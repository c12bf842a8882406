"""Who runs the pipeline: OpenGL, on OSMesa or EGL."""

from __future__ import annotations

from ...design.errors import nearest
from ..backends import BackendError
from ..texture.gl import EGL, OSMESA, GlPainter
from ..texture.painters import has_card

__all__ = ["DEVICES", "choose_device"]

DEVICES: dict[str, GlPainter] = {"osmesa": OSMESA, "egl": EGL}
"""By name."""


def choose_device(name: str | None = None) -> GlPainter:
    """The device of that name, or the best that works here: EGL where there is a graphics card, else OSMesa, else EGL.

    Raises
    ------
    ValueError
        For an unknown name.
    BackendError
        If it cannot be used here, or none can; its text says what would help.
    """
    if name is not None and name not in DEVICES:
        raise ValueError(
            f"backend: expected one of {', '.join(DEVICES)}; found {name!r}{nearest(name, DEVICES)}"
        )
    order = [name] if name else ["egl", "osmesa"] if has_card() else ["osmesa", "egl"]
    for one in order:
        if DEVICES[one].available:
            return DEVICES[one]
    raise BackendError("\n".join(DEVICES[one].why_not for one in order))
