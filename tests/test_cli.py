"""``python -m facade_nb solve``: what it writes, what it says, and how it ends."""

from __future__ import annotations

import json
import os
import struct
import subprocess
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from xml.etree import ElementTree

import pytest

from facade_nb import Layout, gallery, render, solve
from facade_nb.cli import main
from facade_nb.solver import Trace
from facade_nb.solver.events import NoLayoutFound
from tests.oracle.designs import design

KINDS = ["out", "trace", "svg", "glb"]
BROKEN = {
    "nothing": b"",
    "not JSON": b'{"format": "facade-nb/design/1", ]',
    "a list": b"[]",
    "another format": b'{"format": "facade-nb/layout/1"}',
    "not UTF-8": b'{"name": "\xff"}',
    "a text": b'"house"',
    "nested too deeply": b"[" * 100_000,
    "a faulty pattern": b'{"format": "facade-nb/design/1", "patterns": {"wall": "A(BA"}}',
    "NaN": b'{"format": "facade-nb/design/1", "canvas": {"width": NaN}}',
    "a lone surrogate": b'{"format": "facade-nb/design/1", "name": "\\ud800"}',
}


def run(*arguments: str | Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """The command as a person runs it, with all the time there is: this machine may be busy."""
    patient = ["--time-limit", "600"] if arguments[0] == "solve" else []
    return subprocess.run(
        [sys.executable, "-m", "facade_nb", str(arguments[0]), *patient, *map(str, arguments[1:])],
        capture_output=True,
        text=True,
        encoding="utf-8",
        env=os.environ | environment,
    )


@pytest.fixture
def house(tmp_path: Path) -> Path:
    """A file with a design that has a layout."""
    path = tmp_path / "house.json"
    gallery.load("residential-house").to_json(path)
    return path


@pytest.fixture
def hopeless(tmp_path: Path) -> Path:
    """A file with a design that has none."""
    path = tmp_path / "hopeless.json"
    design({"A": 9.0}, {"wall": "A"}, ["wall"]).to_json(path)
    return path


def outputs(folder: Path, kinds: Sequence[str] = KINDS) -> list[str]:
    """Arguments that ask for every output."""
    return [text for kind in kinds for text in (f"--{kind}", str(folder / f"old.{kind}"))]


def told(capsys: pytest.CaptureFixture[str]) -> str:
    """What was said on stderr; nothing was said on stdout, and nothing looks like a traceback."""
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "Traceback" not in captured.err and '.py"' not in captured.err
    return captured.err


class TestDone:
    def test_layout_goes_to_stdout(self, house: Path) -> None:
        done = run("solve", house)
        assert done.returncode == 0
        assert Layout.from_dict(json.loads(done.stdout)) == solve(gallery.load("residential-house"))

    def test_files(self, house: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        assert main(["solve", str(house), *outputs(tmp_path)]) == 0
        assert capsys.readouterr().out == ""
        layout = Layout.from_dict(json.loads((tmp_path / "old.out").read_text("utf-8")))
        assert layout == solve(gallery.load("residential-house"))
        trace = json.loads((tmp_path / "old.trace").read_text("utf-8"))
        assert trace["format"] == "facade-nb/trace/1"
        assert {"WordJudged", "CandidateJudged", "SystemSolved"} <= {
            event["event"] for event in trace["events"]
        }
        root = ElementTree.fromstring((tmp_path / "old.svg").read_bytes())
        assert root.tag == "{http://www.w3.org/2000/svg}svg"
        assert {path.name for path in tmp_path.iterdir()} == {
            "house.json",
            *(f"old.{kind}" for kind in KINDS),
        }

    def test_glb_is_binary_gltf(self, house: Path, tmp_path: Path) -> None:
        assert main(["solve", str(house), *outputs(tmp_path, ["out", "glb"])]) == 0
        data = (tmp_path / "old.glb").read_bytes()
        magic, version, length = struct.unpack("<4sII", data[:12])
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack("<I4s", data[12:20])
        assert kind == b"JSON"
        assert json.loads(data[20 : 20 + size])["meshes"]

    def test_png_is_a_picture(
        self, house: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ) -> None:
        """Some backend always can: the CPU needs no graphics library. A large picture would take long."""
        small = partial(render.render_png, size=(320, 200), samples=1, rays=4)
        monkeypatch.setattr(render, "render_png", small)
        picture = tmp_path / "house.png"
        done = main(["solve", str(house), "--png", str(picture), "--out", str(tmp_path / "layout.json")])
        assert done == 0, told(capsys)
        data = picture.read_bytes()
        assert data[:8] == b"\x89PNG\r\n\x1a\n" and data[-8:-4] == b"IEND"
        width, height = struct.unpack(">II", data[16:24])
        assert (width, height) == (320, 200)

    def test_notes_go_to_stderr(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        path = tmp_path / "hole.json"
        design({"A": 4.0}, {"wall": {"text": "A", "hidden": ["A"]}}, ["wall"]).to_json(path)
        assert main(["solve", str(path)]) == 0
        captured = capsys.readouterr()
        assert captured.err.startswith("Note: ") and "hole" in captured.err
        assert json.loads(captured.out)["holes"] == [[0.0, 0.0, 4.0, 2.0]]

    def test_an_empty_design(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        path = tmp_path / "empty.json"
        path.write_text('{"format": "facade-nb/design/1"}', "utf-8")
        assert main(["solve", str(path), *outputs(tmp_path)]) == 0
        assert told(capsys) == ""
        assert json.loads((tmp_path / "old.out").read_text("utf-8"))["shapes"] == []

    def test_names_of_any_script(self, tmp_path: Path) -> None:
        """In the document, in the file's name, and where the terminal knows ASCII alone."""
        one = design({"Δ": 1.0}, {"Fassade Süd": "Δ^k"}, ["Fassade Süd"], name="Haus Nr. 5 – 東京")
        path, out = tmp_path / "façade 東.json", tmp_path / "läyout.json"
        one.to_json(path)
        done = run("solve", path, "--out", out)
        assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
        assert json.loads(out.read_text("utf-8"))["name"] == "Haus Nr. 5 – 東京"
        for environment in (
            {"PYTHONIOENCODING": "ascii"},
            {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"},
        ):
            done = run("solve", path, **environment)
            assert done.returncode == 0, done.stderr
            assert json.loads(done.stdout)["name"] == "Haus Nr. 5 – 東京"

    def test_replaces_what_was_there(self, house: Path, tmp_path: Path) -> None:
        (tmp_path / "old.out").write_text("old")
        assert main(["solve", str(house), *outputs(tmp_path, ["out"])]) == 0
        assert json.loads((tmp_path / "old.out").read_text("utf-8"))["format"] == "facade-nb/layout/1"


class TestInputAtFault:
    """Exit status 2, and no output file touched."""

    @pytest.fixture(autouse=True)
    def old_files(self, tmp_path: Path) -> None:
        """Outputs that are there already."""
        for kind in KINDS:
            (tmp_path / f"old.{kind}").write_text(f"old {kind}")

    @staticmethod
    def untouched(folder: Path) -> None:
        for kind in KINDS:
            assert (folder / f"old.{kind}").read_text() == f"old {kind}"
        assert not [path for path in folder.iterdir() if path.name.endswith(".tmp")]

    @pytest.mark.parametrize("kind", BROKEN)
    def test_content(self, kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        path = tmp_path / "broken.json"
        path.write_bytes(BROKEN[kind])
        assert main(["solve", str(path), *outputs(tmp_path)]) == 2
        assert told(capsys).strip()
        self.untouched(tmp_path)

    def test_faults_have_their_place(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        path = tmp_path / "broken.json"
        path.write_bytes(BROKEN["a faulty pattern"])
        assert main(["solve", str(path)]) == 2
        text = told(capsys)
        assert "patterns.wall, line 1, column 2" in text and text.splitlines()[-1].strip() == "^"

    def test_no_such_file(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        assert main(["solve", str(tmp_path / "missing.json"), *outputs(tmp_path)]) == 2
        assert "missing.json" in told(capsys)
        self.untouched(tmp_path)

    def test_a_folder(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        assert main(["solve", str(tmp_path), *outputs(tmp_path)]) == 2
        assert str(tmp_path) in told(capsys)
        self.untouched(tmp_path)

    def test_a_path_that_looks_like_json(self, capsys: pytest.CaptureFixture[str]) -> None:
        """An argument is a path, whatever it looks like."""
        assert main(["solve", '{"format": "facade-nb/design/1"}']) == 2
        assert "cannot be read as a file" in told(capsys)

    def test_a_file_that_may_not_be_read(
        self, house: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """The superuser may read everything, so the refusal is staged."""

        def refuse(self: Path, *_: object, **__: object) -> str:
            raise PermissionError(13, "Permission denied", str(self))

        monkeypatch.setattr(Path, "read_text", refuse)
        assert main(["solve", str(house), *outputs(tmp_path)]) == 2
        assert "Permission denied" in told(capsys)
        monkeypatch.undo()
        self.untouched(tmp_path)

    @pytest.mark.parametrize("kind", KINDS)
    def test_an_output_in_a_missing_folder(
        self, kind: str, house: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        """Whichever output it is, the others stay as they were."""
        others = outputs(tmp_path, [other for other in KINDS if other != kind])
        lost = tmp_path / "missing" / "file"
        assert main(["solve", str(house), *others, f"--{kind}", str(lost)]) == 2
        assert str(lost) in told(capsys)
        assert not lost.parent.exists()
        self.untouched(tmp_path)

    def test_an_output_that_is_a_folder(
        self, house: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        assert main(["solve", str(house), *outputs(tmp_path, ["out"]), "--svg", str(tmp_path)]) == 2
        assert "it is a folder" in told(capsys)
        self.untouched(tmp_path)

    def test_a_pattern_that_never_ends(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        path = tmp_path / "long.json"
        document = design({"A": 1.0}, {"wall": "A^k"}, ["wall"], counters={"k": {"min": 3}}).to_dict()
        document["counters"]["k"]["min"] = 10**8
        path.write_text(json.dumps(document))
        assert main(["solve", str(path), *outputs(tmp_path)]) == 2
        assert "counters.k.min" in told(capsys)
        self.untouched(tmp_path)

    @pytest.mark.parametrize(
        "arguments",
        [[], ["solve"], ["solve", "a", "b"], ["solve", "a", "--time-limit", "soon"], ["build", "a"]],
    )
    def test_arguments(self, arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
        with pytest.raises(SystemExit) as caught:
            main(arguments)
        assert caught.value.code == 2
        assert "usage:" in told(capsys)

    @pytest.mark.parametrize("limit", ["nan", "-1"])
    def test_time_limits_that_mean_nothing(self, limit: str, house: Path, tmp_path: Path) -> None:
        done = run("solve", house, f"--time-limit={limit}", *outputs(tmp_path))
        assert done.returncode == 2, done.stderr
        assert "Traceback" not in done.stderr
        self.untouched(tmp_path)


class TestNoLayout:
    def test_exit_status_and_reason(
        self, hopeless: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ) -> None:
        for kind in KINDS:
            (tmp_path / f"old.{kind}").write_text("old")
        assert main(["solve", str(hopeless), *outputs(tmp_path)]) == 3
        assert told(capsys).startswith("No layout: Pattern 'wall': its shortest word, A, measures 9 m")
        assert all((tmp_path / f"old.{kind}").read_text() == "old" for kind in KINDS if kind != "trace")

    def test_the_trace_says_what_was_tried(self, hopeless: Path, tmp_path: Path) -> None:
        file = tmp_path / "trace.json"
        assert main(["solve", str(hopeless), f"--trace={file}"]) == 3
        (none,) = Trace.from_json(file).of_kind(NoLayoutFound)
        assert none.message.startswith("Pattern 'wall': its shortest word, A, measures 9 m")

    def test_as_a_command(self, hopeless: Path) -> None:
        done = run("solve", hopeless)
        assert (done.returncode, done.stdout) == (3, "")
        assert "Traceback" not in done.stderr and done.stderr.count("\n") == 1

    def test_out_of_time(self, house: Path, capsys: pytest.CaptureFixture[str]) -> None:
        from facade_nb.solver import solution as solving

        solving.forget()
        assert main(["solve", str(house), "--time-limit", "0"]) == 3
        assert "Out of time after" in told(capsys)


def test_help_and_version() -> None:
    done = run("solve", "--help")
    assert done.returncode == 0 and all(f"--{kind}" in done.stdout for kind in [*KINDS, "png"])
    assert run("--version").stdout.startswith("facade_nb ")


def test_a_closed_pipe(house: Path) -> None:
    """``… solve house.json | head -1``"""
    command = f'"{sys.executable}" -m facade_nb solve "{house}" | head -1'
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True)
    assert done.stdout == "{\n" and "Traceback" not in done.stderr
