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
from collections.abc import Sequence
from math import inf
from pathlib import Path
from typing import Any

from . import Design, Layout, NoLayout, __version__, solve
from .cli_ending import ended, say
from .cli_files import STANDARD_OUTPUT, Output, Source, check, write
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
        help="solve a design",
        description="Solve a design. Without --out the layout goes to standard output.",
    )
    solving.add_argument("design", type=Source, metavar="DESIGN.json", help="the design document")
    for name, what in (
        ("out", "the layout document (JSON)"),
        ("trace", "what the solver did, as events (JSON)"),
        ("svg", "the elevation (SVG)"),
        ("png", "a lit picture (PNG, needs OSMesa or EGL)"),
        ("glb", "the mesh (binary glTF)"),
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
    solving.set_defaults(run=_solve)
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
    for warning in layout.warnings:
        say(f"Note: {warning}")
    return 0


def _drawings(options: argparse.Namespace, layout: Layout) -> list[tuple[Output, str | bytes]]:
    if options.svg is options.png is options.glb is None:
        return []
    from . import render

    kinds = (
        (options.svg, render.elevation_svg),
        (options.png, render.render_png),
        (options.glb, render.to_glb),
    )
    return [(path, draw(layout)) for path, draw in kinds if path is not None]
