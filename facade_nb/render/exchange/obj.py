"""OBJ with its materials (MTL): one object and one group for each shape, metres, y up, z towards the viewer."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ...design.files import write_together
from ...design.targets import locate
from ...solver.model.layout import Layout
from ..materials import rgb
from ..ruled import library_of, material_of
from ..scene import Solid, build_scene

if TYPE_CHECKING:
    from ..meshing import Mesh

__all__ = ["Piece", "materials_beside", "obj_of", "to_obj", "write_obj"]


class Piece(NamedTuple):
    """A mesh to be written, with the names of its object and its group, and the materials of its slots."""

    name: str
    group: str
    mesh: Mesh
    materials: Mapping[str, str]


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
    return obj_of(map(_piece, build_scene(layout).solids), materials, library_of(layout))


def obj_of(pieces: Iterable[Piece], materials: str = "", library: str = "") -> tuple[str, str]:
    """Meshes as OBJ, and their materials as MTL (see `to_obj`); materials that are rules are those of `library`."""
    head = ["# facade_nb; metres, y up"]
    if materials:
        head.append(f"mtllib {materials}")
    names: dict[str, None] = {}
    body = list(_bodies(pieces, names))
    return "\n".join([*head, *body]) + "\n", "\n".join(_paints(names, library)) + "\n"


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
    """Write a layout as OBJ, with its MTL beside it, both or neither; return the path of the OBJ.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material, or a file that cannot be written.
    """
    beside = materials_beside(path)
    text, materials = to_obj(layout, beside.name if beside else "")
    write_together([(path, text)] + ([(beside, materials)] if beside else []))
    return Path(path)


def _piece(solid: Solid) -> Piece:
    shape = solid.shape
    x, y = shape.number
    name = f"{shape.layer}/{shape.x}[{x}] {shape.y}[{y}]"
    return Piece(name, f"{shape.layer}/{shape.x} {shape.y}", solid.mesh(), solid.materials)


def _bodies(pieces: Iterable[Piece], names: dict[str, None]) -> Iterator[str]:
    import numpy as np

    from ..meshing import corner_normals, corner_places

    points = directions = places = 0
    for piece in pieces:
        mesh = piece.mesh
        yield f"o {_line(piece.name)}"
        yield f"g {_line(piece.group)}"
        if not len(mesh.faces):  # wholly covered, or too small to be told from nothing
            continue
        vertices, corner = np.unique(mesh.vertices.round(6), axis=0, return_inverse=True)
        normals, turn = np.unique(corner_normals(mesh).reshape(-1, 3).round(4), axis=0, return_inverse=True)
        spots, spot = np.unique(corner_places(mesh).reshape(-1, 2).round(5), axis=0, return_inverse=True)
        faces = corner.reshape(-1)[mesh.faces] + points + 1
        turns = turn.reshape(-1, 3) + directions + 1
        textures = spot.reshape(-1, 3) + places + 1
        yield from (f"v {a:.10g} {b:.10g} {c:.10g}" for a, b, c in vertices + 0.0)
        yield from (f"vt {u:.10g} {v:.10g}" for u, v in spots + 0.0)
        yield from (f"vn {a:.4g} {b:.4g} {c:.4g}" for a, b, c in normals + 0.0)
        for slot, name in enumerate(mesh.names):
            chosen = mesh.slots == slot
            if not chosen.any():
                continue
            material = piece.materials[name]
            names.setdefault(material)
            yield f"usemtl {_word(material)}"
            for corners in zip(faces[chosen], textures[chosen], turns[chosen], strict=True):
                yield "f " + " ".join(f"{v}/{t}/{n}" for v, t, n in zip(*corners, strict=True))
        points += len(vertices)
        directions += len(normals)
        places += len(spots)


def _paints(names: Iterable[str], library: str) -> Iterator[str]:
    yield "# facade_nb"
    for name in names:
        material = material_of(library, name)
        red, green, blue = (value / 255 for value in rgb(material.base))
        shine = 2 / max(material.roughness, 0.05) ** 4 - 2  # the exponent that is as rough
        gloss = 0.04 + 0.5 * material.metallic
        yield f"newmtl {_word(name)}"
        yield f"Kd {red:.4f} {green:.4f} {blue:.4f}"
        yield f"Ks {gloss:.4f} {gloss:.4f} {gloss:.4f}"
        yield f"Ns {min(max(shine, 0.0), 1000.0):.4f}"
        yield f"Pr {material.roughness:.4f}"
        yield f"Pm {material.metallic:.4f}"
        yield "illum 2"


def _line(text: str) -> str:
    """A name of one line."""
    return " ".join(text.split()) or "-"


def _word(text: str) -> str:
    """A name without blanks, and without what begins a comment: ``#c8b9a0`` is ``paint-c8b9a0``."""
    return "_".join(text.split()).replace("#", "paint-") or "-"
