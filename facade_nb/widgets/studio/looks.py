"""What the front end is told about shapes: what a cell looks like, who says so, and the table of a layer's pairs."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from ...design.instances import spell_instance
from ...design.model import AXES, Axis, Design, Layer, Shape
from ...solver import Layout
from ...solver.assembly.looks import DEFAULT_SHAPE, Instance, Looks, Told, instances
from .model import FacadeModel, Selection

__all__ = ["describe_cell", "describe_pairs"]

Json = dict[str, Any]

_ATTRIBUTES = tuple(own.name for own in fields(Shape) if own.name != "variants")
_MOST = 400
"""Pairs up to which a layer's table is told: it would not be read any more, and each pair takes its time."""


def describe_cell(model: FacadeModel) -> Json | None:
    """The picked cell: each field's value with the key that gives it, and what each key that could be edited says.

    None where no pair of symbols is picked, or its layer is no more.
    """
    design, picked = model.design, model.selection
    layer = next((own for own in design.layers if own.name == picked.layer), None)
    if layer is None or not picked.x or not picked.y:
        return None
    x, y = (_instance(model.layout, picked, layer, axis) for axis in AXES)
    steps = Looks(design, layer).told(x, y)
    keys = _keys(x, y)
    owners = {
        "layer": layer.shapes,
        "x": design.patterns[layer.x.pattern].shapes,
        "y": design.patterns[layer.y.pattern].shapes,
        "design": design.shapes,
    }
    told: Json = {
        "fields": {name: _field(name, steps) for name in _ATTRIBUTES},
        "keys": keys,
        "patterns": {"x": layer.x.pattern, "y": layer.y.pattern},
        "set": {
            level: {own["key"]: _shape(shapes[own["key"]]) for own in keys if own["key"] in shapes}
            for level, shapes in owners.items()
        },
        "seed": design.seed,
        "rect": None,
    }
    if picked.shape is not None and model.layout is not None and picked.shape < len(model.layout.shapes):
        told["rect"] = [round(value, 4) for value in model.layout.shapes[picked.shape].rect]
    return told


def describe_pairs(model: FacadeModel) -> Json | None:
    """The table of pairs of the picked layer: what each pair looks like, and the most exact key that says so."""
    design, picked = model.design, model.selection
    layer = next((own for own in design.layers if own.name == picked.layer), None)
    if layer is None:
        return None
    columns, rows = (_letters(design, layer, axis) for axis in AXES)
    seen = {axis: _seen(design, layer, axis) for axis in AXES}
    if len(columns) * len(rows) > _MOST:
        return {"layer": layer.name, "columns": columns, "rows": rows, "cells": []}
    looks = Looks(design, layer)
    cells = []
    for y in rows:
        for x in columns:
            steps = looks.told((x, 0, 0), (y, 0, 0))
            shown = _field("visible", steps)["value"] and x in seen["x"] and y in seen["y"]
            cells.append(
                {
                    "material": _field("material", steps)["value"],
                    "geometry": _field("geometry", steps)["value"],
                    "key": steps[-1].key if steps else "",
                    "level": steps[-1].level if steps else "",
                    "shown": shown,
                }
            )
    return {"layer": layer.name, "columns": columns, "rows": rows, "cells": cells}


def _letters(design: Design, layer: Layer, axis: Axis) -> list[str]:
    parsed = design.patterns[layer.along(axis).pattern].parsed
    return [symbol for symbol in parsed.symbols if symbol in parsed.solids]


def _seen(design: Design, layer: Layer, axis: Axis) -> set[str]:
    """The symbols that the axis lets draw: neither masked nor hidden nor transparent."""
    side = layer.along(axis)
    hidden = design.patterns[side.pattern].hidden
    letters = _letters(design, layer, axis)
    kept = letters if side.mask is None else [symbol for symbol in letters if symbol in side.mask]
    return {symbol for symbol in kept if symbol not in hidden and not design.symbol(symbol).transparent}


def _instance(layout: Layout | None, picked: Selection, layer: Layer, axis: Axis) -> Instance:
    """Which instance of its symbol is picked, and of how many; (symbol, 0, 0) where none is."""
    symbol = picked.x if axis == "x" else picked.y
    if picked.number is None or picked.more or layout is None:
        return (symbol, 0, 0)
    number = picked.number[AXES.index(axis)]
    try:
        own = [one for _, one in instances(layout.along(axis), layer) if one[0] == symbol]
    except KeyError:  # the layout is of an earlier design, in which the layer had another name
        own = []
    return (symbol, number, max(len(own), number))


def _keys(x: Instance, y: Instance) -> list[Json]:
    """The keys under which a cell can be edited, each with what it means in words."""
    (across, i, columns), (up, j, rows) = x, y
    found = [(f"{across} {up}", f"all {across} {up}")]
    if i and j:
        one, other = spell_instance(across, i), spell_instance(up, j)
        last, top = spell_instance(across, i - columns - 1), spell_instance(up, j - rows - 1)
        found = [
            (f"{one} {other}", "this one"),
            *found,
            (f"{one} {up}", f"this {across} with every {up}"),
            (f"{across} {other}", f"every {across} with this {up}"),
            (f"{one} *", f"all of this {across}"),
            (f"* {other}", f"all of this {up}"),
            (f"{last} {top}", "this one, counted from the other ends"),
        ]
    found += [(f"{across} *", f"every {across}"), (f"* {up}", f"every {up}"), ("* *", "everything")]
    return [{"key": key, "means": means} for key, means in found]


def _field(name: str, steps: list[Told]) -> Json:
    """A field's value, and the level and the key that say so; neither where it is the default."""
    for step in reversed(steps):
        if name in step.fields:
            told: Json = {"value": step.fields[name], "level": step.level, "key": step.key}
            return told | {"varied": name in step.varied}
    return {"value": getattr(DEFAULT_SHAPE, name), "level": "", "key": "", "varied": False}


def _shape(shape: Shape) -> Json:
    told: Json = {name: value for name in _ATTRIBUTES if (value := getattr(shape, name)) is not None}
    if shape.variants is not None:
        told["variants"] = [{"weight": own.weight, **_shape(own.shape)} for own in shape.variants]
    return told
