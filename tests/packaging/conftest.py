"""The wheel and the sdist, built as a stranger would: from a clean export, where there is no Node."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import Distribution, distribution, distributions
from pathlib import Path

import pytest
from build import ProjectBuilder
from build.env import DefaultIsolatedEnv
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

Build = Callable[[str, Path, Path], Path]


@dataclass(frozen=True)
class Archive:
    """A built distribution: where it is, and the names of the files in it."""

    path: Path
    names: frozenset[str]


@pytest.fixture(scope="session")
def bare_environment(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Return an environment whose path holds no Node, no browser, nothing at all."""
    empty = tmp_path_factory.mktemp("bin")
    dropped = ("PYTHONPATH", "VIRTUAL_ENV", "DISPLAY")
    environment = {name: value for name, value in os.environ.items() if name not in dropped}
    environment["PATH"] = str(empty)
    assert shutil.which("node", path=environment["PATH"]) is None
    return environment


@pytest.fixture(scope="session")
def export(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Copy what git has or would add, as a fresh clone holds it."""
    target = tmp_path_factory.mktemp("export") / "facade_nb"
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=root,
        capture_output=True,
        check=True,
    ).stdout.decode()
    for name in filter(None, listed.split("\0")):
        if (root / name).is_file():  # a tracked file may have been removed
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root / name, target / name)
    return target


@pytest.fixture(scope="session")
def build(bare_environment: dict[str, str]) -> Iterator[Build]:
    """Build with what `pyproject.toml` asks for, in an environment of its own, which all builds here share."""
    with DefaultIsolatedEnv() as isolated:

        def run(kind: str, source: Path, out: Path) -> Path:
            builder = ProjectBuilder.from_isolated_env(isolated, source, runner=quiet)
            if kind not in prepared:
                isolated.install(builder.build_system_requires)
                isolated.install(builder.get_requires_for_build(kind))
                prepared.add(kind)
            return Path(builder.build(kind, out))

        def quiet(
            command: Sequence[str], cwd: str | None = None, more: Mapping[str, str] | None = None
        ) -> None:
            environment = bare_environment | dict(more or {})
            environment["PATH"] = bare_environment["PATH"]  # no Node here either
            done = subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True)
            assert done.returncode == 0, done.stdout + done.stderr

        prepared: set[str] = set()
        yield run


def read_wheel(path: Path) -> Archive:
    with zipfile.ZipFile(path) as archive:
        return Archive(path, frozenset(archive.namelist()))


@pytest.fixture(scope="session")
def wheel(export: Path, build: Build, tmp_path_factory: pytest.TempPathFactory) -> Archive:
    """Return the wheel built from the clean checkout."""
    return read_wheel(build("wheel", export, tmp_path_factory.mktemp("wheel")))


@pytest.fixture(scope="session")
def sdist(export: Path, build: Build, tmp_path_factory: pytest.TempPathFactory) -> Archive:
    """Return the sdist built from the clean checkout; names without the leading folder."""
    path = build("sdist", export, tmp_path_factory.mktemp("sdist"))
    with tarfile.open(path) as archive:
        names = frozenset(name.partition("/")[2] for name in archive.getnames())
    return Archive(path, names)


@pytest.fixture(scope="session")
def wheel_of_sdist(sdist: Archive, build: Build, tmp_path_factory: pytest.TempPathFactory) -> Archive:
    """Return the wheel built from the unpacked sdist."""
    source = tmp_path_factory.mktemp("unpacked")
    with tarfile.open(sdist.path) as archive:
        archive.extractall(source, filter="data")
    (folder,) = source.iterdir()
    out = tmp_path_factory.mktemp("wheel-of-sdist")
    return read_wheel(build("wheel", folder, out))


def needed(first: Distribution) -> dict[str, Distribution]:
    """All that a distribution asks for, as it is installed here: what pip would install beside it."""
    found: dict[str, Distribution] = {}
    seen = {(first.name, "")}
    waiting = [(first, "")]
    while waiting:
        one, extra = waiting.pop()
        for asked in map(Requirement, one.requires or ()):
            if asked.marker is None or asked.marker.evaluate({"extra": extra}):
                name = canonicalize_name(asked.name)
                found.setdefault(name, distribution(name))
                new = {(name, own) for own in ("", *asked.extras)} - seen
                seen |= new
                waiting += [(found[name], own) for _, own in new]
    return found


@pytest.fixture(scope="session")
def installed(
    wheel_of_sdist: Archive, bare_environment: dict[str, str], tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """Install the wheel; return the Python that has it, with what it depends on, and nothing else.

    What it depends on is linked from where it is installed already: to fetch and unpack it again takes 20 s.
    """
    folder = tmp_path_factory.mktemp("venv")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True, env=bare_environment)
    (site,) = folder.glob("lib/python*/site-packages")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "-q", "--no-compile"]
    options = ["--no-deps", "--no-index", "--target", site, wheel_of_sdist.path]
    done = subprocess.run([*pip, *options], env=bare_environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    (wheel,) = distributions(name="facade_nb", path=[str(site)])
    for own in needed(wheel).values():
        for top in {path.parts[0] for path in own.files or ()} - {"..", "__pycache__"}:
            if not (site / top).exists():  # a folder that several share
                (site / top).symlink_to(str(own.locate_file(top)))
    return folder / "bin" / "python"
