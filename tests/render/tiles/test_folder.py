"""A folder of a user's own images, and what can be wrong with one."""

from __future__ import annotations

import warnings
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facade_nb.design.errors import DesignError, GrammarError
from facade_nb.render import Grammar
from facade_nb.render.texture import atlas
from facade_nb.render.tiles import DEFAULT_SIZE, TileError, TileSet, folder


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


def test_a_bad_file_keeps_no_other_out(tmp_path: Path) -> None:
    _image(tmp_path / "stucco.png")
    _image(tmp_path / "good.png")
    _image(tmp_path / "good.jpg")
    _image(tmp_path / "my wall.png")
    _image(tmp_path / "-x.png")
    (tmp_path / "broken.png").write_bytes(b"\x89PNG\r\n\x1a\n and no more")
    (tmp_path / "brick.png").write_bytes(b"")
    whole = _image(tmp_path / "cut.jpg", (200, 200)).read_bytes()
    (tmp_path / "cut.jpg").write_bytes(whole[: len(whole) // 2])
    tiles = TileSet.from_folder(tmp_path)
    assert tiles.names[-2:] == ("cut", "stucco")
    assert tiles.color("stucco")[0, 0, 0] == pytest.approx(200 / 255)
    told = "\n".join(map(str, tiles.faults))
    assert len(tiles.faults) == 5
    assert "expected one file for the tile 'good'; found 'good.jpg' and 'good.png'" in told
    assert "found 'my wall'" in told
    assert "found '-x'" in told
    assert "broken.png: cannot read this image" in told
    assert "brick.png: cannot read this image: it is not an image of a known kind" in told
    grammar = "S -> Mat(Color, Fit:%s, 0, 0, 1, 1)"
    Grammar.parse(grammar % "stucco", tiles).evaluate([(0.5, 0.5)], (1, 1))
    with pytest.raises(
        GrammarError, match="line 1, column 17: the tile 'good' cannot be used: expected one file"
    ):
        Grammar.parse(grammar % "good", tiles)
    with pytest.raises(GrammarError, match="the tile 'brick' cannot be used: cannot read this image"):
        Grammar.parse(grammar % "brick", tiles)  # and not the brick that ships
    with pytest.raises(TileError, match=r"cut\.jpg: cannot read this image"):
        Grammar.parse(grammar % "cut", tiles).evaluate([(0.5, 0.5)], (1, 1))


def test_no_file_that_can_be_used(tmp_path: Path) -> None:
    _image(tmp_path / "-x.png")
    (tmp_path / "empty.png").write_bytes(b"")
    with pytest.raises(TileError) as caught:
        TileSet.from_folder(tmp_path)
    assert isinstance(caught.value, DesignError)  # the command line tells it and ends with 2
    assert len(caught.value.faults) == 2


def test_a_picture_that_is_too_large_is_told_by_its_head(tmp_path: Path) -> None:
    _image(tmp_path / "small.png")
    head = b"\x89PNG\r\n\x1a\n"
    for name, side in (("large", 13_100), ("huge", 60_000)):
        size = b"IHDR" + side.to_bytes(4, "big") * 2 + bytes((8, 2, 0, 0, 0))
        data = len(size[4:]).to_bytes(4, "big") + size + zlib.crc32(size).to_bytes(4, "big")
        (tmp_path / f"{name}.png").write_bytes(head + data + bytes((0, 0, 0, 9)) + b"IDAT" + bytes(13))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tiles = TileSet.from_folder(tmp_path)
    assert tiles.names[-1] == "small"
    assert "expected at most 67108864 pixels; found 13100 × 13100" in tiles.unusable["large"]
    assert "expected at most 67108864 pixels" in tiles.unusable["huge"]


def test_what_is_named_is_read_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for k in range(300):
        _image(tmp_path / f"wall-{k}.png")
    read: list[str] = []
    fitted = folder._fitted
    monkeypatch.setattr(folder, "_fitted", lambda file, size: (read.append(file.stem), fitted(file, size))[1])
    tiles = TileSet.from_folder(tmp_path)
    assert len(tiles) > 300 and read == []
    Grammar.parse("S -> Mat(Color, Fit:wall-7, 0, 0, 1, 1)", tiles).evaluate([(0.5, 0.5)], (1, 1))
    assert read == ["wall-7"]


def test_more_tiles_than_fit_one_image(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Sixty of 1024 pixels a side; here an image is as much smaller as its tiles are."""
    assert atlas.MAX_TEXELS == 67108864
    monkeypatch.setattr(atlas, "MAX_TEXELS", atlas.MAX_TEXELS // 256)
    for k in range(60):
        _image(tmp_path / f"w{k}.png", (16, 16))
    tiles = TileSet.from_folder(tmp_path, size=64, builtin=False)
    rules = "\n".join(f"R{k} -> Mat(Color, Fit:w{k}, 0, 0, 1, 1)" for k in range(60))
    grammar = Grammar.parse(rules, tiles)
    with pytest.raises(DesignError, match="the 60 tiles that are named take more than 262144 pixels"):
        grammar.evaluate([(0.5, 0.5)], (1, 1))


@pytest.mark.parametrize("suffix", [".png", ".tiff"])
def test_a_dim_picture_of_16_bits_stays_dim(tmp_path: Path, suffix: str) -> None:
    Image.fromarray(np.full((32, 32), 200, np.uint16)).save(tmp_path / f"dim{suffix}")
    assert TileSet.from_folder(tmp_path).color("dim")[..., :3].max() < 0.005


def test_floats_that_are_no_numbers(tmp_path: Path) -> None:
    values = np.full((64, 64), 0.5, np.float32)
    values[:8], values[8:16], values[16:24] = np.nan, np.inf, -np.inf
    Image.fromarray(values).save(tmp_path / "odd.tiff")
    Image.fromarray(np.full((32, 32), np.nan, np.float32)).save(tmp_path / "none.tiff")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tiles = TileSet.from_folder(tmp_path, size=64)
        picture = tiles.color("odd")
        assert tiles.color("none")[..., :3].max() == 0
    assert picture[:8, :, 0].max() == 0 and picture[8:16, :, 0].min() == 1 and picture[16:24, :, 0].max() == 0
    assert picture[40, 40, 0] == pytest.approx(0.5, abs=0.003)


def test_names_of_any_script_however_they_are_composed(tmp_path: Path) -> None:
    """Some file systems give names decomposed; grammars may be typed either way."""
    for name in ("mu\u0308nster", "दीवार", "ผนัง", "בָּית"):
        _image(tmp_path / f"{name}.png")
    tiles = TileSet.from_folder(tmp_path)
    assert tiles.faults == () and "münster" in tiles.names
    for name in ("münster", "mu\u0308nster", "दीवार", "ผนัง", "בָּית"):
        grammar = Grammar.parse(f"S -> Mat(Color, Fit:{name}, 0, 0, 1, 1)", tiles)
        assert grammar.evaluate([(0.5, 0.5)], (1, 1)).color[0, 0] == pytest.approx(200 / 255)
