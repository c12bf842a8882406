"""The progress of a town is shown where there is a notebook, and nowhere else."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import IPython
import IPython.display
import pytest

from facade_nb.render.town import Town
from facade_nb.widgets import TownProgress


class Handle:
    """Where something is displayed."""

    def __init__(self, shown: list[str]) -> None:
        self.shown = shown

    def update(self, html: Any) -> None:
        self.shown.append(html.data)


def test_it_tells_each_stage_in_one_place(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[str] = []
    displayed: list[str] = []

    def display(html: Any, display_id: bool) -> Handle:
        displayed.append(html.data)
        return Handle(shown)

    monkeypatch.setattr(IPython, "get_ipython", lambda: SimpleNamespace(kernel=object()))
    monkeypatch.setattr(IPython.display, "display", display)
    stages: list[tuple[float, str]] = []
    progress = TownProgress()

    def told(share: float, name: str) -> None:
        stages.append((share, name))
        progress(share, name)

    Town.generate(12, seed=1, progress=told)
    assert len(displayed) == 1
    assert len(shown) == len(stages) - 1
    for (share, name), html in zip(stages[:-1], displayed + shown, strict=False):
        assert f'value="{share:.3f}"' in html
        assert name in html
    assert "The town was made in" in shown[-1]
    assert "progress max" not in shown[-1]


@pytest.mark.parametrize("shell", [None, object()], ids=["Python", "IPython in a terminal"])
def test_outside_a_notebook_it_shows_nothing(
    shell: object, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(IPython, "get_ipython", lambda: shell)
    TownProgress()(0.5, "roofs")
    assert capsys.readouterr() == ("", "")
