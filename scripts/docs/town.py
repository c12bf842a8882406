"""``python -m scripts.docs.town [FOLDER]``: the town of the README, from afar and in a street, by day and evening."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from facade_nb.render.pipeline.device import choose_device
from facade_nb.render.pipeline.renderer import renderer_of
from facade_nb.render.pipeline.stills import still
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.texture.photograph import save_picture
from facade_nb.render.town import Town

SIZE = (800, 560)
GAP = 8


def main(folder: Path) -> None:
    """Write ``town.jpg``."""
    town = Town.generate(20_000, 1)
    pictures = []
    with renderer_of(town.scene, choose_device()) as renderer:
        for view, hour in (("distance", 15.0), ("street", 15.0), ("distance", 20.6), ("street", 21.0)):
            place = town.viewpoint(view)  # type: ignore[arg-type]
            pictures.append(still(renderer, place.frustum(SIZE), Daytime.at(hour), SIZE, samples=2))
    across = np.full((SIZE[1], GAP, 3), 255, np.uint8)
    rows = [np.concatenate([pictures[k], across, pictures[k + 1]], axis=1) for k in (0, 2)]
    between = np.full((GAP, rows[0].shape[1], 3), 255, np.uint8)
    save_picture(np.concatenate([rows[0], between, rows[1]]), folder / "town.jpg", quality=95)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path("docs/img"))
