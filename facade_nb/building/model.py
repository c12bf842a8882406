"""The building: façades in plan, each with its design across, one height for all, corners and a roof.

docs/buildings.md tells what it means. The plan is a polygon seen from above: x runs east, y north, metres, corners
counter-clockwise. Wall k goes from corner k to the next one, and looks out to its right.
Wall 0 of the plans made here looks south, to whoever looks at a picture.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

from ..design.mimebundle import bundle_of
from ..design.model import Design

if TYPE_CHECKING:
    from pathlib import Path

    from ..solver.model.objective import Objective
    from .layout import BuildingLayout

__all__ = ["ROOFS", "TREATMENTS", "Building", "Corner", "Point", "Roof", "Walls"]

Point = tuple[float, float]
"""East and north, metres."""

Walls = Design | None | Sequence[Design | None] | Mapping[str, Design | None]
"""One design for all walls; or one for each, None for a blind one, in order or by the wall's name."""

Treatment = Literal["quoins", "chamfer"]
TREATMENTS: tuple[Treatment, ...] = ("quoins", "chamfer")

RoofKind = Literal["hip", "gable", "mansard", "flat"]
ROOFS: tuple[RoofKind, ...] = ("hip", "gable", "mansard", "flat")


@dataclass(frozen=True, slots=True)
class Corner:
    """What is done at a corner of the plan, by a design of its own.

    Attributes
    ----------
    kind
        ``quoins``: the design is folded around the corner, its left half on the wall before, its right half on the wall
        after. ``chamfer``: the corner is cut off, and the design is the façade of the cut.
    design
        Its name among the building's designs.
    width
        How wide it is, metres: along both walls together, or of the cut. None: as the design's canvas.
    """

    kind: Treatment
    design: str
    width: float | None = None


@dataclass(frozen=True, slots=True)
class Roof:
    """The roof over all.

    Attributes
    ----------
    kind
        ``hip``, ``gable``, ``mansard`` or ``flat``. Gables need a rectangle or an L, else the roof is hipped.
    rise
        How high it rises above the eaves, metres. None: what the designs leave above their walls, else by its kind.
    overhang
        How far it hangs over the walls, metres.
    """

    kind: RoofKind = "hip"
    rise: float | None = None
    overhang: float = 0.0
    material: str = "tiles"


@dataclass(frozen=True, slots=True)
class Building:
    """Several façades around one building.

    Attributes
    ----------
    height
        Of the canvas of every façade, metres.
    plan
        Corners, counter-clockwise.
    walls
        Per wall the name of its design; None: blind, as a party wall is. A design's own canvas does not count.
    designs
        By name.
    corners
        What is done at some corners, by their number.
    material
        Of blind walls.
    shared
        Symbols and counters along y that are one and the same in all designs. Others of the same name have nothing to
        do with each other.
    """

    name: str = "Untitled"
    height: float = 3.0
    plan: tuple[Point, ...] = ()
    walls: tuple[str | None, ...] = ()
    designs: Mapping[str, Design] = field(default_factory=dict)
    corners: Mapping[int, Corner] = field(default_factory=dict)
    roof: Roof = field(default_factory=Roof)
    material: str = "plaster"
    shared: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        from .checking import check

        check(self)

    @classmethod
    def rectangle(
        cls, width: float, depth: float, walls: Walls, *, height: float | None = None, **rest: Any
    ) -> Building:
        """A rectangle: walls ``front``, ``right``, ``back`` and ``left``.

        Parameters
        ----------
        width, depth
            Of the front and the back, and of the sides, metres.
        walls
            One design for all; or a list of four or a mapping by name, in which None, or nothing, is a blind wall.
        height
            Of all façades; None: the greatest canvas height of the designs.
        rest
            Other fields: `name`, `corners`, `roof`, `material`, `shared`. A corner may be given with its design itself,
            as ``("quoins", design)`` or ``("chamfer", design, width)``.
        """
        from .plans import built

        plan = ((0.0, 0.0), (width, 0.0), (width, depth), (0.0, depth))
        return built(cls, plan, ("front", "right", "back", "left"), walls, height, rest)

    @classmethod
    def ell(
        cls,
        width: float,
        depth: float,
        arms: float | tuple[float, float],
        walls: Walls,
        *,
        height: float | None = None,
        **rest: Any,
    ) -> Building:
        """An L around a yard behind it: walls ``front``, ``right``, ``yard``, ``wing``, ``back`` and ``left``.

        Parameters
        ----------
        width, depth
            Of the front and of the left side, metres.
        arms
            How deep the arm behind the front is, and how wide the wing along the left side; one number for both.
        """
        from .plans import built

        deep, wide = arms if isinstance(arms, tuple) else (arms, arms)
        plan = ((0.0, 0.0), (width, 0.0), (width, deep), (wide, deep), (wide, depth), (0.0, depth))
        names = ("front", "right", "yard", "wing", "back", "left")
        return built(cls, plan, names, walls, height, rest)

    @classmethod
    def row(
        cls,
        houses: Iterable[tuple[float, Design]],
        depth: float,
        *,
        back: Walls = None,
        height: float | None = None,
        **rest: Any,
    ) -> Building:
        """Houses side by side between two neighbours.

        Parameters
        ----------
        houses
            Width and design of each, from left to right. Their party walls and the two ends are blind.
        depth
            Metres.
        back
            One design for the backs of all, or one for each house from left to right; None: blind.
        """
        from .plans import row

        return row(cls, list(houses), depth, back, height, rest)

    def solve(
        self,
        *,
        objective: Objective | None = None,
        time_limit: float | None = 30.0,
        should_stop: Callable[[], bool] | None = None,
    ) -> BuildingLayout:
        """Solve it: heights together, then each wall across (see `solution.solve`)."""
        from .solution import solve

        return solve(self, objective=objective, time_limit=time_limit, should_stop=should_stop)

    @classmethod
    def from_dict(cls, document: Mapping[str, Any]) -> Building:
        """Read a building document (docs/buildings.md). Raises `DesignError` with every fault in it."""
        from .document import read

        return read(document)

    @classmethod
    def from_json(cls, source: str | Path) -> Building:
        """Read a building from JSON text or from a file's path. Raises `DesignError`, also for a missing file."""
        from .document import read_json

        return read_json(source)

    def to_dict(self) -> dict[str, Any]:
        """The building document; reading it gives an equal building."""
        from .document import write

        return write(self)

    def to_json(self, path: str | Path | None = None, *, indent: int | None = 2) -> str:
        """The document as JSON text; with `path` it is also written there, atomically."""
        from .document import write_json

        return write_json(self, path, indent=indent)

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        """In a notebook a building shows itself as the elevations of its walls, side by side."""
        return bundle_of(self)
