"""Each part alone, several over one model, and the parts as they were saved."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import expect

from .conftest import Visit
from .jupyter import Notebook
from .keys import retype

Show = Callable[[str], Notebook]


def test_parts_over_one_model_follow_each_other(show: Show) -> None:
    lab = show("""
        from IPython.display import display
        display(PatternEditor(model), ElevationView(model), CounterEditor(model))
    """)
    page = lab.page
    expect(page.locator(".fnb")).to_have_count(3)
    expect(page.locator("[data-shape]")).to_have_count(17)
    lab.retype("Pattern Bx", "A(BA)^k A")
    expect(page.locator(".fnb-elevation [data-layer=base][data-x=A][data-y=Q]")).to_have_count(5)
    expect(page.locator(".fnb-counter[data-counter=k] .fnb-solved")).to_have_text("3")
    # One bundle for all of them, and one message for each change however many look on.
    sizes = lab.python(
        "[sum(len(str(v)) for v in w.get_state().values()) for w in __import__('ipywidgets').Widget.widgets.values()"
        " if type(w).__name__ in ('PatternEditor', 'ElevationView', 'CounterEditor') and w.model is model]"
    )
    assert len(sizes) == 3
    assert max(sizes) < 2500


@pytest.mark.parametrize(
    ("part", "label"),
    [
        ("PatternEditor", "Pattern Bx"),
        ("SymbolEditor", "Preferred size of A in metres"),
        ("CounterEditor", "Fixed value of counter k"),
        ("LayerEditor", "The vertical pattern of door"),
        ("CanvasEditor", "Canvas height in metres"),
        ("Toolbar", "Undo (Ctrl+Z)"),
        ("ElevationView", "Elevation: arrow keys go from shape to shape"),
        ("BuildingView", "Hour"),
        ("MassingView", "3D view: drag to orbit, scroll to zoom, click to pick"),
    ],
)
def test_each_part_shows_alone(show: Show, part: str, label: str) -> None:
    lab = show(f"{part}(model)")
    expect(lab.field(label)).to_be_visible()


def test_edits_from_python_are_shown(show: Show) -> None:
    lab = show("CanvasEditor(model)")
    lab.python("model.enter(('canvas', 'width'), 7.25)")
    expect(lab.field("Canvas width in metres")).to_have_value("7.25")


def test_every_control_has_a_name_and_keeps_its_keys(show: Show) -> None:
    lab = show("Studio(model)")
    nameless = lab.page.evaluate(
        """() => [...document.querySelectorAll('.fnb :is(button, input, select, textarea, [tabindex])')]
            .filter(e => !(e.ariaLabel || e.textContent.trim() || [...e.labels ?? []].some(l => l.textContent.trim()))
                || e.dataset.lmSuppressShortcuts !== 'true')
            .map(e => e.outerHTML)"""
    )
    assert nameless == []


def test_keys_do_not_reach_the_notebook_in_command_mode(show: Show) -> None:
    lab = show("Studio(model)")
    grip = lab.button("Move layer door")
    grip.focus()
    for key in ("d", "d", "x", "b", "m"):
        lab.page.keyboard.press(key)
    expect(lab.page.locator(".jp-Notebook-cell")).to_have_count(1)
    expect(grip).to_be_focused()


BUSY = """
import pathlib, time
while not pathlib.Path({path!r}).exists():
    time.sleep(0.02)
"""


def test_a_busy_kernel_is_told_and_nothing_typed_is_lost(show: Show, tmp_path: Path) -> None:
    lab = show("Studio(model)")
    enough = tmp_path / "enough"
    lab.page.evaluate(
        """code => {
            const { kernel } = window.jupyterapp.shell.currentWidget.sessionContext.session;
            kernel.requestExecute({code});
        }""",
        BUSY.format(path=str(enough)),
    )
    field = lab.field("Pattern Bx")
    retype(field, "A(BA)^2")
    expect(lab.page.locator(".fnb-status-line")).to_contain_text("kernel is busy")
    retype(field, "A(BA)^1")
    enough.touch()
    expect(lab.page.locator(".fnb-counter[data-counter=k]")).to_have_count(0)
    lab.expect_python("model.design.patterns['Bx'].text", "A(BA)^1")
    assert field.input_value() == "A(BA)^1"


def test_a_fault_of_ours_is_shown_under_the_widget(show: Show) -> None:
    lab = show("""
        def broken(*_, **__): raise ZeroDivisionError("a fault of ours")
        model._solver._solve = broken
        Studio(model)
    """)
    lab.retype("Canvas width in metres", "7")
    expect(lab.page.locator(".fnb-trouble summary")).to_contain_text("a fault of ours")
    lab.run("from facade_nb import solve; model._solver._solve = solve; Studio(model)")


def test_closing_the_output_ends_the_listeners(show: Show) -> None:
    lab = show("Studio(model)")
    lab.run("0")
    expect(lab.page.locator(".fnb")).to_have_count(0)
    assert lab.python("model.enter(('canvas', 'width'), 7.0) or model.wait(60)")
    # Nobody looks: the channel has put its large traits away.
    assert (
        lab.python(
            "len(__import__('facade_nb.widgets.studio.channel').widgets.studio.channel.Channel.of(model).svg)"
        )
        == 0
    )


def test_the_studio_notebook_shows_its_saved_state_and_then_runs(visit: Visit) -> None:
    with visit("lab") as notebook:
        page = notebook.page
        shutil.copy(Path(__file__).resolve().parents[2] / "notebooks" / "studio.ipynb", notebook.root)
        notebook.visit("studio.ipynb")
        picture = page.get_by_alt_text("Elevation of Residential house")
        expect(picture).to_be_visible()  # before the notebook is trusted
        assert picture.evaluate("image => image.naturalWidth") > 100
        notebook.trust()
        expect(page.locator("[data-shape]").first).to_be_attached()
        expect(page.locator(".fnb-status-line")).to_contain_text("read only")
        expect(page.locator(".fnb")).to_have_attribute("inert", "")
        notebook.run()
        expect(page.locator(".fnb-status-line")).to_contain_text("Solved in")
        expect(notebook.field("Canvas width in metres")).to_have_value("8")
        assert notebook.take_problems() == []


LOOKS = """part => [...document.querySelectorAll(`.fnb-${part} *`)].map(e => {
    const { padding, borderRadius, borderWidth, display, fontSize, height } = getComputedStyle(e);
    return [e.className, padding, borderRadius, borderWidth, display, fontSize, e.checkVisibility() && height];
})"""


def test_a_part_looks_the_same_beside_those_of_other_bundles(show: Show) -> None:
    looks = {}
    for code in (
        "Studio(model)",
        "GrammarEditor('S -> Skip(0)')",
        "from IPython.display import display\ndisplay(Studio(model), GrammarEditor('S -> Skip(0)'))",
        "from IPython.display import display\ndisplay(GrammarEditor('S -> Skip(0)'), Studio(model))",
    ):
        lab = show(code)
        if "Studio" in code:
            expect(lab.page.locator("[data-shape]")).to_have_count(17)
        for part in ("part-studio .fnb-toolbar", "part-studio .fnb-panel", "texture-editor"):
            if found := lab.page.evaluate(LOOKS, part):
                assert found == looks.setdefault(part, found), code
    assert len(looks) == 3
