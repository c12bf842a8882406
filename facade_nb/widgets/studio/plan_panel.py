"""Fields for what a building is besides its designs: plan, which design stands on which wall, corners, roof."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from html import escape
from math import inf
from typing import Any

from ipywidgets import HTML, Button, Combobox, Dropdown, FloatText, HBox, IntText, Text, VBox

from ...building import Building
from ...building.model import ROOFS, Treatment
from ...building.reshaping import PLANS, plan_of, reshaped, treated, walled
from ...design import DesignError
from ...render.materials import MATERIALS

__all__ = ["PlanPanel"]

_PLANS = {"rectangle": "Rectangle", "ell": "L around a yard", "row": "Row of houses", "other": "Polygon"}
_LENGTHS = {"width": "Width", "depth": "Depth", "deep": "Depth of the front arm", "wide": "Width of the wing"}
_BLIND = "blind"


class PlanPanel(VBox):
    """The fields, two buttons to undo and redo, and what is wrong with what was typed last.

    Parameters
    ----------
    changed
        Is given the building that a field makes of the present one.
    undo, redo
        Of the two buttons.
    """

    def __init__(
        self, changed: Callable[[Building], None], undo: Callable[[], None], redo: Callable[[], None]
    ) -> None:
        self._changed = changed
        self._building: Building | None = None
        self._kept: dict[str, Any] = {}
        self._quiet = False
        narrow = {"width": "auto"}
        self.undo_button = Button(
            description="Undo", tooltip="Undo plan, corners or roof", icon="undo", layout=narrow
        )
        self.redo_button = Button(
            description="Redo", tooltip="Redo plan, corners or roof", icon="repeat", layout=narrow
        )
        self.undo_button.on_click(lambda _: undo())
        self.redo_button.on_click(lambda _: redo())
        self._fault = HTML()
        self._rows = [HBox(layout={"flex_flow": "row wrap"}) for _ in range(4)]
        super().__init__([*self._rows, HBox([self.undo_button, self.redo_button]), self._fault])
        self.add_class("facade-nb-plan")

    def show(self, building: Building, *, undo: bool, redo: bool) -> None:
        """Show a building, and whether there is something to undo and to redo."""
        self._building = building
        self.undo_button.disabled, self.redo_button.disabled = not undo, not redo
        self._fault.value = ""
        self._quiet = True
        try:
            rows = [
                self._plan(building),
                self._walls(building),
                self._corners(building),
                self._roof(building),
            ]
        finally:
            self._quiet = False
        for box, row in zip(self._rows, rows, strict=True):
            if box.children != tuple(row):  # what stays in its place keeps the focus
                box.children = row

    def _plan(self, building: Building) -> list[Any]:
        kind, lengths = plan_of(building)
        kinds = [(_PLANS[name], name) for name in (PLANS if kind != "other" else (*PLANS, "other"))]
        row = [self._field("Plan", Dropdown, kind, lambda b, v: reshaped(b, v, {}), options=kinds)]
        houses = sum(name.startswith("house ") for name in lengths)
        if kind == "row":
            row.append(self._field("Houses", IntText, houses, _with_houses))
        for name, value in lengths.items():
            label = _LENGTHS.get(name, f"Width of {name}")
            row.append(self._length(label, value, partial(_with_length, name)))
        return row

    def _walls(self, building: Building) -> list[Any]:
        names = [(name, name) for name in building.designs] + [(_BLIND, "")]
        return [
            self._field(f"Wall {k + 1}", Dropdown, own or "", partial(_with_wall, k), options=names)
            for k, own in enumerate(building.walls)
        ]

    def _corners(self, building: Building) -> list[Any]:
        row = []
        kinds = [("plain", ""), ("quoins", "quoins"), ("chamfer", "chamfer")]
        for k in range(len(building.plan)):
            own = building.corners.get(k)
            label = f"Corner {k + 1}"
            kind = own.kind if own is not None else ""
            row.append(self._field(label, Dropdown, kind, partial(_with_corner, k), options=kinds))
            if own is not None:
                wide = own.width if own.width is not None else building.designs[own.design].canvas.width
                row.append(self._length(f"{label}, width", wide, partial(_with_corner_width, k)))
        return row

    def _roof(self, building: Building) -> list[Any]:
        roof = building.roof

        def changed(
            name: str, read: Callable[[Any], Any] = lambda value: value
        ) -> Callable[[Building, Any], Building]:
            return lambda b, v: replace(b, roof=replace(b.roof, **{name: read(v)}))

        rise = "" if roof.rise is None else f"{roof.rise:g}"
        return [
            self._field(
                "Roof", Dropdown, roof.kind, changed("kind"), options=[(kind, kind) for kind in ROOFS]
            ),
            self._field("Rise", Text, rise, changed("rise", _rise), placeholder="by itself"),
            self._length("Overhang", roof.overhang, changed("overhang")),
            self._field(
                "Roof material", Combobox, roof.material, changed("material"), options=list(MATERIALS)
            ),
        ]

    def _length(self, label: str, value: float, change: Callable[[Building, Any], Building]) -> Any:
        return self._field(label, FloatText, round(value, 4), change, step=0.1)

    def _field(
        self, label: str, kind: Any, value: Any, change: Callable[[Building, Any], Building], **traits: Any
    ) -> Any:
        """The field of that name, the same as before where there was one: whoever types in it goes on."""
        field = self._kept.get(label)
        if not isinstance(field, kind):
            if kind is not Dropdown:
                traits["continuous_update"] = False
            field = kind(
                value=value, description=label, style={"description_width": "initial"},
                layout={"width": "auto" if kind is Dropdown else "13em"}, **traits,
            )  # fmt: skip
            field.observe(lambda event, label=label: self._typed(label, event["new"]), "value")
            self._kept[label] = field
        elif "options" in traits and tuple(field.options) != tuple(traits["options"]):
            field.options = traits["options"]
        self._changes[label] = change
        if field.value != value:
            field.value = value
        return field

    @property
    def _changes(self) -> dict[str, Callable[[Building, Any], Building]]:
        return self._kept.setdefault("", {})

    def _typed(self, label: str, value: Any) -> None:
        if self._quiet or self._building is None:
            return
        try:
            made = self._changes[label](self._building, value)
        except (DesignError, ValueError) as error:
            faults = getattr(error, "faults", ()) or (error,)
            told = "".join(f"<div>{escape(str(fault))}</div>" for fault in faults)
            self._fault.value = f'<div class="facade-nb-fault" role="alert">{told}</div>'
            return
        if made == self._building:
            self._fault.value = ""
        else:
            self._changed(made)


def _rise(text: str) -> float | None:
    if not text.strip():
        return None
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"rise: expected metres, or nothing; found {text!r}") from None


def _with_length(name: str, building: Building, value: float) -> Building:
    if not 0 < value < inf:
        told = _LENGTHS.get(name, f"Width of {name}").lower()
        raise ValueError(f"{told}: expected metres above 0; found {value:g}")
    kind, lengths = plan_of(building)
    return reshaped(building, kind, {**lengths, name: float(value)})


def _with_wall(number: int, building: Building, design: str) -> Building:
    made = walled(building, number, design or None)
    if not any(made.walls):
        raise ValueError(f"wall {number + 1}: expected a design on one wall at least; all would be blind")
    return made


def _with_corner(number: int, building: Building, kind: Treatment | None) -> Building:
    return treated(building, number, kind or None)


def _with_corner_width(number: int, building: Building, width: float) -> Building:
    return treated(building, number, building.corners[number].kind, width)


def _with_houses(building: Building, count: int) -> Building:
    """A row of more houses, or of fewer: of one it is a rectangle."""
    kind, lengths = plan_of(building)
    wide = [value for name, value in lengths.items() if name.startswith("house ")]
    if not 2 <= count <= 40:
        raise ValueError(f"houses: expected 2 to 40; found {count}")
    wide = (wide + [wide[-1]] * count)[:count]
    return reshaped(building, kind, {f"house {k}": value for k, value in enumerate(wide, 1)})
