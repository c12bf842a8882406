"""``python -m scripts.docs.tiles [FOLDER]``: the contact sheet ``img/tiles.png`` and the tables of ``tiles.md``."""

from __future__ import annotations

import sys
from pathlib import Path

from facade_nb.design.files import write_atomically
from facade_nb.render.tiles.catalogue import CATALOGUE
from facade_nb.render.tiles.sheet import sheet
from facade_nb.render.tiles.tileset import TileSet

from .tables import with_tables


def table() -> str:
    """The table of docs/tiles.md."""
    lines = []
    group = ""
    for recipe in CATALOGUE.values():
        if recipe.group != group:
            group = recipe.group
            lines += [
                f"\n### {group}\n",
                "| tile | what it shows | metres | goes on | companions |",
                "|---|---|---|---|---|",
            ]
        tiling = {"xy": "both ways", "x": "sideways", "y": "upwards", "": ""}[recipe.tiling]
        maps = ", ".join(f"`.{kind}`" for kind in recipe.maps)
        lines.append(
            f"| `{recipe.name}` | {recipe.summary} | {recipe.width:g} × {recipe.height:g} | {tiling} | {maps} |"
        )
    return "\n".join(lines).strip() + "\n"


def main(folder: Path) -> None:
    """Write the sheet, and put the tables in their place where the page is there."""
    picture = folder / "img" / "tiles.png"
    picture.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(picture, sheet(TileSet.builtin(256), cell=72, columns=12))
    print(picture)
    page = folder / "tiles.md"
    if page.exists():
        text = with_tables(page.read_text(encoding="utf-8"), {"tiles": table().rstrip("\n")})
        write_atomically(page, text)
        print(page)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "docs"))
