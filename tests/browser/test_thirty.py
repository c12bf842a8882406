"""Thirty studios in one notebook, cells run again and again: nothing blank, nothing grows. Counted, not timed."""

from __future__ import annotations

from typing import Any

import nbformat
from playwright.sync_api import CDPSession, expect

from .conftest import Visit
from .jupyter import Notebook
from .waiting import eventually, frames

STUDIOS = 30
AGAIN = 6
RUNS = 5
"""So many of them are run again, once and then so often."""
SHAPES = 17

FIRST = """
import gc, threading
from ipywidgets.widgets import widget as _widget
from facade_nb import gallery
from facade_nb.widgets import Studio
house = gallery.load("residential-house")
def kept():
    gc.collect()
    own = [w for w in _widget._instances.values()]
    text = sum(len(v) for w in own for v in w.get_state().values() if isinstance(v, str))
    return {"text": text, "widgets": len(own), "threads": threading.active_count()}
"""

CONTEXTS = """() => {
    window.contexts = 0;
    const own = HTMLCanvasElement.prototype;
    window.contextOnce ??= own.getContext;
    own.getContext = function (kind, ...more) {
        const context = window.contextOnce.call(this, kind, ...more);
        if (context && kind.startsWith("webgl")) window.contexts += 1;
        return context;
    };
}"""
UNCOUNTED = "() => { HTMLCanvasElement.prototype.getContext = window.contextOnce; }"
RUN_SOME = """async count => {
    const { content } = window.jupyterapp.shell.currentWidget;
    content.deselectAll();
    content.activeCellIndex = 1;
    content.extendContiguousSelectionTo(count);
    await window.jupyterapp.commands.execute("notebook:run-cell");
}"""

BLANK = f"""() => [...document.querySelectorAll(".fnb-part-studio")]
    .filter(own => own.querySelectorAll(".fnb-elevation [data-shape]").length !== {SHAPES}).length"""


def page_counts(lab: Notebook, session: CDPSession) -> dict[str, int]:
    """What the page holds, after what is not held any more was swept away.

    A view that has gone may still be waited for: it is looked again and again, until nothing more goes.
    """
    lab.settle()
    counts = {"nodes": 10**9}
    while True:
        session.send("HeapProfiler.collectGarbage")
        before, counts = counts, session.send("Memory.getDOMCounters")
        if counts["nodes"] > 0.999 * before["nodes"]:
            break
        lab.page.wait_for_timeout(2000)
    sheets = "() => document.adoptedStyleSheets.length + document.querySelectorAll('style').length"
    return {
        "nodes": counts["nodes"],
        "listeners": counts["jsEventListeners"],
        "sheets": lab.page.evaluate(sheets),
        "contexts": lab.page.evaluate("() => window.contexts"),
    }


def expect_studios(lab: Notebook) -> None:
    """Wait for all studios, and look at each."""
    expect(lab.page.locator(".fnb-part-studio")).to_have_count(STUDIOS)

    def none_blank() -> None:
        assert lab.page.evaluate(BLANK) == 0

    eventually(lab.page, none_blank)
    frames(lab.page)


def test_thirty_studios_of_which_some_are_run_again_and_again(visit: Visit) -> None:
    with visit("lab") as lab:
        lab.page.evaluate(CONTEXTS)
        cells = [FIRST, *["Studio(house)"] * STUDIOS]
        notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(code) for code in cells])
        notebook.metadata.kernelspec = {"name": "python3", "display_name": "Python 3", "language": "python"}
        nbformat.write(notebook, lab.root / "thirty.ipynb")
        lab.visit("thirty.ipynb")
        session = lab.page.context.new_cdp_session(lab.page)
        empty = page_counts(lab, session)
        lab.run()
        table: list[dict[str, Any]] = []
        for times in (0, 1, RUNS):
            for _ in range(times):
                lab.page.evaluate(RUN_SOME, AGAIN)
                expect_studios(lab)
            expect_studios(lab)
            table.append(page_counts(lab, session) | lab.python("kept()"))
        lab.page.evaluate(UNCOUNTED)
        heads = list(table[0])
        print("\n" + "".join(f"{head:>12}" for head in ["run", *heads]))
        for number, row in zip((1, 2, 2 + RUNS), table, strict=True):
            print("".join(f"{value:12}" for value in [number, *row.values()]))
        first, second, last = table
        assert last["contexts"] == 0  # an elevation needs none
        assert last["sheets"] == second["sheets"]
        assert last["threads"] <= second["threads"] + 1
        for head in ("nodes", "listeners"):
            # The browser keeps now two, now eight of the studios that have gone: of each it must be less than a half.
            kept = (last[head] - second[head]) / (RUNS * AGAIN)
            one = (first[head] - empty[head]) / STUDIOS
            assert kept < 0.5 * one, f"a studio that was run away keeps {kept:.0f} {head} of {one:.0f}"
        a_run = (last["text"] - second["text"]) / (RUNS * AGAIN)
        assert a_run < 2000, f"a studio that was run away keeps {a_run:.0f} letters"
        assert lab.take_problems() == []
