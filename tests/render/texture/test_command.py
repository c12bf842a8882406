"""``python -m facade_nb render``: what it writes, what it says, and how it ends."""

from __future__ import annotations

import io
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from facade_nb.cli import main
from facade_nb.render import Grammar
from facade_nb.render.texture import Sight, rules_seen
from facade_nb.render.texture.picture import texture_pixels

from .figure_12 import FIGURE_12

TEXT = """
S -> SplitX(Abs, 1, Red, Rel, 1, Up)
Up -> SplitY(Rel, 1, Green, Rel, 1, None)
Red -> Mat(Color, 0, 1, 0, 0, 1)
Green -> Mat(Color, 0, 0, 1, 0, 0.5)
None -> Skip(0)
"""


@pytest.fixture
def grammar(tmp_path: Path) -> Path:
    path = tmp_path / "grammar.txt"
    path.write_text(TEXT, "utf-8")
    return path


def render(grammar: Path, *arguments: str | Path) -> int:
    words = [str(word) for word in arguments]
    if "--backend" not in words:
        words += ["--backend", "cpu"]
    return main(["render", str(grammar), *words])


class TestDone:
    def test_picture_and_rules(
        self, grammar: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        out, rules = tmp_path / "a.png", tmp_path / "a.npy"
        assert render(grammar, "--size", "4x2", "--pixels", "8x4", "--out", out, "--rules", rules) == 0
        assert capsys.readouterr() == ("", "")
        image = np.asarray(Image.open(out))
        assert image.shape == (4, 8, 4)
        assert image[3, 0].tolist() == [255, 0, 0, 255]
        assert image[3, 7].tolist() == [0, 255, 0, 128]  # at the bottom: row 0 is at the top
        assert image[0, 7].tolist() == [0, 0, 0, 0]
        found = np.load(rules)
        assert found.dtype == np.int32 and found.shape == (4, 8)
        assert found.tolist() == [[2, 2, -1, -1, -1, -1, -1, -1]] * 2 + [[2, 2, 3, 3, 3, 3, 3, 3]] * 2
        assert {path.name for path in tmp_path.iterdir()} == {"grammar.txt", "a.png", "a.npy"}

    def test_figure_12(self, tmp_path: Path) -> None:
        """As a command, with the tiles that ship, and as `Grammar.evaluate` has it."""
        path, rules = tmp_path / "12.txt", tmp_path / "12.npy"
        path.write_text(FIGURE_12)
        assert render(path, "--size", "12x9", "--pixels", "120x90", "--seed", "-3,2.5", "--rules", rules) == 0
        x, y = np.meshgrid((np.arange(120) + 0.5) / 10, 9 - (np.arange(90) + 0.5) / 10)
        points = np.stack([x.ravel(), y.ravel()], axis=1)
        surface = Grammar.parse(FIGURE_12).evaluate(points, (12, 9), seed=(-3, 2.5))
        assert (np.load(rules).ravel() == surface.rule).all()
        assert (surface.color[:, 3] > 0.999).all()

    def test_a_start_rule(self, grammar: Path, tmp_path: Path) -> None:
        rules = tmp_path / "a.npy"
        assert render(grammar, "--size", "4x2", "--pixels", "2x2", "--start", "Up", "--rules", rules) == 0
        assert np.load(rules).tolist() == [[-1, -1], [3, 3]]

    def test_an_eye(self, grammar: Path, tmp_path: Path) -> None:
        rules = tmp_path / "a.npy"
        arguments = [
            "--size",
            "4x2",
            "--pixels",
            "40x40",
            "--rules",
            rules,
            "--eye",
            "0.5,1,2",
            "--target",
            "0.5,1",
        ]
        assert render(grammar, *arguments) == 0
        seen = np.load(rules)
        reach = 2 * np.tan(np.radians(25))  # half of what is seen, metres
        left = (0.5 - 0) / reach * 20
        assert (seen[20] == 2).sum() == pytest.approx(2 * left, abs=1)
        assert seen[20, 19] == 2 and seen[20, 0] == -1 and seen[25, 39] == 3

    @pytest.mark.parametrize("backend", ["cpu", "osmesa"])
    def test_a_picture_wider_than_a_graphics_card_draws(
        self, backend: str, grammar: Path, tmp_path: Path
    ) -> None:
        out, rules = tmp_path / "a.png", tmp_path / "a.npy"
        words = ["--size", "4x2", "--pixels", "20000x2", "--backend", backend, "--out", out, "--rules", rules]
        assert render(grammar, *words) == 0
        assert np.load(rules)[1].tolist() == [2] * 5000 + [3] * 15000
        image = np.asarray(Image.open(out))
        assert image[1, [0, 4999, 5000, 19999]].tolist() == [[255, 0, 0, 255]] * 2 + [[0, 255, 0, 128]] * 2

    @pytest.mark.parametrize("backend", ["cpu", "osmesa"])
    @pytest.mark.parametrize("camera", [None, Sight.from_eye((1, 1.5, 3), (0, 1), (4, 2), (61, 43), 80)])
    def test_a_picture_in_parts_is_the_picture(
        self, backend: str, camera: Sight | None, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        from facade_nb.render.texture import picture

        given = {"size": (4.0, 2.0), "pixels": (61, 43), "camera": camera, "backend": backend}
        whole, rules = texture_pixels(Grammar.parse(TEXT), **given), rules_seen(Grammar.parse(TEXT), **given)
        monkeypatch.setattr(picture, "_PART_PIXELS", 300)
        monkeypatch.setattr(picture, "_PART_SIDE", 29)
        assert (texture_pixels(Grammar.parse(TEXT), **given) == whole).all()
        assert (rules_seen(Grammar.parse(TEXT), **given) == rules).all()

    def test_signs_of_numbers(self, grammar: Path, tmp_path: Path) -> None:
        words = ["--size", "4x2", "--pixels", "2x2", "--seed", "-.5,-1", "--out", tmp_path / "a.png"]
        assert render(grammar, *words) == 0

    def test_tiles_of_a_folder(self, tmp_path: Path) -> None:
        folder = tmp_path / "tiles"
        folder.mkdir()
        Image.new("RGB", (32, 32), (10, 200, 30)).save(folder / "my-wall.png")
        path, out = tmp_path / "g.txt", tmp_path / "a.png"
        path.write_text("S -> Mat(Color, Rep:my-wall, 0, 0, 1, 1)")
        assert render(path, "--size", "2x2", "--pixels", "4x4", "--tiles", folder, "--out", out) == 0
        assert np.asarray(Image.open(out))[1, 1].tolist() == [10, 200, 30, 255]


class TestInputAtFault:
    @pytest.mark.parametrize(
        ("content", "message"),
        [
            (
                b"S -> Layer(Wal)\nWall -> Skip(0)",
                "line 1, column 12: there is no rule 'Wal'; did you mean 'Wall'?",
            ),
            (
                b"S -> Mat(Color, Fit:windw1, 0, 0, 1, 1)",
                "there is no tile 'windw1'; did you mean 'window1'?",
            ),
            (b"S -> \xff", "cannot be read as a grammar: it is not text in UTF-8"),
            (b"", "expected at least one rule"),
        ],
    )
    def test_content(
        self, content: bytes, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        path, out, rules = tmp_path / "g.txt", tmp_path / "a.png", tmp_path / "a.npy"
        for file, data in ((path, content), (out, b"old"), (rules, b"old")):
            file.write_bytes(data)
        assert render(path, "--size", "2x2", "--out", out, "--rules", rules) == 2
        error = capsys.readouterr().err
        assert str(path) in error and message in error and "Traceback" not in error
        assert out.read_bytes() == rules.read_bytes() == b"old"
        assert len(list(tmp_path.iterdir())) == 3

    def test_missing_files_and_names(
        self, grammar: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        out = tmp_path / "a.png"
        assert render(tmp_path / "none.txt", "--size", "2x2", "--out", out) == 2
        assert "none.txt: cannot be read as a grammar" in capsys.readouterr().err
        assert render(grammar, "--size", "2x2", "--out", out, "--start", "Upp") == 2
        assert "there is no rule 'Upp'; did you mean 'Up'?" in capsys.readouterr().err
        assert render(grammar, "--size", "2x2", "--out", out, "--tiles", tmp_path / "none") == 2
        assert "none" in capsys.readouterr().err
        assert render(grammar, "--size", "2x2", "--out", tmp_path / "no" / "a.png") == 2
        assert "cannot write this file" in capsys.readouterr().err
        assert not out.exists()

    def test_one_output_that_cannot_be_written_keeps_the_other_back(
        self, grammar: Path, tmp_path: Path
    ) -> None:
        out = tmp_path / "a.png"
        assert render(grammar, "--size", "2x2", "--out", out, "--rules", tmp_path / "no" / "a.npy") == 2
        assert not out.exists()

    @pytest.mark.parametrize(
        "words",
        [
            ["--out", "a.png"],
            ["--size", "12", "--out", "a.png"],
            ["--size", "0x9", "--out", "a.png"],
            ["--size", "-12x9", "--out", "a.png"],
            ["--size", "nanx9", "--out", "a.png"],
            ["--size", "12x9", "--pixels", "8.5x6", "--out", "a.png"],
            ["--size", "12x9", "--pixels", "99999x99999", "--out", "a.png"],
            ["--size", "12x9", "--seed", "1", "--out", "a.png"],
            ["--size", "12x9", "--backend", "gpu", "--out", "a.png"],
            ["--size", "12x9", "--eye", "1,2,-3", "--out", "a.png"],
            ["--size", "12x9"],
        ],
    )
    def test_arguments(self, words: list[str], grammar: Path, capsys: pytest.CaptureFixture[str]) -> None:
        with pytest.raises(SystemExit) as caught:
            main(["render", str(grammar), *words])
        assert caught.value.code == 2
        assert "usage:" in capsys.readouterr().err


def test_as_a_command(grammar: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "facade_nb", "render", str(grammar), "--size", "4x2", "--out", "/dev/full/x"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2 and "Traceback" not in done.stderr and "cannot write this file" in done.stderr


def test_the_picture_is_not_multiplied_by_alpha() -> None:
    from facade_nb.render.texture.picture import render_texture

    data = render_texture(
        Grammar.parse("S -> Mat(Color, 0, 1, 0.5, 0, 0.25)"), size=(1, 1), pixels=(2, 2), backend="cpu"
    )
    assert np.asarray(Image.open(io.BytesIO(data)))[0, 0].tolist() == [255, 128, 0, 64]
