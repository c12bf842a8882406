"""Geometries with parameters, and mesh files, in the inspector."""

from __future__ import annotations

from collections.abc import Callable

from playwright.sync_api import expect

from .hand import Hand
from .jupyter import Notebook
from .keys import retype


def test_parameters_are_typed_and_a_bad_file_is_told(show: Callable[[str], Notebook]) -> None:
    studio = show("Studio(model)")
    hand, page = Hand(studio), studio.page
    studio.page.locator(".fnb-elevation [data-layer=base][data-x=B][data-y=Q]").first.click()
    hand.choose("geometry of B Q in base", "arca")
    look = "getattr(model.design.layers[0].shapes.get('B Q'), 'geometry', None)"
    studio.expect_python(look, "arcade")
    bays = studio.field("bays, geometry of B Q in base")
    retype(bays, "2")
    page.keyboard.press("Enter")
    studio.expect_python(look, "arcade(bays=2)")
    expect(page.locator(".fnb-elevation [data-layer=base][data-x=B][data-y=Q] title").first).to_contain_text(
        "bays=2"
    )
    retype(bays, "2.5")
    page.keyboard.press("Enter")
    expect(page.locator(".fnb-status-line")).to_contain_text(
        "bays of arcade: expected a whole number from 1 to 40"
    )
    hand.choose("geometry of B Q in base", "mesh")
    retype(studio.field("file, geometry of B Q in base"), "urn.obj")
    page.keyboard.press("Enter")
    studio.expect_python(look, "file:urn.obj")
    expect(page.locator(".fnb-studio, .fnb")).to_contain_text(["there is no file 'urn.obj'"])
    expect(page.locator(".fnb-elevation [data-shape]")).to_have_count(17)  # the rest is drawn
