"""Views that pages show live: ``<!-- live: name -->`` in a page of docs is the view of that name here."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from typing import Any

from ipywidgets.embed import dependency_state

from facade_nb import gallery, solve
from facade_nb import widgets as w
from facade_nb.render.town import Town

__all__ = ["PREVIEWS", "states"]

HOUSE = "residential-house"


@cache
def _model() -> w.FacadeModel:
    model = w.FacadeModel(gallery.load(HOUSE))
    model.wait()
    return model


@cache
def _solved(name: str) -> Any:
    return solve(gallery.load(name), trace=True)


@cache
def _texture() -> w.TextureModel:
    return w.TextureModel(gallery.grammar("figure-8"))


@cache
def _town() -> w.TownModel:
    return w.TownModel(Town.generate(40, seed=3))


PREVIEWS: dict[str, Callable[[], Any]] = {
    "studio": lambda: w.Studio(_model()),
    "elevation": lambda: w.ElevationView(_model()),
    "patterns": lambda: w.PatternEditor(_model()),
    "symbols": lambda: w.SymbolEditor(_model()),
    "counters": lambda: w.CounterEditor(_model()),
    "layers": lambda: w.LayerEditor(_model()),
    "canvas": lambda: w.CanvasEditor(_model()),
    "shapes": lambda: w.ShapeEditor(_model()),
    "toolbar": lambda: w.Toolbar(_model()),
    "solver": lambda: w.SolverView(_solved("figure-8")),
    "player": lambda: w.PlayerView(_solved("figure-8")),
    "facade": lambda: w.FacadeView(_solved("figure-8")),
    "analysis": lambda: w.AnalysisView(_solved(HOUSE), player=False),
    "words": lambda: w.WordsView(_solved("figure-7"), tolerance=1.0, step=1.0, player=False),
    "candidates": lambda: w.CandidatesView(_solved(HOUSE), player=False),
    "network": lambda: w.NetworkView(_solved("figure-8"), player=False),
    "alignment": lambda: w.AlignmentView(_solved(HOUSE), player=False),
    "sizing": lambda: w.SizingView(_solved(HOUSE), player=False),
    "qualifiers": w.QualifiersView,
    "code": lambda: w.CodeView(_solved("figure-8"), player=False),
    "runs": lambda: w.RunsView(_solved("figure-8"), player=False),
    "variations": lambda: w.VariationsView(gallery.load(HOUSE), width=[5.0, 6.0, 7.0, 8.0]),
    "texture": lambda: w.TextureView(_texture()),
    "grammar": lambda: w.GrammarEditor(_texture()),
    "pixel": lambda: w.PixelInspector(_texture()),
    "table": lambda: w.GrammarTable(_texture()),
    "town": lambda: w.TownView(_town(), "distance").keep(),
}
"""How each is made."""


def states(names: Iterable[str]) -> tuple[dict[str, Any], list[tuple[str, str]]]:
    """The state of some views together; and of each its model and its static form.

    Raises
    ------
    ValueError
        For a name that there is not.
    """
    views = []
    for name in names:
        if name not in PREVIEWS:
            raise ValueError(f"live: expected one of {', '.join(PREVIEWS)}; found {name}")
        view = PREVIEWS[name]()
        bundle, _ = view._repr_mimebundle_()  # as a notebook asks for it: the view's state is whole then
        views.append((view, bundle.get("text/html", "")))
    state = {
        "version_major": 2,
        "version_minor": 0,
        "state": dependency_state([view for view, _ in views], drop_defaults=False),
    }
    return state, [(view.model_id, static) for view, static in views]
