"""Solids by mesh and façades by grammar in one scene: each is drawn as it is drawn alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from facade_nb.render.pipeline.device import choose_device
from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.pipeline.gathering import gathered
from facade_nb.render.pipeline.passes import BUFFERS, PASSES
from facade_nb.render.pipeline.renderer import renderer_of
from facade_nb.render.pipeline.scene import Scene
from facade_nb.render.pipeline.solids import GROUND, Solids, solids_of
from facade_nb.render.pipeline.together import together
from facade_nb.render.pipeline.viewpoint import Viewpoint
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.texture.facades import Facade
from facade_nb.render.texture.from_layout import grammar_of

from ..houses import house

PIXELS = (160, 90)
PLACE = Viewpoint((3.0, 1.7, 14.0), 14.0, 3.0, 60.0).frustum(PIXELS)
LOOKS = Looks(haze=0.0, relief=False, rays=4)
WANTED = ("rule", "color", "facing", "picture")


@pytest.fixture(scope="module")
def solids() -> Solids:
    return solids_of(house())


@pytest.fixture(scope="module")
def facade() -> Scene:
    """The same house by grammar, 7 m to the right; its seed needs a table."""
    found = grammar_of(house())
    return Scene.of_facades([Facade(found.grammar(), found.size, (7.0, 0.0, 0.0), seed=(-3.3, 0.1))])


def drawn(scene: Scene, hour: float = 11.0, still: bool = False) -> dict[str, NDArray[np.float64]]:
    passes, buffers = gathered(LOOKS.rays) if still else (PASSES, BUFFERS)
    with renderer_of(scene, choose_device(), passes=passes, buffers=buffers) as renderer:
        frame = Frame(scene, PLACE, Daytime.at(hour), PIXELS, LOOKS)
        return {name: values.astype(float) for name, values in renderer.draw(frame, WANTED).items()}


def test_each_is_drawn_as_it_is_alone(solids: Solids, facade: Scene) -> None:
    both = drawn(together(solids.scene, facade))
    mesh, rectangle = drawn(solids.scene), drawn(facade)
    on_facade = rectangle["facing"][..., 3] > 0
    assert on_facade.mean() > 0.1
    assert np.abs(both["color"] - rectangle["color"])[on_facade].max() == 0
    # Beside it nothing of the house has changed; the ground may have its shadow, which is no matter of the grammar.
    assert np.abs(both["color"] - mesh["color"])[~on_facade].max() == 0
    assert len(np.unique(both["rule"][on_facade], axis=0)) == 1


def test_one_throws_its_shadow_on_the_other(solids: Solids, facade: Scene) -> None:
    """Moved to the left and to the front, the façade takes the sun from the house's corner and the ground before it."""
    moved = facade.vertices.copy()
    moved["position"] += (-14.0, 0.0, 4.0)
    before = together(solids.scene, replace(facade, vertices=moved, given_chunks=None))
    apart, both = drawn(solids.scene, 9.0, still=True), drawn(before, 9.0, still=True)
    same = (apart["rule"] == both["rule"]).all(axis=2) & (apart["facing"][..., 3] > 0)
    change = (both["picture"] - apart["picture"])[..., :3].sum(axis=2)
    for own in (apart["facing"][..., 1] > 0.99, apart["facing"][..., 2] > 0.99):
        assert (change[same & own] < -100).sum() > 20
        assert np.median(np.abs(change[same & own])) < 12


def test_the_next_picture_has_its_own_light(solids: Solids) -> None:
    """Maps of the sun stay where they are; what each pixel sees of them does not."""
    passes, buffers = gathered(LOOKS.rays)

    def frame(left: float) -> Frame:
        return Frame(solids.scene, PLACE.crop(left, 0, left + 0.5, 1), Daytime.at(9.0), (80, 90), LOOKS)

    with renderer_of(solids.scene, choose_device(), passes=passes, buffers=buffers) as renderer:
        renderer.draw(frame(0.5))
        second = renderer.draw(frame(0.0))["picture"]
    with renderer_of(solids.scene, choose_device(), passes=passes, buffers=buffers) as renderer:
        assert np.array_equal(renderer.draw(frame(0.0))["picture"], second)


def test_indices_and_chunks_go_on(solids: Solids, facade: Scene) -> None:
    scene = together(solids.scene, facade)
    assert scene.chunks["first"].tolist() == [0, len(solids.scene.indices) - 6, len(solids.scene.indices)]
    assert scene.chunks["count"].sum() == len(scene.indices) == 3 * len(solids.shapes) + 6
    assert (solids.shapes == GROUND).sum() == 2
    assert scene.solid_box[1, 0] == pytest.approx(13.0)
    assert scene.seeds  # a seed below zero needs the table, and all have a row in it
    assert set(scene.vertices["seed"][:, 0].astype(int)) == set(range(len(scene.seeds)))


def test_of_one_is_that_one(solids: Solids) -> None:
    assert together(solids.scene) is solids.scene
    with pytest.raises(ValueError, match="at least one scene"):
        together()


def test_vertices_hold_seeds_where_they_can(solids: Solids) -> None:
    scene = together(solids.scene, replace(solids.scene))
    assert not scene.seeds
    assert np.array_equal(scene.vertices[: len(solids.scene.vertices)]["seed"], solids.scene.vertices["seed"])
