"""Tiles are drawn once: kept in memory and on disk; a folder that cannot be used is no fault."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from facade_nb.render import Grammar
from facade_nb.render.texture.atlas import pack
from facade_nb.render.tiles import TileSet, tileset
from facade_nb.render.tiles.drawing import relief as drawn_relief
from facade_nb.render.tiles.drawn import Drawn, painters


@pytest.fixture
def drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Drawn:
    """Nothing has been drawn yet."""
    made = Drawn(tmp_path / "tiles")
    monkeypatch.setattr(tileset, "_DRAWN", made)
    return made


@pytest.fixture
def painted(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of tiles, as they are drawn."""
    names: list[str] = []
    paint = TileSet._paint

    def noted(self: TileSet, name: str) -> object:
        names.append(name)
        return paint(self, name)

    monkeypatch.setattr(TileSet, "_paint", noted)
    return names


def test_a_tile_is_drawn_once_for_all_processes(
    drawn: Drawn, painted: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    tiles = TileSet.builtin(32)
    assert not tiles.is_drawn("brick")
    first = tiles.stored("brick")
    assert tiles.is_drawn("brick")
    monkeypatch.setattr(tileset, "_DRAWN", Drawn(drawn.folder))  # another process
    again = tiles.stored("brick")
    assert painted == ["brick"]
    assert [level.tobytes() for level in again] == [level.tobytes() for level in first]
    assert [level.shape[0] for level in again] == [32, 16, 8, 4, 2, 1]


def test_what_is_kept_is_what_is_drawn_to_the_bit(drawn: Drawn) -> None:
    for name in ("brick", "brick.normal", "mask-arch", "frame-sash", "frame-sash.specular"):
        tiles = TileSet({}, 64, TileSet.builtin(64).names)
        wanted = tiles._paint(name)
        for level, exact in zip(tiles.mips(name), wanted, strict=True):
            assert level.tobytes() == exact.tobytes()
        assert tiles.color(name).tobytes() == wanted[0].tobytes()


def test_an_edit_that_names_a_new_tile_draws_that_one(drawn: Drawn, painted: list[str]) -> None:
    tiles = TileSet.builtin(16)
    Grammar.parse("S -> Mat(Color, Rep:brick, 0, 0, 1, 1)", tiles).atlas()
    painted.clear()
    Grammar.parse("S -> SplitX(Abs, 1, A, Rel, 1, B)  A -> Mat(Color, Rep:slate, 0, 0, 1, 1)  "
                  "B -> Mat(Color, Rep:brick, 0, 0, 1, 1)", tiles).atlas()  # fmt: skip
    assert painted == ["slate"]


def test_memory_is_bounded_and_disk_has_the_rest(
    drawn: Drawn, painted: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    small = Drawn(drawn.folder, most=4 * 4 * 32 * 32)
    monkeypatch.setattr(tileset, "_DRAWN", small)
    tiles = TileSet.builtin(32)
    names = ("brick", "slate", "wood", "stone", "metal", "tiles")
    for name in names:
        tiles.stored(name)
    assert sum(level.nbytes for levels in small._levels.values() for level in levels) <= 4 * 4 * 32 * 32
    for name in names:
        tiles.stored(name)
    assert painted == list(names)


@pytest.mark.parametrize("where", ["a file", "a folder that is read-only", "nowhere"])
def test_a_folder_that_cannot_be_written_is_no_fault(
    where: str, tmp_path: Path, painted: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    spoilt = tmp_path / "spoilt"
    if where == "a file":
        spoilt.write_text("no folder")
    elif where == "nowhere":
        spoilt = Path("/proc/nowhere")
    else:
        spoilt.mkdir()
        monkeypatch.setattr(Path, "replace", _refused)
    monkeypatch.setattr(tileset, "_DRAWN", Drawn(spoilt / "tiles"))
    assert TileSet.builtin(16).stored("brick")[0].std() > 1
    assert TileSet.builtin(16).relief("frame-sash") is not None
    assert painted == ["brick"]


def _refused(*_: object) -> None:
    raise PermissionError(13, "Permission denied")


@pytest.mark.parametrize("content", [b"", b"no tile", None])
def test_a_spoilt_file_is_drawn_anew(
    content: bytes | None, drawn: Drawn, painted: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    tiles = TileSet.builtin(16)
    first = tiles.stored("brick")
    for path in drawn.folder.iterdir():
        path.write_bytes(path.read_bytes()[:40] if content is None else content)
    monkeypatch.setattr(tileset, "_DRAWN", Drawn(drawn.folder))
    assert tiles.stored("brick")[0].tobytes() == first[0].tobytes()
    assert painted == ["brick", "brick"]


@pytest.mark.parametrize("name", ["rustic", "tiles", "frame-sash", "glass"])
def test_relief_is_kept_too(name: str, drawn: Drawn, monkeypatch: pytest.MonkeyPatch) -> None:
    wanted = drawn_relief(name, 32)
    tiles = TileSet.builtin(32)
    tiles.relief(name)
    monkeypatch.setattr(tileset, "relief", lambda *_: pytest.fail("drawn again"))
    monkeypatch.setattr(tileset, "_DRAWN", Drawn(drawn.folder))
    found = tiles.relief(name)
    if wanted is None:
        assert found is None
        return
    assert found is not None
    assert found.heights.tobytes() == np.asarray(wanted.heights, np.float32).tobytes()
    assert found[1:] == wanted[1:]


def test_painters_that_change_have_a_folder_of_their_own(tmp_path: Path) -> None:
    assert len(painters()) == 16
    every = [tmp_path / f"{k:016x}" for k in range(6)]
    for folder in every:
        Drawn(folder).levels("a", 1, lambda: [np.ones((1, 1, 4))])
    assert every[-1].is_dir()
    assert sum(own.is_dir() for own in every) <= 5


def test_an_atlas_keeps_within_bounds(drawn: Drawn) -> None:
    tiles = TileSet.builtin(64)
    atlas = pack(tiles, ("brick", "slate", "brick.normal"))
    assert atlas.within(1 << 30) is atlas
    half = atlas.within(atlas.pixels.nbytes // 2)
    assert half.pixels.nbytes <= atlas.pixels.nbytes // 2
    for tile in range(3):  # its largest size is the next one of the whole
        whole, own = atlas.table[tile, 1], half.table[tile, 0]
        assert own[2:].tolist() == whole[2:].tolist() == [32, 32]
        (x, y, w, h), (a, b, _, _) = whole, own
        assert (atlas.pixels[y : y + h, x : x + w] == half.pixels[b : b + h, a : a + w]).all()
    assert max(atlas.within(1 << 30, side=40).pixels.shape[:2]) <= 40
    assert atlas.within(0).pixels.nbytes <= 64
