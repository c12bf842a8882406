"""Relief mapping on and off: milliseconds and texels read, of a façade seen three ways and of the town's street."""

from __future__ import annotations

from facade_nb.render import Grammar
from facade_nb.render.pipeline.device import choose_device
from facade_nb.render.pipeline.frame import Frame, Looks
from facade_nb.render.pipeline.renderer import renderer_of
from facade_nb.render.texture.daytime import Daytime
from facade_nb.render.texture.gl import GlPainter
from facade_nb.render.texture.view import Sight
from facade_nb.render.town import Town

from .bench_texture import timed
from .textures import FULL, SIZE

__all__ = ["main"]

PIXELS = (1024, 768)
SIGHTS = {
    "straight on": Sight.flat(SIZE, PIXELS),
    "slanted": Sight.from_eye((1.0, 1.7, 4.0), (7.0, 4.5), SIZE, PIXELS, 65.0),
    "along the wall": Sight.from_eye((1.0, 1.7, 1.2), (9.0, 3.0), SIZE, PIXELS, 65.0),
}
RUNS = 5
BUILDINGS = 2000


def main() -> None:
    """Print the tables."""
    card = choose_device()
    cards = {card.name: card}
    print(f"{card.name}: {card.renderer}")
    grammar = Grammar.parse(FULL)
    questions = {
        False: grammar.question(SIZE, (1.0, 2.0)),
        True: grammar.question(SIZE, (1.0, 2.0), relief=True),
    }
    questions[True] = questions[True]._replace(sun=Daytime.at(10).towards)
    print(f"\nTiles: {questions[False].atlas.pixels.nbytes / 1e6:.1f} MB, "
          f"with heights {questions[True].atlas.pixels.nbytes / 1e6:.1f} MB")  # fmt: skip
    print("\n" + _row(["façade", "backend", "relief", "ms", "CPU ms", "to none", "fetches a pixel"]))
    print(_row(["---"] * 7))
    for view, sight in SIGHTS.items():
        for name, painter in cards.items():
            least = 0.0
            for relief, question in questions.items():
                wall, spent = timed(lambda: painter.paint(question, sight, mips=True))  # noqa: B023
                least = least or spent
                fetches = painter.paint(question, sight, mips=True, count=True).fetches
                assert fetches is not None
                row = [view, name, _said(relief), f"{wall:.0f}", f"{spent:.0f}", f"{spent / least:.2f}"]
                print(_row([*row, f"{fetches.mean():.1f}"]))
    _town(cards)


def _town(cards: dict[str, GlPainter]) -> None:
    town = Town.generate(BUILDINGS, 1)
    print(f"\nTown of {BUILDINGS:,} buildings, by the pipeline; tiles: {_megabytes(town, False)} MB, "
          f"with heights {_megabytes(town, True)} MB")  # fmt: skip
    columns = ["view", "backend", "relief", "frame, ms", "frame, CPU ms", "to none", "grammar pass, ms"]
    print("\n" + _row(columns))
    print(_row(["---"] * len(columns)))
    for name, painter in cards.items():
        with renderer_of(town.scene, painter) as renderer:
            for view in ("distance", "street", "close-up"):
                least = 0.0
                for relief in (False, True):
                    frustum = town.viewpoint(view).frustum(PIXELS)
                    frame = Frame(town.scene, frustum, Daytime.at(14.5), PIXELS, Looks(relief=relief))
                    wall, spent = timed(lambda: renderer.draw(frame))  # noqa: B023
                    least = least or spent
                    passes: dict[str, float] = {}
                    for _ in range(RUNS):
                        renderer.draw(
                            frame,
                            told=lambda k, s: passes.update({k: min(s, passes.get(k, s))}),  # noqa: B023
                        )
                    row = [view, name, _said(relief), f"{wall:.0f}", f"{spent:.0f}", f"{spent / least:.2f}"]
                    print(_row([*row, f"{1000 * passes['grammar']:.0f}"]))


def _megabytes(town: Town, relief: bool) -> str:
    return f"{town.grammar.atlas(relief=relief).pixels.nbytes / 1e6:.1f}"


def _row(cells: list[str]) -> str:
    """A line of a table in Markdown."""
    return f"| {' | '.join(cells)} |"


def _said(relief: bool) -> str:
    return "on" if relief else "off"
