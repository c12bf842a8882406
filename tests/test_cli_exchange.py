"""``python -m facade_nb solve`` and the files for other programs: what is written, and that it is all or nothing."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import ezdxf
import pytest

from facade_nb import gallery, solve
from facade_nb.cli import main
from facade_nb.render import to_cityjson, to_obj, to_pdf, to_schedule

FILES = {
    "--obj": "a.obj",
    "--dxf": "a.dxf",
    "--pdf": "a.pdf",
    "--cityjson": "a.city.json",
    "--schedule": "a.csv",
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    gallery.load("figure-8").to_json(tmp_path / "design.json")
    return tmp_path


def all_of(**changed: str) -> list[str]:
    names = FILES | {f"--{key}": value for key, value in changed.items()}
    return [
        "solve",
        "design.json",
        "--out",
        "layout.json",
        *(word for pair in names.items() for word in pair),
    ]


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_all_files_at_once_in_feet(folder: Path) -> None:
    assert main([*all_of(), "--units", "ft"]) == 0
    assert names(folder) == {"design.json", "layout.json", "a.mtl", *FILES.values()}
    layout = solve(gallery.load("figure-8"))
    assert (folder / "a.csv").read_text() == to_schedule(layout)
    assert (folder / "a.city.json").read_text() == to_cityjson(layout)
    assert ((folder / "a.obj").read_text(), (folder / "a.mtl").read_text()) == to_obj(layout, "a.mtl")
    assert (folder / "a.pdf").read_bytes() == to_pdf(layout, "ft")
    dimensions = ezdxf.readfile(folder / "a.dxf").modelspace().query("DIMENSION")
    assert "39'-4 1/2\"" in {dimension.dxf.text for dimension in dimensions}  # 12 m


@pytest.mark.parametrize("option", FILES)
def test_where_one_cannot_be_written_none_is(
    option: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(all_of(**{option[2:]: "missing/file"})) == 2
    assert capsys.readouterr().err.startswith(f"{option}: ")
    assert names(folder) == {"design.json"}


def test_the_materials_are_an_output_too(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "a.mtl").write_bytes((folder / "design.json").read_bytes())
    assert main(["solve", "a.mtl", "--out", "layout.json", "--obj", "a.obj"]) == 2
    assert "--obj (its materials): expected a file other than the design" in capsys.readouterr().err
    assert main(["solve", "design.json", "--out", "a.mtl", "--obj", "a.obj"]) == 2
    assert main(["solve", "design.json", "--out", "layout.json", "--svg", "./a.mtl", "--obj", "a.obj"]) == 2
    assert (folder / "a.mtl").read_bytes() == (folder / "design.json").read_bytes()
    assert names(folder) == {"design.json", "a.mtl"}


def test_a_design_that_cannot_be_drawn(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = (folder / "design.json").read_text().replace('"box"', '"bax"').replace('"window"', '"widnow"')
    (folder / "design.json").write_text(text)
    assert main(all_of()) == 2
    told = capsys.readouterr().err
    assert "in layer" in told and "did you mean" in told and "Traceback" not in told
    assert names(folder) == {"design.json"}


def test_an_obj_on_standard_output_calls_for_no_materials(folder: Path) -> None:
    words = [sys.executable, "-m", "facade_nb", "solve", "design.json", "--out", "layout.json", "--obj", "-"]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert done.stdout == to_obj(solve(gallery.load("figure-8")))[0]
    assert names(folder) == {"design.json", "layout.json"}


def test_the_libraries_are_loaded_when_a_file_is_made() -> None:
    code = (
        "import sys, facade_nb, facade_nb.render, facade_nb.cli\n"
        "heavy = {'ezdxf', 'reportlab', 'shapely', 'pandas', 'trimesh', 'fontTools', 'PIL'} & set(sys.modules)\n"
        "assert not heavy, heavy\n"
        "import facade_nb.widgets.studio.parts\n"
        "assert 'scipy.cluster' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
