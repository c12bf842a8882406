"""One JupyterLab and one browser for all tests here; each test shows widgets of its own."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from .jupyter import Notebook, browse, serve

expect.set_options(timeout=10_000)

HOUSE = """
from facade_nb import Design, gallery
from facade_nb.widgets import *
model = FacadeModel(gallery.load("residential-house"))
"""

TRACED = """
from IPython.display import display
from facade_nb import Design, gallery, solve
from facade_nb.widgets import *
def traced(name, **more):
    return solve(gallery.load(name), trace=True, **more)
"""

Watch = Callable[[str], Notebook]


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """One browser for all."""
    with browse() as chromium:
        yield chromium


@pytest.fixture(scope="session")
def opened_lab(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Notebook]:
    root = tmp_path_factory.mktemp("lab")
    with serve(root, "lab") as (address, token), browser.new_page() as page:
        lab = Notebook(page, address, token, root, "lab")
        lab.open("0")
        page.evaluate("() => window.jupyterapp.commands.execute('application:toggle-left-area')")
        yield lab


@pytest.fixture
def lab(opened_lab: Notebook) -> Iterator[Notebook]:
    """JupyterLab; the test fails if the console has errors or anything offsite was asked for."""
    opened_lab.take_problems()
    opened_lab.page.set_viewport_size({"width": 1400, "height": 1000})
    yield opened_lab
    assert opened_lab.take_problems() == []


@pytest.fixture
def show(lab: Notebook) -> Callable[[str], Notebook]:
    """Show widgets over `model`, the residential house; the code's last line is displayed."""

    def run(code: str) -> Notebook:
        lab.run(HOUSE + textwrap.dedent(code))
        expect(lab.page.locator(".fnb").first).to_be_visible()
        return lab

    return run


@pytest.fixture
def watch(lab: Notebook) -> Watch:
    """Show views of a trace; the code's last line is displayed."""

    def run(code: str) -> Notebook:
        lab.run("0")  # what the test before has shown must not be taken for this one's
        expect(lab.page.locator(".fnb-view")).to_have_count(0)
        lab.run(TRACED + textwrap.dedent(code))
        expect(lab.page.locator(".fnb-view").first).to_be_visible()
        return lab

    return run


@pytest.fixture
def out() -> Path:
    """Where screenshots go for people to look at; git ignores it."""
    path = Path(__file__).resolve().parents[2] / "out" / "studio"
    path.mkdir(parents=True, exist_ok=True)
    return path
