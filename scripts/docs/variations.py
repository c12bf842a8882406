"""The contact sheet of the gallery's variations: ``python -m scripts.docs.variations [FILE]``.

It solves each building of the gallery and its variations, draws them on one sheet, a building a row, and has Chromium
photograph that. The file is by default ``docs/img/variations.jpg``.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

import pandas as pd
from playwright.sync_api import sync_playwright

from facade_nb import contact_sheet, gallery, solve

__all__ = ["main", "sheet"]


def sheet(names: Sequence[str], width_px: float = 1500) -> str:
    """The designs of those names with their variations as one SVG, a design a row."""
    rows = []
    for name in names:
        for variation in (None, *gallery.variations(name)):
            layout = solve(gallery.load(name, variation))
            rows.append(
                {
                    "variation": variation or name,
                    "windows": sum(shape.kind == "window" for shape in layout.shapes),
                    "layout": layout,
                }
            )
    return contact_sheet(pd.DataFrame(rows), columns=4, width_px=width_px)


def main(path: Path) -> None:
    """Write the sheet as a JPEG."""
    svg = sheet([name for name in gallery.names() if gallery.variations(name)])
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"))
        page = browser.new_page(viewport={"width": 1500, "height": 800})
        page.set_content(f"<body style='margin:0'>{svg}")
        page.screenshot(path=path, full_page=True, type="jpeg", quality=72)
        browser.close()


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/img/variations.jpg"))
