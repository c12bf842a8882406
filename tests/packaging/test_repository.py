"""Promises that the files of the set-up make to each other."""

from __future__ import annotations

import json
import re
import subprocess
import tomllib
from itertools import chain
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import facade_nb

TEXT = re.compile(
    r"\.(py|ts|mjs|json|toml|txt|md|ipynb|css|glsl|svg|cff|yaml)$|^(Makefile|LICENSE|\.ci/run|\.gitignore)$"
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


def test_the_citation_names_this_version_and_both_papers(root: Path) -> None:
    """The keys are those that version 1.2.0 of the Citation File Format asks for."""
    citation = yaml.safe_load((root / "CITATION.cff").read_text("utf-8"))
    assert {"cff-version", "message", "title", "authors"} <= citation.keys()
    assert citation["cff-version"] == "1.2.0"
    assert (citation["title"], citation["version"]) == ("facade_nb", facade_nb.__version__)
    readme = " ".join((root / "README.md").read_text("utf-8").split())
    assert len(citation["references"]) == 2
    for paper in citation["references"]:
        assert {"type", "title", "authors", "year"} <= paper.keys()
        assert f"*{paper['title']}*" in readme
        assert all(author["family-names"] and author["given-names"] for author in paper["authors"])


def test_before_a_commit_the_checks_run(root: Path) -> None:
    [repository] = yaml.safe_load((root / ".pre-commit-config.yaml").read_text("utf-8"))["repos"]
    assert [hook["entry"] for hook in repository["hooks"]] == ["make check"]


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md"])
def test_what_a_page_links_to_is_there(root: Path, page: str) -> None:
    links = re.findall(r"\]\((?!https?:)([^)#]+)", (root / page).read_text("utf-8"))
    assert len(links) > 3
    assert not [link for link in links if not (root / link).exists()]


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
