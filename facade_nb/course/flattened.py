"""Layers put on each other without an alignment, and what is wrong then: the paper's Figures 3 and 4."""

from __future__ import annotations

from dataclasses import replace
from re import search

from ..design import Design
from ..render import elevation_svg, naive_layout
from ..render.naive import Flaw
from ..solver import Layout
from .network import Drawn

__all__ = ["colonnade", "flattened", "porch", "telling"]

_RED = "#d0312d"


def colonnade(width: float = 7.6) -> Design:
    """Two storeys of windows, and four columns before the lower one."""
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": "Colonnade",
            "canvas": {"width": width, "height": 4.4},
            "symbols": {
                "A": {"size": 0.9},
                "B": {"size": 1.2, "unoccludable": True},
                "C": {"size": 0.5, "opaque": False},
                "P": {"size": 2.4},
                "Q": {"size": 2.0},
            },
            "counters": {"j": {"value": 3}},
            "patterns": {"wall": "A(BA)^k", "columns": "c(ec)^j; c := C", "floors": "PQ"},
            "layers": [
                {"name": "wall", "x": {"pattern": "wall"}, "y": {"pattern": "floors"}},
                {
                    "name": "columns",
                    "x": {"pattern": "columns"},
                    "y": {"pattern": "floors", "mask": ["P"]},
                    "depth": 1,
                },
            ],
            "shapes": {
                "A P": {"material": "ashlar"},
                "A Q": {"material": "plaster-ochre"},
                "B P": {"kind": "window", "geometry": "arch", "material": "ashlar"},
                "B Q": {"kind": "window", "geometry": "window", "material": "painted-wood"},
                "C P": {"kind": "column", "geometry": "column", "material": "stone"},
            },
        }
    )


def porch(opaque: str = "AB", unoccludable: str = "", attached: str = "") -> Design:
    """A row of windows B and walls A, and two posts C before it; each text lists the symbols with that mark."""
    sizes = {"A": 0.9, "B": 1.2, "C": 0.6}
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": "Porch",
            "canvas": {"width": 5.4, "height": 2.8},
            "symbols": {
                **{
                    name: {
                        "size": size,
                        "opaque": name in opaque,
                        "unoccludable": name in unoccludable,
                        "attached": name in attached,
                    }
                    for name, size in sizes.items()
                },
                "Y": {"size": 2.8},
            },
            "counters": {"k": {"value": 2}},
            "patterns": {"wall": "B(AB)^k", "front": "cec; c := C", "storey": "Y"},
            "layers": [
                {"name": "wall", "x": {"pattern": "wall"}, "y": {"pattern": "storey"}},
                {"name": "front", "x": {"pattern": "front"}, "y": {"pattern": "storey"}, "depth": 1},
            ],
            "shapes": {
                "A Y": {"material": "brick-yellow"},
                "B Y": {"kind": "window", "geometry": "window", "material": "painted-wood"},
                "C Y": {"kind": "column", "geometry": "column", "material": "stone"},
            },
        }
    )


def telling(layout: Layout) -> tuple[Flaw, ...]:
    """One flaw of each kind that the chapter asks for, of a layout without its alignment, from left to right.

    Where a word leaves some of the canvas empty, the hole is told.
    """
    first: dict[str, Flaw] = {}
    for flaw in naive_layout(layout).flaws:
        if flaw.kind not in ("intrinsic", "short"):
            first.setdefault(flaw.kind, flaw)
    return tuple(sorted(first.values(), key=lambda own: own.rect[0]))


def flattened(layout: Layout) -> Drawn:
    """A picture of a layout's words side by side at preferred sizes; one flaw of each kind has a number."""
    naive = naive_layout(layout)
    svg = elevation_svg(replace(layout, shapes=naive.stacked(layout), holes=()))
    scale = _told(svg, "scale")[0]
    left, foot = _told(svg, "origin")
    marks, flaws = [], telling(layout)
    for number, flaw in enumerate(flaws, 1):
        x, y = left + scale * flaw.rect[0], foot - scale * flaw.rect[3]
        wide, tall = scale * (flaw.rect[2] - flaw.rect[0]), scale * (flaw.rect[3] - flaw.rect[1])
        marks.append(
            f"<rect x='{x:.1f}' y='{y:.1f}' width='{wide:.1f}' height='{tall:.1f}' fill='{_RED}' "
            f"fill-opacity='.18' stroke='{_RED}' stroke-width='2' />"
            f"<circle cx='{x + wide / 2:.1f}' cy='{y + 16:.1f}' r='12' fill='{_RED}' />"
            f"<text x='{x + wide / 2:.1f}' y='{y + 21:.1f}' fill='white' text-anchor='middle'>{number}</text>"
        )
    drawn = f"<g font-family='sans-serif' font-size='15'>{''.join(marks)}</g></svg>"
    name = layout.name or "The façade"
    return Drawn(
        svg.removesuffix("</svg>") + drawn, f"{name} without an alignment: {len(flaws)} places are marked"
    )


def _told(svg: str, name: str) -> list[float]:
    found = search(rf'data-{name}="([^"]*)"', svg)
    return [float(own) for own in found[1].split()] if found else []
