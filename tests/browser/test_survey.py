"""A façade drawn over a photograph, in a real JupyterLab: straight, drawn, snapped, copied, by hand and keys."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image, ImageDraw
from playwright.sync_api import expect

from .jupyter import Notebook
from .waiting import frames

CORNERS = [(150, 800), (1050, 900), (1000, 100), (250, 200)]
"""Of the façade, in a photograph of 1200 by 1000 pixels."""


def test_a_facade_is_drawn_over_a_photograph(
    show: Callable[[str], Notebook], tmp_path: Path, out: Path
) -> None:
    image = Image.new("RGB", (1200, 1000), "white")
    ImageDraw.Draw(image).polygon(CORNERS, fill=(200, 30, 30))
    image.save(tmp_path / "photo.png")
    lab = show(f"editor = SurveyEditor(photo={str(tmp_path / 'photo.png')!r})\neditor")
    page = lab.page
    canvas = page.locator(".fnb-sur-canvas")

    def box() -> dict[str, float]:
        frames(page)
        found = canvas.bounding_box()
        assert found is not None
        return found

    def drag(start: tuple[float, float], end: tuple[float, float]) -> None:
        """From one place of the canvas to another, 0 to 1 from its upper left."""
        at = box()
        points = [(at["x"] + x * at["width"], at["y"] + y * at["height"]) for x, y in (start, end)]
        page.mouse.move(*points[0])
        page.mouse.down()
        page.mouse.move(*points[1], steps=4)
        page.mouse.up()

    expect(page.locator(".fnb-sur-photo")).to_be_visible()  # it has been read
    lab.button("Corners").click()
    expect(page.locator(".fnb-sur-stage")).to_have_attribute("data-cornering", "")
    for (x, y), first in zip(CORNERS, [(0.1, 0.9), (0.9, 0.9), (0.9, 0.1), (0.1, 0.1)], strict=True):
        drag(first, (x / 1200, y / 1000))
    lab.expect_python("[[round(v, 2) for v in c] for c in editor.model.drawn.corners]",
                      [[round(x / 1200, 2), round(y / 1000, 2)] for x, y in CORNERS])  # fmt: skip
    lab.button("Corners").click()
    expect(page.locator(".fnb-sur-stage")).not_to_have_attribute("data-cornering", "")
    lab.settle()
    # Straight: the façade fills the canvas, and nothing else of the photograph is seen.
    photo = Image.open(_screenshot(page, canvas, tmp_path))
    seen = [
        photo.getpixel((round(x * photo.width), round(y * photo.height)))
        for x in (0.03, 0.97)
        for y in (0.03, 0.97)
    ]
    assert all(r > 180 and g < 60 and b < 60 for r, g, b, *_ in seen), seen
    drag((0.1, 0.2), (0.2, 0.4))
    drag((0.3, 0.207), (0.4, 0.396))  # almost as high: it snaps
    rects = "[o['rect'] for o in editor.survey.openings]"
    lab.expect_python(f"len({rects})", 2)
    first, second = lab.python(rects)
    assert first[1::2] == second[1::2] and first[0] == pytest.approx(1.2, abs=0.02)
    canvas.press("c")  # as far as the neighbour stands
    lab.expect_python(f"round({rects}[2][0], 2)", round(2 * second[0] - first[0], 2))
    canvas.press("d")
    lab.expect_python("editor.survey.openings[3]['kind']", "door")
    left = lab.python(f"{rects}[3][0]")
    canvas.press("ArrowRight")
    lab.expect_python(f"round({rects}[3][0], 2)", round(left + 0.01, 2))
    canvas.press("ControlOrMeta+ArrowLeft")  # to the next edge of a window
    edges = sorted(
        {round(side, 3) for rect in (first, second) for side in rect[::2]}
        | {lab.python(f"round({rects}[2][0], 3)")}
    )
    door = lab.python(f"[round(v, 3) for v in {rects}[3][::2]]")
    assert set(door) & set(edges), (door, edges)
    page.screenshot(path=out / "survey.png")
    canvas.press("Delete")
    lab.expect_python("len(editor.survey.openings)", 3)
    canvas.press("ControlOrMeta+z")
    lab.expect_python("len(editor.survey.openings)", 4)
    canvas.press("p")
    lab.retype("True length, metres", "1.5")
    page.keyboard.press("Enter")
    lab.expect_python(
        "round(editor.survey.openings[2]['rect'][2] - editor.survey.openings[2]['rect'][0], 3)", 1.5
    )
    assert lab.python("editor.infer('drawn').name") == "drawn"
    lab.resize(680)
    lab.theme("JupyterLab Dark")
    frames(page, 3)
    page.screenshot(path=out / "survey-dark.png")
    lab.theme("JupyterLab Light")


def _screenshot(page, canvas, folder: Path) -> Path:  # type: ignore[no-untyped-def]
    path = folder / "straight.png"
    page.screenshot(path=path, clip=canvas.bounding_box())
    return path
