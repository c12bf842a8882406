"""The command line: ``python -m facade_nb solve DESIGN.json`` and ``… render GRAMMAR.txt``.

Exit status 0: done; 2: the input is at fault; 3: the design has no layout, and nothing but its trace is written;
1: a drawing that this machine cannot make. Messages go to stderr, without a traceback. Everything is computed before
the first file is written, and files are written whole or not at all.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from collections.abc import Sequence
from math import inf
from pathlib import Path

from . import Design, DesignError, Layout, NoLayout, __version__, solve
from .cli_render import add_render, joined, render_command
from .design.files import write_together

__all__ = ["main"]


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    parser = argparse.ArgumentParser(prog="facade-nb", description="Procedural façades designed in layers.")
    parser.add_argument("--version", action="version", version=f"facade_nb {__version__}")
    commands = parser.add_subparsers(dest="command", required=True)
    solving = commands.add_parser(
        "solve",
        help="solve a design",
        description="Solve a design. Without --out the layout goes to standard output.",
    )
    solving.add_argument("design", metavar="DESIGN.json", help="the design document")
    for name, what in (
        ("out", "the layout document (JSON)"),
        ("trace", "what the solver did, as events (JSON)"),
        ("svg", "the elevation (SVG)"),
        ("png", "a lit picture (PNG, needs OSMesa or EGL)"),
        ("glb", "the mesh (binary glTF)"),
    ):
        solving.add_argument(f"--{name}", metavar="FILE", help=f"write {what}")
    solving.add_argument("--time-limit", type=_seconds, default=10.0, metavar="SECONDS", help="default: 10")
    add_render(commands)
    options = parser.parse_args(joined(sys.argv[1:] if argv is None else argv))
    try:
        return _solve(options) if options.command == "solve" else render_command(options)
    except DesignError as error:
        print(error, file=sys.stderr)
        return 2
    except NoLayout as error:
        print(f"No layout: {error}", file=sys.stderr)
        return 3
    except KeyboardInterrupt:
        print("Stopped.", file=sys.stderr)
        return 130


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
        if options.trace:  # what was tried is what there is to look at now
            write_together([(options.trace, error.trace.to_json())])
        raise
    text = json.dumps(layout.to_dict(), ensure_ascii=False, indent=2, allow_nan=False) + "\n"
    files: list[tuple[str, str | bytes]] = []
    if options.out:
        files.append((options.out, text))
    if options.trace:
        files.append((options.trace, layout.trace.to_json()))
    try:
        files += _drawings(options, layout)
    except RuntimeError as error:  # no backend can draw here; the message says what would help
        print(error, file=sys.stderr)
        return 1
    write_together(files)
    if not options.out:
        sys.stdout.buffer.write(text.encode())  # a document is UTF-8, whatever the terminal's encoding
        sys.stdout.flush()
    for warning in layout.warnings:
        print(f"Note: {warning}", file=sys.stderr)
    return 0


def _drawings(options: argparse.Namespace, layout: Layout) -> list[tuple[str, str | bytes]]:
    files: list[tuple[str, str | bytes]] = []
    if not (options.svg or options.png or options.glb):
        return files
    from . import render

    if options.svg:
        files.append((options.svg, render.elevation_svg(layout)))
    with tempfile.TemporaryDirectory() as folder:
        for name, write in (("png", render.render_png), ("glb", render.write_glb)):
            target = getattr(options, name)
            if target:
                scratch = Path(folder, f"drawing.{name}")
                write(layout, scratch)
                files.append((target, scratch.read_bytes()))
    return files
