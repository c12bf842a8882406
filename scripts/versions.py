"""Choose and try the versions of Python packages, in throw-away environments.

Usage: python scripts/versions.py lock|floors

lock     install the newest versions that pyproject.toml allows and write them to constraints.txt
floors   install the oldest ones of what facade_nb and its lab need, and run the Python tests but those in the browser
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CONSTRAINTS = ROOT / "constraints.txt"
HEADER = """\
# The versions that set-up installs and CI tests, written by `make lock`. What facade_nb needs: pyproject.toml.
"""


def environment(folder: str) -> Path:
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    return Path(folder, "bin", "python")


def install(python: Path, *options: str | Path) -> None:
    pip = [python, "-m", "pip", "--disable-pip-version-check", "install", "-q", *options, "-e", ".[dev]"]
    subprocess.run(pip, cwd=ROOT, check=True)


def lock() -> int:
    with tempfile.TemporaryDirectory() as folder:
        python = environment(folder)
        install(python)
        freeze = [python, "-m", "pip", "freeze", "--exclude-editable"]
        pins = subprocess.run(freeze, capture_output=True, text=True, check=True).stdout
    CONSTRAINTS.write_text(HEADER + pins)
    print(f"{CONSTRAINTS.name}: {len(pins.splitlines())} packages")
    return 0


def floors() -> int:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    wanted = [*project["dependencies"], *project["optional-dependencies"]["lab"]]
    pins = [re.sub(">=", "==", line) for line in wanted if ">=" in line]
    with tempfile.TemporaryDirectory() as folder:
        oldest = Path(folder, "floors.txt")
        oldest.write_text("\n".join(pins) + "\n")
        python = environment(f"{folder}/venv")
        install(python, "-c", oldest)
        others = [f"--ignore=tests/{folder}" for folder in ("browser", "packaging", "site")]
        return subprocess.run([python, "-m", "pytest", "-q", "tests", *others], cwd=ROOT).returncode


if __name__ == "__main__":
    commands = {"lock": lock, "floors": floors}
    if len(sys.argv) != 2 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    sys.exit(commands[sys.argv[1]]())
