"""TownView in a real JupyterLab, 20,000 buildings, WebGL2 in software: its first frames, and frames while one flies.

*First*: from running the cell to a first frame, which may be coarse; *kernel*: of that, until the kernel has answered.
The town was generated before. *A real town, fresh*: all of Liechtenstein, imports and the reading of its file included.
*Anew*: all modules of facade_nb were dropped, and imported again.
*Cpu*: seconds of all processors until then, of kernel, server and browser. *Sharp*: until all is as it will stay.
*Frame*: milliseconds between two frames of the page while keys are held; *coarse*: how many pixels of the canvas one
that is drawn then stands for, along each side.
"""

from __future__ import annotations

import os
import statistics
import sys
import tempfile
from pathlib import Path
from typing import Any

from tests.browser.jupyter import Notebook, browse, serve

__all__ = ["main"]

MADE = """
from facade_nb.render.town import Town
town = Town.generate({buildings}, seed=1)
"""
SHOWN = """
from facade_nb.widgets import TownView
view = TownView(town, {view!r}, layout={{"width": "900px"}})
view
"""
REAL = """
from facade_nb.render.town import Town
from facade_nb.widgets import TownView
view = TownView(Town.from_geojson({file!r}), {view!r}, layout={{"width": "900px"}})
view
"""
FILE = Path(__file__).parents[3] / "shared" / "data" / "towns" / "liechtenstein.geojson.gz"
"""A whole country. Where the data are not there, its row is left out."""

ANEW = """
import sys
for name in [name for name in sys.modules if name.startswith("facade_nb")]:
    del sys.modules[name]
from facade_nb.render.town import Town
town = Town.generate({buildings}, seed=1)
"""

COLD = """
import tempfile
from facade_nb.render.tiles import tileset
from facade_nb.render.tiles.drawn import Drawn
from pathlib import Path
tileset._DRAWN = Drawn(Path(tempfile.mkdtemp()))
"""

RUN = """async code => {
    const {content, sessionContext} = window.jupyterapp.shell.currentWidget;
    content.model.sharedModel.cells[0].setSource(code);
    const began = performance.now();
    let kernel = 0;
    window.jupyterapp.commands.execute("notebook:run-all-cells").then(() => { kernel = performance.now() - began; });
    const canvas = () => document.querySelector(".fnb-town-canvas");
    const until = async (done) => {
        while (!done()) await new Promise(requestAnimationFrame);
        return performance.now() - began;
    };
    await until(() => !canvas());
    const first = await until(() => canvas()?.dataset.coarse);
    window.sharp = () => until(() => canvas().dataset.state === "sharp");
    return {kernel, first};
}"""

FLY = """async ([keys, frames]) => {
    const canvas = document.querySelector(".fnb-town-canvas");
    const press = (type) => {
        for (const code of keys) canvas.dispatchEvent(new KeyboardEvent(type, {code, key: code, bubbles: true}));
    };
    const frame = () => new Promise(requestAnimationFrame);
    canvas.focus();
    press("keydown");
    const took = [];
    const coarse = [];
    let last = await frame();
    for (let k = 0; k < frames; k++) {
        const now = await frame();
        took.push(now - last);
        coarse.push(Number(canvas.dataset.coarse));
        last = now;
    }
    press("keyup");
    return {took: took.slice(frames >> 1), coarse: coarse.slice(frames >> 1)};
}"""


def busy() -> float:
    """Seconds of processor time that this process's children and theirs have had: server, kernels, browser."""
    parents, spent = {}, {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:  # it has just ended
            continue
        pid = int(stat.parent.name)
        parents[pid], spent[pid] = int(fields[1]), int(fields[11]) + int(fields[12])
    own = {os.getpid()}
    while more := {pid for pid, parent in parents.items() if parent in own} - own:
        own |= more
    return sum(spent[pid] for pid in own) / os.sysconf("SC_CLK_TCK")


def show(page: Any, view: str, file: Path | None = None) -> dict[str, float]:
    """Run the cell, with a real town of a `file`; milliseconds, and seconds of processors until the first frame."""
    before = busy()
    code = REAL.format(view=view, file=str(file)) if file is not None else SHOWN.format(view=view)
    took: dict[str, float] = page.evaluate(RUN, code)
    took["cpu"] = busy() - before
    took["sharp"] = page.evaluate("() => window.sharp()")
    return took


def tell(name: str, took: dict[str, float]) -> None:
    """Print a row."""
    figures = " ".join(f"{took[key]:7.0f}" for key in ("kernel", "first", "sharp"))
    print(f"{name:24} {figures} {took['cpu']:7.1f}", flush=True)


def fly(page: Any, keys: list[str], frames: int = 60) -> tuple[float, float, float]:
    """Median and 95th percentile of the milliseconds of a frame, and how coarse they were."""
    found = page.evaluate(FLY, [keys, frames])
    took = sorted(found["took"])
    return statistics.median(took), took[int(0.95 * len(took))], statistics.median(found["coarse"])


def main(buildings: int = 20_000) -> None:
    """Print the tables."""
    with (
        tempfile.TemporaryDirectory() as folder,
        serve(Path(folder), "lab") as (address, token),
        browse(whole=True) as chromium,
        chromium.new_page(viewport={"width": 1400, "height": 1200}) as page,
    ):
        lab = Notebook(page, address, token, Path(folder), "lab")
        lab.open("0")
        print(f"{'cell':24} {'kernel':>7} {'first':>7} {'sharp':>7} {'cpu':>7}")
        for name, before in (
            ("fresh kernel", MADE),
            ("imported anew", ANEW),
            ("once more", "0"),
            ("no tile drawn yet", COLD),
        ):
            lab.run(before.format(buildings=buildings))
            took = show(page, "distance")
            tell(name, took)
        if FILE.exists():
            with lab.beside():
                lab.open("0", "real.ipynb")
                tell("a real town, fresh", show(page, "distance", FILE))
        print(f"{'in motion':24} {'frame':>7} {'p95':>7} {'coarse':>7}")
        for view in ("distance", "street", "close-up"):
            for keys in (["KeyW"], ["ArrowRight"]):
                show(page, view)
                frame, late, coarse = fly(page, keys)
                print(f"{view + ', ' + keys[0]:24} {frame:7.0f} {late:7.0f} {coarse:7.1f}", flush=True)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
