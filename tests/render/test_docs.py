"""The tables of docs/rendering.md are those of the code."""

from __future__ import annotations

from pathlib import Path

import pytest

from scripts.docs.tables import geometry_table, material_table, refresh, with_tables

PAGE = Path(__file__).parents[2] / "docs" / "rendering.md"


def test_the_page_has_the_tables_of_the_code() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert refresh(text) == text, "run: python -m scripts.docs.tables docs/rendering.md"
    assert geometry_table() in text and material_table() in text


def test_a_page_without_a_place_for_a_table() -> None:
    with pytest.raises(ValueError, match="expected <!-- tiles --> and <!-- /tiles --> in the page"):
        with_tables("# A page\n<!-- tiles -->\n", {"tiles": "| a |"})


def test_the_pictures_of_the_page_exist() -> None:
    text = PAGE.read_text(encoding="utf-8")
    for name in ("residential-house.png", "residential-house.svg"):
        assert f"img/{name}" in text
        assert (PAGE.parent / "img" / name).stat().st_size > 5000
