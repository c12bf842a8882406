"""What the front end is told about a model: plain JSON values, made from the model and nothing else."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable
from typing import Any

from ...design import Fault
from ...design.model import AXES, Axis, Design, Layer, LayerAxis
from ...render.materials import RULE
from ...render.ruled import grammar_faults, material_of, rule_names
from .fields import UNSHAPED
from .looks import describe_cell, describe_pairs
from .model import FacadeModel

__all__ = ["describe_design", "describe_drafts", "describe_faults", "describe_selection", "describe_status"]

Json = dict[str, Any]


def describe_design(model: FacadeModel) -> Json:
    """The design as its editors show it: lists in order, with what was solved beside what was asked for."""
    design = model.design
    uses = _uses(design)
    return {
        "name": design.name,
        "canvas": {"width": design.canvas.width, "height": design.canvas.height},
        "layers": [_layer(design, layer) for layer in layers_from_top(design)],
        "patterns": [
            {
                "name": pattern.name,
                "text": pattern.text,
                "hidden": list(pattern.hidden),
                "letters": _letters(design, pattern.name),
                "axes": "".join(axis for axis in AXES if _used(design, pattern.name, axis)),
            }
            for pattern in design.patterns.values()
        ],
        "symbols": [_symbol(model, name, uses.get(name, ""), uses) for name in {**design.symbols, **uses}],
        "counters": [_counter(model, name) for name in _counters(design)],
        "grammar": design.grammar,
        "grammarFaults": describe_faults(grammar_faults(design.grammar)),
        "rules": _rules(design.grammar),
        "groups": sorted({layer.along(axis).group for layer in design.layers for axis in AXES} | {"default"}),
    }


def describe_status(model: FacadeModel, faults: Iterable[Fault]) -> Json:
    """How the last solve went, and what can be undone; `faults`: what cannot be drawn of the layout as it says."""
    layout, blame = model.layout, model.blame
    status: Json = {
        "busy": model.busy,
        "proving": model.proving,
        "stale": model.stale,
        "message": model.message,
        "blame": {
            "patterns": list(blame.patterns) if blame else [],
            "symbols": list(blame.symbols) if blame else [],
            "counters": list(blame.counters) if blame else [],
        },
        "suggestions": [one.text for one in blame.suggestions if one.path != ("tolerances",)]
        if blame
        else [],
        "canUndo": model.can_undo,
        "canRedo": model.can_redo,
        "milliseconds": _rounded(1000 * model.seconds),
        "trouble": repr(model.trouble) if model.trouble is not None else "",
        "solved": None,
    }
    if layout is not None:
        status["solved"] = {
            "shapes": len(layout.shapes),
            "holes": len(layout.holes),
            "warnings": [*layout.warnings, *map(str, faults)],
            "complete": layout.complete,
            "proven": layout.x.proven and layout.y.proven,
            "gap": _rounded(layout.x.gap + layout.y.gap),
            "deviation": {"x": _rounded(layout.x.deviation), "y": _rounded(layout.y.deviation)},
            "width": layout.canvas.width,
            "height": layout.canvas.height,
        }
    return status


def describe_drafts(model: FacadeModel) -> list[Json]:
    """The drafts, each with its faults."""
    return [
        {
            "path": list(path),
            "value": draft.value,
            "faults": describe_faults(draft.faults),
        }
        for path, draft in model.drafts.items()
    ]


_COLOURED = 24
"""Rules that have a colour in lists of materials, at most: each must be drawn for that."""


def _rules(grammar: str) -> dict[str, str]:
    """Materials that rules of a grammar are, each with the colour that stands for it."""
    names = [f"{RULE}{name}" for name in rule_names(grammar)]
    return {name: material_of(grammar, name).fill if k < _COLOURED else "" for k, name in enumerate(names)}


def describe_faults(faults: Iterable[Fault]) -> list[Json]:
    """Faults as the front end shows them."""
    return [
        {
            "place": fault.place,
            "message": fault.message,
            "line": fault.line,
            "column": fault.column,
            "excerpt": fault.excerpt,
        }
        for fault in faults
    ]


def describe_selection(model: FacadeModel) -> Json:
    """What is picked, with the looks of the cell and the table of its layer's pairs."""
    picked = model.selection
    return {
        "shape": picked.shape,
        "layer": picked.layer,
        "x": picked.x,
        "y": picked.y,
        "number": None if picked.number is None else list(picked.number),
        "more": [list(pair) for pair in picked.more],
        "cell": describe_cell(model),
        "pairs": describe_pairs(model),
    }


def layers_from_top(design: Design) -> list[Layer]:
    """All layers, also those that are not visible, topmost first."""
    order = sorted(design.layers, key=lambda layer: layer.depth)
    return order[::-1]


def _layer(design: Design, layer: Layer) -> Json:
    def axis(side: LayerAxis) -> Json:
        return {
            "pattern": side.pattern,
            "group": side.group,
            "mask": None if side.mask is None else list(side.mask),
            "letters": _letters(design, side.pattern),
        }

    return {
        "name": layer.name,
        "visible": layer.visible,
        "unshaped": layer.shapes == UNSHAPED,
        "depth": layer.depth,
        "x": axis(layer.x),
        "y": axis(layer.y),
    }


def _letters(design: Design, pattern: str) -> list[str]:
    """The symbols that can stand solid in words of a pattern, in order."""
    definition = design.patterns.get(pattern)
    if definition is None:
        return []
    parsed = definition.parsed
    return [symbol for symbol in parsed.symbols if symbol in parsed.solids]


def _used(design: Design, pattern: str, axis: Axis) -> bool:
    return any(layer.along(axis).pattern == pattern for layer in design.layers)


def _uses(design: Design) -> dict[str, str]:
    """For each symbol that a pattern can write: the axes it stands on, such as ``"xy"``."""
    uses: dict[str, str] = {}
    for pattern in design.patterns.values():
        axes = "".join(axis for axis in AXES if _used(design, pattern.name, axis))
        for symbol in pattern.parsed.symbols:
            uses[symbol] = "".join(a for a in AXES if a in axes + uses.get(symbol, ""))
    return uses


def _symbol(model: FacadeModel, name: str, axes: str, written: Container[str]) -> Json:
    symbol = model.design.symbol(name)
    layout = model.layout
    solved = {axis: layout.along(axis).sizes.get(name) for axis in AXES} if layout is not None else {}
    return {
        "name": name,
        "axes": axes,
        "size": symbol.size,
        "opaque": symbol.opaque,
        "attached": symbol.attached,
        "unoccludable": symbol.unoccludable,
        "transparent": symbol.transparent,
        "placement": symbol.placement,
        "min": symbol.min,
        "max": symbol.max,
        "solved": {axis: _rounded(size) for axis, size in solved.items() if size is not None},
        "fresh": name in model.newcomers.symbols,
        "used": name in written,
    }


def _counters(design: Design) -> list[str]:
    names = dict.fromkeys(design.counters)
    for pattern in design.patterns.values():
        names.update(dict.fromkeys(pattern.parsed.counters))
    return list(names)


def _counter(model: FacadeModel, name: str) -> Json:
    counter = model.design.counter(name)
    return {
        "name": name,
        "min": counter.min,
        "max": counter.max,
        "value": counter.value,
        "solved": model.layout.counters.get(name) if model.layout is not None else None,
        "fresh": name in model.newcomers.counters,
        "used": any(name in pattern.parsed.counters for pattern in model.design.patterns.values()),
    }


def _rounded(value: float) -> float | None:
    """Four decimals are a tenth of a millimetre; what is not finite is not JSON."""
    return round(value, 4) if math.isfinite(value) else None
