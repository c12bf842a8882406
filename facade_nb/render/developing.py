"""Numbers of light: sRGB and linear, and what a film makes of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["developed", "floats", "linear"]


def floats(values: object) -> NDArray[np.float32]:
    """An array of single precision."""
    return np.asarray(values, np.float32)


def linear(colour: NDArray[np.float32]) -> NDArray[np.float32]:
    """Linear light from sRGB, 0 to 1."""
    return np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4).astype(np.float32)


def developed(light: NDArray[np.float32], exposure: float) -> NDArray[np.float32]:
    """Tone mapping (a filmic curve after Hable's fit of Narkowicz), then sRGB."""
    x = light * (0.5 * exposure)
    x = x + 0.12 * (x.mean(axis=-1, keepdims=True) - x)  # strong colours fade a little, as on film
    curve = np.clip(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0, 1)
    return np.where(curve <= 0.0031308, curve * 12.92, 1.055 * curve ** (1 / 2.4) - 0.055).astype(np.float32)
