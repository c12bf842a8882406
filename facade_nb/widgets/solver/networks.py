"""What the Network and the Alignment view read: networks with what the search did in them, and the chosen paths."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...solver import Trace
from ...solver.events import (
    AxisPosed,
    BandNote,
    CandidateJudged,
    ControlsAligned,
    EdgeRefused,
    EdgeWeighed,
    LimitRaised,
    NetworkClosed,
    NetworkOpened,
    NodeTaken,
    PairsMerged,
    PathChosen,
    RegionTraced,
    StructurePriced,
    TraceBegun,
    WaysMet,
)
from ...solver.trace.codec import to_plain

__all__ = ["KINDS", "aligned", "networks"]

Json = dict[str, Any]

KINDS = ("NodeTaken", "EdgeWeighed", "EdgeRefused", "WaysMet")
"""Kinds of steps, by the number that the piece gives them."""
_Step = NodeTaken | EdgeWeighed | EdgeRefused | WaysMet
_NOWHERE = -1
"""The place after a column of a band that need not be looked at."""


def networks(trace: Trace) -> Json:
    """Networks, their steps as flat arrays, regions, mergers and prices as they are told, and the chosen paths."""
    opened: dict[tuple[str, int], int] = {}
    told: list[Json] = []
    steps = _Steps()
    regions: list[Json] = []
    merged: list[Json] = []
    priced: list[Json] = []
    limits: list[Json] = []
    for at, e in enumerate(trace.events):
        if isinstance(e, NetworkOpened):
            opened[e.axis, e.network] = len(told)
            told.append({"at": at, "closed": None, **to_plain(e)})
        elif isinstance(e, NetworkClosed) and (e.axis, e.network) in opened:
            told[opened[e.axis, e.network]]["closed"] = {"at": at, **to_plain(e)}
        elif isinstance(e, _Step) and (e.axis, e.network) in opened:
            steps.add(at, opened[e.axis, e.network], e)
        elif isinstance(e, LimitRaised):
            limits.append({"at": at, **to_plain(e)})
        elif isinstance(e, RegionTraced):
            regions.append({"at": at, **to_plain(e)})
        elif isinstance(e, StructurePriced) and e.cost is not None:
            priced.append({"at": at, **to_plain(e)})
        elif isinstance(e, (PairsMerged, ControlsAligned)):
            merged.append({"at": at, **to_plain(e)})
    return {
        "networks": told,
        "steps": steps.arrays(),
        "regions": regions,
        "merged": merged,
        "priced": priced,
        "limits": limits,
        "paths": aligned(trace)["paths"],
    }


def aligned(trace: Trace) -> Json:
    """The chosen path of each group, with the tolerance it keeps and the layers of its rows."""
    layers: dict[tuple[str, str], Sequence[str]] = {}
    tolerance: dict[str, float] = {}
    canvas: dict[str, float] = {}
    groups: list[tuple[NetworkOpened, tuple[tuple[BandNote, ...], ...]]] = []
    paths: list[Json] = []
    asked = next(iter(trace.of_kind(TraceBegun)))
    for at, e in enumerate(trace.events):
        if isinstance(e, AxisPosed):
            canvas[e.axis] = e.canvas
            layers.update({(e.axis, group.name): group.layers for group in e.groups})
        elif isinstance(e, CandidateJudged) and e.fate == "best":
            tolerance[e.axis] = e.tolerance
        elif isinstance(e, NetworkOpened):
            groups.append((e, e.bands))
        elif isinstance(e, PathChosen):
            paths.append(
                {
                    "at": at,
                    **to_plain(e),
                    "canvas": canvas[e.axis],
                    "tolerance": tolerance.get(e.axis, 0.0),
                    "layers": list(layers.get((e.axis, e.group), ())),
                    "number": _number(groups, e),
                }
            )
    return {"paths": paths, "placements": _placements(asked)}


def _number(groups: list[tuple[NetworkOpened, tuple[tuple[BandNote, ...], ...]]], path: PathChosen) -> int:
    """Which group of its network a path is in; -1 where that is not told."""
    for opened, bands in groups:
        if (opened.axis, opened.network) == (path.axis, path.network) and path.bands in bands:
            return bands.index(path.bands)
    return -1


def _placements(asked: TraceBegun) -> dict[str, str]:
    """How symbols that are not opaque stand in their columns, where not in the middle."""
    symbols = asked.design.get("symbols", {})
    return {
        name: own["placement"]
        for name, own in symbols.items()
        if own.get("placement") not in (None, "center")
    }


class _Steps:
    """Steps as they are met; flat arrays in the end, with the places of all bands of all steps in one."""

    def __init__(self) -> None:
        self.rows: list[tuple[int, int, int, int, int, int, int]] = []
        self.numbers: list[tuple[float, ...]] = []
        self.paths: list[tuple[int, ...]] = []
        self.offsets: list[int] = []
        self.places: list[int] = []
        self.after: list[int] = []
        self.filled: list[int] = []
        self.texts: dict[str, int] = {"": 0}
        self.fates: dict[str, int] = {"": 0}

    def add(self, at: int, network: int, e: _Step) -> None:
        self.offsets.append(len(self.places))
        self.places += e.places
        column = e.column if isinstance(e, (EdgeWeighed, EdgeRefused)) else ()
        after = (e.after if isinstance(e, (EdgeWeighed, EdgeRefused)) else None) or ()
        for b, place in enumerate(e.places):
            letters = column[b] if b < len(column) else None
            to = after[b] if b < len(after) else None
            if to is None:
                to = _NOWHERE if letters is None else _after(place, letters)
            self.after.append(to)
            self.filled.append(bool(letters))
        fate = e.constraint if isinstance(e, EdgeRefused) else e.fate if isinstance(e, EdgeWeighed) else ""
        # what the numbers say is put in words where it is shown
        text = e.text if isinstance(e, EdgeRefused) and e.bound is None else ""
        self.rows.append(
            (
                at,
                network,
                KINDS.index(type(e).__name__),
                e.group,
                self.fates.setdefault(fate, len(self.fates)),
                self.texts.setdefault(text, len(self.texts)),
                int(getattr(e, "way", "forward") == "backward"),
            )
        )
        self.numbers.append(
            tuple(_real(getattr(e, name, None)) for name in ("omega", "cost", "bound", "against"))
        )
        self.paths.append(tuple(_whole(getattr(e, name, None)) for name in ("path", "parent", "rival")))

    def arrays(self) -> Json:
        rows = np.array(self.rows, np.int32).reshape(-1, 7).T
        omega, cost, bound, against = np.array(self.numbers, np.float64).reshape(-1, 4).T
        path, parent, rival = np.array(self.paths, np.int32).reshape(-1, 3).T
        at, network, kind, group, fate, text, way = rows
        small = {"network": network, "group": group}
        return {
            "at": at.copy(),
            **{name: own.astype(np.int16) for name, own in small.items()},
            **{name: own.astype(np.uint8) for name, own in {"kind": kind, "fate": fate, "way": way}.items()},
            "text": text.copy(),
            "omega": omega.copy(),
            "cost": cost.copy(),
            "bound": bound.copy(),
            "against": against.copy(),
            "path": path.copy(),
            "parent": parent.copy(),
            "rival": rival.copy(),
            "offset": np.array([*self.offsets, len(self.places)], np.int32),
            "places": np.array(self.places, np.int16),
            "after": np.array(self.after, np.int16),
            "filled": np.array(self.filled, np.uint8),
            "kinds": list(KINDS),
            "fates": list(self.fates),
            "texts": list(self.texts),
        }


def _after(place: int, letters: Sequence[int]) -> int:
    """Where a band stands after whole letters."""
    return 2 * (letters[-1] + 1) if letters else place


def _real(value: float | None) -> float:
    return float("nan") if value is None else float(value)


def _whole(value: int | None) -> int:
    return -1 if value is None else value
