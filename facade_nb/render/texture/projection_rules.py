"""The rules of shapes that stand out of a wall, lie back in it or stand on it: bays, loggias, gables, stairs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..geometry import find_geometry
from ..materials import find_material, rgb
from ..stonework import steps_of
from ..tiles import CATALOGUE

if TYPE_CHECKING:
    from ...solver.model.layout import PlacedShape
    from .shape_rules import Recipe, Walls

__all__ = ["PROJECTIONS"]


def _told(shape: PlacedShape) -> Mapping[str, Any]:
    return find_geometry(shape.geometry).told


def _fitted(tile: str, shape: PlacedShape) -> str:
    maps = ", ".join(f"Fit:{tile}.{kind}" for kind in CATALOGUE[tile].maps)
    return f"Fitted(Fit:{tile}, {maps}{', 1, 0' if shape.mirrored[0] else ''})"


def _panes(walls: Walls, shape: PlacedShape) -> str:
    return walls.rule("panes", f"Layer(Room, Curtain, Glass, {_fitted('frame-casement', shape)})")


def _beside(shape: PlacedShape, *parts: str) -> str:
    """Parts of a SplitX, from the left, or from the right where the letter is mirrored."""
    return f"SplitX({', '.join(parts[::-1] if shape.mirrored[0] else parts)})"


def _masked(walls: Walls, material: str, mask: str) -> str:
    """A material where a mask has it."""
    recipe = CATALOGUE.get(material)
    where = f"Fit:{mask}, 0, 0, 1, 1"
    if recipe is not None and recipe.tiling == "xy":
        at = f"0, 0, {1 / recipe.width:.4g}, {1 / recipe.height:.4g}"
        return f"MatAlpha(Color, Rep:{material}, {at}, {where})"
    red, green, blue = (f"{value / 255:.3g}" for value in rgb(find_material(material).fill))
    return f"MatAlpha(Color, 0, {red}, {green}, {blue}, 1, {where})"


def _quoin(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    told, stone = _told(shape), walls.wall(material)
    course = height / max(1, round(height / told.get("course", 0.33)))
    short = _beside(shape, f"Abs, {told.get('short', 0.62) * width:.4g}, {stone}", "Rel, 1, Open")
    pair = walls.rule("courses", f"SplitY(Rel, 1, {stone}, Rel, 1, {walls.rule('short_stone', short)})")
    return f"RepeatY({2 * course:.4g}, {pair})"


def _arched(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    return f"Layer(Room, Curtain, Glass, ArchRest, {_fitted('frame-arch', shape)})"


def _loggia(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    side, told = walls.wall(material), _told(shape)
    back = walls.rule(
        "loggia_back", f"SplitX(Rel, 1, {side}, Rel, 4, {_panes(walls, shape)}, Rel, 1, {side})"
    )
    depth = told.get("depth", 1.4)
    room = walls.rule("loggia_room", f"Intrusion({depth:.4g}, {side}, {back}, {side}, {side}, {side})")
    return _behind(walls, room, told.get("parapet", "rail"), side, height)


def _behind(walls: Walls, room: str, parapet: str, side: str, height: float) -> str:
    """A room behind a rail, a parapet or nothing."""
    fence = min(1.0, 0.38 * height)
    if parapet == "none":
        return f"Layer({room})"
    front = side if parapet == "wall" else "Rail"
    low = walls.rule("parapet", f"SplitY(Abs, {fence:.4g}, {front}, Rel, 1, Open)")
    return f"Layer({room}, {low})"


def _arcade(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    told, wall = _told(shape), walls.wall(material)
    count = told.get("bays") or max(1, min(40, round(width / max(0.62 * height, 0.4))))
    pier = told.get("pier", 0.2) / 2
    walk = walls.rule("walk", f"Intrusion({told.get('depth', 2.0):.4g}, {', '.join([wall] * 5)})")
    arch = walls.rule("arch", f"Layer({walk}, {wall}, ArchHole)")
    piers = f"SplitX(Rel, {pier:.4g}, {wall}, Rel, {1 - 2 * pier:.4g}, {arch}, Rel, {pier:.4g}, {wall})"
    bay = walls.rule("bay", f"SplitY(Rel, 0.86, {walls.rule('piers', piers)}, Rel, 0.14, {wall})")
    return f"RepeatX({width / count:.4g}, {bay})"


def _gable(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    return _masked(walls, material, "mask-gable")


def _pediment(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    mask = "mask-segment" if _told(shape).get("form") == "segment" else "mask-gable"
    field = walls.rule("tympanum", _masked(walls, material, mask))
    return f"SplitY(Rel, 1, {walls.wall(material)}, Rel, 4, {field})"


def _mansard(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    knee = _told(shape).get("knee", 0.68)
    return f"SplitY(Rel, {knee:.4g}, {walls.wall(material)}, Rel, {1 - knee:.4g}, {walls.wall('metal')})"


def _dormer(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    side = walls.wall(material)
    front = walls.rule(
        "dormer_front", f"SplitX(Rel, 1, {side}, Rel, 8, {_panes(walls, shape)}, Rel, 1, {side})"
    )
    form = _told(shape).get("roof", "gable")
    mask = {"gable": "mask-gable", "arch": "mask-segment"}.get(form, "mask-rect")
    roof = walls.rule("dormer_roof", _masked(walls, "metal", mask))
    rise = {"gable": min(0.42 * width, 0.36 * height), "arch": 0.24 * width}.get(form, 0.12 * height)
    return f"SplitY(Rel, 1, {front}, Abs, {rise:.4g}, {roof})"


def _bay(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    side, panes = walls.wall(material), _panes(walls, shape)
    count = _told(shape).get("storeys") or max(1, min(20, round(height / 3.2)))
    lights = walls.rule("bay_lights", f"SplitX(Rel, 1, {panes}, Rel, 2, {panes}, Rel, 1, {panes})")
    storey = f"Rel, 3, {side}, Rel, 6, {lights}, Rel, 1, {side}"
    body = walls.rule("bay_storeys", f"SplitY({', '.join([storey] * count)})")
    roof = min(0.65, 0.11 * height)
    return f"SplitY(Rel, 1, {body}, Abs, {roof:.4g}, {walls.wall('metal')})"


def _awning(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    stripe, cloth = _told(shape).get("stripe", 0.28), walls.wall(material)
    if stripe <= 0:
        return f"Layer({cloth})"
    count = max(3, min(99, 2 * round(width / stripe / 2) + 1))
    white = walls.wall("painted-wood")
    return f"SplitX({', '.join(f'Rel, 1, {white if k % 2 else cloth}' for k in range(count))})"


def _stair(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    count = _told(shape).get("risers") or steps_of(height)
    nosing = walls.rule("nosing", "Mat(Color, 0, 0.3, 0.29, 0.27, 1)")
    step = walls.rule("step", f"SplitY(Rel, 6, {walls.wall(material)}, Rel, 1, {nosing})")
    return f"RepeatY({height / count:.4g}, {step})"


def _statue(walls: Walls, shape: PlacedShape, material: str, width: float, height: float) -> str:
    figure = walls.rule("figure", f"Layer({_fitted('column', shape)})")
    return f"SplitX(Rel, 1, Open, Abs, {min(width, 0.3 * height):.4g}, {figure}, Rel, 1, Open)"


PROJECTIONS: Mapping[str, Recipe] = {
    "quoin": _quoin,
    "arched-window": _arched,
    "loggia": _loggia,
    "arcade": _arcade,
    "gable": _gable,
    "pediment": _pediment,
    "mansard": _mansard,
    "hipped": _gable,
    "dormer": _dormer,
    "bay": _bay,
    "awning": _awning,
    "stair": _stair,
    "statue": _statue,
}
"""How these geometries are drawn; a sign is a board of its material."""
