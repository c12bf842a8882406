"""The forces of the sizing on the elevation, as a picture (the paper's 5.3)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from ...solver import Layout, Trace
from ...solver.events import AxisPosed, LetterPlaced, PathChosen, SystemPosed, SystemSolved
from .sheet import ACCENT, ARC, MUTED, PAPER, PATH, Sheet
from .sizing import forces
from .timeline import timeline

__all__ = ["Load", "forced", "loads"]

_TINY = 1e-6
_WIDE, _HIGH, _MARGIN = 820.0, 460.0, 30.0
_LONG, _SHORT, _JOINT = 26.0, 7.0, 3.0


@dataclass(frozen=True)
class Load:
    """Letters of a word one after the other under the same force, metres; it is positive where they are stretched."""

    axis: str
    start: float
    end: float
    across: float
    force: float
    joints: tuple[float, ...] = ()
    held: bool = False
    """Whether it is the canvas that holds an end; then start and end are both there."""


def loads(trace: Trace, layout: Layout) -> list[Load]:
    """What is stretched and squeezed along both axes, and what the canvas holds; as views/facade.ts has it."""
    solved = {e.axis: e for e in trace.of_kind(SystemSolved)}
    out: list[Load] = []
    for posed in trace.of_kind(SystemPosed):
        if answer := solved.get(posed.axis):
            out += _along(trace, layout, posed, answer)
    return out


def forced(trace: Trace, layout: Layout) -> str:
    """The shapes faintly, and the forces on them; empty where every symbol has the size that it likes."""
    found = loads(trace, layout)
    if not found:
        return ""
    width, height = layout.canvas.width, layout.canvas.height
    scale = min(_WIDE / width, _HIGH / height)
    sheet = Sheet(width * scale + 2 * _MARGIN)
    floor = sheet.height + _MARGIN + height * scale
    hues: dict[str, int] = timeline(trace)["symbols"]
    rects: dict[int, list[tuple[float, float, float, float]]] = {}
    for shape in layout.shapes:
        left, bottom, right, top = shape.rect
        box = (_MARGIN + left * scale, floor - top * scale, (right - left) * scale, (top - bottom) * scale)
        rects.setdefault(hues.get(shape.x, 0), []).append(box)
    for hue, boxes in rects.items():
        sheet.boxes(boxes, hue)
    w, h = width * scale, height * scale
    sheet.box(_MARGIN, floor - h, w, h, fill=PAPER, opacity=0.65)
    sheet.box(_MARGIN, floor - h, w, h, stroke=MUTED)
    largest = max(abs(own.force) for own in found)
    for own in found:
        _draw(sheet, own, scale, floor, largest)
    sheet.height = floor + _MARGIN + 12
    said = (
        "Forces on the façade. Blue: stretched, pulls; red: squeezed, pushes; orange: held by the canvas. "
        f"Largest {largest:.3g} m² per m."
    )
    sheet.text(_MARGIN, sheet.height, said, fill=MUTED, size=11)
    sheet.height += 8
    return sheet.image(f"Forces of the sizing on {layout.name}")


def _draw(sheet: Sheet, own: Load, scale: float, floor: float, largest: float) -> None:
    upright = own.axis == "y"

    def along(value: float) -> float:
        return floor - value * scale if upright else _MARGIN + value * scale

    across = _MARGIN + own.across * scale if upright else floor - own.across * scale
    long = max(_SHORT, _LONG * abs(own.force) / largest)
    way = -1 if upright else 1
    if own.held:
        # The multiplier is positive where the upper bound holds a boundary back.
        by = way * (-long if own.force > 0 else long)
        inwards = (own.start <= 0) == (own.force < 0)
        at = along(own.start)
        tail, tip = (at - by, at) if inwards else (at, at + by)
        sheet.arrow(tail, tip, across, stroke=ACCENT, upright=upright)
        return
    stroke = ARC if own.force > 0 else PATH
    first, last = along(own.start), along(own.end)
    long = way * min(long, max(2.0, abs(last - first) / 2 - 1.5))
    ends = ((first, first + long), (last, last - long))
    sheet.rule(first, last, across, stroke=stroke, upright=upright)
    for joint in own.joints:
        at = along(joint)
        sheet.rule(across - _JOINT, across + _JOINT, at, stroke=stroke, upright=not upright)
    for outer, inner in ends:
        tail, tip = (outer, inner) if own.force > 0 else (inner, outer)
        sheet.arrow(tail, tip, across, stroke=stroke, upright=upright)


def _along(trace: Trace, layout: Layout, posed: SystemPosed, answer: SystemSolved) -> Iterator[Load]:
    axis = posed.axis
    pulls = forces(posed, answer)
    layers = {group.name: group.layers for own in trace.of_kind(AxisPosed, axis) for group in own.groups}
    placed = trace.of_kind(LetterPlaced, axis)
    taken: list[float] = []
    for g, path in enumerate(trace.of_kind(PathChosen, axis)):
        names, own = layers.get(path.group, ()), []
        for b, band in enumerate(path.bands):
            rows = [names[row] for row in band.rows if row < len(names)]
            letters = [e for e in placed if e.group == path.group and e.layer == (rows or [""])[0]]
            found = [(e, pulls.get((g, b, e.column, e.place), 0.0)) for e in letters]
            found = [(e, force) for e, force in found if abs(force) > _TINY]
            if not found:
                continue
            across = _line(layout, axis, rows, taken)
            taken.append(across)
            own.append(across)
            yield from _runs([Load(axis, e.start, e.end, across, force) for e, force in found])
        for v, meaning in enumerate(posed.meaning):
            force = answer.multipliers[v]
            fixed = posed.lower[v] == posed.upper[v]
            if own and meaning.kind == "boundary" and meaning.group == g and fixed and abs(force) > _TINY:
                at = answer.placed[v]
                yield Load(axis, at, at, sum(own) / len(own), force, held=True)


def _runs(letters: Sequence[Load]) -> list[Load]:
    runs: list[Load] = []
    for own in letters:
        last = runs[-1] if runs else None
        if last and abs(last.end - own.start) < _TINY and abs(last.force - own.force) < _TINY:
            runs[-1] = replace(last, end=own.end, joints=(*last.joints, own.start))
        else:
            runs.append(own)
    return runs


def _line(layout: Layout, axis: str, layers: Sequence[str], taken: Sequence[float]) -> float:
    """Where across the façade: in the middle of shapes of the word's layer, away from those of other words."""
    low, high, whole = (1, 3, layout.canvas.height) if axis == "x" else (0, 2, layout.canvas.width)
    middles = {
        round((shape.rect[low] + shape.rect[high]) / 2, 4) for shape in layout.shapes if shape.layer in layers
    }

    def apart(value: float) -> float:
        room = min([whole / 6, *(abs(other - value) for other in taken)])
        return room - abs(value - whole / 2) / 1e3

    return max(sorted(middles) or [whole / 2], key=apart)
