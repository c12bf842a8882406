"""The deferred pipeline: meshes whose vertices carry a façade, and the passes that draw them (docs/pipeline.md)."""

from .device import choose_device
from .frame import Frame, Looks
from .gathering import gathered
from .passes import BUFFERS, PASSES, Buffer, Pass, arranged, without
from .renderer import Renderer, renderer_of
from .scene import Scene
from .solids import Solids, solids_of
from .stills import buffers_of, still
from .together import together
from .vertices import VERTEX
from .viewpoint import CameraPath, Frustum, Viewpoint

__all__ = [
    "BUFFERS",
    "PASSES",
    "VERTEX",
    "Buffer",
    "CameraPath",
    "Frame",
    "Frustum",
    "Looks",
    "Pass",
    "Renderer",
    "Scene",
    "Solids",
    "Viewpoint",
    "arranged",
    "buffers_of",
    "choose_device",
    "gathered",
    "renderer_of",
    "solids_of",
    "still",
    "together",
    "without",
]
