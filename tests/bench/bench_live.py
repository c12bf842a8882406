"""The live view of texture grammars in a real JupyterLab: in motion, at rest, and after a keystroke.

*Frame*: milliseconds between two frames while the view is turned for some seconds, and how coarse the picture gets: a
pixel stands for that many, squared. *Sharp*, *smooth*: from the last motion to the picture at rest, the first 160 ms of
which nothing is drawn. *Keystroke*: from the input event in the editor to the first frame with the new grammar.
"""

from __future__ import annotations

import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import expect

from tests.browser.jupyter import Notebook, browse, serve

from .textures import FULL, RANDOM, SIMPLE

__all__ = ["main"]

CODE = """
from facade_nb.widgets import *
from IPython.display import display
model = TextureModel({text!r}, size=(12, 9))
view = TextureView(model, flat=False, turn=20.0, rise=-8.0, layout={{"width": "800px"}})
display(view, GrammarEditor(model))
"""

MOVE = """async () => {
    const canvas = document.querySelector(".fnb-tex-canvas");
    const frame = () => new Promise(requestAnimationFrame);
    const key = (name) => canvas.dispatchEvent(new KeyboardEvent("keydown", {key: name, bubbles: true}));
    const until = async (state) => { while (canvas.dataset.state !== state) await frame(); return performance.now(); };
    const took = [];
    let last = await frame();
    for (let k = 0; k < 40; k++) {
        key(k % 8 < 4 ? "ArrowLeft" : "ArrowRight");
        await frame();
        const now = performance.now();
        took.push(now - last);
        last = now;
    }
    const coarse = Number(canvas.dataset.coarse);
    return {took: took.slice(10), coarse, sharp: await until("sharp") - last, smooth: await until("smooth") - last};
}"""

TYPE = """async () => {
    const canvas = document.querySelector(".fnb-tex-canvas");
    const area = document.querySelector(".fnb-tex-text");
    const began = performance.now();
    area.value += "\\nOther" + Math.floor(began) + " -> Skip(0)"; // the texture changes, the picture need not
    area.dispatchEvent(new Event("input", {bubbles: true}));
    while (canvas.dataset.state === "smooth") await new Promise(requestAnimationFrame);
    await new Promise(requestAnimationFrame);
    return performance.now() - began;
}"""

TIMES = 7


def main() -> None:
    """Print the table."""
    print(f"{'grammar':8} {'frame':>6} {'p95':>6} {'coarse':>7} {'sharp':>6} {'smooth':>7} {'keystroke':>10}")
    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder), "lab") as (address, token),
        browse(whole=True) as chromium,
        chromium.new_page(viewport={"width": 1400, "height": 1200}) as page,
    ):
        lab = Notebook(page, address, token, Path(folder), "lab")
        lab.open("0")
        for name, text in {"Simple": SIMPLE, "Random": RANDOM, "Full": FULL}.items():
            lab.run("0")
            expect(page.locator(".fnb-tex-canvas")).to_have_count(0)
            lab.run(CODE.format(text=text))
            smooth = page.locator(".fnb-tex-canvas[data-state=smooth]")
            expect(smooth).to_have_count(1, timeout=120_000)
            moved = page.evaluate(MOVE)
            typed = []
            for _ in range(TIMES):
                typed.append(page.evaluate(TYPE))
                expect(smooth).to_have_count(1, timeout=120_000)
            took = sorted(moved["took"])
            print(
                f"{name:8} {statistics.median(took):6.0f} {took[int(0.95 * len(took))]:6.0f} {moved['coarse']:7.2f} "
                f"{moved['sharp']:6.0f} {moved['smooth']:7.0f} {statistics.median(typed):10.0f}",
                flush=True,
            )
