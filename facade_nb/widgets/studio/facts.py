"""How good a layout is, in numbers, and what would help where it warns."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

from ...design.edit import with_counter, with_layer, with_pattern
from ...design.model import AXES
from ...solver import Layout
from ...solver.model.layout import AxisLayout
from .model import FacadeModel

__all__ = ["Remedy", "apply_remedy", "describe_facts", "remedies"]

_CUT = re.compile(r"The search on [xy] was cut short, as (it was stopped|the time was over)")
_ENDLESS = re.compile(
    r"Counter '(.+)' in pattern '.+' repeats nothing that has a size; it was tried up to (\d+) only"
)
_MASK = re.compile(
    r"of layer '(.+)' stands there(?: and pushed the others aside)?, but its ([xy]) mask hides (.+)\.$"
)
_HIDDEN = re.compile(r"stands there(?: and pushed the others aside)?, but pattern '(.+)' hides (.+)\.$")
_LONGER = 6


@dataclass(frozen=True, slots=True)
class Remedy:
    """What would help against a warning, by its place among the layout's, in words for a button."""

    warning: int
    text: str


def describe_facts(layout: Layout | None) -> list[dict[str, Any]]:
    """Per axis: J and what it is made of, how far it may be from the best, and the deviation of sizes."""
    if layout is None:
        return []
    told = []
    for axis in AXES:
        solved = layout.along(axis)
        errors = {name: group.error for name, group in solved.groups.items()}
        told.append(
            {
                "axis": axis,
                "cost": _rounded(solved.cost),
                "error": _rounded(sum(errors.values())),
                **_terms(solved),
                "gap": _rounded(solved.gap),
                "proven": solved.proven,
                "deviation": _rounded(solved.deviation),
                "groups": [
                    {"name": name, "error": _rounded(error), "columns": len(solved.groups[name].columns) - 1}
                    for name, error in errors.items()
                ],
            }
        )
    return told


def _terms(solved: AxisLayout) -> dict[str, Any]:
    """E, Λ and the fit, summed over groups, metres, each with its price in J; nothing where they are not known."""
    terms = [group.terms for group in solved.groups.values() if group.terms is not None]
    if not terms:
        return {"terms": None}
    price = terms[0].objective
    return {
        "terms": {
            "empty": [_rounded(sum(own.empty for own in terms)), price.empty],
            "loose": [_rounded(sum(own.loose for own in terms)), price.loose],
            "fit": [_rounded(sum(own.miss for own in terms)), price.fit],
        }
    }


def remedies(model: FacadeModel) -> list[Remedy]:
    """What would help against the warnings of a model's layout, where that is known."""
    layout = model.layout
    if layout is None:
        return []
    told = []
    for i, warning in enumerate(layout.warnings):
        if _CUT.match(warning):
            told.append(Remedy(i, f"search for {_longer(model):g} s"))
        elif found := _ENDLESS.match(warning):
            told.append(Remedy(i, f"let {found[1]} be at most {found[2]}"))
        elif found := _MASK.search(warning):
            told.append(Remedy(i, f"show {found[3]} in layer {found[1]}"))
        elif found := _HIDDEN.search(warning):
            told.append(Remedy(i, f"show {found[2]} in pattern {found[1]}"))
    return told


def apply_remedy(model: FacadeModel, remedy: Remedy) -> None:
    """Do what would help."""
    layout = model.layout
    if layout is None or remedy not in remedies(model):
        return
    warning, design = layout.warnings[remedy.warning], model.design
    if _CUT.match(warning):
        model.solve_for(_longer(model))
    elif found := _ENDLESS.match(warning):
        model.edit(with_counter(design, found[1], max=int(found[2])))
    elif found := _MASK.search(warning):
        layer = next(layer for layer in design.layers if layer.name == found[1])
        axis = next(axis for axis in AXES if axis == found[2])
        mask = [*(layer.along(axis).mask or ()), found[3]]
        model.edit(with_layer(design, found[1], **{axis: {"mask": mask}}))
    elif found := _HIDDEN.search(warning):
        hidden = [name for name in design.patterns[found[1]].hidden if name != found[2]]
        model.edit(with_pattern(design, found[1], hidden=hidden))


def _longer(model: FacadeModel) -> float:
    return math.ceil(_LONGER * model.time_limit)


def _rounded(value: float) -> float | None:
    return round(value, 4) if math.isfinite(value) else None
