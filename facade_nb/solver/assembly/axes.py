"""From the best candidate of an axis to its layout (docs/problem.md)."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf

from ...design.model import Design
from ..alignment.pricing import terms_of
from ..budget import Clock
from ..model.layout import AxisLayout, GroupLayout, PlacedLetter, RowLayout
from ..model.letters import Letter
from ..model.problem import AxisProblem
from ..model.sizing import Sizing
from ..selection.axis import AxisSearch, Best, Solved
from ..words.instances import MAX_SPELLED

__all__ = ["axis_layout", "axis_warnings", "cut_warnings"]


def axis_layout(design: Design, problem: AxisProblem, best: Best, answer: Solved) -> AxisLayout:
    """Every letter at its place, what it costs, and whether that is proven."""
    layers: dict[str, list[str]] = {}
    for layer in design.stack:
        layers.setdefault(layer.along(problem.axis).group, []).append(layer.name)
    groups: dict[str, GroupLayout] = {}
    for g, (name, patterns) in enumerate(problem.groups):
        group, (priced, k) = answer.groups[g], answer.parts[g]
        structure, placement = priced.structure[k], answer.sized.placements[g]
        placed: dict[int, tuple[tuple[PlacedLetter, ...], ...]] = {}
        for b, (band, intervals) in enumerate(zip(group.bands, placement, strict=True)):
            letters, places = band.letters, iter(intervals)
            placed[b] = tuple(
                [
                    tuple([_placed(letters[n], n, *next(places)) for n in column[b].letters])
                    for column in structure
                ]
            )
        rows = [
            RowLayout(layers[name][i], pattern, placed[group.band_of[i]])
            for i, pattern in enumerate(patterns)
        ]
        groups[name] = GroupLayout(
            priced.omegas[k],
            answer.sized.boundaries[g],
            tuple(rows),
            terms_of(group, structure, priced.pieces[k]),
        )
    gap = max(0.0, answer.cost - best.bound) if best.bound < inf else 0.0
    proven = best.complete and best.whole and gap <= 1e-6
    return AxisLayout(
        answer.cost,
        0.0 if proven else gap,
        answer.sized.deviation,
        proven,
        dict(answer.sized.sizes),
        groups,
        Sizing(answer.sized.system, answer.sized.solution),
        dict(answer.candidate.words),
    )


def _placed(letter: Letter, index: int, start: float, end: float) -> PlacedLetter:
    return PlacedLetter(letter.symbol, start, end, letter.mirrored, letter.transparent, index)


def axis_warnings(walk: AxisSearch, answer: Solved) -> Iterator[str]:
    """What there is to say about an answer."""
    for (name, _), group in zip(walk.problem.groups, answer.groups, strict=True):
        if group.waived and any(band.soft for band in group.bands):
            yield (
                f"No symbol of group {name!r} on {walk.problem.axis} is opaque, so nothing need stand behind its "
                "non-opaque letters."
            )
    for name, found in walk.found.items():
        for counter in found.endless:
            yield (
                f"Counter {counter!r} in pattern {name!r} repeats nothing that has a size; "
                f"it was tried up to {answer.candidate.counters.get(counter, 0)} only."
            )


def cut_warnings(walk: AxisSearch, best: Best, clock: Clock) -> Iterator[str]:
    """What was left out, so that an answer is not proven to be the best."""
    axis = walk.problem.axis
    if not best.complete:
        if clock.asked:
            reason = "it was stopped"
        elif clock.full:
            reason = "it took too much memory"
        elif clock.over:
            reason = "the time was over"
        else:
            reason = "there are too many alignments"
        yield f"The search on {axis} was cut short, as {reason}: there may be a better layout."
    for name, found in walk.found.items():
        if found.left == inf:
            continue
        what = (
            f"words of more than {MAX_SPELLED:,} letters were left out"
            if found.clipped
            else "some words were left out, for there are too many"
        )
        miss = f"; they miss the canvas by {found.left:.3g} m or more" if found.left > 0 else ""
        yield f"Pattern {name!r} on {axis}: {what}{miss}; one of them may be better."
