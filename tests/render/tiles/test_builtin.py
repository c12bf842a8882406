"""The tiles that ship: what is there, that it repeats where it is said to, that it is the same each time."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from facade_nb.render.tiles import CATALOGUE, TileError, TileSet
from facade_nb.render.tiles.images import evened, mipmaps

SIZE = 128
TILES = TileSet.builtin(SIZE)
PLAIN = [name for name in TILES.names if "." not in name]
SIDEWAYS = [recipe.name for recipe in CATALOGUE.values() if "x" in recipe.tiling]
UPWARDS = [recipe.name for recipe in CATALOGUE.values() if "y" in recipe.tiling]


def test_the_names_of_figure_12_ship() -> None:
    assert {"wall1", "wall2", "wall3", "window1", "window2", "window3"} <= set(TILES.names)
    assert len(PLAIN) >= 32
    assert len(set(TILES.names)) == len(TILES.names)


def test_every_kind_that_is_asked_for_is_there() -> None:
    asked = (
        "plaster brick ashlar wood tiles slate window-arch balcony-door door shutter cornice balustrade curtain blind "
        "room-white parquet ceiling lamp sofa mask-arch"
    )
    assert set(asked.split()) <= set(PLAIN)


@pytest.mark.parametrize("name", TILES.names)
def test_a_tile_is_what_it_is_said_to_be(name: str) -> None:
    picture = TILES.color(name)
    assert picture.shape == (SIZE, SIZE, 4)
    assert picture.dtype == np.float32
    assert picture.min() >= 0
    assert picture.max() <= 1
    assert np.abs(picture * 255 - np.round(picture * 255)).max() < 1e-4  # 8 bits hold it exactly
    assert not picture.flags.writeable
    opaque = picture[picture[..., 3] > 0.5]
    if name.endswith(".normal"):
        vectors = 2 * opaque[:, :3] - 1
        assert np.abs(np.linalg.norm(vectors, axis=1) - 1).max() < 0.02
        assert vectors[:, 2].min() > 0
    elif name.startswith("mask"):
        assert 0.2 < float((picture[..., 0] >= 0.5).mean()) < 0.8
    elif "." not in name and not name.startswith("glass"):
        assert opaque.size
        assert opaque[:, :3].std() > 0.004  # something is drawn on it


@pytest.mark.parametrize("name", SIDEWAYS)
def test_left_and_right_edge_meet(name: str) -> None:
    for companion in ("", ".normal"):
        if name + companion in TILES:
            _meets(TILES.color(name + companion).transpose(1, 0, 2))


@pytest.mark.parametrize("name", UPWARDS)
def test_lower_and_upper_edge_meet(name: str) -> None:
    for companion in ("", ".normal"):
        if name + companion in TILES:
            _meets(TILES.color(name + companion))


def _meets(lines: np.ndarray) -> None:
    """Over the seam the mean step is about as large as inside at most: between pixels, and between blurred ones."""
    for level in mipmaps(lines.astype(np.float32))[:4:3]:
        inside = np.abs(np.diff(level, axis=0)).mean(axis=(1, 2))
        seam = np.abs(level[0] - level[-1]).mean()
        assert seam <= inside.max() * 1.7 + 2e-3


@pytest.mark.parametrize("name", ["brick", "ashlar", "wood", "plaster", "parquet"])
def test_a_tile_that_is_lighter_at_one_side_does_not_meet(name: str) -> None:
    """What photographs have: the seam test must see a slow change of a fifth."""
    picture = np.array(TILES.color(name))
    _meets(picture)
    picture[..., :3] *= np.linspace(0.8, 1.0, SIZE)[:, None, None]
    with pytest.raises(AssertionError):
        _meets(picture)


EVEN = {
    **dict.fromkeys(
        ("brick", "brick-yellow", "brick-dark", "plaster", "plaster-ochre", "stone", "wall1"), 2.5
    ),
    **dict.fromkeys(("wall2", "wall3", "ashlar", "sandstone", "tiles", "slate"), 4.5),
}


@pytest.mark.parametrize("name", EVEN)
def test_a_wall_does_not_show_from_afar_where_its_tile_repeats(name: str) -> None:
    """In eighths of the tile, brightness is nearly the same: patches would be seen again in every repeat."""
    levels = TileSet.builtin().mips(name)
    assert levels[0][..., :3].mean(axis=2).std() * 255 > 1.5  # from close by there is something to see
    assert levels[5].shape[0] == 8
    assert levels[5][..., :3].mean(axis=2).std() * 255 < EVEN[name]


def test_evening_out_takes_slow_swings_and_leaves_the_rest() -> None:
    x = (np.arange(64) + 0.5) / 64
    slow, fast = (0.1 * np.sin(2 * np.pi * k * x) for k in (1, 12))
    picture = np.repeat((0.4 + slow + fast[:, None])[..., None], 3, axis=2).astype(np.float32)
    even = evened(picture, 5)
    assert even.mean() == pytest.approx(0.4, abs=1e-5)
    assert np.abs(even[..., 0] - (0.4 + fast)[:, None]).max() < 0.002


def test_tiles_are_the_same_in_another_process(tmp_path: Path) -> None:
    """One with nothing in its folder for caches: it draws them."""
    names = ["brick", "ashlar.normal", "window1", "window-arch", "parquet", "plant"]
    code = (
        "import hashlib; from facade_nb.render.tiles import TileSet; t = TileSet.builtin(128);"
        f"print(hashlib.sha256(b''.join(t.color(n).tobytes() for n in {names[::-1]!r})).hexdigest())"
    )
    empty = {**os.environ, "XDG_CACHE_HOME": str(tmp_path)}
    other = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=empty
    )
    assert list(tmp_path.rglob("brick.128.zz"))
    here = hashlib.sha256(b"".join(TILES.color(name).tobytes() for name in names[::-1])).hexdigest()
    assert other.stdout.strip() == here


def test_frames_are_open_where_windows_are_glazed() -> None:
    frame, window = TILES.color("frame-steel"), TILES.color("window-steel")
    assert 0.5 < (frame[..., 3] == 0).mean() < 0.95
    assert window[..., 3].min() == 1
    bars = frame[..., 3] == 1
    assert np.abs(frame - window)[bars].mean() < 0.01  # but for light off the glass


def test_a_larger_tile_is_the_same_tile() -> None:
    """Shapes do not depend on the resolution: halved, the larger is the smaller but for the irregular grain."""
    for name in ("window3", "door", "mask-arch", "railing"):
        small, large = TILES.color(name), TileSet.builtin(2 * SIZE).mips(name)[1]
        assert np.abs(small - large).mean() < 0.02


def test_a_tile_is_drawn_only_when_it_is_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from facade_nb.render.tiles import tileset
    from facade_nb.render.tiles.drawn import Drawn

    monkeypatch.setattr(tileset, "_DRAWN", Drawn(tmp_path))
    drawn: list[str] = []
    draw = tileset.draw
    monkeypatch.setattr(tileset, "draw", lambda name, size: drawn.append(name) or draw(name, size))
    tiles = TileSet({}, 64, TILES.names)
    assert not drawn
    tiles.color("brick")
    tiles.color("brick")
    assert drawn == ["brick"]
    tiles.array(levels=1, names=["brick", "wood"])
    assert drawn == ["brick", "wood"]


@pytest.mark.parametrize("size", [0, 8, 100, 4096, 64.0, "64"])
def test_a_size_must_be_a_power_of_two(size: object) -> None:
    with pytest.raises(TileError, match=r"expected a power of two from 16 to 2048; found"):
        TileSet.builtin(size)  # type: ignore[arg-type]


def test_an_unknown_name_is_told_with_the_nearest() -> None:
    for ask in (TILES.color, TILES.number, TILES.mips):
        with pytest.raises(TileError, match=r"there is no tile 'windw1'; did you mean 'window1'\?"):
            ask("windw1")


def test_numbers_count_from_one() -> None:
    assert [TILES.number(name) for name in TILES.names] == list(range(1, len(TILES) + 1))


@pytest.mark.parametrize(
    "name", [r.name for r in CATALOGUE.values() if r.group.split(",")[0] in ("Windows", "Frames", "Doors")]
)
def test_windows_and_doors_fill_their_rectangle(name: str) -> None:
    """Otherwise the room behind would show beside the frame. Arches do not: `mask-arch` goes with them."""
    alpha = TILES.color(name)[..., 3]
    rim = np.concatenate([alpha[0], alpha[-1], alpha[:, 0], alpha[:, -1]])
    if "arch" in name or name == "gate":
        assert rim.min() == 0
    else:
        assert rim.min() > 0.99


def test_the_stones_of_an_arch_hide_the_edge_of_its_mask() -> None:
    frame, mask = TILES.color("frame-arch")[..., 3], TILES.color("mask-arch")[..., 0] >= 0.5
    edge = np.zeros_like(mask)
    edge[1:, :] |= mask[1:, :] != mask[:-1, :]
    edge[:, 1:] |= mask[:, 1:] != mask[:, :-1]
    assert frame[edge].min() > 0.98
