"""Every chapter and notebook of the site is alive: its views stand there, step, turn and fly, from plain files."""

from __future__ import annotations

import json
import re
from pathlib import Path

from playwright.sync_api import Locator, Page, expect

from facade_nb.course.chapters import CHAPTERS

from .conftest import LIMIT, ROOT


def places(page: str) -> list[tuple[str, str]]:
    """The file of the state, and the number of the model, of each view of a page."""
    return re.findall(
        r'<div class="fnb-live" data-source="([^"]+)" data-state="[^"]+" data-model="([^"]+)"', page
    )


def test_every_chapter_and_notebook_has_views_and_pages_share_the_code(site: Path) -> None:
    chapters = [f"tutorials/{name}" for name in CHAPTERS]
    notebooks = [f"notebooks/{path.stem}" for path in sorted((ROOT / "notebooks").glob("*.ipynb"))]
    codes = set()
    for name in [*chapters, *notebooks]:
        found = places((site / f"{name}.html").read_text("utf-8"))
        assert found, name
        for source, model in found:
            text = (site / name).parent.joinpath(source).resolve().read_text("utf-8")
            state = json.loads(text.partition(",")[2].removesuffix(");\n"))["state"]
            assert model in state
            told = [own["code"] for own in state.values() if "code" in own]
            assert told and not [own for own in state.values() if own["state"].get("module")], name
            codes.update(told)
    live = site / "_static" / "live"
    assert codes <= {path.stem for path in live.glob("code-*.js")}
    assert len(codes) == len(list(live.glob("code-*.js"))) <= 7  # one of each bundle


def shown(page: Page, number: int = 0) -> Locator:
    """A view of the page, once it stands there."""
    view = page.locator(".fnb-live").nth(number)
    view.scroll_into_view_if_needed()
    expect(view).to_have_attribute("data-live", "shown", timeout=LIMIT)
    return view


def test_chapters_step_predict_turn_and_fly(site: Path, page: Page) -> None:
    """One of each kind: a network is stepped, sizes are asked for, a room is turned, a hamlet is flown through."""
    page.set_viewport_size({"width": 560, "height": 700})  # few pixels: they are drawn in software

    def go(name: str) -> None:
        page.goto((site / "tutorials" / f"{name}.html").as_uri())

    go("06-a-shortest-path")
    track = shown(page).locator(".fnb-play-track")
    at = int(track.get_attribute("aria-valuenow") or "")
    track.press("ArrowRight")
    expect(track).to_have_attribute("aria-valuenow", str(at + 1), timeout=LIMIT)

    go("09-sizes")
    asked = shown(page)
    asked.get_by_role("button", name="Hint", exact=True).press("Enter")
    expect(asked.locator(".fnb-quiz-hint")).to_be_visible()

    go("11-rooms-behind-windows")
    room = shown(page).locator(".fnb-tex-canvas")
    expect(room).to_have_attribute("data-state", "smooth", timeout=LIMIT)
    before = room.screenshot()
    room.press("ArrowLeft")
    page.wait_for_function("canvas => canvas.dataset.state !== 'smooth'", arg=room.element_handle())
    expect(room).to_have_attribute("data-state", "smooth", timeout=LIMIT)
    assert room.screenshot() != before

    go("12-the-pipeline-and-a-town")
    hamlet = shown(page).locator(".fnb-town-canvas").first
    expect(hamlet).to_have_attribute("data-state", "sharp", timeout=LIMIT)
    assert hamlet.get_attribute("data-loaded") == "1.000"
    before = hamlet.screenshot()
    hamlet.focus()
    page.keyboard.down("w")
    page.wait_for_function("canvas => canvas.dataset.state !== 'sharp'", arg=hamlet.element_handle())
    page.keyboard.up("w")
    expect(hamlet).to_have_attribute("data-state", "sharp", timeout=LIMIT)
    assert hamlet.screenshot() != before
