"""A town: its plan, its mesh and its grammar, without drawing."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...design.errors import DesignError, Fault
from ..pipeline.passes import image_bytes
from ..pipeline.scene import Scene
from ..pipeline.viewpoint import Viewpoint
from ..texture import Grammar
from .generated import generate_plan
from .mesh import Mesh, Mesher, build_mesh
from .plan import KINDS, ROOFS, Plan
from .real import real_houses
from .rings import areas
from .stages import Stages
from .styles import STYLES, Style, town_grammar
from .surroundings import surrounded
from .viewpoints import View, viewpoint
from .workers import Workers

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["MOST", "Town"]

MOST = 100_000
"""A generated town has no more buildings."""

PIXELS = (1024, 768)
"""Of the picture whose images `Town.stats` counts."""


@dataclass(frozen=True, eq=False)
class Town:
    """A town in triangles whose façades are drawn by one grammar.

    Attributes
    ----------
    plan
        Footprints, heights, roofs, styles.
    mesh
        Vertices, indices and chunks.
    grammar
        Of all styles.
    styles
        What `plan.style` counts.
    """

    plan: Plan
    mesh: Mesh
    grammar: Grammar
    styles: tuple[Style, ...] = field(default=STYLES)

    @classmethod
    def generate(
        cls,
        buildings: int = 20_000,
        seed: int = 1,
        *,
        progress: Callable[[float, str], None] | None = None,
        should_stop: Callable[[], bool] | None = None,
    ) -> Town:
        """A town from a seed: the same seed gives the same town, byte for byte, on every processor.

        Parameters
        ----------
        buildings
            How many, exactly; up to 100,000.
        seed
            A whole number.
        progress
            Called with the part that is done, from 0 to 1, and with what comes next.
        should_stop
            Asked between stages: True ends it.

        Raises
        ------
        DesignError
            For numbers out of range.
        TownStopped
            If `should_stop` said so.
        """
        count, number = _whole(buildings, "buildings", 1, MOST), _whole(seed, "seed", 0, 2**31 - 1)
        stages = Stages(progress, should_stop)
        with Workers() as workers:
            grammar = workers.begin(_ready)
            plan = generate_plan(count, number, STYLES, stages)
            stages.at(0.75, "mesh")
            mesh = build_mesh(plan, STYLES, grammar())
            stages.done()
            return cls(plan, mesh, grammar())

    @classmethod
    def from_geojson(
        cls,
        source: Mapping[str, Any] | str | Path,
        seed: int = 1,
        *,
        progress: Callable[[float, str], None] | None = None,
        should_stop: Callable[[], bool] | None = None,
    ) -> Town:
        """A town from real footprints, which are used as they are. What they do not tell is chosen by the seed.

        Parameters
        ----------
        source
            GeoJSON as a dict, or the path of a file (``.geojson``, ``.json``, also ``.gz``), in longitude and latitude.
        seed, progress, should_stop
            As of `generate`.

        Raises
        ------
        DesignError
            If it cannot be read or is no GeoJSON, or if no footprint in it can be used. `left_out` counts those that
            cannot, where others can.
        TownStopped
            If `should_stop` said so.
        """
        number, stages = _whole(seed, "seed", 0, 2**31 - 1), Stages(progress, should_stop)
        with Workers() as workers:
            grammar = workers.begin(_ready)
            found = real_houses(source, number, STYLES, stages, workers)
            # Houses and ground become triangles as soon as they are there.
            parts = [workers.begin(lambda: Mesher(STYLES, grammar()).houses(found.plan))]
            plan = surrounded(
                found, number, stages, workers,
                lambda laid: parts.append(workers.begin(lambda: parts[0]().ground(laid.ground))),
            )  # fmt: skip
            stages.at(0.75, "mesh")
            mesh = parts[1]().rest(plan)
            stages.done()
            return cls(plan, mesh, grammar())

    @property
    def left_out(self) -> Mapping[str, int]:
        """Why footprints were left out, and how many."""
        return self.plan.left_out

    @cached_property
    def scene(self) -> Scene:
        """What the pipeline draws."""
        return Scene(self.mesh.vertices, self.mesh.indices, self.grammar, self.mesh.chunks)

    def viewpoint(self, view: View) -> Viewpoint:
        """Where one stands for a view: ``distance``, ``street``, ``close-up`` (`viewpoints.viewpoint`)."""
        return viewpoint(self.plan, view)

    @property
    def vertices(self) -> np.ndarray:
        """(v,) `VERTEX`."""
        return self.mesh.vertices

    @property
    def indices(self) -> NDArray[np.uint32]:
        """(3 t,) corners of triangles, counter-clockwise from outside."""
        return self.mesh.indices

    @property
    def chunks(self) -> np.ndarray:
        """Parts of the mesh that lie together: first index, count, bounding box."""
        return self.mesh.chunks

    @property
    def building_of(self) -> NDArray[np.uint32]:
        """(t,) the building of each triangle; `NOBODY`: ground."""
        return self.mesh.building_of

    def stats(self) -> dict[str, Any]:
        """How much there is of what, and how many bytes the graphics card holds, with a picture of `PIXELS`."""
        mesh, encoding = self.mesh, self.grammar.encoding
        sizes = {**self.scene.bytes, "images": image_bytes(PIXELS)}
        total = sizes.pop("total") + sizes["images"]
        return {
            "buildings": len(self.plan),
            "facades": mesh.facades,
            "vertices": len(mesh.vertices),
            "grammars": len(self.styles),
            "rules": len(encoding.positions),
            "bytes": {**sizes, "total": total},
        }

    @cached_property
    def buildings(self) -> pd.DataFrame:
        """One row a building: area, height, storeys, style, seed, the middle of its box, and more."""
        import pandas as pd

        plan = self.plan
        sums = np.zeros(len(plan))
        np.add.at(sums, plan.ring_of, areas(plan.corners, plan.rings))
        building = plan.building
        begin = np.flatnonzero(np.append(True, building[1:] != building[:-1]))
        low = np.minimum.reduceat(plan.corners, begin, axis=0)
        high = np.maximum.reduceat(plan.corners, begin, axis=0)
        middle = (low + high) / 2
        names = np.array([one.name for one in self.styles])
        return pd.DataFrame(
            {
                "area": np.round(sums, 2),
                "height": np.round(plan.eaves + plan.rise, 3),
                "eaves": plan.eaves,
                "storeys": plan.storeys,
                "style": names[plan.style],
                "roof": np.array(ROOFS)[plan.roof],
                "kind": np.array(KINDS)[plan.kind],
                "shop": plan.shop,
                "seed": [(float(x) / 64, float(y) / 64) for x, y in plan.seed],
                "x": np.round(middle[:, 0], 3),
                "z": np.round(0.0 - middle[:, 1], 3),
            },
            index=pd.RangeIndex(len(plan), name="building"),
        )


def _ready() -> Grammar:
    """The town's grammar with what whoever draws it asks first: that takes as long as to read it."""
    return town_grammar().ready()


def _whole(value: object, name: str, least: int, most: int) -> int:
    try:
        number = int(value)  # type: ignore[call-overload]
        exact = number == value and not isinstance(value, bool)
    except (TypeError, ValueError, OverflowError):
        number, exact = 0, False
    if not exact or not least <= number <= most:
        raise DesignError(Fault(name, f"expected a whole number from {least:,} to {most:,}; found {value!r}"))
    return number
