"""``python -m facade_nb.render.tiles [FOLDER]``: the contact sheet ``img/tiles.png`` and the tables of ``tiles.md``."""

from __future__ import annotations

import sys
from pathlib import Path

from ...design.files import write_atomically
from ..tables import with_tables
from .sheet import sheet, table
from .tileset import TileSet


def main(folder: Path) -> None:
    """Write the sheet, and put the tables in their place where the page is there."""
    picture = folder / "img" / "tiles.png"
    picture.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(picture, sheet(TileSet.builtin(256), cell=78, columns=11))
    print(picture)
    page = folder / "tiles.md"
    if page.exists():
        text = with_tables(page.read_text(encoding="utf-8"), {"tiles": table().rstrip("\n")})
        write_atomically(page, text)
        print(page)


main(Path(sys.argv[1] if len(sys.argv) > 1 else "docs"))
