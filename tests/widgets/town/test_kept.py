"""What a town's saved state has for pages without a kernel."""

from __future__ import annotations

import json
import zlib
from typing import Any

import pytest

from facade_nb.render.town import Town
from facade_nb.widgets import TownModel, TownView
from facade_nb.widgets.town.packet import blobs_of


def _kept(view: TownView) -> tuple[dict[str, Any], bytes]:
    """What is told, and the bytes of all arrays."""
    data = zlib.decompress(view.channel.kept)
    length = int.from_bytes(data[:4], "little")
    return json.loads(data[4 : 4 + length]), data[-(-(4 + length) // 8) * 8 :]


def test_all_that_is_drawn_is_kept_while_somebody_looks() -> None:
    model = TownModel(Town.generate(8, seed=1))
    view = TownView(model)
    assert view.channel.kept == b""
    assert view.keep(side=16) is view
    told, content = _kept(view)
    for name, blob in blobs_of(model).items():
        kind, at, count = told["blobs"][name]["$"]
        assert (kind, content[at : at + count]) == ("u1", bytes(blob.content))
    assert [tile["name"] for tile in told["tiles"]] == list(model.grammar.encoding.tiles)
    assert all(max(max(size) for size in tile["sizes"]) <= 16 for tile in told["tiles"])
    sides = {max(max(size) for size in tile["sizes"]) for tile in told["tiles"]}
    assert {1, 16} <= sides  # of those that no house of the town shows there is one pixel
    assert told["pixels"]["$"][2] == sum(4 * w * h for tile in told["tiles"] for w, h in tile["sizes"])
    view.channel._sleep()
    assert view.channel.kept == b""
    view.channel.wake()
    assert _kept(view)[0] == told
    with pytest.raises(ValueError, match="side: expected a whole number of pixels from 1; found 0"):
        view.keep(0)
