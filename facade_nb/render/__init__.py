"""Drawing a layout: an SVG elevation, a mesh, a picture, files for other programs.

Nothing here needs a GL library, trimesh or Pillow until a mesh or a picture is asked for, nor ezdxf, reportlab, shapely
or pandas until one of the files is.
"""

from .derivation import rules_svg, splits_svg
from .elevation import elevation_svg
from .exchange import (
    obj_files,
    schedule,
    to_cityjson,
    to_dxf,
    to_obj,
    to_pdf,
    to_schedule,
    write_cityjson,
    write_dxf,
    write_obj,
    write_pdf,
    write_schedule,
)
from .exploded import exploded_svg
from .geometry import GEOMETRIES, Geometry
from .materials import MATERIALS
from .mesh import to_glb, write_glb
from .naive import Naive, naive_layout
from .outline import outline_svg
from .overlay import overlay_svg
from .picture import render_png
from .scene import DrawingWarning, Scene, Solid, build_scene, drawing_faults
from .splits import split_grammar
from .texture import Grammar
from .texture.from_layout import grammar_of
from .trying import Move, trying

__all__ = [
    "GEOMETRIES",
    "MATERIALS",
    "DrawingWarning",
    "Geometry",
    "Grammar",
    "Move",
    "Naive",
    "Scene",
    "Solid",
    "build_scene",
    "drawing_faults",
    "elevation_svg",
    "exploded_svg",
    "grammar_of",
    "naive_layout",
    "obj_files",
    "outline_svg",
    "overlay_svg",
    "render_png",
    "rules_svg",
    "schedule",
    "split_grammar",
    "splits_svg",
    "to_cityjson",
    "to_dxf",
    "to_glb",
    "to_obj",
    "to_pdf",
    "to_schedule",
    "trying",
    "write_cityjson",
    "write_dxf",
    "write_glb",
    "write_obj",
    "write_pdf",
    "write_schedule",
]
