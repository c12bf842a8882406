"""Where things are on a page."""

from __future__ import annotations

from playwright.sync_api import Page

__all__ = ["apart"]


def apart(page: Page, one: str, other: str) -> bool:
    """Whether two things on the page do not overlap."""
    a, b = (page.locator(query).first.bounding_box() for query in (one, other))
    assert a and b
    return (
        a["x"] + a["width"] <= b["x"] + 1
        or b["x"] + b["width"] <= a["x"] + 1
        or a["y"] + a["height"] <= b["y"] + 1
        or b["y"] + b["height"] <= a["y"] + 1
    )
