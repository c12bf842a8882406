"""Tall stacks that cannot be searched exhaustively: what is found in time, against a hundred times the time.

Stacks of 8 to 40 layers with distinct words whose sizes do not agree: each row has its own bays, doors and piers, some
of them wider or narrower than what they meet, some a letter more. Then the same with insertions: a third of the rows
have something between two placeholders instead. The value is J across. A run that is proven needs no longer one.
"""

from __future__ import annotations

import argparse
import random
import time
from collections.abc import Sequence

from facade_nb import Design, Layout, NoLayout, solve
from facade_nb.solver import solution as solving

from .designs import line_of

__all__ = ["main", "stack"]

LAYERS = (8, 12, 16, 26, 40)
GOAL = 1.02


def main(short: float = 0.5, factor: float = 100.0, seed: int = 1) -> None:
    """Print the table: `short` seconds against `factor` times as many."""
    heads = (
        "layers",
        f"J in {short:g} s",
        "took",
        "gap",
        f"J in {factor * short:g} s",
        "took",
        "gap",
        "ratio",
    )
    widths = (-8, 14, 8, 8, 14, 8, 8, 8)
    for insertions in (0.0, 0.34):
        print("\nwith insertions" if insertions else "without insertions")
        print(line_of(list(zip(heads, widths, strict=True))))
        _table([stack(layers, seed, insertions) for layers in LAYERS], short, factor, widths)


def _table(designs: Sequence[Design], short: float, factor: float, widths: Sequence[int]) -> None:
    worst = 0.0
    for design in designs:
        quick, seconds = _run(design, short)
        first = _told(quick, seconds)
        long, more = (quick, seconds) if quick and quick.x.proven else _run(design, factor * short)
        ratio = quick.x.cost / long.x.cost if quick and long and long.x.cost > 0 else float("inf")
        worst = max(worst, ratio)
        cells = [str(len(design.layers)), *first, *_told(long, more), f"{ratio:.4f}"]
        print(line_of(list(zip(cells, widths, strict=True))), flush=True)
    print(f"\nworst ratio {worst:.4f}; goal at most {GOAL:g}")


def _run(design: Design, limit: float) -> tuple[Layout | None, float]:
    solving.forget()
    begin = time.perf_counter()
    try:
        return solve(design, time_limit=limit), time.perf_counter() - begin
    except NoLayout:
        return None, time.perf_counter() - begin


def _told(layout: Layout | None, seconds: float) -> list[str]:
    if layout is None:
        return ["no layout", f"{seconds:.2f}", ""]
    return [f"{layout.x.cost:.4f}", f"{seconds:.2f}", "proven" if layout.x.proven else f"{layout.x.gap:.3f}"]


def stack(layers: int, seed: int, insertions: float = 0.0) -> Design:
    """A stack of so many layers, with insertions in a part of them; a seed gives the same one each time."""
    pick = random.Random(1000 * seed + layers)
    sizes: dict[str, float] = {"P": 3.0}
    rows: list[str] = []
    for n in range(layers):
        own = {
            "a": round(0.8 * pick.uniform(0.94, 1.06), 2),
            "b": round(1.2 * pick.uniform(0.94, 1.06), 2),
            "d": round(2.0 * pick.uniform(0.94, 1.06), 2),
        }
        word: list[str] = []
        for _ in range(8):
            word += pick.choice((["a", "b"], ["a", "b"], ["d"]))
        if pick.random() < 0.2:
            word.append("a")
        if insertions:
            rows.append(_bays(pick, n, own, word, n > 0 and pick.random() < insertions, sizes))
            continue
        for symbol, size in own.items():
            sizes[f"{symbol}{n}"] = size
        rows.append("".join(f"{symbol}{n}" for symbol in word))
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": f"stack of {layers}",
            "canvas": {"width": 16.0, "height": 3.0},
            "symbols": {symbol: {"size": size} for symbol, size in sizes.items()},
            "patterns": {**{f"x{n}": row for n, row in enumerate(rows)}, "storey": "P"},
            "layers": [
                {"name": f"layer {n}", "x": {"pattern": f"x{n}"}, "y": {"pattern": "storey"}}
                for n in range(layers)
            ],
        }
    )


def _bays(
    pick: random.Random,
    n: int,
    own: dict[str, float],
    word: list[str],
    inserted: bool,
    sizes: dict[str, float],
) -> str:
    """A row in which each letter has a size of its own (with few symbols no sizes would suit all rows)."""
    if inserted:
        word = word[: pick.choice((1, 2, 3))]
    names = [f"{symbol}-{n}-{k}" for k, symbol in enumerate(word)]
    sizes.update(
        {
            name: round(own[symbol] * pick.uniform(0.94, 1.06), 2)
            for name, symbol in zip(names, word, strict=True)
        }
    )
    behind = pick.choice((f"f{n}", f"e{n}'"))
    text = "".join(f"<{name}>" for name in names)
    return f"e{n} c{n} {behind}; c{n} := {text}" if inserted else text


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--short", type=float, default=0.5, help="seconds of the short run")
    parser.add_argument("--factor", type=float, default=100.0, help="how many times longer the other is")
    parser.add_argument("--seed", type=int, default=1, help="which stacks")
    chosen = parser.parse_args()
    main(chosen.short, chosen.factor, chosen.seed)
