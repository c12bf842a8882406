"""What is seen, in a real JupyterLab: text that can be read, bundles that leave each other's looks alone, Figure 3."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from playwright.sync_api import expect

from .jupyter import Notebook
from .waiting import eventually, frames

CONTRASTS = """() => {
    const box = document.querySelector(".fnb-studio").appendChild(document.createElement("i"));
    const pen = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
    const light = colours => {
        for (const colour of colours) {
            box.style.color = `var(--fnb-${colour})`;
            pen.fillStyle = getComputedStyle(box).color;
            pen.fillRect(0, 0, 1, 1);
        }
        const [r, g, b] = [...pen.getImageData(0, 0, 1, 1).data].map(c => {
            const part = c / 255;
            return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
        });
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const found = {};
    for (const ink of ["text", "muted", "link", "error", "good"])
        for (const ground of [["0"], ["1"], ["1", "picked"], ["2"]]) {
            if (ground[0] === "2" && (ink === "error" || ink === "good")) continue;  // no sign stands there
            const [a, b] = [light(ground), light([...ground, ink])].sort((x, y) => y - x);
            found[`${ink} on ${ground.join(" ")}`] = (a + 0.05) / (b + 0.05);
        }
    box.remove();
    return found;
}"""


def test_small_text_can_be_read_in_both_themes(show: Callable[[str], Notebook]) -> None:
    lab = show("Studio(model)")
    for theme in ("JupyterLab Dark", "JupyterLab Light"):
        lab.theme(theme)
        frames(lab.page, 3)

        def read() -> None:
            found: dict[str, float] = lab.page.evaluate(CONTRASTS)
            assert len(found) == 18
            assert {name: ratio for name, ratio in found.items() if ratio < 4.5} == {}

        eventually(lab.page, read)


def test_bundles_on_one_page_leave_each_other_alone_and_figure_3_has_a_legend(
    show: Callable[[str], Notebook], out: Path
) -> None:
    lab = show(
        "from facade_nb import solve\nfrom IPython.display import display\ndisplay(Studio(model, name=''))"
    )
    page = lab.page

    def seen() -> list[Any]:
        """Of a qualifier's word, and of a group's chip: where the solver's views have such names, too."""
        return page.locator(".fnb-symbol .fnb-word").first.evaluate(
            "own => { const { display, height, padding, borderTopWidth } = getComputedStyle(own); "
            "return [display, height, padding, borderTopWidth, own.offsetWidth]; }"
        )

    alone = seen()
    lab.run(
        "from facade_nb import Design, gallery, solve\nfrom facade_nb.widgets import *\n"
        "from IPython.display import display\nmodel = FacadeModel(gallery.load('residential-house'))\nmodel.wait()\n"
        "display(WordsView(solve(gallery.load('figure-7'), trace=True)), Studio(model, name=''))"
    )
    lab.shown()
    expect(page.locator(".fnb-part-words .fnb-word[data-reason]").first).to_be_visible()
    assert seen() == alone
    rows = page.locator(".fnb-part-words .fnb-word[data-reason]").first
    assert rows.evaluate("own => getComputedStyle(own).display") == "grid"
    # The paper's Figure 3: each kind of error with its number, and a kind that is put away by a key.
    lab.button("What is shown").press("Enter")
    page.locator("[data-option=naive]").press("Space")
    page.keyboard.press("Escape")
    keys = page.locator(".fnb-flaw-key")
    expect(keys).to_have_text(
        [
            "3 boundaries of layers apart",
            "1 uneven distance",
            "1 place covered",
            "1 hole",
            "2 words too short for the canvas",
        ]
    )
    expect(page.locator(".fnb-behind")).to_have_count(1)
    expect(page.locator(".fnb-flaw-short")).to_have_count(3)  # one of them in the legend
    keys.last.press("Enter")
    expect(keys.last).to_have_attribute("aria-pressed", "false")
    expect(page.locator(".fnb-flaw-short")).to_have_count(1)
    page.locator(".fnb-studio").screenshot(path=out / "looks-naive.png")
    lab.field("From words laid side by side to the aligned layout").press("End")
    expect(page.locator(".fnb-naive-said")).to_have_text("Aligned: as it is solved")
    expect(page.locator(".fnb-behind")).to_have_count(0)
