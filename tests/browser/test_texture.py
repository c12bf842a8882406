"""Texture grammars live, in a real JupyterLab: pixels that are read from the canvas."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import expect

from .jupyter import Notebook

HEAD = """
from IPython.display import display
from facade_nb import gallery
from facade_nb.widgets import *
import numpy as np
from facade_nb.render.developing import developed
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
def lit(view, pixels):
    sight = view.sight(pixels)
    question = view.model.grammar.question(view.model.size, view.model.seed)
    surface = PAINTERS["cpu"].paint(question, sight, mips=True).surface
    looks, day = sight.looks(), Daytime.at(view.model.hour)
    free = np.ones(len(looks.rays), np.float32)
    heights = sight.eye[1] + looks.rays[:, 1] * sight.eye[2] / np.maximum(-looks.rays[:, 2], 1e-6)
    seen = light(*surface[:3], looks.rays, day, free, heights.astype(np.float32))
    seen += (1 - surface.color[:, 3:].clip(0, 1)) * day.backdrop(looks.rays)
    return (developed(seen, day.exposure) * 255).round().astype(int).tolist()
def expected(view, pixels):
    question = view.model.grammar.question(view.model.size, view.model.seed)
    color = PAINTERS["cpu"].paint(question, view.sight(pixels), mips=True).surface.color
    return (color * 255).round().astype(int).tolist()
"""

Live = Callable[[str], Notebook]
SHARP = ".fnb-tex-canvas[data-state=sharp]"
READ = """canvas => [canvas.width, canvas.height,
    [...canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data]]"""


@pytest.fixture
def live(lab: Notebook) -> Live:
    """Show views; the code's last line is displayed."""

    def run(code: str) -> Notebook:
        lab.run("0")
        expect(lab.page.locator(".fnb-texture")).to_have_count(0)
        lab.run(HEAD + textwrap.dedent(code))
        expect(lab.page.locator(".fnb-texture").first).to_be_visible()
        return lab

    return run


def pixels(lab: Notebook, index: int = 0) -> Any:
    """The canvas when it is sharp, (h, w, 4)."""
    canvas = lab.page.locator(".fnb-tex-canvas").nth(index)
    expect(canvas).to_have_attribute("data-state", "sharp", timeout=60_000)
    width, height, data = canvas.evaluate(READ)
    return np.array(data, np.int64).reshape(height, width, 4)


def on_screen(lab: Notebook, index: int) -> float:
    """How much the picture varies as the screen has it; waits for the browser to paint, which is slow in software."""
    stage = lab.page.locator(".fnb-tex-stage").nth(index)
    for _ in range(20):
        varies = float(np.array(Image.open(BytesIO(stage.screenshot())).convert("L")).std())
        if varies > 5:
            break
        lab.page.wait_for_timeout(300)
    return varies


@pytest.mark.parametrize("sight", ["flat=True", "flat=False, turn=30.0, rise=-10.0, distance=6.0"])
def test_the_canvas_agrees_with_numpy(live: Live, sight: str) -> None:
    lab = live(
        f"view = TextureView(TEXT, lit=False, controls=False, layout={{'width': '240px'}}, {sight}); view"
    )
    image = pixels(lab)
    height, width = image.shape[:2]
    wanted = np.array(lab.python(f"expected(view, ({width}, {height}))")).reshape(image.shape)
    away = np.abs(image - wanted).max(axis=2) > 2
    assert wanted[..., 3].mean() > 100
    assert away.mean() < 0.002


@pytest.mark.parametrize("hour", [9.5, 22.0])
def test_light_agrees_with_numpy(live: Live, hour: float) -> None:
    lab = live(f"""
        view = TextureView(TEXT, hour={hour}, controls=False, layout={{'width': '240px'}},
                           flat=False, turn=30.0, rise=-10.0)
        view
    """)
    image = pixels(lab)
    height, width = image.shape[:2]
    wanted = np.array(lab.python(f"lit(view, ({width}, {height}))")).reshape(height, width, 3)
    assert (np.abs(image[..., :3] - wanted).max(axis=2) > 4).mean() < 0.01
    assert wanted.std() > 10


def test_typing_changes_the_picture_and_a_fault_keeps_it(live: Live) -> None:
    lab = live("""
        model = TextureModel("S -> Mat(Color, 0, 1, 0, 0, 1)", lit=False)
        display(TextureView(model, controls=False, layout={'width': '200px'}), GrammarEditor(model))
    """)
    image = pixels(lab)
    middle = (image.shape[0] // 2, image.shape[1] // 2)
    assert image[middle].tolist() == [255, 0, 0, 255]
    area = lab.field("Grammar")
    area.fill("S -> Mat(Color, 0, 0, 0, 1, 1)")
    lab.expect_python("model.text", "S -> Mat(Color, 0, 0, 0, 1, 1)")
    lab.page.wait_for_timeout(400)
    assert pixels(lab)[middle].tolist() == [0, 0, 255, 255]
    area.fill("S -> Matt(Color, 0, 0, 1, 0, 1)")
    fault = lab.page.locator(".fnb-tex-fault")
    expect(fault).to_contain_text("Line 1, column 6")
    expect(fault).to_contain_text("Mat")
    expect(fault.locator("pre")).to_contain_text("^")
    lab.page.wait_for_timeout(400)
    assert pixels(lab)[middle].tolist() == [0, 0, 255, 255]
    expect(area).to_have_value("S -> Matt(Color, 0, 0, 1, 0, 1)")


def test_a_lost_context_comes_back(live: Live) -> None:
    lab = live("view = TextureView(TEXT, lit=False, controls=False, layout={'width': '200px'}); view")
    before = pixels(lab)
    lab.page.evaluate("() => globalThis[Symbol.for('facade_nb.texture.renderer')].lose()")
    lab.python("[setattr(view.model, 'seed', (5.0, 9.0))]")
    lab.page.wait_for_timeout(600)
    after = pixels(lab)
    wanted = np.array(lab.python(f"expected(view, ({after.shape[1]}, {after.shape[0]}))")).reshape(
        after.shape
    )
    assert (np.abs(after - wanted).max(axis=2) > 2).mean() < 0.002
    assert (after != before).any()


def test_ten_views_share_a_context(live: Live, lab: Notebook) -> None:
    made = "() => globalThis[Symbol.for('facade_nb.texture.renderer')]?.made ?? 0"
    before = lab.page.evaluate(made)
    live("""
        display(*(TextureView(TEXT, seed=(k, 2 * k), lit=False, controls=False, layout={'width': '120px'})
                  for k in range(10)))
    """)
    expect(lab.page.locator(SHARP)).to_have_count(10, timeout=60_000)
    for k in range(10):
        image = pixels(lab, k)
        assert (image[..., 3] > 0).mean() > 0.5
        assert image[..., :3].std() > 5
    assert lab.page.evaluate(made) == max(before, 1)
    for k in range(10):
        assert on_screen(lab, k) > 5


def test_a_click_shows_the_derivation(live: Live) -> None:
    lab = live(
        "studio = TextureStudio(gallery.grammar('figure-12'), flat=False, turn=20.0, rise=-8.0); studio"
    )
    pixels(lab)
    canvas = lab.page.locator(".fnb-tex-canvas")
    canvas.click()
    expect(lab.page.locator(".fnb-tex-steps li").first).to_be_visible()
    assert lab.page.locator(".fnb-tex-steps li").count() == lab.python("len(studio.model.derivation)")
    expect(lab.page.locator(".fnb-tex-overlay polygon.fnb-tex-now")).to_have_count(1)
    lab.page.locator(".fnb-tex-steps button").first.click()
    read = lab.python("len(studio.model.derivation[0].records)")
    expect(lab.page.locator(".fnb-tex-pixel[data-lit=now]")).to_have_count(read)


@pytest.mark.parametrize("theme", ["JupyterLab Dark", "JupyterLab Light"])
def test_the_picture_stays_on_the_screen_when_the_theme_changes(live: Live, out: Path, theme: Any) -> None:
    lab = live("TextureStudio(gallery.grammar('figure-12'), flat=False, turn=20.0, rise=-8.0)")
    expect(lab.page.locator(SHARP)).to_have_count(1, timeout=60_000)
    try:
        lab.theme(theme)
        lab.page.wait_for_timeout(900)
        lab.page.locator(".fnb-texture").screenshot(path=out / f"texture-{theme.split()[1].lower()}.png")
        assert on_screen(lab, 0) > 5
    finally:
        lab.theme("JupyterLab Light")
