"""What a picture takes of the graphics card: images that buffers share, and a town with them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from facade_nb import gallery
from facade_nb.render import Grammar
from facade_nb.render.pipeline.device import choose_device
from facade_nb.render.pipeline.frame import Frame
from facade_nb.render.pipeline.passes import (
    BUFFERS,
    LAMPS,
    PASSES,
    SHADOW,
    Buffer,
    Pass,
    image_bytes,
    shared,
    without,
)
from facade_nb.render.pipeline.renderer import renderer_of
from facade_nb.render.pipeline.scene import Scene
from facade_nb.render.pipeline.viewpoint import Viewpoint
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.texture.facades import box
from facade_nb.render.town import Town

PIXELS = (1024, 768)
OWN = {own.name: own for own in BUFFERS}
ALL = tuple(OWN)


def clashes(passes: Sequence[Pass], whole: Sequence[str]) -> list[str]:
    """Where a buffer is read after another has been drawn into its image."""
    images = shared(passes, BUFFERS, whole)
    holds: dict[str, str] = {}
    found = []
    for own in passes:
        found += [f"{own.name}: {name}" for name in own.reads if holds[images[name]] != name]
        held = {images[name] for name in own.reads}
        found += [f"{own.name} draws into what it reads" for name in own.writes if images[name] in held]
        holds.update((images[name], name) for name in own.writes)
    written = {name for own in passes for name in own.writes}
    return found + [name for name in written & {*whole} if holds[images[name]] != name]


@pytest.mark.parametrize("whole", [("picture",), ("toned",), ("color", "facing", "light"), ("along",), ALL])
def test_no_image_is_drawn_over_while_it_is_needed(whole: tuple[str, ...]) -> None:
    for passes in (
        PASSES,
        without(["edges"]),
        without(["soften", "occlusion", "light", "air", "tone", "edges"]),
    ):
        assert clashes(passes, whole) == []


def test_images_are_shared_only_where_they_are_alike() -> None:
    images = shared()
    assert {name for name, image in images.items() if name != image} == {"overhang", "light", "air"}
    assert all(
        (OWN[name].kind, OWN[name].channels, OWN[name].size(PIXELS))
        == (OWN[image].kind, OWN[image].channels, OWN[image].size(PIXELS))
        for name, image in images.items()
    )
    assert shared(whole=ALL) == {name: name for name in ALL}


def test_a_pass_of_ones_own_shares_images_too() -> None:
    more = Buffer("again", 4, "f2", "Once more.")
    passes = (*PASSES[:-1], Pass("again", "tone.frag", ("air",), ("again",), "Once more."), PASSES[-1])
    assert shared(passes, (*BUFFERS, more))["again"] in {"along", "specular"}


def test_a_picture_is_the_same_whatever_else_is_read() -> None:
    grammar = Grammar.parse(gallery.grammar("figure-10"))
    pixels = (97, 64)
    scene = Scene.of_facades(box(grammar, 11, 13, 9, side="Side", roof=0.0))
    place = Viewpoint.towards((9.0, 1.7, 17.0), (0.0, 5.0, 0.0), 62.0)
    frame = Frame(scene, place.frustum(pixels), Daytime.at(13.0), pixels)
    with renderer_of(scene, choose_device()) as renderer:
        alone = renderer.draw(frame)["picture"]
        every = renderer.draw(frame, ALL)
        again = renderer.draw(frame, ("along", "picture"))
    assert alone.std() > 10
    assert (alone == every["picture"]).all()
    assert (alone == again["picture"]).all()
    assert (again["along"] == every["along"]).all()
    with renderer_of(scene, choose_device()) as renderer:
        for name in ("light", "color", "normal", "toned"):
            assert np.array_equal(renderer.draw(frame, (name,))[name], every[name]), name


def test_bytes_of_a_pixel() -> None:
    maps = 2 * SHADOW * SHADOW * 4 + LAMPS * LAMPS * 4
    assert image_bytes(PIXELS) == maps + 94 * 1024 * 768
    assert image_bytes(PIXELS, whole=ALL) == maps + 111 * 1024 * 768


def test_twenty_thousand_buildings_take_less_than_200_megabytes() -> None:
    """Told by two towns that are smaller: beyond what is there once, all takes room by the building."""
    few, more = (Town.generate(count, seed=1).stats()["bytes"] for count in (1_000, 2_500))
    for sizes in (few, more):
        assert sizes["images"] == image_bytes(PIXELS)
        assert sizes["total"] == sum(size for name, size in sizes.items() if name != "total")
    each = (more["total"] - few["total"]) / 1_500
    assert each > 1_000
    assert more["total"] + 17_500 * each < 200e6
