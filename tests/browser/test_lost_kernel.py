"""What every part does when its kernel is restarted, shut down or killed, and while there is no connection to it."""

from __future__ import annotations

import json
import os
import signal
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from .conftest import HOUSE, Served
from .gate import Gate
from .jupyter import Notebook
from .waiting import LIMIT, eventually, frames

SOME = """
from IPython.display import display
texture = TextureModel("S -> Mat(Color, 0, 1, 0, 0, 1)")
display(Studio(model), GrammarEditor(texture))
"""
ALL = """
from IPython.display import display
from facade_nb import solve
trace = TraceModel.of(solve(gallery.load("figure-7"), trace=True, time_limit=None))
texture = TextureModel("S -> Mat(Color, 0, 1, 0, 0, 1)", size=(4, 3), lit=False)
display(
    Studio(model), ElevationView(model), PatternEditor(model), SymbolEditor(model), CounterEditor(model),
    LayerEditor(model), CanvasEditor(model), Toolbar(model), MassingView(model),
    SolverView(trace, height=300), WordsView(trace), NetworkView(trace), QualifiersView(),
    TextureView(texture, layout={"width": "300px"}, antialias="none"),
    GrammarEditor(texture), GrammarTable(texture), PixelInspector(texture),
)
"""
NAME = "lost.ipynb"  # on the server of the other tests
KERNEL = "window.jupyterapp.shell.currentWidget.sessionContext.session.kernel"
RED = "S -> Mat(Color, 0, 1, 0, 0, 1)"
SESSION = "window.jupyterapp.shell.currentWidget.sessionContext"


class Server:
    """A Jupyter server behind a gate, with a notebook of all parts open in it."""

    def __init__(self, lab: Notebook, gate: Gate, address: str, token: str) -> None:
        self.lab = lab
        self.page = lab.page
        self.gate = gate
        self.ended = False
        self._address = address
        self._token = token

    def request(self, method: str, path: str) -> str:
        """Speak to the server past the page, as another client does."""
        headers = {"Authorization": f"token {self._token}"}
        data = b"{}" if method == "POST" else None
        request = urllib.request.Request(self._address + path, method=method, headers=headers, data=data)
        return urllib.request.urlopen(request, timeout=LIMIT).read().decode()

    @property
    def kernel(self) -> str:
        """The id of the notebook's kernel."""
        return str(self.page.evaluate(f"() => {KERNEL}.id"))

    def show(self, code: str, views: int) -> None:
        """Run the notebook's cell, with a kernel, and wait for all views."""
        if self.ended:
            eventually(
                self.page, self._expect_no_session
            )  # JupyterLab would take the one that is just ending
            self.lab.open("0", NAME)  # the page would ask which kernel to start
            self.ended = False
        self.page.evaluate(f"() => {KERNEL}.info")
        self.lab.run(HOUSE + code)
        expect(self.page.locator(".fnb")).to_have_count(views)
        self.said = self.page.locator(".fnb-absence:visible")
        self.views = views
        expect(self.said).to_have_count(0)
        expect(self.page.locator(".fnb-status-line").first).to_contain_text("Solved in")
        self.pid = int(self.lab.python("__import__('os').getpid()"))
        self.take_problems()

    def _expect_no_session(self) -> None:
        assert NAME not in [session["path"] for session in json.loads(self.request("GET", "/api/sessions"))]

    def take_problems(self) -> list[str]:
        """Errors in the console, but those of the page's own requests to a server that has no such kernel any more."""
        return [text for text in self.lab.take_problems() if "Failed to load resource" not in text]

    def busy(self) -> None:
        """Have the kernel do something for longer than the test takes."""
        self.page.evaluate(
            f"() => {{ {KERNEL}.requestExecute({{code: 'import time; time.sleep(600)'}}).done.catch(() => 0) }}"
        )
        self.page.wait_for_function(f"() => {KERNEL}.status === 'busy'")


def restarted_in_the_menu(server: Server) -> None:
    server.page.evaluate(f"() => {{ {SESSION}.restartKernel().catch(() => 0) }}")


def shut_down_in_the_menu(server: Server) -> None:
    server.ended = True
    server.page.evaluate(f"() => {{ {SESSION}.shutdown().catch(() => 0) }}")


def restarted_elsewhere(server: Server) -> None:
    server.request("POST", f"/api/kernels/{server.kernel}/restart")


def kernel_shut_down_elsewhere(server: Server) -> None:
    server.ended = True
    server.request("DELETE", f"/api/kernels/{server.kernel}")


def session_ended_elsewhere(server: Server) -> None:
    server.ended = True
    sessions = json.loads(server.request("GET", "/api/sessions"))
    [own] = [one["id"] for one in sessions if one["kernel"]["id"] == server.kernel]
    server.request("DELETE", f"/api/sessions/{own}")


def killed(server: Server) -> None:
    os.kill(server.pid, signal.SIGKILL)


End = Callable[[Server], None]
ENDS: dict[End, str] = {
    restarted_in_the_menu: "The kernel was restarted.",
    restarted_elsewhere: "The kernel was restarted.",
    shut_down_in_the_menu: "The kernel was shut down.",
    kernel_shut_down_elsewhere: "The kernel was shut down.",
    session_ended_elsewhere: "The kernel was shut down.",
    killed: "The kernel died and was started anew.",
}


@pytest.fixture(scope="module")
def opened(browser: Browser, served: Served) -> Iterator[Server]:
    address, token, root = served("lab")
    with Gate(address) as gate, browser.new_page() as page:
        page.context.grant_permissions(["clipboard-write"])  # everything is pressed, also what copies
        page.set_viewport_size({"width": 1400, "height": 1000})
        # JupyterLab says so when it has asked for something in vain, and one closes that before one goes on.
        told = page.get_by_role("dialog", name="Server Connection Error")
        page.add_locator_handler(told, lambda dialog: dialog.get_by_role("button").last.click())
        lab = Notebook(page, gate.address, token, root, "lab")
        lab.open("0", NAME)
        page.evaluate("() => window.jupyterapp.commands.execute('application:toggle-left-area')")
        yield Server(lab, gate, address, token)
        lab.end()


@pytest.fixture
def server(opened: Server) -> Iterator[Server]:
    """A studio and a grammar editor over a kernel that is there; the console must have no errors."""
    opened.show(SOME, 2)
    yield opened
    assert opened.take_problems() == []


def typed(page: Page, label: str, keys: str) -> None:
    """Go to the end of a field of the first view that has it, and type."""
    field = page.get_by_label(label, exact=True).first
    field.click()
    page.keyboard.press("End")
    page.keyboard.type(keys)


@pytest.mark.parametrize("end", ENDS, ids=lambda end: end.__name__)
def test_however_the_kernel_ends_it_is_said_and_what_was_typed_is_kept(server: Server, end: End) -> None:
    page = server.page
    server.busy()
    typed(page, "Pattern Bx", " A")
    typed(page, "Pattern Bx", "B")
    typed(page, "Name of pattern By", "zz")  # not entered: the field has not been left
    expect(page.locator(".fnb-status-line").first).to_contain_text("kernel is busy")
    expect(server.said).to_have_count(0)  # a busy kernel has not gone

    end(server)
    expect(server.said).to_have_count(server.views)
    if end is killed:
        page.locator(".jp-Dialog button.jp-mod-accept").click()  # JupyterLab says so, too
    for text in server.said.all_inner_texts():
        assert text.startswith(ENDS[end]), text
    expect(page.locator(".fnb-status-line").first).to_contain_text("read only")
    expect(page.get_by_text("Solved in")).to_have_count(0)

    pattern = page.get_by_label("Pattern Bx", exact=True).first
    name = page.get_by_label("Name of pattern By", exact=True).first
    expect(name).to_have_value("Byzz")
    pattern.click()  # the name's field has been left
    page.keyboard.type("CC")
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+a")
    expect(pattern).to_be_focused()
    assert pattern.evaluate("e => e.value.slice(e.selectionStart, e.selectionEnd)") == "A(BA)^k AB"
    page.locator(".fnb-title").first.focus()
    expect(pattern).to_have_value("A(BA)^k AB")
    expect(name).to_have_value("Byzz")
    assert page.evaluate(LOOSE) == []

    if end in (
        restarted_in_the_menu,
        restarted_elsewhere,
    ):  # a cell that is run again has views that are heard
        server.show(SOME, 2)
        typed(page, "Pattern Bx", " A")
        server.lab.expect_python("model.design.patterns['Bx'].text", "A(BA)^k A")
        typed(page, "Grammar", " # A")
        server.lab.expect_python("texture.text", f"{RED} # A")


def test_every_part_says_it_and_can_be_pressed_without_errors(opened: Server) -> None:
    opened.show(ALL, 17)
    page = opened.page
    expect(page.locator(".fnb-solver .fnb-view").first).to_be_visible()
    expect(page.locator(".fnb-tex-canvas")).to_have_attribute("data-state", "sharp")
    expect(page.locator(".fnb-massing canvas")).to_be_visible()
    restarted_elsewhere(opened)
    expect(opened.said).to_have_count(17)
    assert page.evaluate(LOOSE) == []
    press_everything(page)
    expect(opened.said).to_have_count(17)
    assert opened.take_problems() == []
    opened.lab.run("0")  # views that end tell nobody
    expect(page.locator(".fnb")).to_have_count(0)
    assert opened.take_problems() == []


LOOSE = """() => [...document.querySelectorAll('.fnb :is(input, textarea, select, button)')]
    .filter(e => !e.closest('.fnb-solver:not(.fnb-part-qualifiers), .fnb-texture') || e.matches('.fnb-tex-text'))
    .filter(e => !e.closest('[data-local]') && !e.readOnly && e.ariaDisabled !== 'true').map(e => e.outerHTML)"""


def press_everything(page: Page) -> None:
    """Click and drag all there is; the console is looked at afterwards."""
    page.evaluate(
        """() => {
            for (const e of document.querySelectorAll('.fnb :is(button, select, summary), .fnb [data-shape]'))
                for (const type of ['pointerdown', 'mousedown', 'pointerup', 'mouseup', 'click'])
                    e.dispatchEvent(new MouseEvent(type, {bubbles: true, cancelable: true, composed: true}));
            for (const e of document.querySelectorAll('.fnb summary')) e.parentElement.open = true;
        }"""
    )
    canvas = page.locator(".fnb-massing canvas").last
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    assert box
    page.mouse.move(box["x"] + 100, box["y"] + 100)
    page.mouse.down()
    page.mouse.move(box["x"] + 160, box["y"] + 120, steps=4)
    page.mouse.up()
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.wheel(0, 40)
    frames(page, 3)


def test_views_that_are_made_later_show_what_was_typed_too(server: Server, out: Path) -> None:
    page = server.page
    server.busy()
    typed(page, "Pattern Bx", " A")
    typed(page, "Grammar", " # A")
    restarted_elsewhere(server)
    expect(server.said).to_have_count(server.views)
    page.evaluate(
        "() => { for (const own of document.querySelectorAll('.fnb')) own.dataset.before = 'yes'; }"
    )
    page.evaluate(
        """() => {
            const panel = window.jupyterapp.shell.currentWidget;
            const { model } = panel.content.widgets[0].outputArea;
            for (let k = 0; k < model.length; k++) model.set(k, model.get(k).toJSON());
        }"""
    )
    expect(page.locator(".fnb[data-before]")).to_have_count(0)
    expect(server.said).to_have_count(server.views)
    expect(page.get_by_label("Pattern Bx", exact=True)).to_have_value("A(BA)^k A")
    expect(page.get_by_label("Grammar", exact=True)).to_have_value(f"{RED} # A")
    for text in server.said.all_inner_texts():
        assert "What was typed last has not reached it" in text, text
    for theme in ("Dark", "Light"):
        server.lab.theme(f"JupyterLab {theme}")  # type: ignore[arg-type]
        expect(page.locator(f".fnb[data-theme={theme.lower()}]")).to_have_count(server.views)
        for name in ("part-studio", "texture"):
            page.locator(f".fnb-{name}").screenshot(path=out / f"lost-{name}-{theme.lower()}.png")


def test_after_a_gap_in_the_connection_what_was_typed_is_sent(server: Server) -> None:
    page, gate = server.page, server.gate
    gate.shut()
    expect(server.said).to_have_count(server.views)
    for text in server.said.all_inner_texts():
        assert text.startswith("No connection to the kernel."), text
    assert page.evaluate(LOOSE) == []
    gate.open()
    expect(server.said).to_have_count(0)
    typed(page, "Pattern Bx", " A")
    server.lab.expect_python("model.design.patterns['Bx'].text", "A(BA)^k A")
    typed(page, "Grammar", " # A")
    server.lab.expect_python("texture.text", f"{RED} # A")
    server.take_problems()  # the application tells of the gap itself


def test_what_was_under_way_when_the_connection_broke_arrives_once(server: Server) -> None:
    page, gate = server.page, server.gate
    gate.hold()  # nothing gets through any more, and the page does not know it yet
    typed(page, "Pattern Bx", " A")
    typed(page, "Grammar", " # A")
    gate.shut()
    expect(server.said).to_have_count(server.views)
    expect(page.get_by_label("Pattern Bx", exact=True).first).to_have_value("A(BA)^k A")
    expect(page.get_by_label("Grammar", exact=True)).to_have_value(f"{RED} # A")
    gate.open()
    expect(server.said).to_have_count(0)
    server.lab.expect_python("model.design.patterns['Bx'].text", "A(BA)^k A")
    server.lab.expect_python("texture.text", f"{RED} # A")
    page.keyboard.press("Control+z")
    server.lab.expect_python("texture.text", RED)
    expect(page.get_by_label("Pattern Bx", exact=True).first).to_have_value("A(BA)^k A")
    server.take_problems()


def test_a_kernel_that_was_restarted_behind_a_gap_is_not_taken_for_the_old_one(server: Server) -> None:
    server.gate.shut()
    expect(server.said).to_have_count(server.views)
    restarted_elsewhere(server)
    server.gate.open()
    notices = server.page.get_by_text("The kernel was restarted.")
    expect(notices).to_have_count(server.views)
    server.take_problems()
