"""Promises that the files of the set-up make to each other."""

from __future__ import annotations

import json
import re
import subprocess
import tomllib
from itertools import chain
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

TEXT = re.compile(
    r"\.(py|ts|mjs|json|toml|txt|md|ipynb|css|glsl|svg)$|^(Makefile|LICENSE|\.ci/run|\.gitignore)$"
)


@pytest.fixture(scope="module")
def project(root: Path) -> dict[str, object]:
    """Return pyproject.toml, read."""
    return tomllib.loads((root / "pyproject.toml").read_text())


def test_pins_meet_the_floors(root: Path, project: dict) -> None:
    pins = dict(
        line.split("==") for line in (root / "constraints.txt").read_text().splitlines() if "==" in line
    )
    pins = {canonicalize_name(name): version for name, version in pins.items()}
    table = project["project"]
    wanted = chain(table["dependencies"], *table["optional-dependencies"].values())
    requirements = [Requirement(text) for text in wanted if not text.startswith("facade_nb")]
    assert len(requirements) > 15
    for requirement in requirements:
        assert requirement.specifier.contains(pins[canonicalize_name(requirement.name)]), requirement


def test_lock_names_no_registry(root: Path) -> None:
    packages = json.loads((root / "package-lock.json").read_text())["packages"]
    assert not [name for name, entry in packages.items() if "resolved" in entry]
    assert all("integrity" in entry for name, entry in packages.items() if name)


def test_ci_runs_exactly_make_test(root: Path) -> None:
    script = root / ".ci" / "run"
    assert script.stat().st_mode & 0o111
    assert re.search(r"^timeout [^\n]* make test$", script.read_text(), re.MULTILINE)


def test_no_file_holds_a_path_of_this_machine(root: Path) -> None:
    """The place of the checkout, or the user's home, would be wrong everywhere else."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=root,
        capture_output=True,
        check=True,
    ).stdout.decode()
    places = [f"{root}/", f"{Path.home()}/"]
    files = [root / name for name in listed.split("\0") if TEXT.search(name) and (root / name).is_file()]
    assert files
    assert not [
        str(path.relative_to(root))
        for path in files
        if any(place in path.read_text(encoding="utf-8") for place in places)
    ]
