"""What a studio can write: each format of the package, by the key that its menu has."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from io import BytesIO
from types import MappingProxyType
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from ...design import Design, DesignError, Fault
from ...render import (
    elevation_svg,
    exploded_svg,
    grammar_of,
    obj_files,
    render_png,
    to_cityjson,
    to_dxf,
    to_glb,
    to_pdf,
    to_schedule,
)
from ...solver import Layout
from .commands import file_name
from .model import FacadeModel
from .python_code import python_of

__all__ = ["EXPORTS", "Export", "describe_exports", "export"]


@dataclass(frozen=True, slots=True)
class Export:
    """A format: what it is called, how its file's name ends, its media type, and what writes it."""

    title: str
    suffix: str
    media: str
    write: Callable[[Layout], str | bytes]


def _layout_json(layout: Layout) -> str:
    return json.dumps(layout.to_dict(), ensure_ascii=False, indent=2) + "\n"


def _zipped_obj(layout: Layout) -> bytes:
    """The OBJ with its materials and their pictures, which are of no use apart."""
    data = BytesIO()
    with ZipFile(data, "w", ZIP_DEFLATED) as archive:
        for path, content in obj_files(layout, f"{file_name(layout.name)}.obj").items():
            archive.writestr(ZipInfo(path.name), content, ZIP_DEFLATED)
    return data.getvalue()


def _own(layout: Layout) -> Design:
    return layout.design or Design()


EXPORTS: Mapping[str, Export] = MappingProxyType(
    {
        "svg": Export("Elevation (SVG)", ".svg", "image/svg+xml", elevation_svg),
        "dimensions": Export(
            "Elevation with dimensions (SVG)",
            "-dimensions.svg",
            "image/svg+xml",
            lambda layout: elevation_svg(layout, dimensions=True),
        ),
        "layers": Export("Layers drawn apart (SVG)", "-layers.svg", "image/svg+xml", exploded_svg),
        "png": Export("Picture (PNG)", ".png", "image/png", render_png),
        "glb": Export("Model (glTF, GLB)", ".glb", "model/gltf-binary", to_glb),
        "obj": Export("Model (OBJ and MTL, zipped)", "-obj.zip", "application/zip", _zipped_obj),
        "dxf": Export("Drawing (DXF)", ".dxf", "image/vnd.dxf", to_dxf),
        "pdf": Export("Drawing to scale (PDF)", ".pdf", "application/pdf", to_pdf),
        "cityjson": Export("Building (CityJSON)", ".city.json", "application/city+json", to_cityjson),
        "schedule": Export("Schedule (CSV)", "-schedule.csv", "text/csv", to_schedule),
        "design": Export("Design (JSON)", ".json", "application/json", lambda layout: _own(layout).to_json()),
        "layout": Export("Layout (JSON)", "-layout.json", "application/json", _layout_json),
        "grammar": Export(
            "Texture grammar (text)", "-grammar.txt", "text/plain", lambda layout: grammar_of(layout).text
        ),
        "python": Export("Python", ".py", "text/x-python", lambda layout: python_of(_own(layout))),
    }
)
"""The formats, in the order of the menu. All but the design and the Python need a layout."""

_WITHOUT = {"design": lambda design: design.to_json(), "python": python_of}


def describe_exports() -> list[dict[str, str]]:
    """The menu: the key and the title of each format."""
    return [{"key": key, "title": one.title} for key, one in EXPORTS.items()]


def export(model: FacadeModel, key: str) -> dict[str, Any]:
    """A file with the model's design or layout, as the browser takes it.

    Raises
    ------
    DesignError
        Where there is no layout to write yet.
    """
    one = EXPORTS[key]
    if key in _WITHOUT:
        data: str | bytes = _WITHOUT[key](model.design)
    elif model.layout is None:
        raise DesignError(Fault("", f"there is no layout yet that could be written as {one.title}"))
    else:
        data = one.write(model.layout)
    binary = isinstance(data, bytes)
    text = b64encode(data).decode("ascii") if isinstance(data, bytes) else data
    name = f"{file_name(model.design.name)}{one.suffix}"
    return {"kind": "file", "name": name, "media": one.media, "binary": binary, "text": text}
