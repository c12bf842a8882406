"""Run every bench here and print what it measures: ``python -m tests.bench [NAME ...]``.

A bench is a file ``bench_NAME.py`` with a function ``main()`` that prints a table. Each runs in a process of its
own, so that one's imports and caches do not speed up another.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def names() -> list[str]:
    """Return the names of the benches, without ``bench_``."""
    return sorted(path.stem.removeprefix("bench_") for path in HERE.glob("bench_*.py"))


def main(chosen: Sequence[str]) -> int:
    """Run some benches, or all; return 1 if one fails."""
    if unknown := sorted(set(chosen) - set(names())):
        print(f"no bench {', '.join(unknown)}: there are {', '.join(names())}", file=sys.stderr)
        return 2
    failed = []
    for name in chosen or names():
        print(f"\n== {name} ==", flush=True)
        call = f"from tests.bench import bench_{name}; bench_{name}.main()"
        if subprocess.run([sys.executable, "-c", call], cwd=ROOT).returncode:
            failed.append(name)
    if failed:
        print(f"\nfailed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
