"""Stepping through the traces of all gallery designs with every view kept on the page, in a real JupyterLab.

A step is a click on the player's button, at places spread over the trace and at the beginning of every stage, forward
and back. *Paint* is from the click to the end of the animation frame in which the views have drawn; *work* is what the
browser computed for it (script, style, layout), without the wait for the frame; *all* has painting and handing
the picture over with it. Each is the least of three times the same step, since others use the machine too, but for
*paint*. An empty widget in the same notebook, taking turns, sends a few bytes to Python and back. Then each view alone
on the page: the median and the most of *work*.
"""

from __future__ import annotations

import json
import statistics
import tempfile
from pathlib import Path
from typing import Any

from playwright.sync_api import Page, expect

from facade_nb import gallery
from tests.browser.jupyter import Notebook, browse, serve

from .bench_studio import TIMED

__all__ = ["main"]

STEPS, ALONE = 25, 9
"""Places in a trace besides the stages' beginnings; with each view alone, places in all."""

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

PLACES = """[(lambda trace, steps: (lambda timeline: [
    timeline.moment_of(trace.events, at) for at in sorted({
        *(n * (len(trace.events) - 2) // (steps - 1) for n in range(steps)),
        *(own.first for own in timeline.segments(trace.events) if own.first < len(trace.events) - 1)})
])(__import__("facade_nb.widgets.solver.timeline", fromlist=["timeline"])))(layout.trace, %d)][0]"""

# A moment's link is followed; then the step is timed, there and back, three times.
STEP = """async ([moment, times]) => {
    const frame = () => new Promise(requestAnimationFrame);
    const rest = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
    const link = document.createElement("a");
    link.href = `#facade-nb=${moment}`;
    document.body.append(link);
    link.click();
    link.remove();
    await rest(200);  // what is out of sight is drawn when the player rests
    const step = (name) => new Promise((resolve) => {
        const button = document.querySelector(`.fnb-playbar [aria-label="${name}"]`);
        const channel = new MessageChannel();
        let frame = 0, done = 0;
        requestAnimationFrame(() => { frame = performance.now(); });
        const began = performance.now();
        button.click();
        const clicked = performance.now();
        channel.port1.onmessage = () => {
            const own = clicked - began;
            resolve([done - began, own + done - frame, own + performance.now() - frame]);
        };
        requestAnimationFrame(() => {
            void document.body.offsetHeight;
            done = performance.now();
            channel.port2.postMessage(0);
        });
    });
    const made = { forward: [], back: [] };
    for (let n = 0; n < times; n++)
        for (const [way, name] of [["forward", "Step forward"], ["back", "Step back"]]) {
            made[way].push(await step(name));
            await frame();
            await rest(20);
        }
    return made;
}"""

KEEP = """async (name) => {
    for (const chip of document.querySelectorAll(".fnb-page-chip"))
        if (chip.textContent !== "Follow the stage")
            if ((chip.getAttribute("aria-pressed") === "true") !== (chip.textContent === name)) chip.click();
    await new Promise((resolve) => setTimeout(resolve, 300));
}"""


def main() -> None:
    """Print both tables."""
    head = ("events", "empty", "paint", "p95", "ratio", "work", "p95", "most", "all", "p95")
    print(f"{'ms':20} {' '.join(f'{name:>7}' for name in head)}   goals: ratio 1.6, work 16")
    alone = [(name, print_design(name)) for name in gallery.names()]
    titles = list(alone[0][1])
    print(f"\n{'work, one view, ms':20} {' '.join(f'{title:>16}' for title in titles)}")
    for name, views in alone:
        figures = [f"{statistics.median(own):.1f} to {max(own):.1f}" for own in views.values()]
        print(f"{name:20} {' '.join(f'{figure:>16}' for figure in figures)}", flush=True)


def print_design(name: str) -> dict[str, list[float]]:
    """Step through one design, in a server of its own: pages of others do not slow it down."""
    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder), "lab") as (address, token),
        browse(whole=True) as chromium,
        chromium.new_page(viewport={"width": 1400, "height": 1000}) as page,
    ):
        lab = Notebook(page, address, token, Path(folder), "lab")
        lab.open("0")
        views = page_views()
        lab.run(CODE.format(name=name, views=views))
        expect(page.locator(".fnb-view")).to_have_count(len(views), timeout=60_000)
        page.wait_for_timeout(500)
        events = lab.python("len(layout.trace.events)")
        step(page, "x/analysis+0")  # warm
        paint, work, whole, empty = [], [], [], []
        for n, moment in enumerate(lab.python(PLACES % STEPS)):
            for took in step(page, moment):
                paint += [to_paint for to_paint, _, _ in took]
                work.append(min(own for _, own, _ in took))
                whole.append(min(own for _, _, own in took))
            page.wait_for_timeout(300)  # Python is told where the player rests; that is not the next step's
            asked = [f"window.askEmpty({json.dumps(f'{n} asked')})", "window.emptyOutput"]
            empty.append(float(page.evaluate(TIMED, asked)))
        floor, median = statistics.median(empty), statistics.median(paint)
        print(
            f"{name:20} {events:7d} {floor:7.1f} {median:7.1f} {late(paint):7.1f} {median / floor:7.2f} "
            f"{statistics.median(work):7.1f} {late(work):7.1f} {max(work):7.1f} "
            f"{statistics.median(whole):7.1f} {late(whole):7.1f}",
            flush=True,
        )
        return alone(page, lab)


def alone(page: Page, lab: Notebook) -> dict[str, list[float]]:
    """Work of steps with one view on the page, by its title."""
    found: dict[str, list[float]] = {}
    places = lab.python(PLACES % ALONE)[:: max(1, len(lab.python(PLACES % ALONE)) // ALONE)]
    titles = page.locator(".fnb-page-chip").all_inner_texts()[1:]
    for title in titles:
        page.evaluate(KEEP, title)
        found[title] = [min(own for _, own, _ in took) for at in places for took in step(page, at, times=2)]
    return found


def step(page: Page, moment: str, times: int = 3) -> tuple[list[Any], list[Any]]:
    """What steps forward from a moment, and back to it, took."""
    made = page.evaluate(STEP, [moment, times])
    return made["forward"], made["back"]


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
