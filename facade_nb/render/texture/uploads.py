"""What the shader is given: textures and uniforms, the same for desktop GL and for a browser."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .atlas import Atlas
from .noise import Seed, noise_texture
from .question import Question

__all__ = [
    "Upload",
    "grammar_upload",
    "noise_upload",
    "seeds_upload",
    "tile_uploads",
    "uniforms",
    "uploads",
]


@dataclass(frozen=True, slots=True)
class Upload:
    """A texture, to be read texel by texel.

    Attributes
    ----------
    name
        Of the sampler.
    size
        Width and height.
    channels
        1 or 4.
    kind
        ``f1`` (8 bits, from 0 to 1), ``f2`` or ``f4`` (floats of 16 or 32 bits).
    content
        The bytes, row 0 first. Floats of 16 bits are converted here: drivers round them as they like.
    """

    name: str
    size: tuple[int, int]
    channels: int
    kind: str
    content: bytes


def uploads(question: Question) -> tuple[Upload, ...]:
    """Every texture that the evaluator reads."""
    return (grammar_upload(question), *tile_uploads(question.atlas))


def grammar_upload(question: Question, wide: bool = False) -> Upload:
    """The grammar; `wide`: the same values in 32 bits, which software renderers read faster."""
    texture = question.texture.astype(np.float32) if wide else question.texture
    return _upload("grammar", texture, 4, "f2" if texture.dtype == np.float16 else "f4")


def noise_upload() -> Upload:
    """The noise texture: the same for all grammars."""
    return _upload("noise", noise_texture(), 1, "f4")


def tile_uploads(atlas: Atlas) -> tuple[Upload, ...]:
    """The noise texture, the tiles, and the table of where each tile is in their atlas: large, and seldom new."""
    table = np.zeros((len(atlas.table), atlas.table.shape[1] + 1, 4), np.float32)
    table[:, 1:] = atlas.table
    table[:, 0, 0] = atlas.grey
    table[:, 0, 1:] = atlas.relief
    return (
        noise_upload(),
        _upload("atlas", atlas.pixels, 4, "f1"),
        _upload("tile_table", table, 4, "f4"),
    )


def seeds_upload(seeds: Sequence[Seed]) -> Upload:
    """Seeds of façades, a row for each: upper and lower 16 bits of its whole steps for x and y; what is left."""
    table = np.zeros((len(seeds), 2, 4), np.float32)
    for k, own in enumerate(seeds):
        (x, y) = (value % 2**32 for value in own.whole)
        table[k] = (x >> 16, x & 0xFFFF, y >> 16, y & 0xFFFF), (*own.rest, 0, 0)
    return _upload("seeds", table, 4, "f4")


def _upload(name: str, array: NDArray[Any], channels: int, kind: str) -> Upload:
    return Upload(name, (array.shape[1], array.shape[0]), channels, kind, array.tobytes())


def uniforms(question: Question) -> dict[str, Any]:
    """What is asked of the grammar."""
    seed = question.seed
    return {
        "to_sun": question.sun,
        "grammar_width": question.texture.shape[1],
        "facade_size": question.size,
        "start_rule": question.records[question.start].place,
        "seed_whole": tuple(value % 2**32 for value in seed.whole),
        "seed_rest": seed.rest,
    }
