"""What is written stays closed where the program that reads it merges corners, as most do."""

from __future__ import annotations

import io
import random

import numpy as np
import pytest
import trimesh

from facade_nb.render import GEOMETRIES, to_glb, to_obj
from facade_nb.render.apart import apart
from facade_nb.render.meshing import have_area, mesh_parts
from facade_nb.solver.model.layout import Canvas, Layout, PlacedShape

TOLD = (
    "arcade(bays=3)",
    "gable(form=stepped)",
    "gable(form=curved)",
    "mansard(ends=hipped)",
    "dormer(roof=arch)",
)


def merged(vertices: np.ndarray, faces: np.ndarray) -> trimesh.Trimesh:
    found = trimesh.Trimesh(vertices, faces, process=False)
    found.merge_vertices(merge_tex=True, merge_norm=True, digits_vertex=5)
    return found


@pytest.mark.parametrize("name", GEOMETRIES)
def test_every_geometry_is_closed_once_its_corners_are_merged(name: str) -> None:
    rng = random.Random(name)
    for _ in range(4):
        width, height = rng.uniform(0.2, 5.0), rng.uniform(0.2, 5.0)
        depth = max(rng.uniform(0.05, 1.2), GEOMETRIES[name].depth(width, height))
        mesh = mesh_parts(GEOMETRIES[name].parts(width, height, depth))
        written = apart(mesh)
        found = merged(written.vertices, written.faces)
        assert found.is_watertight and found.is_winding_consistent
        assert have_area(written.vertices[written.faces]).all()
        assert np.abs(written.vertices[written.faces] - mesh.vertices[mesh.faces]).max() < 1e-3


def test_files_are() -> None:
    looks = [
        *TOLD,
        "window",
        "door",
        "panel",
        "balcony",
        "stair",
        "awning",
        "sign(text=AB)",
        "statue",
        "roof",
    ]
    shapes = [
        PlacedShape("all", "A", "B", (2.0 * k, 0.0, 2.0 * k + 1.7, 1.9), geometry=look, number=(k + 1, 1))
        for k, look in enumerate(looks)
    ]
    layout = Layout("All", Canvas(2.0 * len(looks), 2.0), shapes=tuple(shapes))
    scene = trimesh.load(io.BytesIO(to_glb(layout)), file_type="glb")
    assert len(scene.graph.nodes_geometry) >= len(looks)
    for body in scene.geometry.values():
        found = merged(body.vertices, body.faces)
        assert found.is_watertight and found.is_winding_consistent
    text = to_obj(layout)[0].split("\no ")[1:]
    assert len(text) == len(looks)
    corners = np.array(
        [line.split()[1:4] for own in text for line in own.splitlines() if line.startswith("v ")], float
    )
    for own in text:
        told = (line.split()[1:] for line in own.splitlines() if line.startswith("f "))
        faces = np.array([[int(corner.split("/")[0]) - 1 for corner in face] for face in told])
        found = merged(corners, faces)
        assert found.is_watertight and found.is_winding_consistent, own.splitlines()[0]
