"""The NumPy evaluator against one made from the SPEC alone, and against known answers."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb.render.texture import Grammar

from .brute import answer
from .grammars import grammar_texts, rays
from .stand_in import stand_in

SIZE = (7.0, 5.0)
MARGIN = 2e-4


def points(count: int, size: tuple[float, float] = SIZE, seed: int = 1) -> np.ndarray:
    return np.random.Generator(np.random.PCG64(seed)).random((count, 2)) * size


@given(grammar_texts(), rays(), st.tuples(st.integers(-999, 999), st.integers(-999, 999)), st.integers(0, 9))
@settings(max_examples=250)
def test_as_the_brute_force_evaluator(
    text: str, ray: tuple[float, float, float], steps: tuple[int, int], number: int
) -> None:
    tiles, seed = stand_in(), (steps[0] / 8, steps[1] / 10)
    grammar = Grammar.parse(text, tiles)
    asked = points(60, seed=number)
    surface = grammar.evaluate(asked, SIZE, seed, rays=np.tile(ray, (len(asked), 1)))
    for k, point in enumerate(asked.astype(np.float32).astype(float)):
        wanted = answer(grammar, tiles, tuple(point), SIZE, seed, ray=ray)
        if wanted.margin < MARGIN:
            continue
        assert surface.rule[k] == wanted.rule
        for array, usage in zip(surface, "cns", strict=False):
            assert np.abs(array[k] - wanted.totals[usage]).max() < 3e-3
