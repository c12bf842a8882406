"""The widgets in marimo, where each view stands in a shadow tree of its own and nothing is JupyterLab's."""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import sys
import textwrap
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from .waiting import LIMIT

Theme = Literal["light", "dark"]
Mode = Literal["run", "edit"]

CELLS = [
    """
    from facade_nb import gallery, solve
    from facade_nb.widgets import FacadeModel, SolverView, Studio, ElevationView, TextureStudio
    """,
    'model = FacadeModel(gallery.load("residential-house"), time_limit=600.0)',
    "Studio(model)",
    "ElevationView(model)",
    'SolverView(solve(gallery.load("figure-7"), trace=True, time_limit=None), height=400)',
    'TextureStudio("S -> Mat(Color, 0, 1, 0, 0, 1)", size=(4, 3), lit=False, antialias="none")',
]
VIEWS = 4
HARMLESS = ("preload", "GPU stall", "ERR_NAME_NOT_RESOLVED")


def notebook(path: Path) -> None:
    """Write a marimo notebook with those cells."""
    text = "import marimo\n\napp = marimo.App(width='full')\n"
    shared = {0: "FacadeModel, SolverView, Studio, ElevationView, TextureStudio, gallery, solve", 1: "model"}
    needs = {0: "", 1: "FacadeModel, gallery", 2: "Studio, model", 3: "ElevationView, model"}
    needs |= {4: "SolverView, gallery, solve", 5: "TextureStudio"}
    for k, code in enumerate(CELLS):
        body = textwrap.indent(textwrap.dedent(code).strip(), "    ")
        text += f"\n\n@app.cell\ndef _({needs[k]}):\n{body}\n    return {f'({shared[k]},)' if k in shared else ''}\n"
    path.write_text(text + "\n\nif __name__ == '__main__':\n    app.run()\n", encoding="utf-8")


class Marimo:
    """A marimo server with one notebook, open in a page."""

    def __init__(self, page: Page, server: subprocess.Popen[bytes], address: str) -> None:
        self.page = page
        self.server = server
        self.address = address
        self.errors: list[str] = []
        page.on("console", lambda m: self.errors.append(m.text) if m.type == "error" else None)
        page.on("pageerror", lambda error: self.errors.append(f"{error}\n{error.stack}"))

    def open(self) -> None:
        """Open the notebook, and wait for all views."""
        self.page.goto(self.address)
        expect(self.page.locator(".fnb")).to_have_count(VIEWS)
        expect(self.page.locator(".fnb-elevation [data-shape]")).to_have_count(34)
        expect(self.page.locator(".fnb-tex-canvas")).to_have_attribute("data-state", "sharp")
        expect(self.page.locator(".fnb-view").first).to_be_visible()

    def part(self, name: str) -> Locator:
        """A view, by its class."""
        return self.page.locator(f".fnb-{name}")

    def take_problems(self) -> list[str]:
        """Errors in the console since the last call."""
        found = [text for text in self.errors if not any(word in text for word in HARMLESS)]
        self.errors.clear()
        return found


@contextlib.contextmanager
def marimo(browser: Browser, folder: Path, mode: Mode) -> Iterator[Marimo]:
    notebook(folder / "facade.py")
    (folder / "marimo").mkdir(exist_ok=True)
    settings = '[display]\ntheme = "system"\n[runtime]\nauto_instantiate = true\n'
    (folder / "marimo" / "marimo.toml").write_text(settings, encoding="utf-8")
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    command = [sys.executable, "-m", "marimo", "-q", mode, "facade.py", "--headless", "--no-token"]
    command += [
        "--host",
        "127.0.0.1",
        "--port",
        str(port),
        *(["--skip-update-check"] if mode == "edit" else []),
    ]
    root = str(Path(__file__).resolve().parents[2])
    environment = {**os.environ, "XDG_CONFIG_HOME": str(folder), "PYTHONPATH": root}
    with (folder / "server.log").open("w") as log:
        server = subprocess.Popen(
            command, cwd=folder, env=environment, stdout=log, stderr=log, start_new_session=True
        )
    address = f"http://127.0.0.1:{port}/"
    try:
        end = time.monotonic() + LIMIT
        while True:
            with contextlib.suppress(OSError):
                urllib.request.urlopen(f"{address}health", timeout=LIMIT)
                break
            assert server.poll() is None and time.monotonic() < end, (folder / "server.log").read_text()
            time.sleep(0.1)
        with browser.new_page(viewport={"width": 1400, "height": 1000}) as page:
            page.set_default_timeout(1000 * LIMIT)
            opened = Marimo(page, server, address)
            opened.open()
            yield opened
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(server.pid, signal.SIGTERM)
        server.wait(LIMIT)


@pytest.fixture(scope="module")
def found(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Marimo]:
    with marimo(browser, tmp_path_factory.mktemp("marimo"), "run") as opened:
        yield opened


def style(place: Locator, name: str) -> str:
    """A computed style."""
    return str(place.evaluate("(e, name) => getComputedStyle(e).getPropertyValue(name)", name))


def light(place: Locator, name: str) -> bool:
    """Whether a colour of an element, or of what is around it where it is transparent, is light."""
    red, green, blue = place.evaluate(
        """(e, name) => {
            const paper = document.createElement('canvas').getContext('2d');
            for (let at = e; at; at = at.parentElement ?? at.getRootNode().host) {
                paper.fillStyle = getComputedStyle(at).getPropertyValue(name);
                paper.clearRect(0, 0, 1, 1);
                paper.fillRect(0, 0, 1, 1);
                const [r, g, b, a] = paper.getImageData(0, 0, 1, 1).data;
                if (a > 128) return [r, g, b];
            }
            return [255, 255, 255];
        }""",
        name,
    )
    return bool(0.3 * red + 0.59 * green + 0.11 * blue > 128)


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_every_view_has_its_style_and_the_theme_of_the_page(found: Marimo, theme: Theme, out: Path) -> None:
    page = found.page
    page.emulate_media(color_scheme=theme)
    assert page.evaluate("() => document.adoptedStyleSheets.length") == 0  # the page is not ours
    for part in found.page.locator(".fnb").all():
        expect(part).to_have_attribute("data-theme", theme)
        assert style(part, "container-type") == "inline-size"
        assert style(part, "font-size") == "13px"
    studio = found.part("part-studio")
    assert style(studio.locator(".fnb-toolbar"), "display") == "flex"
    assert style(studio.locator(".fnb-code").first, "font-family").startswith("ui-monospace")
    panel, paper = studio.locator(".fnb-panel"), studio.locator(".fnb-paper")
    for place in (panel, paper, found.part("tex-text")):
        assert light(place, "background-color") == (theme == "light")
    for place in (studio.locator(".fnb-code").first, found.part("tex-button").first):
        assert light(place, "color") == (theme == "dark")
    # Of the views that hide parts of theirs, what is hidden must not be seen.
    expect(found.page.locator(".fnb-absence:visible")).to_have_count(0)
    for name in ("part-studio", "part-solver", "texture"):
        found.part(name).screenshot(path=out / f"marimo-{name}-{theme}.png")
    assert found.take_problems() == []


def test_typing_a_pattern_redraws_all_views_of_the_model(found: Marimo) -> None:
    page = found.page
    drawn = found.part("elevation").locator("[data-layer=base][data-x=A][data-y=Q]")
    before = drawn.count()
    field = page.get_by_label("Pattern Bx", exact=True)
    field.click()
    page.keyboard.press("End")
    page.keyboard.type(" A")
    expect(drawn).to_have_count(before + 2)
    expect(field).to_be_focused()
    page.keyboard.press("Control+z")
    expect(field).to_have_value("A(BA)^k")
    expect(drawn).to_have_count(before)
    width = page.get_by_label("Canvas width in metres", exact=True)
    width.click()
    page.keyboard.press("Control+a")
    page.keyboard.type("7.")  # what is typed stays while it is being typed
    for paper in found.part("paper").all():
        expect(paper).to_have_attribute("aria-description", "7 by 4.5 metres")
    expect(width).to_have_value("7.")
    page.keyboard.press("Control+z")
    expect(width).to_have_value("6")
    assert found.take_problems() == []


def test_views_that_act_in_the_browser_do_so(found: Marimo) -> None:
    page = found.page
    page.get_by_role("button", name="Both", exact=True).click()
    expect(found.part("building-canvas")).to_have_attribute("data-state", "sharp")
    page.get_by_role("button", name="Elevation", exact=True).click()
    played = page.locator(".fnb-part-solver .fnb-playbar")
    before = played.inner_text()
    page.get_by_role("button", name="Step back", exact=True).click()
    expect(played).not_to_have_text(before)
    canvas = found.part("tex-canvas")
    before = canvas.screenshot()
    page.get_by_role("button", name="Straight on or in perspective").click()
    expect(canvas).to_have_attribute("data-state", "sharp")
    assert canvas.screenshot() != before
    assert found.take_problems() == []


def test_a_shape_is_picked_and_changed_and_the_studio_has_the_screen(found: Marimo) -> None:
    page = found.page
    studio = found.part("part-studio")
    studio.locator(".fnb-elevation [data-layer=door]").click()
    inspector = studio.locator(".fnb-inspector")
    box, paper = inspector.bounding_box(), studio.locator(".fnb-paper").bounding_box()
    assert box and paper and box["y"] >= paper["y"] + paper["height"] - 1
    inspector.get_by_label("material of D P in door", exact=True).click()
    page.get_by_role("option", name="painted-blue", exact=True).click()
    for part in ("part-studio", "part-elevation"):
        title = found.part(part).locator(".fnb-elevation [data-layer=door] title")
        expect(title).to_contain_text("painted-blue")
    screen = studio.get_by_role("button", name="Full screen")
    screen.click()
    expect(screen).to_have_attribute("aria-pressed", "true")
    screen.click()
    expect(screen).to_have_attribute("aria-pressed", "false")
    assert found.take_problems() == []


def test_a_server_that_ends_is_told(found: Marimo) -> None:
    """The last one of that server."""
    page = found.page
    field = page.get_by_label("Pattern Bx", exact=True)
    field.click()
    page.keyboard.press("End")
    os.killpg(found.server.pid, signal.SIGSTOP)  # what is typed now never reaches it
    page.keyboard.type(" A")
    os.killpg(found.server.pid, signal.SIGKILL)
    expect(page.locator(".fnb-absence:visible")).to_have_count(VIEWS)
    expect(page.get_by_text("Solved in")).to_have_count(0)
    expect(field).to_have_value("A(BA)^k A")
    expect(field).to_have_attribute("readonly", "")


def run_again(page: Page, number: int) -> None:
    """Run a cell of an editor again."""
    cell = page.locator("[data-cell-id]").nth(number)
    cell.locator(".cm-content").click()
    page.keyboard.press("Control+Enter")


def test_a_cell_that_is_run_again_has_a_view_that_works(browser: Browser, tmp_path: Path) -> None:
    with marimo(browser, tmp_path, "edit") as found:
        page = found.page
        found.part("part-studio").evaluate("e => { e.dataset.before = 'yes' }")
        run_again(page, 2)
        expect(page.locator(".fnb-part-studio[data-before]")).to_have_count(0)
        field = page.get_by_label("Pattern Bx", exact=True)
        field.click()
        page.keyboard.press("End")
        page.keyboard.type(" A")
        expect(found.part("part-studio").locator("[data-layer=base][data-x=A][data-y=Q]")).to_have_count(5)
