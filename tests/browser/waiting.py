"""Waiting for what is to come, never for a while: a busy machine makes it later, and nothing else."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

from playwright.sync_api import Page

__all__ = ["LIMIT", "eventually", "frames", "until"]

LIMIT = 180.0
"""Seconds after which something is held to never come; what comes is waited for no longer than it takes."""

Value = TypeVar("Value")


def eventually(page: Page, check: Callable[[], Value]) -> Value:
    """Make a check again and again until its assertions hold, and return what it returns."""
    end = time.monotonic() + LIMIT
    while True:
        try:
            return check()
        except AssertionError:
            if time.monotonic() > end:
                raise
        page.wait_for_timeout(50)  # the page's own events are handled meanwhile


def until(page: Page, look: Callable[[], Value]) -> Value:
    """Look again and again until there is something: what is neither false, nor zero, nor empty."""

    def check() -> Value:
        found = look()
        assert found
        return found

    return eventually(page, check)


def frames(page: Page, count: int = 2) -> None:
    """Let the page draw so many frames: what was changed before is laid out, and observers of sizes are told."""
    page.evaluate(
        """count => new Promise(done => {
            const next = () => count-- > 0 ? requestAnimationFrame(next) : done();
            next();
        })""",
        count,
    )
