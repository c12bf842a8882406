"""From light to pixels: tone mapping, sRGB, and means over samples."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["binned", "developed"]


def developed(light: NDArray[np.float32], exposure: float) -> NDArray[np.float32]:
    """Tone mapping (a filmic curve after Hable's fit of Narkowicz), then sRGB."""
    x = light * (0.5 * exposure)
    x = x + 0.12 * (x.mean(axis=-1, keepdims=True) - x)  # strong colours fade a little, as on film
    curve = np.clip(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0, 1)
    return np.where(curve <= 0.0031308, curve * 12.92, 1.055 * curve ** (1 / 2.4) - 0.055).astype(np.float32)


def binned(values: NDArray[np.float32], n: int) -> NDArray[np.float32]:
    """Means over n × n pixels."""
    h, w, c = values.shape
    return values.reshape(h // n, n, w // n, n, c).mean(axis=(1, 3))
