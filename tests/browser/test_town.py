"""The town and its pipeline, in a real JupyterLab: one page, one town of 60 houses, keys and pixels."""

from __future__ import annotations

import base64
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Locator, expect

from facade_nb.render.pipeline.passes import BUFFERS, OUTDOORS

from .conftest import Visit
from .jupyter import Notebook
from .keys import slide
from .town_page import CANVAS, CONTEXT, READ, SESSION
from .waiting import eventually, frames, until

HEAD = """
import base64
import numpy as np
from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.pipeline.renderer import renderer_of
from facade_nb.render.pipeline.viewpoint import CameraPath, Viewpoint
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.texture.gl import OSMESA
from facade_nb.render.town import Town
from facade_nb.widgets import PipelineView, TownView
town = Town.generate(60, seed=1)
view = TownView(town, "street", height=250, layout={"width": "430px"})
def drawn(pixels):
    flat = Looks(relief=False)
    frame = Frame(view.model.scene, view.viewpoint.frustum(pixels), Daytime.at(view.hour), pixels, flat)
    with renderer_of(frame.scene, OSMESA) as renderer:
        return base64.b64encode(renderer.draw(frame)["picture"][..., :3].tobytes()).decode()
def within(place):
    import shapely
    plan = view.model.town.plan
    rings = [plan.corners[a:b] for a, b in zip(plan.rings, plan.rings[1:])]
    spot = shapely.Point(place.eye[0], -place.eye[2])
    return sum(shapely.Polygon(ring).contains(spot) for ring in rings) % 2 == 1
"""


class Shown:
    """The view of the town on its page."""

    def __init__(self, lab: Notebook) -> None:
        self.lab = lab
        self.page = lab.page

    @property
    def canvas(self) -> Locator:
        return self.page.locator(CANVAS)

    def picture(self, selector: str = CANVAS) -> Any:
        """The picture at rest, (h, w, 3)."""
        frames(self.page)
        canvas = self.page.locator(selector)
        expect(canvas).to_have_attribute("data-state", "sharp")
        width, height, data = canvas.evaluate(READ)
        return (
            np.frombuffer(base64.b64decode(data), np.uint8)
            .reshape(height, width, 4)[..., :3]
            .astype(np.int64)
        )

    def told(self, code: str) -> None:
        """Run code in the kernel, and let the page hear of it."""
        self.lab.python(f"[exec({code!r}, globals()), 0][1]")
        self.lab.settle()

    def stand(self, place: str, hour: float = 11.0) -> Any:
        """Go somewhere at an hour; the picture there."""
        self.told(f"view.model.chosen = -1; view.hour = {hour}; view.viewpoint = {place}")
        return self.picture()

    def undo(self, field: Locator, done: str) -> None:
        """Undo until something is true in the kernel: how many steps that takes depends on how fast keys come."""
        while not self.lab.python(f"bool({done})"):
            answered = self.lab.python("view.channel.ack['seq']")
            assert self.lab.python("view.model.can_undo")
            field.press("ControlOrMeta+z")
            self.lab.expect_python(f"view.channel.ack['seq'] > {answered}", True)

    def until(self, differs: Callable[[Any], bool]) -> Any:
        """The picture at rest, once it is as it should be."""

        def check() -> Any:
            image = self.picture()
            assert differs(image)
            return image

        return eventually(self.page, check)


@pytest.fixture(scope="module")
def opened(visit: Visit) -> Iterator[Shown]:
    with visit("lab") as lab:
        lab.open("0", "town.ipynb")
        lab.resize(1200, 900)
        lab.run(HEAD + "view")
        lab.shown()
        yield Shown(lab)


@pytest.fixture
def town(opened: Shown) -> Iterator[Shown]:
    """The town, as it was opened; the test fails if the console has errors or anything offsite was asked for."""
    opened.lab.take_problems()
    yield opened
    assert opened.lab.take_problems() == []


def apart(a: Any, b: Any) -> float:
    """The mean difference of two pictures."""
    return float(np.abs(a - b).mean())


@pytest.mark.parametrize(
    ("place", "hour"), [("'street'", 11.0), ("'distance'", 20.0), ("'close-up'", 22.5)], ids=str
)
def test_the_picture_is_that_of_the_pipeline_in_python(town: Shown, place: str, hour: float) -> None:
    image = town.stand(place, hour)
    height, width = image.shape[:2]
    told = town.lab.python(f"drawn(({width}, {height}))")
    wanted = np.frombuffer(base64.b64decode(told), np.uint8).reshape(image.shape).astype(np.int64)
    off = np.abs(image - wanted)
    assert image.std() > 8
    assert off.mean() < 1
    # Rasterizers differ in which pixels the edge of a kerb or a leaf far away covers.
    assert (off.max(axis=2) <= 3).mean() >= 0.99


def test_the_sky_is_above_and_the_town_below(town: Shown) -> None:
    image = town.stand("'street'")
    sky, ground = image[:12].reshape(-1, 3).mean(axis=0), image[-12:].reshape(-1, 3).mean(axis=0)
    assert sky[2] > sky[0] + 8
    assert sky.sum() > ground.sum() + 60
    assert float(town.canvas.get_attribute("data-loaded") or 0) == 1
    expect(town.page.locator(".fnb-town-view .fnb-town-told")).to_contain_text(
        re.compile(r"\d m?s · \d+ × \d+")
    )


def test_the_picture_of_the_notebook_follows_unseen(town: Shown) -> None:
    def outputs() -> list[str]:
        return town.page.evaluate(
            "() => window.jupyterapp.shell.currentWidget.content.widgets[0].model.outputs.toJSON()"
            ".map(own => String(own.data?.['text/html']))"
        )

    def followed() -> bool:
        return "<img" in outputs()[0]

    until(town.page, followed)
    picture, view = outputs()
    assert "60 buildings" in picture
    assert view == "undefined"
    hidden = town.page.locator("[class^=fnb-follows-]")
    expect(hidden).to_have_count(1)
    expect(hidden).to_be_hidden()


def test_keys_fly(town: Shown) -> None:
    before = town.stand("'street'")
    town.canvas.focus()
    for key, axis in (("w", 0), ("d", 0), ("e", 1)):
        place = town.lab.python("list(view.viewpoint.eye)")
        town.page.keyboard.press(key)
        eventually(
            town.page,
            lambda place=place, axis=axis: _differ(town.lab.python("list(view.viewpoint.eye)"), place, axis),
        )
    yaw = town.lab.python("view.viewpoint.yaw")
    town.page.keyboard.press("ArrowRight")
    eventually(town.page, lambda: _more(town.lab.python("view.viewpoint.yaw"), yaw))
    town.until(lambda image: apart(image, before) > 2)
    town.page.keyboard.press("Home")
    town.lab.expect_python("view.viewpoint == view.model.views['distance']", True)


def _differ(a: list[float], b: list[float], axis: int) -> None:
    assert abs(a[axis] - b[axis]) > 0.01


def _more(a: float, b: float) -> None:
    assert a > b


def test_who_walks_stays_on_the_ground_and_outside(town: Shown) -> None:
    town.stand("'close-up'")
    town.lab.button("Walk on the ground").press("Enter")
    expect(town.canvas).to_be_focused()
    start = town.lab.python("list(view.viewpoint.eye)")
    town.page.keyboard.down("Shift")
    town.page.keyboard.down("ArrowUp")  # towards a door that is 4 m away
    town.page.wait_for_timeout(1500)
    town.page.keyboard.up("ArrowUp")
    town.page.keyboard.up("Shift")
    town.picture()
    eventually(town.page, lambda: _differ(town.lab.python("list(view.viewpoint.eye)"), start, 2))
    assert town.lab.python("view.viewpoint.eye[1]") == 1.7
    assert not town.lab.python("within(view.viewpoint)")
    town.lab.button("Walk on the ground").press("Enter")


def test_the_hour_changes_the_light(town: Shown) -> None:
    day = town.stand("'street'")
    slide(town.lab.field("Hour"), 22.0)
    town.lab.expect_python("view.hour", 22.0)
    night = town.until(lambda image: image.mean() < 0.7 * day.mean())
    assert (night[:10].mean(axis=(0, 1)) < day[:10].mean(axis=(0, 1))).all()


def test_a_click_chooses_a_building(town: Shown) -> None:
    before = town.stand("'street'")
    box = town.canvas.bounding_box()
    assert box is not None
    number = None
    for part in (0.1, 0.2, 0.3, 0.7, 0.85, 0.95):  # somewhere along the street there is a house
        town.page.mouse.click(box["x"] + part * box["width"], box["y"] + 0.45 * box["height"])
        town.lab.settle()
        number = town.lab.python("view.model.chosen")
        if number >= 0:
            break
    assert number is not None
    assert number >= 0
    facts = town.page.locator(".fnb-town-facts")
    expect(facts).to_contain_text(f"Building {number}")
    seed = town.lab.python(f"[x / 64 for x in town.plan.seed[{number}].tolist()]")
    expect(facts).to_contain_text(f"{seed[0]:g}"[:6])
    expect(facts).to_contain_text(str(town.lab.python(f"int(town.plan.storeys[{number}])")))
    marked = town.until(lambda image: apart(image, before) > 0.2)
    assert (marked[..., 2] - marked[..., 0] > 60).sum() > 20  # a blue line around it
    town.canvas.focus()
    town.page.keyboard.press("Escape")
    town.lab.expect_python("view.model.chosen", -1)
    town.until(lambda image: apart(image, before) == 0)


def test_one_building_takes_another_style(town: Shown) -> None:
    before = town.stand("'close-up'")
    town.canvas.focus()
    town.page.keyboard.press("Enter")  # the building in the middle
    town.lab.settle()
    number = town.lab.python("view.model.chosen")
    style = town.lab.field("Style of this building")
    style.focus()
    town.page.keyboard.type("brickworks")
    town.lab.expect_python("list(view.model.restyled)", [[number, 3]])
    town.until(lambda image: apart(image, before) > 8)
    town.undo(style, "not view.model.restyled")  # another style with a b may have been chosen on the way
    town.canvas.focus()
    town.page.keyboard.press("Escape")
    town.until(lambda image: apart(image, before) == 0)


ROOFS = "Tiles, OldTiles, Slates, Tiles, OldTiles"


def retyped(town: Shown, old: str, new: str) -> None:
    """Select some letters of the grammar, and type others."""
    area = town.lab.field("Grammar")
    area.focus()
    area.evaluate(
        "(area, old) => area.setSelectionRange(area.value.indexOf(old), area.value.indexOf(old) + old.length)",
        old,
    )
    town.page.keyboard.type(new)


def test_a_grammar_is_edited_while_one_flies(town: Shown) -> None:
    before = town.stand("'distance'")
    town.lab.field("Part of the grammar").focus()
    town.page.keyboard.type("detached")
    expect(town.lab.field("Grammar")).to_have_value(
        town.lab.python("__import__('facade_nb').gallery.town('detached')")
    )
    retyped(town, ROOFS, "Slates")
    grey = town.until(lambda image: _red(image) < 0.5 * _red(before))
    town.page.keyboard.type("x")
    fault = town.page.locator(".fnb-tex-fault")
    expect(fault).to_contain_text("Line 13")  # where it stands in this part
    expect(fault).to_contain_text("Slatesx")
    assert apart(town.picture(), grey) == 0  # the last good one stays
    town.canvas.focus()
    town.page.keyboard.press("e")  # and one flies on
    town.until(lambda image: apart(image, grey) > 0.2)
    town.undo(
        town.lab.field("Grammar"), "town.grammar.text == view.model.grammar.text and not view.model.faults"
    )
    expect(fault).to_have_count(0)
    town.stand("'distance'")
    town.until(lambda image: apart(image, before) == 0)


def _red(image: Any) -> int:
    """How many pixels have the colour of roof tiles."""
    return int((image[..., 0] > 1.5 * np.maximum(image[..., 1], image[..., 2])).sum())


def test_a_path_is_played(town: Shown) -> None:
    town.stand("'street'")
    town.told(
        "view.path = CameraPath((0.0, 0.4, 0.8), (view.viewpoint, view.model.views['close-up'], "
        "view.model.views['distance']))"
    )
    town.lab.button("Play the path").press("Enter")
    town.lab.expect_python("view.viewpoint == view.model.views['distance']", True)
    scrub = town.lab.field("Time on the path")
    scrub.press("Home")
    town.lab.expect_python("view.viewpoint == view.model.views['street']", True)
    town.told("view.path = None")
    expect(scrub).to_be_hidden()


def test_a_path_is_recorded(town: Shown) -> None:
    town.stand("'street'")
    town.lab.button("Record a path").press("Enter")
    town.canvas.focus()
    for _ in range(3):
        town.page.keyboard.press("w")
        town.page.wait_for_timeout(450)
    town.lab.button("Record a path").press("Enter")
    eventually(town.page, lambda: _more(town.lab.python("len(view.path.times) if view.path else 0"), 1))
    assert town.lab.python("view.path.times[0]") == 0
    town.told("view.path = None")


def test_a_lost_context_comes_back(town: Shown) -> None:
    before = town.stand("'street'")
    made = town.page.evaluate(f"() => {CONTEXT}.made")
    town.page.evaluate(f"() => {CONTEXT}.lose()")
    eventually(town.page, lambda: _more(town.page.evaluate(f"() => {CONTEXT}.made"), made))
    town.canvas.focus()
    town.page.keyboard.press("e")
    town.until(lambda image: apart(image, before) > 0.2)
    town.stand("'street'")
    town.until(lambda image: apart(image, before) == 0)


@pytest.mark.parametrize("theme", ["JupyterLab Dark", "JupyterLab Light"])
def test_themes(town: Shown, theme: Any, out: Path) -> None:
    town.stand("'street'", 20.25)
    town.lab.theme(theme)
    root = town.page.locator(".fnb-town")
    expect(root).to_have_attribute("data-theme", theme.split()[1].lower())
    town.picture()
    root.screenshot(path=out / f"town-{theme.split()[1].lower()}.png")
    ink = town.lab.field("Grammar").evaluate(
        "area => { const { color } = getComputedStyle(area); return Number(/\\d+/.exec(color)[0]); }"
    )
    assert (ink > 128) == (theme == "JupyterLab Dark")


def test_the_pipeline_is_shown_live(town: Shown, out: Path) -> None:
    lab, page = town.lab, town.page
    town.stand("'street'")
    lab.run("PipelineView(view.model, height=220)")
    lab.shown()
    large = ".fnb-pipe .fnb-town-canvas"
    before = town.picture(large)
    names = [own.name for own in BUFFERS if any(own.name in one.writes for one in OUTDOORS)]
    thumbs = page.locator(".fnb-pipe-thumb")
    assert thumbs.evaluate_all("all => all.map(own => own.dataset.buffer)") == names
    expect(page.locator(".fnb-pipe-thumb[data-buffer=lamp_map]")).to_have_attribute("data-off", "")  # by day
    for name in names:
        if name == "lamp_map":
            continue
        colours = page.locator(f".fnb-pipe-thumb[data-buffer={name}] canvas").evaluate(
            """canvas => new Set(new Uint32Array(canvas.getContext("2d")
                .getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size"""
        )
        assert colours > 1, name
    page.locator(".fnb-town-pipeline").screenshot(path=out / "pipeline.png")
    page.locator(large).hover(position={"x": 30, "y": 120})
    expect(page.locator(".fnb-pipe-value")).to_contain_text("At ")
    rule = page.locator(".fnb-pipe-thumb[data-buffer=rule] .fnb-pipe-at")
    expect(rule).not_to_have_text("")
    column, line = rule.inner_text().split()[:2]
    assert [int(column), int(line)] in lab.python(
        "view.model.starts.places(town.grammar).astype(int).tolist()"
    )
    lab.button("facing: Which way its façade looks, and how deep it lies before the camera, metres.").press(
        "Enter"
    )
    expect(page.locator(large)).to_have_attribute("data-buffer-shown", "facing")
    lab.field("Run shadow near").press("Space")
    expect(page.locator(".fnb-pipe-thumb[data-buffer=shadow_far]")).to_have_attribute("data-off", "")
    lab.button("picture: Without the stairs of edges.").press("Enter")
    expect(page.locator(large)).to_have_attribute("data-buffer-shown", "picture")
    eventually(page, lambda: _more(apart(town.picture(large), before), 0.1))  # without shadows it is brighter
    page.locator(large).focus()
    page.keyboard.press("a")
    eventually(page, lambda: _more(apart(town.picture(large), before), 0.5))
    lab.run("view")
    lab.shown()


def test_without_webgl2_there_is_a_still_picture(town: Shown) -> None:
    page = town.page
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
    town.lab.run("view")
    town.lab.shown()
    expect(page.locator(".fnb-town .fnb-tex-why")).to_contain_text("no WebGL2")
    still = page.locator(".fnb-town img")
    expect(still).to_be_visible()
    assert still.evaluate("async image => { await image.decode(); return image.naturalWidth; }") == 720
    page.evaluate(
        """() => {
            HTMLCanvasElement.prototype.getContext = window.getContextOnce;
            globalThis[Symbol.for("facade_nb.pipeline.context")] = window.keptContext;
        }"""
    )
    town.lab.run("view")
    town.lab.shown()
    assert town.picture().std() > 8


def test_one_flies_on_without_a_kernel(town: Shown) -> None:
    """The last one: it ends the kernel."""
    before = town.stand("'street'")
    eventually(town.page, lambda: _more(float(town.canvas.get_attribute("data-loaded") or 0), 0.999))
    town.page.evaluate(f"() => {SESSION}.kernel.shutdown()")
    expect(town.page.locator(".fnb-town .fnb-absence")).to_contain_text("kernel")
    town.canvas.focus()
    town.page.keyboard.press("w")
    flown = town.until(lambda image: apart(image, before) > 0.5)
    slide(town.lab.field("Hour"), 22.0)
    night = town.until(lambda image: image.mean() < 0.7 * flown.mean())
    town.lab.button("Close-up").press("Enter")
    town.until(lambda image: apart(image, night) > 5)
    expect(town.lab.field("Grammar")).to_have_attribute("readonly", "")
