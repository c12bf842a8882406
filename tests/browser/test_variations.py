"""Many designs in a real JupyterLab: solved one by one, cancelled, sorted, opened and undone, by keys and mouse."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from playwright.sync_api import expect

from .jupyter import Notebook

CODE = """
import threading
from IPython.display import display
from facade_nb.variations import answers
gate, solved = threading.Event(), answers.solve
def slow(design, *, should_stop, **more):
    while design.canvas.width == 7.5 and not gate.is_set() and not should_stop():
        gate.wait(0.01)
    return solved(design, should_stop=should_stop, **more)
answers.solve = slow
view = VariationsView(model, width=[6, 9, 0.3, 7.5, 8])
display(view)
display(ElevationView(model))
"""


def test_variants_are_cancelled_gone_on_with_sorted_opened_and_undone(
    show: Callable[[str], Notebook], out: Path
) -> None:
    lab = show(CODE)
    page = lab.page
    rows = page.locator(".fnb-var-row")
    said = page.locator(".fnb-var-said")
    expect(said).to_have_text("3 of 5 solved, 1 without a layout")
    expect(page.locator(".fnb-var-progress")).to_have_js_property("position", 0.6)
    expect(rows.nth(2)).to_contain_text("Pattern 'Rx': its shortest word, H, measures 6 m")
    lab.button("Cancel").press("Enter")
    expect(said).to_have_text("Stopped: 3 of 5 solved, 1 without a layout")
    lab.python("gate.set()")
    lab.button("Go on").press("Enter")
    expect(said).to_have_text("5 variants, 1 without a layout")
    lab.python("setattr(answers, 'solve', solved)")
    expect(lab.button("Go on")).to_be_hidden()
    expect(rows.locator("img:visible")).to_have_count(4)
    # By the keyboard: sorted by windows, the most first; the next row opened.
    windows = page.locator("th button", has_text="windows")
    for way in ("ascending", "descending"):
        windows.press("Enter")
        expect(page.locator("th[aria-sort]:has(button:text('windows'))")).to_have_attribute("aria-sort", way)
    counts = [
        int(text) for text in page.locator(".fnb-var-row td[data-title=windows]:visible").all_inner_texts()
    ]
    assert counts == sorted(counts, reverse=True) and len(counts) == 4
    expect(rows.last).to_have_attribute("data-state", "error")
    page.keyboard.press("Tab")
    while not page.evaluate("() => document.activeElement.matches('.fnb-var-row')"):
        page.keyboard.press("Tab")
    page.keyboard.press("Home")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    expect(rows.nth(1)).to_have_attribute("data-opened", "")
    number = int(rows.nth(1).get_attribute("data-row") or -1)
    lab.expect_python(f"model.design == view.model.variants.designs[{number}]", True)
    page.screenshot(path=out / "variations.png")
    page.keyboard.press("ControlOrMeta+z")
    lab.expect_python("model.design == gallery.load('residential-house')", True)
    # As pictures, in the dark, where it is narrow: a click opens one.
    lab.button("Pictures").click()
    lab.resize(680)
    lab.theme("JupyterLab Dark")
    rows.nth(0).click()
    lab.expect_python("model.design.canvas.width", 9)
    assert page.evaluate(
        "() => document.querySelector('.fnb-var-box').scrollWidth <= document.querySelector('.fnb-var-box').clientWidth"
    )
    page.screenshot(path=out / "variations-dark.png")
    lab.theme("JupyterLab Light")
