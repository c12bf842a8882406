"""What the browser is told of a town: a head with all that is small, and large things in blocks that it asks for."""

from __future__ import annotations

import zlib
from dataclasses import asdict, dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...render.pipeline.frame import Looks
from ...render.pipeline.passes import BUFFERS, OUTDOORS, SHADOW
from ...render.pipeline.sunlight import MAPS
from ...render.pipeline.vertices import VERTEX
from ...render.pipeline.viewpoint import Viewpoint
from ...render.texture.daytime import Daytime
from ...render.texture.program import tile_names
from ...render.texture.shaders import room, rooms_for
from ...render.texture.uploads import grammar_upload, noise_upload
from ...render.town.plan import KINDS, ROOFS
from ..shared.packing import pack
from ..texture.packet import HOURS, attributes, passes_of, shaders_of
from .model import TownModel
from .places import EYE, edges_of
from .tiles import question_of, tiles_of, tiles_piece

__all__ = ["BLOCK", "Blob", "blobs_of", "described", "head_piece", "hours", "kept_piece", "needs_of", "row"]

_LOOKS = Looks()

BLOCK = 4096
"""Vertices of a block, which a message carries; and three times as many indices."""


@dataclass(frozen=True, slots=True, eq=False)
class Blob:
    """Something large, sent in blocks.

    Attributes
    ----------
    content
        Its bytes.
    block
        Bytes of a block; 0: it goes in one.
    version
        Another one in its place has another.
    """

    content: memoryview
    block: int = 0
    version: int = 0

    def deflated(self, number: int) -> bytes:
        """A block, deflated."""
        size = self.block or len(self.content)
        return zlib.compress(self.content[number * size : (number + 1) * size], 1)


def _bytes(array: NDArray[Any]) -> memoryview:
    flat: Any = np.ascontiguousarray(array).reshape(-1).view(np.uint8)
    return memoryview(flat)


def blobs_of(model: TownModel) -> dict[str, Blob]:
    """All that is large, by name, but for tiles."""
    found = {
        "vertices": Blob(_bytes(model.vertices), BLOCK * VERTEX.itemsize),
        "indices": Blob(_bytes(model.source.indices), BLOCK * 12),
    }
    if model.town is not None:
        found["edges"] = Blob(_bytes(edges_of(model.town.plan)))
    return found


def needs_of(model: TownModel) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Which blocks of vertices each chunk draws: offsets (c + 1,) into the numbers of blocks."""
    blocks, chunks = model.source.indices // BLOCK, model.source.chunks
    needed = np.zeros((len(chunks), int(blocks.max(initial=0)) + 1), bool)
    for chunk, first, count in zip(needed, chunks["first"].tolist(), chunks["count"].tolist(), strict=True):
        chunk[blocks[first : first + count]] = True
    offsets = np.concatenate([[0], needed.sum(axis=1).cumsum()])
    return offsets.astype(np.int32), needed.nonzero()[1].astype(np.int32)


def row(place: Viewpoint) -> list[float]:
    """A viewpoint as the browser has it: x, y, z, yaw, pitch, angle."""
    return [*map(float, place.eye), float(place.yaw), float(place.pitch), float(place.angle)]


def head_piece(model: TownModel, blobs: dict[str, Blob]) -> bytes:
    """What is small, and comes first: passes, shaders, light, grammar, chunks, buildings."""
    question = question_of(model.grammar)
    chunks, scene = model.source.chunks, model.scene
    offsets, numbers = needs_of(model)
    head: dict[str, Any] = {
        "passes": passes_of(OUTDOORS),
        "buffers": [asdict(own) for own in BUFFERS],
        "shaders": _shaders(model),
        "hours": hours(),
        "sunlight": {**MAPS, "side": SHADOW},
        "looks": {"haze": _LOOKS.haze, "reach": _LOOKS.reach},
        "stride": VERTEX.itemsize,
        "attributes": attributes(),
        "block": BLOCK,
        "blobs": {
            name: {"bytes": len(own.content), "block": own.block or len(own.content), "version": own.version}
            for name, own in blobs.items()
        },
        "textures": _textures(model),
        "tiles": list(model.grammar.encoding.tiles),
        "tile_bytes": int(model.tile_megabytes * 1e6),
        "grammar": np.frombuffer(grammar_upload(question).content, np.uint8),
        "chunks": {
            "first": chunks["first"].astype(np.int32),
            "count": chunks["count"].astype(np.int32),
            "low": chunks["low"].astype(np.float32).reshape(-1),
            "high": chunks["high"].astype(np.float32).reshape(-1),
            "needs": offsets,
            "blocks": numbers,
        },
        "turning": int(chunks["first"][scene.turning].min(initial=len(scene.indices))),
        "box": scene.box.reshape(-1).tolist(),
        "views": {name: row(place) for name, place in model.views.items()},
        "eye": EYE,
        "report": model.grammar.report(),
        "starts": [],
        "town": None,
    }
    if model.starts is not None:
        head["starts"] = model.starts.places(model.grammar).reshape(-1).astype(int).tolist()
        head["town"] = described(model)
    return pack(head)


def kept_piece(model: TownModel, blobs: dict[str, Blob], side: int) -> bytes:
    """All that is large, for a page that no kernel answers: the blobs, and tiles whose sides are at most `side`.

    Of a tile that nothing in the town shows, one pixel goes along: where no kernel is, no house gets another style.
    """
    tiles, shown = tiles_of(model.grammar), set(_shown(model))
    told, parts = [], []
    for name in model.grammar.encoding.tiles:
        own, pixels = tiles_piece(tiles, [name], [0], side if name in shown else 1)
        told += own
        parts.append(pixels)
    for one in told:  # finer sizes are not there to be asked for
        one.update(
            sizes=one["sizes"][one["first"] : one["end"]], first=0, end=one["end"] - one["first"], draft=False
        )
    contents = {name: np.frombuffer(blob.content, np.uint8) for name, blob in blobs.items()}
    return pack({"blobs": contents, "tiles": told, "pixels": np.frombuffer(b"".join(parts), np.uint8)})


def _shown(model: TownModel) -> tuple[str, ...]:
    """The tiles that rules name which can be met in the town as it stands."""
    rules, positions = model.grammar.rules, model.grammar.encoding.positions
    numbers = {place: number for number, place in enumerate(positions)}
    starts = np.unique(model.vertices["start"].astype(int), axis=0)
    ahead = [numbers[x, y] for x, y in starts.tolist()]
    met = set(ahead)
    while ahead:
        new = set(rules[ahead.pop()].targets()) - met
        met |= new
        ahead += new
    return tile_names([rules[number] for number in sorted(met)])


@lru_cache(maxsize=1)
def hours() -> list[dict[str, Any]]:
    """The light of the hours that the browser has."""
    return [Daytime.at(hour).uniforms() for hour in HOURS]


def _shaders(model: TownModel) -> dict[str, str]:
    """The source of each shader of each pass, by the pass and which it is."""
    question = question_of(model.grammar)
    frames, seeds = map(room, question.stacks)
    rooms = rooms_for(question.rooms)
    return shaders_of(OUTDOORS, frames=frames, seeds=seeds, rooms=rooms, bits=model.grammar.encoding.bits)


def _textures(model: TownModel) -> dict[str, Any]:
    every = (grammar_upload(question_of(model.grammar)), noise_upload())
    return {own.name: {"size": list(own.size), "channels": own.channels, "kind": own.kind} for own in every}


def described(model: TownModel) -> dict[str, Any]:
    """What an inspector tells of each building, and the names of what it counts."""
    town = model.town
    assert town is not None
    plan = town.plan
    return {
        "styles": [one.name for one in town.styles],
        "kinds": list(KINDS),
        "roofs": list(ROOFS),
        "seed": plan.seed.astype(np.int32).reshape(-1),
        "style": plan.style.astype(np.int32),
        "storeys": plan.storeys.astype(np.int32),
        "eaves": plan.eaves.astype(np.float32),
        "rise": plan.rise.astype(np.float32),
        "roof": plan.roof.astype(np.int32),
        "kind": plan.kind.astype(np.int32),
        "parts": list(model.parts),
    }
