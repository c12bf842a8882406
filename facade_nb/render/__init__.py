"""Drawing a layout: an SVG elevation, a mesh, a picture.

Nothing here needs a GL library, trimesh or Pillow until a mesh or a picture is asked for.
"""

from .elevation import elevation_svg
from .exploded import exploded_svg
from .geometry import GEOMETRIES
from .materials import MATERIALS
from .mesh import to_glb, write_glb
from .naive import Naive, naive_layout
from .overlay import overlay_svg
from .picture import render_png
from .scene import Scene, Solid, build_scene
from .splits import split_grammar
from .texture import Grammar
from .texture.from_layout import grammar_of

__all__ = [
    "GEOMETRIES",
    "MATERIALS",
    "Grammar",
    "Naive",
    "Scene",
    "Solid",
    "build_scene",
    "elevation_svg",
    "exploded_svg",
    "grammar_of",
    "naive_layout",
    "overlay_svg",
    "render_png",
    "split_grammar",
    "to_glb",
    "write_glb",
]
