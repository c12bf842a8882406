"""Pictures: light and shadow, backends, and what they say when they cannot be used."""

from __future__ import annotations

import io
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from facade_nb.design.errors import DesignError
from facade_nb.design.model import Canvas
from facade_nb.render import backends as module
from facade_nb.render import build_scene, render_png
from facade_nb.render.backends import BACKENDS, BackendError, choose_backend
from facade_nb.render.camera import Camera
from facade_nb.render.daylight import TIMES
from facade_nb.render.picture import picture
from facade_nb.render.surroundings import building
from facade_nb.solver.model.layout import Layout, PlacedShape

from .houses import house

SMALL = {"size": (160, 100), "rays": 8, "samples": 1}


def wall_with_box(offset: float) -> Layout:
    wall = PlacedShape("wall", "A", "P", (0, 0, 6, 4), material="plaster-white")
    box = PlacedShape("box", "B", "Q", (2.5, 2, 3.5, 3), offset=offset, material="plaster-white")
    return Layout("Box", Canvas(6, 4), shapes=(wall, box))


def brightness(layout: Layout, backend: str | None = None) -> NDArray[np.float64]:
    """Seen straight on, so that rows and columns are those of the façade."""
    pixels = picture(
        layout, (240, 160), Camera(azimuth=0, height=2, angle=20), backend=backend, samples=1, rays=16
    )
    return pixels[..., :3].mean(axis=2)


def test_a_picture_shows_something_and_is_written_whole(tmp_path: Path) -> None:
    data = render_png(house(), tmp_path / "house.png", size=(160, 100), rays=8, samples=1)
    assert (tmp_path / "house.png").read_bytes() == data
    assert [p.name for p in tmp_path.iterdir()] == ["house.png"]
    image = Image.open(io.BytesIO(data))
    assert image.size == (160, 100)
    assert image.mode == "RGB"
    pixels = np.asarray(image, float)
    assert pixels.std() > 20
    assert 90 < pixels.mean() < 220
    sky = pixels[:12].mean(axis=(0, 1))
    assert sky[2] > sky[0]  # blue
    edges = np.abs(np.diff(pixels.mean(axis=2), axis=1))
    assert (edges > 25).mean() > 0.02  # windows, columns and corners, not a blur


def test_brick_is_redder_than_plaster() -> None:
    size, camera = (240, 150), Camera(azimuth=0, angle=20)
    pixels = picture(house(), size, camera, samples=1, rays=8).astype(float)
    canvas = [(0.0, 0.0, 0.0), (6.0, 4.3, 0.0)]
    view = camera.look(np.concatenate([canvas, building(house()).positions.reshape(-1, 3)]), size)

    def redness(x: float, y: float) -> float:
        spot = view.matrix @ np.array([x, y, 0.0, 1.0])
        column = int((spot[0] / spot[3] + 1) / 2 * size[0])
        row = int((1 - spot[1] / spot[3]) / 2 * size[1])
        red, _, blue = pixels[row - 2 : row + 3, column - 2 : column + 3].mean(axis=(0, 1))
        return red / blue

    assert redness(2.1, 0.8) > redness(2.1, 2.3) + 0.2


@pytest.mark.parametrize("backend", [name for name, b in BACKENDS.items() if name != "egl" and b.available])
def test_a_projecting_box_darkens_the_wall_below_it(backend: str) -> None:
    flat, proud = brightness(wall_with_box(0.001), backend), brightness(wall_with_box(0.8), backend)
    changed = flat - proud
    rows, columns = np.nonzero(changed > 30)
    assert len(rows) > 50
    centre_row, centre_column = rows.mean(), columns.mean()
    middle = flat.shape[1] / 2
    assert centre_column > middle  # the sun stands to the upper left
    below = changed[int(centre_row) :, int(middle) : int(middle) + 20]
    assert below.max() > 30


def test_backends_agree() -> None:
    if not BACKENDS["osmesa"].available:
        pytest.fail(BACKENDS["osmesa"].why_not)
    first = picture(house(), backend="osmesa", **SMALL).astype(int)
    second = picture(house(), backend="cpu", **SMALL).astype(int)
    assert (np.abs(first - second).max(axis=2) > 40).mean() < 0.02


def test_triangle_numbers_are_exact() -> None:
    triangles = building(house())
    points = triangles.positions.reshape(-1, 3).astype(float)
    view = Camera().look(points, (200, 120))
    found = {}
    for name in ("osmesa", "cpu"):
        with choose_backend(name).open(triangles.positions, (200, 120)) as canvas:
            found[name] = canvas.draw(view.matrix)
            assert np.array_equal(canvas.depth(view.matrix), found[name][1])
    (one, near), (two, far) = found.values()
    same = one == two
    assert same.mean() > 0.99
    assert one.max() < len(triangles.positions)
    assert np.abs(near - far)[same].max() < 1e-4


def test_pictures_leak_no_context() -> None:
    script = """
import gc, os, resource
from tests.render.houses import house
from facade_nb.render.picture import picture
def kilobytes():
    gc.collect()
    with open("/proc/self/statm") as f:
        return int(f.read().split()[1]) * resource.getpagesize() // 1024
for turn in range(10):
    picture(house(), (64, 48), backend="osmesa", samples=1, rays=2)
    if turn == 2:
        before = kilobytes()
grown = kilobytes() - before
assert grown < 7 * 2000, f"{grown} kB in 7 pictures"
"""
    root = Path(__file__).parents[2]
    done = subprocess.run([sys.executable, "-c", script], cwd=root, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_importing_and_drawing_need_no_graphics_library() -> None:
    script = """
import sys
from facade_nb.render import build_scene, elevation_svg
from tests.render.houses import house
elevation_svg(house())
build_scene(house())
heavy = {"OpenGL", "pyrender", "trimesh", "PIL", "pyglet", "scipy"} & set(sys.modules)
assert not heavy, heavy
"""
    root = Path(__file__).parents[2]
    done = subprocess.run([sys.executable, "-c", script], cwd=root, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_a_missing_library_is_named_with_the_command_that_helps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_loads", lambda library: False)
    assert "apt-get install --no-install-recommends libosmesa6" in BACKENDS["osmesa"].why_not
    assert "apt-get install --no-install-recommends libegl1" in BACKENDS["egl"].why_not
    assert not BACKENDS["osmesa"].available
    with pytest.raises(BackendError, match="no OSMesa found"):
        choose_backend("osmesa")
    assert choose_backend().name == "cpu"


def test_a_second_platform_in_one_process_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "OpenGL", module)
    monkeypatch.setenv("PYOPENGL_PLATFORM", "osmesa")
    assert "already uses OpenGL on osmesa" in BACKENDS["egl"].why_not
    assert "PYOPENGL_PLATFORM=egl" in BACKENDS["egl"].why_not


def test_a_missing_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    import importlib.util

    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    monkeypatch.setattr(module, "_loads", lambda library: True)
    assert "pip install pyrender2" in BACKENDS["osmesa"].why_not


def test_other_systems_are_told_about_the_cpu(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "win32")
    assert "'cpu' works everywhere" in BACKENDS["egl"].why_not


def test_wrong_arguments_are_named() -> None:
    with pytest.raises(
        ValueError, match="backend: expected one of osmesa, egl, cpu; found 'osmsa'; did you mean 'osmesa'"
    ):
        render_png(house(), backend="osmsa")
    with pytest.raises(ValueError, match="time_of_day: expected one of morning"):
        render_png(house(), time_of_day="night", backend="cpu", size=(32, 32), samples=1, rays=1)
    with pytest.raises(ValueError, match="background: expected sky or transparent; found 'blue'"):
        render_png(house(), background="blue")
    with pytest.raises(ValueError, match="at least 16 pixels"):
        render_png(house(), size=(8, 8))


def test_a_folder_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(DesignError, match="cannot write"):
        render_png(house(), tmp_path / "no" / "house.png", size=(32, 32), samples=1, rays=1)


def test_times_of_day_differ() -> None:
    means = {name: picture(house(), time_of_day=name, **SMALL).mean(axis=(0, 1)) for name in TIMES}
    assert means["evening"][0] / means["evening"][2] > means["noon"][0] / means["noon"][2]
    assert means["overcast"].std() < means["evening"].std()


def test_a_transparent_background_keeps_the_shadow() -> None:
    pixels = picture(house(), background="transparent", **SMALL)
    assert pixels.shape == (100, 160, 4)
    assert pixels[2, 2, 3] == 0
    alpha = pixels[..., 3]
    assert (alpha == 255).mean() > 0.15
    assert ((alpha > 40) & (alpha < 240)).mean() > 0.02


def test_verticals_stay_upright_and_everything_is_inside() -> None:
    triangles = building(house())
    points = triangles.positions.reshape(-1, 3).astype(float)
    for azimuth in (-60, 0, 27, 75):
        for size in ((320, 200), (200, 320)):
            view = Camera(azimuth=azimuth).look(points, size)
            clip = np.column_stack([points, np.ones(len(points))]) @ view.matrix.T
            spots = clip[:, :3] / clip[:, 3:]
            assert (np.abs(spots) <= 1).all()
            low, high = (view.matrix @ np.array([3.0, y, 0.0, 1.0]) for y in (0.0, 3.0))
            assert low[0] / low[3] == pytest.approx(high[0] / high[3])


def test_an_empty_canvas_is_a_blank_panel() -> None:
    pixels = picture(Layout("Nothing", Canvas(6, 3)), **SMALL).astype(float)
    assert pixels.std() > 3
    assert pixels[40:60, 70:90].mean() > 200


def test_the_body_closes_the_building() -> None:
    triangles = building(house())
    low, high = triangles.positions.reshape(-1, 3).min(axis=0), triangles.positions.reshape(-1, 3).max(axis=0)
    assert low[2] < -4
    assert high[2] < 1
    assert len(triangles.positions) > len(build_scene(house()).triangles().positions)


def test_a_dormer_does_not_raise_the_body_into_the_roof() -> None:
    plain = house()
    roof = next(shape.rect for shape in plain.shapes if shape.kind == "roof")
    dormer = PlacedShape(
        "dormers", "M", "T", (2.0, roof[1] + 0.1, 3.0, roof[3] - 0.1), kind="window", geometry="window"
    )
    triangles = building(replace(plain, shapes=(*plain.shapes, dormer)))
    assert triangles.positions[triangles.shapes == -1][:, :, 1].max() <= roof[1] + 1e-5
    assert triangles.positions[triangles.shapes == len(plain.shapes)].size > 0  # it is there all the same
