"""What the browser is told of a façade as a building: the mesh of a layout, and all that draws it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from functools import lru_cache
from typing import Any

import numpy as np

from ...render import Grammar
from ...render.pipeline.frame import Looks
from ...render.pipeline.passes import BUFFERS, PLAIN, SHADOW
from ...render.pipeline.solids import Solids
from ...render.pipeline.sunlight import MAPS
from ...render.pipeline.vertices import VERTEX
from ...render.texture.shaders import room, rooms_for
from ...render.texture.uploads import grammar_upload, noise_upload
from ...solver import Layout
from ..shared.packing import pack
from ..texture.packet import attributes, passes_of, shaders_of
from ..town.packet import hours
from ..town.tiles import COARSE, question_of, tiles_of, tiles_piece

__all__ = ["mesh_piece", "works_piece"]

_LOOKS = Looks()
_FAST = 1
"""How hard a mesh is deflated: it goes to a browser beside the kernel, and is waited for."""

_VARYING = ("position", "place")
"""What differs from corner to corner of a flat piece; all else a vertex carries is the same there."""


@lru_cache(maxsize=4)
def works_piece(grammar: Grammar) -> bytes:
    """What draws all meshes of a grammar: passes, shaders, light of the day, the grammar, small tiles."""
    question = question_of(grammar)
    frames, seeds = map(room, question.stacks)
    needs = {
        "frames": frames,
        "seeds": seeds,
        "rooms": rooms_for(question.rooms),
        "bits": grammar.encoding.bits,
    }
    uploads = (grammar_upload(question), noise_upload())
    names = list(grammar.encoding.tiles)
    told, content = tiles_piece(tiles_of(grammar), names, [0] * len(names), COARSE)
    return pack(
        {
            "passes": passes_of(PLAIN),
            "buffers": [asdict(own) for own in BUFFERS],
            "shaders": shaders_of(PLAIN, **needs),
            "hours": hours(),
            "sunlight": {**MAPS, "side": SHADOW},
            "looks": {"haze": _LOOKS.haze, "reach": _LOOKS.reach},
            "stride": VERTEX.itemsize,
            "attributes": attributes(),
            "images": {
                own.name: {"size": list(own.size), "channels": own.channels, "kind": own.kind}
                for own in uploads
            },
            "textures": {own.name: np.frombuffer(own.content, np.uint8) for own in uploads},
            "tiles": names,
            "told": told,
            "coarse": np.frombuffer(content, np.uint8),
        }
    )


def mesh_piece(solids: Solids, layout: Layout, walls: Sequence[str] = ()) -> bytes:
    """The triangles of a layout, and to which shape each belongs, or to which of the other walls of its building."""
    scene = solids.scene
    vertices = scene.vertices
    fields: Any = VERTEX.fields
    flat = vertices.view(np.float32).reshape(len(vertices), -1)
    first = sum(VERTEX[name].itemsize for name in _VARYING) // 4
    assert fields["size"][1] == 4 * first
    rest = flat[:, first:]
    new = np.concatenate([[True], (rest[1:] != rest[:-1]).any(axis=1)]) if len(rest) else np.zeros(0, bool)
    box = scene.box if scene.sunny is None else scene.sunny
    names = sorted({name for shape in layout.shapes for name in (shape.layer, shape.x, shape.y)})
    number = {name: k for k, name in enumerate(names)}
    return pack(
        {
            "varying": np.ascontiguousarray(flat[:, :first]).reshape(-1),
            "facets": np.ascontiguousarray(rest[new]).reshape(-1),
            "facet": (np.cumsum(new) - 1).astype(np.int32),
            "indices": scene.indices.astype(np.int32),
            "turning": int(scene.chunks["first"][scene.turning].min(initial=len(scene.indices))),
            "shapes": solids.shapes.astype(np.int32),
            "sunny": box.reshape(-1).tolist(),
            "body": solids.box.reshape(-1).tolist(),
            "canvas": [layout.canvas.width, layout.canvas.height],
            "names": names,
            "walls": list(walls),
            "placed": np.array(
                [number[name] for shape in layout.shapes for name in (shape.layer, shape.x, shape.y)],
                np.int32,
            ),
        },
        _FAST,
    )
