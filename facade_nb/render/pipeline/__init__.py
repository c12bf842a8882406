"""The deferred pipeline: meshes whose vertices carry a façade, and the passes that draw them (docs/pipeline.md)."""

from .device import choose_device
from .frame import Frame, Looks
from .passes import BUFFERS, PASSES, Buffer, Pass, arranged, without
from .renderer import Renderer, renderer_of
from .scene import Scene
from .stills import buffers_of, still
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
    "Viewpoint",
    "arranged",
    "buffers_of",
    "choose_device",
    "renderer_of",
    "still",
    "without",
]
