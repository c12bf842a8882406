"""What the wheel and the sdist hold, and that an installed wheel works by itself."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from .conftest import Archive

# What a person gets with `pip install facade_nb`: these, whatever else is installed with it.
DATA = {
    "front end": ("facade_nb/widgets/static/", ".js"),
    "styles": ("facade_nb/widgets/static/", ".css"),
    "gallery": ("facade_nb/gallery/", ".json"),
    "compiled search": ("facade_nb/solver/alignment/core/", ".wasm"),
    "licence of what is compiled in": ("facade_nb/solver/alignment/core/", ".txt"),
    "solutions of exercises": ("facade_nb/course/solutions/", ".md"),
}
NOT_FOR_USERS = ("facade_nb/widgets/src/", "facade_nb/widgets/test/")
SOURCES = (".hpp", ".cpp")


def files_below(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def package_files(export: Path) -> set[str]:
    return {
        name
        for name in files_below(export)
        if name.startswith("facade_nb/") and not name.startswith(NOT_FOR_USERS) and not name.endswith(SOURCES)
    }


def test_wheel_holds_the_package_and_nothing_else(export: Path, wheel: Archive) -> None:
    content = {name for name in wheel.names if ".dist-info/" not in name}
    assert content == package_files(export)
    assert "facade_nb/py.typed" in content
    assert any(name.endswith(".dist-info/licenses/LICENSE") for name in wheel.names)


@pytest.mark.parametrize("what", DATA)
def test_wheel_holds_data(wheel: Archive, what: str) -> None:
    folder, ending = DATA[what]
    assert any(name.startswith(folder) and name.endswith(ending) for name in wheel.names)


def test_every_front_end_source_has_a_bundle(export: Path, wheel: Archive) -> None:
    entries = {path.stem for path in (export / "facade_nb/widgets/src/entry").glob("*.ts")}
    bundles = {Path(name).stem for name in wheel.names if name.endswith(".js")}
    assert entries
    assert entries == bundles


def test_sdist_holds_sources_of_the_front_end_too(export: Path, sdist: Archive) -> None:
    sources = {name for name in files_below(export) if name.startswith("facade_nb/")}
    assert sources <= sdist.names
    assert {"LICENSE", "README.md", "pyproject.toml", "scripts/front.mjs", "package.json"} <= sdist.names
    assert not [name for name in sdist.names if name.startswith(("node_modules", ".venv"))]


def test_sdist_builds_the_same_wheel_without_node(wheel: Archive, wheel_of_sdist: Archive) -> None:
    assert wheel.names == wheel_of_sdist.names


HOUSE = """
import json, sys
import facade_nb
from facade_nb import gallery, solve
from facade_nb.render import elevation_svg

layout = solve(gallery.load("residential-house"))
svg = elevation_svg(layout)
print(json.dumps({
    "file": facade_nb.__file__,
    "names": gallery.names(),
    "shapes": len(layout.shapes),
    "svg": svg,
    "modules": sorted({name.partition(".")[0] for name in sys.modules}),
}))
"""

WIDGETS = """
import importlib, json, pkgutil
import anywidget
import facade_nb.widgets as widgets

for module in pkgutil.iter_modules(widgets.__path__, widgets.__name__ + "."):
    importlib.import_module(module.name)

def subclasses(cls):
    for sub in cls.__subclasses__():
        yield sub
        yield from subclasses(sub)

bundles = {}
for cls in subclasses(anywidget.AnyWidget):
    if cls.__module__.startswith("facade_nb"):
        bundles[cls.__name__] = len(str(getattr(cls, "_esm", "")))
print(json.dumps(bundles))
"""


def run(python: Path, code: str, folder: Path, environment: dict[str, str]) -> dict[str, object]:
    """Run code as a stranger would, outside any checkout; return the JSON it prints."""
    done = subprocess.run([python, "-c", code], cwd=folder, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)
    assert isinstance(answer, dict)
    return answer


def test_installed_wheel_solves_and_draws_without_gl(
    installed: Path, tmp_path: Path, bare_environment: dict[str, str]
) -> None:
    answer = run(installed, HOUSE, tmp_path, bare_environment)
    assert Path(str(answer["file"])).is_relative_to(installed.parent.parent)
    assert "residential-house" in answer["names"]
    assert answer["shapes"] > 0
    assert str(answer["svg"]).lstrip().startswith("<svg")
    loaded = {"moderngl", "playwright", "pythreejs"} & set(answer["modules"])
    assert not loaded


def test_installed_command_solves(installed: Path, tmp_path: Path, bare_environment: dict[str, str]) -> None:
    export = "from facade_nb import gallery; print(gallery.load('residential-house').to_json())"
    design = subprocess.run([installed, "-c", export], env=bare_environment, capture_output=True, check=True)
    (tmp_path / "house.json").write_bytes(design.stdout)
    command = [
        installed,
        "-m",
        "facade_nb",
        "solve",
        "house.json",
        "--out",
        "layout.json",
        "--svg",
        "house.svg",
    ]
    done = subprocess.run(command, cwd=tmp_path, env=bare_environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "layout.json").read_text())
    assert "<svg" in (tmp_path / "house.svg").read_text()


def test_installed_widgets_find_their_front_end(
    installed: Path, tmp_path: Path, bare_environment: dict[str, str]
) -> None:
    bundles = run(installed, WIDGETS, tmp_path, bare_environment)
    assert bundles
    assert all(bundles.values()), f"without a front end: {bundles}"
