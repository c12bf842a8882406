"""The picture of docs/buildings.md: ``python -m scripts.docs.buildings`` draws it anew."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

from PIL import Image

from facade_nb import Building, gallery
from facade_nb.building import Roof
from facade_nb.building.treatments import chamfer, quoins
from facade_nb.render.camera import Camera

PICTURE = Path(__file__).parents[2] / "docs" / "img" / "buildings.jpg"
SIZE = (760, 620)


def examples() -> list[tuple[Building, Camera]]:
    """The buildings of the page, each with where one stands."""
    apartments, branch = gallery.load("apartment-house"), gallery.load("teaser")
    corner = Building.rectangle(
        14,
        9,
        apartments,
        height=10,
        corners={
            0: ("quoins", quoins()),
            1: ("chamfer", chamfer(ground=3.2, storey=2.9)),
            2: ("quoins", quoins()),
        },
        roof=Roof("hip", material="slate"),
    )
    yard = Building.ell(
        21,
        19,
        10,
        {"front": branch, "right": branch, "left": branch, "yard": apartments, "wing": apartments},
        height=14.7,
        roof=Roof("gable", rise=4, material="slate"),
    )
    row = Building.row(
        [(14, branch), (12, gallery.load("terraced-house")), (16, apartments)],
        12,
        height=15,
        roof=Roof("gable", rise=4),
    )
    return [
        (corner, Camera(azimuth=36, height=8)),
        (yard, Camera(azimuth=148, height=11)),
        (row, Camera(azimuth=25, height=4)),
    ]


def main() -> None:
    """Draw it."""
    sheet = Image.new("RGB", (SIZE[0] * 3, SIZE[1]))
    for k, (building, camera) in enumerate(examples()):
        hour = "overcast" if k == 1 else "morning"  # the yard looks away from the sun
        data = building.solve().render_png(size=SIZE, camera=camera, time_of_day=hour, rays=48)
        sheet.paste(Image.open(BytesIO(data)), (k * SIZE[0], 0))
    sheet.save(PICTURE, quality=88, optimize=True)


if __name__ == "__main__":
    main()
