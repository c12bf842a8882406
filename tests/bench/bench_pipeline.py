"""The deferred pipeline on a town: what each pass takes, and how many texels its grammar reads."""

from __future__ import annotations

import time
from collections import defaultdict
from dataclasses import replace
from typing import Literal

import numpy as np

from facade_nb.render.pipeline.device import DEVICES
from facade_nb.render.pipeline.frame import Frame
from facade_nb.render.pipeline.passes import PASSES
from facade_nb.render.pipeline.renderer import Renderer, renderer_of
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.town import Town

from .designs import line_of

__all__ = ["main"]

BUILDINGS = 20_000
PIXELS = (1024, 768)
View = Literal["street", "distance", "close-up"]
VIEWS: tuple[View, ...] = ("street", "distance", "close-up")
HOUR = 14.5
RUNS = 7
GOAL = 250.0
"""Milliseconds of wall time for the street, on two quiet cores."""


def main() -> None:
    """Print a table for each device."""
    begin = time.perf_counter()
    town = Town.generate(BUILDINGS, 1)
    print(
        f"{BUILDINGS} buildings, generated in {time.perf_counter() - begin:.1f} s; {PIXELS[0]} × {PIXELS[1]}."
    )
    print(
        f"Least of {RUNS} frames, each pass waited for (ms). CPU: of all threads. Maps of shadows are kept."
    )
    counting = [
        replace(own, defines=(*own.defines, "COUNT_FETCHES")) if own.name == "grammar" else own
        for own in PASSES
    ]
    for name, device in DEVICES.items():
        if not device.available:
            print(f"\n{name}: {device.why_not}")
            continue
        print(f"\n{name}: {device.renderer}")
        frames = {view: _frame(town, view) for view in VIEWS}
        with renderer_of(town.scene, device) as renderer:
            taken = {view: _passes(renderer, frame) for view, frame in frames.items()}
            whole = {view: _whole(renderer, frame) for view, frame in frames.items()}
        with renderer_of(town.scene, device, passes=counting) as renderer:
            fetches = {view: _fetches(renderer, frame) for view, frame in frames.items()}
        widths = (-12, *(10 for _ in range(2 * len(VIEWS))))
        heads = ["pass", *(head for view in VIEWS for head in (view, "CPU"))]
        print(line_of(list(zip(heads, widths, strict=True))))
        for own in (own for own in PASSES if own.name in taken["street"]):  # others need lamps
            cells = [f"{1000 * value:.0f}" for view in VIEWS for value in taken[view][own.name]]
            print(line_of(list(zip([own.name, *cells], widths, strict=True))))
        cells = [
            f"{1000 * sum(column):.0f}"
            for view in VIEWS
            for column in zip(*taken[view].values(), strict=True)
        ]
        print(line_of(list(zip(["all", *cells], widths, strict=True))))
        cells = [f"{1000 * value:.0f}" for view in VIEWS for value in whole[view]]
        print(line_of(list(zip(["in one go", *cells], widths, strict=True))))
        cells = [cell for view in VIEWS for cell in (f"{fetches[view]:.1f}", "")]
        print(line_of(list(zip(["texels", *cells], widths, strict=True))))
        print(
            f"street in one go: {1000 * whole['street'][0]:.0f} ms; goal under {GOAL:.0f} on two quiet cores"
        )


def _frame(town: Town, view: View) -> Frame:
    return Frame(town.scene, town.viewpoint(view).frustum(PIXELS), Daytime.at(HOUR), PIXELS)


def _passes(renderer: Renderer, frame: Frame) -> dict[str, tuple[float, float]]:
    """Least seconds of each pass: wall time, CPU time."""
    wall: dict[str, list[float]] = defaultdict(list)
    spent: dict[str, list[float]] = defaultdict(list)
    for run in range(RUNS + 1):
        last = [time.process_time()]

        def told(name: str, seconds: float, last: list[float] = last, first: bool = run == 0) -> None:
            now = time.process_time()
            if not first:
                wall[name].append(seconds)
                spent[name].append(now - last[0])
            last[0] = now

        renderer.draw(frame, ("picture",), told)
    return {name: (min(wall[name]), min(spent[name])) for name in wall}


def _whole(renderer: Renderer, frame: Frame) -> tuple[float, float]:
    """Least seconds of a frame whose passes do not wait for each other, read back: wall time, CPU time."""
    wall, spent = [], []
    for _ in range(RUNS):
        begin, used = time.perf_counter(), time.process_time()
        renderer.draw(frame, ("picture",))
        wall.append(time.perf_counter() - begin)
        spent.append(time.process_time() - used)
    return min(wall), min(spent)


def _fetches(renderer: Renderer, frame: Frame) -> float:
    """Texels that a pixel reads, the mean over those where something is seen."""
    drawn = renderer.draw(frame, ("color", "facing"))
    return float(drawn["color"][..., 0].astype(np.float64)[drawn["facing"][..., 3] > 0].mean())


if __name__ == "__main__":
    main()
