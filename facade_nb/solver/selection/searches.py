"""The searches of groups on one axis: what candidates that have words in common share."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from ...design.model import Symbol
from .. import tuning
from ..alignment.group import Group, lone_unsized, make_group
from ..alignment.pricing import Priced
from ..budget import Progress
from ..cache import CACHE
from ..candidates.bounds import GroupKey, inputs_of, rows_of
from ..candidates.stream import Candidate
from ..effort import Effort
from ..model.letters import Letter, Word
from ..model.objective import Objective
from ..model.problem import AxisProblem
from ..sizing.system import size_axis, strain
from .clusters import GroupSearch
from .observer import AxisObserver

__all__ = ["Searches", "Setting", "weight_of"]


@dataclass(frozen=True, slots=True)
class Setting:
    """What the search of an axis is asked for: see `axis.AxisSearch`."""

    problem: AxisProblem
    objective: Objective
    tolerance: float
    method: str
    check: Effort
    trace: AxisObserver | None
    extend: Callable[[], None] | None
    progress: Progress

    @property
    def symbol(self) -> Callable[[str], Symbol]:
        """The symbol of a name; an undeclared one is unsized."""
        symbols = self.problem.symbol
        return lambda name: symbols.get(name) or Symbol(name)


def weight_of(priced: Priced) -> float:
    """Bytes that a structure takes, about."""
    return tuning.ELEMENT_BYTES + tuning.ELEMENT_BYTES * sum(
        len(column) for columns in priced.structure for column in columns
    )


class _Rows:
    """The rows of a group, and the words they were made of (which keeps those, and so their identities, alive)."""

    __slots__ = ("letters", "unsized", "words")

    def __init__(self, letters: list[tuple[Letter, ...]], words: tuple[Word, ...]) -> None:
        self.letters, self.words = letters, words
        self.unsized = {letter.symbol for row in letters for letter in row if letter.size is None}


class Searches:
    """The searches of groups, by the words and by what is aligned alike.

    Attributes
    ----------
    runs
        By what groups are told apart (`Group.identity`).
    """

    def __init__(self, setting: Setting) -> None:
        self._setting = setting
        self.runs: dict[object, GroupSearch] = {}
        self._rows: dict[object, _Rows] = {}
        self._by_words: dict[object, GroupSearch] = {}
        self._inputs: list[tuple[str, ...]] | None = None

    def of(self, candidate: Candidate) -> tuple[list[list[int]], list[GroupKey], list[GroupSearch]]:
        """Which groups of a candidate are aligned together, what each depends on, and the search of each cluster."""
        rows, keys, clusters = self._rows_of(candidate)
        runs = [self._same_words(rows, own, tuple(keys[g] for g in own)) for own in clusters]
        return clusters, keys, runs

    def groups(self, candidate: Candidate) -> tuple[list[list[int]], list[Group]]:
        """Which groups of a candidate are aligned together, and all of them; nothing is searched."""
        rows, _, clusters = self._rows_of(candidate)
        made = {g: group for own in clusters for g, group in zip(own, self._made(rows, own), strict=True)}
        return clusters, [made[g] for g in range(len(made))]

    def keep(self) -> None:
        """Keep what has been found for the next call, and let go of what can be made again."""
        for key, run in self.runs.items():
            if run.done and not run.cut:
                letters = sum(len(band.letters) for group in run.groups for band in group.bands)
                weight = tuning.LETTER_BYTES * (1 + letters) + sum(map(weight_of, run.ties))
                CACHE.groups.put(self._known_as(key), (run.ties, run.floor), weight)
            for group in run.groups:
                group.forget()

    def clear(self) -> None:
        """Let go of all searches."""
        self.runs.clear()
        self._rows.clear()
        self._by_words.clear()

    def _same_words(self, rows: Sequence[_Rows], cluster: Sequence[int], words: object) -> GroupSearch:
        """The search of a cluster: the one that there is for the same words, or others with the same letters."""
        run = self._by_words.get(words)
        if run is None:
            groups = self._made(rows, cluster)
            key = tuple(group.identity for group in groups)
            run = self.runs.get(key)
            if run is None:
                known = CACHE.groups.get(self._known_as(key)) if self._setting.trace is None else None
                run = self.runs[key] = self.run(groups, None, cluster, known)
            self._by_words[words] = run
        return run

    def _made(self, rows: Sequence[_Rows], cluster: Sequence[int]) -> list[Group]:
        """The groups of a cluster."""
        unsized = any(rows[g].unsized for g in cluster)
        free = lone_unsized(*(dict.fromkeys(rows[g].letters) for g in cluster)) if unsized else frozenset()
        return [
            make_group(
                rows[g].letters,
                self._setting.problem.canvas,
                self._setting.tolerance,
                self._setting.objective,
                free=free,
                check=self._setting.check,
            )
            for g in cluster
        ]

    def run(
        self,
        groups: Sequence[Group],
        accept: Callable[[Priced], bool] | None,
        cluster: Iterable[int],
        known: tuple[list[Priced], float] | None = None,
    ) -> GroupSearch:
        """A search of groups that are aligned together; with `accept`, of structures that will do only."""
        nodes = tuning.PATHS if accept is None and not self._setting.objective.plain else tuning.PATHS // 50
        log = None
        if self._setting.trace is not None:
            names = [self._setting.problem.groups[g][0] for g in cluster]
            log = self._setting.trace.walk(self._setting.problem.axis, names, groups, self._setting.method)

        problem, symbol = (
            self._setting.problem,
            self._setting.symbol,
        )  # a search does not refer to this, which refers to it

        def fits(priced: Priced) -> bool:
            parts = tuple((priced, k) for k in range(len(groups)))
            return size_axis(groups, parts, problem.canvas, symbol) is not None

        def strained(priced: Priced) -> float:
            parts = tuple((priced, k) for k in range(len(groups)))
            return 0.0 if fits(priced) else max(1e-9, strain(groups, parts, problem.canvas, symbol))

        return GroupSearch(
            groups, self._setting.method, nodes, self._setting.check, accept, log, known, fits, strained
        )

    def _known_as(self, key: object) -> object:
        return (
            key,
            self._setting.problem.canvas,
            self._setting.tolerance,
            self._setting.objective,
            self._setting.method,
        )

    def _rows_of(self, candidate: Candidate) -> tuple[list[_Rows], list[GroupKey], list[list[int]]]:
        """The rows of each group, what they depend on, and which groups are aligned together.

        Those are that share an unsized symbol.
        """
        if self._inputs is None:
            self._inputs = inputs_of(self._setting.problem)
        rows: list[_Rows] = []
        keys: list[GroupKey] = []
        for g, (names, (_, standing)) in enumerate(
            zip(self._inputs, self._setting.problem.groups, strict=True)
        ):
            words = tuple(candidate.words[name] for name in names)
            key = (g, *map(id, words))
            own = self._rows.get(key)
            if own is None:
                own = self._rows[key] = _Rows(
                    rows_of(self._setting.problem, candidate.words, standing), words
                )
            rows.append(own)
            keys.append(key)
        clusters: list[list[int]] = []
        for g, one in enumerate(rows):
            if not one.unsized:
                clusters.append([g])
                continue
            joined = [c for c in clusters if any(rows[o].unsized & one.unsized for o in c)]
            clusters = [c for c in clusters if c not in joined]
            clusters.append(sorted([g, *(o for c in joined for o in c)]))
        return rows, keys, clusters
