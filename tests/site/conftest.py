"""The site, made once, and a browser that has no network."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page

from ..browser.jupyter import browse

ROOT = Path(__file__).resolve().parents[2]
LIMIT = 120_000  # milliseconds: machines are shared


@pytest.fixture(scope="session")
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
