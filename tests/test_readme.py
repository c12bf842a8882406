"""The README is true: its links lead somewhere, its code runs and says what it says."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text()
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    links = re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text())
    missing = [link for link in links if not (page.parent / link).exists()]
    assert not missing


def test_python_of_the_readme_runs() -> None:
    [code] = [c for c in re.findall(r"```python\n(.*?)```", README, re.S) if "Design.from_json" in c]
    names: dict[str, object] = {}
    exec(compile(code, "README.md", "exec"), names)
    layout = names["layout"]
    assert layout.counters == {"k": 3}
    assert layout.x.sizes["A"] == pytest.approx(0.936, abs=5e-4)


def test_files_of_the_readme_exist() -> None:
    for name in re.findall(r"`((?:notebooks|tutorials)/[a-z-]+\.ipynb)`", README):
        assert (ROOT / name).exists()


def test_make_targets_of_the_readme_exist() -> None:
    makefile = (ROOT / "Makefile").read_text()
    for target in re.findall(r"`?make ([a-z]+)", README):
        assert re.search(rf"^{target}:", makefile, re.M), target
