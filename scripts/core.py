"""Build the solver's compiled search: facade_nb/solver/alignment/core/*.hpp and core.cpp into core.wasm beside them.

Usage: python scripts/core.py          write the module
       python scripts/core.py --check  say whether the committed module is what the sources make; write nothing

The module is committed, so that `pip install .` needs no compiler. The compiler is clang as the Python package
ziglang brings it. The linear programmes are solved by daqp's own C sources, of the version that constraints.txt
pins; pip fetches them. Run with the Python of `.venv`, after scripts/setup.py.
"""

from __future__ import annotations

import hashlib
import os
import re
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CORE = ROOT / "facade_nb" / "solver" / "alignment" / "core"
MODULE = CORE / "core.wasm"
CACHE = ROOT / ".venv" / "core"
TARGET = (
    "-target",
    "wasm32-wasi",
    "-mcpu=generic+bulk_memory+nontrapping_fptoint+sign_ext",
    "-O3",
    "-DNDEBUG",
)
WARNINGS = ("-Wall", "-Wextra", "-Werror", "-Wno-invalid-offsetof")


def zig(*arguments: str | Path, folder: Path) -> None:
    command = [sys.executable, "-m", "ziglang", *map(str, arguments)]
    environment = {
        **os.environ,
        "ZIG_GLOBAL_CACHE_DIR": str(CACHE / "zig"),
        "ZIG_LOCAL_CACHE_DIR": str(CACHE / "zig"),
    }
    subprocess.run(command, cwd=folder, env=environment, check=True)


def daqp() -> Path:
    """The folder with daqp's C sources."""
    pin = re.search(r"^daqp==(\S+)$", (ROOT / "constraints.txt").read_text(), re.MULTILINE)
    if pin is None:
        sys.exit("constraints.txt pins no daqp")
    folder = CACHE / f"daqp-{pin[1]}"
    if not folder.is_dir():
        with tempfile.TemporaryDirectory() as place:
            fetch = ("download", "-q", "--no-deps", "--no-binary", "daqp", "-d", place, f"daqp=={pin[1]}")
            subprocess.run([sys.executable, "-m", "pip", "--disable-pip-version-check", *fetch], check=True)
            (archive,) = Path(place).glob("daqp-*.tar.gz")
            with tarfile.open(archive) as sources:
                sources.extractall(CACHE, filter="data")
    return folder / "csrc"


def build() -> bytes:
    """The module, made without any name of this machine in it."""
    sources = daqp()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        for source in sorted((sources / "src").glob("*.c")):
            zig(
                "cc",
                "-c",
                *TARGET,
                f"-I{sources / 'include'}",
                "-o",
                folder / f"{source.stem}.o",
                source,
                folder=CORE,
            )
        out = folder / MODULE.name
        objects = sorted(folder.glob("*.o"))
        library = ("-mexec-model=reactor", "-fno-exceptions", "-fno-rtti", "-s", f"-I{sources / 'include'}")
        zig("c++", "-std=c++20", *TARGET, *WARNINGS, *library, "-o", out, "core.cpp", *objects, folder=CORE)
        return out.read_bytes()


def main(options: list[str]) -> int:
    module = build()
    size = f"{len(module) / 1000:.0f} kB, sha256 {hashlib.sha256(module).hexdigest()[:12]}"
    if options == ["--check"]:
        current = MODULE.is_file() and MODULE.read_bytes() == module
        print(
            f"{MODULE.name} is up to date: {size}"
            if current
            else f"{MODULE.name} is stale ({size})\nrun: make core"
        )
        return 0 if current else 1
    MODULE.write_bytes(module)
    print(f"{MODULE.relative_to(ROOT)}  {size}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
