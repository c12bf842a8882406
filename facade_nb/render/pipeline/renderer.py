"""Runs the passes with OpenGL, offscreen: OSMesa or EGL."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..texture.atlas import Atlas
from ..texture.gl import GlPainter
from ..texture.shaders import room, rooms_for, shader
from ..texture.uploads import Upload, grammar_upload
from .frame import Frame, in_view, runs_of
from .hidden import hidden, nearest_first
from .passes import BUFFERS, PASSES, Buffer, Pass, arranged, emptied, shared
from .scene import Scene
from .vertices import VERTEX

__all__ = ["TILE_BYTES", "Renderer", "renderer_of"]

TILE_BYTES = 64 << 20
"""What tiles may take of the card, in one image."""

_FORMAT = "3f 2f 2f 2f 2f 3f 3f"
_KINDS = {"f1": np.uint8, "f2": np.float16, "f4": np.float32, "i4": np.int32, "depth": np.float32}


class Renderer:
    """A scene on the graphics card, and the passes that draw it. Made by `renderer_of`; one thread at a time.

    Parameters
    ----------
    scene
        What is drawn.
    painter
        Whose context draws.
    passes, buffers
        The pipeline.
    tile_bytes
        What tiles may take of the card: where they take more, the largest sizes are left out.
    """

    def __init__(
        self,
        scene: Scene,
        painter: GlPainter,
        passes: Sequence[Pass] = PASSES,
        buffers: Sequence[Buffer] = BUFFERS,
        tile_bytes: int = TILE_BYTES,
    ) -> None:
        self._tile_bytes = tile_bytes
        self.scene, self.painter = scene, painter
        self.passes, self.buffers = arranged(passes, buffers), {own.name: own for own in buffers}
        self._kept = ExitStack()
        self._sized = ExitStack()
        self._pixels = (0, 0)
        self._whole: frozenset[str] = frozenset()  # buffers that share no image with a later one
        self._images: dict[str, Any] = {}
        self._targets: dict[str, Any] = {}
        self._programs: dict[tuple[str, ...], Any] = {}
        self._given: dict[
            tuple[str, ...], frozenset[str]
        ] = {}  # what each program asks for: to list it takes long
        self._meshes: dict[tuple[str, ...], Any] = {}
        self._tiles: dict[str, Any] = {}  # the painter's
        self._atlases: dict[bool, Atlas] = {}
        self._held: dict[str, Any] = {}
        self._maps: dict[str, bytes] = {}
        self._software = "llvmpipe" in painter.renderer
        self._hidden = np.zeros(len(scene.chunks), bool)  # from the camera, for passes that add to it
        self._empty: set[str] = set()  # passes that others come after, and that have drawn nothing
        with painter.entered() as context:
            self._context = context
            self._load()

    def _keep(self, made: Any) -> Any:
        self._kept.callback(made.release)
        return made

    def _load(self) -> None:
        context, question = self._context, self.scene.question
        self._vertices = self._keep(context.buffer(self.scene.vertices.tobytes() or bytes(VERTEX.itemsize)))
        self._indices = self._keep(context.buffer(self.scene.indices.tobytes() or bytes(12)))
        self._hold(grammar_upload(question, wide="llvmpipe" in self.painter.renderer))
        for upload in self.scene.uploads:
            self._hold(upload)
        self._asked = {own.after for own in self.passes if own.after}
        for own in self.passes:
            if not own.options:
                self._make((own.name,), own)

    def _hold(self, upload: Upload) -> None:
        """Give the card a texture, in the place of one of that name."""
        if upload.name in self._held:
            self._held[upload.name].release()
        context = self._context
        image = context.texture(upload.size, upload.channels, upload.content, dtype=upload.kind, alignment=1)
        image.filter = (context.NEAREST, context.NEAREST)
        image.repeat_x = image.repeat_y = False
        self._held[upload.name] = self._keep(image)

    def _fitted(self, relief: bool) -> Atlas:
        """The tiles as far as they fit; with their heights where relief is asked for."""
        if relief not in self._atlases:
            question = self.scene.relief_question if relief else self.scene.question
            most = self._context.info["GL_MAX_TEXTURE_SIZE"]
            self._atlases[relief] = question.atlas.within(self._tile_bytes, most)
        return self._atlases[relief]

    def _make(self, key: tuple[str, ...], own: Pass) -> None:
        """The program of a pass, with what it draws; the key is its name and its options."""
        context, question = self._context, self.scene.question
        frames, seeds = map(room, question.stacks)
        rooms = rooms_for(question.rooms)
        bits = question.texture.dtype.itemsize * 8
        defines = (*own.defines, *self.scene.defines, *(name.upper() for name in key[1:]))
        fragment = shader(own.fragment, frames=frames, seeds=seeds, rooms=rooms, bits=bits, defines=defines)
        program = self.painter.program(shader(own.vertex), fragment)
        self._programs[key] = program
        self._given[key] = frozenset(program)
        if own.draws == "mesh":
            content = _content(program)
            array = context.vertex_array(
                program, [(self._vertices, *content)], self._indices, skip_errors=True
            )
        else:
            array = context.vertex_array(program, [])
        self._meshes[key] = self._keep(array)

    def close(self) -> None:
        """Give back what it holds of the card."""
        with self.painter.entered():
            self._sized.close()
            self._kept.close()

    def draw(
        self,
        frame: Frame,
        wanted: Sequence[str] = ("picture",),
        told: Callable[[str, float], None] | None = None,
    ) -> dict[str, NDArray[Any]]:
        """Run the passes, and read buffers back: each (h, w, channels), row 0 at the top.

        Parameters
        ----------
        wanted
            Names of buffers. One that no pass has written, because it was left out, is not in the answer.
        told
            Called after each pass with its name and its seconds; the pipeline then waits for each.

        Raises
        ------
        ValueError
            For pictures larger than the card can draw.
        """
        with self.painter.entered() as context:
            most = context.info["GL_MAX_TEXTURE_SIZE"]
            if max(frame.pixels) > most or min(frame.pixels) < 1:
                raise ValueError(f"pixels: expected from 1 to {most} across and up; found {frame.pixels}")
            self._make_room(frame.pixels, frozenset(wanted))
            self._tiles = self.painter.tiles(self._fitted(frame.looks.relief))
            uniforms = frame.uniforms()
            written: set[str] = set()
            self._empty.clear()
            for own in self.passes:
                if not frame.runs(own.when) or own.after in self._empty:
                    self._empty.add(own.name)
                    continue
                begin = time.perf_counter()
                if not self._unchanged(own, uniforms):
                    self._run(own, uniforms, frame)
                written.update(own.writes)
                if told is not None:
                    context.finish()
                    told(own.name, time.perf_counter() - begin)
            return {name: self._read(name) for name in wanted if name in written}

    def _unchanged(self, own: Pass, uniforms: dict[str, Any]) -> bool:
        """Whether a map of shadows or lamps is still that of the last picture: it depends on its matrix alone."""
        if own.draws != "mesh" or not own.through.startswith(("sun", "above")):
            return False
        matrix = uniforms[own.through].tobytes()
        same = self._maps.get(own.name) == matrix
        self._maps[own.name] = matrix
        return same

    def _run(self, own: Pass, uniforms: dict[str, Any], frame: Frame) -> None:
        key = (own.name, *(name for name in own.options if frame.runs(name)))
        if key not in self._programs:
            self._make(key, own)
        context, program, mesh = self._context, self._programs[key], self._meshes[key]
        asks = self._given[key]
        target = self._targets[own.name]
        target.use()
        target.viewport = (0, 0, *target.size)
        for unit, (name, image) in enumerate(
            {**self._tiles, **self._held, **{n: self._images[n] for n in own.reads}}.items()
        ):
            if name in asks:
                image.use(unit)
                program[name].value = unit
        given = {**uniforms, "from_world": uniforms[own.through]} if own.through else uniforms
        for name, value in given.items():
            if name in asks:
                if isinstance(value, np.ndarray):
                    program[name].write(np.ascontiguousarray(value.T, np.float32).tobytes())
                else:
                    program[name].value = value
        if own.draws == "mesh":
            if not own.adds:
                self._empty_images(own, frame)
            context.enable(
                (context.BLEND if own.sums else context.DEPTH_TEST) | (0 if own.both else context.CULL_FACE)
            )
            context.blend_func = context.ONE, context.ONE
            context.front_face, context.cull_face = "ccw", "back"
            self._draw_mesh(own, mesh, uniforms)
            if own.name in self._asked and not self._drew(own):
                self._empty.add(own.name)
            context.disable(context.DEPTH_TEST | context.CULL_FACE | context.BLEND)
        else:
            if own.under:
                context.enable(context.BLEND)
                context.blend_func = context.ONE_MINUS_DST_ALPHA, context.ONE
            elif own.seen and not own.sky:
                self._empty_images(own, frame)
            if own.seen:  # the screen lies as far away as can be
                context.enable(context.DEPTH_TEST)
                context.depth_func = "<=" if own.sky else ">"
            mesh.render(context.TRIANGLES, vertices=3)
            context.depth_func = "<"
            context.disable(context.BLEND | context.DEPTH_TEST)

    def _empty_images(self, own: Pass, frame: Frame) -> None:
        """Empty what a pass draws into, as far as that is read where it draws nothing."""
        target = self._targets[own.name]
        needed = emptied(own, [one for one in self.passes if frame.runs(one.when)], self._whole)
        colours = [name for name in own.writes if self.buffers[name].kind != "depth"]
        masks = [(name in needed,) * 4 for name in colours]
        if masks:
            target.color_mask = masks[0] if len(masks) == 1 else tuple(masks)
        target.clear(depth=1.0)
        if masks:
            target.color_mask = (True,) * 4 if len(masks) == 1 else ((True,) * 4,) * len(masks)
            target.use()  # only then does the mask hold

    def _draw_mesh(self, own: Pass, mesh: Any, uniforms: dict[str, Any]) -> None:
        """Draw the chunks that are in view; where software draws, only those that are not hidden all over."""
        through, chunks = uniforms[own.through], self.scene.chunks
        seen = in_view(self.scene, through, own.turning)
        depth = next((name for name in own.writes if self.buffers[name].kind == "depth"), "")
        spares = self._software and own.through == "camera" and bool(depth) and not own.reads

        def draw(which: np.ndarray) -> None:
            for first, count in runs_of(chunks[which]):
                mesh.render(self._context.TRIANGLES, vertices=count, first=first)

        if spares and own.adds:  # what it adds to has found out
            draw(np.flatnonzero(seen & ~self._hidden))
            return
        self._hidden = np.zeros(len(chunks), bool)
        places = np.flatnonzero(seen)
        if not spares:
            draw(places)
            return
        near, rest = nearest_first(chunks[places], np.array(uniforms["eye"]))
        draw(places[near])
        if len(rest):
            image = self._images[depth]
            depths = np.frombuffer(image.read(alignment=1), np.float32).reshape(image.size[::-1])
            asked = np.concatenate([places[rest], np.flatnonzero(in_view(self.scene, through, True))])
            self._hidden[asked] = hidden(chunks[asked], through, depths)
            draw(places[rest][~self._hidden[places[rest]]])

    def _drew(self, own: Pass) -> bool:
        """Whether a pass that draws the mesh has drawn something: its depths tell."""
        return any(
            bool((self._read(name) < 1).any()) for name in own.writes if self.buffers[name].kind == "depth"
        )

    def _make_room(self, pixels: tuple[int, int], wanted: frozenset[str]) -> None:
        """Images of the picture's size, kept until another is asked for; those no longer needed are used again."""
        if pixels == self._pixels and wanted <= self._whole:
            return
        self._sized.close()
        self._images, self._targets, self._pixels, self._whole = {}, {}, pixels, wanted
        self._maps.clear()
        context = self._context

        def keep(made: Any) -> Any:
            self._sized.callback(made.release)
            return made

        sharing = shared(self.passes, tuple(self.buffers.values()), wanted)
        for name, first in sharing.items():
            if first != name:
                self._images[name] = self._images[first]
                continue
            own = self.buffers[name]
            size = own.size(pixels)
            if own.kind == "depth":
                image = context.depth_texture(size)
                image.compare_func = ""
            else:
                image = context.texture(size, own.channels, dtype=own.kind)
            image.filter = (context.NEAREST, context.NEAREST)
            image.repeat_x = image.repeat_y = False
            self._images[name] = keep(image)
        for own_pass in self.passes:
            colours = [self._images[n] for n in own_pass.writes if self.buffers[n].kind != "depth"]
            depths = [n for n in own_pass.writes if self.buffers[n].kind == "depth"]
            told = depths or [own_pass.seen] if own_pass.seen else depths
            target = keep(context.framebuffer(colours, self._images[told[0]] if told else None))
            target.depth_mask = bool(depths)  # what is only asked stays, also when colours are cleared
            self._targets[own_pass.name] = target

    def _read(self, name: str) -> NDArray[Any]:
        own, image = self.buffers[name], self._images[name]
        values = np.frombuffer(image.read(alignment=1), _KINDS[own.kind])
        return np.ascontiguousarray(values.reshape(image.size[1], image.size[0], -1)[::-1])


def _content(program: Any) -> tuple[str, ...]:
    """The layout of a vertex and the attributes that a program reads; what it does not read is passed over."""
    names = [name for name in VERTEX.names or () if name in program]
    parts = dict(zip(VERTEX.names or (), _FORMAT.split(), strict=True))
    layout = " ".join(part if name in names else f"{4 * int(part[0])}x" for name, part in parts.items())
    return (layout, *names)


@contextmanager
def renderer_of(scene: Scene, painter: GlPainter, **options: Any) -> Iterator[Renderer]:
    """A renderer that gives back what it holds when the block ends."""
    own = Renderer(scene, painter, **options)
    try:
        yield own
    finally:
        own.close()
