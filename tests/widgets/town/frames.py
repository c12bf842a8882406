"""Numbers of frames, as Python has them, for the browser's tests: facade_nb/widgets/test/town/frames.json.

python tests/widgets/town/frames.py     writes them anew
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from facade_nb.render.pipeline.frame import Frame, Looks, visible
from facade_nb.render.pipeline.passes import SHADOW
from facade_nb.render.pipeline.scene import Scene
from facade_nb.render.pipeline.sunlight import MAPS
from facade_nb.render.pipeline.viewpoint import CameraPath, Viewpoint
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.town import Town
from facade_nb.widgets.texture.packet import HOURS
from facade_nb.widgets.town.packet import row

PATH = Path(__file__).resolve().parents[3] / "facade_nb" / "widgets" / "test" / "town" / "frames.json"
PLACES = (
    Viewpoint((1.5, 80.0, 150.0), 0.0, -24.0),
    Viewpoint((80.19, 1.7, -65.8), -123.7, 5.0),
    Viewpoint((-3000.0, 900.0, 12.0), 91.0, -60.0, 35.0),
)
SIZES = ((640, 400), (333, 500), (64, 64))
TIMES = (11.0, 6.25, 22.0)


def plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value.reshape(-1).tolist()
    return list(map(float, value)) if isinstance(value, tuple) else value


def made() -> dict[str, Any]:
    """The scene's chunks, and what Python makes of each frame."""
    town = Town.generate(60, seed=1)
    scene = Scene(town.vertices, town.indices, town.grammar, town.chunks)
    cases = []
    for place, pixels, hour in zip(PLACES, SIZES, TIMES, strict=True):
        frame = Frame(scene, place.frustum(pixels), Daytime.at(hour), pixels)
        values = frame.uniforms()
        seen = {name: visible(scene, values[name]) for name in ("camera", "sun_near", "sun_far")}
        cases.append(
            {
                "place": row(place),
                "pixels": pixels,
                "hour": hour,
                "uniforms": {name: plain(value) for name, value in values.items()},
                "runs": seen,
            }
        )
    path = CameraPath((0.0, 1.0, 2.5), PLACES)
    chunks = town.chunks
    return {
        "head": {
            "box": scene.box.reshape(-1).tolist(),
            "sunlight": {**MAPS, "side": SHADOW},
            "looks": {"haze": Looks().haze, "reach": Looks().reach},
        },
        "hours": [
            {name: plain(value) for name, value in Daytime.at(hour).uniforms().items()} for hour in HOURS
        ],
        "chunks": {name: chunks[name].reshape(-1).tolist() for name in ("first", "count", "low", "high")},
        "cases": cases,
        "path": path.to_dict(),
        "along": [[time, row(path.at(time))] for time in (-1.0, 0.0, 0.3, 1.0, 1.9, 2.5, 9.0)],
    }


if __name__ == "__main__":
    PATH.write_text(json.dumps(made(), separators=(",", ":")) + "\n", encoding="utf-8")
