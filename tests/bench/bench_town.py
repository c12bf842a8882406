"""The texture paper's Figure 11 for our town, what a user would pick instead, and growth.

CPU milliseconds are those of all threads, the least of a few runs: others share the machine. A software renderer on two
free cores takes about half of it. *Simple* and *Random* are the grammars of the paper's kinds on the same walls, *Full*
is the town's own.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator, Sequence

import numpy as np
from scipy import ndimage

from facade_nb.render import Grammar
from facade_nb.render.pipeline.device import DEVICES
from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.pipeline.passes import BUFFERS, PASSES
from facade_nb.render.pipeline.renderer import Renderer, renderer_of
from facade_nb.render.pipeline.scene import Scene
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.texture.evaluating import evaluate
from facade_nb.render.town import Town
from facade_nb.render.town.viewpoints import VIEWS

from .designs import line_of
from .textures import RANDOM, SIMPLE

__all__ = ["main"]

PIXELS = (1024, 768)
HOUR = 14.5
RUNS = 4
FLAT = Looks(relief=False)
"""What relief costs has a bench of its own."""

SAMPLE = 60
"""Façades of which baked and explicit ones are made; the town's are reckoned from them."""

PAPER = {"distance": (12, 15, 55), "street": (7, 9, 25), "close-up": (12, 14, 40)}
"""Milliseconds of the paper's Figure 11, on a GeForce 470 GTX."""


def main(arguments: Sequence[str] = ()) -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--buildings", type=int, default=20_000)
    options = parser.parse_args(arguments)
    begin = time.perf_counter()
    town = Town.generate(options.buildings, 1)
    print(f"{options.buildings:,} buildings made in {time.perf_counter() - begin:.1f} s; goal under 20")
    stats = town.stats()
    megabytes = {name: f"{size / 1e6:.1f} MB" for name, size in stats["bytes"].items()}
    print(
        f"{stats['facades']:,} façades, {stats['vertices']:,} vertices, {stats['rules']:,} rules: {megabytes}"
    )
    images = sum(np.prod(own.size(PIXELS)) * own.channels * _SIZES[own.kind] for own in BUFFERS)
    print(f"images of {PIXELS[0]} × {PIXELS[1]}: {images / 1e6:.1f} MB; goal 200 MB, all included")
    _figure_11(town)
    _instead(town)
    _growth()


_SIZES = {"f1": 1, "f2": 2, "f4": 4, "i4": 4, "depth": 4}


def variants(town: Town) -> Iterator[tuple[str, Scene]]:
    """The town with simple grammars on its walls, and with its own."""
    names = dict(zip(map(tuple, town.grammar.encoding.positions), town.grammar.encoding.names, strict=True))
    for name, text in (("Simple", SIMPLE), ("Random", RANDOM)):
        grammar = Grammar.parse(text + "\nPlain -> Mat(Color, 0, 0.45, 0.44, 0.43, 1)\n")
        places = dict(zip(grammar.encoding.names, grammar.encoding.positions, strict=True))
        vertices = town.vertices.copy()
        found, index = np.unique(vertices["start"], axis=0, return_inverse=True)
        table = [places["S" if _wall(names[int(x), int(y)]) else "Plain"] for x, y in found]
        vertices["start"] = np.array(table, np.float32)[index.reshape(-1)]
        yield name, Scene(vertices, town.indices, grammar, town.chunks)
    yield "Full", town.scene


def _wall(rule: str) -> bool:
    return rule.rpartition(".")[2].lower().endswith(("front", "street", "side", "court"))


def timed(renderer: Renderer, frame: Frame) -> tuple[float, float]:
    """Least milliseconds of wall time and of CPU time."""
    wall, spent = [], []
    for _ in range(RUNS):
        start, used = time.perf_counter(), time.process_time()
        renderer.draw(frame, told=lambda *_: None)
        wall.append(1000 * (time.perf_counter() - start))
        spent.append(1000 * (time.process_time() - used))
    return min(wall), min(spent)


def _figure_11(town: Town) -> None:
    print(f"\nFigure 11, {PIXELS[0]} × {PIXELS[1]}, {HOUR} h, ms a frame: wall / CPU; (the paper's)")
    widths = (-9, -8, 20, 20, 20, 14)
    print(
        line_of(
            list(zip(("view", "backend", "Simple", "Random", "Full", "texels, Full"), widths, strict=True))
        )
    )
    cells: dict[tuple[str, str, str], str] = {}
    for name, scene in variants(town):
        for device in DEVICES.values():
            if not device.available:
                continue
            with renderer_of(scene, device) as renderer:
                for view in VIEWS:
                    frame = Frame(scene, town.viewpoint(view).frustum(PIXELS), Daytime.at(HOUR), PIXELS, FLAT)
                    wall, spent = timed(renderer, frame)
                    paper = PAPER[view][("Simple", "Random", "Full").index(name)]
                    cells[view, device.name, name] = f"{wall:.0f} / {spent:.0f} ({paper})"
    for view in VIEWS:
        for device in DEVICES.values():
            if device.available:
                row = [
                    view,
                    device.name,
                    *(cells[view, device.name, n] for n in ("Simple", "Random", "Full")),
                ]
                print(
                    line_of(list(zip([*row, f"{_fetches(town, view):.0f}"], widths, strict=True))), flush=True
                )
    for device in DEVICES.values():
        print(f"{device.name}: {device.renderer if device.available else device.why_not}")


def _fetches(town: Town, view: str) -> float:
    """Texels that are read for a visible pixel, on average."""
    from dataclasses import replace

    passes = [
        replace(own, defines=(*own.defines, "COUNT_FETCHES")) if own.name == "grammar" else own
        for own in PASSES
    ]
    device = next(own for own in DEVICES.values() if own.available)
    with renderer_of(town.scene, device, passes=passes) as renderer:
        frame = Frame(town.scene, town.viewpoint(view).frustum(PIXELS), Daytime.at(HOUR), PIXELS, FLAT)  # type: ignore[arg-type]
        drawn = renderer.draw(frame, ("color", "facing"))
    return float(drawn["color"][..., 0][drawn["facing"][..., 3] > 0].mean())


def _instead(town: Town) -> None:
    """Façades baked each into a texture of its own, and as rectangles of their own, of a sample of walls."""
    draw = np.random.Generator(np.random.PCG64(1))
    vertices, names = town.vertices, town.grammar.encoding.names
    starts = {
        tuple(map(int, own)): name for own, name in zip(town.grammar.encoding.positions, names, strict=True)
    }
    keys = np.column_stack([vertices["start"], vertices["size"], vertices["seed"], vertices["normal"]])
    upright = (np.abs(vertices["normal"][:, 1]) < 0.01) & vertices["normal"].any(axis=1)  # others turn
    walls = np.unique(keys[upright], axis=0)
    area = float((walls[:, 2] * walls[:, 3]).sum())
    print(f"\nInstead, for all {len(walls):,} walls ({area / 1e6:.2f} km²), reckoned from {SAMPLE} of them:")
    density = 100.0  # pixels a metre: a pixel of the close-up view covers about a centimetre
    chosen = walls[draw.choice(len(walls), SAMPLE, replace=False)]
    part = float((chosen[:, 2] * chosen[:, 3]).sum()) / area
    baking = pieces = 0
    shapes = 0.0
    for wall in chosen:
        size, seed = (float(wall[2]), float(wall[3])), (float(wall[4]), float(wall[5]))
        question = town.grammar.question(size, seed, starts[int(wall[0]), int(wall[1])])
        begin = time.perf_counter()
        step = 0.05
        x, y = (np.arange(step / 2, extent, step, dtype=np.float32) for extent in size)
        points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        rule = evaluate(question, points, color_only=True).rule.reshape(len(y), len(x))
        baking += (time.perf_counter() - begin) * (density * step) ** 2
        begin = time.perf_counter()
        edges = (np.diff(rule, axis=0, prepend=-9) != 0) | (np.diff(rule, axis=1, prepend=-9) != 0)
        pieces += int(ndimage.label(~edges)[1])
        shapes += time.perf_counter() - begin
    bytes_baked = area * density**2 * 4 * 4 / 3
    scene = town.scene.bytes
    rows = [
        ("our town", f"{scene['total'] / 1e6:,.0f} MB", f"{len(town.indices) // 3:,}", "rooms, random, any sharpness"),
        ("baked, 100 pixels a metre", f"{bytes_baked / 1e6:,.0f} MB", f"{len(town.indices) // 3:,}",
         f"{baking / part:,.0f} s of NumPy to bake; no rooms"),
        ("explicit geometry", f"{pieces / part * (4 * 36 + 24) / 1e6:,.0f} MB", f"{2 * pieces / part:,.0f}",
         f"{(baking / (density * 0.05) ** 2 + shapes) / part:,.0f} s to derive at 5 cm; no rooms"),
    ]  # fmt: skip
    widths = (-28, 14, 16, -44)
    print(line_of(list(zip(("", "memory", "triangles", "and"), widths, strict=True))))
    for row in rows:
        print(line_of(list(zip(row, widths, strict=True))))


def _growth() -> None:
    device = next(own for own in DEVICES.values() if own.available)
    print("\nGrowth with buildings: seconds to make, MB, CPU ms a frame (distance, street)")
    widths = (10, 8, 8, 10, 10)
    for count in (1_000, 5_000, 20_000, 100_000):
        begin = time.perf_counter()
        town = Town.generate(count, 1)
        made = time.perf_counter() - begin
        with renderer_of(town.scene, device) as renderer:
            spent = [
                timed(
                    renderer,
                    Frame(town.scene, town.viewpoint(view).frustum(PIXELS), Daytime.at(HOUR), PIXELS, FLAT),
                )[1]
                for view in ("distance", "street")
            ]
        cells = (
            f"{count:,}",
            f"{made:.1f}",
            f"{town.scene.bytes['total'] / 1e6:.0f}",
            *(f"{s:.0f}" for s in spent),
        )
        print(line_of(list(zip(cells, widths, strict=True))), flush=True)
    print("\nGrowth with rules and layers: CPU ms of the grammar's pass on a façade that fills the picture")
    for what, texts in (
        ("rules", {n: _many_rules(n) for n in (5, 20, 80)}),
        ("layers", {n: _many_layers(n) for n in (1, 2, 4, 8)}),
    ):
        cells = [f"{n}: {_alone(text):.0f}" for n, text in texts.items()]
        print(f"  {what}: {', '.join(cells)}", flush=True)


def _many_rules(count: int) -> str:
    """A grammar of so many rules, of which a pixel meets about five."""
    leaves = count - 3
    lines = ["S -> RepeatY(3, Floor)", "Floor -> RepeatX(2, Bay)"]
    lines.append(f"Bay -> RandUni(0, {', '.join(f'L{k}' for k in range(leaves))})")
    lines += [f"L{k} -> Mat(Color, Rep:brick, 0, 0, 0.5, {0.5 + 0.001 * k:.3f})" for k in range(leaves)]
    return "\n".join(lines)


def _many_layers(count: int) -> str:
    """So many layers, each but the lowest half transparent."""
    lines = [
        f"S -> Layer({', '.join(f'L{k}' for k in range(count))})",
        "L0 -> Mat(Color, Rep:brick, 0, 0, 0.5, 0.5)",
    ]
    lines += [
        f"L{k} -> MatAlpha(Color, 0, 0.5, 0.4, 0.3, 0.2, Rep:clouds, 0, 0, 0.1, 0.1)" for k in range(1, count)
    ]
    return "\n".join(lines)


def _alone(text: str) -> float:
    from facade_nb.render.pipeline.viewpoint import Viewpoint
    from facade_nb.render.texture.facades import Facade

    scene = Scene.of_facades([Facade(Grammar.parse(text), (24.0, 18.0))])
    place = Viewpoint.towards((12.0, 9.0, 10.0), (12.0, 9.0, 0.0), 90.0)
    looks = Looks(shadow=False, occlusion=False, smooth=False, haze=0.0, relief=False)
    frame = Frame(scene, place.frustum(PIXELS), Daytime.at(HOUR), PIXELS, looks)
    device = next(own for own in DEVICES.values() if own.available)
    found: list[float] = []
    with renderer_of(scene, device) as renderer:
        for _ in range(RUNS):
            used = [time.process_time()]

            def told(name: str, _: float) -> None:
                now = time.process_time()
                if name == "grammar":
                    found.append(1000 * (now - used[0]))  # noqa: B023
                used[0] = now  # noqa: B023

            renderer.draw(frame, ("color",), told)
    return min(found)
