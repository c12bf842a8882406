"""Run all checks and tests, one after the other, and sum up at the end.

Usage: python scripts/run_tests.py [NAME ...]

Without names it runs everything in `STEPS`. A step that fails does not keep the later ones from running; the exit
status is 1 if any failed. Run with the Python of `.venv`, after scripts/setup.py.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BIN = ROOT / ".venv" / "bin"
TOOLS = ROOT / "node_modules" / ".bin"
PYTHON = BIN / "python"
PYTEST = (PYTHON, "-m", "pytest", "-q", "--durations=8")

# The browser tests start servers and a browser of their own, so they run alone; the rest shares the cores.
STEPS: dict[str, Sequence[str | Path]] = {
    "ruff": (BIN / "ruff", "check"),
    "format": (BIN / "ruff", "format", "--check"),
    "mypy": (BIN / "mypy",),
    "imports": (BIN / "lint-imports", "--no-logo"),
    "biome": (TOOLS / "biome", "ci", "--colors=off", "."),
    "tsc": (TOOLS / "tsc", "--noEmit"),
    "bundles": ("node", ROOT / "scripts" / "front.mjs", "--check"),
    "core": (PYTHON, ROOT / "scripts" / "core.py", "--check"),
    "vitest": (TOOLS / "vitest", "run"),
    "pytest": (*PYTEST, "-n", "auto", "--dist", "loadfile", "tests", "--ignore=tests/browser"),
    "browser": (*PYTEST, "tests/browser"),
}
GROUPS = {
    "check": ("ruff", "format", "mypy", "imports", "biome", "tsc", "bundles", "core"),
    "python": ("ruff", "format", "mypy", "imports", "pytest"),
    "front-end": ("biome", "tsc", "bundles", "vitest"),
}


def main(names: Sequence[str]) -> int:
    chosen = [step for name in names for step in GROUPS.get(name, (name,))] or list(STEPS)
    if unknown := [name for name in chosen if name not in STEPS]:
        print(f"expected some of {', '.join([*STEPS, *GROUPS])}, not {', '.join(unknown)}", file=sys.stderr)
        return 2
    environment = {**os.environ, "PATH": f"{BIN}{os.pathsep}{os.environ['PATH']}"}
    if not sys.stdout.isatty():
        environment["NO_COLOR"] = "1"
    results = []
    for name in chosen:
        print(f"\n[test] {name}", flush=True)
        start = time.monotonic()
        status = subprocess.run(
            list(map(str, STEPS[name])), cwd=ROOT, env=environment, stdin=subprocess.DEVNULL
        )
        results.append((name, status.returncode, time.monotonic() - start))
    print("\n[test] summary")
    for name, status, seconds in results:
        print(f"  {name:10} {'passed' if status == 0 else f'FAILED ({status})':12} {seconds:7.1f} s")
    failed = [name for name, status, _ in results if status]
    print(f"[test] {'failed: ' + ', '.join(failed) if failed else 'all passed'}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
