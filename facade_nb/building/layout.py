"""A solved building: the layout of each of its faces, and the heights that they have in common."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..design.files import write_atomically, write_together
from ..design.mimebundle import bundle_of
from ..solver.model.layout import AxisLayout, Layout
from .faces import Face
from .model import Building

if TYPE_CHECKING:
    from ..render.camera import Camera
    from ..render.exchange.chains import Units
    from ..render.pipeline.solids import Solids
    from .roofs import Roofing

__all__ = ["BuildingLayout", "SolvedFace"]

FORMAT = "facade-nb/building-layout/1"


@dataclass(frozen=True, slots=True)
class SolvedFace:
    """A face with its layout.

    Attributes
    ----------
    face
        Where it stands.
    layout
        As the design is solved, its own roof and the parts of quoins included; of a blind wall, one plain wall.
    shown
        What is built of it: without its own roof, and up to the eaves.
    """

    face: Face
    layout: Layout
    shown: Layout = field(repr=False)


@dataclass(frozen=True, repr=False)
class BuildingLayout:
    """A solved building.

    Attributes
    ----------
    faces
        As one walks around it, from wall 1 on.
    heights
        The answer along y for all designs together, under names such as ``V of street``.
    counters
        Per face, the counters of its layout.
    eaves
        Where the roof begins, metres.
    warnings
        What there is to say, each beginning with the face or ``heights``.
    complete
        False if a limit cut the search short, on some wall or for the heights.
    strips
        The layouts of quoins before they are folded, by design.
    """

    building: Building
    faces: tuple[SolvedFace, ...]
    heights: AxisLayout
    eaves: float
    warnings: tuple[str, ...] = ()
    complete: bool = True
    strips: Mapping[str, Layout] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """The building's."""
        return self.building.name

    @property
    def counters(self) -> Mapping[str, Mapping[str, int]]:
        """Per face, by its name."""
        return {own.face.name: own.layout.counters for own in self.faces}

    @property
    def proven(self) -> bool:
        """Whether the heights and every wall are proven to be the best."""
        return self.heights.proven and all(own.layout.x.proven for own in self.faces)

    def face(self, name: str) -> SolvedFace:
        """The face of that name. Raises `KeyError`, with all names, where there is none."""
        for own in self.faces:
            if own.face.name == name:
                return own
        raise KeyError(f"expected one of {', '.join(own.face.name for own in self.faces)}; found {name!r}")

    def explain(self) -> str:
        """What was solved, in a few lines: the heights, then each face."""
        from .telling import explain

        return explain(self)

    @cached_property
    def developed(self) -> Layout:
        """All faces side by side, as one layout: what is drawn as an elevation."""
        from .developed import developed

        return developed(self)

    @cached_property
    def roofing(self) -> Roofing:
        """The roof over all, as triangles."""
        from .roofs import roofing

        return roofing(self)

    def solids(self, *, ground: bool = True) -> Solids:
        """The scene that pictures are drawn of: x east, y up, z south."""
        from .scene import solids_of_building

        return solids_of_building(self, ground=ground)

    def elevation_svg(self) -> str:
        """The elevations of all faces, side by side."""
        from ..render import elevation_svg

        return elevation_svg(self.developed)

    def render_png(
        self,
        path: str | Path | None = None,
        *,
        size: tuple[int, int] = (1600, 1000),
        camera: Camera | None = None,
        time_of_day: str = "morning",
        background: str = "sky",
        backend: str | None = None,
        samples: int = 2,
        rays: int = 64,
    ) -> bytes:
        """Return a picture, and write it to a path (see `facade_nb.render.render_png`)."""
        from ..render.picture import png_of, scene_picture

        solids = self.solids()
        pixels = scene_picture(
            solids,
            solids.corners,
            size,
            camera,
            time_of_day=time_of_day,
            background=background,
            backend=backend,
            samples=samples,
            rays=rays,
        )
        return png_of(pixels, path)

    def to_glb(self) -> bytes:
        """Binary glTF: a node for each shape, named ``wall 1/layer/X Y``, one for the roof and one for the body."""
        from .mesh import to_glb

        return to_glb(self)

    def write_glb(self, path: str | Path) -> Path:
        """Write it as GLB, atomically, and return the path."""
        write_atomically(path, self.to_glb())
        return Path(path)

    def to_obj(self, materials: str = "") -> tuple[str, str]:
        """OBJ and its MTL (see `facade_nb.render.to_obj`); groups are named ``wall 1/layer/X Y``."""
        from .mesh import to_obj

        return to_obj(self, materials)

    def obj_files(self, path: str | Path | None) -> dict[Path, str | bytes]:
        """What is written as OBJ, by the paths of the files (see `facade_nb.render.obj_files`)."""
        from .mesh import obj_files

        return obj_files(self, path)

    def write_obj(self, path: str | Path) -> Path:
        """Write it as OBJ, its MTL and pictures of rules beside it, all or none; return the path of the OBJ."""
        write_together(list(self.obj_files(path).items()))
        return Path(path)

    def to_cityjson(self) -> str:
        """CityJSON 2.0: one ``Building`` with all walls, their openings, the roof and the ground."""
        from .cityjson import to_cityjson

        return to_cityjson(self)

    def write_cityjson(self, path: str | Path) -> Path:
        """Write it as CityJSON, atomically, and return the path."""
        write_atomically(path, self.to_cityjson())
        return Path(path)

    def to_dxf(self, *, units: Units = "m") -> str:
        """The elevations of all faces side by side, as DXF (see `facade_nb.render.to_dxf`)."""
        from ..render import to_dxf

        return to_dxf(self.developed, units=units)

    def to_pdf(self, *, units: Units = "m") -> bytes:
        """The elevations of all faces, each with its name, as PDF (see `facade_nb.render.to_pdf`).

        They stand side by side, on one sheet if they fit there at 1:100, else on several.
        """
        from .sheets import to_pdf

        return to_pdf(self, units)

    def to_schedule(self) -> str:
        """What all walls are made of, as CSV (see `facade_nb.render.to_schedule`)."""
        from ..render import to_schedule

        return to_schedule(self.developed)

    def to_dict(self) -> dict[str, Any]:
        """The document of the solved building: the building's, and per face its place and its layout's."""
        return {
            "format": FORMAT,
            "building": self.building.to_dict(),
            "eaves": self.eaves,
            "faces": [
                {
                    "name": own.face.name,
                    "design": own.face.design,
                    "start": list(own.face.start),
                    "end": list(own.face.end),
                    "layout": own.layout.to_dict(),
                }
                for own in self.faces
            ],
            "warnings": list(self.warnings),
            "complete": self.complete,
        }

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        """In a notebook it shows itself as its elevations."""
        return bundle_of(self)

    def __repr__(self) -> str:
        state = "" if self.complete else ", not complete"
        shapes = sum(len(own.layout.shapes) for own in self.faces)
        return f"<BuildingLayout {self.name!r}: {len(self.faces)} faces, {shapes} shapes{state}>"
