"""The wire between a town and the browser: a head, blocks as they are asked for, and what is edited."""

from __future__ import annotations

import zlib
from typing import Any

from traitlets import Bool, Bytes, Dict, Float, Int, List, Unicode

from ...render.pipeline.vertices import VERTEX
from ...render.pipeline.viewpoint import Viewpoint
from ..shared.bundled import Message, as_run
from ..shared.pictured import EditedWire
from ..studio.wire import describe_faults
from .following import Following
from .model import TownModel
from .packet import BLOCK, Blob, blobs_of, head_piece, kept_piece, row
from .still import SAVED, image, still, told
from .tiles import tiles_of, tiles_piece

__all__ = ["TownChannel"]


def _state(model: TownModel) -> dict[str, Any]:
    return {
        "hour": model.hour,
        "viewpoint": row(model.viewpoint),
        "path": [] if model.path is None else model.path.to_dict(),
        "chosen": model.chosen,
        "section": model.section,
        "text": model.text,
        "faults": describe_faults(model.faults),
        "restyled": [list(pair) for pair in model.restyled],
        "can_undo": model.can_undo,
        "can_redo": model.can_redo,
    }


class TownChannel(EditedWire):
    """One town model's line to the browser. Get it by `TownChannel.of`: there is one for each."""

    front = "town"

    head = Bytes(help="All that is small; see `packet.head_piece`.").tag(sync=True)
    kept = Bytes(help="All that a page without a kernel can't ask for; see `keep`.").tag(sync=True)
    hour = Float().tag(sync=True)
    viewpoint = List(Float()).tag(sync=True)
    path = List(Dict()).tag(sync=True)
    chosen = Int(-1).tag(sync=True)
    section = Unicode().tag(sync=True)
    text = Unicode().tag(sync=True)
    faults = List(Dict()).tag(sync=True)
    restyled = List(List(Int())).tag(sync=True)
    can_undo = Bool().tag(sync=True)
    can_redo = Bool().tag(sync=True)

    def __init__(self, model: TownModel) -> None:
        self._blobs: dict[str, Blob] = {}
        self._kept = 0  # the side of tiles that are kept; 0: nothing is
        self._following = Following(self._picture)
        super().__init__(model, **_state(model))
        self._refill()
        model.observe(self._on_model)

    def close(self) -> None:
        """Close the wire; the model lives on."""
        self._following.drop()
        super().close()

    def promise_picture(self) -> bool:
        """Have the picture that a notebook carries follow the cell's output; whether it will."""
        return self._following.promise(told(self.model), f"fnb-follows-{self.model_id}")

    def _picture(self) -> str:
        drawn = b""
        with self._telling():
            drawn = still(self.model, SAVED, hasty=True)
        return as_run(image(self.model, drawn))

    def _drawn(self) -> bytes:
        return still(self.model)

    def _refill(self) -> None:
        with self._telling():
            self._blobs = blobs_of(self.model)
            self.head = head_piece(self.model, self._blobs)
            if self._kept:
                self.kept = kept_piece(self.model, self._blobs, self._kept)

    def keep(self, side: int) -> None:
        """Have in the traits what is sent in blocks elsewise, with tiles up to a side."""
        self._kept = side
        self.wake()
        self.kept = kept_piece(self.model, self._blobs, side)

    def _empty(self) -> None:
        self._stills = False
        self._blobs = {}
        self.head = self.still = self.kept = b""

    def _on_model(self, change: Any) -> None:
        with self.hold_sync():
            if change["name"] in ("grammar", "tile_megabytes") and not self._asleep:
                self._refill()
            for name, value in _state(self.model).items():
                setattr(self, name, value)
            if self._stills and change["name"] in ("grammar", "hour", "restyled", "viewpoint"):
                self.draw_still()
        if change["name"] == "restyled" and not self._asleep:
            self._patch({own for own, _ in set(change["old"] or ()) ^ set(change["new"])})

    def _patch(self, buildings: set[int]) -> None:
        """Send the vertices of buildings that have changed."""
        self._blobs["vertices"] = Blob(
            memoryview(self.model.vertices.view("u1").reshape(-1)), BLOCK * VERTEX.itemsize
        )
        content = self._blobs["vertices"].content
        for building in sorted(buildings):
            first, end = (VERTEX.itemsize * at for at in self.model.vertices_of(building))
            self.send({"kind": "patch", "name": "vertices", "at": first}, buffers=[bytes(content[first:end])])

    def _answer(self, message: Message) -> None:
        self._following.wait()
        op = message.get("op")
        with self._telling():
            if op == "blocks":
                self._send_blocks(message)
            elif op == "tiles":
                self._send_tiles(message)
            else:
                with self.hold_sync():
                    if op == "still":
                        self._follow_with_stills()
                    elif "seq" in message:
                        with self._taking(message):
                            self._edit(str(op), message)

    def _send_blocks(self, message: Message) -> None:
        name, version, numbers = message["name"], message["version"], message["blocks"]
        blob = self._blobs.get(name)
        if blob is None or blob.version != version:
            return  # it has been replaced; the new head says so
        self.send(
            {
                "kind": "blocks",
                "name": name,
                "version": version,
                "blocks": numbers,
                "client": message["client"],
            },
            buffers=[blob.deflated(number) for number in numbers],
        )

    def _send_tiles(self, message: Message) -> None:
        known = set(self.model.grammar.encoding.tiles)
        asked = [pair for pair in zip(message["names"], message["above"], strict=True) if pair[0] in known]
        told, content = tiles_piece(
            tiles_of(self.model.grammar),
            [name for name, _ in asked],
            [least for _, least in asked],
            int(message["upto"]),
        )
        self.send(
            {"kind": "tiles", "tiles": told, "client": message["client"]}, buffers=[zlib.compress(content, 1)]
        )

    def _edit(self, op: str, message: Message) -> None:
        model = self.model
        if op in ("undo", "redo"):
            getattr(model, op)()
            return
        name, value = message["name"], message["value"]
        if name == "text":
            model.enter(str(value))
        elif name == "section":
            model.edit(str(value))
        elif name == "hour":
            model.adjust(float(value))
        elif name == "chosen":
            model.chosen = int(value)
        elif name == "restyled":
            model.restyle(*map(int, value))
        elif name == "viewpoint":
            x, y, z, yaw, pitch, angle = map(float, value)
            model.viewpoint = Viewpoint((x, y, z), yaw, pitch, angle)
        elif name == "path":
            model.travel(value)
