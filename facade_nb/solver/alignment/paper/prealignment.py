"""Prealignment of control patterns (the paper's 5.2, *Heuristics and Optimizations*).

A word of a pattern with a substitution is a control word, some of whose letters have been replaced by contents. The
control word is much shorter: `f d f` for `f A B A B A f`. The same control pattern often serves several layers, and
then their control words are one. Aligning them first is cheap; and the nodes between the columns of that alignment
guide that of the whole words, so that only what is inside a control column is left to be aligned.

That the best alignment of the whole words passes these nodes is likely, not certain. See `guides` for what is made
of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

from ...model.letters import Letter
from ..bands import Band
from ..group import Group, make_group
from ..observer import Places
from ..pricing import Structure
from .guides import Guide

__all__ = ["control_group", "control_guides"]


@dataclass(frozen=True, slots=True)
class _Control:
    """A control word: its letters, and at which letter of the whole word each begins."""

    letters: tuple[Letter, ...]
    begins: tuple[int, ...]


def control_word(band: Band) -> _Control:
    """Undo the substitution: what came in as one instance is one letter again, as long as its content."""
    letters: list[Letter] = []
    begins: list[int] = []
    origins = band.origins[0]
    at = 0
    for origin, run in groupby(range(len(band.letters)), key=lambda i: origins[i]):
        own = [band.letters[i] for i in run]
        if origin is None or len(own) == 1 or any(a.size is None or a.transparent for a in own):
            letters.extend(own)
            begins.extend(range(at, at + len(own)))
        else:
            letters.append(
                Letter(
                    origin[0],
                    sum(a.size or 0.0 for a in own),
                    opaque=all(a.opaque for a in own),
                    attached=own[0].attached or own[-1].attached,
                    unoccludable=any(a.unoccludable for a in own),
                )
            )
            begins.append(at)
        at += len(own)
    return _Control(tuple(letters), (*begins, at))


def control_group(group: Group) -> Group | None:
    """The group of control words; None where nothing was substituted by more than one letter."""
    words = [control_word(band) for band in group.bands]
    if all(len(word.letters) == len(band.letters) for word, band in zip(words, group.bands, strict=True)):
        return None
    return make_group(
        [words[b].letters for b in group.band_of],
        group.canvas,
        group.tolerance,
        group.objective,
        cuts=all(band.cuts for band in group.bands),
        free=frozenset().union(*(band.free for band in group.bands)),
        check=group.bands[0].check,
    )


def control_guides(groups: Sequence[Group], controls: Sequence[Group], structure: Structure) -> list[Guide]:
    """The nodes between the columns of aligned control words, as nodes of the whole words."""
    guides: list[Guide] = []
    for g, (group, control, columns) in enumerate(zip(groups, controls, structure, strict=True)):
        if control is group:
            continue
        words = [control_word(band) for band in group.bands]
        rows = [control.band_of[band.top] for band in group.bands]
        nodes: list[Places] = [(0,) * len(rows)]
        for column in columns:
            places = [column[b].target >> 2 for b in rows]
            nodes.append(
                tuple(2 * word.begins[p >> 1] + (p & 1) for word, p in zip(words, places, strict=True))
            )
        guides.append(Guide(g, tuple(range(len(rows))), tuple(dict.fromkeys(nodes)), strict=True))
    return guides
