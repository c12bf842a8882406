"""The façade on the page is what Python draws, whatever was edited, though only what differs is changed in it."""

from __future__ import annotations

from collections.abc import Callable

from .jupyter import Notebook
from .waiting import eventually

Show = Callable[[str], Notebook]

PARSED = """text => {
    const drawn = document.querySelector(".fnb-sheet > svg:not(.fnb-overlay)");
    const own = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
    own.removeAttribute("style");
    const ids = drawn.querySelector("pattern, linearGradient").id.match(/^fnb-[a-z0-9]+/)[0];
    const shown = drawn.cloneNode(true);
    return [shown.outerHTML.replaceAll(ids, "PREFIX"), document.importNode(own, true).outerHTML];
}"""

DRAWN = (
    "__import__('facade_nb.render').render.elevation_svg("
    "model.layout, holes=True, background=False, prefix='PREFIX', theme=model_channel.theme)"
)


def test_the_page_shows_what_python_draws_and_keeps_what_stays(show: Show) -> None:
    lab = show(
        """
        studio = Studio(model)
        model_channel = studio.channel
        studio
        """
    )
    page = lab.page
    page.locator(".fnb-elevation [data-shape]").first.wait_for()
    page.evaluate(
        "() => { window.kept = document.querySelector('[data-layer=base][data-x=A][data-y=P][data-number=\"1 1\"]'); }"
    )
    for label, text, shapes in (
        ("Canvas width in metres", "6.4", 17),  # sizes alone
        ("Pattern Bx", "A(BA)^k A", 19),  # shapes come
        ("Canvas height in metres", "9", 19),  # another scale
        ("Pattern Bx", "A(BA)^2", 14),  # shapes go
    ):
        lab.retype(label, text)
        _check(lab, shapes)
    assert page.evaluate("() => window.kept.isConnected")


def _check(lab: Notebook, shapes: int) -> None:
    """Once the layout of all that was typed has come, with so many shapes, the page shows what Python draws."""

    def same() -> None:
        lab.settle()
        assert lab.python("[len(model.layout.shapes), model.busy]") == [shapes, False]
        shown, drawn = lab.page.evaluate(PARSED, lab.python(DRAWN))
        assert shown == drawn

    eventually(lab.page, same)
