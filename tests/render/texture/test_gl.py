"""The GLSL evaluator against the NumPy one, pixel by pixel (SPEC 5)."""

from __future__ import annotations

from collections import Counter

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from facade_nb.render import Grammar
from facade_nb.render.texture.evaluating import evaluate
from facade_nb.render.texture.gl import OSMESA
from facade_nb.render.texture.view import Looks

from .grammars import grammar_texts, rays
from .stand_in import stand_in

SIZE = (7.0, 5.0)
SEEN: Counter[str] = Counter()


@given(grammar_texts(), rays(), st.tuples(st.integers(-999, 999), st.integers(-999, 999)), st.integers(0, 9))
@settings(max_examples=300)
def test_as_numpy(text: str, ray: tuple[float, float, float], steps: tuple[int, int], number: int) -> None:
    grammar = Grammar.parse(text, stand_in())
    points = (np.random.Generator(np.random.PCG64(number)).random((4000, 2)) * SIZE).astype(np.float32)
    directions = np.tile(np.array(ray, np.float32), (len(points), 1))
    question = grammar.question(SIZE, (steps[0] / 8, steps[1] / 10))
    wanted = evaluate(question, points, directions)
    shot = OSMESA.paint_at(
        question, Looks(points, directions, np.zeros(4000, np.float32), np.ones(4000, bool))
    )
    found = shot.surface
    wrong = found.rule != wanted.rule
    for a, b in zip(found[:3], wanted[:3], strict=True):
        wrong |= np.abs(a - b).max(axis=1) > 2e-3
    SEEN["all"] += len(points)
    SEEN["wrong"] += int(wrong.sum())
    SEEN["renders"] += 1
    assert wrong.mean() < 0.01, (wrong.sum(), np.flatnonzero(wrong)[:3])
    print(dict(SEEN))
