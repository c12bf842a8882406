"""One JupyterLab and one browser for all tests here; each test shows widgets of its own."""

from __future__ import annotations

import contextlib
import functools
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, BrowserContext, expect

from .jupyter import App, Notebook, browse, serve
from .waiting import LIMIT

expect.set_options(timeout=1000 * LIMIT)

HOUSE = """
from facade_nb import Design, gallery
from facade_nb.widgets import *
model = FacadeModel(gallery.load("residential-house"), time_limit=600.0)
"""

TRACED = """
from IPython.display import display
from facade_nb import Design, gallery, solve
from facade_nb.widgets import *
def traced(name, **more):
    return solve(gallery.load(name), trace=True, time_limit=None, **more)
"""

LONG = (
    "town",
    "flying",
    "texture",
    "houses",
    "lost_kernel",
    "studio",
    "solver_page",
    "marimo",
    "thirty",
    "applications",
    "building",
    "stage",
    "keys",
    "solver",
    "walls",
    "panel",
    "parts",
    "questions",
)
"""Files of tests, those that take the longest first: begun last, one would keep a process waiting for another."""

Watch = Callable[[str], Notebook]
Served = Callable[[App], tuple[str, str, Path]]
Visit = Callable[[App], contextlib.AbstractContextManager[Notebook]]


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with the files that take the longest; a file's own tests stay in their order."""
    place = {Path(__file__).parent / f"test_{name}.py": number for number, name in enumerate(LONG)}
    items.sort(key=lambda item: place.get(item.path, len(LONG)))


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """One browser for all."""
    with browse() as chromium:
        yield chromium


@pytest.fixture(scope="session")
def pages(browser: Browser) -> BrowserContext:
    """Pages that share what has been loaded: JupyterLab is read, and compiled, once."""
    context = browser.new_context()
    context.grant_permissions(["clipboard-read", "clipboard-write"])
    return context


@pytest.fixture(scope="session")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """Address, token and root of an application's server; each is started when it is first asked for."""
    with contextlib.ExitStack() as stack:

        @functools.cache
        def server(app: App) -> tuple[str, str, Path]:
            root = tmp_path_factory.mktemp(app)
            return *stack.enter_context(serve(root, app)), root

        yield server


@pytest.fixture(scope="session")
def visit_anew(pages: BrowserContext, served: Served) -> Visit:
    """Open a page of an application, for `with`."""

    @contextlib.contextmanager
    def visiting(app: App) -> Iterator[Notebook]:
        with pages.new_page() as page:
            notebook = Notebook(page, *served(app), app)
            yield notebook
            notebook.end()

    return visiting


@pytest.fixture(scope="session")
def opened_lab(visit_anew: Visit) -> Iterator[Notebook]:
    with visit_anew("lab") as lab:
        lab.open("0")
        lab.page.evaluate("() => window.jupyterapp.commands.execute('application:toggle-left-area')")
        yield lab


@pytest.fixture(scope="session")
def visit(visit_anew: Visit, request: pytest.FixtureRequest) -> Visit:
    """As `visit_anew`; in JupyterLab, notebooks are opened beside the one that is there and has its own kernel.

    Reading and starting JupyterLab takes longer than most tests.
    """

    @contextlib.contextmanager
    def visiting(app: App) -> Iterator[Notebook]:
        if app != "lab":
            with visit_anew(app) as notebook:
                yield notebook
            return
        lab: Notebook = request.getfixturevalue("opened_lab")
        lab.run("0")  # what the test before has shown must not be taken for this one's
        expect(lab.page.locator(".fnb")).to_have_count(0)
        lab.resize(1280, 720)
        with lab.beside():
            lab.take_problems()
            yield lab

    return visiting


@pytest.fixture
def lab(opened_lab: Notebook) -> Iterator[Notebook]:
    """JupyterLab; the test fails if the console has errors or anything offsite was asked for."""
    opened_lab.take_problems()
    opened_lab.resize(1400)
    yield opened_lab
    assert opened_lab.take_problems() == []


@pytest.fixture
def show(lab: Notebook) -> Callable[[str], Notebook]:
    """Show widgets over `model`, the residential house; the code's last line is displayed."""

    def run(code: str) -> Notebook:
        lab.run(HOUSE + textwrap.dedent(code))
        lab.shown()
        return lab

    return run


@pytest.fixture
def watch(lab: Notebook) -> Watch:
    """Show views of a trace; the code's last line is displayed."""

    def run(code: str) -> Notebook:
        lab.run("0")  # what the test before has shown must not be taken for this one's
        expect(lab.page.locator(".fnb-view")).to_have_count(0)
        lab.run(TRACED + textwrap.dedent(code))
        lab.shown()
        return lab

    return run


@pytest.fixture
def out() -> Path:
    """Where screenshots go for people to look at; git ignores it."""
    path = Path(__file__).resolve().parents[2] / "out" / "studio"
    path.mkdir(parents=True, exist_ok=True)
    return path
