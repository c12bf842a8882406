"""The tables of docs/rendering.md, from the registries: ``python -m facade_nb.render.tables docs/rendering.md``."""

from __future__ import annotations

import sys
from pathlib import Path

from ..design.files import write_atomically
from .geometry import GEOMETRIES
from .materials import DEFAULT_MATERIAL, MATERIALS

__all__ = ["geometry_table", "material_table", "refresh"]


def geometry_table() -> str:
    """Every geometry as a row of a Markdown table."""
    rows = [
        "| geometry | what it is | fills its rectangle | made of, unless told otherwise | reaches out of its box |"
    ]
    rows.append("|---|---|---|---|---|")
    for name, geometry in GEOMETRIES.items():
        full = "yes" if geometry.full else "no"
        rows.append(
            f"| `{name}` | {geometry.summary} | {full} | {geometry.own or DEFAULT_MATERIAL} | {geometry.overhang} |"
        )
    return "\n".join(rows)


def material_table() -> str:
    """Every material as a row of a Markdown table."""
    rows = [
        "| material | what it is | drawn as | base colour | roughness | metallic |",
        "|---|---|---|---|---|---|",
    ]
    for name, m in MATERIALS.items():
        looks = f"{m.pattern or 'flat'}, `{m.fill}` | `{m.base}`"
        rows.append(f"| `{name}` | {m.summary} | {looks} | {m.roughness:g} | {m.metallic:g} |")
    return "\n".join(rows)


def refresh(text: str) -> str:
    """The page with its tables, between their markers, made anew."""
    for marker, table in (("geometries", geometry_table()), ("materials", material_table())):
        head, start, rest = text.partition(f"<!-- {marker} -->\n")
        _, end, tail = rest.partition(f"<!-- /{marker} -->")
        text = f"{head}{start}{table}\n{end}{tail}"
    return text


if __name__ == "__main__":
    page = Path(sys.argv[1])
    write_atomically(page, refresh(page.read_text(encoding="utf-8")))
