"""A notebook that JupyterLab has saved with its widgets, opened anew without its kernel."""

from __future__ import annotations

from collections.abc import Iterator
from io import BytesIO
from pathlib import Path

import nbformat
import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Browser, Locator, Page, expect

from .jupyter import Notebook, serve

CODE = """
from IPython.display import display
from facade_nb import gallery, solve
from facade_nb.widgets import TextureView, WordsView
display(WordsView(solve(gallery.load("figure-7"), trace=True), tolerance=1.0, step=1.0))
view = TextureView("S -> SplitX(Rel, 1, Red, Rel, 1, Blue)  Red -> Mat(Color, 0, 1, 0, 0, 1)"
                   "  Blue -> Mat(Color, 0, 0, 0, 1, 1)", lit=False, size=(12, 9), layout={'width': '300px'})
view"""
SAVE = "() => window.jupyterapp.commands.execute('docmanager:save')"
STATE = "application/vnd.jupyter.widget-state+json"
RED, BLUE = [255, 0, 0], [0, 0, 255]


@pytest.fixture
def saved(browser: Browser, tmp_path: Path) -> Iterator[tuple[Notebook, Page]]:
    """A notebook run, saved with its widgets and opened anew; not yet trusted."""
    with serve(tmp_path, "lab") as (address, token), browser.new_page() as page:
        lab = Notebook(page, address, token, tmp_path, "lab")
        lab.open(CODE)
        lab.run()
        expect(page.locator(".fnb-tex-canvas")).to_have_attribute("data-state", "smooth", timeout=60_000)
        expect(page.locator(".fnb-words-of[data-pattern=balconies]")).to_be_visible()
        page.wait_for_timeout(500)
        page.evaluate(
            "() => window.jupyterapp.commands.execute('@jupyter-widgets/jupyterlab-manager:saveWidgetState')"
        )
        page.evaluate(SAVE)
        page.wait_for_timeout(500)
    assert STATE in nbformat.read(tmp_path / "test.ipynb", 4).metadata.widgets
    with serve(tmp_path, "lab") as (address, token), browser.new_page() as page:  # the old kernel is gone
        yield Notebook(page, address, token, tmp_path, "lab"), page


def halves(place: Locator) -> list[list[int]]:
    """What the screen shows a quarter and three quarters across."""
    image = np.array(Image.open(BytesIO(place.screenshot())).convert("RGB"), int)
    height, width = image.shape[:2]
    return [image[height // 2, width // 4].tolist(), image[height // 2, 3 * width // 4].tolist()]


def test_a_saved_page_shows_the_picture_before_it_is_trusted(saved: tuple[Notebook, Page]) -> None:
    lab, page = saved
    lab.visit("test.ipynb")
    static = page.get_by_alt_text("drawn by a texture grammar")
    expect(static).to_be_visible()
    assert halves(static) == [RED, BLUE]


def test_a_saved_view_lives_again_once_the_page_is_trusted(saved: tuple[Notebook, Page]) -> None:
    """JupyterLab saves what is in the models: bytes, too."""
    lab, page = saved
    lab.visit("test.ipynb")
    expect(page.get_by_alt_text("drawn by a texture grammar")).to_be_visible()
    lab.trust()
    canvas = page.locator(".fnb-tex-canvas")
    expect(canvas).to_have_attribute("data-state", "smooth", timeout=60_000)
    assert halves(canvas) == [RED, BLUE]
    expect(page.locator(".fnb-words-of[data-pattern=balconies] code").first).to_have_text("e b^s e; b := B")
