"""What the browser is told of a grammar: shaders, textures, the labelled table, the steps of a pixel."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict
from functools import lru_cache
from typing import Any

import numpy as np

from ...render import Grammar
from ...render.pipeline.passes import PAGE, Pass, used
from ...render.pipeline.vertices import VERTEX
from ...render.texture.daytime import Daytime
from ...render.texture.operators import Operator
from ...render.texture.shaders import room, rooms_for, shader
from ...render.texture.steps import Chosen, Divided, Entered, Layered, Painted, Passed, Stacked, Step
from ..shared.packing import pack
from .places import Plane

__all__ = [
    "HOURS",
    "attributes",
    "derivation",
    "grammar_table",
    "light_piece",
    "passes_of",
    "scene_piece",
    "shaders_of",
    "step_text",
    "tiles_piece",
]

HOURS = tuple(k / 4 for k in range(97))
"""The hours whose light the browser has; it mixes the two nearest."""


_ASKING = [own for own in PAGE if own.fragment == "grammar.frag"]


def scene_piece(grammar: Grammar) -> bytes:
    """The texture to the bit, the start rule, the shader and the table of a grammar."""
    question = grammar.question((1.0, 1.0))
    frames, seeds = map(room, question.stacks)
    texture = grammar.texture()
    needs = {
        "frames": frames,
        "seeds": seeds,
        "rooms": rooms_for(question.rooms),
        "bits": grammar.encoding.bits,
    }
    return pack(
        {
            "width": texture.shape[1],
            "height": texture.shape[0],
            "bits": grammar.encoding.bits,
            "texture": np.frombuffer(texture.tobytes(), np.uint8),
            "start": list(question.records[question.start].place),
            "shaders": shaders_of(_ASKING, **needs),
            "report": grammar.report(),
            "table": grammar_table(grammar),
        }
    )


def tiles_piece(grammar: Grammar, side: int = 0) -> bytes:
    """The tiles that a grammar names; of each, the sizes whose sides are at most `side`, if that is not 0."""
    atlas = grammar.atlas()
    if side:
        atlas = atlas.no_larger(side)
    table = np.zeros((len(atlas.table), atlas.table.shape[1] + 1, 4), np.float32)
    table[:, 1:] = atlas.table
    table[:, 0, 0] = atlas.grey
    return pack(
        {
            "width": atlas.pixels.shape[1],
            "height": atlas.pixels.shape[0],
            "pixels": atlas.pixels.reshape(-1),
            "levels": table.shape[1],
            "count": table.shape[0],
            "table": table.reshape(-1),
        }
    )


@lru_cache(maxsize=1)
def light_piece() -> bytes:
    """What is the same for all grammars: the light of the day, the passes of the pipeline."""
    return pack(
        {
            "passes": passes_of(PAGE),
            "buffers": [asdict(own) for own in used(PAGE)],
            "shaders": shaders_of([own for own in PAGE if own not in _ASKING]),
            "stride": VERTEX.itemsize,
            "attributes": attributes(),
            "hours": [Daytime.at(hour).uniforms() for hour in HOURS],
        }
    )


def passes_of(passes: Sequence[Pass]) -> list[dict[str, Any]]:
    """Passes as the browser has them."""
    return [{**asdict(own), "reads": list(own.reads), "writes": list(own.writes)} for own in passes]


def shaders_of(passes: Sequence[Pass], **needs: int) -> dict[str, str]:
    """The source of each shader of each pass, by the pass and which it is; `needs`: of the grammar (`shader`)."""
    found = {}
    for own in passes:
        found[f"{own.name}:vertex"] = shader(own.vertex, "es")
        found[f"{own.name}:fragment"] = shader(own.fragment, "es", **needs, defines=own.defines)
    return found


def attributes() -> dict[str, list[int]]:
    """How many floats each attribute of a vertex has, and where it begins."""
    fields: Any = VERTEX.fields
    return {
        name: [int(np.prod(VERTEX[name].shape, dtype=int)), int(fields[name][1])]
        for name in VERTEX.names or ()
    }


def grammar_table(grammar: Grammar) -> list[dict[str, Any]]:
    """Every rule with its pixels, each channel with its name and value: the paper's Figure 3 for this grammar."""
    texture, encoding = grammar.texture(), grammar.encoding
    rows = []
    for rule, (x, y) in zip(grammar.rules, encoding.positions, strict=True):
        count = rule.operator.pixels(len(rule.parts))
        labels = list(_labels(rule.operator, count))
        pixels = []
        for k in range(count):
            values = texture[y, x + k]
            channels = [[labels[4 * k + c], _number(float(values[c]))] for c in range(4)]
            pixels.append({"at": [x + k, y], "channels": channels})
        rows.append({"name": rule.name, "operator": rule.operator.name, "pixels": pixels})
    return rows


def _labels(operator: Operator, count: int) -> Iterator[str]:
    """The name of each channel of so many pixels; empty where it holds nothing."""
    yield from operator.head
    if operator.each:
        rest = 4 * count - len(operator.head)
        for k in range(rest):
            name = operator.each[k % len(operator.each)]
            yield f"{name}{_small(k // len(operator.each) + 1)}" if name else ""


def _small(number: int) -> str:
    return str(number).translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))


def _number(value: float) -> str:
    return f"{value:.4g}".replace("-", "−")


def derivation(steps: Sequence[Step], places: Sequence[Plane]) -> list[dict[str, Any]]:
    """The steps of a pixel as the front end has them: `corners` and `spot` are places in space, metres."""
    return [
        {
            "rule": step.name,
            "operator": step.operator,
            "text": step_text(step),
            "scope": list(step.scope),
            "corners": _corners(plane, step.scope),
            "spot": list(plane.at(*step.point)),
            "faces": list(step.faces),
            "layers": [list(layer) for layer in step.layers],
            "seeds": [list(corner) for corner in step.seeds],
            "records": [list(record) for record in step.records],
            "color": list(step.value) if isinstance(step, Painted) else None,
        }
        for step, plane in zip(steps, places, strict=True)
    ]


def _corners(plane: Plane, scope: tuple[float, float, float, float]) -> list[list[float]]:
    left, bottom, right, top = scope
    around = ((left, bottom), (right, bottom), (right, top), (left, top))
    return [list(plane.at(*corner)) for corner in around]


def step_text(step: Step) -> str:
    """What an operator has done, as a sentence."""
    match step:
        case Divided():
            return f"part {step.part + 1} of {step.count}, from {step.low:.3g} to {step.high:.3g} m"
        case Chosen():
            return f"random number {step.random:.4f} chooses part {step.part + 1}"
        case Stacked():
            return f"puts corner {step.corner[0]}, {step.corner[1]} on the seed stack"
        case Layered():
            return f"goes on with layer {step.layer}"
        case Passed():
            mask = "" if step.mask is None else f"the mask is {step.mask:.2f}: "
            more = f"passes over {step.levels} more layer{'s' * (step.levels != 1)}"
            return f"{mask}transparent, {more if step.levels else 'goes on with the layer below'}"
        case Entered():
            return f"the ray hits the {step.face}, {step.depth:.3g} m behind"
        case Painted():
            values = ", ".join(f"{value:.2f}" for value in step.value)
            return f"adds {step.usage.lower()} {values}"
    return step.operator
