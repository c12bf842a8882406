"""Stepping through the traces of all gallery designs with every view on the page, in a real JupyterLab.

A step is a click on the player's button. *To paint* is from the click to the end of the animation frame in which the
views have drawn; *work* is what the browser computed for it, layout included, without the wait for the frame. An empty
widget in the same notebook, taking turns, sends a few bytes to Python and back.
"""

from __future__ import annotations

import json
import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import expect

from facade_nb import gallery
from tests.browser.jupyter import Notebook, browse, serve

from .bench_studio import TIMED

__all__ = ["main"]

STEPS = 40

CODE = """
import anywidget, traitlets
from facade_nb import gallery, solve
from facade_nb.widgets import SolverView
from IPython.display import display

class Empty(anywidget.AnyWidget):
    _esm = '''export default {{ render({{ model, el }}) {{
        const out = document.createElement("output");
        el.append(out);
        model.on("change:reply", () => {{ out.textContent = model.get("reply"); }});
        window.askEmpty = (text) => {{ model.set("text", text); model.save_changes(); }};
        window.emptyOutput = out;
    }} }}'''
    text = traitlets.Unicode().tag(sync=True)
    reply = traitlets.Unicode().tag(sync=True)

layout = solve(gallery.load({name!r}), trace=True)
view = SolverView(layout, views={views!r}, follow=False)
empty = Empty()
empty.observe(lambda change: setattr(empty, "reply", change["new"]), "text")
display(view, empty)
"""

STEP = """(name) => new Promise((resolve) => {
    const button = document.querySelector(`.fnb-playbar [aria-label="${name}"]`);
    let frame = 0;
    requestAnimationFrame(() => { frame = performance.now(); });
    const began = performance.now();
    button.click();
    const clicked = performance.now();
    requestAnimationFrame(() => {
        void document.body.offsetHeight;
        const done = performance.now();
        resolve([done - began, clicked - began + done - frame]);
    });
})"""


def main() -> None:
    """Print the table."""
    head = ("events", "empty", "paint", "p95", "ratio", "work", "p95", "most")
    print(f"{'ms':20} {' '.join(f'{name:>7}' for name in head)}   goals: ratio 1.6, work 16")
    for name in gallery.names():
        print_design(name)


def print_design(name: str) -> None:
    """Step through one design, in a server of its own: pages of others do not slow it down."""
    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder), "lab") as (address, token),
        browse() as chromium,
        chromium.new_page(viewport={"width": 1400, "height": 1000}) as page,
    ):
        lab = Notebook(page, address, token, Path(folder), "lab")
        lab.open("0")
        views = page_views()
        lab.run(CODE.format(name=name, views=views))
        expect(page.locator(".fnb-view")).to_have_count(len(views), timeout=60_000)
        page.wait_for_timeout(500)
        events = lab.python("len(layout.trace.events)")
        paint, work, empty = [], [], []
        for n in range(-3, STEPS):
            lab.python(f"setattr(view.model, 'position', {max(0, n) * (events - 2) // STEPS})")
            page.wait_for_timeout(60)
            for button in ("Step forward", "Step back"):
                to_paint, own = page.evaluate(STEP, button)
                if n >= 0:
                    paint.append(to_paint)
                    work.append(own)
            page.wait_for_timeout(300)  # Python is told where the player rests; that is not the next step's
            milliseconds = page.evaluate(
                TIMED, [f"window.askEmpty({json.dumps(f'{n} asked')})", "window.emptyOutput"]
            )
            if n >= 0:
                empty.append(float(milliseconds))
    floor, median = statistics.median(empty), statistics.median(paint)
    print(
        f"{name:20} {events:7d} {floor:7.1f} {median:7.1f} {late(paint):7.1f} {median / floor:7.2f} "
        f"{statistics.median(work):7.1f} {late(work):7.1f} {max(work):7.1f}",
        flush=True,
    )


def page_views() -> list[str]:
    """The views that a page can keep, by their names."""
    source = (
        Path(__file__).resolve().parents[2]
        / "facade_nb"
        / "widgets"
        / "src"
        / "solver"
        / "views"
        / "index.ts"
    )
    text = source.read_text(encoding="utf-8")
    return [line.strip(" ,") for line in text.split("= {")[1].split("}")[0].splitlines() if line.strip(" ,")]


def late(times: list[float]) -> float:
    """The 95th percentile."""
    return sorted(times)[int(0.95 * len(times))]
