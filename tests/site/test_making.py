"""What the site is made of: every public name, every page, and links that lead somewhere."""

from __future__ import annotations

import importlib
import re
from pathlib import Path

import pytest

from facade_nb import gallery, widgets
from scripts.docs.site.checking import faults
from scripts.docs.site.contents import toctrees
from scripts.docs.site.previews import PREVIEWS
from scripts.docs.site.reference import PACKAGES, description, homes, write_reference
from scripts.docs.site.staging import place, saved, stage

ROOT = Path(__file__).resolve().parents[2]


def test_every_public_name_is_described_on_the_page_that_is_its_home(tmp_path: Path) -> None:
    pages = write_reference(tmp_path)
    assert pages == [f"api/{package}" for package in PACKAGES]
    for package in PACKAGES:
        module = importlib.import_module(package)
        for name in module.__all__:
            home, own = homes()[package, name]
            page = (tmp_path / "api" / f"{home}.md").read_text("utf-8")
            assert re.search(rf":: {re.escape(home)}\.{own}$|^- `{own}`: the module", page, re.MULTILINE), (
                name
            )
            assert name == "__version__" or description(name, getattr(module, name)), (
                f"{package}.{name} says nothing"
            )


def test_every_package_with_public_names_has_a_page() -> None:
    """Those whose names a shorter path exports, too, need none of their own."""
    named = {
        id(getattr(importlib.import_module(p), name))
        for p in PACKAGES
        for name in importlib.import_module(p).__all__
    }
    for path in sorted((ROOT / "facade_nb").rglob("__init__.py")):
        package = ".".join(path.relative_to(ROOT).parent.parts)
        exported = getattr(importlib.import_module(package), "__all__", ())
        missing = [
            name for name in exported if id(getattr(importlib.import_module(package), name)) not in named
        ]
        assert missing == [], package


def test_a_page_that_no_section_names_is_in_the_contents_all_the_same(tmp_path: Path) -> None:
    pages = [*stage(ROOT, tmp_path), *write_reference(tmp_path)]
    told = toctrees([*pages, "docs/page-of-tomorrow"])
    listed = re.findall(r"^/(.+)$", told, re.MULTILINE)
    assert sorted(listed) == sorted([*pages, "docs/page-of-tomorrow"])
    assert told.index(":caption: More") < told.index("/docs/page-of-tomorrow")
    with pytest.raises(ValueError, match=r"expected a page docs/glossary in the section 'Start'; found none"):
        toctrees(page for page in pages if page != "docs/glossary")


def test_what_leads_nowhere_is_found(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text(
        '<a href="b.html#there">1</a> <a href="b.html#gone">2</a> <a href="c.html">3</a> <a href="https://x.org">4</a>'
        '<img src="no.png"> <script src="https://cdn.org/x.js"></script> <div data-source="no.js"></div>'
    )
    (tmp_path / "b.html").write_text('<p id="there"></p>')
    assert faults(tmp_path) == [
        "a.html: there is no no.png",
        "a.html: fetches https://cdn.org/x.js, which is not a file of the site",
        "a.html: there is no no.js",
        "a.html: b.html#gone names a place that is not there",
        "a.html: there is no c.html",
    ]


def test_a_widget_that_was_saved_has_a_place_and_its_picture(tmp_path: Path) -> None:
    view = {
        "application/vnd.jupyter.widget-view+json": {"model_id": "m"},
        "text/html": ["<figure>", "f</figure>"],
    }
    notebook = {
        "metadata": {
            "widgets": {"application/vnd.jupyter.widget-state+json": {"state": {"m": {"</script>": 1}}}}
        },
        "cells": [
            {"cell_type": "code", "outputs": [{"data": view}]},
            {"cell_type": "markdown", "source": ["see [here](#facade-nb=x/words+3)"]},
        ],
    }
    made = saved(tmp_path, Path("notebooks/one.ipynb"), notebook)
    (output,) = made["cells"][0]["outputs"]
    assert output["data"] == {"text/html": place(Path("notebooks/one"), "one", "m", "<figure>f</figure>")}
    assert 'data-source="../_static/live/one.js"' in output["data"]["text/html"]
    assert (tmp_path / "_static/live/one.js").read_text().startswith('facadeNbState("one",{"state":')
    assert made["cells"][1]["source"] == 'see <a href="#facade-nb=x/words+3">here</a>'


def test_the_table_of_figures_has_every_figure_and_names_what_there_is() -> None:
    text = (ROOT / "docs" / "figures.md").read_text("utf-8")
    rows = re.findall(r"^\| ([LST]) (Table )?(\d+) \|", text, re.MULTILINE)
    wanted = (
        [("L", "", n) for n in range(1, 11)]
        + [("S", "", n) for n in range(1, 10)]
        + [("T", "", n) for n in range(1, 14)]
    )
    assert sorted((paper, table, int(n)) for paper, table, n in rows) == sorted([*wanted, ("S", "Table ", 1)])
    known = {*gallery.names(), *gallery.grammars(), "qualifiers-a"}
    for kind, name in re.findall(r"(designs?|grammars?) `([\w-]+)`", text):
        assert name in known, f"{kind} {name}"
    for name in re.findall(r"`([A-Z]\w+View|Studio|PixelInspector|GrammarTable)`", text):
        assert name in widgets.__all__
    for path in re.findall(r"`((?:notebooks|tutorials)/[\w-]+\.ipynb)`", text):
        assert (ROOT / path).is_file()


def test_every_widget_is_in_the_reference() -> None:
    page = (ROOT / "docs" / "widget-reference.md").read_text("utf-8")
    views = [
        name
        for name in widgets.__all__
        if name.endswith(("View", "Editor", "Inspector", "Table", "Studio", "Toolbar"))
    ]
    assert [name for name in views if name not in page and name != "TraceView"] == []
    assert set(re.findall(r"<!-- live: ([\w-]+) -->", page)) <= set(PREVIEWS)
