"""A person's hand in the studio: mouse and keyboard alone, and each action is counted.

An action is one click, one drag, one key chord, or one field typed: going into the field is part of typing, and so is
the Enter that ends a name. A choice from a list is two: the list is opened, and the choice is made.
"""

from __future__ import annotations

from typing import Literal

from playwright.sync_api import Locator, expect

from .jupyter import Notebook
from .keys import retype

__all__ = ["Hand"]

Pair = tuple[str, str]


class Hand:
    """Works in a studio, and counts its actions.

    Attributes
    ----------
    count
        The actions so far.
    """

    def __init__(self, studio: Notebook) -> None:
        self.studio = studio
        self.count = 0

    def click(self, target: Locator, *, more: bool = False) -> None:
        """Click; with `more`, Shift is held."""
        self.count += 1
        target.click(modifiers=["Shift"] if more else [])

    def press(self, name: str) -> None:
        """Click the button of that name."""
        self.click(self.studio.button(name))

    def type(self, text: str) -> None:
        """Type into the field that has the focus."""
        self.count += 1
        self.studio.page.keyboard.type(text)

    def write(self, label: str, text: str, *, enter: bool = False) -> None:
        """Type over what a field holds."""
        self.count += 1
        retype(self.studio.field(label), text)
        if enter:
            self.studio.page.keyboard.press("Enter")

    def choose(self, label: str, beginning: str) -> None:
        """Choose from a list: open it, and type how the choice begins."""
        self.count += 2
        self.studio.field(label).click()
        self.studio.page.keyboard.type(beginning)
        self.studio.page.keyboard.press("Enter")

    def begin(self, width: str, height: str) -> None:
        """From an empty studio to a canvas, with the focus in a first pattern."""
        self.write("Width of the new canvas in metres", width)
        self.write("Height of the new canvas in metres", height)
        self.press("New")
        expect(self.studio.field("Pattern P1")).to_be_focused()

    def first_pattern(self, name: str, text: str) -> None:
        """Type the pattern that has the focus, then its name."""
        self.type(text)
        self.write("Name of pattern P1", name, enter=True)
        expect(self.studio.field(f"Pattern {name}")).to_be_focused()

    def pattern(self, name: str, text: str) -> None:
        """Add a pattern."""
        self.press("Add a pattern")
        expect(self.studio.field("Pattern P1")).to_be_focused()
        self.first_pattern(name, text)

    def sizes(self, **sizes: str) -> None:
        """Type preferred sizes of symbols."""
        for symbol, size in sizes.items():
            self.write(f"Preferred size of {symbol} in metres", size)

    def layer(self, name: str) -> None:
        """Add a layer; it takes the patterns by itself."""
        self.press("Add a layer")
        expect(self.studio.field("The horizontal pattern of layer 1")).to_be_focused()
        self.write("Name of layer layer 1", name, enter=True)
        expect(self.studio.field(f"Name of layer {name}")).to_be_focused()

    def only(self, layer: str, symbol: str) -> None:
        """Mask the vertical pattern of a layer."""
        self.choose(f"Only this symbol of the vertical pattern of {layer}", f"only {symbol}")

    def group(self, layer: str, name: str) -> None:
        """Give the horizontal pattern of a layer a new alignment group."""
        self.choose(f"The horizontal alignment group of {layer}", "new group")
        self.type(name)
        self.studio.page.keyboard.press("Enter")

    def look(
        self,
        layer: str,
        *pairs: Pair,
        key: str = "",
        level: Literal["", "layer", "the design"] = "",
        geometry: str = "",
        material: str = "",
        kind: str = "",
        offset: str = "",
        thickness: str = "",
    ) -> None:
        """Pick a pair of a layer, or several, and give it looks."""
        for number, (x, y) in enumerate(pairs):
            self.click(self.studio.button(f"Pair {x} {y} of {layer}"), more=number > 0)
        picked = "the picked pairs" if len(pairs) > 1 else " ".join(pairs[0])
        what = f"of {picked} in {layer}"
        expect(
            self.studio.field(f"kind {what}")
        ).to_be_visible()  # what was picked before is not to be changed
        if key:
            self.choose("Which shapes are edited", key)
        if level:
            self.choose("Whose shapes are edited", level)
        if geometry:
            self.choose(f"geometry {what}", geometry)
        if material:
            self.click(self.studio.field(f"material {what}"))
            self.click(self.studio.page.get_by_role("option", name=material, exact=True))
        if kind:
            self.write(f"kind {what}", kind, enter=True)
        for name, value in (("offset", offset), ("thickness", thickness)):
            if value:
                self.write(f"{name} {what} in metres", value)
