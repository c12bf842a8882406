"""A trace: the events of one call of `solve`, made as they are read, written and read as JSON."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any, TypeVar, overload

from ...design.errors import DesignError, Fault
from ...design.inputs import read_text
from ..events import Event
from .codec import FORMAT, from_plain, to_plain

if TYPE_CHECKING:
    import pandas as pd

    from ..model.layout import Layout
    from .lattice import Lattice
    from .recorder import Recorder
    from .weights import Refusal, Weight

__all__ = ["Events", "Trace"]

_Kind = TypeVar("_Kind", bound=Event)


class Events(Sequence[Event]):
    """A sequence that is made no further than it is read."""

    def __init__(self, source: Iterable[Event]) -> None:
        self._source: Iterator[Event] | None = iter(source)
        self._made: list[Event] = []
        self._making = Lock()  # views may read from several threads

    def __reduce__(self) -> tuple[type[Events], tuple[list[Event]]]:
        """A copy, or a pickle, is of events, not of what makes them."""
        return Events, (list(self),)

    def _make(self, upto: int | None) -> None:
        with self._making:
            while self._source is not None and (upto is None or len(self._made) <= upto):
                event = next(self._source, None)
                if event is None:
                    self._source = None
                else:
                    self._made.append(event)

    @overload
    def __getitem__(self, index: int) -> Event: ...
    @overload
    def __getitem__(self, index: slice) -> list[Event]: ...
    def __getitem__(self, index: int | slice) -> Event | list[Event]:
        if isinstance(index, int):
            self._make(index if index >= 0 else None)
        else:
            bounded = index.stop is not None and index.stop >= 0 and (index.start or 0) >= 0
            self._make(index.stop - 1 if bounded and (index.step or 1) > 0 else None)
        return self._made[index]

    def __len__(self) -> int:
        self._make(None)
        return len(self._made)

    def __iter__(self) -> Iterator[Event]:
        n = 0
        while True:
            while n < len(self._made):  # what is made is never taken back: it is read without the lock
                yield self._made[n]
                n += 1
            if self._source is None and n == len(self._made):
                return
            self._make(n)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and list(self) == list(other)

    __hash__ = None  # type: ignore[assignment]  # it has an order and an equality, but it is no key

    def __repr__(self) -> str:
        more = "" if self._source is None else ", more to be made"
        return f"<Events: {len(self._made)} made{more}>"


class Trace:
    """What `solve` did, told as events.

    ``layout.trace.events`` is a sequence of frozen events (`facade_nb.solver.events`), in an order in which they can
    be played: axis by axis, stage by stage. The methods with a stage's name give it as a pandas DataFrame.
    """

    def __init__(self, events: Iterable[Event] = ()) -> None:
        self.events = events if isinstance(events, Events) else Events(events)

    @classmethod
    def of(cls, recorder: Recorder) -> Trace:
        """The trace of what a recorder has noted."""
        return cls(_told(recorder))

    def __repr__(self) -> str:
        return f"<Trace {self.events!r}>"

    def of_kind(self, kind: type[_Kind], axis: str | None = None) -> list[_Kind]:
        """The events of one kind, of both axes or of the one given."""
        return [e for e in self.events if isinstance(e, kind) and (axis is None or e.axis == axis)]

    # Documents

    def to_dict(self) -> dict[str, Any]:
        """The trace document: ``{"format": "facade-nb/trace/1", "events": [...]}``."""
        return {"format": FORMAT, "events": [to_plain(event) for event in self.events]}

    def to_json(self) -> str:
        """The document as JSON text, one event a line."""
        lines = (json.dumps(to_plain(e), ensure_ascii=False, allow_nan=False) for e in self.events)
        return f'{{"format": {json.dumps(FORMAT)}, "events": [\n' + ",\n".join(lines) + "\n]}\n"

    @classmethod
    def from_dict(cls, document: Mapping[str, Any]) -> Trace:
        """Read a trace document.

        Raises
        ------
        DesignError
            With the place, what was expected and what was found.
        """
        found = document.get("format") if isinstance(document, Mapping) else None
        if found != FORMAT:
            raise DesignError(Fault("format", f"expected {FORMAT!r}, found {found!r}"))
        events = document.get("events")
        if not isinstance(events, list):
            raise DesignError(Fault("events", f"expected a list, found {type(events).__name__}"))
        return cls([from_plain(event, f"events[{n}]") for n, event in enumerate(events)])

    @classmethod
    def from_json(cls, source: str | Path) -> Trace:
        """Read a trace from JSON text or from a file's path.

        Raises
        ------
        DesignError
            For a file that cannot be read, for text that is not JSON (with line and column), and as `from_dict`.
        """
        text = read_text(source) if isinstance(source, Path) else source.removeprefix("\ufeff")
        try:
            document = json.loads(text, parse_constant=_no_number)
        except json.JSONDecodeError as error:
            what = f"expected JSON: {error.msg}"
            raise DesignError(Fault("", what, error.lineno, error.colno)) from None
        if not isinstance(document, dict):
            raise DesignError(Fault("", f"expected a trace document, found {type(document).__name__}"))
        return cls.from_dict(document)

    # What can be made of it

    def replay(self) -> Layout:
        """The layout that these events make: see `replay`."""
        from .replay import replay

        return replay(self.events)

    def lattice(self, axis: str, group: str, bands: tuple[int, int] | None = None) -> Lattice:
        """The alignment decision network of a group: see `lattice.traced_lattice`."""
        from .lattice import traced_lattice

        return traced_lattice(self, axis, group, bands)

    def judge(
        self, axis: str, group: str, columns: Sequence[Sequence[Sequence[int]]]
    ) -> list[tuple[Weight, Refusal | None]]:
        """Judge columns that somebody made up for a group: what each weighs, and what it breaks.

        See `weights.judge`.
        """
        from .lattice import traced_group
        from .weights import judge

        return judge(traced_group(self, axis, group), columns)

    def analysis(self) -> pd.DataFrame:
        """A table of the pairs of patterns that were compared, with the equation of each."""
        from .tables import analysis

        return analysis(self)

    def words(self) -> pd.DataFrame:
        """A table of the words, kept and dropped, with the reason."""
        from .tables import words

        return words(self)

    def candidates(self) -> pd.DataFrame:
        """A table of the candidates, with what became of each."""
        from .tables import candidates

        return candidates(self)

    def nodes(self) -> pd.DataFrame:
        """A table of the partial paths that the search took up."""
        from .tables import nodes

        return nodes(self)

    def edges(self) -> pd.DataFrame:
        """A table of the columns that the search weighed, and of those it refused."""
        from .tables import edges

        return edges(self)

    def path(self) -> pd.DataFrame:
        """A table of the columns of the chosen alignments."""
        from .tables import path

        return path(self)

    def equations(self) -> pd.DataFrame:
        """A table of the bounds and rows of the least-squares systems."""
        from .tables import equations

        return equations(self)

    def active_set(self) -> pd.DataFrame:
        """A table of the steps of the active-set method."""
        from .tables import active_set

        return active_set(self)

    def timings(self) -> pd.DataFrame:
        """A table of the seconds that each stage and each network took."""
        from .tables import timings

        return timings(self)


def _told(recorder: Recorder) -> Iterator[Event]:
    from .narration import tell  # what tells is not loaded before it is asked for

    yield from tell(recorder)


def _no_number(name: str) -> float:
    raise DesignError(Fault("", f"expected a number, found {name}; a trace holds none that is not finite"))
