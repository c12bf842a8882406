"""The files of commands: nothing is overwritten unasked, nothing is left behind, and what is no file is kept."""

from __future__ import annotations

import argparse
import json
import os
import pty
import resource
import signal
import stat
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from itertools import combinations, cycle, product
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from facade_nb import Layout, gallery, solve
from facade_nb.cli import command_parser, main
from facade_nb.cli_files import Folder, Output, Source
from facade_nb.design.errors import DesignError
from facade_nb.design.files import NotWritten, write_atomically, write_together
from facade_nb.design.targets import locate, one_file
from tests.oracle.designs import design

COMMANDS = {
    "solve": ["house.json"],
    "infer": ["survey.json"],
    "render": ["grammar.txt", "--size", "2x2", "--pixels", "4x4", "--backend", "cpu", "--tiles", "tiles"],
    "town": ["--footprints", "town.geojson", "--path", "walk.json", "--pixels", "8x8"],
}
"""How each command is called, without its outputs, in a folder that `folder` makes."""

INPUTS = {
    "solve": ["house.json"],
    "infer": ["survey.json"],
    "render": ["grammar.txt", "tiles/wall.png", "tiles/Floor.JPG"],
    "town": ["town.geojson", "walk.json"],
}


def commands() -> dict[str, argparse.ArgumentParser]:
    """All commands there are."""
    (found,) = (a for a in command_parser()._actions if isinstance(a, argparse._SubParsersAction))
    return dict(found.choices)


def outputs(command: str) -> list[str]:
    """The options of a command that name files to write."""
    return [a.option_strings[0] for a in commands()[command]._actions if a.type is Output]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where there are inputs for every command; the working directory."""
    monkeypatch.chdir(tmp_path)
    gallery.load("figure-8").to_json(tmp_path / "house.json")
    opening = {"kind": "window", "rect": [1, 1, 2, 2]}
    facade = {"building": "1", "width": 3, "height": 3, "openings": [opening]}
    (tmp_path / "survey.json").write_text(json.dumps({"facades": [facade]}))
    (tmp_path / "grammar.txt").write_text("S -> Mat(Color, Rep:wall, 0, 0, 1, 1)")
    (tmp_path / "tiles").mkdir()
    for name in ("wall.png", "Floor.JPG"):
        Image.new("RGB", (32, 32), (10, 200, 30)).save(tmp_path / "tiles" / name)
    (tmp_path / "tiles" / "notes.txt").write_text("no tile")
    (tmp_path / "deep").mkdir()
    ring = [[9.0, 47.0], [9.0002, 47.0], [9.0002, 47.0001], [9.0, 47.0001], [9.0, 47.0]]
    (tmp_path / "town.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [ring]}))
    place = {"eye": [0, 2, 30], "yaw": 0, "pitch": 0, "angle": 60}
    (tmp_path / "walk.json").write_text(json.dumps([{"time": time, **place} for time in (0, 0.1)]))
    return tmp_path


def state(folder: Path) -> dict[str, object]:
    """All that can be told of the files of a folder."""
    found: dict[str, object] = {}
    for path in sorted(folder.rglob("*")):
        what = path.lstat()
        data: object = path.readlink() if path.is_symlink() else path.read_bytes() if path.is_file() else None
        times = () if path.is_dir() else (what.st_mtime_ns, what.st_ino)
        found[str(path.relative_to(folder))] = (what.st_mode, what.st_uid, times, data)
    return found


def run(*arguments: str | Path, **settings: object) -> subprocess.CompletedProcess[bytes]:
    """The command as a person runs it, with all the time there is: this machine may be busy."""
    patient = ["--time-limit", "600"] if arguments[0] == "solve" else []
    words = [sys.executable, "-m", "facade_nb", str(arguments[0]), *patient, *map(str, arguments[1:])]
    given = {"capture_output": True} | settings
    return subprocess.run(words, **given)  # type: ignore[call-overload, no-any-return]


def by_link(path: str) -> str:
    Path("link").symlink_to(path)
    return "link"


def by_two_links(path: str) -> str:
    Path("deep/far").symlink_to(Path(path).absolute())
    Path("link").symlink_to("deep/far")
    return "./link"


def by_hard_link(path: str) -> str:
    os.link(path, "hard")
    return "hard"


def by_linked_folder(path: str) -> str:
    Path("deep/there").symlink_to(Path(path).absolute().parent)
    return f"deep/there/{Path(path).name}"


def by_descriptor(path: str) -> str:
    return f"/dev/fd/{os.open(path, os.O_RDWR)}"


NAMES: dict[str, Callable[[str], str]] = {
    "the same": str,
    "a dot": lambda path: f"./{path}",
    "up and down": lambda path: f"deep/../{path}",
    "absolute": lambda path: str(Path(path).absolute()),
    "two slashes": lambda path: f"/{Path(path).absolute()}",
    "a link": by_link,
    "a link to a link": by_two_links,
    "a linked folder": by_linked_folder,
}
"""Other names of a file; those of `KEPT` need it to be there."""
KEPT = NAMES | {"a hard link": by_hard_link, "a descriptor": by_descriptor}


def dealt(
    these: Sequence[tuple[Any, ...]], those: Sequence[tuple[Any, ...]], each: int
) -> list[tuple[Any, ...]]:
    """All of `these`, `each` of `those` beside each of them, going round: every one of both kinds has its turn."""
    going = cycle(those)
    return [(*one, *next(going)) for one in these for _ in range(each)]


def refused(capsys: pytest.CaptureFixture[str], folder: Path, command: list[str]) -> str:
    """Run a command that is at fault: nothing is touched. Returns what it says."""
    before = state(folder)
    assert main(command) == 2
    told = capsys.readouterr()
    assert told.out == "" and "Traceback" not in told.err
    assert state(folder) == before
    return told.err


def test_every_command_says_what_it_reads_and_writes() -> None:
    """A path that is not declared is not looked at."""
    assert set(commands()) == set(COMMANDS) == set(INPUTS)
    drawn = ["--svg", "--png", "--glb", "--obj", "--dxf", "--pdf", "--cityjson", "--schedule"]
    assert outputs("solve") == ["--out", "--trace", *drawn]
    assert outputs("infer") == ["--out"]
    assert outputs("render") == ["--out", "--rules"]
    assert outputs("town") == ["--stats", "--out", "--animation"]
    for parser in commands().values():
        for action in parser._actions:
            declared = isinstance(action.type, type) and issubclass(action.type, Source | Output | Folder)
            metavar = str(action.metavar)
            assert declared == ("FILE" in metavar or "DIR" in metavar or "." in metavar), action.dest


class TestOneFile:
    @pytest.mark.parametrize(
        ("command", "output", "read", "other"),
        dealt(
            [(c, o, read) for c in COMMANDS for o in outputs(c) for read in INPUTS[c]],
            [(name,) for name in KEPT],
            each=3,
        ),
    )
    def test_input_and_output(
        self,
        command: str,
        output: str,
        read: str,
        other: str,
        folder: Path,
        capsys: pytest.CaptureFixture[str],
    ) -> None:
        """`solve house.json --out house.json` would destroy the design."""
        name = KEPT[other](read)
        told = refused(capsys, folder, [command, *COMMANDS[command], output, name])
        assert told.startswith(f"{output}: expected a file other than ") and repr(name) in told
        assert read in told or other == "a descriptor"

    @pytest.mark.parametrize(
        ("command", "first", "second", "other", "there"),
        dealt(
            [(c, *pair) for c in COMMANDS for pair in combinations(outputs(c), 2)],
            list(product(KEPT, (False, True))),
            each=1,
        ),
    )
    def test_two_outputs(
        self,
        command: str,
        first: str,
        second: str,
        other: str,
        there: bool,
        folder: Path,
        capsys: pytest.CaptureFixture[str],
    ) -> None:
        """The last would be kept, the other lost."""
        if there or other not in NAMES:
            (folder / "a").write_text("old")
        name = KEPT[other]("a")
        for one, two in (("a", name), (name, "a")):
            told = refused(capsys, folder, [command, *COMMANDS[command], second, two, first, one])
            assert told.startswith(f"{second}: expected a file other than that of {first}")

    def test_an_input_that_is_a_link(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        (folder / "link.json").symlink_to("house.json")
        refused(capsys, folder, ["solve", "link.json", "--svg", "house.json"])
        refused(capsys, folder, ["solve", "link.json", "--svg", "link.json"])

    def test_a_tile_that_is_a_link(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        Image.new("RGB", (32, 32)).save(folder / "mine.png")
        (folder / "tiles" / "roof.png").symlink_to("../mine.png")
        told = refused(capsys, folder, ["render", *COMMANDS["render"], "--out", "mine.png"])
        assert "one of the tiles" in told and "roof.png" in told

    def test_a_file_among_the_tiles_that_is_none(self, folder: Path) -> None:
        assert main(["render", *COMMANDS["render"], "--rules", "tiles/notes.txt"]) == 0
        assert main(["render", *COMMANDS["render"], "--rules", "tiles/new.npy"]) == 0

    @pytest.mark.parametrize(
        "words",
        [
            ["--svg", "-"],
            ["--svg", "/dev/stdout"],
            ["--svg", "caught"],
            ["--out", "caught", "--svg", "-"],
        ],
    )
    def test_standard_output_and_another(self, words: list[str], folder: Path) -> None:
        """Standard output is the file that it was sent to."""
        with (folder / "caught").open("wb") as caught:
            done = run(
                "solve", "house.json", *words, stdout=caught, stderr=subprocess.PIPE, capture_output=False
            )
        assert (done.returncode, (folder / "caught").read_bytes()) == (2, b"")
        assert b"expected a file other than that of --out" in done.stderr

    def test_standard_input(self, folder: Path) -> None:
        before = state(folder)
        with (folder / "house.json").open() as given:
            done = run("solve", "/dev/stdin", "--out", "house.json", stdin=given)
        assert done.returncode == 2 and b"would be lost" in done.stderr
        with (folder / "house.json").open("ab") as caught:  # >> house.json
            done = run("solve", "house.json", stdout=caught, stderr=subprocess.PIPE, capture_output=False)
        assert done.returncode == 2 and b"would be lost" in done.stderr
        assert state(folder) == before

    def test_the_null_device_may_have_everything(self, folder: Path) -> None:
        done = run("solve", "house.json", "--out", os.devnull, "--svg", os.devnull, "--glb", os.devnull)
        assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")
        assert stat.S_ISCHR(Path(os.devnull).stat().st_mode)

    def test_names_that_some_file_systems_take_for_one(
        self, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ) -> None:
        """Where there is such a file system, only making a file tells."""
        assert not one_file(locate("House.svg"), locate("house.SVG"))  # two here
        monkeypatch.setattr(
            Path,
            "exists",
            lambda path: path.name.casefold() in {file.name.casefold() for file in path.parent.iterdir()},
        )
        assert one_file(locate("House.svg"), locate("house.SVG"))
        assert not one_file(locate("House.svg"), locate("house2.SVG"))
        assert not one_file(locate("House.svg"), locate("deep/house.svg"))
        refused(capsys, folder, ["solve", "house.json", "--out", "Straße", "--svg", "STRASSE"])


NO_PLACES = [
    ("none/a", "there is no folder"),
    ("house.json/a", "Not a directory"),
    ("deep", "it is a folder"),
    ("deep/", "it is a folder"),
    (".", "it is a folder"),
    ("new/", "this is how a folder is written"),
    ("", "expected the name of a file; found none"),
    ("/proc/a", "No such file"),  # no one may make files there
    ("/dev/fd/987", "Bad file descriptor"),
    ("loop", "Too many levels of symbolic links"),
    ("lost", "there is no folder"),
    ("a" * 300, "File name too long"),
]
"""Names under which nothing can be written, and what is told of them."""


class TestPlaces:
    """What cannot be written is told before anything is computed."""

    @pytest.fixture(autouse=True)
    def nothing_is_computed(self, monkeypatch: pytest.MonkeyPatch) -> None:
        def refuse(*_: object, **__: object) -> None:
            raise AssertionError("computed")

        monkeypatch.setattr("facade_nb.cli.solve", refuse)
        monkeypatch.setattr("facade_nb.render.texture.picture.render_texture", refuse)
        monkeypatch.setattr("facade_nb.render.texture.picture.rules_seen", refuse)
        monkeypatch.setattr("facade_nb.cli_town._town", refuse)

    @pytest.mark.parametrize(
        ("command", "output", "name", "reason"),
        dealt([(c, o) for c in COMMANDS for o in outputs(c)], NO_PLACES, each=5),
    )
    def test_no_place(
        self,
        command: str,
        output: str,
        name: str,
        reason: str,
        folder: Path,
        capsys: pytest.CaptureFixture[str],
    ) -> None:
        (folder / "loop").symlink_to("loop")
        (folder / "lost").symlink_to("none/a")
        others = [text for o in outputs(command) if o != output for text in (o, f"old{o}")]
        for other in others[1::2]:
            (folder / other).write_text("old")
        told = refused(capsys, folder, [command, *COMMANDS[command], *others, output, name])
        assert reason in told and "cannot write this file" in told

    def test_a_file_that_is_write_protected(
        self, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ) -> None:
        """The superuser may write everything, so the refusal is staged."""
        (folder / "a").write_text("old")
        monkeypatch.setattr(os, "access", lambda path, mode: False)
        assert "it is write-protected" in refused(capsys, folder, ["solve", "house.json", "--out", "a"])

    def test_a_descriptor_for_reading(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        number = os.open("house.json", os.O_RDONLY)
        (folder / "b.json").write_bytes((folder / "house.json").read_bytes())
        told = refused(capsys, folder, ["solve", "b.json", "--out", f"/dev/fd/{number}"])
        assert "it is open for reading only" in told

    def test_no_standard_output(self, folder: Path) -> None:
        done = run(
            "solve",
            "house.json",
            capture_output=False,
            stderr=subprocess.PIPE,
            preexec_fn=lambda: os.close(1),
        )
        assert done.returncode == 2
        assert done.stderr == b"--out: standard output: cannot be written: Bad file descriptor\n"


class TestFolders:
    TOWN = ("town", "--footprints", "town.geojson", "--pixels", "8x8")

    @pytest.mark.parametrize(
        ("words", "message"),
        [
            (["--buffers", "house.json"], "--buffers: expected a folder; found the file"),
            (["--buffers", "house.json/deep"], "--buffers: expected a folder; found the file"),
            (["--buffers", ""], "--buffers: expected the name of a folder; found none"),
            (["--buffers", "."], "--buffers: expected a folder without that of --footprints ('town.geojson') in it"),
            (["--buffers", "deep", "--out", "deep/a.png"], "--buffers: expected a folder without that of --out"),
            (["--buffers", "new", "--path", "walk.json", "--frames", "./new"], "--frames: expected a folder without"),
            (["--buffers", "loop"], "--buffers: cannot be a folder: "),
            (["--buffers", "/proc/none"], "--buffers: "),
        ],
    )  # fmt: skip
    def test_no_place(
        self, words: list[str], message: str, folder: Path, capsys: pytest.CaptureFixture[str],
        monkeypatch: pytest.MonkeyPatch,
    ) -> None:  # fmt: skip
        (folder / "loop").symlink_to("loop")
        monkeypatch.setattr("facade_nb.cli_town._town", None)
        if words[1].startswith("/proc"):  # the superuser may write anywhere but there
            monkeypatch.setattr(os, "access", lambda *_: False)
        assert message in refused(capsys, folder, [*self.TOWN, *words])

    def test_is_made_with_those_around_it(self, folder: Path) -> None:
        assert main([*self.TOWN, "--buffers", "new/deep"]) == 0
        assert (folder / "new" / "deep" / "picture.png").is_file()


class TestKept:
    def test_a_link_and_the_permissions_of_its_file(self, folder: Path) -> None:
        (folder / "deep" / "layout.json").write_text("old")
        (folder / "deep" / "layout.json").chmod(0o640)
        (folder / "link").symlink_to("deep/layout.json")
        (folder / "far").symlink_to("link")
        assert main(["solve", "house.json", "--out", "far"]) == 0
        assert str(Path("far").readlink()) == "link" and str(Path("link").readlink()) == "deep/layout.json"
        assert json.loads(Path("deep/layout.json").read_text("utf-8"))["format"] == "facade-nb/layout/1"
        assert stat.S_IMODE(Path("deep/layout.json").stat().st_mode) == 0o640
        assert not list(folder.rglob("*.tmp"))

    def test_a_link_to_a_file_that_is_not_there_yet(self, folder: Path) -> None:
        (folder / "link").symlink_to("deep/layout.json")
        assert main(["solve", "house.json", "--out", "link"]) == 0
        assert str(Path("link").readlink()) == "deep/layout.json" and Path("deep/layout.json").is_file()

    def test_other_names_of_an_old_file(self, folder: Path) -> None:
        """What was kept under another name is not asked for."""
        (folder / "a").write_text("old")
        os.link("a", "kept")
        assert main(["solve", "house.json", "--out", "a"]) == 0
        assert Path("kept").read_text() == "old"

    def test_a_new_file_has_the_permissions_that_are_usual(self, folder: Path) -> None:
        (folder / "usual").touch()
        assert main(["solve", "house.json", "--out", "new"]) == 0
        assert Path("new").stat().st_mode == Path("usual").stat().st_mode

    def test_a_name_as_long_as_can_be(self, folder: Path) -> None:
        name = "東" * 85
        write_atomically(name, "text")
        assert Path(name).read_text() == "text"


class TestStreams:
    """Devices, pipes and descriptors are written into."""

    def test_a_named_pipe(self, folder: Path) -> None:
        os.mkfifo("pipe")
        got: list[bytes] = []
        there: list[bool] = []

        def listen() -> None:
            got.append(Path("pipe").read_bytes())
            there.append(Path("a.svg").exists())

        thread = threading.Thread(target=listen)
        thread.start()
        assert main(["solve", "house.json", "--out", "pipe", "--svg", "a.svg"]) == 0
        thread.join()
        assert Layout.from_dict(json.loads(got[0])) == solve(gallery.load("figure-8"))
        assert there == [True]  # who reads a pipe to its end finds the files
        assert stat.S_ISFIFO(Path("pipe").stat().st_mode)

    def test_a_device(self, folder: Path) -> None:
        """A terminal."""
        control, terminal = pty.openpty()
        try:
            write_together([(os.ttyname(terminal), "text")])
            assert os.read(control, 100) == b"text"
            assert (
                main(["solve", os.ttyname(terminal), "--out", os.ttyname(terminal), "--svg", "none/a"]) == 2
            )
        finally:
            os.close(control)
            os.close(terminal)

    @pytest.mark.parametrize("name", ["-", "/dev/stdout", "link", None])
    def test_standard_output(self, name: str | None, folder: Path) -> None:
        """A file behind it goes on where it was, as of `{ echo a; facade-nb solve …; echo b; } > file`."""
        (folder / "link").symlink_to("/dev/stdout")
        with (folder / "caught").open("wb") as caught:
            caught.write(b"a\n")
            caught.flush()
            words = [] if name is None else ["--out", name]
            done = run(
                "solve", "house.json", *words, stdout=caught, stderr=subprocess.PIPE, capture_output=False
            )
            caught.write(b"b\n")
        assert (done.returncode, done.stderr) == (0, b"")
        data = (folder / "caught").read_bytes()
        assert data[:2] == b"a\n" and data[-2:] == b"b\n"
        assert json.loads(data[2:-2])["format"] == "facade-nb/layout/1"

    @pytest.mark.parametrize("number", [1, 2, 70])
    def test_descriptors_by_name(self, number: int, folder: Path) -> None:
        os.dup2(2, 70)
        (folder / "link").symlink_to(f"/dev/fd/{number}")
        (folder / "far").symlink_to("link")
        (folder / "fds").symlink_to("/proc/self/fd")
        places = ("/dev/fd", "/proc/self/fd", "/proc/thread-self/fd", "fds", "//dev/fd/../fd")
        for name in ("link", "./far", *(f"{place}/{number}" for place in places)):
            assert locate(name).descriptor == number and locate(name).is_stream
        os.close(70)
        (folder / "70").touch()
        assert locate("70").descriptor is None and not locate("70").is_stream

    def test_a_picture_to_standard_output(self, folder: Path) -> None:
        done = run("render", *COMMANDS["render"], "--out", "-")
        assert done.returncode == 0 and done.stdout[:8] == b"\x89PNG\r\n\x1a\n"
        assert not (folder / "-").exists()

    def test_a_pipe_that_asks_not_to_wait(self) -> None:
        reading, writing = os.pipe()
        os.set_blocking(writing, False)
        got: list[bytes] = []

        def listen() -> None:
            time.sleep(0.2)
            with os.fdopen(reading, "rb") as pipe:
                got.append(pipe.read())

        thread = threading.Thread(target=listen)
        thread.start()
        write_together([(writing, b"x" * 300_000)])
        os.close(writing)
        thread.join()
        assert got == [b"x" * 300_000]

    def test_documents_too(self, folder: Path) -> None:
        """Whatever is written by the library is written like that."""
        os.mkfifo("pipe")
        got: list[bytes] = []
        thread = threading.Thread(target=lambda: got.append(Path("pipe").read_bytes()))
        thread.start()
        text = gallery.load("figure-8").to_json("pipe")
        thread.join()
        assert got == [text.encode() + b"\n"]


class TestFull:
    """A disk without room, a reader that went away."""

    @pytest.mark.parametrize("words", [[], ["--out", "/dev/full"]])
    def test_a_full_disk(self, words: list[str], folder: Path) -> None:
        (folder / "a.svg").write_text("old")
        before = state(folder)
        with Path("/dev/full").open("wb") as full:
            done = run(
                "solve", "house.json", *words, "--svg", "a.svg",
                stdout=full, stderr=subprocess.PIPE, capture_output=False,
            )  # fmt: skip
        assert done.returncode == 1
        assert done.stderr.count(b"\n") == 1 and b"No space left on device" in done.stderr
        assert state(folder) == before

    def test_a_file_that_gets_too_large(self, folder: Path) -> None:
        for name in ("a.png", "a.npy"):
            (folder / name).write_text("old")
        before = state(folder)

        def limit() -> None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))

        words = [*COMMANDS["render"], "--pixels", "40x40", "--out", "a.png", "--rules", "a.npy"]
        done = run("render", *words, preexec_fn=limit)
        assert done.returncode == 1
        assert done.stderr == b"a.npy: cannot write this file: File too large\n"
        assert state(folder) == before

    def test_help_on_a_full_disk(self) -> None:
        with Path("/dev/full").open("wb") as full:
            done = run("solve", "--help", stdout=full, stderr=subprocess.PIPE, capture_output=False)
        assert done.returncode == 1
        assert done.stderr == b"standard output: cannot be written: No space left on device\n"

    def test_no_room_for_messages(self, folder: Path) -> None:
        with Path("/dev/full").open("wb") as full:
            assert run("solve", "none.json", stderr=full, stdout=full, capture_output=False).returncode == 2

    def test_a_closed_pipe(self, folder: Path) -> None:
        reading, writing = os.pipe()
        os.close(reading)
        done = run(
            "solve", "house.json", "--svg", "a.svg",
            stdout=writing, stderr=subprocess.PIPE, capture_output=False,
        )  # fmt: skip
        os.close(writing)
        assert done.returncode == 141
        assert (
            done.stderr
            == b"standard output: cannot be written: it was closed before everything was written\n"
        )
        assert (folder / "a.svg").read_bytes().startswith(b"<svg")  # the files are there all the same
        assert not list(folder.rglob("*.tmp"))

    def test_the_library_says_so(self, folder: Path) -> None:
        with pytest.raises(NotWritten, match="/dev/full: cannot write this file: No space left on device"):
            write_together([("a", "text"), ("/dev/full", "text")])
        assert not (folder / "a").exists()
        with pytest.raises(DesignError, match="there is no folder"):
            write_together([("a", "text"), ("none/a", "text")])
        assert not (folder / "a").exists()


class TestSignals:
    @pytest.fixture
    def busy(self, folder: Path) -> Iterator[Callable[..., subprocess.Popen[bytes]]]:
        """Start a command that waits in the midst of writing, for a reader of its pipe."""
        os.mkfifo("pipe")
        started: list[subprocess.Popen[bytes]] = []

        def start(**settings: object) -> subprocess.Popen[bytes]:
            words = [
                sys.executable,
                "-m",
                "facade_nb",
                "solve",
                "house.json",
                "--out",
                "pipe",
                "--svg",
                "a.svg",
                "--time-limit",
                "600",
            ]
            process: subprocess.Popen[bytes] = subprocess.Popen(words, stderr=subprocess.PIPE, **settings)  # type: ignore[call-overload]
            started.append(process)
            while not list(folder.glob("*.tmp")) and process.poll() is None:
                time.sleep(0.01)
            return process

        yield start
        for process in started:
            process.kill()
            process.wait()
            assert process.stderr is not None
            process.stderr.close()

    @pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
    def test_nothing_is_left_behind(
        self, number: signal.Signals, folder: Path, busy: Callable[..., subprocess.Popen[bytes]]
    ) -> None:
        (folder / "a.svg").write_text("old")
        # What runs in the background of a script has SIGINT ignored, and leaves that to its children.
        process = busy(preexec_fn=lambda: signal.signal(number, signal.SIG_DFL))
        process.send_signal(number)
        _, told = process.communicate()
        assert (process.returncode, told) == (128 + number, b"Stopped.\n")
        assert not list(folder.rglob("*.tmp"))
        assert (folder / "a.svg").read_text() == "old"

    def test_a_signal_that_is_to_be_ignored(
        self, folder: Path, busy: Callable[..., subprocess.Popen[bytes]]
    ) -> None:
        """`nohup facade-nb …`"""
        process = busy(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.send_signal(signal.SIGHUP)
        assert json.loads((folder / "pipe").read_bytes())["format"] == "facade-nb/layout/1"
        assert process.wait() == 0 and (folder / "a.svg").is_file()

    def test_handlers_are_given_back(self, folder: Path) -> None:
        before = [signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)]
        assert main(["solve", "house.json", "--out", "a"]) == 0
        assert [signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)] == before


def test_without_a_layout_the_trace_is_written_like_that(folder: Path) -> None:
    design({"A": 9.0}, {"wall": "A"}, ["wall"]).to_json("hopeless.json")
    done = run("solve", "hopeless.json", "--trace", "-", "--out", "a")
    assert done.returncode == 3 and json.loads(done.stdout)["format"] == "facade-nb/trace/1"
    assert not (folder / "a").exists()
