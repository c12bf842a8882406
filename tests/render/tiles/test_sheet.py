"""docs/tiles.md has the tables of the code, and its picture."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

from PIL import Image

from facade_nb.render.tiles import CATALOGUE, TileSet, sheet
from scripts.docs.tiles import table

PAGE = Path(__file__).parents[3] / "docs" / "tiles.md"


def test_the_page_has_the_tables_of_the_code() -> None:
    assert table() in PAGE.read_text(encoding="utf-8"), "run: python -m scripts.docs.tiles"


def test_the_picture_of_the_page_is_small_and_whole() -> None:
    picture = PAGE.parent / "img" / "tiles.png"
    assert picture.stat().st_size < 640_000
    rows = -(-len(CATALOGUE) // 11)
    with Image.open(picture) as image:
        assert image.height > rows * 78


def test_a_sheet_shows_what_is_asked_for() -> None:
    tiles = TileSet.builtin(64)
    image = Image.open(BytesIO(sheet(tiles, ["plaster-ochre"], cell=64, columns=1))).convert("RGB")
    red, green, blue = image.getpixel((image.width // 2, image.height // 2))  # type: ignore[misc]
    mean = tiles.color("plaster-ochre")[..., :3].mean(axis=(0, 1)) * 255
    assert abs(red - mean[0]) + abs(green - mean[1]) + abs(blue - mean[2]) < 40
    assert tiles._repr_png_()[:4] == b"\x89PNG"
