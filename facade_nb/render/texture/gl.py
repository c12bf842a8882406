"""The GLSL evaluator on this machine: OpenGL 3.3 through moderngl, on OSMesa or EGL, without a screen.

A process keeps one context for each, with its programs; everything else is made for a picture and released with it.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .evaluating import Question, Surface
from .noise import noise_texture
from .osmesa import OSMesaContext, find_osmesa
from .shaders import room, shader
from .shot import Shot, spread
from .view import Looks, Sight

__all__ = ["EGL", "OSMESA", "GlPainter"]


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
    """

    def __init__(self, name: str, missing: Callable[[], str], make: Callable[[], Any]) -> None:
        self.name, self._missing, self._make = name, missing, make
        self._lock = threading.RLock()
        self._programs: dict[tuple[str, int, int, tuple[str, ...]], Any] = {}

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
            return f"{self.name}: no OpenGL 3.3 context can be made ({error}); the backend 'cpu' works everywhere"
        return ""

    @property
    def renderer(self) -> str:
        """What draws, as the driver calls it."""
        return str(self._context.info["GL_RENDERER"])

    def paint(self, question: Question, sight: Sight, *, mips: bool = False, count: bool = False) -> Shot:
        """Every pixel of a view at its centre; with `count`, how many texels each has read."""
        width, height = sight.pixels
        left, bottom, right, top = (np.float32(v) for v in sight.window)
        step_x, step_y = (right - left) / np.float32(width), (top - bottom) / np.float32(height)
        given = {
            "window": (left, bottom, step_x, step_y),
            "pixel_shift": (0.5, 0.5),
            "eye": (*(sight.eye or (0.0, 0.0, 0.0)), float(sight.eye is not None)),
            "spread": 0.0 if sight.eye is None else min(float(step_x), float(step_y)),
            "across": sight.right,
            "forward": sight.ahead,
        }
        defines = (*(("MIPS", "EDGES") if mips else ()), *(("COUNT_FETCHES",) if count else ()))
        with self._drawn(question, "sight.frag", defines, (width, height), given, {}) as images:
            return _shot(question, [image.read() for image in images], (width, height), count, flip=True)

    def paint_at(self, question: Question, looks: Looks, *, mips: bool = False, count: bool = False) -> Shot:
        """Points with their rays; with `count`, how many texels each has read."""
        inside = np.flatnonzero(looks.inside)
        number = len(inside)
        width = min(1024, max(1, number))
        size = (width, max(1, -(-number // width)))
        points, rays = (np.zeros((size[0] * size[1], 4), np.float32) for _ in range(2))
        points[:number, :2] = looks.points[inside]
        points[:number, 2] = looks.footprint[inside] if mips else 0
        rays[:number, :3] = (0, 0, -1) if looks.rays is None else looks.rays[inside]
        given = {"points": points.tobytes(), "rays": rays.tobytes()}
        defines = (*(("MIPS", "EDGES") if mips else ()), *(("COUNT_FETCHES",) if count else ()))
        with self._drawn(question, "points.frag", defines, size, {"spread": looks.spread}, given) as images:
            shot = _shot(question, [image.read() for image in images], size, count, flip=False)
        return spread(shot.first(number), looks.inside)

    @contextmanager
    def _drawn(
        self,
        question: Question,
        name: str,
        defines: tuple[str, ...],
        size: tuple[int, int],
        uniforms: dict[str, Any],
        data: dict[str, bytes],
    ) -> Iterator[list[Any]]:
        """The images that a shader draws: colour, normal, specular, numbers. They end with the context."""
        with self._lock, self._context as context, ExitStack() as kept:
            most = context.info["GL_MAX_TEXTURE_SIZE"]
            if max(size) > most:
                raise ValueError(f"pixels: {self.name} draws at most {most} across and up; found {size}")
            program = self._program(name, question, defines)

            def keep(made: Any) -> Any:
                kept.callback(made.release)
                return made

            textures = [
                *_textures(question),
                *((key, size, 4, "f4", content) for key, content in data.items()),
            ]
            for unit, (key, shape, channels, kind, content) in enumerate(textures):
                texture = keep(context.texture(shape, channels, content, dtype=kind, alignment=1))
                texture.filter = (context.NEAREST, context.NEAREST)
                texture.use(unit)
                if key in program:
                    program[key].value = unit
            for key, value in {**_uniforms(question), **uniforms}.items():
                if key in program:
                    program[key].value = value
            images = [keep(context.texture(size, 4, dtype=kind)) for kind in ("f4", "f4", "f4", "i4")]
            target = keep(context.framebuffer(images))
            array = keep(context.vertex_array(program, []))
            target.use()
            target.viewport = (0, 0, *size)
            array.render(context.TRIANGLES, vertices=3)
            yield images

    def _program(self, name: str, question: Question, defines: tuple[str, ...]) -> Any:
        frames, seeds = map(room, question.stacks)
        key = (name, frames, seeds, defines)
        if key not in self._programs:
            fragment = shader(name, frames=frames, seeds=seeds, defines=defines)
            self._programs[key] = self._context.program(
                vertex_shader=shader("whole.vert"), fragment_shader=fragment
            )
        return self._programs[key]

    @cached_property
    def _context(self) -> Any:
        return self._make()


def _textures(question: Question) -> Iterator[tuple[str, tuple[int, int], int, str, bytes]]:
    """Name, size, channels, kind and content of what the evaluator reads."""
    grammar, atlas = question.texture, question.atlas
    half = grammar.dtype == np.float16
    yield "grammar", grammar.shape[1::-1], 4, "f2" if half else "f4", grammar.tobytes()
    noise = noise_texture()
    yield "noise", noise.shape[1::-1], 1, "f4", noise.tobytes()
    yield "atlas", atlas.pixels.shape[1::-1], 4, "f1", atlas.pixels.tobytes()
    table = np.zeros((len(atlas.table), atlas.table.shape[1] + 1, 4), np.float32)
    table[:, 1:] = atlas.table
    table[:, 0, 0] = atlas.grey
    yield "tile_table", table.shape[1::-1], 4, "f4", table.tobytes()


def _uniforms(question: Question) -> dict[str, Any]:
    seed = question.seed
    return {
        "grammar_width": question.texture.shape[1],
        "facade_size": question.size,
        "start_rule": question.records[question.start].place,
        "seed_whole": tuple(value % 2**32 for value in seed.whole),
        "seed_rest": seed.rest,
    }


def _shot(question: Question, images: list[bytes], size: tuple[int, int], count: bool, flip: bool) -> Shot:
    """Pixels read back; with `flip`, rows from the top."""

    def of(content: bytes, kind: Any) -> NDArray[Any]:
        values = np.frombuffer(content, kind).reshape(size[1], size[0], 4)
        return np.ascontiguousarray(values[::-1] if flip else values).reshape(-1, 4)

    color, normal, specular = (of(content, np.float32) for content in images[:3])
    numbers = of(images[3], np.int32)
    width = question.texture.shape[1]
    rules = np.full(question.texture.shape[0] * width + 1, -1, np.int32)  # the last one is for none
    for i, record in enumerate(question.records):
        rules[record.place[1] * width + record.place[0]] = i
    margin = np.ascontiguousarray(numbers[:, 2]).view(np.float32)
    return Shot(
        Surface(color, normal, specular, rules[numbers[:, 0]]), margin, numbers[:, 1] if count else None
    )


# Platforms --------------------------------------------------------------------------------------------------


def _no_osmesa() -> str:
    if not sys.platform.startswith("linux"):
        return f"works on Linux only, and this is {sys.platform}; the backend 'cpu' works everywhere"
    if find_osmesa() is None:
        install = "sudo apt-get install --no-install-recommends libosmesa6 libgl1"
        return f"no OSMesa found; on Debian or Ubuntu: {install}"
    return ""


def _make_osmesa() -> Any:
    import moderngl

    context: Any = OSMesaContext()
    return moderngl.create_context(require=330, context=context)


def _no_egl() -> str:
    if not sys.platform.startswith("linux"):
        return f"works on Linux only, and this is {sys.platform}; the backend 'cpu' works everywhere"
    name = ctypes.util.find_library("EGL")
    try:
        if name is None:
            raise OSError
        ctypes.CDLL(name)
    except OSError:
        return "no EGL found; on Debian or Ubuntu: sudo apt-get install --no-install-recommends libegl1 libgl1-mesa-dri"
    return ""


def _make_egl() -> Any:
    import moderngl

    options: dict[str, Any] = {"backend": "egl", "libgl": "libGL.so.1", "libegl": "libEGL.so.1"}
    return moderngl.create_context(standalone=True, require=330, **options)


OSMESA = GlPainter("osmesa", _no_osmesa, _make_osmesa)
EGL = GlPainter("egl", _no_egl, _make_egl)
