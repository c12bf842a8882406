"""Qualifiers: the four cases of the paper's Figure 4 side by side, live."""

from __future__ import annotations

import traceback
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from anywidget import AnyWidget
from ipywidgets import Widget, widget_serialization
from traitlets import Bytes, Instance, Unicode

from ... import gallery
from ...design import Design, DesignError
from ...render import elevation_svg
from ...solver import Trace
from ...solver.events import AxisSolved, LetterPlaced, PathChosen
from ..shared.bundled import Bundled, Message, bundle
from ..shared.packing import pack
from ..studio.model import FacadeModel
from ..studio.parts import picture
from .built import PREFIX
from .timeline import hues

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["QualifiersView", "told_of"]

_QUALIFIERS = ("opaque", "attached", "unoccludable")
_CASES = ("qualifiers-a", "qualifiers-b", "qualifiers-c", "qualifiers-d")


class QualifiersChannel(Bundled):
    """The wire of one `QualifiersView`: its cases as the browser shows them."""

    front = "solver"

    cases = Bytes(help="The cases as they are told, packed: the drawings are large.").tag(sync=True)

    def __init__(self, models: Sequence[FacadeModel]) -> None:
        self.models = tuple(models)
        self._begun = [model.design for model in models]
        self.told: list[dict[str, Any]] = []
        super().__init__()
        for n, model in enumerate(self.models):
            model.observe(lambda _, n=n: self._publish(n), "version")
        self._refill()

    def _refill(self) -> None:
        self.told = [self._case(n) for n in range(len(self.models))]
        self.cases = pack(self.told)

    def _empty(self) -> None:
        self.cases = b""

    def _publish(self, n: int) -> None:
        if not self._asleep and not self.models[n].busy:
            self.told[n] = self._case(n)
            self.cases = pack(self.told)

    def _case(self, n: int) -> dict[str, Any]:
        model = self.models[n]
        design = model.design
        case: dict[str, Any] = {
            "name": design.name,
            "canvas": {"x": design.canvas.width, "y": design.canvas.height},
            "changed": design != self._begun[n],
            "message": model.message,
            "symbols": _symbols(design),
            "hues": hues(design),
            "patterns": [
                {"layer": own.name, "text": design.patterns[own.x.pattern].text} for own in design.stack
            ],
            "letters": [],
            "cuts": [],
            "svg": {"light": "", "dark": ""},
            "told": "",
            "cost": None,
        }
        if model.layout is not None and not model.stale and model.trace is not None:
            case |= _solved(model.trace, model.layout)
        return case

    def _answer(self, message: Message) -> None:
        try:
            model = self.models[message["case"]]
            if message["op"] == "set":
                model.enter(tuple(message["path"]), message["value"])
            elif message["op"] == "reset":
                model.edit(self._begun[message["case"]])
            self.trouble = ""
        except DesignError as error:
            self.trouble = str(error)
        except Exception:  # the edge to the browser: it is shown there, not lost in a log
            self.trouble = traceback.format_exc()


def _symbols(design: Design) -> list[dict[str, Any]]:
    """The symbols with a size that horizontal patterns write, with their qualifiers."""
    names = dict.fromkeys(
        symbol for own in design.stack for symbol in design.patterns[own.x.pattern].parsed.symbols
    )
    found = [design.symbol(name) for name in names]
    return [
        {"name": name, "size": own.size, **{key: getattr(own, key) for key in _QUALIFIERS}}
        for name, own in zip(names, found, strict=True)
        if own.size is not None
    ]


def _solved(trace: Trace, layout: Any) -> dict[str, Any]:
    path = trace.of_kind(PathChosen, "x")[0]
    letters = trace.of_kind(LetterPlaced, "x")
    solved = trace.of_kind(AxisSolved, "x")[0]
    return {
        "letters": [
            {
                "layer": e.layer,
                "symbol": e.symbol,
                "start": e.start,
                "end": e.end,
                "transparent": e.transparent,
                "mirrored": e.mirrored,
            }
            for e in letters
        ],
        "cuts": list(layout.x.groups[path.group].columns),
        "svg": {
            theme: elevation_svg(layout, theme=theme, background=False, prefix=PREFIX, width_px=420)
            for theme in ("light", "dark")
        },
        "told": told_of(trace),
        "cost": solved.cost,
    }


def told_of(trace: Trace) -> str:
    """What the solid letters of the upper word cover, in a sentence, from the chosen path."""
    path = trace.of_kind(PathChosen, "x")[0]
    top = next(band for band in path.bands if 0 in band.rows)
    t = path.bands.index(top)
    found: dict[str, None] = {}
    for j, column in enumerate(path.columns):
        own = [top.letters[n].symbol for n in column.letters[t] if not top.letters[n].transparent]
        if not own:
            continue
        below = [b for b in range(len(path.bands)) if b != t]
        under = "".join(path.bands[b].letters[n].symbol for b in below for n in column.letters[b])
        if under:
            found[f"{''.join(own)} covers {under}"] = None
        else:
            sides = "".join(
                next((path.bands[b].letters[k.letters[b][at]].symbol for b in below if k.letters[b]), "")
                for k, at in ((path.columns[j - 1], -1), (path.columns[min(j + 1, len(path.columns) - 1)], 0))
            )
            found[f"{''.join(own)} stands between {' and '.join(sorted(sides))}"] = None
    return "; ".join(found) + "." if found else "Nothing of the upper layer is solid."


class QualifiersView(AnyWidget):
    """The four cases of the paper's Figure 4: switch qualifiers, and see what the posts cover.

    Parameters
    ----------
    designs
        Designs, or models of them, each of which becomes a case; None: those of the paper's figure.

    Attributes
    ----------
    models
        The models of the cases; edit them, and the view follows.
    """

    _esm = bundle("loader.js")

    channel = Instance(Widget).tag(sync=True, **widget_serialization)
    part = Unicode("qualifiers").tag(sync=True)

    def __init__(self, designs: Sequence[FacadeModel | Design | str | Path] | None = None) -> None:
        chosen = [gallery.load(name) for name in _CASES] if designs is None else designs
        self.models = tuple(own if isinstance(own, FacadeModel) else FacadeModel(own) for own in chosen)
        for model in self.models:
            model.follow()
            model.wait()
        super().__init__(channel=QualifiersChannel(self.models))

    def __repr__(self) -> str:
        return f"QualifiersView({len(self.models)} cases)"

    @property
    def frame(self) -> pd.DataFrame:
        """The cases as a table: name, qualified symbols, J, columns, what covers what."""
        import pandas as pd

        rows = []
        for model in self.models:
            trace = model.trace
            solved = trace is not None and not model.stale and trace.of_kind(PathChosen, "x")
            rows.append(
                {
                    "case": model.design.name,
                    "width": model.design.canvas.width,
                    **{
                        key: " ".join(s["name"] for s in _symbols(model.design) if s[key])
                        for key in _QUALIFIERS
                    },
                    "cost": trace.of_kind(AxisSolved, "x")[0].cost if solved and trace else None,
                    "columns": len(trace.of_kind(PathChosen, "x")[0].columns) if solved and trace else None,
                    "told": told_of(trace) if solved and trace else model.message,
                }
            )
        return pd.DataFrame(rows)

    def to_html(self) -> str:
        """The elevations of the cases, with what covers what."""
        cells = ""
        for model in self.models:
            trace = model.trace
            said = told_of(trace) if trace is not None and not model.stale else model.message
            cells += f"<td>{picture(model.layout)}<br>{escape(model.design.name)}<br>{escape(said)}</td>"
        return f"<table><tr>{cells}</tr></table>"

    def _repr_mimebundle_(self, **options: Any) -> tuple[dict[str, Any], dict[str, Any]] | None:
        """The live view and, for pages where none can run, the static form."""
        self.channel.wake()
        made = super()._repr_mimebundle_(**options)
        if made is not None:
            made[0]["text/html"] = self.to_html()
        return made
