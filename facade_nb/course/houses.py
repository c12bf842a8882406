"""The tiny house of the tutorials: a wall with windows, and posts in front of it."""

from __future__ import annotations

from collections.abc import Mapping

from ..design import Design

__all__ = ["house"]


def house(
    walls: str = "A(BA)^k",
    front: str = "cec; c := C",
    width: float = 6.6,
    opaque_posts: bool = True,
    most: Mapping[str, float] | None = None,
) -> Design:
    """One storey, ``width`` metres wide.

    Parameters
    ----------
    walls
        Pattern of the wall: A is 0.9 m of it, B a window of 1.2 m.
    front
        Pattern of what stands in front: C is a post of 0.6 m, e what lies between.
    opaque_posts
        Whether posts hide all that is behind them.
    most
        The greatest size of some symbols, metres.
    """
    storey = {"pattern": "storey"}
    limits = {name: {"max": size} for name, size in (most or {}).items()}
    return Design.from_dict(
        {
            "format": "facade-nb/design/1",
            "name": "Tiny house",
            "canvas": {"width": width, "height": 2.8},
            "symbols": {
                "A": {"size": 0.9, **limits.get("A", {})},
                "B": {"size": 1.2, "unoccludable": True, **limits.get("B", {})},
                "C": {"size": 0.6, "opaque": opaque_posts, **limits.get("C", {})},
                "Y": {"size": 2.8},
            },
            "patterns": {"walls": walls, "front": front, "storey": "Y"},
            "layers": [
                {"name": "walls", "x": {"pattern": "walls"}, "y": storey},
                {"name": "front", "x": {"pattern": "front"}, "y": storey, "depth": 1},
            ],
            "shapes": {
                "A Y": {"material": "brick-yellow"},
                "C Y": {"material": "stone"},
                "B Y": {"kind": "window", "geometry": "window", "material": "painted-wood"},
            },
        }
    )
