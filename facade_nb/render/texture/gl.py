"""The GLSL evaluator on this machine: OpenGL 3.3 through moderngl, on OSMesa or EGL, without a screen.

A process keeps one context for each, with its programs and the tiles used last; everything else is made for a picture
and released with it.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .atlas import Atlas
from .osmesa import OSMesaContext, find_osmesa
from .question import Question, Surface
from .shaders import room, rooms_for, shader
from .shot import Shot, spread
from .uploads import Upload, grammar_upload, tile_uploads, uniforms
from .view import Looks, Sight

__all__ = ["EGL", "OSMESA", "GlPainter"]

_ATLASES = 2
"""How many sets of tiles are kept on the card."""


class GlPainter:
    """A painter on OpenGL.

    Parameters
    ----------
    name
        By which it is chosen.
    missing
        Says why there can be no context here; empty where there may be one.
    make
        Makes one: a `moderngl.Context`.
    install
        The command that installs what it needs on Debian or Ubuntu.
    """

    def __init__(self, name: str, missing: Callable[[], str], make: Callable[[], Any], install: str) -> None:
        self.name, self._missing, self._make, self._install = name, missing, make, install
        self._lock = threading.RLock()
        self._entered = 0
        self._atlases: dict[int, tuple[Atlas, dict[str, Any]]] = {}
        self._programs: dict[tuple[str, str], Any] = {}

    @property
    def available(self) -> bool:
        """Whether it can be used here."""
        return not self.why_not

    @cached_property
    def why_not(self) -> str:
        """Why it cannot be used here and the command that would help; empty if it can."""
        problem = self._missing()
        if problem:
            return f"{self.name}: {problem}"
        try:
            import moderngl  # noqa: F401
        except ImportError:
            return f"{self.name}: moderngl is not installed; run: pip install moderngl"
        try:
            with self._lock:
                self._context  # noqa: B018 (made here)
        except Exception as error:
            return (
                f"{self.name}: no OpenGL 3.3 context can be made ({error}); a driver may be missing; on Debian or "
                f"Ubuntu: {self._install}"
            )
        return ""

    @contextmanager
    def entered(self) -> Iterator[Any]:
        """Its `moderngl.Context`, for this thread alone until the block ends; blocks may lie inside each other."""
        with self._lock, ExitStack() as kept:
            if not self._entered:
                kept.enter_context(self._context)
            self._entered += 1
            kept.callback(self._leave)
            yield self._context

    def _leave(self) -> None:
        self._entered -= 1

    @property
    def renderer(self) -> str:
        """What draws, as the driver calls it."""
        with self.entered() as context:
            return str(context.info["GL_RENDERER"])

    def paint(
        self,
        question: Question,
        sight: Sight,
        *,
        mips: bool = False,
        color_only: bool = False,
        count: bool = False,
    ) -> Shot:
        """Every pixel of a view at its centre; with `count`, how many texels each has read."""
        return self.paint_at(question, sight.looks(), mips=mips, color_only=color_only, count=count)

    def paint_at(
        self,
        question: Question,
        looks: Looks,
        *,
        mips: bool = False,
        color_only: bool = False,
        count: bool = False,
    ) -> Shot:
        """Points with their rays; with `count`, how many texels each has read."""
        inside = np.flatnonzero(looks.inside)
        number = len(inside)
        width = min(1024 if number < 1 << 22 else 4096, max(1, number))
        size = (width, max(1, -(-number // width)))
        points, rays = (np.zeros((size[0] * size[1], 4), np.float32) for _ in range(2))
        points[:number, :2] = looks.points[inside]
        points[:number, 2] = looks.footprint[inside] if mips else 0
        rays[:number, :3] = (0, 0, -1) if looks.rays is None else looks.rays[inside]
        data = [
            Upload(name, size, 4, "f4", array.tobytes())
            for name, array in (("points", points), ("rays", rays))
        ]
        defines = _defines(mips, color_only, count, question.relief)
        with self._drawn(question, defines, size, {"spread": looks.spread}, data) as images:
            shot = _shot(question, _read(images, color_only), size, count)
        return spread(shot.first(number), looks.inside)

    @contextmanager
    def _drawn(
        self,
        question: Question,
        defines: tuple[str, ...],
        size: tuple[int, int],
        given: dict[str, Any],
        data: Sequence[Upload],
    ) -> Iterator[list[Any]]:
        """The images that a shader draws: colour, normal, specular, numbers. They end with the context."""
        with self.entered() as context, ExitStack() as kept:
            most = context.info["GL_MAX_TEXTURE_SIZE"]
            if max(size) > most:
                raise ValueError(f"pixels: {self.name} draws at most {most} across and up; found {size}")
            program = self._program("points.frag", question, defines)

            def keep(made: Any) -> Any:
                kept.callback(made.release)
                return made

            grammar = grammar_upload(question, wide="llvmpipe" in self.renderer)
            own = {upload.name: keep(_texture(context, upload)) for upload in (grammar, *data)}
            for unit, (key, texture) in enumerate({**self.tiles(question.atlas), **own}.items()):
                texture.use(unit)
                if key in program:
                    program[key].value = unit
            for key, value in {**uniforms(question), **given}.items():
                if key in program:
                    program[key].value = value
            numbers = 4 if {"EDGES", "COUNT_FETCHES", "RELIEF"} & set(defines) else 1  # or the rule alone
            layout = ((4, "f4"), (4, "f4"), (4, "f4"), (numbers, "i4"))
            images = [keep(context.texture(size, count, dtype=kind)) for count, kind in layout]
            target = keep(context.framebuffer(images))
            array = keep(context.vertex_array(program, []))
            target.use()
            target.viewport = (0, 0, *size)
            array.render(context.TRIANGLES, vertices=3)
            yield images

    def tiles(self, atlas: Atlas) -> dict[str, Any]:
        """Textures of the noise and the tiles, kept for the atlases that were used last; within `entered`."""
        kept = self._atlases.pop(id(atlas), None)
        if kept is None:
            kept = (atlas, {upload.name: _texture(self._context, upload) for upload in tile_uploads(atlas)})
        self._atlases[id(atlas)] = kept  # the last one used stands last
        while len(self._atlases) > _ATLASES:
            _, old = self._atlases.pop(next(iter(self._atlases)))
            for texture in old.values():
                texture.release()
        return kept[1]

    def _program(self, name: str, question: Question, defines: tuple[str, ...]) -> Any:
        frames, seeds = map(room, question.stacks)
        rooms = rooms_for(question.rooms)
        bits = question.texture.dtype.itemsize * 8
        fragment = shader(name, frames=frames, seeds=seeds, rooms=rooms, bits=bits, defines=defines)
        return self.program(shader("whole.vert"), fragment)

    def program(self, vertex: str, fragment: str) -> Any:
        """The program of two sources, kept as long as the process. To be asked for within `entered`."""
        key = (vertex, fragment)
        if key not in self._programs:
            self._programs[key] = self._context.program(vertex_shader=vertex, fragment_shader=fragment)
        return self._programs[key]

    @cached_property
    def _context(self) -> Any:
        return self._make()


def _texture(context: Any, upload: Upload) -> Any:
    texture = context.texture(upload.size, upload.channels, upload.content, dtype=upload.kind, alignment=1)
    texture.filter = (context.NEAREST, context.NEAREST)
    texture.repeat_x = texture.repeat_y = False
    return texture


def _defines(mips: bool, color_only: bool, count: bool, relief: bool) -> tuple[str, ...]:
    wanted = {"MIPS": mips, "EDGES": mips, "COLOR_ONLY": color_only, "COUNT_FETCHES": count, "RELIEF": relief}
    return tuple(name for name, on in wanted.items() if on)


def _read(images: Sequence[Any], color_only: bool) -> list[bytes | None]:
    """The images' bytes; None for those that hold nothing."""
    return [None if color_only and k in (1, 2) else image.read() for k, image in enumerate(images)]


def _shot(question: Question, images: list[bytes | None], size: tuple[int, int], count: bool) -> Shot:
    """Pixels read back."""

    def of(content: bytes | None, kind: Any) -> NDArray[Any]:
        if content is None:
            return np.zeros((size[0] * size[1], 4), kind)
        return np.frombuffer(content, kind).reshape(size[0] * size[1], -1)

    color, normal, specular = (of(content, np.float32) for content in images[:3])
    numbers = of(images[3], np.int32)
    width = question.texture.shape[1]
    rules = np.full(question.texture.shape[0] * width + 1, -1, np.int32)  # the last one is for none
    for i, record in enumerate(question.records):
        rules[record.place[1] * width + record.place[0]] = i
    margin = np.zeros(len(numbers), np.float32)
    if numbers.shape[1] > 1:
        margin = np.ascontiguousarray(numbers[:, 2]).view(np.float32)
    shade = np.ascontiguousarray(numbers[:, 3]).view(np.float32) if question.relief else None
    surface = Surface(color, normal, specular, rules[numbers[:, 0]])
    return Shot(surface, margin, numbers[:, 1] if count else None, shade)


# Platforms --------------------------------------------------------------------------------------------------


_INSTALL_OSMESA = "sudo apt-get install --no-install-recommends libosmesa6 libgl1"
_INSTALL_EGL = "sudo apt-get install --no-install-recommends libegl1 libgl1-mesa-dri"


def _no_osmesa() -> str:
    if not sys.platform.startswith("linux"):
        return f"works on Linux only, and this is {sys.platform}"
    if find_osmesa() is None:
        return f"no OSMesa found; on Debian or Ubuntu: {_INSTALL_OSMESA}"
    return ""


def _make_osmesa() -> Any:
    import moderngl

    context: Any = OSMesaContext()
    return moderngl.create_context(require=330, context=context)


def _no_egl() -> str:
    if not sys.platform.startswith("linux"):
        return f"works on Linux only, and this is {sys.platform}"
    name = ctypes.util.find_library("EGL")
    try:
        if name is None:
            raise OSError
        ctypes.CDLL(name)
    except OSError:
        return f"no EGL found; on Debian or Ubuntu: {_INSTALL_EGL}"
    return ""


def _make_egl() -> Any:
    import moderngl

    options: dict[str, Any] = {"backend": "egl", "libgl": "libGL.so.1", "libegl": "libEGL.so.1"}
    context = moderngl.create_context(standalone=True, require=330, **options)
    # From now on EGL takes it for the current one, also when OSMesa has taken its place, and then `entered` would bind
    # nothing: what is drawn would go to OSMesa's context. Once left, it is bound anew each time.
    with context:
        pass
    return context


OSMESA = GlPainter("osmesa", _no_osmesa, _make_osmesa, _INSTALL_OSMESA)
EGL = GlPainter("egl", _no_egl, _make_egl, _INSTALL_EGL)
