"""The façade as a building, in a real JupyterLab: one page, a studio with a small view, keys, mouse and pixels."""

from __future__ import annotations

import base64
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Locator, expect

from .conftest import HOUSE, Visit
from .jupyter import Notebook
from .keys import slide
from .town_page import CONTEXT, READ, SESSION
from .waiting import eventually, frames, until

HEAD = (
    HOUSE
    + """
import base64
from dataclasses import replace
import numpy as np
from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.pipeline.renderer import renderer_of
from facade_nb.render.pipeline.solids import solids_of
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.texture.gl import OSMESA
view = Studio(model, name="", view="building", height=300)
def drawn(pixels):
    scene = solids_of(model.layout).scene
    frame = Frame(scene, view.viewpoint(pixels).frustum(pixels), Daytime.at(view.hour), pixels, Looks(relief=False))
    with renderer_of(scene, OSMESA) as renderer:
        return base64.b64encode(renderer.draw(frame)["picture"][..., :3].tobytes()).decode()
"""
)
CANVAS = ".fnb-building-canvas"
MARKS = ".fnb-building-marks"


class Shown:
    """The view on its page."""

    def __init__(self, lab: Notebook) -> None:
        self.lab = lab
        self.page = lab.page

    @property
    def canvas(self) -> Locator:
        return self.page.locator(CANVAS)

    def pixels(self, selector: str = CANVAS) -> Any:
        """What stands in a canvas, (h, w, 4)."""
        width, height, data = self.page.locator(selector).evaluate(READ)
        return np.frombuffer(base64.b64decode(data), np.uint8).reshape(height, width, 4).astype(np.int64)

    def picture(self) -> Any:
        """The picture at rest, (h, w, 3)."""
        frames(self.page)
        expect(self.canvas).to_have_attribute("data-state", "sharp")
        return self.pixels()[..., :3]

    def until(self, differs: Callable[[Any], bool]) -> Any:
        """The picture at rest, once it is as it should be."""

        def check() -> Any:
            image = self.picture()
            assert differs(image)
            return image

        return eventually(self.page, check)

    def told(self, code: str) -> None:
        """Run code in the kernel, and let the page hear of it."""
        self.lab.python(f"[exec({code!r}, globals()), 0][1]")
        self.lab.settle()

    def stand(self, turn: float = 24.0, rise: float = 0.0, hour: float = 10.0) -> Any:
        """Look at the whole building from a side, with nothing picked nor pointed at; the picture."""
        self.page.mouse.move(2, 2)
        self.told(
            f"model.select(); view.turn = {turn}; view.rise = {rise}; view.hour = {hour}; "
            "view.distance = 0.0; view.target = []"
        )
        return self.picture()

    def at(self, across: float, down: float) -> tuple[float, float]:
        """A place of the picture on the page."""
        box = self.canvas.bounding_box()
        assert box
        return box["x"] + across * box["width"], box["y"] + down * box["height"]

    def marked(self) -> int:
        """How many pixels are marked."""
        return int((self.pixels(MARKS)[..., 3] > 0).sum())


@pytest.fixture(scope="module")
def opened(visit: Visit) -> Iterator[Shown]:
    with visit("lab") as lab:
        lab.open("0", "building.ipynb")
        lab.resize(1000, 800)
        lab.run(HEAD + "view")
        lab.shown()
        yield Shown(lab)


@pytest.fixture
def building(opened: Shown) -> Iterator[Shown]:
    """The view, as it was opened; the test fails if the console has errors or anything offsite was asked for."""
    opened.lab.take_problems()
    yield opened
    assert opened.lab.take_problems() == []


def apart(a: Any, b: Any) -> float:
    """The mean difference of two pictures; many, where they have another size."""
    return float(np.abs(a - b).mean()) if a.shape == b.shape else 255.0


def test_a_lost_context_comes_back(building: Shown) -> None:
    before = building.stand()
    made = building.page.evaluate(f"() => {CONTEXT}.made")
    building.page.evaluate(f"() => {CONTEXT}.lose()")
    until(building.page, lambda: building.page.evaluate(f"() => {CONTEXT}.made > {made}"))
    building.stand(60)
    turned = building.until(lambda image: apart(image, before) > 3)
    building.stand()
    # Tiles may be finer now; it is the first view all the same.
    building.until(lambda image: apart(image, before) < 0.5 * apart(turned, before))


@pytest.mark.parametrize(("turn", "rise", "hour"), [(24, 0, 10), (-140, 25, 21.5)])
def test_the_picture_is_that_of_the_pipeline_in_python(
    building: Shown, turn: float, rise: float, hour: float
) -> None:
    image = building.stand(turn, rise, hour)
    height, width = image.shape[:2]
    told = building.lab.python(f"drawn(({width}, {height}))")
    wanted = np.frombuffer(base64.b64decode(told), np.uint8).reshape(image.shape).astype(np.int64)
    off = np.abs(image - wanted)
    assert image.std() > 8
    assert off.mean() < 1
    # The map of shadows lies around what is looked at here, and before the eye there: its texels differ.
    assert (off.max(axis=2) <= 4).mean() >= 0.97


def test_mouse_and_keys_go_around_it(building: Shown) -> None:
    page = building.page
    first = building.stand()
    page.mouse.move(*building.at(0.5, 0.2))
    page.mouse.down()
    page.mouse.move(*building.at(0.3, 0.25), steps=5)
    page.mouse.up()
    building.until(lambda image: apart(image, first) > 3)
    building.lab.expect_python("view.turn > 45 and view.rise > 0", True)
    assert building.lab.python("model.selection.shape") is None  # a drag is no click
    turn, rise = building.lab.python("[view.turn, view.rise]")
    building.canvas.focus()
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("ArrowUp")
    building.lab.expect_python(f"view.turn < {turn} and view.rise > {rise}", True)
    page.keyboard.press("Shift+ArrowUp")
    page.keyboard.press("+")
    building.lab.expect_python("len(view.target) == 3 and view.distance > 0", True)
    far = building.lab.python("view.distance")
    page.mouse.move(*building.at(0.5, 0.5))
    page.mouse.wheel(0, -200)
    building.lab.expect_python(f"view.distance < {far}", True)
    page.keyboard.press("0")
    building.lab.expect_python("[view.turn, view.rise, view.distance, view.target]", [24.0, 0.0, 0.0, []])
    building.until(lambda image: apart(image, first) == 0)


def test_a_click_picks_a_shape_and_the_inspector_tells_of_it(building: Shown) -> None:
    page = building.page
    building.stand()
    eventually(page, lambda: _equal(building.marked(), 0))
    page.mouse.move(*building.at(0.45, 0.45))
    until(page, building.marked)  # the shape under the pointer
    page.mouse.click(*building.at(0.45, 0.45))
    building.lab.expect_python("model.selection.shape is not None", True)
    expect(page.locator(".fnb-inspector")).to_be_visible()
    chosen = building.lab.python("model.selection.shape")
    page.mouse.click(*building.at(0.02, 0.3))  # the sky
    building.lab.expect_python("model.selection.shape", None)
    expect(page.locator(".fnb-inspector")).to_have_count(0)
    eventually(page, lambda: _equal(building.marked(), 0))
    building.told(f"model.select({chosen})")  # as a click in the elevation does
    until(page, building.marked)
    building.stand(180)
    eventually(page, lambda: _equal(building.marked(), 0))  # from behind it is not seen


def _equal(found: Any, wanted: Any) -> None:
    assert found == wanted


def test_an_edit_is_seen_and_the_camera_stays(building: Shown) -> None:
    before = building.stand()
    building.lab.retype("Canvas width in metres", "9")
    building.until(lambda image: apart(image, before) > 1)
    assert building.lab.python("[view.turn, model.layout.canvas.width]") == [24.0, 9.0]
    building.lab.retype("Canvas width in metres", "6")
    building.until(lambda image: apart(image, before) == 0)


def test_the_hour_changes_the_light(building: Shown) -> None:
    day = building.stand()
    slide(building.lab.field("Hour"), 22.0)
    building.until(lambda image: image.mean() < 0.7 * day.mean())
    building.lab.expect_python("view.hour", 22.0)


def test_nothing_is_drawn_while_nothing_changes(building: Shown) -> None:
    building.stand()
    count = (
        "canvas => { window.drawnPictures = 0; const { drawImage } = CanvasRenderingContext2D.prototype; "
        + (
            "canvas.getContext('2d').drawImage = function (...all) { window.drawnPictures += 1; "
            "return drawImage.apply(this, all); }; }"
        )
    )
    building.canvas.evaluate(count)
    frames(building.page, 30)
    assert building.page.evaluate("window.drawnPictures") == 0
    building.canvas.focus()
    building.page.keyboard.press("ArrowLeft")
    until(building.page, lambda: building.page.evaluate("window.drawnPictures"))


def test_who_looks_at_the_elevation_holds_no_mesh(building: Shown) -> None:
    before = building.stand()
    building.lab.expect_python("bool(view.channel.mesh)", True)
    building.lab.button("Elevation").click()
    expect(building.canvas).to_be_hidden()
    building.lab.expect_python("bool(view.channel.mesh)", False)
    building.lab.button("3D").click()
    building.until(lambda image: apart(image, before) == 0)


@pytest.mark.parametrize("theme", ["JupyterLab Dark", "JupyterLab Light"])
def test_themes(building: Shown, theme: Any, out: Path) -> None:
    building.stand()
    building.lab.theme(theme)
    root = building.page.locator(".fnb")
    expect(root).to_have_attribute("data-theme", theme.split()[-1].lower())
    building.page.screenshot(path=out / f"building-{theme.split()[-1].lower()}.png")


def test_the_last_picture_is_kept(building: Shown) -> None:
    building.stand()
    building.lab.expect_python("view.still[:2] == b'\\xff\\xd8' and len(view.still) < 120_000", True)


def test_without_webgl2_it_says_so(building: Shown) -> None:
    page = building.page
    page.evaluate(
        """() => {
            window.keptContext = globalThis[Symbol.for("facade_nb.pipeline.context")];
            delete globalThis[Symbol.for("facade_nb.pipeline.context")];
            window.getContextOnce ??= HTMLCanvasElement.prototype.getContext;
            HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
                return kind === "webgl2" ? null : window.getContextOnce.call(this, kind, ...rest);
            };
        }"""
    )
    building.lab.run("view")
    building.lab.shown()
    expect(page.locator(".fnb-building-note")).to_contain_text("no WebGL2")
    expect(page.locator(".fnb-building-still")).to_be_visible()
    page.evaluate(
        """() => {
            HTMLCanvasElement.prototype.getContext = window.getContextOnce;
            globalThis[Symbol.for("facade_nb.pipeline.context")] = window.keptContext;
        }"""
    )
    building.lab.run("view")
    building.lab.shown()
    assert building.picture().std() > 8


def test_one_goes_around_it_without_a_kernel(building: Shown) -> None:
    """The last one: it ends the kernel."""
    before = building.stand()
    building.page.evaluate(f"() => {SESSION}.kernel.shutdown()")
    expect(building.page.locator(".fnb-absence")).to_contain_text("kernel")
    building.canvas.focus()
    building.page.keyboard.press("ArrowLeft")
    turned = building.until(lambda image: apart(image, before) > 2)
    slide(building.lab.field("Hour"), 22.0)
    building.until(lambda image: image.mean() < 0.7 * turned.mean())
