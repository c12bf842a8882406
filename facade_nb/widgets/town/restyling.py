"""With which rule each vertex begins, when a grammar is read anew or a building takes another style."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ...design.errors import DesignError, Fault, nearest
from ...render import Grammar
from ...render.town.cornices import CORNICES
from ...render.town.solids import RULES as SOLIDS
from ...render.town.styles import GROUND, Style
from ...render.town.things import RULES

__all__ = ["Starts", "start_names"]

_FACES = ("front", "street", "party", "gable", "roof", "flat", "plain", "side", "court")
"""What a rule is taken for where a style has one rule for several."""


def start_names(styles: Sequence[Style]) -> tuple[str, ...]:
    """The rules that walls, roofs, ground and what stands about may begin with."""
    every = [rule for style in styles for rule in style.starts.values()]
    return tuple(dict.fromkeys((*every, *GROUND.values(), *RULES, *CORNICES, *SOLIDS)))


class Starts:
    """The start rule of each vertex, by name.

    Parameters
    ----------
    vertices
        Of a town.
    grammar
        Whose rules they name.
    styles
        The town's.
    """

    def __init__(self, vertices: np.ndarray, grammar: Grammar, styles: Sequence[Style]) -> None:
        self.styles = tuple(styles)
        self.names = start_names(styles)
        places = self.places(grammar)
        wide = grammar.texture().shape[1]
        codes = (places[:, 1] * wide + places[:, 0]).astype(np.int64)
        order = np.argsort(codes, kind="stable")
        own = vertices["start"].astype(np.int64)
        found = np.searchsorted(codes[order], own[:, 1] * wide + own[:, 0])
        self.rules: NDArray[np.int32] = order[np.minimum(found, len(order) - 1)].astype(np.int32)
        """(v,) index into `names`."""

    def places(self, grammar: Grammar) -> NDArray[np.float32]:
        """Column and row (n, 2) of each rule in a grammar's texture.

        Raises
        ------
        DesignError
            If the grammar lacks one of them.
        """
        known: Mapping[str, tuple[int, int]] = dict(
            zip(grammar.encoding.names, grammar.encoding.positions, strict=True)
        )
        missing = [name for name in self.names if name not in known]
        if missing:
            raise DesignError(
                Fault(
                    name,
                    f"walls of the town begin with the rule {name!r}: expected it in the text; found none"
                    f"{nearest(name, list(known))}",
                )
                for name in missing
            )
        return np.array([known[name] for name in self.names], np.float32)

    def restyled(self, at: NDArray[np.intp], widths: NDArray[np.float32], style: int) -> NDArray[np.int32]:
        """The rules (n,) with which the vertices `at` begin in another style."""
        number = {name: k for k, name in enumerate(self.names)}
        new = self.styles[style]
        rules = self.rules[at].copy()
        for k, (rule, width) in enumerate(zip(rules.tolist(), widths.tolist(), strict=True)):
            face = self._face(self.names[rule])
            if face:
                rules[k] = number[new.start(face, width)]
        return rules

    def _face(self, rule: str) -> str:
        """What a rule is for; empty for what belongs to no house."""
        for style in self.styles:
            for face in (*_FACES, *style.starts):
                if style.starts.get(face) == rule:
                    return face.removeprefix("short-")
        return ""
