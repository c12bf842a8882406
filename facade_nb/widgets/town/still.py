"""A still picture of a town: for pages where none can be drawn."""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO

from ...render.pipeline.frame import Frame, Looks
from ...render.pipeline.renderer import renderer_of
from ...render.texture.daytime import Daytime
from ...render.texture.gl import EGL, OSMESA, GlPainter
from ..shared.pictured import picture_html
from .model import TownModel
from .tiles import coarse_tiles

__all__ = ["SAVED", "SIZE", "image", "painter", "still", "told"]

SIZE = (720, 405)
"""Pixels of it."""

SAVED = (480, 270)
"""Pixels of what a cell's output carries, and a saved notebook with it."""

_QUALITY = 78


def painter() -> GlPainter | None:
    """Who draws it here; None: nobody can."""
    return next((own for own in (OSMESA, EGL) if own.available), None)


def still(model: TownModel, pixels: tuple[int, int] = SIZE, hasty: bool = False) -> bytes:
    """What is seen from the viewpoint in the light of the hour, as JPEG; empty where no OpenGL can be had.

    `hasty`: where tiles have not been drawn yet, small ones are drawn instead.
    """
    from PIL import Image

    by = painter()
    if by is None:
        return b""
    scene = model.scene
    if hasty and (small := coarse_tiles(scene.grammar)) is not None:
        scene = replace(scene, grammar=replace(scene.grammar, tiles=small))
    frame = Frame(scene, model.viewpoint.frustum(pixels), Daytime.at(model.hour), pixels, Looks(relief=False))
    with renderer_of(frame.scene, by, tile_bytes=int(model.tile_megabytes * 1e6)) as renderer:
        drawn = renderer.draw(frame)["picture"]
    out = BytesIO()
    Image.fromarray(drawn[..., :3]).save(out, "JPEG", quality=_QUALITY, optimize=True)
    return out.getvalue()


def told(model: TownModel) -> str:
    """What it shows, in words."""
    count = 0 if model.town is None else len(model.town.plan)
    hour, minute = divmod(round(60 * model.hour), 60)
    what = f"A town of {count:,} buildings" if model.town is not None else "Façades"
    return f"{what} at {hour}:{minute:02d}"


def image(model: TownModel, data: bytes) -> str:
    """A picture as HTML; empty if there is none."""
    return picture_html(told(model), data)
