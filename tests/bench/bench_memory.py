"""How much memory a kernel takes while a design is edited: resident at most, and addresses reserved at most.

A script of random edits (seeded) goes through the widgets' model, as a person's would: sizes, the canvas, counters,
letters of patterns, flags, layers, and undo. Each design has a process of its own. *Idle* is the process before the
first solve. Then the same with no more addresses than a hub's user may have (``ulimit -v``): nothing may fail for
want of them. *Python*: solves that went on with the search in Python, as no memory was left for the compiled one.
"""

from __future__ import annotations

import argparse
import json
import random
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

from .designs import LARGE, line_of

__all__ = ["edited", "main", "peaks"]

ROOT = Path(__file__).resolve().parent.parent.parent
EDITS = 100
MORE = {"teaser": 300}
LIMITS: tuple[int | None, ...] = (None, 3_000_000, 1_500_000)
"""KiB of addresses, as ``ulimit -v`` takes them."""


def main(seed: int = 1, seconds: float = 2.0) -> None:
    """Print the table; each solve has so many seconds."""
    heads = ("design", "edits", "ulimit -v", "idle MB", "peak MB", "addresses", "errors", "in Python", "s")
    widths = (-16, 6, 11, 8, 8, 10, 7, 10, 7)
    print(line_of(list(zip(heads, widths, strict=True))))
    for name in LARGE:
        for limit in LIMITS if name in MORE else LIMITS[:1]:
            own = peaks(name, MORE.get(name, EDITS), seed, seconds, limit)
            cells = (
                name,
                str(own["edits"]),
                "" if limit is None else str(limit),
                *(f"{own[key]:.0f}" for key in ("idle", "resident", "addresses")),
                str(own["errors"]),
                str(own["python"]),
                f"{own['seconds']:.0f}",
            )
            print(line_of(list(zip(cells, widths, strict=True))), flush=True)


def peaks(name: str, edits: int, seed: int, seconds: float, limit: int | None = None) -> dict[str, float]:
    """What a process of its own takes, in MB, with no more than `limit` KiB of addresses."""
    code = f"from tests.bench import bench_memory; bench_memory.edited({name!r}, {edits}, {seed}, {seconds})"
    command = [sys.executable, "-c", code]
    if limit is not None:
        command = ["sh", "-c", f'ulimit -v {limit}; exec "$@"', "sh", *command]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{name}: the process ended with {done.returncode}: {done.stderr[-2000:]}")
    answer: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return answer


def edited(name: str, edits: int, seed: int, seconds: float) -> None:
    """Edit a design of the gallery in this process; print what it took as JSON."""
    from facade_nb import DesignError, gallery
    from facade_nb.widgets.studio.model import FacadeModel

    idle, begin = _status()["VmRSS"], time.perf_counter()
    model = FacadeModel(gallery.load(name), time_limit=seconds)
    draw = random.Random(seed)
    start, errors, done, python = model.design, 0, 0, 0
    while done < edits:
        try:
            design = _change(model, draw)
        except DesignError:
            continue
        if design is model.design:
            continue
        done += 1
        model.edit(design)
        errors += model.trouble is not None
        python += any("Python" in text for text in (model.layout.warnings if model.layout else ()))
        if draw.random() < 0.1:  # a mistake, taken back
            model.undo()
    while model.can_undo:
        model.undo()
        errors += model.trouble is not None
        if model.design == start:
            break
    now = _status()
    told = {
        "idle": idle,
        "resident": now["VmHWM"],
        "addresses": now["VmPeak"],
        "edits": done,
        "errors": errors,
        "python": python,
        "seconds": time.perf_counter() - begin,
    }
    print(json.dumps(told))


def _change(model: object, draw: random.Random) -> object:
    """The model's design with one thing changed."""
    from facade_nb.design import Design, edit
    from facade_nb.widgets.studio.model import FacadeModel

    assert isinstance(model, FacadeModel)
    now = model.design
    names = [name for name, own in now.symbols.items() if own.size is not None]

    def size() -> Design:
        name = draw.choice(names)
        return edit.with_symbol(
            now, name, size=round((now.symbols[name].size or 1) * draw.uniform(0.6, 1.7), 2)
        )

    def canvas() -> Design:
        if draw.random() < 0.5:
            return edit.with_canvas(now, width=round(now.canvas.width * draw.uniform(0.8, 1.25), 1))
        return edit.with_canvas(now, height=round(now.canvas.height * draw.uniform(0.8, 1.25), 1))

    def flag() -> Design:
        name = draw.choice(names)
        key = draw.choice(("opaque", "attached", "unoccludable"))
        return edit.with_symbol(now, name, **{key: not getattr(now.symbols[name], key)})

    def counter() -> Design:
        used = sorted({c for own in now.patterns.values() for c in own.parsed.counters})
        if not used:
            return now
        value = draw.choice((None, None, 0, 1, 2, 3))
        return edit.with_counter(now, draw.choice(used), value=value)

    def letter() -> Design:
        name = draw.choice(list(now.patterns))
        text = now.patterns[name].text
        at = draw.choice([k for k, sign in enumerate(text) if sign in names] or [0])
        return edit.with_pattern(now, name, text=text[:at] + draw.choice(names) + text[at + 1 :])

    def layer() -> Design:
        own = draw.choice(now.layers)
        return edit.with_layer(now, own.name, visible=not own.visible)

    ways: list[Callable[[], Design]] = [size, canvas, flag, counter, letter, layer]
    return draw.choices(ways, weights=(45, 15, 8, 12, 10, 10))[0]()


def _status() -> dict[str, float]:
    """Sizes of this process, in MB."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return {
        key: float(own.split()[0]) / 1024
        for key, own in (line.split(":", 1) for line in lines)
        if key in ("VmRSS", "VmHWM", "VmPeak")
    }


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=2.0, help="for a solve")
    given = parser.parse_args()
    main(given.seed, given.seconds)
