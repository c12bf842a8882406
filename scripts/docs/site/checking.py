"""What must hold of the site as it lies there: nothing is fetched from elsewhere, and what pages point to is there."""

from __future__ import annotations

from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

__all__ = ["Page", "faults"]

FETCHED = {
    ("script", "src"),
    ("img", "src"),
    ("link", "href"),
    ("iframe", "src"),
    ("source", "src"),
    ("video", "src"),
}


class Page(HTMLParser):
    """Names that a page has, what it points to, and what it fetches."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.names: set[str] = set()
        self.links: list[str] = []
        self.fetched: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        told = dict(attrs)
        self.names |= {value for key in ("id", "name") if (value := told.get(key))}
        for key in ("href", "src"):
            if not (value := told.get(key)) or told.get("rel") in ("canonical",):
                continue
            if (tag, key) in FETCHED:
                self.fetched.append(value)
            else:
                self.links.append(value)
        if source := told.get("data-source"):
            self.fetched.append(source)


def faults(site: Path) -> list[str]:
    """Each thing that is wrong, with the page that it is on."""

    @cache
    def read(path: Path) -> Page:
        return Page(path.read_text("utf-8"))

    found = []
    for path in sorted(site.rglob("*.html")):
        page, here = read(path), path.relative_to(site)
        for link in [*page.fetched, *page.links]:
            parts = urlsplit(link)
            if parts.scheme in ("data", "mailto"):
                continue
            if parts.scheme or parts.netloc:
                if link in page.fetched:
                    found.append(f"{here}: fetches {link[:100]}, which is not a file of the site")
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not target.is_file():
                found.append(f"{here}: there is no {link[:100]}")
            elif (
                parts.fragment
                and target.suffix == ".html"
                and not _has(read(target), unquote(parts.fragment))
            ):
                found.append(f"{here}: {link[:100]} names a place that is not there")
    return found


def _has(page: Page, name: str) -> bool:
    return name in page.names or name in ("", "facade-nb") or name.startswith("facade-nb=")
