"""What the site has, in which order. A page of `docs` that is not named here comes under *More*."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import PurePosixPath

__all__ = ["SECTIONS", "toctrees"]

SECTIONS: dict[str, tuple[str, ...]] = {
    "Start": ("docs/quick-start", "docs/installation", "docs/concepts", "docs/glossary"),
    "Learn": ("tutorials/*", "notebooks/*", "docs/figures"),
    "Design": (
        "docs/problem",
        "docs/patterns",
        "docs/documents",
        "docs/design-schema",
        "docs/gallery",
        "docs/surveys",
        "docs/buildings",
        "docs/variations",
    ),
    "Solver": (
        "docs/solver",
        "docs/alignment-search",
        "docs/analysis",
        "docs/trace",
        "docs/visible",
        "docs/differences",
    ),
    "Pictures and files": (
        "docs/rendering",
        "docs/exchange",
        "docs/texture",
        "docs/grammars",
        "docs/layout-grammar",
        "docs/tiles",
        "docs/photographs",
        "docs/pipeline",
    ),
    "Towns": ("docs/towns", "docs/town-plan", "docs/town-styles"),
    "Widgets": ("docs/widget-reference", "docs/widgets", "docs/texture-widgets", "docs/town-widgets"),
    "Reference": ("api/*", "docs/command-line"),
    "The project": ("docs/design", "CONTRIBUTING", "docs/measured", "docs/tested", "CHANGELOG"),
}
"""Pages by section, without their endings. A star stands for all of a folder, in the order of their names."""


def toctrees(pages: Iterable[str]) -> str:
    """The tables of contents that hold each page once: what no section names comes last.

    Raises
    ------
    ValueError
        For a page that a section names and that is not there.
    """
    left = sorted(set(pages) - {"index"})
    parts = []
    for title, patterns in SECTIONS.items():
        chosen = []
        for pattern in patterns:
            found = [page for page in left if PurePosixPath(page).match(pattern)]
            if not found:
                raise ValueError(f"expected a page {pattern} in the section {title!r}; found none")
            chosen += found
            left = [page for page in left if page not in found]
        parts.append(_toctree(title, chosen))
    if left:
        parts.append(_toctree("More", left))
    return "\n".join(parts)


def _toctree(title: str, pages: Iterable[str]) -> str:
    listed = "\n".join(f"/{page}" for page in pages)
    return f"```{{toctree}}\n:hidden:\n:caption: {title}\n\n{listed}\n```\n"
