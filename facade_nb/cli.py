"""The command line: ``python -m facade_nb solve DESIGN.json``, ``… infer SURVEY.json``, ``… render GRAMMAR.txt`` and
``… town``.

Exit status 0: done; 2: the input is at fault; 3: the design has no layout, and nothing but its trace is written;
1: this machine cannot draw it, or could not write it (a full disk). Messages go to stderr, without a traceback.
Everything is computed before the first file is written, and files are written whole or not at all. No output may be
an input or another output (see `cli_files`); signals and closed pipes end a command as `cli_ending` says.
"""

from __future__ import annotations

import argparse
import json
import sys
import warnings
from collections.abc import Callable, Sequence
from functools import partial
from math import inf
from pathlib import Path
from typing import Any

from . import Design, DesignError, Layout, NoLayout, __version__, solve
from .cli_building import read_building, solve_building
from .cli_ending import ended, say
from .cli_files import STANDARD_OUTPUT, Output, Source, check, obj_outputs, write
from .cli_infer import add_infer
from .cli_render import add_render, joined
from .cli_town import add_town

__all__ = ["command_parser", "main"]


class _Parser(argparse.ArgumentParser):
    """A parser whose help is an output like others: argparse would not tell that a disk is full."""

    def _print_message(self, message: str, file: Any = None) -> None:
        if message and file is not None and file is sys.stdout:
            write([(STANDARD_OUTPUT, message)])
        elif message:
            say(message.rstrip("\n"))


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit status."""

    def run() -> int:
        options = command_parser().parse_args(joined(sys.argv[1:] if argv is None else argv))
        check(options)
        return int(options.run(options))

    return ended(run)


def command_parser() -> argparse.ArgumentParser:
    """Return the parser of all commands. Its paths have the types of `cli_files`, so that `main` can check them."""
    parser = _Parser(prog="facade-nb", description="Procedural façades designed in layers.")
    parser.add_argument("--version", action="version", version=f"facade_nb {__version__}")
    commands = parser.add_subparsers(dest="command", required=True)
    solving = commands.add_parser(
        "solve",
        help="solve a design or a building",
        description="Solve a design, or a building of several façades. Without --out it goes to standard output.",
    )
    solving.add_argument(
        "design", type=Source, metavar="DESIGN.json", help="the document of a design or a building"
    )
    for name, what in (
        ("out", "the layout document (JSON)"),
        ("trace", "what the solver did, as events (JSON)"),
        ("svg", "the elevation (SVG)"),
        ("png", "a lit picture (PNG, needs OSMesa or EGL)"),
        ("glb", "the mesh (binary glTF)"),
        ("obj", "the mesh (OBJ), with its materials (MTL) beside it"),
        ("dxf", "the drawing with dimensions (DXF)"),
        ("pdf", "the drawing to scale with dimensions and schedule (PDF)"),
        ("cityjson", "the building (CityJSON)"),
        ("schedule", "what it is made of, as a table (CSV)"),
    ):
        default = STANDARD_OUTPUT if name == "out" else None
        solving.add_argument(
            f"--{name}",
            type=Output,
            default=default,
            metavar="FILE",
            help=f"write {what}; -: standard output",
        )
    solving.add_argument("--time-limit", type=_seconds, default=10.0, metavar="SECONDS", help="default: 10")
    solving.add_argument(
        "--units",
        choices=("m", "ft"),
        default="m",
        help="of dimensions in DXF and PDF: metres, or feet and inches; default: m",
    )
    solving.set_defaults(run=_solve, beside=_beside)
    add_infer(commands)
    add_render(commands)
    add_town(commands)
    return parser


def _seconds(text: str) -> float:
    """A time in seconds."""
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 <= value < inf:
        raise argparse.ArgumentTypeError(f"expected seconds, 0 or more; found {text!r}")
    return value


def _solve(options: argparse.Namespace) -> int:
    building = read_building(Path(options.design))
    if building is not None:
        return solve_building(building, options)
    design = Design.from_json(Path(options.design))
    try:
        layout = solve(design, trace=options.trace is not None, time_limit=options.time_limit)
    except NoLayout as error:
        if options.trace is not None:  # what was tried is what there is to look at now
            write([(options.trace, error.trace.to_json())])
        raise
    text = json.dumps(layout.to_dict(), ensure_ascii=False, indent=2, allow_nan=False) + "\n"
    files: list[tuple[Output, str | bytes]] = [(options.out, text)]
    if options.trace is not None:
        files.append((options.trace, layout.trace.to_json()))
    try:
        files += _drawings(options, layout)
    except RuntimeError as error:  # no backend can draw here; the message says what would help
        say(error)
        return 1
    write(files)
    for warning in (*layout.warnings, *(_undrawn(layout) if len(files) > 1 else ())):
        say(f"Note: {warning}")
    return 0


def _drawings(options: argparse.Namespace, layout: Layout) -> list[tuple[Output, str | bytes]]:
    named = (
        options.svg,
        options.png,
        options.glb,
        options.dxf,
        options.pdf,
        options.cityjson,
        options.schedule,
    )
    if options.obj is None and not any(path is not None for path in named):
        return []
    from . import render

    kinds: tuple[Callable[[Layout], str | bytes], ...] = (
        render.elevation_svg,
        render.render_png,
        render.to_glb,
        partial(render.to_dxf, units=options.units),
        partial(render.to_pdf, units=options.units),
        render.to_cityjson,
        render.to_schedule,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", render.DrawingWarning)  # said in words of our own, once
        found = [(path, draw(layout)) for path, draw in zip(named, kinds, strict=True) if path is not None]
        if options.obj is not None:
            found += obj_outputs(options, partial(render.obj_files, layout))
    return found


def _undrawn(layout: Layout) -> list[str]:
    """What could not be drawn as the design says."""
    from .render import drawing_faults

    return [str(fault) for fault in drawing_faults(layout)]


def _beside(options: argparse.Namespace) -> list[tuple[str, Output]]:
    """The file that is written beside another, with what it is called in messages: the MTL of an OBJ."""
    if options.obj is None or options.obj.is_standard:
        return []
    from .render.exchange.obj import materials_beside

    try:
        file = materials_beside(options.obj)
    except DesignError:  # the OBJ has no place, which is told of the OBJ
        return []
    return [("--obj (its materials)", Output(file))] if file else []
