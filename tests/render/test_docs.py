"""The tables of docs/rendering.md are those of the code."""

from __future__ import annotations

from pathlib import Path

from facade_nb.render.tables import geometry_table, material_table

PAGE = Path(__file__).parents[2] / "docs" / "rendering.md"


def test_the_page_has_the_tables_of_the_code() -> None:
    text = PAGE.read_text(encoding="utf-8")
    for table in (geometry_table(), material_table()):
        assert table in text, "run: python -m facade_nb.render.tables docs/rendering.md"


def test_the_pictures_of_the_page_exist() -> None:
    text = PAGE.read_text(encoding="utf-8")
    for name in ("residential-house.png", "residential-house.svg"):
        assert f"img/{name}" in text
        assert (PAGE.parent / "img" / name).stat().st_size > 5000
