"""What was solved, in words."""

from __future__ import annotations

from .layout import BuildingLayout
from .vertical import SPINES

__all__ = ["explain"]


def explain(layout: BuildingLayout) -> str:
    """The heights, then each face: what it costs, whether that is proven, and where the walls meet."""
    heights = layout.heights
    lines = [
        f"{layout.name}: {len(layout.faces)} faces, {layout.building.height:g} m high, eaves at {layout.eaves:.2f} m.",
        f"Heights of all walls: J {heights.cost:.3f} m, {_sure(heights.proven, heights.gap)}; sizes deviate by "
        f"{heights.deviation:.3f} m.",
    ]
    shared = heights.groups.get(SPINES)
    if shared is not None:
        stops = ", ".join(f"{stop:.2f}" for stop in shared.columns)
        lines.append(f"All walls meet at {stops} m. Between them stand, from below:")
        for row in shared.rows:
            name = row.layer.removeprefix("spine of ")
            words = [
                "".join(letter.symbol.removesuffix(f" of {name}") for letter in own) for own in row.columns
            ]
            lines.append(f"  {name}: {' | '.join(words)}")
    elif len({own.face.design for own in layout.faces} - {None}) == 1:
        lines.append("All walls are of one design, and meet wherever it has a boundary.")
    for own in layout.faces:
        face, x = own.face, own.layout.x
        if face.design is None:
            lines.append(f"{face.name}, {face.length:.2f} m: blind.")
            continue
        counters = ", ".join(f"{name} = {value}" for name, value in own.layout.counters.items())
        lines.append(
            f"{face.name}, {face.length:.2f} m, {face.design}: J {x.cost:.3f} m across, {_sure(x.proven, x.gap)}"
            f"{'; ' + counters if counters else ''}."
        )
    lines += [f"Note: {text}" for text in layout.warnings]
    return "\n".join(lines)


def _sure(proven: bool, gap: float) -> str:
    return "proven to be the least" if proven else f"perhaps {gap:.3f} m more than the least"
