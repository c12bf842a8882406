"""The mesh for other programs: a trimesh scene, and GLB (binary glTF 2.0)."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..design.files import write_atomically
from ..solver.model.layout import Layout
from .apart import apart
from .baked import baked, drawable, face_places, face_size
from .materials import find_material, rgb
from .meshing import Mesh
from .scene import Scene, Solid, build_scene

if TYPE_CHECKING:
    import trimesh
    from trimesh.visual.material import PBRMaterial

__all__ = ["EMPTY", "finish", "node_name", "paint", "pictured", "to_glb", "to_trimesh", "write_glb"]

_ARRAY_BUFFER, _ELEMENT_ARRAY_BUFFER = 34962, 34963  # what a view of the buffer is for, in glTF's numbers

_NOTHING = b'{"asset":{"version":"2.0"},"scene":0,"scenes":[{}]} '
EMPTY = struct.pack("<4sIIII", b"glTF", 2, 20 + len(_NOTHING), len(_NOTHING), 0x4E4F534A) + _NOTHING
"""A GLB file without anything in it, which trimesh does not write: header, then one chunk of JSON."""


def to_trimesh(scene: Scene) -> trimesh.Scene:
    """A trimesh scene: a node for every shape and material slot, named ``layer/index X Y/slot``.

    Shapes that look the same share their geometry. Metres, y up, z towards the viewer, as glTF wants it; texture
    coordinates are metres too. Only what a rule of the design's grammar draws has those of its picture, 0 to 1.
    """
    import trimesh

    result = trimesh.Scene()
    paints: dict[object, PBRMaterial] = {}
    made: dict[tuple[object, ...], str] = {}
    alike: dict[tuple[object, ...], Mesh] = {}
    for solid in scene.solids:
        local = alike.get((solid.parts, solid.cuts))
        if local is None:
            local = alike[solid.parts, solid.cuts] = apart(solid.body())
        normals, places = local.normals, local.places
        place = np.eye(4)
        place[:3, 3] = (solid.rect[0], solid.rect[1], solid.face)
        for k, slot in enumerate(local.names):
            chosen = local.slots == k
            count = int(chosen.sum())
            if not count:  # too small to be told from nothing
                continue
            name = solid.materials[slot]
            drawn = drawable(scene.library, name)
            size = face_size(solid.rect) if drawn else (1.0, 1.0)
            key = (solid.parts, solid.cuts, slot, name, size)
            if key not in made:
                if (name, size) not in paints:
                    paints[name, size] = pictured(scene.library, name, size) if drawn else paint(name)
                body = trimesh.Trimesh(
                    vertices=local.vertices[local.faces[chosen]].reshape(-1, 3),
                    faces=np.arange(3 * count).reshape(-1, 3),
                    vertex_normals=normals[chosen].reshape(-1, 3),
                    visual=trimesh.visual.TextureVisuals(
                        uv=(face_places(local, size) if drawn else places)[chosen].reshape(-1, 2),
                        material=paints[name, size],
                    ),
                    process=False,
                )
                made[key] = f"{solid.shape.geometry} {slot} {name} {len(made)}"
                result.geometry[made[key]] = body
            result.graph.update(frame_to=node_name(solid, slot), matrix=place, geometry=made[key])
    return result


def node_name(solid: Solid, slot: str) -> str:
    """The name of a shape's node in the mesh."""
    shape = solid.shape
    return f"{shape.layer}/{solid.index} {shape.x} {shape.y}/{slot}"


def to_glb(layout: Layout) -> bytes:
    """Return a layout as GLB: a node for each shape that has a body, named ``layer/X Y``; alike shapes share a mesh.

    The extras of a node tell which shape it is: its `index` in the layout, its layer, symbols, numbers, kind and size.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material.
    """
    solids = build_scene(layout)
    scene = to_trimesh(solids)
    if not scene.geometry:
        return EMPTY

    def tidy(tree: dict[str, Any]) -> None:
        _one_node_a_shape(tree, solids)
        finish(tree)

    return scene.export(file_type="glb", include_normals=True, tree_postprocessor=tidy)


def write_glb(layout: Layout, path: str | Path) -> Path:
    """Write a layout as GLB, atomically, and return the path.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material, or a file that cannot be written.
    """
    write_atomically(path, to_glb(layout))
    return Path(path)


def _one_node_a_shape(tree: dict[str, Any], scene: Scene) -> None:
    """Make one node of the nodes of a shape's slots, and one mesh of their meshes, shared by shapes that have the same.

    trimesh has one material a mesh; in glTF each primitive of a mesh has its own.
    """
    own = {node["name"]: node for node in tree["nodes"]}
    old, nodes = tree["meshes"], []
    made: dict[tuple[int, ...], int] = {}
    meshes: list[dict[str, Any]] = []
    for solid in scene.solids:
        names = [node_name(solid, slot) for slot in dict.fromkeys(part.slot for part in solid.parts)]
        found = [own[name] for name in names if name in own]
        if not found:  # too small to be told from nothing
            continue
        key = tuple(node["mesh"] for node in found)
        if key not in made:
            made[key] = len(meshes)
            primitives = [primitive for k in key for primitive in old[k]["primitives"]]
            meshes.append({"name": f"{solid.shape.geometry} {len(meshes)}", "primitives": primitives})
        shape = solid.shape
        left, bottom, right, top = shape.rect
        nodes.append(
            {
                "name": f"{shape.layer}/{shape.x} {shape.y}",
                "mesh": made[key],
                "translation": [left, bottom, solid.face],
                "extras": {
                    "index": solid.index,
                    "layer": shape.layer,
                    "x": shape.x,
                    "y": shape.y,
                    "number": list(shape.number),
                    "kind": shape.kind,
                    "size": [right - left, top - bottom],
                },
            }
        )
    tree["nodes"], tree["meshes"] = nodes, meshes
    tree["scenes"] = [{"nodes": list(range(len(nodes)))}]


def finish(tree: dict[str, Any]) -> None:
    """Say what each view of the buffer is for, which trimesh leaves open."""
    for mesh in tree["meshes"]:
        for primitive in mesh["primitives"]:
            for accessor in primitive["attributes"].values():
                _view(tree, accessor)["target"] = _ARRAY_BUFFER
            _view(tree, primitive["indices"])["target"] = _ELEMENT_ARRAY_BUFFER


def _view(tree: dict[str, Any], accessor: int) -> dict[str, Any]:
    return tree["bufferViews"][tree["accessors"][accessor]["bufferView"]]


def pictured(library: str, name: str, size: tuple[float, float]) -> PBRMaterial:
    """The picture of a rule over a face of that size, which its texture coordinates fill from 0 to 1."""
    from PIL import Image
    from trimesh.visual.material import PBRMaterial

    return PBRMaterial(
        name=name,
        baseColorTexture=Image.fromarray(baked(library, name, size)),
        baseColorFactor=[1.0] * 4,
        roughnessFactor=0.9,
        metallicFactor=0.0,
    )


def paint(name: str) -> PBRMaterial:
    """A material as glTF has it."""
    from trimesh.visual.material import PBRMaterial

    material = find_material(name)
    colour = (np.array(rgb(material.base)) / 255.0) ** 2.2  # glTF factors are linear
    return PBRMaterial(
        name=name,
        baseColorFactor=[*colour, 1.0],
        roughnessFactor=material.roughness,
        metallicFactor=material.metallic,
    )
