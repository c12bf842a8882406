"""The part of a channel that tells the browser of the façade as a building: only while a view looks at it."""

from __future__ import annotations

import asyncio
import zlib
from typing import Any

from traitlets import Bytes

from ...design import DesignError
from ...render import Grammar
from ...render.pipeline.solids import solids_of
from ...solver import Layout
from ..shared.bundled import Message
from ..town.tiles import tiles_of, tiles_piece
from .extras import Extras
from .mesh_pieces import mesh_piece, works_piece

__all__ = ["Scenery"]

_PAUSE = 0.03
"""Seconds between a layout and its mesh: the elevation goes first, and a layout that is passed over has none."""


class Scenery(Extras):
    """The traits of the 3D view. Tiles come by messages, in the sizes that a view asks for."""

    works = Bytes(help="What draws all meshes of a grammar; see `mesh_pieces.works_piece`.").tag(sync=True)
    mesh = Bytes(help="The layout's triangles; see `mesh_pieces.mesh_piece`.").tag(sync=True)

    def __init__(self, model: Any, **traits: Any) -> None:
        self._meshed: Layout | None = None
        self._grammar: Grammar | None = None
        self._meshing: asyncio.TimerHandle | None = None
        super().__init__(model, **traits)

    def _describe_scenery(self) -> None:
        """Bring the mesh up to date, soon, if somebody looks."""
        if not self._wanted("building"):
            self._drop_mesh()
        elif self.model.layout is not self._meshed and self._meshing is None:
            try:
                loop = asyncio.get_running_loop()
            except RuntimeError:  # nobody to call back later
                self._mesh_now()
            else:
                self._meshing = loop.call_later(_PAUSE, self._mesh_now)

    def _mesh_now(self) -> None:
        self._meshing = None
        layout = self.model.layout
        if layout is None or layout is self._meshed or not self._wanted("building"):
            return
        self._meshed = layout
        try:
            whole = self.model.whole
            solids = (whole.solids(layout) if whole else None) or solids_of(layout)
        except DesignError:  # a material that there is not: the elevation says so; the last good mesh stays
            return
        grammar = solids.scene.grammar
        with self.hold_sync():
            if grammar is not self._grammar:
                self.works, self._grammar = works_piece(grammar), grammar
            self.mesh = mesh_piece(solids, layout, whole.walls() if whole else ())

    def _drop_mesh(self) -> None:
        if self._meshing is not None:
            self._meshing.cancel()
            self._meshing = None
        if self.mesh:
            self._meshed = self._grammar = None
            self.works = self.mesh = b""

    def _answer_tiles(self, message: Message) -> None:
        """Send some tiles in larger sizes."""
        if self._grammar is None:
            return
        known = set(self._grammar.encoding.tiles)
        asked = [pair for pair in zip(message["names"], message["above"], strict=True) if pair[0] in known]
        told, content = tiles_piece(
            tiles_of(self._grammar),
            [name for name, _ in asked],
            [least for _, least in asked],
            int(message["upto"]),
        )
        self.send(
            {"kind": "tiles", "tiles": told, "client": message["client"]}, buffers=[zlib.compress(content, 1)]
        )
