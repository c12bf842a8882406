"""The tables of docs/texture.md: ``python -m scripts.docs.texture docs/texture.md``."""

from __future__ import annotations

import sys
from pathlib import Path

from facade_nb.design.files import write_atomically
from facade_nb.render.texture.operators import OPERATORS, Kind, Operator

from .tables import with_tables

__all__ = ["channel_table", "operator_table", "refresh"]


def operator_table() -> str:
    """Every operator: how it is written, what its parameters are, what it does."""
    rows = ["| code | operator | parameters | what it does |", "|---|---|---|---|"]
    for operator in OPERATORS.values():
        kinds: dict[Kind, list[str]] = {}
        for param in (*operator.fixed, *operator.part):
            kinds.setdefault(param.kind, []).append(f"`{param.name}`")
        told = "; ".join(f"{', '.join(names)}: {kind.value}" for kind, names in kinds.items())
        rows.append(f"| {operator.code} | `{operator.signature}` | {told} | {operator.doc} |")
    return "\n".join(rows)


def channel_table() -> str:
    """What stands in each channel of each operator, the paper's Figure 3."""
    rows = ["| operator | pixel 0 | pixel 1 | pixel 2 |", "|---|---|---|---|"]
    for operator in OPERATORS.values():
        rows.append(f"| `{operator.name}` | {' | '.join(_pixels(operator))} |")
    return "\n".join(rows)


def _pixels(operator: Operator) -> list[str]:
    head = [operator.head[i : i + 4] for i in range(0, len(operator.head), 4)]
    cells = [_cell(pixel) for pixel in head]
    if operator.part:
        names = [f"{name}₁" if name else "" for name in operator.each]
        if len(names) == 2:
            names += [f"{name}₂" for name in operator.each]
        cells.append(f"{_cell(names)}, and so on")
    return cells + [""] * (3 - len(cells))


def _cell(pixel: tuple[str, ...] | list[str]) -> str:
    return " · ".join(name or "–" for name in pixel)


def refresh(text: str) -> str:
    """docs/texture.md with its tables made anew."""
    return with_tables(text, {"operators": operator_table(), "channels": channel_table()})


if __name__ == "__main__":
    page = Path(sys.argv[1])
    write_atomically(page, refresh(page.read_text(encoding="utf-8")))
