"""A folder of a user's own images, and what can be wrong with one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facade_nb.design.errors import DesignError
from facade_nb.render.tiles import DEFAULT_SIZE, TileError, TileSet


def _image(path: Path, size: tuple[int, int] = (20, 12), colour: tuple[int, ...] = (200, 100, 50)) -> Path:
    Image.new("RGB" if len(colour) == 3 else "RGBA", size, colour).save(path)
    return path


def test_images_become_tiles_of_one_size(tmp_path: Path) -> None:
    _image(tmp_path / "stucco.png", (70, 40))
    _image(tmp_path / "Fenster_2.jpg", (300, 100), (10, 20, 30))
    _image(tmp_path / "moos.grün.webp", (8, 8))
    (tmp_path / "README.txt").write_text("not an image")
    (tmp_path / "more").mkdir()
    tiles = TileSet.from_folder(tmp_path, builtin=False)
    assert tiles.names == ("Fenster_2", "moos.grün", "stucco")
    assert tiles.size == 128
    assert np.abs(tiles.color("stucco") - np.float32([200, 100, 50, 255]) / 255).max() < 1e-6
    assert TileSet.from_folder(tmp_path, builtin=False, size=32).size == 32


def test_the_picture_stands_upright(tmp_path: Path) -> None:
    image = Image.new("RGBA", (4, 4), (0, 0, 0, 255))
    image.putpixel((0, 3), (255, 255, 255, 255))  # lower left
    image.save(tmp_path / "corner.png")
    tiles = TileSet.from_folder(tmp_path, builtin=False, size=32)
    low, high = np.float32([0.05]), np.float32([0.95])
    assert tiles.sample("corner", low, low)[0, 0] > 0.9
    assert tiles.sample("corner", low, high)[0, 0] < 0.1


def test_colours_do_not_bleed_from_transparent_pixels(tmp_path: Path) -> None:
    image = Image.new("RGBA", (64, 64), (255, 0, 255, 0))
    image.paste((0, 128, 0, 255), (0, 0, 32, 64))
    image.save(tmp_path / "half.png")
    picture = TileSet.from_folder(tmp_path, builtin=False, size=32).color("half")
    seen = picture[picture[..., 3] > 0.02]
    assert seen[:, 0].max() < 0.02


@pytest.mark.parametrize("mode", ["L", "LA", "P", "1", "CMYK", "I;16", "I", "F"])
def test_every_kind_of_image_is_read(tmp_path: Path, mode: str) -> None:
    values = np.tile(np.linspace(0, 1, 32), (32, 1))
    if mode == "I;16":
        image = Image.fromarray((values * 65535).astype(np.uint16))
    elif mode == "I":
        image = Image.fromarray((values * 65535).astype(np.int32))
    elif mode == "F":
        image = Image.fromarray(values.astype(np.float32))
    else:
        image = Image.fromarray((values * 255).astype(np.uint8)).convert(mode)
    image.save(tmp_path / "grey.tiff")
    picture = TileSet.from_folder(tmp_path, builtin=False).color("grey")
    assert picture[5, 2, 0] < 0.25
    assert picture[5, 29, 0] > 0.75


def test_a_folder_extends_the_tiles_that_ship(tmp_path: Path) -> None:
    _image(tmp_path / "stucco.png")
    _image(tmp_path / "brick.png")
    tiles = TileSet.from_folder(tmp_path)
    assert tiles.size == DEFAULT_SIZE
    assert tiles.names[-2:] == ("brick", "stucco")
    assert "window1" in tiles
    assert "brick-dark.normal" in tiles
    assert "brick.normal" not in tiles  # the joints of the old brick on the new one
    assert tiles.color("brick")[0, 0, 0] == pytest.approx(200 / 255)


def test_companions_come_from_files_too(tmp_path: Path) -> None:
    _image(tmp_path / "brick.png")
    _image(tmp_path / "brick.normal.png", colour=(128, 128, 255))
    tiles = TileSet.from_folder(tmp_path, size=32)
    assert tiles.names[-2:] == ("brick", "brick.normal")
    assert "brick.specular" not in tiles


def test_a_missing_folder(tmp_path: Path) -> None:
    with pytest.raises(
        TileError, match="nowhere: expected a folder of images; there is nothing of that name"
    ):
        TileSet.from_folder(tmp_path / "nowhere")
    with pytest.raises(TileError, match="expected a folder of images; this is a file"):
        TileSet.from_folder(_image(tmp_path / "a.png"))


def test_a_folder_without_images(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("none")
    with pytest.raises(TileError, match=r"expected images \(\.png, .*\) in this folder; found none"):
        TileSet.from_folder(tmp_path)


def test_all_faults_are_told_at_once(tmp_path: Path) -> None:
    _image(tmp_path / "good.png")
    _image(tmp_path / "good.jpg")
    _image(tmp_path / "my wall.png")
    _image(tmp_path / "-x.png")
    (tmp_path / "broken.png").write_bytes(b"\x89PNG\r\n\x1a\n and no more")
    (tmp_path / "empty.png").write_bytes(b"")
    whole = _image(tmp_path / "cut.jpg", (200, 200)).read_bytes()
    (tmp_path / "cut.jpg").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(TileError) as caught:
        TileSet.from_folder(tmp_path)
    told = str(caught.value)
    assert isinstance(caught.value, DesignError)  # the command line tells it and ends with 2
    assert len(caught.value.faults) == 6
    assert "expected one file for the tile 'good'; 'good.jpg' has the same name" in told
    assert "found 'my wall'" in told
    assert "found '-x'" in told
    assert "broken.png: cannot read this image" in told
    assert "empty.png: cannot read this image: it is not an image of a known kind" in told
    assert "cut.jpg: cannot read this image" in told
