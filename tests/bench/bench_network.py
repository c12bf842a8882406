"""Panning and zooming networks of 10,000 nodes and more, in headless Chromium.

Milliseconds from frame to frame, beside a page where nothing is drawn. The first network is of two words of 99 letters,
100 × 100 nodes; the others are those of the gallery that are largest. *Step* is a step of the player, drawn.
"""

from __future__ import annotations

import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import Page, expect

from tests.browser.jupyter import Notebook, browse, serve

__all__ = ["main"]

FRAMES = 90

CODE = """
from facade_nb import Design, gallery, solve
from facade_nb.widgets import NetworkView
def long():
    return Design.from_dict({
        "format": "facade-nb/design/1", "name": "long", "canvas": {"width": 99.0, "height": 3.0},
        "symbols": {name: {"size": size} for name, size in {"A": 1.0, "B": 1.0, "C": 1.0, "D": 1.0, "Y": 3.0}.items()},
        "counters": {"k": {"value": 49}}, "patterns": {"walls": "A(BA)^k", "posts": "C(DC)^k", "height": "Y"},
        "layers": [
            {"name": "walls", "x": {"pattern": "walls"}, "y": {"pattern": "height"}},
            {"name": "posts", "x": {"pattern": "posts"}, "y": {"pattern": "height"}, "depth": 1},
        ],
    })
layout = solve(NAME, trace=True)
view = NetworkView(layout)
view
"""

MOVE = """frames => new Promise(resolve => {
    const canvas = document.querySelector('.fnb-plane-canvas');
    const box = canvas.getBoundingClientRect();
    const at = (type, x, y, buttons) => canvas.dispatchEvent(new PointerEvent(type, {
        clientX: box.left + x, clientY: box.top + y, buttons, pointerId: 1, bubbles: true }));
    const times = [], work = [];
    let n = 0, last = performance.now();
    const step = () => {
        const began = performance.now();
        times.push(began - last);
        last = began;
        if (n === 0) at('pointerdown', 300, 150, 1);
        if (n < frames / 2) at('pointermove', 300 + 60 * Math.sin(n / 5), 150 + 40 * Math.cos(n / 5), 1);
        else {
            if (n === frames / 2) at('pointerup', 300, 150, 0);
            canvas.dispatchEvent(new WheelEvent('wheel', { deltaY: n % 30 < 15 ? -80 : 80, ctrlKey: true,
                clientX: box.left + 300, clientY: box.top + 150, cancelable: true, bubbles: true }));
        }
        // The view draws in a frame callback that it asked for before ours of the next frame.
        requestAnimationFrame(() => work.push(performance.now() - began));
        if (++n > frames) resolve([times.slice(2), work.slice(2)]);
        else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
})"""

DRAWN = """() => new Promise(resolve => {
    const began = performance.now();
    document.querySelector('.fnb-playbar [aria-label="Step back"]').click();
    requestAnimationFrame(() => { resolve(performance.now() - began); });
})"""


def main() -> None:
    """Print the table."""
    head = ("nodes", "frame", "p95", "worst", "ratio")
    print(f"{'ms':18} {' '.join(f'{name:>9}' for name in head)}   still page: frame    step")
    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder), "lab") as (address, token),
        browse(whole=True) as chromium,
        chromium.new_page(viewport={"width": 1400, "height": 1000}) as page,
    ):
        lab = Notebook(page, address, token, Path(folder), "lab")
        lab.open("0")
        for name, code in (
            ("100 × 100", "long()"),
            ("terraced-house", "gallery.load('terraced-house')"),
            ("bookshop", "gallery.load('bookshop')"),
        ):
            _measure(lab, page, name, code)


def _measure(lab: Notebook, page: Page, name: str, code: str) -> None:
    lab.run(CODE.replace("NAME", code))
    expect(page.locator(".fnb-plane-canvas")).to_be_visible(timeout=60_000)
    page.wait_for_timeout(800)
    nodes = page.locator(".fnb-net-status").inner_text().split(" nodes")[0].split("; ")[-1]
    still, _ = page.evaluate(MOVE.replace(".fnb-plane-canvas", "body"), FRAMES)
    times, _ = page.evaluate(MOVE, FRAMES)
    steps = [page.evaluate(DRAWN) for _ in range(20)]
    ordered = sorted(times)
    ratio = statistics.median(times) / statistics.median(still)
    late, median = ordered[int(0.95 * len(ordered))], statistics.median(times)
    print(
        f"{name:18} {nodes:>9} {median:9.1f} {late:9.1f} {ordered[-1]:9.1f} {ratio:9.2f}        "
        f"{statistics.median(still):9.1f} {statistics.median(steps):9.1f}",
        flush=True,
    )
