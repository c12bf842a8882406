"""Start Jupyter servers and drive them in headless Chromium."""

from __future__ import annotations

import ast
import contextlib
import json
import os
import re
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

import nbformat
from playwright.sync_api import Browser, Error, Locator, Page, sync_playwright

from .keys import retype
from .waiting import LIMIT, eventually, frames

__all__ = ["App", "Notebook", "browse", "serve"]

App = Literal["lab", "notebook", "voila"]

_FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--enable-unsafe-swiftshader",  # WebGL2 in software
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",  # no network: what works here works offline
]

_UNNEEDED = (
    "apputils-extension:announcements",
    "debugger-extension",
    "extensionmanager-extension",
    "notebook-extension:execution-indicator",
    "notebook-extension:log-output",
)
"""Parts of JupyterLab that no test and no other part needs: they would draw, or ask, as often as a kernel speaks."""

_HARMLESS = (
    "t.on is not a function",  # pythreejs, for every light
    "schema",  # Notebook 7.6.5, for every notebook
    "fontawesome",  # Voilà asks a CDN for it
    "font-awesome",
    "ERR_NAME_NOT_RESOLVED",
    "federation",  # Voilà
    "favicon",
    "[anywidget] Failed to initialize model.",  # it waits for 2 s; whether all is shown is looked at all the same
)
_LABS_OWN = re.compile(r"removeChild.*static/lab/jlab_core[^\n]*$", re.S)
"""JupyterLab now and then loses a node while window and theme change; nothing of ours is on the stack."""

_PANEL = "window.jupyterapp.shell.currentWidget"
_CLOSE = """async name => {
    const { shell } = window.jupyterapp;
    for (const panel of [...shell.widgets("main")].filter(panel => panel.context?.path === name)) panel.dispose();
}"""
_OPEN = """async name => {
    const { commands, shell } = window.jupyterapp;
    const open = [...shell.widgets("main")].find(panel => panel.context?.path === name);
    const panel = open ?? await commands.execute("docmanager:open", { path: name });
    await panel.context.ready;
    shell.activateById(panel.id);
}"""


@contextlib.contextmanager
def serve(root: Path, app: App) -> Iterator[tuple[str, str]]:
    """Serve the notebooks under `root`; gives the address and the token."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    token = secrets.token_hex(8)
    with tempfile.TemporaryDirectory() as name:
        home = Path(name)
        (home / "labconfig").mkdir()
        quiet = {"disabledExtensions": {f"@jupyterlab/{name}": True for name in _UNNEEDED}}
        (home / "labconfig" / "page_config.json").write_text(json.dumps(quiet), encoding="utf-8")
        command = {
            "voila": ["voila", str(root), "--no-browser", f"--port={port}", "--Voila.ip=127.0.0.1"],
            "lab": ["jupyterlab", *_server(root, port, token), "--LabApp.expose_app_in_browser=True"],
            "notebook": [
                "notebook",
                *_server(root, port, token),
                "--JupyterNotebookApp.expose_app_in_browser=True",
            ],
        }[app]
        environment = {
            **os.environ,
            "JUPYTER_CONFIG_DIR": name,
            "JUPYTER_DATA_DIR": f"{name}/data",
            "JUPYTER_RUNTIME_DIR": f"{name}/runtime",
            "IPYTHONDIR": f"{name}/ipython",
        }
        log = home / "server.log"
        with log.open("w") as out:
            server = subprocess.Popen(
                [sys.executable, "-m", *command],
                stdout=out,
                stderr=out,
                env=environment,
                start_new_session=True,
            )
        address = f"http://127.0.0.1:{port}"
        try:
            _await_server(address + ("/" if app == "voila" else "/api"), server, log)
            yield address, token
        finally:
            os.killpg(server.pid, signal.SIGTERM)  # the kernels with it
            server.wait(LIMIT)


def _server(root: Path, port: int, token: str) -> list[str]:
    return [
        "--allow-root",
        "--no-browser",
        "--ip=127.0.0.1",
        f"--port={port}",
        "--ServerApp.port_retries=0",
        f"--ServerApp.root_dir={root}",
        f"--IdentityProvider.token={token}",
    ]


def _await_server(address: str, server: subprocess.Popen[bytes], log: Path) -> None:
    end = time.monotonic() + LIMIT
    while server.poll() is None and time.monotonic() < end:
        try:
            urllib.request.urlopen(address, timeout=LIMIT)
        except OSError:
            time.sleep(0.1)
        else:
            return
    raise RuntimeError(f"the server did not start:\n{log.read_text()[-2000:]}")


@contextlib.contextmanager
def browse(*, whole: bool = False) -> Iterator[Browser]:
    """A browser, that of the system where there is one.

    Without windows of its own it takes a quarter less; `whole`: as people have it.
    """
    names = [
        *(() if whole else ("chromium-headless-shell",)),
        "chromium",
        "chromium-browser",
        "google-chrome",
    ]
    system = next(filter(None, map(shutil.which, names)), None)
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=system, args=_FLAGS)
        try:
            yield chromium
        finally:
            chromium.close()


class Notebook:
    """A notebook with one cell, open in an application; `run` gives it new code."""

    def __init__(self, page: Page, address: str, token: str, root: Path, app: App) -> None:
        self.page = page
        self.app = app
        self._address = address
        self._token = token
        self._root = root
        self._names: set[str] = set()
        self._errors: list[str] = []
        self._offsite: list[str] = []
        page.on("console", lambda m: self._errors.append(m.text) if m.type == "error" else None)
        page.on("pageerror", lambda error: self._errors.append(f"{error}\n{error.stack}"))
        page.on("request", lambda r: self._offsite.append(r.url) if _is_offsite(r.url) else None)
        page.set_default_timeout(1000 * LIMIT)

    def open(self, code: str, name: str = "test.ipynb") -> None:
        """Write a notebook with that code and open it anew; Voilà runs it, too."""
        if self._in_lab():
            self.page.evaluate(_CLOSE, name)
        notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(code)])
        notebook.metadata.kernelspec = {"name": "python3", "display_name": "Python 3", "language": "python"}
        nbformat.write(notebook, self._root / name)
        self.visit(name)

    def visit(self, name: str) -> None:
        """Open a notebook that is there."""
        self._names.add(name)
        if self._in_lab():
            self.page.evaluate(_OPEN, name)
            self._await_kernel()
            return
        path = {
            "lab": f"/lab/workspaces/{secrets.token_hex(4)}/tree/{name}?reset&token={self._token}",
            "notebook": f"/notebooks/{name}?token={self._token}",
            "voila": f"/voila/render/{name}",
        }[self.app]
        self.page.goto(self._address + path)
        if self.app != "voila":
            self._await_kernel()

    def _in_lab(self) -> bool:
        """Whether JupyterLab has been started on the page."""
        return self.app == "lab" and self.page.url.startswith(f"{self._address}/lab")

    def _await_kernel(self) -> None:
        """Wait until the notebook that is looked at has a kernel that waits for work."""
        self.page.wait_for_function(
            f"""() => {{
                const panel = window.jupyterapp?.shell.currentWidget;
                return panel?.context?.isReady
                    && {_PANEL}.sessionContext?.session?.kernel?.connectionStatus === "connected"
                    && {_PANEL}.sessionContext.kernelDisplayStatus === "idle";
            }}""",
        )

    @contextlib.contextmanager
    def beside(self) -> Iterator[None]:
        """Open other notebooks in JupyterLab; at the end they are closed with their kernels, and this one is back."""
        own, self._names = self._names, set()
        try:
            yield
        finally:
            theirs, self._names = self._names, own
            for name in theirs:
                self.page.evaluate(_CLOSE, name)
            self._end(theirs)
            for name in own:
                self.page.evaluate(_OPEN, name)
            self._await_kernel()

    @property
    def root(self) -> Path:
        """Where the server finds its notebooks."""
        return self._root

    def address(self, name: str) -> str:
        """Where JupyterLab shows a notebook, as a person would link to it."""
        return f"{self._address}/lab/tree/{name}?token={self._token}"

    def end(self) -> None:
        """Leave the page; the kernels of the notebooks that were open end."""
        self.page.goto("about:blank")  # Voilà ends its own
        if self.app != "voila":
            self._end(self._names)

    def _end(self, names: set[str]) -> None:
        """End the kernels of those notebooks."""
        for session in self._ask("sessions"):
            if session["path"] in names:
                self._ask(f"sessions/{session['id']}", "DELETE")

    def _ask(self, what: str, method: str = "GET") -> Any:
        """Ask the server itself."""
        request = urllib.request.Request(
            f"{self._address}/api/{what}", method=method, headers={"Authorization": f"token {self._token}"}
        )
        with urllib.request.urlopen(request, timeout=LIMIT) as reply:
            return json.loads(reply.read() or b"null")

    def run(self, code: str | None = None) -> None:
        """Run all cells, the first one with new code if some is given; raises what the code raises."""
        if code is not None:
            self.page.evaluate(
                f"code => {_PANEL}.content.model.sharedModel.cells[0].setSource(code)",
                code,
            )
        self.page.evaluate("() => window.jupyterapp.commands.execute('notebook:run-all-cells')")
        outputs = self.page.evaluate(
            f"""() => [...{_PANEL}.content.model.cells]
                .filter(cell => cell.type === "code").flatMap(cell => cell.outputs.toJSON())"""
        )
        errors = [f"{o['ename']}: {o['evalue']}" for o in outputs if o["output_type"] == "error"]
        if errors:
            raise AssertionError(errors)

    def python(self, expression: str) -> Any:
        """The value of a JSON-like expression in the kernel."""
        code = f"import json as _json; _value = _json.dumps({expression})"
        text = self.page.evaluate(
            f"""async code => {{
                const kernel = {_PANEL}.sessionContext.session.kernel;
                const future = kernel.requestExecute({{code, user_expressions: {{value: "_value"}}}});
                const reply = await future.done;
                if (reply.content.status !== "ok") throw new Error(reply.content.evalue);
                return reply.content.user_expressions.value.data["text/plain"];
            }}""",
            code,
        )
        return json.loads(ast.literal_eval(text))  # the repr of a str

    def expect_python(self, expression: str, value: Any) -> None:
        """Wait until an expression in the kernel has a value: what was typed last may still be on its way.

        Until then the expression may as well raise, as where it names what is still to be made.
        """

        def check() -> None:
            try:
                found = self.python(expression)
            except Error as error:
                raise AssertionError(f"{expression} raises {error}") from error
            assert found == value, f"{expression} is {found!r}, expected {value!r}"

        eventually(self.page, check)

    def shown(self) -> None:
        """Wait until every widget that the cells display stands on the page, and has settled."""
        self.page.wait_for_function(
            f"""() => {{
                const views = [...{_PANEL}.content.model.cells].filter(cell => cell.type === "code")
                    .flatMap(cell => cell.outputs.toJSON())
                    .filter(output => output.data?.["application/vnd.jupyter.widget-view+json"]);
                const made = [...document.querySelectorAll(".fnb")];
                const waiting = [...document.querySelectorAll(".fnb-page-slot > .fnb-empty")];
                return made.length >= views.length && made.every(own => own.childElementCount)
                    && !waiting.some(own => own.checkVisibility());
            }}"""
        )
        self.settle()

    def settle(self) -> None:
        """Wait until the kernel has answered what it was sent, and the page has drawn the answers."""
        for _ in range(2):  # an answer may ask for more
            self.python("None")
            frames(self.page)

    def resize(self, width: int, height: int = 1000) -> None:
        """Give the window another size, and wait until the page is laid out in it."""
        self.page.set_viewport_size({"width": width, "height": height})
        self.page.wait_for_function("width => window.innerWidth === width", arg=width)
        frames(self.page, 3)

    def retype(self, label: str, text: str) -> Locator:
        """Replace what the field of that name holds, by keys alone: all is selected, and typed over."""
        field = self.field(label)
        retype(field, text)
        return field

    def trust(self) -> None:
        """Trust the notebook's saved outputs."""
        self.page.evaluate(
            f"() => {{ for (const cell of {_PANEL}.content.model.cells) cell.trusted = true; }}"
        )

    def theme(self, name: Literal["JupyterLab Light", "JupyterLab Dark"]) -> None:
        """Switch the theme."""
        self.page.evaluate(
            "theme => window.jupyterapp.commands.execute('apputils:change-theme', {theme})", name
        )

    def shapes(self) -> int:
        """How many shapes the elevation shows."""
        return self.page.locator(".fnb-elevation [data-shape]").count()

    def field(self, label: str) -> Locator:
        """The field of that name."""
        return self.page.get_by_label(label, exact=True)

    def button(self, name: str) -> Locator:
        """The button of that name."""
        return self.page.get_by_role("button", name=name, exact=True)

    def take_problems(self) -> list[str]:
        """Errors in the console since the last call, without those known to be harmless, and requests offsite."""
        found = [
            e for e in self._errors if not any(word in e for word in _HARMLESS) and not _LABS_OWN.search(e)
        ]
        found += [url for url in self._offsite if self.app != "voila"]
        self._errors.clear()
        self._offsite.clear()
        return found


def _is_offsite(url: str) -> bool:
    return url.startswith("http") and not url.startswith("http://127.0.0.1")
