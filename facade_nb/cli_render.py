"""``python -m facade_nb render GRAMMAR.txt``: a picture of a texture grammar (docs/texture.md)."""

from __future__ import annotations

import argparse
import io
import re
from collections.abc import Sequence
from dataclasses import replace
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .cli_ending import say
from .cli_files import Output, Source, write
from .design.errors import GrammarError, quoted
from .design.inputs import read_text

if TYPE_CHECKING:
    from .render.texture.atlas import Tiles
    from .render.texture.grammar import Grammar
    from .render.texture.view import Sight

__all__ = ["add_render", "hour_of", "joined", "pixels_of", "render_command"]

_FAR, _NEAR = 1e6, 1e-3  # of an eye, metres
_NOTES = 5
_BACKENDS = ("cpu", "osmesa", "egl")
_ANTIALIAS = ("none", "adaptive", "supersample")
_MOST_PIXELS, _LONGEST = 1 << 26, 1 << 16
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_NUMBERS = ("--size", "--pixels", "--seed", "--eye", "--target", "--angle", "--hour")
_DIGITS = frozenset("0123456789.")


class _Tiles(Source):
    """A folder of images."""

    __slots__ = ()

    @staticmethod
    def suffixes() -> Sequence[str]:
        """Of images."""
        from .render.tiles.folder import SUFFIXES

        return SUFFIXES


def add_render(commands: Any) -> None:
    """Add the command to a parser's commands."""
    parser = commands.add_parser(
        "render",
        help="render a texture grammar",
        description="Render a texture grammar, seen straight on unless an eye is given.",
    )
    parser.add_argument("grammar", type=Source, metavar="GRAMMAR.txt", help="the grammar")
    parser.add_argument(
        "--size", type=_size, required=True, metavar="WxH", help="of the façade, metres: 12x9"
    )
    parser.add_argument(
        "--pixels", type=pixels_of, default=(800, 600), metavar="WxH", help="default: 800x600"
    )
    parser.add_argument("--seed", type=_pair, default=(0.0, 0.0), metavar="X,Y", help="default: 0,0")
    parser.add_argument("--start", metavar="RULE", help="default: S, else the first rule")
    parser.add_argument("--backend", choices=_BACKENDS, help="default: the best that works here")
    parser.add_argument(
        "--antialias", choices=_ANTIALIAS, default="adaptive", help="of the picture; default: adaptive"
    )
    parser.add_argument(
        "--tiles", type=_Tiles, metavar="DIR", help="a folder of images to use beside the tiles that ship"
    )
    parser.add_argument(
        "--eye", type=_triple, metavar="X,Y,Z", help="look from here, metres from the lower left corner"
    )
    parser.add_argument(
        "--target", type=_target, metavar="X,Y", help="to this point of the façade; default: its middle"
    )
    parser.add_argument(
        "--angle", type=_angle, default=50.0, metavar="DEGREES", help="width of view; default: 50"
    )
    parser.add_argument("--hour", type=hour_of, metavar="HOUR", help="in the light of this hour, 0 to 24")
    parser.add_argument(
        "--relief", action="store_true", help="show how deep cornices, reveals and ornaments are"
    )
    parser.add_argument(
        "--out", type=Output, metavar="FILE.png", help="write the picture; -: standard output"
    )
    parser.add_argument(
        "--rules",
        type=Output,
        metavar="FILE.npy",
        help="write which rule is seen at each pixel (int32); -: standard output",
    )
    parser.set_defaults(parser=parser, run=render_command)


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
    if options.out is None and options.rules is None:
        options.parser.error("nothing to write: give --out or --rules")
    from .render.backends import BackendError
    from .render.texture.painters import choose_painter
    from .render.texture.picture import render_texture, rules_seen

    grammar = _grammar(Path(options.grammar), _tiles(options.tiles))
    try:
        choose_painter(options.backend)
    except BackendError as error:
        say(error)
        return 1
    given = {
        "size": options.size,
        "pixels": options.pixels,
        "seed": options.seed,
        "start": options.start,
        "camera": _sight(options),
        "backend": options.backend,
    }
    files: list[tuple[Output, str | bytes]] = []
    if options.out is not None:
        looks = {"antialias": options.antialias, "hour": options.hour, "relief": options.relief}
        files.append((options.out, render_texture(grammar, **given, **looks)))
    if options.rules is not None:
        import numpy as np

        stream = io.BytesIO()
        np.save(stream, rules_seen(grammar, **given))
        files.append((options.rules, stream.getvalue()))
    write(files)
    return 0


def _tiles(folder: str | None) -> Tiles | None:
    if folder is None:
        return None
    from .render.tiles import TileSet

    tiles = TileSet.from_folder(folder)
    for fault in tiles.faults[:_NOTES]:
        say(f"Note: {fault}")
    if len(tiles.faults) > _NOTES:
        say(f"Note: … and {len(tiles.faults) - _NOTES:,} more files of that folder")
    return tiles


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

    if options.eye[2] < _NEAR:
        options.parser.error(
            f"argument --eye: expected an eye in front of the façade, its z at least {_NEAR:g}"
        )
    width, height = options.size
    target = options.target or (width / 2, height / 2)
    return Sight.from_eye(options.eye, target, options.size, options.pixels, options.angle)


# Arguments --------------------------------------------------------------------------------------------------


def _numbers(text: str, signs: str, count: int) -> tuple[float, ...]:
    for sign in signs[1:]:
        text = text.replace(sign, signs[0])
    words = [word.strip() for word in text.split(signs[0])]
    if len(words) != count or not all(map(_NUMBER.fullmatch, words)):
        return ()
    values = tuple(map(float, words))
    return values if all(map(isfinite, values)) else ()


def _size(text: str) -> tuple[float, float]:
    """A façade's width and height."""
    values = _numbers(text, "xX×", 2)
    if not values or min(values) < 1e-3 or max(values) >= 1e5:
        raise argparse.ArgumentTypeError(
            "expected a width and a height in metres, such as 12x9, from 0.001 to below 100000; "
            f"found {quoted(text)}"
        )
    return values[0], values[1]


def pixels_of(text: str) -> tuple[int, int]:
    """A picture's width and height."""
    values = _numbers(text, "xX×", 2)
    if (
        not values
        or min(values) < 1
        or any(value % 1 for value in values)
        or max(values) > _LONGEST
        or values[0] * values[1] > _MOST_PIXELS
    ):
        raise argparse.ArgumentTypeError(
            f"expected a width and a height in pixels, such as 800x600, each at most {_LONGEST}, and at most "
            f"{_MOST_PIXELS} in all; found {quoted(text)}"
        )
    return int(values[0]), int(values[1])


def _pair(text: str) -> tuple[float, float]:
    """Two numbers."""
    values = _numbers(text, ",", 2)
    if not values or max(map(abs, values)) >= 2**53:
        raise argparse.ArgumentTypeError(f"expected two numbers, such as 1,2; found {quoted(text)}")
    return values[0], values[1]


def _target(text: str) -> tuple[float, float]:
    """A point of the façade's plane."""
    values = _numbers(text, ",", 2)
    if not values or max(map(abs, values)) > _FAR:
        raise argparse.ArgumentTypeError(
            f"expected two numbers within ±{_FAR:.0f} m, such as 6,4; found {quoted(text)}"
        )
    return values[0], values[1]


def _triple(text: str) -> tuple[float, float, float]:
    """Three numbers."""
    values = _numbers(text, ",", 3)
    if not values or max(map(abs, values)) > _FAR:
        raise argparse.ArgumentTypeError(
            f"expected three numbers within ±{_FAR:.0f} m, such as 6,1.7,10; found {quoted(text)}"
        )
    return values[0], values[1], values[2]


def hour_of(text: str) -> float:
    """An hour of the day."""
    values = _numbers(text, ",", 1)
    if not values or not 0 <= values[0] <= 24:
        raise argparse.ArgumentTypeError(f"expected an hour from 0 to 24, such as 9.5; found {quoted(text)}")
    return values[0]


def _angle(text: str) -> float:
    """Degrees."""
    values = _numbers(text, ",", 1)
    if not values or not 1 <= values[0] <= 170:
        raise argparse.ArgumentTypeError(f"expected degrees from 1 to 170; found {quoted(text)}")
    return values[0]
