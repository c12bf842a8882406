"""Run all checks and tests, side by side where there are cores for it, and sum up at the end.

Usage: python scripts/run_tests.py [NAME ...]

Without names it runs everything in `STEPS`. Each step's output is printed as a whole when the step is over. A step
that fails does not keep the others from running; the exit status is 1 if any failed. Stopped by a signal, it ends the
steps that are still running, prints what they have printed by then, and sums up all the same. However a step ends,
no process that came of it goes on. Run with the Python of `.venv`, after scripts/setup.py.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import shutil
import signal
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from families import Family

ROOT = Path(__file__).resolve().parent.parent
BIN = ROOT / ".venv" / "bin"
TOOLS = ROOT / "node_modules" / ".bin"
PYTHON = BIN / "python"
PYTEST = (PYTHON, "-m", "pytest", "-q", "--durations=8")
CORES = os.cpu_count() or 1
NICE = ("nice", "-n", "10") if shutil.which("nice") else ()
# Processes that share the same tests have to read all of them first, each for itself, which takes ten seconds: with few
# cores the folders are taken by turns, each by one process.
THIRD = max(1, CORES // 3)
SPREAD = ("-n", str(THIRD), "--dist", "loadfile") if THIRD > 1 else ()
GRACE = 20.0  # seconds that a step has to end when it is told to
LOOK = 5.0  # seconds between looks at what a step has started


@dataclass(frozen=True)
class Step:
    """A command, and how many of the cores it is given.

    A step that is given none is in nobody's way, and nobody in its: the others give way to it (`nice`).
    """

    command: Sequence[str | Path]
    cores: int = 1


# In the order in which they are started, what takes long before the rest. The browser tests take the longest, for
# a browser and a kernel wait for each other by turns. Their clock is a hand's, and two of them side by side leave room:
# so all else runs beside them and gives way.
STEPS: dict[str, Step] = {
    "browser": Step(
        (*PYTEST, "-n", "2", "--dist", "loadfile", "--no-loadscope-reorder", "tests/browser"), cores=0
    ),
    "solver": Step((*PYTEST, *SPREAD, "tests/solver"), cores=THIRD),
    "others": Step(
        (
            *PYTEST,
            *SPREAD,
            "tests",
            *(f"--ignore=tests/{own}" for own in ("browser", "site", "solver", "render")),
        ),
        cores=THIRD,
    ),
    "render": Step((*PYTEST, *SPREAD, "tests/render"), cores=THIRD),
    "mypy": Step((BIN / "mypy",)),
    "ruff": Step((BIN / "ruff", "check")),
    "format": Step((BIN / "ruff", "format", "--check")),
    "imports": Step((BIN / "lint-imports", "--no-logo")),
    "biome": Step((TOOLS / "biome", "ci", "--colors=off", ".")),
    "tsc": Step((TOOLS / "tsc", "--noEmit")),
    "bundles": Step(("node", ROOT / "scripts" / "front.mjs", "--check")),
    "core": Step((PYTHON, ROOT / "scripts" / "core.py", "--check")),
    "vitest": Step((TOOLS / "vitest", "run")),
    "site": Step((*PYTEST, "tests/site")),
}
GROUPS: dict[str, tuple[str, ...]] = {
    "pytest": ("solver", "render", "others"),
    "check": ("ruff", "format", "mypy", "imports", "biome", "tsc", "bundles", "core"),
    "python": ("ruff", "format", "mypy", "imports", "solver", "render", "others"),
    "docs": ("site",),
    "front-end": ("biome", "tsc", "bundles", "vitest"),
}


@dataclass
class Result:
    """How a step went: its exit status, None while it is running, and the last line that it printed."""

    status: int | None
    seconds: float
    last: str

    @property
    def told(self) -> str:
        if self.status is None:
            return "STOPPED"
        return f"FAILED ({self.status})" if self.status else "passed"


class Runner:
    """Runs steps, no more at once than there are cores."""

    def __init__(self) -> None:
        self.results: dict[str, Result] = {}
        self._free = asyncio.Semaphore(CORES)
        self._environment = {**os.environ, "PATH": f"{BIN}{os.pathsep}{os.environ['PATH']}"}
        # Hundreds of processes are started, and each would have to compile what it reads.
        self._environment.pop("PYTHONDONTWRITEBYTECODE", None)
        if not sys.stdout.isatty():
            self._environment["NO_COLOR"] = "1"

    async def run(self, names: Sequence[str]) -> None:
        """Start the steps in their order, each when there is room for it, and wait for all."""
        await self._compile()
        async with asyncio.TaskGroup() as group:
            for name in names:
                for _ in range(STEPS[name].cores):
                    await self._free.acquire()
                group.create_task(self._one(name, STEPS[name]))

    async def _compile(self) -> None:
        """Compile the package once, for all that import it at once would each compile all of it."""
        command = (PYTHON, "-m", "compileall", "-q", "-j", "0", "facade_nb")
        process = await asyncio.create_subprocess_exec(*command, cwd=ROOT, env=self._environment)
        try:
            await process.wait()
        except asyncio.CancelledError:
            await _end(process, Family(process.pid))
            raise

    async def _one(self, name: str, step: Step) -> None:
        with tempfile.TemporaryFile() as out:
            start = time.monotonic()
            print(f"[test] {name} begins", flush=True)
            process = await asyncio.create_subprocess_exec(
                *(NICE if step.cores else ()),
                *map(str, step.command),
                cwd=ROOT,
                env=self._environment,
                stdin=asyncio.subprocess.DEVNULL,
                stdout=out,
                stderr=out,
                start_new_session=True,  # a signal to all is for this process to pass on
            )
            status: int | None = None
            family = Family(process.pid)
            watch = asyncio.create_task(_watch(family))
            try:
                status = await process.wait()
            except asyncio.CancelledError:
                await _end(process, family)
            watch.cancel()
            await asyncio.to_thread(family.end)
            await process.wait()
            seconds = time.monotonic() - start
            self.results[name] = Result(status, seconds, _show(name, seconds, out))
            for _ in range(step.cores):
                self._free.release()


async def _watch(family: Family) -> None:
    """Remember what a step starts: when its parents have been killed it can't be told any more whose it was."""
    while True:
        family.look()
        await asyncio.sleep(LOOK)


async def _end(process: asyncio.subprocess.Process, family: Family) -> None:
    """End a step as Ctrl+C does: pytest then sums up what it has got to."""
    family.look()
    if process.returncode is None:
        process.send_signal(signal.SIGINT)
    with contextlib.suppress(TimeoutError):
        await asyncio.wait_for(process.wait(), GRACE)


def _show(name: str, seconds: float, out: BinaryIO) -> str:
    """Print what a step has printed; return the line that it closes with."""
    out.seek(0)
    text = out.read().decode(errors="replace").strip()
    print(f"\n[test] {name}, {seconds:.1f} s\n{text}\n", flush=True)
    return text.rpartition("\n")[2].strip(" =")


async def _run(names: Sequence[str]) -> dict[str, Result]:
    runner = Runner()
    task = asyncio.create_task(runner.run(names))
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        loop.add_signal_handler(number, lambda: task.cancelling() or task.cancel())
    with contextlib.suppress(asyncio.CancelledError):
        await task
    return runner.results


def main(names: Sequence[str]) -> int:
    wanted = {step for name in names for step in GROUPS.get(name, (name,))} or set(STEPS)
    if unknown := sorted(wanted - set(STEPS)):
        print(f"expected some of {', '.join([*STEPS, *GROUPS])}, not {', '.join(unknown)}", file=sys.stderr)
        return 2
    chosen = [name for name in STEPS if name in wanted]
    start = time.monotonic()
    results = asyncio.run(_run(chosen))
    print(f"\n[test] summary, {time.monotonic() - start:.1f} s in all")
    for name in chosen:
        result = results.get(name) or Result(None, 0.0, "not begun")
        print(f"  {name:10} {result.told:12} {result.seconds:7.1f} s  {result.last}")
    failed = [name for name in chosen if name not in results or results[name].status != 0]
    print(f"[test] {'failed: ' + ', '.join(failed) if failed else 'all passed'}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
