"""The command ``town``: its files, figures, frames, and what it says of mistakes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facade_nb.cli import main
from facade_nb.render.pipeline.device import DEVICES
from facade_nb.render.pipeline.passes import BUFFERS
from facade_nb.render.town import Town

SMALL = ("town", "--buildings", "40", "--pixels", "96x64")
SQUARE = [[9.0, 47.0], [9.0002, 47.0], [9.0002, 47.0001], [9.0, 47.0001], [9.0, 47.0]]


def run(*arguments: str | Path) -> int:
    return main([str(own) for own in arguments])


def test_a_picture_its_figures_and_buffers(tmp_path: Path) -> None:
    files = tmp_path / "a.png", tmp_path / "s.json", tmp_path / "new" / "buffers"
    assert run(*SMALL, "--out", files[0], "--stats", files[1], "--buffers", files[2]) == 0
    pixels = np.asarray(Image.open(files[0]))
    assert pixels.shape == (64, 96, 3) and pixels.std() > 15
    told = json.loads(files[1].read_text())
    assert set(told["seconds"]) == {"generate", "first_frame", "frame"} and min(told["seconds"].values()) > 0
    del told["seconds"]
    assert told == Town.generate(40, 1).stats()
    assert {own.stem for own in files[2].iterdir()} == {own.name for own in BUFFERS} - {"lamp_map"}  # by day
    assert (np.asarray(Image.open(files[2] / "picture.png")) == pixels).all()


def test_every_view_hour_and_seed_is_another_picture(tmp_path: Path) -> None:
    seen = set()
    for more in (
        [],
        ["--view", "distance"],
        ["--view", "close-up"],
        ["--hour", "22"],
        ["--seed", "2"],
        ["--samples", "2"],
    ):
        assert run(*SMALL, *more, "--out", tmp_path / "a.png") == 0
        seen.add((tmp_path / "a.png").read_bytes())
    assert len(seen) == 6
    assert run(*SMALL, "--out", tmp_path / "b.png") == 0 and (tmp_path / "b.png").read_bytes() in seen


def test_frames_along_a_path(tmp_path: Path) -> None:
    place = Town.generate(40, 1).viewpoint("street")
    x, y, z = place.eye
    rows = [
        {"time": time, "eye": [x + time, y, z], "yaw": place.yaw, "pitch": 4, "angle": 60} for time in (0, 1)
    ]
    (tmp_path / "path.json").write_text(json.dumps(rows))
    options = (
        "--path",
        tmp_path / "path.json",
        "--rate",
        "3",
        "--frames",
        tmp_path / "f",
        "--animation",
        tmp_path / "a.webp",
    )
    assert run(*SMALL, *options) == 0
    names = sorted(own.name for own in (tmp_path / "f").iterdir())
    assert names == ["00000.png", "00001.png", "00002.png"]
    first, last = (np.asarray(Image.open(tmp_path / "f" / name)) for name in (names[0], names[-1]))
    assert (first != last).any()
    assert getattr(Image.open(tmp_path / "a.webp"), "n_frames", 1) == 3


def test_real_footprints(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    crossing = [SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3], SQUARE[0]]
    features = [
        {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}}
        for ring in (SQUARE, crossing)
    ]
    file = tmp_path / "two.geojson"
    file.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    assert run("town", "--footprints", file, "--pixels", "64x48", "--out", tmp_path / "a.png") == 0
    assert "Note: 1 left out:" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--buildings", "0", "--out", "a.png"], "expected a whole number from 1 to 100000; found '0'"),
        (["--buildings", "1e3", "--out", "a.png"], "expected a whole number from 1 to 100000; found '1e3'"),
        (["--view", "near", "--out", "a.png"], "invalid choice: 'near'"),
        (["--hour", "25", "--out", "a.png"], "expected an hour from 0 to 24"),
        (["--samples", "9", "--out", "a.png"], "expected a whole number from 1 to 4; found '9'"),
        ([], "nothing to write"),
        (["--frames", "f"], "--frames and --animation need a --path"),
        (["--rate", "nan", "--path", "p.json", "--frames", "f"], "expected frames a second, from 0.1 to 240"),
    ],
)
def test_mistakes_are_told(
    options: list[str],
    message: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as caught:
        run("town", *options)
    assert caught.value.code == 2 and message in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("--footprints", "[]", "GeoJSON"),
        ("--footprints", '{"type": "FeatureCollection", "features": []}', "footprint"),
        ("--path", "{", "expected a camera path"),
        ("--path", '[{"time": 0}]', "expected a list of time, eye, yaw, pitch and angle"),
    ],
)
def test_files_that_are_something_else(
    name: str, text: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "in.json"
    file.write_text(text)
    assert run("town", name, file, "--out", tmp_path / "a.png", "--pixels", "32x32") == 2
    told = capsys.readouterr().err
    assert message in told and "Traceback" not in told and not (tmp_path / "a.png").exists()


def test_a_folder_that_is_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "f").write_text("mine")
    assert run(*SMALL, "--buffers", tmp_path / "f") == 2
    assert "--buffers: expected a folder; found the file" in capsys.readouterr().err
    assert (tmp_path / "f").read_text() == "mine"


def test_no_graphics_library(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for device in DEVICES.values():
        monkeypatch.setitem(device.__dict__, "why_not", f"{device.name}: none here")
    assert run(*SMALL, "--out", tmp_path / "a.png") == 1
    assert "osmesa: none here\negl: none here" in capsys.readouterr().err
