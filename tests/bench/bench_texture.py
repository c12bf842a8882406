"""Texture grammars: frames, texels read, antialiasing, and memory against a façade baked into one picture."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial

import numpy as np

from facade_nb.render import Grammar
from facade_nb.render.pipeline.facade import alone, colours
from facade_nb.render.texture.antialias import ANTIALIAS, smoothed
from facade_nb.render.texture.gl import GlPainter
from facade_nb.render.texture.noise import noise_texture
from facade_nb.render.texture.painters import PAINTERS
from facade_nb.render.texture.question import Question
from facade_nb.render.texture.shot import Painter
from facade_nb.render.texture.view import Sight

from .designs import line_of
from .textures import FULL, RANDOM, SIMPLE, SIZE

__all__ = ["main", "timed"]

GRAMMARS = {"Simple": SIMPLE, "Random": RANDOM, "Full": FULL}
PIXELS = (1024, 768)
SIGHTS = {
    "flat": Sight.flat(SIZE, PIXELS),
    "street": Sight.from_eye((1.0, 1.7, 7.0), (7.0, 4.5), SIZE, PIXELS, 65.0),
    "close-up": Sight.from_eye((5.4, 4.8, 1.6), (6.0, 4.8), SIZE, PIXELS, 60.0),
}
RUNS = 5
GOAL_FULL, GOAL_NUMPY = 120.0, 1.0


def main() -> None:
    """Print the tables."""
    questions = {name: Grammar.parse(text).question(SIZE, (1.0, 2.0)) for name, text in GRAMMARS.items()}
    present = {name: painter for name, painter in PAINTERS.items() if painter.available}
    for name, painter in PAINTERS.items():
        told = painter.why_not or (painter.renderer if isinstance(painter, GlPainter) else "NumPy")
        print(f"{name}: {told}")
    _frames(questions, present)
    _agreement(questions, present)
    _antialiasing(questions, present)
    _memory()


def timed(work: Callable[[], object]) -> tuple[float, float]:
    """Least milliseconds of wall time, and of CPU time of all threads: others share this machine."""
    work()
    wall, spent = [], []
    for _ in range(RUNS):
        start, used = time.perf_counter(), time.process_time()
        work()
        wall.append(1000 * (time.perf_counter() - start))
        spent.append(1000 * (time.process_time() - used))
    return min(wall), min(spent)


def _frames(questions: dict[str, Question], present: dict[str, Painter]) -> None:
    print(f"\nA frame of {PIXELS[0]} × {PIXELS[1]}, one sample a pixel, read back, least of {RUNS} (ms):")
    print("all: colour, normal and specular. colour: that alone. CPU: of all threads, of all.")
    widths = (-8, -9, -8, 7, 8, 8, 9, 8, 11)
    heads = ("grammar", "view", "backend", "all", "CPU", "colour", "CPU", "to cpu", "texels read")
    print(line_of(list(zip(heads, widths, strict=True))))
    count = PIXELS[0] * PIXELS[1]
    spent: dict[tuple[str, str, str], float] = {}
    for name, question in questions.items():
        for view, sight in SIGHTS.items():
            for one, painter in reversed(present.items()):  # NumPy first: the others are compared with it
                whole = timed(partial(painter.paint, question, sight))
                alone = timed(partial(painter.paint, question, sight, color_only=True))
                spent[name, view, one] = alone[1]
                read = "–"
                if isinstance(painter, GlPainter):
                    fetches = painter.paint(question, sight, count=True).fetches
                    assert fetches is not None
                    read = f"{fetches[fetches > 0].mean():.1f}"
                cells = [name, view, one, *(f"{value:.0f}" for value in (*whole, *alone))]
                cells += [f"{alone[1] / spent[name, view, 'cpu']:.2f}", read]
                print(line_of(list(zip(cells, widths, strict=True))), flush=True)
    speed = count / spent["Simple", "flat", "cpu"] / 1000
    print(f"NumPy on Simple: {speed:.1f} million pixels a second of CPU; goal at least {GOAL_NUMPY:g}")
    for one in present:
        if one != "cpu":
            for view in SIGHTS:
                half = spent["Full", view, one] / 2
                print(f"{one} on Full, {view}: {half:.0f} ms, half of its CPU time; goal under {GOAL_FULL:g}")


def _agreement(questions: dict[str, Question], present: dict[str, Painter]) -> None:
    print("\nPixels that differ from NumPy's, in rule or in colour by more than 1/500:")
    for one, painter in present.items():
        if one == "cpu":
            continue
        wrong = total = 0
        for question in questions.values():
            for sight in SIGHTS.values():
                a, b = painter.paint(question, sight).surface, present["cpu"].paint(question, sight).surface
                wrong += int(((a.rule != b.rule) | (np.abs(a.color - b.color).max(axis=1) > 0.002)).sum())
                total += len(a.rule)
        print(f"  {one}: {wrong} of {total} ({wrong / total:.1e})")


def _antialiasing(questions: dict[str, Question], present: dict[str, Painter]) -> None:
    pixels = (320, 240)
    sights = {
        "flat": Sight.flat(SIZE, pixels),
        "street": Sight.from_eye((1.0, 1.7, 7.0), (7.0, 4.5), SIZE, pixels, 65.0),
        "along": Sight.from_eye((-3.0, 1.7, 1.2), (6.0, 4.0), SIZE, pixels, 50.0),
    }
    print(
        f"\nAntialiasing at {pixels[0]} × {pixels[1]}: error (root mean square, of 255) against 256 samples; CPU ms:"
    )
    widths = (-8, -8, -13, 8, 14, 8, 8, 8)
    heads = ("grammar", "view", "samples", "error", "at boundaries", "cpu", "osmesa", "to none")
    print(line_of(list(zip(heads, widths, strict=True))))
    cpu = present["cpu"]
    places = (np.arange(16) + 0.5) / 16
    for name, question in questions.items():
        grammar = Grammar.parse(GRAMMARS[name])
        for view, sight in sights.items():
            shots = [
                cpu.paint_at(question, sight.looks(None, (x, y))).surface.color
                for x in places
                for y in places
            ]
            truth = np.mean(shots, axis=0, dtype=np.float64)
            edge = cpu.paint(question, sight, mips=True).margin < 0.75
            first = 0.0
            for how in ANTIALIAS:
                error = 255 * (smoothed(cpu, question, sight, how) - truth)[:, :3]
                spent = {
                    one: timed(
                        partial(_drawn, painter, grammar, sight, how)
                        if isinstance(painter, GlPainter)
                        else partial(smoothed, painter, question, sight, how)
                    )[1]
                    for one, painter in present.items()
                }
                first = first or spent["cpu"]
                cells = [name, view, how, *(f"{np.sqrt((e**2).mean()):.2f}" for e in (error, error[edge]))]
                cells += [f"{spent['cpu']:.0f}", f"{spent['osmesa']:.0f}" if "osmesa" in spent else "–"]
                cells.append(f"{spent['cpu'] / first:.1f}")
                print(line_of(list(zip(cells, widths, strict=True))), flush=True)


def _drawn(painter: GlPainter, grammar: Grammar, sight: Sight, how: str) -> None:
    """A picture of the pipeline."""
    for _ in colours(painter, alone(grammar, SIZE, (1.0, 2.0)), [sight], how):
        pass


def _memory() -> None:
    """The baked picture has as many texels on a metre as the sharpest tile has there: what one sees from close by."""
    print(
        "\nMemory against the façade baked into one picture of equal sharpness, both with smaller sizes, kB:"
    )
    widths = (-8, 7, 9, 8, 8, 9, 10, 8, 12)
    heads = ("grammar", "rules", "grammar", "noise", "tiles", "in all", "baked", "ratio", "1000 seeds")
    print(line_of(list(zip(heads, widths, strict=True))))
    for name, text in GRAMMARS.items():
        grammar = Grammar.parse(text)
        atlas = grammar.atlas()
        sharpest = atlas.table[0, 0, 2] / 1.0  # texels on a metre: a tile of 256 on a window of a metre
        baked = 4 / 3 * 4 * SIZE[0] * SIZE[1] * sharpest**2
        own, noise, tiles = grammar.texture().nbytes, noise_texture().nbytes, atlas.pixels.nbytes
        whole = own + noise + tiles
        cells = [
            name,
            str(len(grammar.rules)),
            f"{own / 1e3:.1f}",
            *(f"{v / 1e3:.0f}" for v in (noise, tiles, whole, baked)),
        ]
        cells += [f"{baked / whole:.1f}", f"{1000 * baked / whole:.0f}"]
        print(line_of(list(zip(cells, widths, strict=True))))
    print("A thousand façades with seeds of their own need no more than one. Rooms cannot be baked.")


if __name__ == "__main__":
    main()
