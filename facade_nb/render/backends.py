"""Where triangles become pixels: OSMesa, EGL, or NumPy alone.

A picture needs little of a renderer: which triangle is seen at each pixel, and how deep. Everything else (light,
shadow, materials) is worked out from that in `shading`. So every backend gives the same picture, and one without any
graphics library is always there.
"""

from __future__ import annotations

import ctypes.util
import os
import sys
import threading
import types
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..design.errors import FacadeError, nearest

__all__ = ["BACKENDS", "Backend", "BackendError", "Canvas3D", "choose_backend"]


class BackendError(FacadeError, RuntimeError):
    """A backend that was asked for cannot be used here; the text says what would help."""


class Canvas3D(Protocol):
    """Triangles that are ready to be drawn."""

    def draw(self, matrix: NDArray[np.float64]) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
        """Seen through `matrix` (4, 4), from the world to OpenGL's clip space: per pixel the triangle, and its depth.

        Returns
        -------
        index
            (h, w) int32, -1 where there is none; row 0 is at the top.
        depth
            (h, w) float32, from 0 (near) to 1 (far, and where there is nothing).
        """
        ...

    def depth(self, matrix: NDArray[np.float64]) -> NDArray[np.float32]:
        """The depth alone."""
        ...


class Backend(Protocol):
    """A way to draw triangles."""

    name: str

    @property
    def why_not(self) -> str:
        """Why it cannot be used here and the command that would help; empty if it can."""
        ...

    @property
    def available(self) -> bool:
        """Whether it can be used here."""
        ...

    def open(self, positions: NDArray[np.float32], size: tuple[int, int]) -> Any:
        """A context manager of a `Canvas3D` of `size` (width, height) pixels for triangles (t, 3, 3)."""
        ...


class _Pyrender:
    """pyrender, on one of the platforms of PyOpenGL. A process can use only one of them."""

    _lock = threading.Lock()

    def __init__(self, name: str, libraries: tuple[str, ...], package: str) -> None:
        self.name, self._libraries, self._package = name, libraries, package

    @property
    def available(self) -> bool:
        return not self.why_not

    @property
    def why_not(self) -> str:
        if not sys.platform.startswith("linux"):
            return f"{self.name}: works on Linux only, and this is {sys.platform}; the backend 'cpu' works everywhere"
        if not any(_loads(library) for library in self._libraries):
            return (
                f"{self.name}: no {self._libraries[0]} found; on Debian or Ubuntu: "
                f"sudo apt-get install --no-install-recommends {self._package}"
            )
        try:
            from importlib.util import find_spec

            missing = [name for name in ("OpenGL", "pyrender") if find_spec(name) is None]
        except ValueError:
            missing = ["pyrender"]
        if missing:
            return f"{self.name}: {' and '.join(missing)} not installed; run: pip install pyrender2 'PyOpenGL>=3.1.9'"
        other = os.environ.get("PYOPENGL_PLATFORM")
        if "OpenGL" in sys.modules and other != self.name:
            return (
                f"{self.name}: this process already uses OpenGL on {other or 'the screen'}; "
                f"restart it with PYOPENGL_PLATFORM={self.name} set"
            )
        return ""

    @contextmanager
    def open(self, positions: NDArray[np.float32], size: tuple[int, int]) -> Iterator[Canvas3D]:
        with self._lock:
            canvas = _PyrenderCanvas(self.name, positions, size)
            try:
                yield canvas
            finally:
                canvas.close()


_KEPT: dict[str, Any] = {}  # deleting an EGL renderer ends EGL for the whole process, so that one is kept


class _PyrenderCanvas:
    _near, _far = 1.0, 3.0  # what pyrender makes of the depth buffer with these is undone in `_unmade`

    def __init__(self, platform: str, positions: NDArray[np.float32], size: tuple[int, int]) -> None:
        pyrender = _import_pyrender(platform)
        self._flags, self._depth_only = pyrender.RenderFlags.FLAT, pyrender.RenderFlags.DEPTH_ONLY
        count = len(positions)
        code = np.arange(1, count + 1, dtype=np.uint32)
        colours = np.stack([code & 255, code >> 8 & 255, code >> 16 & 255, np.full(count, 255)], 1) / 255.0
        primitive = pyrender.Primitive(
            positions=positions.reshape(-1, 3),
            color_0=np.repeat(colours, 3, axis=0).astype(np.float32),
            material=pyrender.MetallicRoughnessMaterial(
                baseColorFactor=(1.0, 1.0, 1.0, 1.0), doubleSided=True
            ),
        )
        self._camera = _camera_class(pyrender)(self._near, self._far)
        self._scene = pyrender.Scene(bg_color=(0, 0, 0, 0))
        if count:
            self._scene.add(pyrender.Mesh([primitive]))
        self._scene.add(self._camera, pose=np.eye(4))
        kept = _KEPT.get(platform)
        if kept is not None:
            kept.viewport_width, kept.viewport_height = size
            self._renderer = kept
        else:
            self._renderer = _renderer_class(pyrender)(*size)
            if platform == "egl":
                _KEPT[platform] = self._renderer
        self._owned = platform != "egl"

    def draw(self, matrix: NDArray[np.float64]) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
        self._camera.matrix = np.asarray(matrix, np.float64)
        colour, linear = self._renderer.render(self._scene, flags=self._flags)
        code = colour.astype(np.int32)
        return code[..., 0] + (code[..., 1] << 8) + (code[..., 2] << 16) - 1, self._unmade(linear)

    def depth(self, matrix: NDArray[np.float64]) -> NDArray[np.float32]:
        self._camera.matrix = np.asarray(matrix, np.float64)
        return self._unmade(self._renderer.render(self._scene, flags=self._flags | self._depth_only))

    def _unmade(self, linear: NDArray[np.float32]) -> NDArray[np.float32]:
        n, f = np.float32(self._near), np.float32(self._far)
        with np.errstate(divide="ignore"):
            return np.where(
                linear > 0, ((f + n) - 2 * n * f / linear) / (2 * (f - n)) + np.float32(0.5), np.float32(1)
            )

    def close(self) -> None:
        if self._owned:
            self._renderer.delete()


def _import_pyrender(platform: str) -> Any:
    os.environ["PYOPENGL_PLATFORM"] = platform
    if (
        "pyrender.viewer" not in sys.modules
    ):  # the window would need pyglet and a display; nothing here opens one
        stub = types.ModuleType("pyrender.viewer")
        stub.__dict__["Viewer"] = type("Viewer", (), {})
        sys.modules["pyrender.viewer"] = stub
    import pyrender

    return pyrender


def _camera_class(pyrender: Any) -> Any:
    class MatrixCamera(pyrender.Camera):
        """A camera that is given as one matrix, its pose included."""

        matrix = np.eye(4)

        def __init__(self, near: float, far: float) -> None:
            super().__init__(znear=near, zfar=far)

        def get_projection_matrix(
            self, width: int | None = None, height: int | None = None
        ) -> NDArray[np.float64]:
            return self.matrix

    return MatrixCamera


def _renderer_class(pyrender: Any) -> Any:
    from OpenGL import GL as gl
    from pyrender.offscreen import OffscreenRenderer
    from pyrender.renderer import Renderer

    class Sharp(Renderer):
        """Draws without antialiasing into its framebuffer: the mean of two triangles' numbers is a third triangle."""

        _main_fb: Any
        _main_fb_dims: Any

        def _configure_main_framebuffer(self) -> None:
            if self._main_fb is not None and self._main_fb_dims == (
                self.viewport_width,
                self.viewport_height,
            ):
                return
            self._delete_main_framebuffer()
            w, h = self.viewport_width, self.viewport_height
            colours, depths, frames = (
                gl.glGenRenderbuffers(2),
                gl.glGenRenderbuffers(2),
                gl.glGenFramebuffers(2),
            )
            for colour, depth, frame in zip(colours, depths, frames, strict=True):
                gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, colour)
                gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_RGBA8, w, h)
                gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, depth)
                gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH_COMPONENT24, w, h)
                gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, frame)
                gl.glFramebufferRenderbuffer(
                    gl.GL_DRAW_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_RENDERBUFFER, colour
                )
                gl.glFramebufferRenderbuffer(
                    gl.GL_DRAW_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_RENDERBUFFER, depth
                )
            (self._main_cb, self._main_cb_ms), (self._main_db, self._main_db_ms) = colours, depths
            self._main_fb, self._main_fb_ms = frames
            self._main_fb_dims = (w, h)

    class Offscreen(OffscreenRenderer):
        def _create(self) -> None:
            super()._create()
            self._renderer = Sharp(self.viewport_width, self.viewport_height)

    return Offscreen


def _loads(library: str) -> bool:
    name = ctypes.util.find_library(library)
    if name is None:
        return False
    try:
        ctypes.CDLL(name)
    except OSError:
        return False
    return True


class _Cpu:
    """NumPy alone: slower than the others, and always there."""

    name = "cpu"
    why_not = ""
    available = True

    @contextmanager
    def open(self, positions: NDArray[np.float32], size: tuple[int, int]) -> Iterator[Canvas3D]:
        yield _CpuCanvas(positions, size)


class _CpuCanvas:
    def __init__(self, positions: NDArray[np.float32], size: tuple[int, int]) -> None:
        self._points = np.concatenate(
            [positions, np.ones((*positions.shape[:2], 1))], axis=2, dtype=np.float64
        )
        self._size = size

    def draw(self, matrix: NDArray[np.float64]) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
        width, height = self._size
        index = np.full((height, width), -1, np.int32)
        depth = np.ones((height, width))
        clip = self._points @ np.asarray(matrix, np.float64).T
        ahead = (clip[:, :, 3] > 1e-6).all(axis=1)  # what reaches behind the camera is left out
        with np.errstate(divide="ignore", invalid="ignore"):
            spot = clip[:, :, :3] / clip[:, :, 3:]
        x, y, z = (
            (spot[:, :, 0] + 1) / 2 * width - 0.5,
            (1 - spot[:, :, 1]) / 2 * height - 0.5,
            (spot[:, :, 2] + 1) / 2,
        )
        low_x, high_x = np.ceil(np.clip(x.min(1), 0, width)), np.floor(np.clip(x.max(1), -1, width - 1))
        low_y, high_y = np.ceil(np.clip(y.min(1), 0, height)), np.floor(np.clip(y.max(1), -1, height - 1))
        twice = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (y[:, 1] - y[:, 0]) * (x[:, 2] - x[:, 0])
        seen = ahead & (low_x <= high_x) & (low_y <= high_y) & (np.abs(twice) > 1e-12)
        for k in np.flatnonzero(seen):
            x0, x1, y0, y1 = int(low_x[k]), int(high_x[k]) + 1, int(low_y[k]), int(high_y[k]) + 1
            px, py = np.arange(x0, x1)[None, :], np.arange(y0, y1)[:, None]
            (ax, bx, cx), (ay, by, cy), (az, bz, cz) = x[k], y[k], z[k]
            b = ((px - ax) * (cy - ay) - (py - ay) * (cx - ax)) / twice[k]
            c = ((py - ay) * (bx - ax) - (px - ax) * (by - ay)) / twice[k]
            deep = az + b * (bz - az) + c * (cz - az)  # linear on the screen, also in perspective
            field = depth[y0:y1, x0:x1]
            hit = (b >= 0) & (c >= 0) & (b + c <= 1) & (deep < field) & (deep >= 0)
            field[hit] = deep[hit]
            index[y0:y1, x0:x1][hit] = k
        return index, depth.astype(np.float32)

    def depth(self, matrix: NDArray[np.float64]) -> NDArray[np.float32]:
        return self.draw(matrix)[1]


BACKENDS: dict[str, Backend] = {
    "osmesa": _Pyrender("osmesa", ("OSMesa",), "libosmesa6 libgl1"),
    "egl": _Pyrender("egl", ("EGL",), "libegl1 libgl1-mesa-dri"),
    "cpu": _Cpu(),
}
"""The backends by name, the preferred one first."""


def choose_backend(name: str | None = None) -> Backend:
    """The backend of that name, or the first that works here.

    Raises
    ------
    ValueError
        For an unknown name.
    BackendError
        If the one asked for cannot be used here.
    """
    if name is None:
        return next(backend for backend in BACKENDS.values() if backend.available)
    if name not in BACKENDS:
        raise ValueError(
            f"backend: expected one of {', '.join(BACKENDS)}; found {name!r}{nearest(name, BACKENDS)}"
        )
    reason = BACKENDS[name].why_not
    if reason:
        raise BackendError(reason)
    return BACKENDS[name]
