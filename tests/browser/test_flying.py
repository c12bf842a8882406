"""TownView as it loads: what it shows at first, in which resolution tiles come, what it says of itself; and faults."""

from __future__ import annotations

import base64
import re
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Locator, Page, expect

from .conftest import Visit
from .jupyter import Notebook
from .town_page import CANVAS, CONTEXT, READ, SESSION
from .waiting import eventually, frames, until

HEAD = """
from facade_nb.render.tiles import TileSet
from facade_nb.render.town import Town
from facade_nb.widgets import TownView
from facade_nb.widgets.town.channel import TownChannel
town = Town.generate(60, seed=1)
send, asked, held = TownChannel._send_tiles, [], []
def answer(wire, message):
    asked.append(message)
    if hold and message["upto"] > 32:
        held.append((wire, message))
    else:
        send(wire, message)
hold = False
TownChannel._send_tiles = answer
def release():
    global hold
    hold = False
    while held:
        send(*held.pop(0))
"""
SHOW = """
asked.clear()
view = TownView(town, "street", height=200, layout={{"width": "360px"}}{more})
view
"""

SPIED = """limits => {
    const own = WebGL2RenderingContext.prototype;
    window.imagesOnce ??= own.texImage2D;
    window.limitsOnce ??= own.getParameter;
    window.images = [];
    own.texImage2D = function (...given) {
        const [, , , wide, tall, , , type, content] = given;
        if (type === this.UNSIGNED_BYTE && content) window.images.push([wide, tall]);
        return window.imagesOnce.apply(this, given);
    };
    own.getParameter = function (name) {
        const found = Object.entries(limits).find(([own]) => this[own] === name);
        return found ? found[1] : window.limitsOnce.call(this, name);
    };
}"""
UNSPIED = """() => {
    WebGL2RenderingContext.prototype.texImage2D = window.imagesOnce;
    WebGL2RenderingContext.prototype.getParameter = window.limitsOnce;
}"""
STATES = """canvas => {
    window.states = [];
    const note = () => window.states.push(canvas.dataset.state);
    new MutationObserver(note).observe(canvas, {attributeFilter: ["data-state"]});
}"""


class Shown:
    """A view of a town on its page."""

    def __init__(self, lab: Notebook) -> None:
        self.lab = lab
        self.page: Page = lab.page

    @property
    def canvas(self) -> Locator:
        return self.page.locator(CANVAS)

    def show(self, more: str = "", before: str = "") -> None:
        """Show the town anew, with a model of its own."""
        self.lab.run("0")
        expect(self.canvas).to_have_count(0)
        self.lab.run(before + SHOW.format(more=more))
        self.lab.shown()

    def picture(self) -> Any:
        """The picture as it will stay, (h, w, 3)."""
        frames(self.page)
        expect(self.canvas).to_have_attribute("data-state", "sharp")
        width, height, data = self.canvas.evaluate(READ)
        return np.frombuffer(base64.b64decode(data), np.uint8).reshape(height, width, 4)[..., :3].astype(int)

    def tell(self, code: str) -> None:
        """Run code in the kernel, and let the page hear of it."""
        self.lab.python(f"[exec({code!r}, globals()), 0][1]")
        self.lab.settle()

    def images(self) -> list[list[int]]:
        """Sizes of images of bytes that the card was given."""
        found: list[list[int]] = self.page.evaluate("() => window.images")
        return found


def apart(a: Any, b: Any) -> float:
    """The mean difference of two pictures."""
    return float(np.abs(a - b).mean())


@pytest.fixture(scope="module")
def opened(visit: Visit) -> Iterator[Shown]:
    with visit("lab") as lab:
        lab.open("0", "flying.ipynb")
        lab.resize(900, 900)
        lab.run(HEAD)
        yield Shown(lab)


@pytest.fixture
def town(opened: Shown) -> Iterator[Shown]:
    """Where towns are shown; the test fails if the console has errors or anything offsite was asked for."""
    opened.lab.take_problems()
    yield opened
    assert opened.lab.take_problems() == []


def test_a_picture_of_what_has_not_come_is_not_called_sharp(town: Shown) -> None:
    town.show(before="hold = True\n")
    expect(town.canvas).to_have_attribute("data-state", "loading")
    assert float(town.canvas.get_attribute("data-loaded") or 1) < 1
    coarse = town.canvas.evaluate(READ)
    expect(town.page.locator(".fnb-town-note")).to_contain_text("% of the town is here")
    town.canvas.evaluate(STATES)
    town.tell("release()")
    sharp = town.picture()
    assert "moving" in town.page.evaluate("() => window.states")  # it was drawn anew
    before = np.frombuffer(base64.b64decode(coarse[2]), np.uint8).reshape(*sharp.shape[:2], 4)[..., :3]
    assert 0.3 < apart(sharp, before.astype(int)) < 12  # the same place, with finer tiles
    assert float(town.canvas.get_attribute("data-loaded") or 0) == 1
    assert apart(town.picture(), sharp) == 0


def test_tiles_come_coarse_first_and_each_size_once(town: Shown) -> None:
    town.show()
    town.picture()
    asked = town.lab.python("[[m['upto'], m['names'], m['above']] for m in asked]")
    names = town.lab.python("list(town.grammar.encoding.tiles)")
    assert asked[0] == [32, names, [0] * len(names)]
    assert [upto for upto, *_ in asked] == sorted(upto for upto, *_ in asked)
    pairs = [(upto, name) for upto, own, _ in asked for name in own]
    assert len(pairs) == len(set(pairs))


def test_an_edit_that_names_a_new_tile_has_that_one_sent(town: Shown) -> None:
    town.show()
    before = town.picture()
    town.tell("view.model.edit('shared')")
    town.tell(
        "asked.clear(); used = view.model.grammar.encoding.tiles; "
        "names = [name for name in TileSet.builtin().names if name not in used and '.' not in name]"
    )
    town.tell(
        "old = next(n for n in view.model.grammar.encoding.tiles if 'Rep:' + n + ',' in view.model.text); "
        "view.model.enter(view.model.text.replace('Rep:' + old + ',', 'Rep:' + names[0] + ','))"
    )
    assert town.lab.python("len(view.model.faults)") == 0
    town.picture()
    sent = town.lab.python("sorted({n for m in asked for n in m['names']})")
    assert sent == [town.lab.python("names[0]")]
    town.tell("view.model.undo()")
    assert apart(town.picture(), before) == 0


def test_tiles_keep_within_the_bound(town: Shown) -> None:
    town.show()
    whole = town.picture()
    town.page.evaluate(SPIED, {})
    try:
        town.show(", tile_megabytes=1")
        small = town.picture()
        images = town.images()
        assert images
        assert max(4 * wide * tall for wide, tall in images) <= 1_000_000
        assert 0.05 < apart(small, whole) < 12
        town.tell("view.model.tile_megabytes = 64")
        eventually(town.page, lambda: _same(town.picture(), whole))
        assert max(4 * wide * tall for wide, tall in town.images()) > 1_000_000
    finally:
        town.page.evaluate(UNSPIED)


def _same(a: Any, b: Any) -> None:
    assert apart(a, b) == 0


def test_from_far_away_the_card_has_small_tiles(town: Shown) -> None:
    town.page.evaluate(SPIED, {})
    try:
        town.show(before="from facade_nb.render.pipeline.viewpoint import Viewpoint\n")
        town.tell("view.viewpoint = Viewpoint((0.0, 900.0, 900.0), 0.0, -45.0)")
        town.picture()
        town.page.evaluate("() => { window.images = []; }")
        town.tell("view.viewpoint = view.model.views['close-up']")
        town.picture()
        sizes = [4 * wide * tall for wide, tall in town.images()]
        assert all(after <= 4.5 * before for before, after in pairwise(sizes))
    finally:
        town.page.evaluate(UNSPIED)


def test_a_card_with_small_images_gets_smaller_tiles(town: Shown) -> None:
    town.show()
    whole = town.picture()
    town.page.evaluate(SPIED, {"MAX_TEXTURE_SIZE": 2048, "MAX_ARRAY_TEXTURE_LAYERS": 1})
    try:
        town.show()
        small = town.picture()
        assert 1024 < max(max(size) for size in town.images()) <= 2048
        assert apart(small, whole) < 2  # of a picture so small hardly anything is lost
    finally:
        town.page.evaluate(UNSPIED)


def test_where_images_are_too_small_the_view_says_so_and_the_rest_goes_on(town: Shown) -> None:
    town.page.evaluate(SPIED, {"MAX_TEXTURE_SIZE": 1024})
    try:
        town.show()
        note = town.page.locator(".fnb-town-note")
        expect(note).to_contain_text("at most 1024 pixels a side; this town takes 1728")
        expect(town.lab.field("Grammar")).to_be_editable()
        town.tell("view.model.chosen = 3")
        expect(town.page.locator(".fnb-town-facts")).to_contain_text("Building 3")
    finally:
        town.page.evaluate(UNSPIED)
    town.show()
    assert town.picture().std() > 8


def test_without_float_buffers_there_is_a_still_picture(town: Shown) -> None:
    town.page.evaluate(
        """() => {
            const own = WebGL2RenderingContext.prototype;
            window.extensionsOnce = own.getExtension;
            own.getExtension = function (name) {
                return name === "EXT_color_buffer_float" ? null : window.extensionsOnce.call(this, name);
            };
        }"""
    )
    try:
        town.show()
        expect(town.page.locator(".fnb-town .fnb-tex-why")).to_contain_text("no EXT_color_buffer_float")
        expect(town.page.locator(".fnb-town img")).to_be_visible()
    finally:
        town.page.evaluate("() => { WebGL2RenderingContext.prototype.getExtension = window.extensionsOnce; }")


def test_a_context_that_is_lost_while_the_town_comes_is_made_again(town: Shown) -> None:
    town.show()
    whole = town.picture()
    town.show(before="hold = True\n")
    expect(town.canvas).to_have_attribute("data-state", "loading")
    town.page.evaluate(
        f"() => {{ window.lose = {CONTEXT}.get().getExtension('WEBGL_lose_context'); window.lose.loseContext(); }}"
    )
    note = town.page.locator(".fnb-town-note")
    expect(note).to_contain_text("taken the graphics card away")
    expect(note).to_have_css("background-color", re.compile("0\\.78"))  # it can be read over the picture
    town.tell("release()")
    town.page.evaluate("() => window.lose.restoreContext()")
    assert apart(town.picture(), whole) == 0
    expect(note).to_be_hidden()


@pytest.mark.parametrize("what", ["restart", "shutdown"])
def test_one_flies_on_when_the_kernel_is_gone(what: str, town: Shown) -> None:
    """The last one: it ends the kernel."""
    if town.lab.python("'view' in globals()") is False:
        town.lab.run(HEAD)
    town.show()
    before = town.picture()
    town.page.evaluate(f"() => {SESSION}.kernel.{what}()")
    notice = town.page.locator(".fnb-town .fnb-absence")
    expect(notice).to_contain_text("restart" if what == "restart" else "kernel")
    expect(notice).to_contain_text("One can fly, walk")
    town.canvas.focus()
    town.page.keyboard.press("w")
    until(town.page, lambda: apart(town.picture(), before) > 0.5)
    town.lab.button("Close-up").press("Enter")
    flown = town.picture()
    box = town.canvas.bounding_box()
    assert box is not None
    town.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    expect(town.page.locator(".fnb-town-facts")).to_contain_text("Building")
    until(town.page, lambda: apart(town.picture(), flown) > 0.1)
    expect(town.lab.field("Grammar")).to_have_attribute("readonly", "")
    if what == "restart":
        town.lab.run("0")
        expect(town.canvas).to_have_count(0)
