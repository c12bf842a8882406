"""Texture grammars live, in a real JupyterLab: pixels that are read from the canvas."""

from __future__ import annotations

import base64
import functools
import shutil
import textwrap
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image, ImageDraw
from playwright.sync_api import expect

from .conftest import Visit
from .jupyter import Notebook
from .keys import paste, retype, slide
from .waiting import eventually, frames, until

HEAD = """
from IPython.display import display
from facade_nb import gallery
from facade_nb.widgets import *
import base64
import numpy as np
from facade_nb.render.developing import developed
from facade_nb.render.texture.antialias import averaged
from facade_nb.render.texture.daytime import Daytime, light
from facade_nb.render.texture.painters import PAINTERS
TEXT = '''S -> Layer(Wall, Floors)
Wall -> Mat(Color, Rep:brick, 0, 0, 0.5, 0.5)
Floors -> RepeatY(3, Floor)
Floor -> RandStack(Bays)
Bays -> RepeatX(2.5, Bay)
Bay -> SplitX(Rel, 1, Skip, Abs, 1.2, Column, Rel, 1, Skip)
Column -> SplitY(Abs, 0.9, Skip, Abs, 1.5, Window, Rel, 1, Skip)
Window -> RandUni(1, Room, Green)
Room -> Intrusion(1.5, Red, Blue, Red, Green, Green)
Red -> Mat(Color, 0, 0.8, 0.1, 0.1, 1)
Blue -> Mat(Color, 0, 0.1, 0.1, 0.8, 1)
Green -> Mat(Color, Fit:window-green, 0, 0, 1, 1)
Skip -> Skip(0)'''
def outdoors(surface, looks, day):
    # In the light of an hour, with the sky behind the façade, as the page has it.
    color, normal, specular, _ = surface
    alpha, height = color[:, 3:].clip(0, 1), looks.points[:, 1]
    rays = np.float32([[0, 0, -1]]).repeat(len(color), 0) if looks.rays is None else looks.rays
    straight = np.concatenate([color[:, :3] / alpha.clip(1e-6), alpha], axis=1)
    seen = light(straight, normal, specular, rays, day, np.ones(len(rays), np.float32), height)
    seen = alpha * seen + (1 - alpha) * day.backdrop(rays)
    return np.concatenate([developed(seen, day.exposure), np.ones((len(rays), 1))], axis=1)
def expected(view, pixels, antialias=None):
    # One sample a pixel, with tiles in the size that fits; or antialiased as offscreen pictures are.
    model, painter, sight = view.model, PAINTERS["cpu"], view.sight(pixels)
    question = model.grammar.question(model.size, model.seed)
    if antialias is None:
        surface = painter.paint(question, sight, mips=True).surface
    else:
        surface = averaged(painter, question, sight, antialias).surface
    color = outdoors(surface, sight.looks(), Daytime.at(model.hour)) if model.lit else surface.color
    return base64.b64encode((color * 255).round().astype(np.uint8).tobytes()).decode()
"""

Live = Callable[[str], Notebook]
SHARP = ".fnb-tex-canvas:is([data-state=sharp], [data-state=smooth])"
READ = """canvas => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let text = "";
    for (let at = 0; at < data.length; at += 8192) text += String.fromCharCode(...data.subarray(at, at + 8192));
    return [canvas.width, canvas.height, btoa(text)];
}"""


@pytest.fixture
def live(lab: Notebook) -> Live:
    """Show views; the code's last line is displayed."""

    def run(code: str) -> Notebook:
        lab.run("0")
        expect(lab.page.locator(".fnb-texture")).to_have_count(0)
        lab.run(HEAD + textwrap.dedent(code))
        lab.shown()
        return lab

    return run


def pixels(lab: Notebook, index: int = 0, state: str = "sharp") -> Any:
    """The canvas when it is sharp, or smooth, (h, w, 4): colours times alpha, which canvases give out divided."""
    canvas = lab.page.locator(".fnb-tex-canvas").nth(index)
    expect(canvas).to_have_attribute("data-state", state)
    width, height, data = canvas.evaluate(READ)
    image = bytes_of(data).reshape(height, width, 4)
    image[..., :3] = np.rint(image[..., :3] * image[..., 3:] / 255)
    return image


def bytes_of(text: str) -> Any:
    return np.frombuffer(base64.b64decode(text), np.uint8).astype(np.int64)


def wanted(lab: Notebook, image: Any, antialias: str | None = None) -> Any:
    """What NumPy makes of `view`, for a canvas like this one."""
    height, width = image.shape[:2]
    return bytes_of(lab.python(f"expected(view, ({width}, {height}), {antialias!r})")).reshape(image.shape)


def agreeing(lab: Notebook, off: int, share: float, index: int = 0) -> Any:
    """The sharp picture, once it is what NumPy makes of `view`: all but a share of its pixels, within so much."""

    def check() -> Any:
        image = pixels(lab, index)
        assert (np.abs(image - wanted(lab, image)).max(axis=2) > off).mean() < share
        return image

    return eventually(lab.page, check)


def screen(lab: Notebook, index: int = 0) -> Any:
    """The stage as the screen has it, (h, w, 3)."""
    shot = lab.page.locator(".fnb-tex-stage").nth(index).screenshot()
    return np.array(Image.open(BytesIO(shot)).convert("RGB"), np.int64)


def on_screen(lab: Notebook, index: int = 0) -> Any:
    """The picture as the screen has it; waits for the browser to paint it, which is slow in software."""

    def check() -> Any:
        image = screen(lab, index)
        assert image.mean(axis=2).std() > 5
        return image

    return eventually(lab.page, check)


def still(lab: Notebook) -> Any:
    """The stage as the screen has it, once it stays as it is."""

    def check() -> Any:
        first = screen(lab)
        frames(lab.page)
        assert np.array_equal(screen(lab), first)
        return first

    return eventually(lab.page, check)


def coloured(lab: Notebook, middle: list[int]) -> None:
    """Wait until the middle of the sharp picture has a colour."""

    def check() -> None:
        image = pixels(lab)
        assert image[image.shape[0] // 2, image.shape[1] // 2].tolist() == middle

    eventually(lab.page, check)


@pytest.mark.parametrize("sight", ["flat=True", "flat=False, turn=30.0, rise=-10.0, distance=6.0"])
def test_the_canvas_agrees_with_numpy(live: Live, sight: str) -> None:
    lab = live(f"""
        view = TextureView(TEXT, lit=False, controls=False, antialias='none', layout={{'width': '240px'}}, {sight})
        view
    """)
    image = agreeing(lab, 2, 0.002)
    assert image[..., 3].mean() > 100


@pytest.mark.parametrize("hour", [9.5, 22.0])
def test_light_agrees_with_numpy(live: Live, hour: float) -> None:
    lab = live(f"""
        view = TextureView(TEXT, hour={hour}, controls=False, antialias='none', layout={{'width': '240px'}},
                           flat=False, turn=30.0, rise=-10.0)
        view
    """)
    assert agreeing(lab, 4, 0.01)[..., :3].std() > 10


# The states that the picture goes through: a state may be gone before one looks.
WATCH = """() => {
    const canvas = document.querySelector(".fnb-tex-canvas");
    window.states = [];
    new MutationObserver(() => window.states.push(canvas.dataset.state))
        .observe(canvas, { attributeFilter: ["data-state"] });
}"""


@pytest.mark.parametrize("options", ["lit=False", "hour=9.5"])
def test_at_rest_the_picture_is_antialiased_as_offscreen_pictures_are(live: Live, options: str) -> None:
    lab = live(f"""
        view = TextureView(TEXT, {options}, controls=False, layout={{'width': '240px'}}, flat=False,
                           turn=30.0, rise=-10.0, distance=9.0)
        view
    """)
    smooth = pixels(lab, state="smooth")
    adaptive, truth, raw = (wanted(lab, smooth, how) for how in ("adaptive", "supersample", None))
    # All but a pixel or two, of which one of the samples lies on a boundary to a thousandth of a millimetre.
    assert (np.abs(smooth - adaptive).max(axis=2) > 4).mean() < 0.0002
    # Where boundaries are, it is much nearer to sixteen samples everywhere than one sample is.
    edges = np.abs(raw - truth).max(axis=2) > 24
    assert edges.mean() > 0.02
    assert np.abs(smooth - truth)[edges].mean() < 0.25 * np.abs(raw - truth)[edges].mean()
    # It begins anew when one moves, and comes back to the same picture.
    turn = lab.python("view.turn")
    lab.page.evaluate(WATCH)
    lab.python("[setattr(view, 'turn', 20.0)]")
    lab.page.wait_for_function("() => window.states.includes('moving')")
    lab.python(f"[setattr(view, 'turn', {turn})]")

    def back() -> None:
        assert (pixels(lab, state="smooth") == smooth).mean() > 0.999

    eventually(lab.page, back)


def test_typing_changes_the_picture_and_a_fault_keeps_it(live: Live) -> None:
    lab = live("""
        model = TextureModel("S -> Mat(Color, 0, 1, 0, 0, 1)", lit=False)
        display(TextureView(model, controls=False, antialias='none', layout={'width': '200px'}), GrammarEditor(model))
    """)
    coloured(lab, [255, 0, 0, 255])
    area = lab.field("Grammar")
    retype(area, "S -> Mat(Color, 0, 0, 0, 1, 1)")
    lab.expect_python("model.text", "S -> Mat(Color, 0, 0, 0, 1, 1)")
    coloured(lab, [0, 0, 255, 255])
    retype(area, "S -> Matt(Color, 0, 0, 1, 0, 1)")
    fault = lab.page.locator(".fnb-tex-fault")
    expect(fault).to_contain_text("Line 1, column 6")
    expect(fault).to_contain_text("Mat")
    expect(fault.locator("pre")).to_contain_text("^")
    underlined = lab.page.locator(".fnb-tex-marks u")
    expect(underlined).to_have_text("Matt")
    # It lies under the word, also where one has scrolled.
    place = """word => {
        const area = document.querySelector(".fnb-tex-text"), pen = document.createElement("canvas").getContext("2d");
        pen.font = getComputedStyle(area).font;
        const [a, b] = [area, word].map(e => e.getBoundingClientRect()), own = area.value.split("\\n");
        const line = own.findIndex(one => one.includes("Matt"));
        const before = own[line].slice(0, own[line].indexOf("Matt"));
        return [b.left - (a.left + 8 + pen.measureText(before).width - area.scrollLeft),
            b.top - (a.top + 6 + 18 * line - area.scrollTop)];
    }"""

    def lies(tolerance: int) -> None:
        across, down = underlined.evaluate(place)
        assert abs(down) < 4
        assert abs(across) < tolerance  # a tab is up to eight letters wide

    for text in (
        "S -> Matt(Color, 0, 0, 1, 0, 1)",
        "# a\n" * 40 + f"# {'long ' * 80}\n" + "\tS -> Matt(Color)",
    ):
        (paste if "\n" in text else retype)(area, text)
        expect(fault).to_contain_text(f"Line {text.count(chr(10)) + 1}, ")
        expect(underlined).to_be_visible()
        area.evaluate("area => { area.scrollTop = 1e4; area.scrollLeft = 37; }")
        eventually(lab.page, functools.partial(lies, 2 if "\t" not in text else 80))
    retype(area, "S -> Matt(Color, 0, 0, 1, 0, 1)")
    expect(fault).to_contain_text("Line 1, column 6")
    lab.settle()
    coloured(lab, [0, 0, 255, 255])
    expect(area).to_have_value("S -> Matt(Color, 0, 0, 1, 0, 1)")


def test_faults_are_told_by_every_part(live: Live) -> None:
    """Where there is no picture yet, where it is an old one, and where there is no grammar to list."""
    lab = live("""
        model = TextureModel("S -> Matt(Color, 0, 1, 0, 0, 1)")
        display(TextureView(model, controls=False, antialias='none', layout={'width': '300px'}), GrammarEditor(model),
                GrammarTable(model))
    """)
    note, listed = lab.page.locator(".fnb-tex-note"), lab.page.locator(".fnb-tex-none")
    expect(note).to_contain_text("no picture yet")
    expect(note).to_contain_text("line 1, column 6: there is no operator 'Matt'; did you mean 'Mat'?")
    expect(listed).to_be_visible()
    expect(lab.page.locator(".fnb-tex-canvas")).to_be_hidden()
    height = lab.page.locator(".fnb-tex-stage").evaluate("stage => stage.clientHeight")
    assert height < 200
    area = lab.field("Grammar")
    retype(area, "S -> Mat(Color, 0, 1, 0, 0, 1)")
    expect(note).to_be_hidden()
    expect(listed).to_be_hidden()
    expect(lab.page.locator(".fnb-tex-faults")).to_have_text(lab.python("model.grammar.report()"))
    until(lab.page, lambda: pixels(lab)[..., 0].max() > 200)
    retype(area, "S -> Mat(Color, 0, 1, 0, 0)")
    expect(note).to_contain_text("this is the picture of what it was before")
    expect(lab.page.locator(".fnb-tex-canvas")).to_be_visible()
    until(lab.page, lambda: pixels(lab)[..., 0].max() > 200)


def test_the_step_looked_at_is_in_sight(live: Live) -> None:
    """The last of many steps, and its record far down in the table; the page around does not scroll."""
    lab = live("""
        model = TextureModel(gallery.grammar('figure-10'), size=(14, 12))
        model.pick((5.2, 6.0))
        display(PixelInspector(model), GrammarTable(model))
    """)
    seen = """row => {
        const [a, b] = [row, row.closest("ol, .fnb-tex-table")].map((e) => e.getBoundingClientRect());
        return a.top >= b.top - 1 && a.bottom <= b.bottom + 1;
    }"""
    current, pixel = (
        lab.page.locator(name).first for name in (".fnb-tex-steps [aria-current]", "[data-lit=now]")
    )
    assert lab.page.locator(".fnb-tex-steps li").count() > 14  # more than fit
    expect(pixel).to_have_count(1)
    until(lab.page, lambda: current.evaluate(seen) and pixel.evaluate(seen))
    lab.page.locator(".fnb-tex-steps button").first.click()
    frames(lab.page)
    until(lab.page, lambda: current.evaluate(seen) and pixel.evaluate(seen))
    # What is looked at while the parts are hidden is in sight when they are shown.
    hide = "(parts, shown) => parts.forEach((part) => { part.style.display = shown ? '' : 'none'; })"
    parts = lab.page.locator(".fnb-tex-inspector, .fnb-tex-table")
    parts.evaluate_all(hide, False)
    lab.python("model.pick((9.3, 2.0)) and None")
    expect(lab.page.locator(".fnb-tex-inspector [role=status]")).to_contain_text("At 9.30, 2.00 m")
    frames(lab.page)
    parts.evaluate_all(hide, True)
    until(lab.page, lambda: current.evaluate(seen) and pixel.evaluate(seen))


LOSE = """() => {
    const { canvas } = globalThis[Symbol.for("facade_nb.pipeline.context")];
    window.lost = false;
    canvas.addEventListener("webglcontextlost", () => { window.lost = true; }, { once: true });
    window.losing = canvas.getContext("webgl2").getExtension("WEBGL_lose_context");
    window.losing.loseContext();
}"""


def test_a_lost_context_comes_back(live: Live) -> None:
    lab = live("""
        view = TextureView(TEXT, lit=False, controls=False, antialias='none', layout={'width': '200px'})
        other = TextureView(TEXT, seed=(3, 4), lit=False, controls=False, antialias='none', layout={'width': '200px'})
        display(view, other)
    """)
    before, beside = pixels(lab), pixels(lab, 1)
    lab.page.evaluate(LOSE)
    lab.page.wait_for_function("() => window.lost")
    lab.python("[setattr(view.model, 'seed', (5.0, 9.0))]")  # it changes while there is no context
    lab.settle()
    on_screen(lab, 1)  # and until then each keeps its picture
    lab.page.evaluate("() => window.losing.restoreContext()")
    after = agreeing(lab, 2, 0.002)
    assert (np.abs(after - before).max(axis=2) > 2).mean() > 0.02
    assert np.array_equal(pixels(lab, 1), beside)
    # Once more, in the middle of drawing.
    lab.python("[setattr(view, 'flat', False)]")
    lab.page.evaluate("() => globalThis[Symbol.for('facade_nb.pipeline.context')].lose()")
    agreeing(lab, 2, 0.002)


def test_ten_views_share_a_context(live: Live, lab: Notebook) -> None:
    made = "() => globalThis[Symbol.for('facade_nb.pipeline.context')]?.made ?? 0"
    before = lab.page.evaluate(made)
    code = """
        views = [TextureView(TEXT, seed=(k, 2 * k), lit=False, controls=False, antialias='none', flat=k % 2 > 0,
                             turn=25.0, layout={'width': '120px'}) for k in range(10)]
        display(*views)
    """
    for _ in range(2):  # run again, as one does
        live(code)
        expect(lab.page.locator(SHARP)).to_have_count(10)
        assert lab.page.evaluate(made) == max(before, 1)
    for k in range(10):
        lab.python(f"[globals().update(view=views[{k}])]")
        assert agreeing(lab, 2, 0.004, k)[..., :3].std() > 5
        on_screen(lab, k)


# As narrow as its columns may be: what is drawn in software costs by the pixel.
STUDIO = """
    studio = TextureStudio(gallery.grammar('figure-12'), flat=False, turn=20.0, rise=-8.0, layout={'width': '760px'})
    studio"""


def test_a_click_shows_the_derivation(live: Live) -> None:
    lab = live(STUDIO)
    expect(lab.page.locator(SHARP)).to_have_count(1)
    canvas = lab.page.locator(".fnb-tex-canvas")
    canvas.click()
    expect(lab.page.locator(".fnb-tex-steps li").first).to_be_visible()
    assert lab.page.locator(".fnb-tex-steps li").count() == lab.python("len(studio.model.derivation)")
    expect(lab.page.locator(".fnb-tex-overlay polygon.fnb-tex-now")).to_have_count(1)
    lab.page.locator(".fnb-tex-steps button").first.click()
    read = lab.python("len(studio.model.derivation[0].records)")
    expect(lab.page.locator(".fnb-tex-pixel[data-lit=now]")).to_have_count(read)


def test_the_picture_stays_on_the_screen_when_the_theme_changes(live: Live) -> None:
    """After a click, with scopes over it: JupyterLab hides the page for a moment, and then a stage has no size."""
    lab = live(STUDIO)
    pixels(lab, state="smooth")
    lab.page.locator(".fnb-tex-canvas").click()
    for k in range(3):
        lab.page.locator(".fnb-tex-steps button").nth(k).click()
    lab.page.mouse.move(5, 5)
    lab.settle()
    before = still(lab)
    assert before.std() > 20

    def same() -> None:
        pixels(lab, state="smooth")
        inner = (slice(4, -4), slice(4, -4))  # without the frame, which has the theme's colour
        now = screen(lab)
        assert now.shape == before.shape
        assert (np.abs(now - before)[inner].max(axis=2) > 8).mean() < 0.001

    try:
        for theme in ("JupyterLab Dark", "JupyterLab Light", "JupyterLab Dark", "JupyterLab Light"):
            lab.theme(theme)
            shown = "dark" if theme.endswith("Dark") else "light"
            expect(lab.page.locator(".fnb-texture").first).to_have_attribute("data-theme", shown)
            frames(lab.page, 4)
            eventually(lab.page, same)
    finally:
        lab.theme("JupyterLab Light")


ROOM = """S -> Layer(Wall, Bay)
Wall -> Mat(Color, 0, 0.5, 0.5, 0.5, 1)
Bay -> SplitX(Rel, 1, Skip, Abs, 4, Column, Rel, 1, Skip)
Column -> SplitY(Rel, 1, Skip, Abs, 3, Room, Rel, 1, Skip)
Room -> Intrusion(2, Red, Blue, Red, Green, Green)
Red -> Mat(Color, 0, 1, 0, 0, 1)
Green -> Mat(Color, 0, 0, 1, 0, 1)
Blue -> Mat(Color, 0, 0, 0, 1, 1)
Skip -> Skip(0)"""


def test_scopes_in_rooms_are_drawn_where_their_walls_are_seen(live: Live) -> None:
    lab = live(f"""
        view = TextureView({ROOM!r}, size=(8, 6), lit=False, controls=False, antialias='none',
                           layout={{'width': '480px'}}, flat=False, turn=0.0, rise=0.0, distance=9.0)
        view
    """)
    for turn, rise in ((0.0, 0.0), (12.0, -6.0)):
        lab.python(f"[setattr(view, 'turn', {turn}), setattr(view, 'rise', {rise})]")
        image = agreeing(lab, 2, 0.004)
        blue = (image == [0, 0, 255, 255]).all(axis=2)
        rows, columns = np.nonzero(blue)
        canvas = lab.page.locator(".fnb-tex-canvas")
        canvas.click(position={"x": float(np.median(columns)), "y": float(np.median(rows))})
        lab.expect_python("view.model.derivation[-1].name if view.model.derivation else ''", "Blue")
        last = lab.page.locator(".fnb-tex-overlay polygon.fnb-tex-now.fnb-tex-inside")
        expect(last).to_have_count(1)
        corners = np.array([p.split(",") for p in (last.get_attribute("points") or "").split()], float)
        # The back wall is blue up to its outline, as far as it is not hidden by the edges of the window.
        inside = Image.new("L", image.shape[1::-1])
        ImageDraw.Draw(inside).polygon([tuple(corner) for corner in corners.tolist()], fill=1)
        covered = np.array(inside, bool)
        assert covered[blue].mean() > 0.99
        whole = abs(covered.sum() - blue.sum()) / blue.sum()
        assert whole < (0.03 if turn == 0 else 0.6)
        if turn == 0:  # all of it is seen
            assert np.abs(corners.min(axis=0) - [columns.min(), rows.min()]).max() < 2
            assert np.abs(corners.max(axis=0) - [columns.max() + 1, rows.max() + 1]).max() < 2
        lab.python("[view.model.pick(None) or 0]")


def test_keys_and_pointer_move_about(live: Live) -> None:
    lab = live("""
        view = TextureView(TEXT, lit=False, antialias='none', layout={'width': '300px'}, flat=False, turn=10.0)
        view
    """)
    page, canvas = lab.page, lab.page.locator(".fnb-tex-canvas")
    looks = "[view.turn, view.rise, view.distance, list(view.target)]"
    last, at = pixels(lab), lab.python(looks)

    def moved(what: str) -> list[Any]:
        """The picture has changed, Python knows it, and both agree."""
        nonlocal last, at
        before = at

        def arrived() -> Any:  # Python is told whenever one rests, which may be in the middle of a drag
            image = agreeing(lab, 2, 0.005)
            assert (image != last).any(axis=2).mean() > 0.01, what
            now = lab.python(looks)
            assert now != before, what
            return image, now

        last, at = eventually(page, arrived)
        return [before, at]

    def middle() -> tuple[float, float]:
        canvas.scroll_into_view_if_needed()
        box = canvas.bounding_box()
        assert box
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    # The wheel belongs to the page until the picture has the focus.
    page.evaluate("() => addEventListener('wheel', () => { window.wheeled = true; }, { once: true })")
    page.mouse.move(*middle())
    page.mouse.wheel(0, -300)
    page.wait_for_function("() => window.wheeled")
    lab.settle()
    assert np.array_equal(pixels(lab), last)
    assert lab.python(looks) == at

    x, y = middle()  # the page may have scrolled
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 60, y, steps=4)
    page.mouse.up()
    before, now = moved("drag")
    assert now[0] > before[0] + 10 and now[3] == []
    assert lab.python("view.model.point") is None  # a drag is no click

    page.keyboard.down("Shift")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 40, y + 20, steps=4)
    page.mouse.up()
    page.keyboard.up("Shift")
    before, now = moved("shift-drag")
    assert now[:2] == before[:2]
    assert now[3][0] > 6 and now[3][1] > 4.5

    page.mouse.move(x, y)
    page.mouse.wheel(0, -300)  # the press has given it the focus
    before, now = moved("wheel")
    near = now[2]
    assert near > 0

    canvas.focus()
    for key, k, sign in (("ArrowRight", 0, 1), ("ArrowLeft", 0, -1), ("ArrowUp", 1, 1), ("ArrowDown", 1, -1)):
        canvas.press(key)
        before, now = moved(key)
        assert sign * (now[k] - before[k]) > 1, key
    canvas.press("+")
    assert moved("+")[1][2] < near
    canvas.press("Shift+ArrowRight")
    before, now = moved("Shift+ArrowRight")
    assert now[3][0] > before[3][0]
    canvas.press("Home")
    assert moved("Home")[1] == [0, 0, 0, []]
    canvas.press("Enter")
    lab.expect_python("view.model.point", [6.0, 4.5])
    canvas.press("Escape")
    lab.expect_python("view.model.point", None)


def test_sliders_and_buttons(live: Live) -> None:
    lab = live("""
        view = TextureView(TEXT, hour=11.0, antialias='none', layout={'width': '300px'}, flat=False, turn=10.0)
        view
    """)
    last = pixels(lab)
    for label, value, state in (
        ("Seed", 7, "list(view.model.seed)"),
        ("Width", 9, "view.model.size[0]"),
        ("Height", 6, "view.model.size[1]"),
        ("Hour", 21, "view.model.hour"),
    ):
        slide(lab.field(label), value)
        lab.expect_python(state, [7.0, 14.0] if label == "Seed" else float(value))
        image = agreeing(lab, 4, 0.01)
        assert image.shape != last.shape or (image != last).any(axis=2).mean() > 0.01, label
        last = image
    # Many values in a row: the slider is never set back, and the last one arrives.
    jumps = lab.field("Width").evaluate("""async (input) => {
        const jumps = [];
        for (let value = 9; value <= 20; value += 0.5) {
            input.value = value;
            input.dispatchEvent(new Event("input", {bubbles: true}));
            await new Promise((done) => setTimeout(done, 15));
            if (Math.abs(input.value - value) > 1e-6) jumps.push([value, input.value]);
        }
        return jumps;
    }""")
    assert jumps == []
    lab.expect_python("view.model.size[0]", 20.0)
    lab.button("Light of the hour or plain colours").click()
    lab.expect_python("view.model.lit", False)
    lab.button("Straight on or in perspective").click()
    lab.expect_python("view.flat", True)
    agreeing(lab, 2, 0.005)


WITHOUT = """() => {
    delete globalThis[Symbol.for("facade_nb.pipeline.context")];
    window.getContextOnce ??= HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind === "webgl2" ? null : window.getContextOnce.call(this, kind, ...rest);
    };
}"""
WITH = """() => {
    HTMLCanvasElement.prototype.getContext = window.getContextOnce;
    delete globalThis[Symbol.for("facade_nb.pipeline.context")];
}"""


def test_without_webgl_python_draws_a_still_picture(live: Live, out: Path) -> None:
    lab = live("0; TextureView('S -> Skip(0)', controls=False)")
    lab.page.evaluate(WITHOUT)
    try:
        live("view = TextureView(TEXT, lit=False, layout={'width': '420px'}); view")
        why = lab.page.locator(".fnb-tex-why")
        expect(why).to_contain_text("no WebGL2")
        expect(why).to_contain_text("hardware acceleration")
        still = lab.page.locator(".fnb-tex-still")
        expect(still).to_be_visible()
        lab.page.wait_for_function("() => document.querySelector('.fnb-tex-still').naturalWidth === 360")
        before = np.array(Image.open(BytesIO(still.screenshot())).convert("RGB"), np.int64)
        assert before.std() > 10
        lab.page.locator(".fnb-texture").screenshot(path=out / "texture-without-webgl.png")
        source = still.get_attribute("src") or ""
        slide(lab.field("Seed"), 7)
        expect(still).not_to_have_attribute("src", source)

        def differs() -> None:
            after = np.array(Image.open(BytesIO(still.screenshot())).convert("RGB"), np.int64)
            assert (after != before).any()

        eventually(lab.page, differs)
    finally:
        lab.page.evaluate(WITH)


def test_a_saved_notebook_shows_a_picture_without_a_kernel(visit: Visit) -> None:
    with visit("lab") as notebook:
        page = notebook.page
        shutil.copy(Path(__file__).resolve().parents[2] / "notebooks" / "texture.ipynb", notebook.root)
        notebook.visit("texture.ipynb")
        picture = page.get_by_alt_text("drawn by a texture grammar")
        expect(picture).to_be_visible()
        assert picture.evaluate("image => image.naturalWidth") == 360
        assert np.array(Image.open(BytesIO(picture.screenshot())).convert("L")).std() > 10
        expect(page.get_by_role("cell", name="Floor -> RandStack(Bays)")).to_be_visible()


def test_a_picture_that_changes_while_it_is_hidden_is_there_again(live: Live) -> None:
    lab = live("view = TextureView(TEXT, antialias='none', layout={'width': '300px'}); view")
    pixels(lab)
    lab.python("len(view.model.pick((6.0, 4.5)))")
    lab.settle()
    before = still(lab)
    lab.page.evaluate("""async () => {
        const stage = document.querySelector(".fnb-tex-stage");
        stage.style.display = "none";
        stage.querySelector("canvas").dispatchEvent(new KeyboardEvent("keydown", {key: "+"}));
        await new Promise(requestAnimationFrame);
        stage.style.display = "";
    }""")

    def nearer() -> None:
        pixels(lab)
        now = screen(lab)
        assert (np.abs(now - before).max(axis=2) > 8).mean() > 0.02
        assert (now == 255).all(axis=2).mean() < 0.2
        assert now.std() > 20

    eventually(lab.page, nearer)
