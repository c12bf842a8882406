"""The studio of a building: choose a wall, edit its design, see the heights of all walls follow."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from secrets import token_hex
from typing import Any

from ipywidgets import HTML, ToggleButton, ToggleButtons, VBox
from traitlets import Instance, Unicode

from ...building import Building, BuildingLayout
from ...building.faces import faces
from ...design import Design
from ...design.model import Canvas
from ...render.pipeline.solids import Solids
from ...solver import Layout
from .model import FacadeModel
from .plan_panel import PlanPanel
from .strip import strip_of
from .studio import Studio
from .whole import Whole, solids_around

__all__ = ["BuildingStudio"]

_NEAR = 1e-9


class BuildingStudio(VBox):
    """A strip with all walls, fields for plan, corners and roof, a choice of a wall, and a `Studio` for its design.

    The studio's 3D shows the whole building, the chosen wall in front and marked; a click on another wall chooses that.
    Plan, corners and roof have an undo of their own. An edit solves the whole building again: what changes the heights
    of one wall changes those of all. Walls of one design change together. The height of the canvas is the building's;
    its width is that of the wall in the plan.

    Parameters
    ----------
    building
        A `Building`, its JSON text or a path to it.
    time_limit
        Seconds after which a solve ends with the best layout found so far.
    traits
        Of the `Studio`: ``height``, ``view``.

    Attributes
    ----------
    building
        As it is now; assign another one to go on with that.
    solved
        The last one; None before the first.
    wall
        The name of the face that is edited, such as ``wall 1``.
    """

    building: Building = Instance(Building)
    solved: BuildingLayout | None = Instance(BuildingLayout, allow_none=True)
    wall: str = Unicode("")

    def __init__(self, building: Building | str | Path, *, time_limit: float = 20.0, **traits: Any) -> None:
        if not isinstance(building, Building):
            building = Building.from_json(building)
        self._time_limit, self._given = time_limit, traits
        self._studios: dict[str, Studio] = {}
        self._models: dict[str, FacadeModel] = {}
        self._found: tuple[Building, BuildingLayout, str] | None = None
        self._theme = "light"
        self._prefix = f"walls{token_hex(4)}"
        self._strip = HTML(layout={"width": "100%"})
        self._choice = ToggleButtons(description="", style={"button_width": "auto"})
        self._choice.add_class("facade-nb-walls")
        self._past: list[Building] = []
        self._future: list[Building] = []
        self._wholes: dict[str, tuple[Layout, BuildingLayout]] = {}
        self._panel = PlanPanel(self._reshape, self.undo, self.redo)
        opened = ToggleButton(
            description="Plan, corners and roof",
            icon="caret-right",
            layout={"width": "auto", "align_self": "flex-start"},
        )
        opened.observe(lambda change: self._open(change["owner"]), "value")
        self._open(opened)
        self._plan = VBox([opened, self._panel])
        super().__init__(children=[self._strip, self._plan, self._choice])
        self.add_class("facade-nb-keys")  # the studio in it keeps the keys of these fields from JupyterLab
        self.building = building
        self._offer()
        self._choice.observe(lambda change: self._choose(change["new"]), "value")
        self.observe(self._replaced, "building")
        self._choice.value = self._choice.options[0][1]

    @property
    def model(self) -> FacadeModel:
        """The model of the wall that is edited."""
        return self._models[self.wall]

    def choose(self, wall: str) -> None:
        """Edit another wall. Raises `ValueError`, with all names, where there is none of that name, or it is blind."""
        names = [value for _, value in self._choice.options]
        if wall not in names:
            raise ValueError(f"expected one of {', '.join(names)}; found {wall!r}")
        self._choice.value = wall

    def reshape(self, building: Building) -> None:
        """Go on with a building of another plan, other corners or another roof, as one step that `undo` takes back."""
        self._reshape(building)

    def undo(self) -> None:
        """Take back the last change of plan, corners or roof; designs stay as they are now."""
        if self._past:
            self._future.append(self.building)
            self._go_on(_with_designs(self._past.pop(), self.building))

    def redo(self) -> None:
        """Make again what was taken back last."""
        if self._future:
            self._past.append(self.building)
            self._go_on(_with_designs(self._future.pop(), self.building))

    def _open(self, button: ToggleButton) -> None:
        """Show the fields of plan, corners and roof while the button is down."""
        button.icon = "caret-down" if button.value else "caret-right"
        self._panel.layout.display = None if button.value else "none"

    def close(self) -> None:
        """Stop solving, and close all widgets."""
        for model in self._models.values():
            model.close()
        super().close()

    def _offer(self) -> None:
        """The walls that there are to choose."""
        around = [face for face in faces(self.building) if face.design is not None]
        options = [(f"{face.name} · {face.design} · {face.length:.2f} m", face.name) for face in around]
        quoins = {own.design: number for number, own in self.building.corners.items() if own.kind == "quoins"}
        options += [(f"quoins · {design}", f"quoins {design}") for design in quoins]
        self._offering = True
        try:
            self._choice.options = options or [("no walls", "")]
        finally:
            self._offering = False
        self._panel.show(self.building, undo=bool(self._past), redo=bool(self._future))

    def _reshape(self, building: Building) -> None:
        self._past.append(self.building)
        self._future.clear()
        self._go_on(building)

    def _go_on(self, building: Building) -> None:
        """Take on another plan, other corners or another roof. Walls that keep their design keep their undo."""
        before = {wall: self._design_of(wall) for wall in self._models}
        self._assign(building)
        wall = self.wall
        self._offer()
        names = [value for _, value in self._choice.options]
        for name, design in before.items():
            if name not in names or self._design_of(name) != design:
                self._models.pop(name).close()
                self._studios.pop(name)
        self._choice.value = wall if wall in names else names[0]
        self._choose(self._choice.value)

    def _assign(self, building: Building) -> None:
        self.unobserve(self._replaced, "building")
        self.building = building
        self.observe(self._replaced, "building")

    def _walls(self) -> list[str]:
        return [value for _, value in self._choice.options]

    def _around(self, wall: str, layout: Layout) -> Solids | None:
        """The building around a layout of a wall's model."""
        own, whole = self._wholes.get(wall, (None, None))
        return solids_around(whole, wall, layout, self._walls()) if whole and own is layout else None

    def _design_of(self, wall: str) -> str:
        """The name of the design of a choice."""
        if wall.startswith("quoins "):
            return wall.removeprefix("quoins ")
        return next((f.design for f in faces(self.building) if f.name == wall and f.design), "")

    def _width_of(self, wall: str) -> float:
        """How wide a choice is, metres."""
        key = self._design_of(wall)
        if wall.startswith("quoins "):
            widths = (own.width for own in self.building.corners.values() if own.design == key)
            return next((w for w in widths if w is not None), self.building.designs[key].canvas.width)
        return next(face.length for face in faces(self.building) if face.name == wall)

    def _choose(self, wall: str | None) -> None:
        """Show the studio of a wall."""
        if not wall or self._offering:
            return
        key = self._design_of(wall)
        design = replace(
            self.building.designs[key], canvas=Canvas(self._width_of(wall), self.building.height)
        )
        before = self.wall
        if wall not in self._studios:
            # What stands around the wall is of one solve: nothing is shown before that has ended.
            model = FacadeModel(design, time_limit=self._time_limit, solve=self._solver(wall), first=None)
            self._models[wall] = model
            model.whole = Whole(self._walls, partial(self._around, wall), self._choose_number)
            self._studios[wall] = Studio(model, **self._given)
            self._studios[wall].channel.observe(lambda change: self._dress(change["new"]), "theme")
            model.observe(lambda _: self._follow(wall), "version")
        elif self._models[wall].design != design:  # it has changed on another wall of the same design
            self._models[wall].load(design)
        elif self._found is not None and self._found[0] != self.building:  # other walls have changed
            self._models[wall].solve_for(self._time_limit)
        self.wall = wall  # last: it has a model then, whichever thread asks
        if before in self._studios:  # one goes on looking as one did
            self._studios[wall].view = self._studios[before].view
            self._studios[wall].hour = self._studios[before].hour
        self.children = [self._strip, self._plan, self._choice, self._studios[wall]]
        self._follow(wall)

    def _solver(self, wall: str) -> Callable[..., Layout]:
        """Solves the whole building with a wall's design; called in a thread of the model's."""

        def solved(
            design: Design,
            *,
            time_limit: float | None = None,
            should_stop: Callable[[], bool] | None = None,
            trace: bool = False,
        ) -> Layout:
            building = self._with(wall, design)
            layout = building.solve(time_limit=time_limit, should_stop=should_stop)
            self._found = building, layout, strip_of(layout, wall, self._theme, self._prefix)
            own = _own(layout, wall, design)
            self._wholes[wall] = own, layout
            return own

        return solved

    def _choose_number(self, number: int) -> None:
        """Edit the wall of that number among those to choose."""
        names = self._walls()
        if 0 <= number < len(names):
            self.choose(names[number])

    def _with(self, wall: str, design: Design) -> Building:
        """The building with another design on a wall, and on all walls of that design."""
        key = self._design_of(wall)
        canvas = self.building.designs[key].canvas  # a canvas of its own means nothing here
        designs = {**self.building.designs, key: replace(design, canvas=canvas)}
        return replace(self.building, designs=designs, height=design.canvas.height)

    def _follow(self, wall: str) -> None:
        """Take over what a model has come to."""
        if wall != self.wall:
            return
        model = self._models[wall]
        width = self._width_of(wall)
        if abs(model.design.canvas.width - width) > _NEAR:  # that is the plan's
            model.edit(lambda own: replace(own, canvas=Canvas(width, own.canvas.height)))
            return
        changed = self._with(wall, model.design)
        if changed != self.building:
            self._assign(changed)
            self._panel.show(changed, undo=bool(self._past), redo=bool(self._future))
        if self._found is not None and self._found[0] == self.building:
            self.solved = self._found[1]
            self._strip.value = self._found[2]

    def _dress(self, theme: str) -> None:
        """Draw the strip in the theme that a browser has told the studio below it."""
        if theme != self._theme:
            self._theme = theme
            if self._found is not None:
                building, layout, _ = self._found
                self._found = building, layout, strip_of(layout, self.wall, theme, self._prefix)
                self._follow(self.wall)

    def _replaced(self, change: Any) -> None:
        """Another building was assigned."""
        for model in self._models.values():
            model.close()
        self._models.clear()
        self._studios.clear()
        self._wholes.clear()
        self._past.clear()
        self._future.clear()
        self._found = None
        wall = self.wall
        self._offer()
        names = [value for _, value in self._choice.options]
        self._choice.value = wall if wall in names else names[0]
        if self.wall not in self._models:
            self._choose(self._choice.value)


def _with_designs(building: Building, now: Building) -> Building:
    """A building as it was, with its designs and its height as they are now."""
    return replace(building, designs={**building.designs, **now.designs}, height=now.height)


def _own(layout: BuildingLayout, wall: str, design: Design) -> Layout:
    """The layout of a wall as its design makes it, without the parts of quoins; of quoins, their strip."""
    if wall.startswith("quoins "):
        return replace(layout.strips[wall.removeprefix("quoins ")], design=design)
    own = layout.face(wall).layout
    layers = {layer.name for layer in design.layers}
    return replace(own, shapes=tuple(shape for shape in own.shapes if shape.layer in layers), design=design)
