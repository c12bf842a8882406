"""What a person does with keys: they go the whole way, through JupyterLab's shortcuts, where `fill` writes a value."""

from __future__ import annotations

from playwright.sync_api import Locator

__all__ = ["paste", "retype", "slide"]


def retype(field: Locator, text: str) -> None:
    """Click into a field, select all that it holds and type over it; an empty text deletes it."""
    field.click()
    field.press("ControlOrMeta+a")
    if text:
        field.page.keyboard.type(text)
    else:
        field.press("Delete")


def paste(field: Locator, text: str) -> None:
    """As `retype`, for a long text: it comes from the clipboard."""
    field.click()
    field.press("ControlOrMeta+a")
    field.page.evaluate("text => navigator.clipboard.writeText(text)", text)
    field.press("ControlOrMeta+v")


def slide(field: Locator, value: float) -> None:
    """Bring a slider to a value by its keys: to the nearer end, by pages, then by steps."""
    low, high = field.evaluate("slider => [Number(slider.min), Number(slider.max)]")
    end, sign, keys = "Home", 1, ("PageUp", "ArrowRight")
    if value - low > high - value:
        end, sign, keys = "End", -1, ("PageDown", "ArrowLeft")
    field.press(end)
    for key in keys:
        while True:
            before = float(field.input_value())
            if abs(before - value) < 1e-6:
                return
            field.press(key)
            after = float(field.input_value())
            assert sign * (after - before) > 0, f"{key} does not move the slider beyond {before}"
            if sign * (after - value) > 1e-6:
                break
        if key.startswith("Page"):
            field.press("PageDown" if sign > 0 else "PageUp")
    raise AssertionError(f"the slider has no step at {value}")
