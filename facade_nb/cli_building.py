"""``python -m facade_nb solve BUILDING.json``: the same outputs as of a design, of all walls together."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING

from .cli_ending import say
from .cli_files import Output, obj_outputs, write
from .design.errors import DesignError, Fault
from .design.inputs import read_json_text, read_text

if TYPE_CHECKING:
    from .building import Building

__all__ = ["read_building", "solve_building"]


def read_building(path: Path) -> Building | None:
    """The building in a file; None where the file is not a building's, or cannot be read as JSON at all.

    Raises
    ------
    DesignError
        With every fault of a building's document.
    """
    try:
        document = read_json_text(read_text(path, "a design"), str(path))
    except DesignError:
        return None  # whoever reads it as a design tells what is wrong
    said = document.get("format") if isinstance(document, dict) else None
    if not (isinstance(said, str) and said.startswith("facade-nb/building/")):
        return None
    from .building import Building

    return Building.from_dict(document)


def solve_building(building: Building, options: argparse.Namespace) -> int:
    """Solve it and write what is asked for; returns the exit status."""
    if options.trace is not None:
        raise DesignError(
            Fault("--trace", "expected a design; a building is solved wall by wall, without a trace")
        )
    layout = building.solve(time_limit=options.time_limit)
    text = json.dumps(layout.to_dict(), ensure_ascii=False, indent=2, allow_nan=False) + "\n"
    files: list[tuple[Output, str | bytes]] = [(options.out, text)]
    ways = (
        (options.svg, layout.elevation_svg),
        (options.png, layout.render_png),
        (options.glb, layout.to_glb),
        (options.dxf, lambda: layout.to_dxf(units=options.units)),
        (options.pdf, lambda: layout.to_pdf(units=options.units)),
        (options.cityjson, layout.to_cityjson),
        (options.schedule, layout.to_schedule),
    )
    try:
        files += [(path, draw()) for path, draw in ways if path is not None]
    except RuntimeError as error:  # no backend can draw here; the message says what would help
        say(error)
        return 1
    if options.obj is not None:
        files += obj_outputs(options, layout.obj_files)
    write(files)
    for warning in layout.warnings:
        say(f"Note: {warning}")
    return 0
