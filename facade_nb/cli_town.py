"""``python -m facade_nb town``: a town as stills, buffers, frames, figures (docs/towns.md)."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .cli_ending import say
from .cli_files import Folder, Output, Source, write
from .cli_render import hour_of, pixels_of
from .design.errors import DesignError, Fault, quoted

if TYPE_CHECKING:
    from .render.pipeline.renderer import Renderer
    from .render.pipeline.viewpoint import CameraPath, Viewpoint
    from .render.town import Town

__all__ = ["add_town", "town_command"]

_VIEWS = ("distance", "street", "close-up")
_MOST = 100_000
_SAMPLES = 4


def add_town(commands: Any) -> None:
    """Add the command to a parser's commands."""
    parser = commands.add_parser(
        "town",
        help="render a town",
        description="Render a town: one that is made from a seed, or one of real footprints.",
    )
    source = parser.add_mutually_exclusive_group()
    source.add_argument("--buildings", type=_buildings, default=20_000, metavar="N", help="default: 20000")
    source.add_argument("--footprints", type=Source, metavar="F.geojson", help="real footprints; also as .gz")
    parser.add_argument("--seed", type=_seed, default=1, metavar="N", help="default: 1")
    parser.add_argument("--view", choices=_VIEWS, default="street", help="default: street")
    parser.add_argument("--hour", type=hour_of, default=14.5, metavar="HOUR", help="0 to 24; default: 14.5")
    parser.add_argument(
        "--pixels", type=pixels_of, default=(1024, 768), metavar="WxH", help="default: 1024x768"
    )
    parser.add_argument(
        "--relief",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="cornices, reveals and ornaments as deep as they are; default: with relief",
    )
    parser.add_argument(
        "--samples", type=_samples, default=1, metavar="N", help="N × N points a pixel, 1 to 4; default: 1"
    )
    parser.add_argument("--backend", choices=("osmesa", "egl"), help="default: the best that works here")
    parser.add_argument(
        "--buffers",
        type=Folder,
        metavar="DIR",
        help="write every buffer of the pipeline as a picture into DIR",
    )
    parser.add_argument("--stats", type=Output, metavar="F.json", help="write figures; -: standard output")
    parser.add_argument("--out", type=Output, metavar="F.png", help="write the picture; -: standard output")
    parser.add_argument(
        "--path", type=Source, metavar="F.json", help="a camera path, for --frames and --animation"
    )
    parser.add_argument("--rate", type=_rate, default=25.0, metavar="N", help="frames a second; default: 25")
    parser.add_argument(
        "--frames", type=Folder, metavar="DIR", help="write the frames along the path into DIR"
    )
    parser.add_argument(
        "--animation", type=Output, metavar="F.webp", help="write them as one file: WebP, PNG or GIF"
    )
    parser.set_defaults(parser=parser, run=town_command)


def town_command(options: argparse.Namespace) -> int:
    """Run the command; returns the exit status."""
    if not any((options.out, options.stats, options.buffers, options.frames, options.animation)):
        options.parser.error("nothing to write: give --out, --stats, --buffers, --frames or --animation")
    if (options.frames or options.animation) and not options.path:
        options.parser.error("--frames and --animation need a --path")
    from .render.backends import BackendError
    from .render.pipeline.device import choose_device
    from .render.pipeline.renderer import renderer_of

    try:
        device = choose_device(options.backend)
    except BackendError as error:
        say(error)
        return 1
    path = _path(options.path) if options.path else None
    seconds: dict[str, float] = {}
    begin = time.perf_counter()
    town = _town(options)
    seconds["generate"] = time.perf_counter() - begin
    for reason, count in town.plan.left_out.items():
        say(f"Note: {count:,} left out: {reason}")
    files: list[tuple[Output, str | bytes]] = []
    begin = time.perf_counter()
    with renderer_of(town.scene, device) as renderer:
        place = town.viewpoint(options.view)
        files += _stills(options, renderer, place, seconds, begin)
        if path is not None:
            files += _frames(options, renderer, path)
    if options.stats:
        stats = {**town.stats(), "seconds": {name: round(value, 4) for name, value in seconds.items()}}
        files.append((options.stats, json.dumps(stats, indent=2) + "\n"))
    for folder in (options.buffers, options.frames):
        if folder:
            Path(folder).mkdir(parents=True, exist_ok=True)
    write(files)
    return 0


def _town(options: argparse.Namespace) -> Town:
    from .render.town import Town

    tell = _teller("town")
    if options.footprints:
        return Town.from_geojson(Path(options.footprints), options.seed, progress=tell)
    return Town.generate(options.buildings, options.seed, progress=tell)


def _stills(
    options: argparse.Namespace, renderer: Renderer, place: Viewpoint, seconds: dict[str, float], begin: float
) -> list[tuple[Output, str | bytes]]:
    from .render.pipeline.frame import Looks
    from .render.pipeline.stills import buffers_of, still
    from .render.texture.daytime import Daytime

    daytime, frustum = Daytime.at(options.hour), place.frustum(options.pixels)
    looks = Looks(relief=options.relief)
    found: list[tuple[Output, str | bytes]] = []
    if options.out or options.stats:
        pixels = still(renderer, frustum, daytime, options.pixels, looks, options.samples)
        seconds["first_frame"] = time.perf_counter() - begin
        if options.out:
            found.append((options.out, _png(pixels)))
    if options.stats:
        again = time.perf_counter()
        still(renderer, frustum, daytime, options.pixels, looks, options.samples)
        seconds["frame"] = time.perf_counter() - again
    if options.buffers:
        for name, values in buffers_of(renderer, frustum, daytime, options.pixels, looks).items():
            found.append((Output(Path(options.buffers) / f"{name}.png"), _png(values)))
    return found


def _frames(
    options: argparse.Namespace, renderer: Renderer, path: CameraPath
) -> list[tuple[Output, str | bytes]]:
    from PIL import Image

    from .render.pipeline.frame import Looks
    from .render.pipeline.stills import still
    from .render.texture.daytime import Daytime

    daytime, looks, tell = Daytime.at(options.hour), Looks(relief=options.relief), _teller("frames")
    count = max(1, round(path.seconds * options.rate))
    found: list[tuple[Output, str | bytes]] = []
    images = []
    for number in range(count):
        frustum = path.at(number / options.rate).frustum(options.pixels)
        pixels = still(renderer, frustum, daytime, options.pixels, looks, options.samples)
        if options.frames:
            found.append((Output(Path(options.frames) / f"{number:05d}.png"), _png(pixels)))
        if options.animation:
            images.append(Image.fromarray(pixels))
        tell((number + 1) / count)
    if options.animation:
        stream = BytesIO()
        kind = {".gif": "GIF", ".png": "PNG"}.get(Path(options.animation).suffix.lower(), "WEBP")
        images[0].save(
            stream, kind, save_all=True, append_images=images[1:], duration=round(1000 / options.rate), loop=0
        )
        found.append((options.animation, stream.getvalue()))
    return found


def _png(pixels: Any) -> bytes:
    from PIL import Image

    stream = BytesIO()
    Image.fromarray(pixels).save(stream, "PNG")
    return stream.getvalue()


def _path(source: str) -> CameraPath:
    from .design.inputs import read_text
    from .render.pipeline.viewpoint import CameraPath

    text = read_text(Path(source), "a camera path")
    try:
        return CameraPath.from_dict(json.loads(text))
    except (ValueError, RecursionError) as error:
        raise DesignError(Fault(str(source), f"expected a camera path; {error}")) from None


def _teller(what: str) -> Callable[..., None]:
    """Tells progress where somebody looks on."""
    shown = sys.stderr is not None and sys.stderr.isatty()

    def tell(part: float, stage: str = "") -> None:
        if shown:
            end = "\n" if part >= 1 else ""
            print(f"\r{what}: {stage or ''} {100 * part:3.0f} %  ", end=end, file=sys.stderr, flush=True)

    return tell


# Arguments --------------------------------------------------------------------------------------------------


def _whole(text: str, least: int, most: int) -> int:
    try:
        value = int(text) if text.strip().isascii() and text.strip().isdigit() else -1
    except ValueError:
        value = -1
    if not least <= value <= most:
        raise argparse.ArgumentTypeError(
            f"expected a whole number from {least} to {most}; found {quoted(text)}"
        )
    return value


def _buildings(text: str) -> int:
    """How many buildings."""
    return _whole(text, 1, _MOST)


def _seed(text: str) -> int:
    """A seed."""
    return _whole(text, 0, 2**31 - 1)


def _samples(text: str) -> int:
    """Points across and up in a pixel."""
    return _whole(text, 1, _SAMPLES)


def _rate(text: str) -> float:
    """Frames a second."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.1 <= value <= 240:
        raise argparse.ArgumentTypeError(f"expected frames a second, from 0.1 to 240; found {quoted(text)}")
    return value
