"""Meshes of the user's: ``file:NAME`` as a geometry is the mesh in that file, fitted to the cell of its shape.

y is up and z towards the viewer, as in glTF. ``file:NAME(fit=keep)`` keeps the mesh's proportions: it stands in the
middle of the cell's floor. Otherwise it is stretched to fill the cell, and is as deep as that makes it on average.
"""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path
from stat import S_ISDIR, S_ISREG

from ..design.errors import DesignError, Fault, nearest
from .geometry import Geometry
from .parts import Part, Polyhedron

__all__ = ["FILE", "file_geometry", "is_file"]

FILE = "file:"
"""What a geometry begins with that is a file."""

KINDS = (".glb", ".gltf", ".obj", ".off", ".ply", ".stl")
"""What can be read, by the end of the name."""

MOST = 20_000
"""Triangles of a mesh, at most: an elevation draws each of them."""

_LARGEST = 64 * 2**20
"""Bytes of a file, at most."""

_TOLD = re.compile(r"(.*)\(\s*fit\s*=\s*(\w*)\s*\)\s*", re.DOTALL)

Triangles = tuple[tuple[tuple[float, float, float], ...], tuple[tuple[int, ...], ...]]
"""Corners, the longest side of their box being 1, its lower left at x = y = 0 and its front at z = 0; and faces."""


def is_file(geometry: str) -> bool:
    """Whether a geometry is a file of the user's."""
    return geometry.startswith(FILE)


def file_geometry(name: str, place: str = "geometry") -> Geometry:
    """The geometry of a mesh file.

    Raises
    ------
    DesignError
        With `place` as the fault's place, for a file that is not there, or holds no closed mesh.
    """
    text, fit = name.removeprefix(FILE).strip(), "fill"
    told = _TOLD.fullmatch(text)
    if told is not None:
        text, fit = told[1].strip(), told[2]
    try:
        if fit not in ("fill", "keep"):
            raise ValueError(f"fit: expected fill or keep; found {fit!r}{nearest(fit, ('fill', 'keep'))}")
        points, faces = _read(Path(text).expanduser(), text)
    except ValueError as error:
        raise DesignError(Fault(place, str(error))) from None

    def recipe(w: float, h: float, d: float) -> tuple[Part, ...]:
        return (_fitted(points, faces, w, h, keep=fit == "keep"),)

    return Geometry(FILE, recipe, "a mesh of the user's", full=False, modelled=True)


def _read(path: Path, text: str) -> Triangles:
    """The mesh of a file. Raises ValueError with what is wrong."""
    if not text:
        raise ValueError("expected the name of a mesh file after 'file:'; found none")
    if path.suffix.lower() not in KINDS:
        raise ValueError(f"expected a file that ends in {', '.join(KINDS)}; found {text!r}")
    try:
        known = path.stat()
    except FileNotFoundError:
        raise ValueError(f"there is no file {text!r}{nearest(path.name, _beside(path))}") from None
    except (OSError, ValueError) as error:  # a loop of links, a closed folder, too long a name
        raise ValueError(f"{text!r} cannot be read: {_why(error)}") from None
    if not S_ISREG(known.st_mode):  # a pipe would be waited for without end
        found = "a folder" if S_ISDIR(known.st_mode) else "a device or a pipe"
        raise ValueError(f"expected a file; {text!r} is {found}")
    if known.st_size > _LARGEST:
        raise ValueError(
            f"expected a file of at most {_LARGEST // 2**20} MB; {text!r} has {known.st_size:,} bytes"
        )
    answer = _triangles(str(path.resolve()), known.st_mtime_ns, known.st_size)
    if isinstance(answer, str):
        raise ValueError(f"{text!r} {answer}")
    return answer


def _why(error: Exception) -> str:
    """What the system says about a file, without its name."""
    told = getattr(error, "strerror", None) or str(error)
    return told[:1].lower() + told[1:]


def _beside(path: Path) -> list[str]:
    """Names of the meshes in the folder where a file was looked for."""
    try:
        return [own.name for own in path.parent.iterdir() if own.suffix.lower() in KINDS]
    except (OSError, ValueError):
        return []


@lru_cache(maxsize=32)
def _triangles(path: str, changed: int, size: int) -> Triangles | str:
    """The mesh of a file as it was when it was changed last, or what is wrong with it."""
    import numpy as np
    import trimesh

    try:
        with np.errstate(all="ignore"):  # corners that are no numbers are told below
            mesh = trimesh.load(path, force="mesh", process=False)
    except PermissionError as error:
        return f"cannot be read: {_why(error)}"
    except Exception as error:  # whatever a reader of some format makes of a broken file
        return f"cannot be read as a mesh ({type(error).__name__})"
    faces = getattr(mesh, "faces", None)
    if faces is None or not len(faces):
        return "holds no triangles"
    if len(faces) > MOST:
        return f"has {len(faces):,} triangles; expected at most {MOST:,}"
    corners, faces = np.array(mesh.vertices, float), np.asarray(faces)
    if not (faces.min() >= 0 and faces.max() < len(corners)):
        return "has triangles with corners that it does not list"
    corners, faces = corners[np.unique(faces)], np.unique(faces, return_inverse=True)[1].reshape(-1, 3)
    if not np.isfinite(corners).all():
        return "has corners that are no numbers"
    # Any unit will do, a file in nanometres as well as one in parsecs: what follows has tolerances for bodies of
    # about a metre.
    largest = float(np.abs(corners).max())
    corners = corners / largest if largest > 0 else corners
    corners -= corners.min(axis=0)
    extent = float(corners.max())
    if not corners.max(axis=0).min() > 1e-6 * extent:
        return "is flat; expected a body with width, height and depth"
    mesh = trimesh.Trimesh(corners / extent, faces, process=False)
    mesh.merge_vertices(merge_tex=True, merge_norm=True)
    mesh.update_faces(mesh.nondegenerate_faces())
    mesh.remove_unreferenced_vertices()
    if not mesh.is_watertight:
        trimesh.repair.fill_holes(mesh)
    trimesh.repair.fix_normals(mesh, multibody=True)
    if not mesh.is_watertight:
        edges, counts = np.unique(np.sort(mesh.edges, axis=1), axis=0, return_counts=True)
        return (
            f"is not closed: {int((counts != 2).sum())} of its {len(edges)} edges do not join two triangles"
        )
    if not (mesh.is_winding_consistent and mesh.volume > 0):
        return "is turned inside out in places"
    low, high = mesh.bounds
    points = mesh.vertices - (low[0], low[1], high[2])
    return tuple(tuple(point) for point in points.tolist()), tuple(
        tuple(face) for face in mesh.faces.tolist()
    )


def _fitted(
    points: tuple[tuple[float, float, float], ...],
    faces: tuple[tuple[int, ...], ...],
    w: float,
    h: float,
    *,
    keep: bool,
) -> Polyhedron:
    wide, tall = (max(point[k] for point in points) for k in (0, 1))
    across, up = w / wide, h / tall
    if keep:
        across = up = min(across, up)
    aside, deep = (w - across * wide) / 2, (across * up) ** 0.5
    return Polyhedron(tuple((aside + x * across, y * up, z * deep) for x, y, z in points), faces)
