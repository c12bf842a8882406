"""The site as a reader has it: made by its command, opened from its folder, without a server, network or kernel."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from ..browser.jupyter import browse

ROOT = Path(__file__).resolve().parents[2]
LIMIT = 120_000  # milliseconds: machines are shared


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Make the site."""
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "scripts.docs.site", folder]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.fixture
def page(site: Path) -> Iterator[Page]:
    """A page of a browser that has no network; nothing may go wrong in it, or be asked for elsewhere."""
    problems: list[str] = []
    with browse() as browser:
        page = browser.new_page(viewport={"width": 1200, "height": 1000})
        page.set_default_timeout(LIMIT)
        page.on("console", lambda told: told.type == "error" and problems.append(told.text))
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.on(
            "request",
            lambda asked: asked.url.startswith(("file:", "blob:", "data:")) or problems.append(asked.url),
        )
        yield page
    assert problems == []


def test_views_are_live_from_plain_files(site: Path, page: Page) -> None:
    """A solver's view is stepped by keys, a texture is drawn, a town is flown through."""
    page.goto((site / "index.html").as_uri())
    track = page.locator(".fnb-live .fnb-play-track")
    expect(page.locator(".fnb-live")).to_have_attribute("data-live", "shown", timeout=LIMIT)
    expect(page.locator(".fnb-live-still")).to_be_hidden()
    last = track.get_attribute("aria-valuemax") or ""
    expect(track).to_have_attribute("aria-valuenow", last)
    track.focus()
    page.keyboard.press("ArrowLeft")
    expect(track).to_have_attribute("aria-valuenow", str(int(last) - 1), timeout=LIMIT)
    page.keyboard.press("Home")
    expect(page.get_by_text("Nothing is placed yet")).to_be_visible(timeout=LIMIT)

    page.set_viewport_size({"width": 500, "height": 700})  # few pixels: they are drawn in software
    page.goto((site / "docs" / "widget-reference.html").as_uri() + "#pixelinspector-grammartable")
    texture = page.locator(".fnb-tex-canvas").first
    texture.scroll_into_view_if_needed()
    expect(texture).to_have_attribute("data-state", "smooth", timeout=LIMIT)

    town = page.locator(".fnb-town-canvas")
    page.get_by_role("heading", name="TownView").scroll_into_view_if_needed()
    town.scroll_into_view_if_needed()
    expect(town).to_have_attribute("data-state", "sharp", timeout=LIMIT)
    assert town.get_attribute("data-loaded") == "1.000"
    before = town.screenshot()
    town.focus()
    page.keyboard.down("w")
    page.wait_for_function("canvas => canvas.dataset.state !== 'sharp'", arg=town.element_handle())
    page.keyboard.up("w")
    expect(town).to_have_attribute("data-state", "sharp", timeout=LIMIT)
    assert town.screenshot() != before
