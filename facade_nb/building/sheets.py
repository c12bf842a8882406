"""A building on sheets of paper: as many walls side by side as a readable scale has room for."""

from __future__ import annotations

from collections.abc import Sequence

from ..render.exchange.chains import Units
from ..render.exchange.pdf import Page, largest_scale, sheets_pdf
from .developed import GAP, developed
from .layout import BuildingLayout, SolvedFace

__all__ = ["to_pdf"]

_READABLE = 100
"""All walls stand on one sheet if they fit there at 1:100; else each has one at which it does, or at which it fits."""


def to_pdf(layout: BuildingLayout, units: Units) -> bytes:
    """The elevations of all walls, each with its name, on as few sheets as their scale allows; all have the same."""
    pages, scale = _pages(layout, units)
    return sheets_pdf(layout.developed, pages, units, scale)


def _pages(layout: BuildingLayout, units: Units) -> tuple[list[Page], int]:
    whole = _page(layout, layout.faces)
    least = largest_scale(whole, units)
    if least <= _READABLE or len(layout.faces) < 2:
        return [whole], 1
    scale = max(_READABLE, *(largest_scale(_page(layout, (own,)), units) for own in layout.faces))
    if least <= scale:
        return [whole], 1
    pages: list[Page] = []
    some: list[SolvedFace] = []
    for own in layout.faces:
        page = _page(layout, [*some, own])
        if not some or largest_scale(page, units) > scale:
            some = []
            page = _page(layout, [own])
            pages.append(page)
        some.append(own)
        pages[-1] = page
    return pages, scale


def _page(layout: BuildingLayout, faces: Sequence[SolvedFace]) -> Page:
    names, at = [], 0.0
    for own in faces:
        names.append((own.face.name, at, at + own.face.length))
        at += own.face.length + GAP
    return Page(developed(layout, faces), tuple(names))
