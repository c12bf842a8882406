"""Words: what each pattern can write, to scale against canvas ± μ, kept or dropped and why (the paper's Figure 7)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from traitlets import Float

from ...solver.events import AxisPosed, CandidateJudged, LetterNote, WordJudged
from .sheet import ACCENT, BAD, GOOD, MUTED, SECOND, Sheet, shortened, spelled
from .timeline import timeline
from .view import TraceView

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["WordsView"]

_ROWS, _LETTERS, _ALL = 14, 120, 900
"""So many words of a pattern are drawn in the static form, about so many letters, and so many of all patterns."""
_ROW, _LEFT, _SCALE, _RIGHT = 22.0, 210.0, 420.0, 150.0

_LEGEND = (
    "Metres. Orange line: the canvas; shaded: canvas ± μ; dashed: transparent, or of free size, then it takes what "
    "is left. Bold: taken."
)


class WordsView(TraceView):
    """The words of each pattern, with the values of their counters and the alternatives taken.

    Parameters
    ----------
    tolerance
        μ in metres at which words are looked at, at most the solver's own; None: the solver's.
    step
        Unsized symbols are sampled at multiples of this many metres, as in the paper's Figure 7; None: their
        sizes are free.
    """

    _shows = "words"
    _needs = ("words",)

    tolerance = Float(None, allow_none=True, min=0.0).tag(sync=True)
    step = Float(None, allow_none=True, min=0.0).tag(sync=True)

    @property
    def frame(self) -> pd.DataFrame:
        """The words as a table: `Trace.words`."""
        return self.model.trace.words()

    def to_html(self) -> str:
        """Every pattern's words drawn to scale, as the solver judged them."""
        trace = self.model.trace
        sheet = Sheet(_LEFT + _SCALE + _RIGHT)
        hues: dict[str, int] = timeline(trace)["symbols"]
        taken = {
            (e.axis, name): word
            for e in trace.of_kind(CandidateJudged)
            if e.fate == "best"
            for name, word in e.words.items()
        }
        room = min(_LETTERS, _ALL // max(1, len(taken)))
        for posed in trace.of_kind(AxisPosed):
            told = trace.of_kind(WordJudged, posed.axis)
            last = told[-1].tolerance if told else 0.0
            for name in dict.fromkeys(name for group in posed.groups for name in group.patterns):
                own = [e for e in told if e.pattern == name and e.tolerance == last]
                if own:
                    _draw(sheet, posed, name, own, hues, taken.get((posed.axis, name), ""), room)
        sheet.height += 8
        sheet.text(12, sheet.height, _LEGEND, fill=MUTED, size=11)
        sheet.height += 10
        return sheet.image(f"Words of {self.model.name}")


def _draw(
    sheet: Sheet,
    posed: AxisPosed,
    name: str,
    own: list[WordJudged],
    hues: dict[str, int],
    taken: str,
    room: int,
) -> None:
    chosen = _chosen(own, taken, room)
    scale = _SCALE / max(own[0].high, *(e.size for e in chosen)) / 1.02
    sheet.height += 22
    bounds = f"{'' if own[0].low is None else f'{max(own[0].low, 0):.4g} ≤ '}|w| ≤ {own[0].high:.4g} m"
    sheet.text(12, sheet.height, f"{posed.axis}: {name}", size=13, bold=True)
    sheet.text(_LEFT + _SCALE, sheet.height, bounds, fill=MUTED, anchor="end")
    sheet.height += 8
    for e in chosen:
        _draw_word(sheet, posed.canvas, scale, e, hues, taken=e.word == taken)
    if len(own) > len(chosen):
        sheet.height += 16
        sheet.text(12, sheet.height - 4, f"… {len(own) - len(chosen)} more", fill=MUTED)
    sheet.height += 10


def _chosen(own: list[WordJudged], taken: str, room: int) -> list[WordJudged]:
    """The words that are drawn: where they are too many, that which was taken, and those near it or the canvas."""
    middle = next((e.size for e in own if e.word == taken), own[0].high - own[0].tolerance)
    near = sorted(own, key=lambda e: (e.word != taken, not e.kept, abs(e.size - middle)))
    found: set[int] = set()
    for e in near[:_ROWS]:
        if found and room < len(e.letters):
            break
        room -= len(e.letters)
        found.add(id(e))
    return [e for e in own if id(e) in found]


def _draw_word(
    sheet: Sheet, canvas: float, scale: float, e: WordJudged, hues: dict[str, int], *, taken: bool
) -> None:
    y = sheet.height
    values = ", ".join(f"{name} = {value}" for name, value in e.counters.items())
    sheet.text(12, y + 15, values, fill=MUTED, mono=True, size=11)
    sheet.text(96, y + 15, shortened(spelled(e.letters), 16), mono=True, size=11, bold=taken)
    low = max(e.low, 0.0) if e.low is not None else 0.0
    sheet.box(_LEFT + low * scale, y, (e.high - low) * scale, _ROW, fill=SECOND, opacity=0.1)
    at = 0.0
    for letter, size in zip(e.letters, _sizes(e, canvas), strict=True):
        sheet.letter(
            _LEFT + at * scale, y + 3, size * scale, _ROW - 6, letter, hues.get(letter.symbol, 0),
            free=letter.size is None, dim=not e.kept,
        )  # fmt: skip
        at += size
    sheet.line(_LEFT + canvas * scale, y, _LEFT + canvas * scale, y + _ROW, stroke=ACCENT, dash="3 2")
    sheet.text(_LEFT + _SCALE + 8, y + 15, f"{e.size:.4g}{' +' if any(map(_is_free, e.letters)) else ''}")
    sheet.text(
        _LEFT + _SCALE + 58,
        y + 15,
        f"{'✓' if e.kept else '✕'} {e.reason}{', taken' if taken else ''}",
        fill=GOOD if e.kept else BAD,
        bold=taken,
    )
    sheet.height += _ROW


def _sizes(e: WordJudged, canvas: float) -> list[float]:
    """Sizes to draw: letters without one share what is left of the canvas."""
    free = sum(_is_free(letter) for letter in e.letters)
    left = max(0.0, canvas - e.size) / free if free else 0.0
    return [left if letter.size is None else letter.size for letter in e.letters]


def _is_free(letter: LetterNote) -> bool:
    return letter.size is None
