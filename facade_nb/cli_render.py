"""``python -m facade_nb render GRAMMAR.txt``: a picture of a texture grammar (SPEC 6)."""

from __future__ import annotations

import argparse
import io
import os
import sys
from collections.abc import Sequence
from dataclasses import replace
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .design.errors import GrammarError
from .design.files import write_together
from .design.inputs import read_text

if TYPE_CHECKING:
    from .render.texture.atlas import Tiles
    from .render.texture.grammar import Grammar
    from .render.texture.view import Sight

__all__ = ["add_render", "joined", "render_command"]

_BACKENDS = ("cpu", "osmesa", "egl")
_ANTIALIAS = ("none", "adaptive", "supersample")
_MOST_PIXELS = 1 << 26
_NUMBERS = ("--size", "--pixels", "--seed", "--eye", "--target", "--angle", "--hour")
_DIGITS = frozenset("0123456789.")


def add_render(commands: Any) -> None:
    """Add the command to a parser's commands."""
    parser = commands.add_parser(
        "render",
        help="render a texture grammar",
        description="Render a texture grammar, seen straight on unless an eye is given.",
    )
    parser.add_argument("grammar", metavar="GRAMMAR.txt", help="the grammar")
    parser.add_argument(
        "--size", type=_size, required=True, metavar="WxH", help="of the façade, metres: 12x9"
    )
    parser.add_argument("--pixels", type=_pixels, default=(800, 600), metavar="WxH", help="default: 800x600")
    parser.add_argument("--seed", type=_pair, default=(0.0, 0.0), metavar="X,Y", help="default: 0,0")
    parser.add_argument("--start", metavar="RULE", help="default: S, else the first rule")
    parser.add_argument("--backend", choices=_BACKENDS, help="default: the best that works here")
    parser.add_argument(
        "--antialias", choices=_ANTIALIAS, default="adaptive", help="of the picture; default: adaptive"
    )
    parser.add_argument("--tiles", metavar="DIR", help="a folder of images to use beside the tiles that ship")
    parser.add_argument(
        "--eye", type=_triple, metavar="X,Y,Z", help="look from here, metres from the lower left corner"
    )
    parser.add_argument(
        "--target", type=_pair, metavar="X,Y", help="to this point of the façade; default: its middle"
    )
    parser.add_argument(
        "--angle", type=_angle, default=50.0, metavar="DEGREES", help="width of view; default: 50"
    )
    parser.add_argument("--hour", type=_hour, metavar="HOUR", help="in the light of this hour, 0 to 24")
    parser.add_argument("--out", metavar="FILE.png", help="write the picture")
    parser.add_argument("--rules", metavar="FILE.npy", help="write which rule is seen at each pixel (int32)")
    parser.set_defaults(parser=parser)


def joined(arguments: Sequence[str]) -> list[str]:
    """``--seed -1,2`` as ``--seed=-1,2``, which argparse would take for an option of its own."""
    found: list[str] = []
    for argument in arguments:
        if found and found[-1] in _NUMBERS and argument[:1] == "-" and argument[1:2] in _DIGITS:
            found[-1] += f"={argument}"
        else:
            found.append(argument)
    return found


def render_command(options: argparse.Namespace) -> int:
    """Run the command; returns the exit status."""
    if not (options.out or options.rules):
        options.parser.error("nothing to write: give --out or --rules")
    if options.out and options.rules and os.path.realpath(options.out) == os.path.realpath(options.rules):
        options.parser.error("--out and --rules: expected two files; found one")
    from .render.backends import BackendError
    from .render.texture.painters import choose_painter
    from .render.texture.picture import render_texture, rules_seen

    grammar = _grammar(Path(options.grammar), _tiles(options.tiles))
    try:
        choose_painter(options.backend)
    except BackendError as error:
        print(error, file=sys.stderr)
        return 1
    given = {
        "size": options.size,
        "pixels": options.pixels,
        "seed": options.seed,
        "start": options.start,
        "camera": _sight(options),
        "backend": options.backend,
    }
    files: list[tuple[str, str | bytes]] = []
    if options.out:
        files.append(
            (options.out, render_texture(grammar, **given, antialias=options.antialias, hour=options.hour))
        )
    if options.rules:
        import numpy as np

        stream = io.BytesIO()
        np.save(stream, rules_seen(grammar, **given))
        files.append((options.rules, stream.getvalue()))
    write_together(files)
    return 0


def _tiles(folder: str | None) -> Tiles | None:
    if folder is None:
        return None
    from .render.tiles import TileSet

    return TileSet.from_folder(folder)


def _grammar(path: Path, tiles: Tiles | None) -> Grammar:
    from .render.texture import Grammar

    text = read_text(path, "a grammar")
    try:
        return Grammar.parse(text, tiles)
    except GrammarError as error:
        raise GrammarError(replace(fault, place=str(path)) for fault in error.faults) from None


def _sight(options: argparse.Namespace) -> Sight | None:
    if options.eye is None:
        return None
    from .render.texture.view import Sight

    if options.eye[2] <= 0:
        options.parser.error("argument --eye: expected an eye in front of the façade, its z above 0")
    width, height = options.size
    target = options.target or (width / 2, height / 2)
    return Sight.from_eye(options.eye, target, options.size, options.pixels, options.angle)


# Arguments --------------------------------------------------------------------------------------------------


def _numbers(text: str, signs: str, count: int) -> tuple[float, ...]:
    for sign in signs[1:]:
        text = text.replace(sign, signs[0])
    words = text.split(signs[0])
    try:
        values = tuple(float(word) for word in words)
    except ValueError:
        return ()
    return values if len(values) == count and all(map(isfinite, values)) else ()


def _size(text: str) -> tuple[float, float]:
    """A façade's width and height."""
    values = _numbers(text, "xX×", 2)
    if not values or min(values) <= 0 or max(values) >= 1e5:
        raise argparse.ArgumentTypeError(
            f"expected a width and a height in metres, such as 12x9; found {text!r}"
        )
    return values[0], values[1]


def _pixels(text: str) -> tuple[int, int]:
    """A picture's width and height."""
    values = _numbers(text, "xX×", 2)
    if (
        not values
        or min(values) < 1
        or any(value % 1 for value in values)
        or values[0] * values[1] > _MOST_PIXELS
    ):
        raise argparse.ArgumentTypeError(
            f"expected a width and a height in pixels, such as 800x600, at most {_MOST_PIXELS} in all; found {text!r}"
        )
    return int(values[0]), int(values[1])


def _pair(text: str) -> tuple[float, float]:
    """Two numbers."""
    values = _numbers(text, ",", 2)
    if not values or max(map(abs, values)) >= 2**53:
        raise argparse.ArgumentTypeError(f"expected two numbers, such as 1,2; found {text!r}")
    return values[0], values[1]


def _triple(text: str) -> tuple[float, float, float]:
    """Three numbers."""
    values = _numbers(text, ",", 3)
    if not values:
        raise argparse.ArgumentTypeError(f"expected three numbers, such as 6,1.7,10; found {text!r}")
    return values[0], values[1], values[2]


def _hour(text: str) -> float:
    """An hour of the day."""
    values = _numbers(text, ",", 1)
    if not values or not 0 <= values[0] <= 24:
        raise argparse.ArgumentTypeError(f"expected an hour from 0 to 24, such as 9.5; found {text!r}")
    return values[0]


def _angle(text: str) -> float:
    """Degrees."""
    values = _numbers(text, ",", 1)
    if not values or not 1 <= values[0] <= 170:
        raise argparse.ArgumentTypeError(f"expected degrees from 1 to 170; found {text!r}")
    return values[0]
