"""The 3D view of a model: one pythreejs mesh, updated in place, and below it what rules of a grammar draw."""

from __future__ import annotations

import asyncio
from math import ceil, log2

import numpy as np
import pythreejs as three
from numpy.typing import NDArray

from ...design import DesignError
from ...render import Scene, build_scene
from ...render.baked import drawable
from ...render.materials import rgb
from ...solver import Layout
from .massing_rules import Ruled, close_geometry
from .model import FacadeModel, Selection

__all__ = ["Massing", "layout_mesh"]

_PAUSE = 0.06
"""Seconds between a change of the model and the 3D view's following, so that it never delays the elevation."""

_HIGHLIGHT = np.array([0.12, 0.5, 0.95], np.float32)
_VIEW = np.array([0.42, 0.16, 1.0])
"""Direction from the façade to the camera."""

_FIELD = 32.0
_ASPECT = 1.3
"""Vertical field of view in degrees, and the aspect it holds for (massing.ts opens it where the view is narrower)."""


class Massing:
    """A renderer with one mesh of the whole façade, orbit controls and a picker.

    All triangles of plain materials are in one mesh with colours at the corners, so the browser is sent three arrays
    when something changes, whatever the number of shapes. The arrays have room to spare: a buffer on the GPU cannot
    grow.

    Parameters
    ----------
    model
        The model to show. A click on a shape selects it there; what is selected is tinted.
    """

    def __init__(self, model: FacadeModel) -> None:
        self.model = model
        self._later: asyncio.TimerHandle | None = None
        self._shown: tuple[Layout | None, Selection] = (None, Selection())
        self._shapes: NDArray[np.int64] = np.zeros(0, np.int64)
        self._colours: NDArray[np.float32] = np.zeros((0, 3), np.float32)
        self._canvas = np.ones(2)
        self.active = True
        self._geometry = _geometry(1)
        self.mesh = three.Mesh(
            self._geometry,
            _paint(),
        )
        self._ruled = Ruled(self.mesh)
        centre, eye = self._stand(self._canvas)
        self._camera = three.PerspectiveCamera(position=eye, fov=_FIELD, near=0.1, far=2000)
        self._orbit = three.OrbitControls(controlling=self._camera, target=centre)
        self._picker = three.Picker(controlling=self.mesh, event="click")
        self._scene = three.Scene(
            children=[
                self.mesh,
                self._camera,
                three.HemisphereLight("#ffffff", "#a9a296", 0.62),
                three.DirectionalLight("#fff4e0", 0.62, position=[-7, 9, 8]),
            ],
            background=None,
        )
        self.renderer = three.Renderer(
            camera=self._camera,
            scene=self._scene,
            controls=[self._orbit, self._picker],
            antialias=True,
            alpha=True,
            clearOpacity=0,
            width=400,
            height=300,
        )
        self.update()
        self._picker.observe(self._on_pick, ("faceIndex", "object"))
        model.observe(self._on_version, "version")

    def show(self, active: bool) -> None:
        """Say whether the view is seen; what is not seen is not updated."""
        self.active = active
        if active:
            self.update()

    def update(self) -> None:
        """Bring mesh, tint and camera up to date with the model."""
        self._later = None
        layout, selection = self.model.layout, self.model.selection
        if layout is None or not self.active or (layout, selection) == self._shown:
            return
        if layout is not self._shown[0]:
            try:
                self._rebuild(layout)
            except DesignError:  # an unknown material: the elevation says so; the last good picture stays
                return
        self._tint(selection)
        self._shown = (layout, selection)

    def close(self) -> None:
        """Close the widgets and stop following the model."""
        self.model.unobserve(self._on_version, "version")
        if self._later is not None:
            self._later.cancel()
        for widget in (self.renderer, self._orbit, self._picker, *self._scene.children, self._scene):
            widget.close()
        close_geometry(self._geometry)
        self.mesh.material.close()
        self._ruled.close()

    def _on_version(self, _: object) -> None:
        if self._later is not None:
            self._later.cancel()
        try:
            self._later = asyncio.get_running_loop().call_later(_PAUSE, self.update)
        except RuntimeError:  # no event loop: nobody to call back later
            self.update()

    def _on_pick(self, _: object) -> None:
        face, mesh = self._picker.faceIndex, self._picker.object
        shapes = self._ruled.shapes(mesh)
        shapes = self._shapes if shapes is None else shapes
        hit = face is not None and mesh is not None and face < len(shapes)
        self.model.select(int(shapes[face]) if hit else None)

    def _rebuild(self, layout: Layout) -> None:
        scene = build_scene(layout)
        positions, normals, self._colours, self._shapes = _plain(scene)
        count = len(self._shapes)
        if 3 * count > len(self._geometry.attributes["position"].array):
            outgrown, self._geometry = self._geometry, _geometry(count)
            self.mesh.geometry = self._geometry
            close_geometry(outgrown)
        attributes = self._geometry.attributes
        _fill(attributes["position"], positions)
        _fill(attributes["normal"], normals)
        self._ruled.update(scene)
        self._follow(np.array([layout.canvas.width, layout.canvas.height]))

    def _tint(self, selection: Selection) -> None:
        colours = self._colours
        if selection.shape is not None:
            picked = np.repeat(self._shapes == selection.shape, 3)[:, None]
            colours = np.where(picked, 0.45 * colours + 0.55 * _HIGHLIGHT, colours)
        _fill(self._geometry.attributes["color"], colours)
        self._ruled.tint(selection.shape, _HIGHLIGHT)

    def _stand(self, canvas: NDArray[np.float64]) -> tuple[list[float], list[float]]:
        """Where to look at, and from where to see the whole façade."""
        centre = np.array([canvas[0] / 2, canvas[1] / 2, 0.0])
        reach = max(canvas[1], canvas[0] / _ASPECT) / 2
        distance = 1.3 * reach / np.tan(np.radians(_FIELD / 2))
        eye = centre + _VIEW / np.linalg.norm(_VIEW) * distance
        return [float(v) for v in centre], [float(v) for v in eye]

    def _follow(self, canvas: NDArray[np.float64]) -> None:
        """Keep the façade as large and as central as it was when the canvas changes; the direction is the person's."""
        if np.array_equal(canvas, self._canvas):
            return
        old_centre, old_eye = (np.array(point) for point in self._stand(self._canvas))
        centre, eye = (np.array(point) for point in self._stand(canvas))
        grown = np.linalg.norm(eye - centre) / np.linalg.norm(old_eye - old_centre)
        target = np.array(self._orbit.target)
        offset = (np.array(self._camera.position) - target) * grown
        target = centre + (target - old_centre) * grown
        self._canvas = canvas
        self._orbit.target = [float(v) for v in target]
        self._camera.position = [float(v) for v in target + offset]


def _geometry(triangles: int, *, exact: bool = False) -> three.BufferGeometry:
    """A geometry with room for at least that many triangles, or for just as many (one at least)."""
    corners = 3 * (max(1, triangles) if exact else 2 ** ceil(log2(max(256, triangles))))
    empty = np.zeros((corners, 3), np.float32)
    return three.BufferGeometry(
        attributes={
            name: three.BufferAttribute(empty.copy(), normalized=False)
            for name in ("position", "normal", "color")
        }
    )


def _fill(attribute: three.BufferAttribute, values: NDArray[np.float32]) -> None:
    """Write `values` to the front of an attribute; the rest are triangles without extent."""
    padded = np.zeros_like(attribute.array)
    padded[: len(values)] = values
    attribute.array = padded


def _plain(
    scene: Scene,
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32], NDArray[np.int64]]:
    """The triangles that no rule draws: positions, normals, colours (3 t, 3), and (t,) the index of their shape."""
    triangles = scene.triangles()
    names = triangles.material_names
    # The elevation's colours: what is seen flat is found again in 3D.
    fills = [rgb(triangles.material(name).fill) for name in names]
    palette = np.array(fills, np.float32).reshape(-1, 3) / 255
    ruled = np.array([drawable(scene.library, name) for name in names], bool)
    kept = ~ruled[triangles.materials] if len(names) else np.zeros(0, bool)
    return (
        triangles.positions[kept].reshape(-1, 3),
        triangles.normals[kept].reshape(-1, 3),
        np.repeat(palette[triangles.materials[kept]], 3, axis=0),
        triangles.shapes[kept],
    )


def layout_mesh(layout: Layout) -> three.Mesh:
    """A layout as one mesh, with the elevation's colours at its corners; below it a mesh for each picture of a rule."""
    scene = build_scene(layout)
    positions, normals, colours, shapes = _plain(scene)
    geometry = _geometry(len(shapes), exact=True)
    for name, values in (("position", positions), ("normal", normals), ("color", colours)):
        _fill(geometry.attributes[name], values)
    mesh = three.Mesh(geometry, _paint())
    Ruled(mesh).update(scene)
    return mesh


def _paint() -> three.MeshStandardMaterial:
    return three.MeshStandardMaterial(vertexColors="VertexColors", roughness=0.85, metalness=0.0)
