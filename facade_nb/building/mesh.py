"""The mesh of a solved building for other programs: GLB and OBJ, in space: x east, y up, z south, metres."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..render.apart import apart
from ..render.baked import drawable, face_places, face_size
from ..render.exchange.obj import Piece, files_of, obj_of
from ..render.mesh import EMPTY, finish, paint, pictured
from ..render.meshing import Mesh
from ..render.ruled import is_rule, material_of
from ..solver.model.layout import PlacedShape
from .bodies import Frame, bodies_of, deepest
from .layout import BuildingLayout
from .scene import over_all

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["Part", "obj_files", "parts_of", "to_glb", "to_obj"]


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """One thing of a building, in space.

    Attributes
    ----------
    name
        ``wall 1/layer/X Y``, ``wall 1/filling``, ``roof/roof``, ``body``.
    face
        The face that it stands on; empty: none.
    shape
        The shape that it is, where it is one, and its index among those of its face.
    library
        The texture grammar whose rules may be materials.
    size, places
        Of its face, metres, and the texture coordinates (m, 3, 2) of the picture of a rule over it, where one is drawn.
    """

    name: str
    face: str
    mesh: Mesh
    materials: Mapping[str, str]
    shape: PlacedShape | None = None
    index: int = -1
    library: str = ""
    size: tuple[float, float] | None = None
    places: NDArray[np.float64] | None = None


def parts_of(layout: BuildingLayout) -> Iterator[Part]:
    """All that a building is made of, face by face, then the roof and the body."""
    back = deepest(layout)
    for own in layout.faces:
        frame, name = Frame.of(own), own.face.name
        for body in bodies_of(layout, own, back):
            mesh = apart(replace(body.mesh, vertices=frame.place(body.mesh.vertices)))
            if body.solid is None:
                yield Part(f"{name}/filling", name, mesh, body.materials, library=body.library)
                continue
            shape, size, places = body.solid.shape, None, None
            if any(drawable(body.library, material) for material in body.materials.values()):
                corner = (*body.solid.rect[:2], body.solid.face)
                size = face_size(body.solid.rect)
                places = face_places(replace(body.mesh, vertices=body.mesh.vertices - corner), size)
            told = f"{name}/{shape.layer}/{shape.x} {shape.y}"
            yield Part(told, name, mesh, body.materials, shape, body.index, body.library, size, places)
    for name, mesh, material in over_all(layout, back):
        yield Part(name, "", mesh, {"body": material})


def to_glb(layout: BuildingLayout) -> bytes:
    """Return a building as GLB: a node for each part, whose extras tell which shape of which face it is."""
    import numpy as np
    import trimesh

    scene = trimesh.Scene()
    paints: dict[object, Any] = {}
    nodes: list[tuple[Part, list[str]]] = []
    for number, part in enumerate(parts_of(layout)):
        normals, places = part.mesh.normals, part.mesh.places
        names = []
        for k, slot in enumerate(part.mesh.names):
            chosen = part.mesh.slots == k
            count = int(chosen.sum())
            if not count:
                continue
            material = part.materials[slot]
            picture = part.places if drawable(part.library, material) else None
            size = part.size if picture is not None else None
            key = (material, part.library if is_rule(material) else "", size)
            if key not in paints:
                paints[key] = _paint(part, material, size)
            body = trimesh.Trimesh(
                vertices=part.mesh.vertices[part.mesh.faces[chosen]].reshape(-1, 3),
                faces=np.arange(3 * count).reshape(-1, 3),
                vertex_normals=normals[chosen].reshape(-1, 3),
                visual=trimesh.visual.TextureVisuals(
                    uv=(places if picture is None else picture)[chosen].reshape(-1, 2), material=paints[key]
                ),
                process=False,
            )
            names.append(f"{number}/{slot}")
            scene.add_geometry(body, node_name=names[-1], geom_name=names[-1])
        if names:
            nodes.append((part, names))
    if not nodes:
        return EMPTY

    def tidy(tree: dict[str, Any]) -> None:
        own = {node["name"]: node for node in tree["nodes"] if "mesh" in node}
        old, made = tree["meshes"], []
        meshes: list[dict[str, Any]] = []
        for part, names in nodes:
            primitives = [p for name in names for p in old[own[name]["mesh"]]["primitives"]]
            made.append({"name": part.name, "mesh": len(meshes), "extras": _told(part)})
            meshes.append({"name": part.name, "primitives": primitives})
        tree["nodes"], tree["meshes"] = made, meshes
        tree["scenes"] = [{"nodes": list(range(len(made)))}]
        finish(tree)

    return bytes(scene.export(file_type="glb", include_normals=True, tree_postprocessor=tidy))


def _paint(part: Part, material: str, size: tuple[float, float] | None) -> Any:
    if size is not None:
        return pictured(part.library, material, size)
    return paint(material_of(part.library, material).fill if is_rule(material) else material)


def _told(part: Part) -> dict[str, Any]:
    if part.shape is None:
        return {"face": part.face}
    left, bottom, right, top = part.shape.rect
    return {
        "face": part.face,
        "index": part.index,
        "layer": part.shape.layer,
        "x": part.shape.x,
        "y": part.shape.y,
        "number": list(part.shape.number),
        "kind": part.shape.kind,
        "size": [right - left, top - bottom],
    }


def to_obj(layout: BuildingLayout, materials: str = "") -> tuple[str, str]:
    """Return a building as OBJ and MTL: each part is a group within an object of its own."""
    return obj_of((_piece(part) for part in parts_of(layout)), materials)[:2]


def obj_files(layout: BuildingLayout, path: str | Path | None) -> dict[Path, str | bytes]:
    """The OBJ, its MTL and the pictures of its rules, by the paths of the files; nothing is written."""
    return files_of((_piece(part) for part in parts_of(layout)), path)


def _piece(part: Part) -> Piece:
    shape, name = part.shape, part.name
    if shape is not None:
        x, y = shape.number
        name = f"{part.face}/{shape.layer}/{shape.x}[{x}] {shape.y}[{y}]"
    return Piece(name, part.name, part.mesh, part.materials, part.size, part.places, part.library)
