"""The view of many designs: a table or pictures, sorted by any column; one of them is opened in the studio."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from html import escape
from typing import TYPE_CHECKING, Any

from traitlets import Enum, Unicode

from ...design import Design
from ...variations.answers import Answer
from ...variations.sheet import contact_sheet
from ...variations.variants import Variants
from ..shared.pictured import PartView
from ..studio.model import FacadeModel
from ..studio.parts import FIRST
from .channel import VariationsChannel
from .model import VariationsModel, told

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["VariationsView"]

_PICTURE_LIMIT = 60_000
"""Bytes of a contact sheet up to which a saved notebook carries it."""
_ROWS = 60
"""Rows of the static form."""


class VariationsView(PartView):
    """Variants of a design, solved one by one: click one, or press Enter, and it is opened in the studio.

    Parameters
    ----------
    source
        A design or a `FacadeModel`: it is solved for every combination of the values given, as by `sweep`. Or
        designs, such as `vary` makes. Or a table that `sweep` or `solve_each` returned, or some of its rows.
    model
        The shared model of a studio, or the studio itself, in which variants are opened. Without one it is
        `facade`, which ``Studio(view.facade)`` shows.
    width, height, counters, sizes, executor, time_limit
        As of `sweep`.

    Attributes
    ----------
    sort
        The column that rows are sorted by; with ``-`` before it, the largest first; empty: as they were given.
    look
        ``table`` or ``pictures``.

    Raises
    ------
    ValueError
        As `sweep`; and for a source that is none of these.
    """

    _shows = "variations"

    sort = Unicode("").tag(sync=True)
    look = Enum(["table", "pictures"], "table").tag(sync=True)

    def __init__(
        self,
        source: Design | FacadeModel | Iterable[Design] | pd.DataFrame,
        model: Any = None,
        *,
        width: Sequence[float] | None = None,
        height: Sequence[float] | None = None,
        counters: Mapping[str, Sequence[int]] | None = None,
        sizes: Mapping[str, Sequence[float]] | None = None,
        executor: Executor | None = None,
        time_limit: float | None = 10.0,
        **options: Any,
    ) -> None:
        facade = _facade(model)
        found: dict[int, Answer] = {}
        if isinstance(source, FacadeModel):
            facade, source = facade or source, source.design
        base = source if isinstance(source, Design) else None
        if isinstance(source, Design):
            variants = Variants.of_product(source, width=width, height=height, counters=counters, sizes=sizes)
        elif hasattr(source, "to_dict") and hasattr(source, "columns"):
            variants, found = told(source, facade.design if facade else None)
        else:
            variants = Variants.of_designs(_designs(source))
        self.model = VariationsModel(
            variants, facade, base=base, found=found, executor=executor, time_limit=time_limit
        )
        if not found:
            self.model.run()
        super().__init__(channel=VariationsChannel.of(self.model), part=self._shows, **options)

    @property
    def facade(self) -> FacadeModel:
        """The model of the studio that variants are opened in."""
        return self.model.facade

    @property
    def table(self) -> pd.DataFrame:
        """What is solved so far, as `sweep` returns it."""
        return self.model.table

    def __repr__(self) -> str:
        count = len(self.model.variants)
        return f"VariationsView({count} variant{'' if count == 1 else 's'} of {self.channel.name!r})"

    def to_html(self) -> str:
        """The static form: the table and, where it is not too large, a contact sheet, of what is solved soon."""
        self.model.wait(FIRST)
        variants, answers = self.model.variants, self.model.answers
        head = "".join(f"<th>{escape(name)}</th>" for name in (*variants.columns, "windows", ""))
        body = ""
        for k in range(min(len(variants), _ROWS)):
            answer = answers.get(k)
            layout = answer.layout if answer else None
            count = "" if layout is None else str(sum(shape.kind == "window" for shape in layout.shapes))
            error = "not solved yet" if answer is None else answer.error
            cells = ["" if value is None else f"{value:g}" for value in variants.values[k]]
            body += f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in (*cells, count, error))}</tr>"
        return f"{self._sheet()}<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"

    def _sheet(self) -> str:
        if not any(answer.layout for answer in self.model.answers.values()):
            return ""
        drawn = contact_sheet(self.table.head(_ROWS)).encode()
        if len(drawn) > _PICTURE_LIMIT:
            return ""
        data = b64encode(drawn).decode("ascii")
        return f'<img alt="Contact sheet of {escape(repr(self))}" src="data:image/svg+xml;base64,{data}">'


def _facade(model: Any) -> FacadeModel | None:
    """The shared model of what was given: itself, or that of a studio or another part."""
    own = getattr(model, "model", model)
    if own is None or isinstance(own, FacadeModel):
        return own
    raise ValueError(
        f"VariationsView: model: expected a FacadeModel or a Studio, found {type(model).__name__}"
    )


def _designs(source: object) -> list[Design]:
    given = list(source) if isinstance(source, Iterable) and not isinstance(source, str | bytes) else [source]
    designs: list[Design] = []
    for k, own in enumerate(given):
        if isinstance(own, Design):
            designs.append(own)
        else:
            raise ValueError(
                "VariationsView: expected a design, designs, or a table that sweep returned; "
                f"found {type(own).__name__}{f' in place {k}' if len(given) > 1 else ''}"
            )
    return designs
