"""The notebooks as a product: each runs to its end, is small, and shows something where no widget can be."""

from __future__ import annotations

import json
import re
import runpy
from pathlib import Path

import nbformat
import pytest
from bs4 import BeautifulSoup
from nbclient import NotebookClient
from nbconvert import HTMLExporter

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOKS = sorted(path for folder in ("notebooks", "tutorials") for path in (ROOT / folder).glob("*.ipynb"))
LARGEST = 500_000  # bytes
WIDGET = "application/vnd.jupyter.widget-view+json"
STATE = "application/vnd.jupyter.widget-state+json"
PLACES = re.compile(
    r"(?<![\w.:/])/(tmp|home|root|work|Users|usr|opt|var)/|\b[A-Z]:\\\\|site-packages|ipykernel_"
)

every_notebook = pytest.mark.parametrize(
    "path", NOTEBOOKS, ids=lambda path: f"{path.parent.name}/{path.stem}"
)


def outputs(notebook: nbformat.NotebookNode) -> list[nbformat.NotebookNode]:
    return [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]


def has_static_form(data: dict[str, str]) -> bool:
    """A picture, or a table."""
    html = data.get("text/html", "")
    return any(kind.startswith("image/") for kind in data) or "<img " in html or "<table>" in html


def test_there_are_notebooks() -> None:
    assert ROOT / "notebooks" / "studio.ipynb" in NOTEBOOKS
    assert ROOT / "tutorials" / "how-the-solver-thinks.ipynb" in NOTEBOOKS


def test_all_are_saved_with_views_and_made_by_one_command() -> None:
    made = runpy.run_path(str(ROOT / "scripts" / "notebooks.py"))["paths"]([])
    saved = [
        path for path in NOTEBOOKS if STATE in nbformat.read(path, as_version=4).metadata.get("widgets", {})
    ]
    assert saved == NOTEBOOKS
    assert set(made) == set(saved)


@pytest.mark.parametrize("folder", ["notebooks", "tutorials"])
def test_they_run_one_after_the_other(folder: str) -> None:
    """In one kernel, which forgets all names in between: a kernel takes longer to start than most of them to run."""
    joined = nbformat.v4.new_notebook()
    for path in NOTEBOOKS:
        if path.parent.name == folder:
            code = [own for own in nbformat.read(path, as_version=4).cells if own.cell_type == "code"]
            joined.cells += [nbformat.v4.new_code_cell(f"%reset -f\n# {path.stem}"), *code]
    client = NotebookClient(
        joined, timeout=None, kernel_name="python3", resources={"metadata": {"path": str(ROOT / folder)}}
    )
    client.execute()  # raises at the first cell that fails
    assert len(outputs(joined)) > 60
    # A warning is the first thing a reader would see.
    assert not [output.text for output in outputs(joined) if output.get("name") == "stderr"]


@every_notebook
def test_is_small(path: Path) -> None:
    assert path.stat().st_size <= LARGEST


@every_notebook
def test_opens_with_what_it_is_for(path: Path) -> None:
    first = nbformat.read(path, as_version=4).cells[0]
    assert first.cell_type == "markdown"
    for words in ("you will", "learn", "need"):
        assert words in first.source.lower()


@every_notebook
def test_names_its_kernel(path: Path) -> None:
    """Without a name JupyterLab asks which kernel to take, each time that the notebook is opened."""
    assert nbformat.read(path, as_version=4).metadata["kernelspec"]["name"] == "python3"


@every_notebook
def test_is_saved_with_static_forms_where_a_widget_would_be_blank(path: Path) -> None:
    saved = outputs(nbformat.read(path, as_version=4))
    assert saved, "saved without outputs"
    assert not [output for output in saved if output.output_type == "error"]
    after = [*saved[1:], nbformat.from_dict({})]
    widgets = [
        (one.data, two.get("data", {}))
        for one, two in zip(saved, after, strict=True)
        if WIDGET in one.get("data", {})
    ]
    assert not [both for both in widgets if not any(map(has_static_form, both))]


@pytest.mark.parametrize("name", ["notebooks/solver", "notebooks/town", "tutorials/how-the-solver-thinks"])
def test_html_of_nbconvert_has_no_blank_output(name: str) -> None:
    """Without a network its widgets are blank: what else the cell shows is not."""
    html, _ = HTMLExporter(exclude_input=True).from_filename(str(ROOT / f"{name}.ipynb"))
    page = BeautifulSoup(html, "html.parser")
    cells = [cell for cell in page.select(".jp-CodeCell") if cell.select_one(".jp-OutputArea-child")]
    assert len(cells) >= 3
    for cell in cells:
        for hidden in cell.select("script, style, .jp-OutputPrompt"):
            hidden.decompose()
        assert cell.select_one("img, svg, table") or cell.get_text(strip=True), cell


@every_notebook
def test_what_is_saved_names_no_place_on_a_machine(path: Path) -> None:
    notebook = nbformat.read(path, as_version=4)
    saved = json.dumps(outputs(notebook), ensure_ascii=False)
    assert [saved[max(0, found.start() - 60) : found.end() + 60] for found in PLACES.finditer(saved)] == []
