"""Build the solver's compiled search: facade_nb/solver/alignment/core/*.hpp and core.cpp into core.wasm beside them.

Usage: python scripts/core.py            write the module
       python scripts/core.py --check    say whether the committed module was made from these sources; build nothing
       python scripts/core.py --rebuild  say whether these sources make the committed module, byte for byte

The module is committed, so that `pip install .` needs no compiler. Its last section says what it was made from: a
digest of the sources, of the compiler's version and of its options, and one of all that stands before that section.
Comparing them takes no time, where a build on a fresh machine takes two minutes. The compiler is clang as the Python
package ziglang brings it. The linear programmes are solved by daqp's own C sources, of the version that
constraints.txt pins; pip fetches them. Run with the Python of `.venv`, after scripts/setup.py.
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
LIBRARY = ("-mexec-model=reactor", "-fno-exceptions", "-fno-rtti", "-s")
SECTION = "made-from"


def zig(*arguments: str | Path, folder: Path) -> None:
    command = [sys.executable, "-m", "ziglang", *map(str, arguments)]
    environment = {
        **os.environ,
        "ZIG_GLOBAL_CACHE_DIR": str(CACHE / "zig"),
        "ZIG_LOCAL_CACHE_DIR": str(CACHE / "zig"),
    }
    subprocess.run(command, cwd=folder, env=environment, check=True)


def pinned(package: str) -> str:
    """The version of a package that constraints.txt pins."""
    pin = re.search(rf"^{package}==(\S+)$", (ROOT / "constraints.txt").read_text(), re.MULTILINE)
    if pin is None:
        sys.exit(f"constraints.txt pins no {package}")
    return pin[1]


def daqp() -> Path:
    """The folder with daqp's C sources."""
    version = pinned("daqp")
    folder = CACHE / f"daqp-{version}"
    if not folder.is_dir():
        with tempfile.TemporaryDirectory() as place:
            fetch = ("download", "-q", "--no-deps", "--no-binary", "daqp", "-d", place, f"daqp=={version}")
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
        include = f"-I{sources / 'include'}"
        options = ("-std=c++20", *TARGET, *WARNINGS, *LIBRARY, include)
        zig("c++", *options, "-o", out, "core.cpp", *objects, folder=CORE)
        module = out.read_bytes()
        return module + made_from(module)


def made_from(module: bytes) -> bytes:
    """The custom section that says what a module was made from; it goes to the module's end."""
    sha = hashlib.sha256()
    for part in (pinned("ziglang"), pinned("daqp"), *TARGET, *WARNINGS, *LIBRARY):
        sha.update(part.encode() + b"\0")
    for source in sorted([*CORE.glob("*.hpp"), *CORE.glob("*.cpp")]):
        sha.update(source.name.encode() + b"\0" + source.read_bytes() + b"\0")
    text = f"sources {sha.hexdigest()}\nmodule {hashlib.sha256(module).hexdigest()}\n"
    body = _sized(SECTION.encode()) + text.encode()
    return b"\0" + _sized(body)


def _sized(content: bytes) -> bytes:
    """Some bytes after their number, as WebAssembly writes it: seven bits a byte, the lowest first."""
    number, head = len(content), b""
    while number > 0x7F:
        head += bytes([number & 0x7F | 0x80])
        number >>= 7
    return head + bytes([number]) + content


def is_current() -> bool:
    """Whether the committed module says that it was made from these sources, and is whole."""
    module = MODULE.read_bytes() if MODULE.is_file() else b""
    length = len(made_from(b""))
    return module.endswith(made_from(module[:-length]))


def told(module: bytes) -> str:
    return f"{len(module) / 1000:.0f} kB, sha256 {hashlib.sha256(module).hexdigest()[:12]}"


def main(options: list[str]) -> int:
    if options in (["--check"], ["--rebuild"]):
        current = is_current() if options == ["--check"] else MODULE.read_bytes() == build()
        if current:
            print(f"{MODULE.name} is up to date: {told(MODULE.read_bytes())}")
        else:
            print(f"{MODULE.name} was not made from these sources\nrun: make core")
        return 0 if current else 1
    MODULE.write_bytes(build())
    print(f"{MODULE.relative_to(ROOT)}  {told(MODULE.read_bytes())}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
