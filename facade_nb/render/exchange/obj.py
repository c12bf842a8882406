"""OBJ with its materials (MTL): one object and one group for each shape, metres, y up, z towards the viewer.

A material that is a rule of the design's grammar has a picture beside the MTL, one for each size of face.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ...design.files import write_together
from ...design.targets import locate
from ...solver.model.layout import Layout
from ..baked import baked_png, drawable, face_places, face_size
from ..materials import rgb
from ..ruled import is_rule, library_of, material_of
from ..scene import Solid, build_scene
from .beside import HEAD, Beside

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..meshing import Mesh

__all__ = ["Piece", "files_of", "materials_beside", "obj_files", "obj_of", "to_obj", "write_obj"]


class Piece(NamedTuple):
    """A mesh to be written, with the names of its object and its group, and the materials of its slots.

    Where rules are drawn on it, `size` is that of its face, `places` (m, 3, 2) are the texture coordinates of the
    picture over it, and `library` is the grammar.
    """

    name: str
    group: str
    mesh: Mesh
    materials: Mapping[str, str]
    size: tuple[float, float] | None = None
    places: NDArray[np.float64] | None = None
    library: str = ""


class _Paint(NamedTuple):
    """A material of the MTL: its name in the design, and for a picture the size of its face and the grammar."""

    material: str
    size: tuple[float, float] | None
    library: str

    def word(self, taken: Iterable[str]) -> str:
        """What the MTL calls it: none of the names that are taken."""
        told = f"{self.material} {self.size[0]:g}x{self.size[1]:g}" if self.size else self.material
        names = (_word(told), *(f"{_word(told)}~{k}" for k in range(2, 10_000)))
        return next(name for name in names if name not in taken)


def to_obj(layout: Layout, materials: str = "") -> tuple[str, str]:
    """Return a layout as OBJ, and its materials as MTL.

    Each shape is a group ``layer/X Y`` within an object of its own, ``layer/X[2] Y[1]``. Normals are given; faces are
    triangles.

    Parameters
    ----------
    layout
        What to write.
    materials
        The name by which the OBJ calls for its MTL; empty: it calls for none.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material.
    """
    return obj_of(map(_piece, build_scene(layout).solids), materials, library_of(layout))[:2]


def obj_of(
    pieces: Iterable[Piece],
    materials: str = "",
    library: str = "",
    pictures: Callable[[int], str] | None = None,
) -> tuple[str, str, dict[str, bytes]]:
    """Meshes as OBJ, their materials as MTL (see `to_obj`), and the pictures of rules by the names of their files.

    Parameters
    ----------
    library
        The grammar of materials that are rules, where a piece has none of its own.
    pictures
        The name of each picture's file, by its number; None: rules have their mean colours.
    """
    head = ["# facade_nb; metres, y up"]
    if materials:
        head.append(f"mtllib {materials}")
    paints: dict[_Paint, str] = {}
    body = list(_bodies(pieces, paints, library, pictured=pictures is not None))
    files = {own: pictures(k) for k, own in enumerate((own for own in paints if own.size), 1) if pictures}
    content = {
        file: baked_png(own.library, own.material, own.size or (1.0, 1.0)) for own, file in files.items()
    }
    return "\n".join([*head, *body]) + "\n", "\n".join(_written(paints, files)) + "\n", content


def obj_files(layout: Layout, path: str | Path | None) -> dict[Path, str | bytes]:
    """What a layout is as OBJ, by the paths of the files: the OBJ, its MTL, and the pictures of its rules.

    They are `house.obj`, `house.mtl`, `house-rule-1.png` and so on. Where a file of somebody else's has such a name, it
    is `house~2.mtl` (see `Beside`). Nothing is written. Into a stream (a path that is one, or None) goes the OBJ alone.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material, or an OBJ that has no place.
    """
    return files_of([_piece(solid, library_of(layout)) for solid in build_scene(layout).solids], path)


def files_of(pieces: Iterable[Piece], path: str | Path | None) -> dict[Path, str | bytes]:
    """The same of meshes."""
    materials = materials_beside(path) if path is not None else None
    if path is None or materials is None:
        return {Path("-" if path is None else path): obj_of(pieces)[0]}
    beside = Beside(materials, _blankless(Path(path).stem))
    text, told, pictures = obj_of(pieces, beside.materials.name, pictures=beside.picture)
    return {
        Path(path): text,
        beside.materials: told,
        **{beside.materials.with_name(name): data for name, data in pictures.items()},
    }


def materials_beside(path: str | Path) -> Path | None:
    """Where the MTL of an OBJ is written: beside it. None where it is written into a stream.

    Raises
    ------
    DesignError
        If the OBJ has no place.
    """
    if locate(path).is_stream:
        return None
    file = Path(path)
    return (
        file.with_name(f"{file.stem}.mtl") if file.suffix.lower() != ".mtl" else file.with_suffix(".mtl.mtl")
    )


def write_obj(layout: Layout, path: str | Path) -> Path:
    """Write a layout as OBJ, its MTL and the pictures of its rules beside it, all or none; return the path of the OBJ.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material, or a file that cannot be written.
    """
    write_together(list(obj_files(layout, path).items()))
    return Path(path)


def _piece(solid: Solid, library: str = "") -> Piece:
    from ..apart import apart

    shape = solid.shape
    x, y = shape.number
    name = f"{shape.layer}/{shape.x}[{x}] {shape.y}[{y}]"
    own = Piece(
        name, f"{shape.layer}/{shape.x} {shape.y}", apart(solid.mesh()), solid.materials, library=library
    )
    if not any(drawable(library, material) for material in solid.materials.values()):
        return own
    size = face_size(solid.rect)
    return own._replace(size=size, places=face_places(solid.body(), size))


def _bodies(
    pieces: Iterable[Piece], paints: dict[_Paint, str], library: str, *, pictured: bool
) -> Iterator[str]:
    import numpy as np

    points = directions = places = 0
    for piece in pieces:
        mesh = piece.mesh
        yield f"o {_line(piece.name)}"
        yield f"g {_line(piece.group)}"
        if not len(mesh.faces):  # wholly covered, or too small to be told from nothing
            continue
        vertices, corner = np.unique(mesh.vertices.round(6), axis=0, return_inverse=True)
        normals, turn = np.unique(mesh.normals.reshape(-1, 3).round(4), axis=0, return_inverse=True)
        own = piece.library or library
        coats: dict[int, _Paint] = {}
        coordinates = mesh.places
        for slot, name in enumerate(mesh.names):
            material = piece.materials[name]
            coats[slot] = _Paint(material, None, own if is_rule(material) else "")
            if pictured and piece.places is not None and drawable(own, material):
                coats[slot] = _Paint(material, piece.size, own)
                coordinates = np.where((mesh.slots == slot)[:, None, None], piece.places, coordinates)
        spots, spot = np.unique(coordinates.reshape(-1, 2).round(5), axis=0, return_inverse=True)
        faces = corner.reshape(-1)[mesh.faces] + points + 1
        turns = turn.reshape(-1, 3) + directions + 1
        textures = spot.reshape(-1, 3) + places + 1
        yield from (f"v {a:.10g} {b:.10g} {c:.10g}" for a, b, c in vertices + 0.0)
        yield from (f"vt {u:.10g} {v:.10g}" for u, v in spots + 0.0)
        yield from (f"vn {a:.4g} {b:.4g} {c:.4g}" for a, b, c in normals + 0.0)
        for slot, coat in coats.items():
            chosen = mesh.slots == slot
            if not chosen.any():
                continue
            if coat not in paints:
                paints[coat] = coat.word(paints.values())
            yield f"usemtl {paints[coat]}"
            for corners in zip(faces[chosen], textures[chosen], turns[chosen], strict=True):
                yield "f " + " ".join(f"{v}/{t}/{n}" for v, t, n in zip(*corners, strict=True))
        points += len(vertices)
        directions += len(normals)
        places += len(spots)


def _written(paints: Mapping[_Paint, str], files: Mapping[_Paint, str]) -> Iterator[str]:
    yield HEAD
    for own, word in paints.items():
        material = material_of(own.library, own.material)
        red, green, blue = (value / 255 for value in rgb(material.base))
        shine = 2 / max(material.roughness, 0.05) ** 4 - 2  # the exponent that is as rough
        gloss = 0.04 + 0.5 * material.metallic
        if own in files:
            red = green = blue = 1.0  # the picture is multiplied by it
        yield f"newmtl {word}"
        yield f"Kd {red:.4f} {green:.4f} {blue:.4f}"
        yield f"Ks {gloss:.4f} {gloss:.4f} {gloss:.4f}"
        yield f"Ns {min(max(shine, 0.0), 1000.0):.4f}"
        yield f"Pr {material.roughness:.4f}"
        yield f"Pm {material.metallic:.4f}"
        yield "illum 2"
        if own in files:
            yield f"map_Kd {files[own]}"


def _line(text: str) -> str:
    """A name of one line."""
    return " ".join(text.split()) or "-"


def _word(text: str) -> str:
    """A name without blanks, and without what begins a comment: ``#c8b9a0`` is ``paint-c8b9a0``."""
    return _blankless(text).replace("#", "paint-") or "-"


def _blankless(text: str) -> str:
    return "_".join(text.split())
