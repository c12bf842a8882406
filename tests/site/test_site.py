"""The site as a reader has it: made by its command, opened from its folder, without a server, network or kernel."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Page, expect

from .conftest import LIMIT


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
