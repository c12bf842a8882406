"""The tables of docs/rendering.md, from the registries: ``python -m scripts.docs.tables docs/rendering.md``.

`with_tables` is for the tables of other pages as well.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

from facade_nb.design.files import write_atomically
from facade_nb.render.geometry import GEOMETRIES
from facade_nb.render.materials import DEFAULT_MATERIAL, MATERIALS

__all__ = ["geometry_table", "material_table", "parameter_table", "refresh", "with_tables"]


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


def parameter_table() -> str:
    """Every parameter of every geometry as a row of a Markdown table."""
    rows = ["| geometry | parameter | what it says | what it may be |", "|---|---|---|---|"]
    for name, geometry in GEOMETRIES.items():
        rows += [
            f"| `{name}` | `{own.name}` | {own.summary} | {own.expected} |" for own in geometry.parameters
        ]
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


def with_tables(text: str, tables: Mapping[str, str]) -> str:
    """A page with its tables made anew: each stands between ``<!-- name -->`` and ``<!-- /name -->``.

    Raises
    ------
    ValueError
        For a page that lacks a table's place.
    """
    for name, table in tables.items():
        head, start, rest = text.partition(f"<!-- {name} -->\n")
        _, end, tail = rest.partition(f"<!-- /{name} -->")
        if not end:
            raise ValueError(
                f"expected <!-- {name} --> and <!-- /{name} --> in the page; found no such place"
            )
        text = f"{head}{start}{table}\n{end}{tail}"
    return text


def refresh(text: str) -> str:
    """docs/rendering.md with its tables made anew."""
    return with_tables(
        text, {"geometries": geometry_table(), "parameters": parameter_table(), "materials": material_table()}
    )


if __name__ == "__main__":
    page = Path(sys.argv[1])
    write_atomically(page, refresh(page.read_text(encoding="utf-8")))
