"""The Studio's latency, sizes and cold starts, measured in a real JupyterLab.

A keystroke, or a step of a drag of the canvas' edge, is timed in the page: from the event to the first animation frame
after the new elevation has been put in the page. An empty widget, in the same notebook and taking turns with it, sends
as much each way and draws nothing: what no widget of this set-up can be quicker than.

Hover and pan are timed by the intervals of `requestAnimationFrame` while a real pointer moves, beside those of a page
in which nothing moves; what is sent to the kernel meanwhile is counted.
"""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient
from playwright.sync_api import Page, expect

from tests.browser.jupyter import Notebook, browse, serve
from tests.browser.waiting import frames

__all__ = ["main"]

ROOT = Path(__file__).resolve().parents[2]
ROUNDS = 40
MOVES = 240

CODE = """
import anywidget, json, traitlets
from facade_nb import gallery
from facade_nb.widgets import FacadeModel, Studio
from IPython.display import display

class Empty(anywidget.AnyWidget):
    _esm = '''export default { render({ model, el }) {
        const out = document.createElement("output");
        el.append(out);
        model.on("change:reply", () => { out.textContent = model.get("reply").slice(0, 20); });
        window.askEmpty = (text) => { model.set("text", text); model.save_changes(); };
        window.emptyOutput = out;
    } }'''
    text = traitlets.Unicode().tag(sync=True)
    reply = traitlets.Unicode().tag(sync=True)

studio = Studio(FacadeModel(gallery.load("NAME"), time_limit=60.0))
channel = studio.channel
size = len(channel.svg) + len(json.dumps(channel.design)) + len(json.dumps(channel.status))
empty = Empty()
empty.observe(lambda change: setattr(empty, "reply", f"{change['new'][:10]} " + "x" * size), "text")
display(studio, empty)
"""

TYPED = {
    "residential-house": ("Pattern Bx", ("A(BA)^k", "A(BA)^2")),
    "bookshop": ("Pattern dormers", ("A(MABA)^s MA", "A(MABA)^2 MA")),
}
"""By design, a field and what is typed into it in turns."""

TIMED = """([event, watched]) => {
    window.timed = new Promise((resolve, reject) => {
        const timer = setTimeout(() => reject(new Error("nothing was repainted in 60 s")), 60000);
        let began = performance.now();
        if (event) window.addEventListener(event, () => { began = performance.now(); }, { capture: true, once: true });
        const facade = ".fnb-sheet > svg:not(.fnb-overlay)"; // made anew, or changed where it differs
        const drawn = ({ type, target, addedNodes }) => type === "characterData" || target.closest?.(facade) ||
            [...addedNodes].some((node) =>
                node.nodeType === Node.TEXT_NODE ? window.emptyOutput.contains(node) : node.matches(facade));
        const observer = new MutationObserver((records) => {
            if (!records.some(drawn)) return; // such as a label beside the pointer
            observer.disconnect();
            clearTimeout(timer);
            requestAnimationFrame(() => resolve(performance.now() - began));
        });
        observer.observe(eval(watched), { attributes: true, childList: true, characterData: true, subtree: true });
    });
}"""
SHEET = "document.querySelector('.fnb-sheet')"


def main() -> None:
    """Print the table."""
    print_latency()
    print_frames()
    print_sizes()
    print_cold()


def print_latency() -> None:
    """Time keystrokes and steps of a drag beside the empty widget, in turns."""
    print(
        f"{'input to repaint, ms':38} {'median':>8} {'p95':>8} {'ratio':>8} {'ratio':>8} {'search':>8}   "
        "goal: ratios 1.5, 2"
    )
    for design in TYPED:
        with (
            tempfile.TemporaryDirectory() as name,
            serve(Path(name), "lab") as (address, token),
            browse(whole=True) as chromium,
            chromium.new_page(viewport={"width": 1400, "height": 1000}) as page,
        ):
            lab = Notebook(page, address, token, Path(name), "lab")
            lab.open(CODE.replace("NAME", design))
            lab.run()
            expect(page.locator(".fnb-elevation [data-shape]").first).to_be_visible(timeout=120_000)
            page.wait_for_timeout(2000)
            _print_rows(design, *_rows(lab, design))


def _rows(lab: Notebook, design: str) -> tuple[dict[str, list[float]], dict[str, list[float]]]:
    """What each kind of input took, and how long the search after it went on, milliseconds.

    What is painted first may be the layout that is known before the search has come to its end.
    """
    page = lab.page
    width = float(lab.python("studio.model.design.canvas.width"))
    field, texts = TYPED[design]
    acts: dict[str, Callable[[int], None]] = {
        "empty widget": lambda turn: _ask_empty(page, turn),
        "pattern text": lambda turn: _type(page, field, texts[turn % 2]),
        "canvas width": lambda turn: _type(page, "Canvas width in metres", f"{width + (turn + 6) / 50:.2f}"),
        "step of a drag": lambda turn: _drag(page, turn),
    }
    rows: dict[str, list[float]] = {label: [] for label in acts}
    solving: dict[str, list[float]] = {label: [] for label in acts}
    for turn in range(-5, ROUNDS):  # the first few warm up and do not count
        for label, act in acts.items():
            act(turn)
            milliseconds = float(page.evaluate("() => window.timed"))
            page.mouse.up()
            lab.python("studio.model.wait()")  # nothing is under way when the next turn begins
            solved = 0.0 if label == "empty widget" else 1000 * lab.python("studio.model.seconds")
            if turn >= 0:
                rows[label].append(milliseconds)
                solving[label].append(solved)
    return rows, solving


def _print_rows(design: str, rows: dict[str, list[float]], solving: dict[str, list[float]]) -> None:
    least = _figures(rows["empty widget"])
    for label, times in rows.items():
        median, late = _figures(times)
        print(
            f"{f'{design}, {label}':38} {median:8.1f} {late:8.1f} {median / least[0]:8.2f} {late / least[1]:8.2f} "
            f"{statistics.median(solving[label]):8.1f}"
        )


def _figures(times: list[float]) -> tuple[float, float]:
    """Median and 95th percentile."""
    return statistics.median(times), sorted(times)[int(0.95 * len(times))]


def _ask_empty(page: Page, turn: int) -> None:
    """Start a round trip of the empty widget."""
    page.evaluate(TIMED, [None, "window.emptyOutput"])
    page.evaluate("text => window.askEmpty(text)", f"{turn:08}" + "y" * 140)


def _type(page: Page, label: str, text: str) -> None:
    """Put a text into a field, as one key would."""
    page.evaluate(TIMED, [None, SHEET])
    page.evaluate(
        """([label, text]) => {
            const field = document.querySelector(`[aria-label="${label}"]`);
            field.value = text;
            field.dispatchEvent(new Event("input"));
        }""",
        [label, text],
    )


def _drag(page: Page, turn: int) -> None:
    """Take the façade's right edge and move it, now wider, now narrower."""
    box = page.locator(".fnb-edge-width .fnb-edge-grip").bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    frames(page)  # the scale is held from now on, which draws the façade once more
    page.evaluate(TIMED, ["pointermove", SHEET])
    page.mouse.move(x + (6 if turn % 2 else -6), y)


STUDIO = """
from facade_nb import gallery
from facade_nb.widgets import FacadeModel, Studio
model = FacadeModel(gallery.load("NAME"), time_limit=60.0)
Studio(model)
"""

WATCH = """() => {
    const kernel = window.jupyterapp.shell.currentWidget.sessionContext.session.kernel;
    const watched = window.watched = { times: [], sent: 0, on: true };
    const note = (_, { direction }) => { if (direction === "send") watched.sent += 1; };
    kernel.anyMessage.connect(note);
    watched.end = () => { watched.on = false; kernel.anyMessage.disconnect(note); };
    const frame = (at) => { watched.times.push(at); if (watched.on) requestAnimationFrame(frame); };
    requestAnimationFrame(frame);
}"""

WATCHED = """() => {
    const { times, sent, end } = window.watched;
    end();
    return [times.slice(1).map((at, i) => at - times[i]), sent];
}"""


def print_frames() -> None:
    """Time the frames while the pointer goes over the façade, and while the façade is moved."""
    print(
        f"\n{'frames while the pointer moves, ms':34} {'frames':>8} {'median':>8} {'p95':>8} {'longest':>8} "
        f"{'sent':>8}   goal: median 16.7, sent 0"
    )
    with (
        tempfile.TemporaryDirectory() as name,
        serve(Path(name), "lab") as (address, token),
        browse(whole=True) as chromium,
        chromium.new_page(viewport={"width": 1400, "height": 1000}) as page,
    ):
        lab = Notebook(page, address, token, Path(name), "lab")
        for design in ("residential-house", "bookshop"):
            lab.open(STUDIO.replace("NAME", design), f"{design}.ipynb")
            lab.run()
            lab.shown()
            page.locator(".fnb-elevation [data-shape]").first.scroll_into_view_if_needed()
            lab.settle()
            for label, action in (("nothing", _rest), ("hover", _hover), ("pan", _pan)):
                page.evaluate(WATCH)
                action(lab)
                times, sent = page.evaluate(WATCHED)
                median, late = statistics.median(times), sorted(times)[int(0.95 * len(times))]
                print(
                    f"{f'{design}, {label}':34} {len(times):8} {median:8.1f} {late:8.1f} {max(times):8.1f} {sent:8}"
                )


def _rest(lab: Notebook) -> None:
    lab.page.wait_for_timeout(4000)


def _hover(lab: Notebook) -> None:
    """Go to and fro over the façade."""
    box = lab.page.locator(".fnb-sheet").bounding_box()
    assert box
    left, right = box["x"] + 0.1 * box["width"], box["x"] + 0.9 * box["width"]
    for turn in range(4):
        height = box["y"] + (0.3 + 0.15 * turn) * box["height"]
        lab.page.mouse.move((left, right)[turn % 2], height)
        lab.page.mouse.move((right, left)[turn % 2], height, steps=MOVES // 4)


def _pan(lab: Notebook) -> None:
    """Drag the façade about with the middle button."""
    box = lab.page.locator(".fnb-paper").bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    mouse = lab.page.mouse
    mouse.move(x, y)
    mouse.down(button="middle")
    for turn in range(4):
        mouse.move(x + (-1) ** turn * 120, y + 20 * turn, steps=MOVES // 4)
    mouse.up(button="middle")


def print_sizes() -> None:
    """Run the studio notebook and print what its widgets send, and what it weighs saved."""
    notebook = nbformat.read(ROOT / "notebooks" / "studio.ipynb", as_version=4)
    NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(ROOT / "notebooks")}}).execute()
    states: dict[str, Any] = notebook.metadata["widgets"]["application/vnd.jupyter.widget-state+json"][
        "state"
    ]
    sent = {key: len(json.dumps(state, ensure_ascii=False).encode()) for key, state in states.items()}
    saved = len(nbformat.writes(notebook).encode())
    print(f"\n{'studio notebook, kB':34} {'':8} {'':8} {'goal':>8}")
    print(f"{f'sent by {len(sent)} front-end instances':34} {sum(sent.values()) / 1000:8.1f} {'':8} {300:8}")
    print(f"{'saved with widget state':34} {saved / 1000:8.1f} {'':8} {500:8}")


def print_cold() -> None:
    """Print how long a fresh process takes to import, and to solve the house for the first time."""
    code = """
import time; a = time.perf_counter()
import facade_nb; b = time.perf_counter()
design = facade_nb.gallery.load("residential-house"); c = time.perf_counter()
facade_nb.solve(design); d = time.perf_counter()
print(1000 * (b - a), 1000 * (d - c))
"""

    def run() -> list[float]:
        done = subprocess.run(
            [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
        )
        return [float(value) for value in done.stdout.split()]

    runs = [run() for _ in range(5)]
    imported, solved = (statistics.median(column) for column in zip(*runs, strict=True))
    print(f"\n{'cold start, ms (median of 5)':34}")
    print(f"{'import facade_nb':34} {imported:8.1f}")
    print(f"{'solve the residential house':34} {solved:8.1f}")


if __name__ == "__main__":
    main()
