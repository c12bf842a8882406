"""What every tile goes through: colour under transparent pixels, 8 bits, and mipmaps."""

from __future__ import annotations

import numpy as np

from .canvas import Floats, Values

__all__ = ["bled", "coverage", "evened", "mipmaps", "rounded"]


def rounded(picture: Floats) -> Floats:
    """The nearest multiples of 1/255, so that a texture of 8 bits holds exactly what NumPy computes with."""
    return (np.floor(np.clip(picture, 0, 1) * 255 + 0.5) / np.float32(255)).astype(np.float32)


def evened(colour: Floats, waves: float) -> Floats:
    """Take slow changes out of a colour (h, w, 3) that goes on at its edges.

    From afar a repeated tile shows nothing but its patches that are darker or lighter than others, over and over. What
    swings fewer than `waves` times across the tile is weakened, the slowest most; the mean stays.
    """
    up, across = np.fft.fftfreq(colour.shape[0], 1 / colour.shape[0]), np.arange(colour.shape[1] // 2 + 1)
    keep = 1 - np.exp(-(((up[:, None] ** 2 + across**2) / waves**2) ** 2))
    keep[0, 0] = 1
    swings = np.fft.rfft2(colour, axes=(0, 1)) * keep[..., None]
    return np.fft.irfft2(swings, s=colour.shape[:2], axes=(0, 1)).astype(np.float32)


def bled(picture: Floats) -> Floats:
    """Give transparent pixels (h, w, 4) the colour of what is near, so that no dark rim appears where samples blend."""
    if picture[..., 3].min() > 0 or picture[..., 3].max() <= 0:
        return picture
    levels = [np.concatenate([picture[..., :3] * picture[..., 3:], picture[..., 3:]], axis=-1)]
    while max(levels[-1].shape[:2]) > 1:
        levels.append(_halved(levels[-1]))
    filled = levels[-1]
    for level in levels[-2::-1]:
        coarse = filled.repeat(2, axis=0).repeat(2, axis=1)[: level.shape[0], : level.shape[1]]
        filled = np.where(level[..., 3:] > 1e-6, level, coarse / np.maximum(coarse[..., 3:], 1e-6) * 1e-5)
    colour = filled[..., :3] / np.maximum(filled[..., 3:], 1e-12)
    result = picture.copy()
    clear = picture[..., 3] <= 0
    result[clear, :3] = np.clip(colour[clear], 0, 1)
    return result


def mipmaps(picture: Floats, kind: str = "color") -> tuple[Floats, ...]:
    """The picture (size, size, 4) and its halvings down to one pixel.

    Parameters
    ----------
    picture
        Level 0.
    kind
        ``color`` and ``specular``: colours weigh as much as they are opaque, and alpha is the mean. ``normal``: means
        are made as long as normals again. ``mask``: as much of each level as of the first is at least a half.
    """
    levels = [picture]
    exact = picture
    share, grey = coverage(picture), _grey(picture)
    while max(exact.shape[:2]) > 1:
        weighted = np.concatenate([exact[..., :3] * exact[..., 3:], exact], axis=-1)
        mean = _halved(weighted)
        alpha = mean[..., 6:]
        colour = np.where(alpha > 1e-6, mean[..., :3] / np.maximum(alpha, 1e-6), mean[..., 3:6])
        if kind == "normal":
            vector = 2 * colour - 1
            vector /= np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-6)
            colour = 0.5 + 0.5 * vector
        exact = np.concatenate([colour, alpha], axis=-1).astype(np.float32)
        levels.append(rounded(_covered(exact, share, grey) if kind == "mask" else exact))
    return tuple(levels)


def coverage(picture: Floats) -> float:
    """Share of the pixels where the tile, taken as a mask, is at least a half."""
    return float(np.mean(_mask(picture, _grey(picture)) >= 0.5))


def _grey(picture: Floats) -> bool:
    """Whether the tile is opaque throughout: its mask is then its brightness, otherwise its alpha."""
    return bool(picture[..., 3].min() >= 1)


def _mask(picture: Floats, grey: bool) -> Floats:
    return picture[..., :3].mean(axis=-1) if grey else picture[..., 3]


def _covered(picture: Floats, share: float, grey: bool) -> Floats:
    """Move brightness, or alpha, up or down until that share of the pixels is at least a half."""
    values = np.sort(_mask(picture, grey).ravel())[::-1]
    count = round(share * len(values))
    if 0 < count < len(values):
        middle = (values[count - 1] + values[count]) / 2
        limit = middle if values[count - 1] > values[count] else values[count]
    else:
        limit = 0.5
    result = picture.copy()
    part = slice(0, 3) if grey else slice(3, 4)
    value = picture[..., part]
    below, above = value * (0.5 / max(limit, 1e-6)), 0.5 + (value - limit) * (0.5 / max(1 - limit, 1e-6))
    result[..., part] = np.clip(
        np.where(value < limit, below, above), 0, 1
    )  # black stays black, and white white
    return result


def _halved(picture: Values) -> Values:
    """Means of two by two pixels; a single row or column is kept."""
    h, w = picture.shape[:2]
    if h > 1:
        picture = (picture[0::2] + picture[1::2]) / 2
    if w > 1:
        picture = (picture[:, 0::2] + picture[:, 1::2]) / 2
    return picture
