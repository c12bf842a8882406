"""Rules of a texture grammar as materials, written in the studio."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from playwright.sync_api import expect

from .jupyter import Notebook

FIRST = "Red -> Mat(Color, 0, 0.6, 0.2, 0.1, 1)"
SECOND = "Blue -> Mat(Color, 0, 0.1, 0.3, 0.6, 1)"


def test_rules_are_written_chosen_and_undone(show: Callable[[str], Notebook], out: Path) -> None:
    studio = show("Studio(model, height=900)")
    page = studio.page
    page.locator("summary", has_text="Rules").click()
    field = studio.field("Rules of materials")
    field.click()
    page.keyboard.type(FIRST)
    page.keyboard.press("Enter")
    page.keyboard.type("Blue -> Mat(Color, 0")
    studio.expect_python("model.design.grammar", f"{FIRST}\nBlue -> Mat(Color, 0")
    alert = page.locator(".fnb-rules").get_by_role("alert")
    expect(alert).to_contain_text("Blue -> Mat(Color, 0")
    expect(field).to_have_attribute("aria-invalid", "true")
    page.keyboard.type(", 0.1, 0.3, 0.6, 1)")
    studio.expect_python("model.design.grammar", f"{FIRST}\n{SECOND}")
    expect(alert).to_be_hidden()
    expect(page.locator(".fnb-rules")).to_contain_text("Materials now: rule:Red, rule:Blue.")

    page.locator(".fnb-elevation [data-layer=base][data-x=A][data-y=Q]").first.click()
    page.get_by_role("button", name="material of A Q in base").click()
    page.get_by_role("option", name="rule:Blue").click()
    studio.expect_python(
        "sorted({s.material for s in model.layout.shapes if s.layer == 'base' and (s.x, s.y) == ('A', 'Q')})",
        ["rule:Blue"],
    )
    expect(page.locator(".fnb-status-line")).not_to_contain_text("expected a rule")
    page.locator(".fnb-studio").screenshot(path=out / "rules.png")
    page.keyboard.press("Control+z")
    studio.expect_python("any('rule:' in s.material for s in model.layout.shapes)", False)
