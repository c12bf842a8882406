"""A notebook that JupyterLab has saved with its widgets, opened anew without its kernel."""

from __future__ import annotations

from collections.abc import Iterator
from io import BytesIO

import nbformat
import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Locator, Page, expect

from .conftest import Visit
from .jupyter import Notebook
from .waiting import eventually

NAME = "saved.ipynb"
CODE = """
from IPython.display import display
from facade_nb import gallery, solve
from facade_nb.widgets import TextureView, WordsView
display(WordsView(solve(gallery.load("figure-7"), trace=True, time_limit=None), tolerance=1.0, step=1.0))
view = TextureView("S -> SplitX(Rel, 1, Red, Rel, 1, Blue)  Red -> Mat(Color, 0, 1, 0, 0, 1)"
                   "  Blue -> Mat(Color, 0, 0, 0, 1, 1)", lit=False, size=(12, 9), layout={'width': '300px'})
view"""
SAVE = "() => window.jupyterapp.commands.execute('docmanager:save')"
STATE = "application/vnd.jupyter.widget-state+json"
RED, BLUE = [255, 0, 0], [0, 0, 255]


@pytest.fixture(scope="module")
def saved(visit: Visit) -> Iterator[tuple[Notebook, Page]]:
    """A notebook run, saved with its widgets and opened anew; not yet trusted."""
    with visit("lab") as lab:
        page, path = lab.page, lab.root / NAME
        lab.open(CODE, NAME)
        lab.run()
        expect(page.locator(".fnb-tex-canvas")).to_have_attribute("data-state", "smooth")
        expect(page.locator(".fnb-words-of[data-pattern=balconies]")).to_be_visible()
        lab.settle()
        page.evaluate(
            "() => window.jupyterapp.commands.execute('@jupyter-widgets/jupyterlab-manager:saveWidgetState')"
        )

        def save() -> None:
            page.evaluate(SAVE)
            assert STATE in nbformat.read(path, 4).metadata.get("widgets", {})

        eventually(page, save)
    notebook = nbformat.read(path, 4)
    notebook.metadata["came"] = "by mail"  # the server trusts what it has saved itself
    nbformat.write(notebook, path)
    with visit("lab") as lab:  # the old kernel is gone
        lab.visit(NAME)
        yield lab, lab.page


def halves(place: Locator) -> list[list[int]]:
    """What the screen shows a quarter and three quarters across."""
    image = np.array(Image.open(BytesIO(place.screenshot())).convert("RGB"), int)
    height, width = image.shape[:2]
    return [image[height // 2, width // 4].tolist(), image[height // 2, 3 * width // 4].tolist()]


def has(place: Locator, colours: list[list[int]]) -> None:
    assert halves(place) == colours


def test_a_saved_page_shows_the_picture_before_it_is_trusted(saved: tuple[Notebook, Page]) -> None:
    _, page = saved
    static = page.get_by_alt_text("drawn by a texture grammar")
    expect(static).to_be_visible()
    eventually(page, lambda: has(static, [RED, BLUE]))


def test_a_saved_view_lives_again_once_the_page_is_trusted(saved: tuple[Notebook, Page]) -> None:
    """JupyterLab saves what is in the models: bytes, too."""
    lab, page = saved
    expect(page.get_by_alt_text("drawn by a texture grammar")).to_be_visible()
    lab.trust()
    canvas = page.locator(".fnb-tex-canvas")
    expect(canvas).to_have_attribute("data-state", "smooth")
    eventually(page, lambda: has(canvas, [RED, BLUE]))
    expect(page.locator(".fnb-words-of[data-pattern=balconies] code").first).to_have_text("e b^s e; b := B")
