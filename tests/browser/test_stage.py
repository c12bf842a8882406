"""The stage of the Studio in JupyterLab: zoom and pan, an empty studio, what is kept, exports, snapshots, views."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from facade_nb import Design

from .conftest import Visit
from .jupyter import Notebook
from .keys import retype
from .waiting import eventually, frames

Show = Callable[[str], Notebook]
KERNEL = "window.jupyterapp.shell.currentWidget.sessionContext"
FRESH = """
from facade_nb import Design, gallery
from facade_nb.widgets import *
"""
BOX = """() => {
    const svg = document.querySelector('.fnb-sheet > svg:not(.fnb-overlay)');
    const [x, y] = svg.dataset.origin.split(' ').map(Number);
    const box = svg.getBoundingClientRect();
    const by = box.width / svg.viewBox.baseVal.width;
    return { metre: svg.dataset.scale * by, left: box.left + x * by, bottom: box.top + y * by };
}"""


@pytest.fixture
def studio(show: Show) -> Notebook:
    """The Studio on the residential house."""
    lab = show("Studio(model)")
    expect(lab.page.locator(".fnb-elevation [data-shape]")).to_have_count(17)
    lab.page.locator(".fnb-sheet:not([data-settling])").wait_for()
    return lab


def camera(lab: Notebook) -> dict[str, float]:
    """Pixels of a metre on the screen, and where the façade's corner stands."""
    frames(lab.page)
    found: dict[str, float] = lab.page.evaluate(BOX)
    return found


def middle(of: Locator) -> tuple[float, float]:
    box = of.bounding_box()
    assert box
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drag(page: Page, x: float, y: float, dx: float, dy: float, button: str = "left") -> None:
    page.mouse.move(x, y)
    page.mouse.down(button=button)  # type: ignore[arg-type]
    page.mouse.move(x + dx, y + dy, steps=4)
    page.mouse.up(button=button)  # type: ignore[arg-type]


def test_the_facade_is_zoomed_moved_and_fitted(studio: Notebook) -> None:
    page = studio.page
    first = camera(studio)
    shape = page.locator(".fnb-elevation [data-shape] rect.cell").first
    x, y = middle(shape)
    page.mouse.move(x, y)
    page.keyboard.down("Control")
    page.mouse.wheel(0, -240)
    page.keyboard.up("Control")
    page.locator(".fnb-paper[data-free]").wait_for()
    larger = camera(studio)
    assert larger["metre"] > 1.5 * first["metre"]
    assert (x - larger["left"]) / larger["metre"] == pytest.approx(
        (x - first["left"]) / first["metre"], abs=0.02
    )
    drag(page, x, y, 60, -30, "middle")
    moved = camera(studio)
    assert moved["left"] == pytest.approx(larger["left"] + 60, abs=1)
    assert moved["bottom"] == pytest.approx(larger["bottom"] - 30, abs=1)
    studio.expect_python("model.selection.shape", None)
    page.locator(".fnb-paper").first.focus()
    page.keyboard.down(" ")
    drag(page, x, y, -40, 0)
    page.keyboard.up(" ")
    assert camera(studio)["left"] == pytest.approx(moved["left"] - 40, abs=1)
    retype(studio.field("Canvas width in metres"), "6.2")  # what is edited meanwhile stays where it is
    expect(page.locator(".fnb-status-line")).to_contain_text("Solved in")
    assert camera(studio)["metre"] == pytest.approx(moved["metre"], rel=0.01)
    retype(studio.field("Canvas width in metres"), "6")
    page.locator(".fnb-paper").first.focus()
    page.keyboard.press("0")
    eventually(page, lambda: _same(camera(studio), first))
    page.keyboard.press("+")
    eventually(page, lambda: _larger(camera(studio), first))
    studio.button("Fit the façade into the view (0)").click()
    eventually(page, lambda: _same(camera(studio), first))


def _same(found: dict[str, float], wanted: dict[str, float]) -> None:
    assert found == pytest.approx(wanted, abs=0.6)


def _larger(found: dict[str, float], than: dict[str, float]) -> None:
    assert found["metre"] > 1.2 * than["metre"]


def test_picking_leaves_the_picture_and_a_click_beside_picks_nothing(studio: Notebook) -> None:
    page = studio.page
    before = camera(studio)
    page.locator(".fnb-elevation [data-layer=door]").click()
    expect(page.locator(".fnb-inspector")).to_be_visible()
    assert camera(studio) == before
    paper = page.locator(".fnb-paper").first.bounding_box()
    assert paper
    page.mouse.click(paper["x"] + 8, paper["y"] + paper["height"] / 2)
    expect(page.locator(".fnb-inspector")).to_have_count(0)
    studio.expect_python("model.selection.layer", "")
    assert camera(studio) == before


def test_a_facade_that_is_dragged_wider_stays_clear_of_the_panel(studio: Notebook) -> None:
    page = studio.page
    edge = page.locator(".fnb-edge-width .fnb-edge-grip")
    x, y = middle(edge)
    panel = page.locator(".fnb-panel").bounding_box()
    assert panel
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(panel["x"] + 150, y, steps=6)
    studio.settle()
    drawn = page.locator(".fnb-sheet > svg:not(.fnb-overlay)").bounding_box()
    assert drawn and drawn["x"] + drawn["width"] <= panel["x"] - 10
    page.mouse.up()
    assert studio.python("model.design.canvas.width") > 7.5


def test_nothing_is_asked_of_python_while_the_hand_moves(studio: Notebook) -> None:
    page = studio.page
    page.evaluate(
        f"""() => {{
            window.sent = 0;
            const kernel = {KERNEL}.session.kernel;
            kernel.anyMessage.connect((_, {{direction, msg}}) => {{
                if (direction === 'send' && msg.header.msg_type === 'comm_msg') window.sent += 1;
            }});
        }}"""
    )
    x, y = middle(page.locator(".fnb-elevation [data-layer=door] rect.cell"))
    for k in range(12):
        page.mouse.move(x + 20 * (k - 6), y - 8 * k)
    expect(page.locator(".fnb-hover")).to_have_attribute("visibility", "visible")
    page.locator(".fnb-paper").first.focus()
    drag(page, x, y, 80, 40, "middle")
    page.keyboard.press("+")
    frames(page)
    assert page.evaluate("() => window.sent") == 0


def test_what_is_pointed_at_is_marked_wherever_it_is_shown(studio: Notebook) -> None:
    page = studio.page
    page.locator(".fnb-elevation [data-layer=door]").hover()
    expect(page.locator(".fnb-symbol[data-symbol=D][data-lit]")).to_have_count(1)
    expect(page.locator(".fnb-layer[data-layer=door][data-lit]")).to_have_count(1)
    expect(page.locator(".fnb-symbol[data-symbol=A][data-lit]")).to_have_count(0)
    page.locator(".fnb-symbol[data-symbol=A]").hover()
    count = page.locator(".fnb-elevation [data-shape][data-x=A]").count()
    expect(page.locator(".fnb-overlay .fnb-lit")).to_have_count(count)


def test_views_are_switched_without_a_new_picture(studio: Notebook, out: Path) -> None:
    page = studio.page
    studio.button("What is shown").click()
    for option, drawn in (
        ("grid", ".fnb-mark-grid"),
        ("letters", ".fnb-mark-letter"),
        ("transparent", ".fnb-mark-clear"),
        ("groups", ".fnb-mark-group"),
        ("dimensions", ".fnb-mark-chain"),
    ):
        page.locator(f"[data-option={option}]").click()
        expect(page.locator(drawn).first).to_be_attached()
    expect(page.locator(".fnb-mark-letter")).to_have_count(
        15
    )  # those of the two cells that are covered are left away
    expect(page.locator(".fnb-mark-measure", has_text="6.00")).to_have_count(1)
    for theme in ("Dark", "Light"):
        studio.theme(f"JupyterLab {theme}")  # type: ignore[arg-type]
        expect(page.locator(f".fnb[data-theme={theme.lower()}]")).to_have_count(1)
        for width in (1600, 1200, 900):
            studio.resize(width)
            page.locator(".fnb-studio").screenshot(path=out / f"stage-{width}-{theme.lower()}.png")
    studio.resize(1400)
    page.locator("[data-option=letters]").click()
    expect(page.locator(".fnb-mark-letter")).to_have_count(0)
    page.keyboard.press("Escape")
    expect(page.locator(".fnb-popover:visible")).to_have_count(0)


def test_words_side_by_side_become_the_layout_by_a_slider(studio: Notebook, out: Path) -> None:
    page = studio.page
    shape = page.locator(".fnb-elevation [data-layer=columns] rect.cell").first
    whole = page.locator(".fnb-elevation svg[data-scale]").first

    def place() -> list[float]:
        """Of the shape, as parts of the drawing, which is smaller where the slider stands below it."""
        own, all_ = shape.bounding_box(), whole.bounding_box()
        assert own and all_
        return [
            round((own["x"] - all_["x"]) / all_["width"], 3),
            round((own["y"] - all_["y"]) / all_["height"], 3),
            round(own["width"] / all_["width"], 3),
        ]

    aligned = place()
    studio.button("What is shown").click()
    page.locator("[data-option=naive]").click()
    page.keyboard.press("Escape")
    expect(page.locator(".fnb-flaw-occlusion").first).to_be_attached()
    expect(page.locator(".fnb-naive-said")).to_contain_text("covered")
    page.locator(".fnb-studio").screenshot(path=out / "stage-naive.png")
    assert place() != aligned
    slider = studio.field("From words laid side by side to the aligned layout")
    slider.focus()
    page.keyboard.press("End")
    expect(page.locator(".fnb-flaw")).to_have_count(0)
    assert place() == pytest.approx(aligned, abs=0.002)


def test_layers_are_drawn_apart_and_picked_there(studio: Notebook, out: Path) -> None:
    page = studio.page
    page.locator(".fnb-tab", has_text="Layers").click()
    expect(page.locator(".fnb-exploded [data-sheet]")).to_have_count(4)
    page.locator(".fnb-exploded [data-layer=door]").click()
    expect(page.locator(".fnb-exploded [data-shape][data-picked]")).to_have_count(1)
    studio.expect_python("model.selection.layer", "door")
    page.locator(".fnb-studio").screenshot(path=out / "stage-layers.png")
    retype(studio.field("Canvas width in metres"), "9")
    expect(page.locator(".fnb-exploded [data-layer=base][data-y=Q]")).to_have_count(11)


def test_snapshots_stand_side_by_side(studio: Notebook, out: Path) -> None:
    page = studio.page
    studio.button("Take a snapshot, to compare with later").click()
    expect(page.get_by_text("Snapshot 1 taken.")).to_be_visible()
    retype(studio.field("Canvas width in metres"), "9")
    expect(page.get_by_text("Snapshot 1 taken.")).to_be_visible()
    page.locator(".fnb-tab", has_text="Compare").click()
    expect(page.locator(".fnb-compared img")).to_have_count(2)
    expect(page.locator(".fnb-compared").first).to_contain_text("6 × 4.5 m, 17 shapes")
    expect(page.locator(".fnb-compared").last).to_contain_text("9 × 4.5 m, 25 shapes")
    page.locator(".fnb-studio").screenshot(path=out / "stage-compare.png")
    studio.button("Bring this snapshot back").first.click()
    studio.expect_python("model.design.canvas.width", 6.0)
    expect(page.get_by_text("Opened snapshot 1.")).to_be_visible()


def test_files_are_written_by_one_menu_and_python_goes_to_the_clipboard(studio: Notebook) -> None:
    page = studio.page
    for key, suffix in (
        ("svg", ".svg"),
        ("glb", ".glb"),
        ("layout", "-layout.json"),
        ("grammar", "-grammar.txt"),
    ):
        studio.button("Export").click()
        with page.expect_download() as download:
            page.locator(f".fnb-menu-item[data-key={key}]").click()
        assert download.value.suggested_filename == f"residential-house{suffix}"
        data = Path(download.value.path()).read_bytes()
        assert data[:4] == {"svg": b"<svg", "glb": b"glTF", "layout": b"{\n  "}.get(key, data[:4])
    studio.button("Export").click()
    page.locator(".fnb-menu-item[data-key=copy-python]").click()
    expect(page.get_by_text("is on the clipboard")).to_be_visible()
    code = page.evaluate("() => navigator.clipboard.readText()")
    space: dict[str, Any] = {}
    exec(code, space)
    assert space["design"].to_dict() == studio.python("model.design.to_dict()")


def test_a_gallery_design_over_unsaved_work_is_one_press_from_undone(studio: Notebook) -> None:
    page = studio.page
    retype(studio.field("Canvas width in metres"), "9")
    studio.button("Open a design of the gallery").click()
    expect(page.locator(".fnb-popover:visible img[src]").first).to_be_visible()
    page.locator(".fnb-popover:visible").get_by_label("Open figure 7").click()
    notice = page.locator(".fnb-notice:visible", has_text="Opened figure 7")
    notice.get_by_role("button", name="Undo").click()
    expect(notice).to_have_count(0)
    studio.expect_python("(model.design.name, model.design.canvas.width)", ["Residential house", 9.0])


def test_the_limit_is_set_where_the_time_is_told(studio: Notebook) -> None:
    page = studio.page
    page.locator(".fnb-details summary").click()
    expect(page.locator(".fnb-figures tr[data-axis=x]")).to_contain_text("proven")
    retype(studio.field("Search for at most so many seconds"), "20")
    page.keyboard.press("Enter")
    studio.expect_python("model.time_limit", 20.0)


SLOW = """
import time
from facade_nb import solve
def slowly(design, *, should_stop, **more):
    layout = solve(design, time_limit=None)
    while design.canvas.width == 9 and not should_stop():
        time.sleep(0.01)
    return layout
model = FacadeModel(gallery.load("residential-house"), solve=slowly)
Studio(model)
"""


def test_cancel_takes_what_was_found_by_then(show: Show) -> None:
    lab = show(SLOW)
    retype(lab.field("Canvas width in metres"), "9")
    lab.button("Cancel").click()
    expect(lab.page.locator(".fnb-notice:visible")).to_contain_text("best layout found so far")
    expect(lab.page.locator(".fnb-status-line")).to_contain_text("Solved in")
    expect(lab.button("Cancel")).to_have_count(0)
    assert lab.shapes() == 25


@pytest.fixture
def empty(lab: Notebook) -> Notebook:
    """A studio on an empty canvas."""
    lab.run(FRESH + "Studio(name='')")
    lab.shown()
    expect(lab.page.locator(".fnb-invitation")).to_be_visible()
    return lab


def test_an_empty_studio_begins_with_a_canvas_and_goes_on_in_its_pattern(empty: Notebook, out: Path) -> None:
    page = empty.page
    expect(page.locator(".fnb-invitation img[src]").first).to_be_visible()
    page.locator(".fnb-studio").screenshot(path=out / "stage-empty.png")
    retype(empty.field("Width of the new canvas in metres"), "8")
    page.keyboard.press("Tab")
    page.keyboard.type("6")
    page.keyboard.press("Enter")
    expect(page.locator(".fnb-invitation")).to_be_hidden()
    expect(empty.field("Canvas width in metres")).to_have_value("8")
    expect(empty.field("Pattern P1")).to_be_focused()


def test_an_empty_studio_begins_with_a_pattern(empty: Notebook) -> None:
    page = empty.page
    empty.field("A pattern to begin with").click()
    page.keyboard.type("A(BA^k")
    page.keyboard.press("Enter")
    expect(page.locator(".fnb-invitation .fnb-fault-text")).to_be_visible()
    page.keyboard.press("End")
    for key in ("ArrowLeft", "ArrowLeft", ")"):
        page.keyboard.press(key)
    expect(page.locator(".fnb-invitation .fnb-fault-text")).to_be_hidden()
    page.keyboard.press("Enter")
    expect(empty.field("Pattern across")).to_be_focused()
    expect(page.locator(".fnb-elevation [data-shape]").first).to_be_visible()


def test_an_empty_studio_begins_with_the_gallery(empty: Notebook) -> None:
    empty.page.locator(".fnb-invitation").get_by_label("Open residential house").click()
    expect(empty.page.locator(".fnb-elevation [data-shape]")).to_have_count(17)
    expect(empty.page.locator(".fnb-invitation")).to_be_hidden()


@pytest.fixture(scope="module")
def kept(visit: Visit) -> Iterator[Notebook]:
    """A notebook of its own, whose kernel may end."""
    with visit("lab") as lab:
        lab.open("0", "kept.ipynb")
        yield lab


def test_a_design_outlives_its_kernel(kept: Notebook) -> None:
    page = kept.page
    code = FRESH + "studio = Studio(gallery.load('residential-house'))\nstudio"
    kept.run(code)
    kept.shown()
    retype(kept.field("Canvas width in metres"), "9")
    kept.expect_python("studio.model.design.canvas.width", 9.0)
    folder = kept.root / ".facade_nb" / "kept"
    eventually(page, lambda: _kept(folder, 9.0))

    page.evaluate(f"() => {KERNEL}.restartKernel()")
    expect(page.locator(".fnb-absence:visible")).to_contain_text("the design comes back")
    with page.expect_download() as download:
        kept.button("Save the design as a JSON file").click()
    saved = Design.from_json(Path(download.value.path()).read_text())
    assert saved.canvas.width == 9.0

    page.evaluate(f"() => {KERNEL}.session.kernel.info")
    kept.run(code)
    kept.shown()
    notice = page.locator(".fnb-kept:visible")
    expect(notice).to_contain_text("Restored “Residential house”")
    expect(kept.field("Canvas width in metres")).to_have_value("9")
    kept.button("Undo (Ctrl+Z)").click()
    expect(kept.field("Canvas width in metres")).to_have_value("6")
    kept.button("Redo (Ctrl+Shift+Z)").click()
    expect(kept.field("Canvas width in metres")).to_have_value("9")
    notice.get_by_role("button", name="Go on with it").click()
    expect(notice).to_have_count(0)

    kept.run(code)  # in the kernel that runs: it is what the cell says, and what was is offered
    kept.shown()
    expect(kept.field("Canvas width in metres")).to_have_value("6")
    page.locator(".fnb-kept:visible").get_by_role("button", name="Restore").click()
    expect(kept.field("Canvas width in metres")).to_have_value("9")


def _kept(folder: Path, width: float) -> None:
    widths = [
        json.loads(file.read_text())["design"]["canvas"]["width"]
        for file in folder.glob("*.json")
        if ".before" not in file.name
    ]
    assert widths == [width]
