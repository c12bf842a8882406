"""What rules of a design's grammar draw in the 3D view by pythreejs: a mesh with a picture for each rule and size."""

from __future__ import annotations

from collections import defaultdict
from typing import NamedTuple

import numpy as np
import pythreejs as three
from numpy.typing import NDArray

from ...render import Scene
from ...render.baked import baked, drawable, face_places, face_size
from ...render.meshing import have_area

__all__ = ["Pictured", "Ruled", "close_geometry", "pictured_triangles"]

_MOST = 256
"""Pixels along a side of a picture, at most: it goes to the browser as it is, and stays on its graphics card."""

_Key = tuple[str, str, tuple[float, float]]
"""A grammar, a material, and the size of a face."""


class Pictured(NamedTuple):
    """Triangles that one picture is drawn on: corner by corner (t, 3, …), and (t,) the index of their shape."""

    positions: NDArray[np.float32]
    normals: NDArray[np.float32]
    places: NDArray[np.float32]
    shapes: NDArray[np.int64]


def pictured_triangles(scene: Scene) -> dict[_Key, Pictured]:
    """All triangles of a scene whose material is a rule that its grammar can draw, by what is drawn on them."""
    found: dict[_Key, list[Pictured]] = defaultdict(list)
    for solid in scene.solids:
        slots = {slot: name for slot, name in solid.materials.items() if drawable(scene.library, name)}
        if not slots:
            continue
        size, local, mesh = face_size(solid.rect), solid.body(), solid.mesh()
        corners, normals, places = mesh.vertices[mesh.faces], mesh.normals, face_places(local, size)
        for k, slot in enumerate(mesh.names):
            chosen = (mesh.slots == k) & have_area(corners)
            if slot in slots and chosen.any():
                shapes = np.full(int(chosen.sum()), solid.index)
                at, out, on = (values[chosen].astype(np.float32) for values in (corners, normals, places))
                found[scene.library, slots[slot], size].append(Pictured(at, out, on, shapes))
    return {
        key: Pictured(*(np.concatenate(same) for same in zip(*some, strict=True)))
        for key, some in found.items()
    }


class Ruled:
    """The meshes with pictures below another mesh, which is what is picked. Pictures that are drawn again are kept."""

    def __init__(self, parent: three.Mesh) -> None:
        self.parent = parent
        self.meshes: dict[three.Mesh, Pictured] = {}
        self._textures: dict[_Key, three.DataTexture] = {}

    def update(self, scene: Scene) -> None:
        """Show the rules of another scene."""
        wanted = pictured_triangles(scene)
        old, kept = list(self.meshes), self._textures
        self._textures = {key: kept.get(key) or _texture(key) for key in wanted}
        self.meshes = {_mesh(own, self._textures[key]): own for key, own in wanted.items()}
        if old or self.meshes:
            self.parent.children = tuple(self.meshes)
        for mesh in old:
            _close(mesh)
        for key, texture in kept.items():
            if key not in wanted:
                texture.close()

    def shapes(self, mesh: object) -> NDArray[np.int64] | None:
        """The shape of each triangle of a mesh; None for one that is not of these."""
        return next((own.shapes for known, own in self.meshes.items() if known is mesh), None)

    def tint(self, chosen: int | None, colour: NDArray[np.float32]) -> None:
        """Tint the triangles of a shape."""
        for mesh, own in self.meshes.items():
            colours = np.ones((3 * len(own.shapes), 3), np.float32)
            if chosen is not None:
                colours[np.repeat(own.shapes == chosen, 3)] = 0.35 + 0.65 * colour
            mesh.geometry.attributes["color"].array = colours

    def close(self) -> None:
        """Close all of them."""
        for mesh in self.meshes:
            _close(mesh)
        for texture in self._textures.values():
            texture.close()


def _texture(key: _Key) -> three.DataTexture:
    pixels = np.ascontiguousarray(baked(*key, most=_MOST)[::-1])  # its first row is the lowest
    return three.DataTexture(
        data=pixels,
        format="RGBFormat",
        wrapS="RepeatWrapping",
        wrapT="RepeatWrapping",
        magFilter="LinearFilter",
        minFilter="LinearMipMapLinearFilter",
        generateMipmaps=True,
        anisotropy=4,
    )


def _mesh(own: Pictured, texture: three.DataTexture) -> three.Mesh:
    content = {
        "position": own.positions.reshape(-1, 3),
        "normal": own.normals.reshape(-1, 3),
        "uv": own.places.reshape(-1, 2),
        "color": np.ones((3 * len(own.shapes), 3), np.float32),
    }
    attributes = {name: three.BufferAttribute(values, normalized=False) for name, values in content.items()}
    material = three.MeshStandardMaterial(
        map=texture, vertexColors="VertexColors", roughness=0.85, metalness=0.0
    )
    return three.Mesh(three.BufferGeometry(attributes=attributes), material)


def _close(mesh: three.Mesh) -> None:
    close_geometry(mesh.geometry)
    mesh.material.close()
    mesh.close()


def close_geometry(geometry: three.BufferGeometry) -> None:
    """Close a geometry and its arrays."""
    for attribute in geometry.attributes.values():
        attribute.close()
    geometry.close()
