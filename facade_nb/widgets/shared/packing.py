"""A piece of a trace as bytes for the browser: JSON, with large arrays beside it, deflated.

Layout before deflating: a little-endian uint32 with the length of the JSON, the JSON in UTF-8, zeros up to a multiple
of 8, then the arrays, each padded likewise. In the JSON an array stands as ``{"$": [type, offset, length]}``, its
offset counted from the end of the padded JSON. ``src/shared/packing.ts`` reads it.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np

__all__ = ["pack"]

_TYPES = ("u1", "i2", "i4", "f4", "f8")


def pack(value: Any, level: int = 6) -> bytes:
    """Pack plain data that may hold NumPy arrays of one dimension; `level`: how hard it is deflated, 1 to 9.

    Raises
    ------
    ValueError
        For a number that is not finite: JSON has none.
    TypeError
        For an array of another type than uint8, int16, int32, float32 or float64.
    """
    blocks: list[bytes] = []
    size = 0

    def plain(own: Any) -> Any:
        nonlocal size
        if isinstance(own, np.ndarray):
            name = own.dtype.str[1:]
            if name not in _TYPES or own.ndim != 1:
                raise TypeError(
                    f"expected a flat array of {', '.join(_TYPES)}; found {own.dtype}, {own.ndim}-D"
                )
            data = own.astype(own.dtype.newbyteorder("<")).tobytes()
            place = {"$": [name, size, own.size]}
            blocks.append(_padded(data))
            size += len(blocks[-1])
            return place
        if isinstance(own, Mapping):
            return {key: plain(inner) for key, inner in own.items()}
        if isinstance(own, (list, tuple)):
            return [plain(inner) for inner in own]
        return own

    text = json.dumps(plain(value), ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode()
    head = _padded(len(text).to_bytes(4, "little") + text)
    return zlib.compress(head + b"".join(blocks), level)


def _padded(data: bytes) -> bytes:
    return data + bytes(-len(data) % 8)
