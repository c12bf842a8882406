"""Recipes of CONTRIBUTING.md and docs/visible.md are followed; the picture of the house is that of the contracts."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
HEADING = re.compile(r"^#{2,3} ", re.MULTILINE)
TOOLS = ("package.json", "tsconfig.json", "scripts/front.mjs")


@dataclass(frozen=True)
class Recipe:
    """What a section says to change, and the lines that pass then."""

    title: str
    patch: str
    check: str


def recipes(page: str) -> list[Recipe]:
    found = []
    for section in HEADING.split((ROOT / page).read_text("utf-8")):
        patches = re.findall(r"^```diff\n(.*?)^```", section, re.DOTALL | re.MULTILINE)
        checks = re.findall(r"^```python check\n(.*?)^```", section, re.DOTALL | re.MULTILINE)
        assert len(patches) == len(checks) <= 1, section.partition("\n")[0]
        found += [Recipe(section.partition("\n")[0], patches[0], checks[0]) for _ in patches]
    return found


RECIPES = [*recipes("CONTRIBUTING.md"), *recipes("docs/visible.md")]


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a copy of the package and of what builds its front end."""
    target = tmp_path_factory.mktemp("contributing")
    command = ["git", "ls-files", "-z", "--", "facade_nb", *TOOLS]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, check=True, text=True).stdout
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target / name)
    (target / "node_modules").symlink_to(ROOT / "node_modules")
    return target


def run(copy: Path, *command: str, given: str = "") -> subprocess.CompletedProcess[str]:
    """Run a command in the copy, with the copy's package and none of a repository around it."""
    environment = {
        **os.environ,
        "PYTHONPATH": str(copy),
        "GIT_CEILING_DIRECTORIES": str(copy.parent),
        "PYTHONDONTWRITEBYTECODE": "1",  # files change within a second, and are as long as before
    }
    return subprocess.run(command, cwd=copy, env=environment, input=given, capture_output=True, text=True)


def follow(copy: Path, recipe: Recipe, *options: str) -> None:
    done = run(copy, "git", "apply", *options, "-", given=recipe.patch)
    assert done.returncode == 0, done.stderr


def test_there_is_a_recipe_for_each_kind() -> None:
    kinds = ["A reflection mode of counts", "A shape", "A material", "A texture operator", "Adding a view"]
    assert [recipe.title for recipe in RECIPES] == kinds


@pytest.mark.parametrize("recipe", RECIPES, ids=lambda recipe: recipe.title)
def test_a_recipe_works_and_is_needed(copy: Path, recipe: Recipe) -> None:
    before = run(copy, sys.executable, "-c", recipe.check)
    assert before.returncode == 1, "it passes without the change"
    follow(copy, recipe)
    try:
        after = run(copy, sys.executable, "-c", recipe.check)
        assert after.returncode == 0, after.stderr
        if ".ts\n" in recipe.patch:
            bundled(copy, recipe)
    finally:
        follow(copy, recipe, "--reverse")


def bundled(copy: Path, recipe: Recipe) -> None:
    """The front end with the change: its types are right, and its bundle and styles have what was added."""
    [title] = re.findall(r'^\+ +subtitle: "(.+)"', recipe.patch, re.MULTILINE)
    [style] = re.findall(r"^\+\.(fnb-[a-z]+) \{", recipe.patch, re.MULTILINE)
    static = copy / "facade_nb" / "widgets" / "static"
    assert title not in (static / "solver.js").read_text("utf-8")
    for command in (["node_modules/.bin/tsc", "--noEmit"], ["node", "scripts/front.mjs"]):
        done = run(copy, *command)
        assert done.returncode == 0, done.stdout + done.stderr
    assert title in (static / "solver.js").read_text("utf-8")
    assert style in (static / "solver.css").read_text("utf-8")


def test_the_picture_of_the_house_is_that_of_the_contracts() -> None:
    lines = [line for line in (ROOT / "CONTRIBUTING.md").read_text("utf-8").splitlines() if " ◄─ " in line]
    drawn = [[set(room.split(", ")) for room in line.split(" ◄─ ")] for line in lines]
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    layers = {c["containers"][0]: c["layers"] for c in contracts if c["type"] == "layers"}
    assert drawn == [
        [set(re.findall(r"\w+", layer)) for layer in reversed(layers[container])]
        for container in ("facade_nb", "facade_nb.solver")
    ]
