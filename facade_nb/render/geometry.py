"""The geometries a shape can have, each a small recipe of parts (see `parts` for their frame).

``offset`` places the face of a shape: positive towards the viewer, 0 in the plane of the façade. ``thickness`` goes
backwards from there. A few geometries have parts that reach out of that box; each says so in `Geometry.overhang`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import lru_cache
from math import cos, pi, sin
from types import MappingProxyType
from typing import Any

from ..design.errors import DesignError, Fault, nearest
from .materials import DEFAULT_MATERIAL
from .openings import arched_window, archway, door, french_window, reveal, shop, window
from .parameters import Parameter, read_call, read_values
from .parts import Block, Moulding, Part, Ring, Turned
from .projections import awning, balcony, bay, dormer, loggia, railing, sign
from .roofs import gable as gabled
from .roofs import hip, hipped, mansard, pitched
from .stonework import arcade, gable, pediment, quoin, stair, stair_stand, statue

__all__ = ["DEFAULT_GEOMETRY", "GEOMETRIES", "Geometry", "find_geometry", "held"]

DEFAULT_GEOMETRY = "box"
"""What a shape looks like where the design says nothing."""

Recipe = Callable[..., tuple[Part, ...]]
"""Width, height and depth (from the face backwards), all in metres, and parameters by name, to parts."""


def box(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A plain block."""
    return (Block(0, 0, w, h, -d, 0),)


def panel(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A wall with a sunk field."""
    rim = min(0.16, 0.14 * min(w, h))
    sunk = min(0.04, d / 2)
    return (Block(rim, rim, w - rim, h - rim, -d, -sunk), Ring(0, 0, w, h, rim, -d, 0))


def column(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A round column with base, swelling shaft and capital; it is as deep as it is wide, whatever the thickness."""
    plinth = min(0.42 * w, 0.07 * h)
    abacus = min(0.32 * w, 0.05 * h)
    radius = 0.39 * w  # of the shaft at its foot
    torus, neck = 0.55 * plinth, 0.8 * abacus
    foot, head = plinth + torus, h - abacus - 2.2 * neck
    base = [(plinth + torus * (0.5 + y), radius * (1.02 + 0.4 * x)) for x, y in _HALF_ROUND]
    shaft = [  # entasis: the upper two thirds draw in along a curve
        (foot + t * (head - foot), radius * (1 - 0.16 * max(0.0, (t - 0.3) / 0.7) ** 1.6)) for t in _STEPS
    ]
    top = shaft[-1][1]
    capital = [
        (head, top * 1.1),
        (head + 0.4 * neck, top * 1.1),
        (head + 0.5 * neck, top * 1.02),
        (head + 1.2 * neck, top * 1.04),
        (head + 1.8 * neck, radius * 1.12),
        (head + 2.2 * neck, radius * 1.2),
    ]
    half = w / 2
    return (
        Block(0, 0, w, plinth, -w, 0),
        Turned(half, -half, (*base, *shaft, *capital)),
        Block(0.02 * w, h - abacus, 0.98 * w, h, -0.98 * w, -0.02 * w),
    )


_HALF_ROUND = tuple((0.5 * cos(pi * i / 6), 0.5 * sin(pi * i / 6)) for i in range(-3, 4))
_STEPS = tuple(i / 10 for i in range(11))


def pilaster(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A flat pillar with base and capital, standing out from the wall."""
    foot, head = min(0.5 * w, 0.09 * h), min(0.4 * w, 0.07 * h)
    inset = 0.1 * w
    set_back = min(0.03, d / 2)
    return (
        Block(inset, foot, w - inset, h - head, -d, -set_back),
        Block(0, 0, w, foot, -d, 0),
        Block(0.05 * w, h - head, w - 0.05 * w, h - 0.45 * head, -d, -set_back / 2),
        Block(0, h - 0.45 * head, w, h, -d, 0),
    )


def cornice(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A moulded cornice: fillet, hollow, corona and top fillet; it draws back to the wall at its foot."""
    p = min(0.9 * d, cornice_stand(w, h))  # its foot has a thickness: a sheet without one is no body
    steps = (
        (0.0, 1.0), (0.1, 1.0), (0.1, 0.88), (0.2, 0.82), (0.28, 0.68), (0.33, 0.52), (0.33, 0.46),
        (0.37, 0.46), (0.37, 0.13), (0.7, 0.13), (0.72, 0.1), (0.82, 0.03), (0.84, 0.0), (1.0, 0.0),
    )  # fmt: skip
    return (Moulding(0, w, tuple((y * h, -z * p) for y, z in steps), -d),)


def cornice_stand(w: float, h: float) -> float:
    """How far a cornice stands out of the wall by itself."""
    return min(0.35, max(0.08, 0.6 * h))


def ledge(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A string course: a band with a weathered top and a drip below."""
    p = min(d, ledge_stand(w, h))
    profile = (
        (0.0, -p),
        (0.18 * h, -0.45 * p),
        (0.3 * h, -0.45 * p),
        (0.3 * h, 0.0),
        (0.82 * h, 0.0),
        (h, -0.55 * p),
    )
    return (Moulding(0, w, profile, -d),)


def ledge_stand(w: float, h: float) -> float:
    """How far a ledge stands out of the wall by itself."""
    return min(0.14, max(0.05, 0.4 * h))


@dataclass(frozen=True, slots=True)
class Geometry:
    """One geometry.

    Attributes
    ----------
    name
        As designs write it.
    recipe
        Makes the parts.
    summary, overhang
        For the documentation and menus; `overhang` says what reaches out of the shape's box, and how far.
    full
        Whether it fills its rectangle, so that nothing behind it shows.
    recess
        How far behind the face, for a given depth, the surface lies that takes the shadow of the neighbours; metres.
    stand
        Where the face is when the offset is 0, metres: what projects by nature (a column, a balcony) does so unasked.
        Width, height and the parameters that were told are given.
    deep
        How deep it is at least, whatever the thickness, metres; called as `stand` is.
    least
        The width and height below which it is a plain block, metres.
    slots
        Materials of the parts that do not have the shape's own: slot to material.
    own
        The material of the shape where the design names one of `unsuited` (the default, plaster, glass for a door).
    parameters
        What may be told in brackets after its name.
    told
        What was told: parameter to value.
    runs_on
        Whether its surface continues the courses of its neighbours.
    roof
        Whether it covers the house, and is as deep as that in pictures.
    modelled
        Whether the elevation outlines it and shades within it: what stands out, or lies deep.
    cuts
        Whether it opens the wall that it stands in by its outline, though it does not fill its rectangle.
    ajar
        A parameter and the value with which it does not fill its rectangle.
    turns
        Whether it is mirrored where its letter is; what is written on a sign is not.
    """

    name: str
    recipe: Recipe
    summary: str
    overhang: str = ""
    full: bool = True
    recess: Callable[[float], float] = lambda d: 0.0
    stand: Callable[..., float] = lambda w, h, **told: 0.0
    deep: Callable[..., float] = lambda w, h, **told: 0.0
    slots: Mapping[str, str] = field(default_factory=dict)
    own: str = ""
    least: float = 0.0
    unsuited: frozenset[str] = frozenset()
    parameters: tuple[Parameter, ...] = ()
    told: Mapping[str, Any] = field(default_factory=dict)
    runs_on: bool = False
    roof: bool = False
    modelled: bool = False
    cuts: bool = True
    ajar: tuple[str, str] = ("", "")
    turns: bool = True

    @property
    def wall(self) -> bool:
        """Whether shapes that stand in it open it."""
        return (self.full or self.name in ("gable", "pediment")) and not self.roof

    def parts(self, w: float, h: float, d: float) -> tuple[Part, ...]:
        """The parts of a shape `w` by `h`, `d` deep, metres; a plain block where there is no room for more."""
        if min(w, h) < self.least:
            return box(w, h, d)
        return self.recipe(w, h, d, **self.told)

    def face(self, w: float, h: float) -> float:
        """Where its face is by itself, z in metres."""
        return self.stand(w, h, **self.told) if min(w, h) >= self.least else self.stand(w, h)

    def depth(self, w: float, h: float) -> float:
        """How deep it is at least, metres."""
        return self.deep(w, h, **self.told) if min(w, h) >= self.least else 0.0

    def material(self, slot: str, material: str) -> str:
        """The material of a slot in a shape made of `material`."""
        if slot in self.slots:
            return self.slots[slot]
        return self.own if material in self.unsuited else material


_PLAIN = frozenset({DEFAULT_MATERIAL, "plaster"})
_WINDOW = {"glass": "glass", "sill": "stone", "rail": "iron", "step": "stone", "shade": "shade"}
_ROOF = {"gable": "wood", "frame": "painted-wood", "glass": "glass", "gutter": "metal"}

_TABLE = (
    Geometry("box", box, "plain block"),
    Geometry("panel", panel, "wall with a sunk field", recess=lambda d: min(0.02, d / 2), runs_on=True),
    Geometry(
        "window", window, "frame, leaves, glazing bars by size, sill", "the sill comes 0.06 m forward",
        recess=reveal, least=0.3, slots=_WINDOW, own="painted-wood", unsuited=_PLAIN | {"glass"},
        parameters=(
            Parameter("leaves", "leaves side by side", 1, 12, whole=True),
            Parameter("rows", "rows of panes below the transom", 1, 12, whole=True),
        ),
    ),
    Geometry(
        "french-window", french_window, "glazed doors to the floor behind a low railing",
        "the railing comes 0.1 m forward",
        recess=reveal, least=0.3, slots=_WINDOW, own="painted-wood", unsuited=_PLAIN | {"glass"},
    ),
    Geometry(
        "shop", shop, "shop window: stall riser, large panes, fanlights", "the sill comes 0.04 m forward",
        recess=reveal, least=0.3, slots=_WINDOW, own="painted-green", unsuited=_PLAIN | {"glass"},
        parameters=(Parameter("panes", "panes side by side", 1, 12, whole=True),),
    ),
    Geometry(
        "door", door, "frame, panelled leaves, step, fanlight where it is tall", "the step comes 0.3 m forward",
        recess=reveal, least=0.3, slots=_WINDOW | {"metal": "bronze"}, own="oak", unsuited=_PLAIN | {"glass"},
        parameters=(Parameter("leaves", "leaves side by side", 1, 2, whole=True),),
    ),
    Geometry(
        "arch", archway, "wall with an arched, glazed opening", "the keystone comes 0.03 m forward",
        least=0.3, slots=_WINDOW | {"frame": "painted-wood"},
        runs_on=True,
    ),
    Geometry(
        "column", column, "round column with base, swelling shaft and capital",
        "as deep as it is wide, whatever the thickness",
        full=False, stand=lambda w, h, **told: 0.85 * w,
    ),
    Geometry("pilaster", pilaster, "flat pillar with base and capital", stand=lambda w, h, **told: 0.1, full=False),
    Geometry("cornice", cornice, "moulded cornice", stand=cornice_stand),
    Geometry("ledge", ledge, "string course with a weathered top", stand=ledge_stand),
    Geometry(
        "balcony", balcony, "slab with an iron railing; open above", full=False, least=0.3,
        stand=lambda w, h, **told: 0.9, slots={"rail": "iron"}, own="stone", unsuited=_PLAIN,
        parameters=(Parameter("rail", "height of the railing, metres", 0.4, 2),),
    ),
    Geometry(
        "railing", railing, "iron railing alone; open above", full=False, least=0.3,
        stand=lambda w, h, **told: 0.08, slots={"rail": "iron"},
        parameters=(Parameter("rail", "height of the railing, metres", 0.4, 2),),
    ),
    Geometry(
        "roof", gabled, "gabled roof, its gable to the viewer",
        "eaves 0.25 m to the sides and below, verge 0.25 m forward",
        full=False, slots=_ROOF, own="tiles", unsuited=_PLAIN,
        roof=True,
    ),
    Geometry(
        "hip", hip, "hipped roof, its slope to the viewer", "eaves 0.3 m to the sides and forward, gutter 0.1 m below",
        full=False, slots=_ROOF, own="tiles", unsuited=_PLAIN,
        roof=True, runs_on=True,
    ),
    Geometry(
        "pitched", pitched, "pitched roof, its slope to the viewer", "eaves 0.3 m forward, gutter 0.1 m below",
        full=True, slots=_ROOF, own="tiles", unsuited=_PLAIN, runs_on=True,
        roof=True,
    ),
    Geometry(
        "hipped", hipped, "hipped roof with hip and ridge tiles, boxed eaves and a gutter",
        "eaves 0.3 m to the sides and forward, or as told, and 0.14 m below; the gutter 0.09 m further",
        full=False, slots=_ROOF | {"caps": "tiles"}, own="tiles", unsuited=_PLAIN, runs_on=True,
        roof=True, modelled=True,
        parameters=(
            Parameter("ridge", "length of the ridge, a share of the width; 0: a pavilion", 0, 1),
            Parameter("eaves", "how far the eaves reach out, metres", 0, 2),
        ),
    ),
    Geometry(
        "mansard", mansard, "mansard roof: a steep slope up to the knee, a flatter one above",
        "eaves 0.3 m forward, gutter 0.1 m below",
        slots=_ROOF | {"upper": "metal"}, own="slate", unsuited=_PLAIN, runs_on=True,
        roof=True, modelled=True, ajar=("ends", "hipped"),
        parameters=(
            Parameter("knee", "height of the knee, a share of the whole", 0.3, 0.95),
            Parameter("ends", "ends that stand between neighbours, or slope as well", words=("upright", "hipped")),
        ),
    ),
    Geometry(
        "dormer", dormer, "window in a roof between cheeks, under a roof of its own",
        "the roof comes 0.12 m forward and runs back into the slope, to where that covers it",
        full=False, stand=lambda w, h, **told: 0.3, deep=lambda w, h, **told: 1.3 * h, least=0.3,
        slots=_WINDOW | {"roof": "metal", "cheek": "metal", "frame": "painted-wood"},
        own="painted-wood", unsuited=_PLAIN | {"glass"},
        modelled=True,
        parameters=(Parameter("roof", "form of its roof", words=("gable", "arch", "flat")),),
    ),
    Geometry(
        "gable", gable, "gable wall above its roof, under coping stones; a round window where there is room",
        "the coping comes 0.05 m forward",
        full=False, least=0.3, slots={"coping": "stone", "frame": "painted-wood", "glass": "glass"}, runs_on=True,
        modelled=True,
        parameters=(
            Parameter("form", "its outline", words=("straight", "stepped", "curved")),
            Parameter("steps", "steps at each side of a stepped one", 1, 40, whole=True),
        ),
    ),
    Geometry(
        "pediment", pediment, "cornice, field and raking cornices over a door, a window or a portico",
        full=False, least=0.1, stand=lambda w, h, **told: min(0.35, 0.12 * w),
        own="stone", unsuited=_PLAIN,
        modelled=True,
        parameters=(Parameter("form", "its outline", words=("triangle", "segment", "broken")),),
    ),
    Geometry(
        "quoin", quoin, "corner stones, long and short in turn; flush at the left, mirrored at the right",
        full=False, stand=lambda w, h, **told: 0.05, own="stone", unsuited=_PLAIN,
        modelled=True,
        parameters=(
            Parameter("course", "height of a stone, metres", 0.1, 2),
            Parameter("short", "length of a short stone, a share of a long one", 0.2, 1),
        ),
    ),
    Geometry(
        "arched-window", arched_window, "window with an arched head, which cuts an arch out of the wall",
        "the sill comes 0.06 m forward",
        full=False, recess=reveal, least=0.3, slots=_WINDOW, own="painted-wood", unsuited=_PLAIN | {"glass"},
        modelled=True,
        parameters=(Parameter("rise", "height of the arch, a share of the width", 0.02, 1.5),),
    ),
    Geometry(
        "bay", bay, "bay window on a corbel, windows all around, storey by storey, under a roof of its own",
        full=False, least=0.3, stand=lambda w, h, **told: min(0.9, max(0.35, 0.32 * w)),
        slots=_WINDOW | {"frame": "painted-wood", "roof": "metal"}, runs_on=True,
        modelled=True,
        parameters=(
            Parameter("cant", "slant of its sides, metres along for each metre out; 0: square", 0, 2),
            Parameter("storeys", "rows of windows", 1, 20, whole=True),
        ),
    ),
    Geometry(
        "loggia", loggia, "room open to the front, glazed at its back",
        least=0.9, deep=lambda w, h, depth=1.4, **told: depth, runs_on=True,
        slots={"glass": "glass", "rail": "iron", "frame": "painted-wood"},
        modelled=True,
        parameters=(
            Parameter("depth", "how far it lies back, metres", 0.2, 6),
            Parameter("parapet", "what stands at its front", words=("rail", "wall", "none")),
        ),
    ),
    Geometry(
        "arcade", arcade, "arches on piers before a covered walk", "mouldings come 0.07 m forward",
        least=0.3, deep=lambda w, h, depth=2.0, **told: depth, slots={"floor": "granite"}, runs_on=True,
        modelled=True,
        parameters=(
            Parameter("bays", "number of arches", 1, 40, whole=True),
            Parameter("depth", "how deep the walk is, metres", 0.3, 8),
            Parameter("pier", "width of a pier, a share of its bay", 0.05, 0.6),
        ),
    ),
    Geometry(
        "stair", stair, "flight of steps towards the viewer, between cheek walls",
        full=False, stand=stair_stand, own="stone", unsuited=_PLAIN, cuts=False,
        modelled=True,
        parameters=(
            Parameter("risers", "number of steps", 1, 80, whole=True),
            Parameter("cheeks", "walls beside the steps", words=("yes", "no")),
        ),
    ),
    Geometry(
        "awning", awning, "awning of striped cloth with a scalloped valance, on iron arms",
        full=False, least=0.3, stand=lambda w, h, **told: min(1.5, max(0.4, 1.1 * h)), cuts=False,
        slots={"stripe": "painted-wood", "arm": "iron", "box": "metal"}, own="painted-green", unsuited=_PLAIN,
        modelled=True,
        parameters=(
            Parameter("stripe", "width of a stripe, metres; 0: plain cloth", 0, 3),
            Parameter("valance", "height of the valance, metres", 0.05, 1),
        ),
    ),
    Geometry(
        "sign", sign, "board in a moulded frame, with raised capitals", "the frame comes 0.03 m forward",
        least=0.1, stand=lambda w, h, **told: 0.08, slots={"frame": "bronze", "letters": "painted-wood"},
        own="painted-blue", unsuited=_PLAIN, turns=False,
        parameters=(Parameter("text", "what is written on it, without commas and brackets", text=True),),
    ),
    Geometry(
        "statue", statue, "stand-in for a statue: a draped figure on a plinth", "as deep as it is wide",
        full=False, stand=lambda w, h, **told: 0.6 * min(w, 0.42 * h), own="stone", unsuited=_PLAIN,
        modelled=True,
    ),
)  # fmt: skip

_BY_NAME = {geometry.name: geometry for geometry in _TABLE}

GEOMETRIES: Mapping[str, Geometry] = MappingProxyType(_BY_NAME)
"""Every geometry, in the order menus show them."""


@contextmanager
def held(geometry: Geometry) -> Iterator[None]:
    """A geometry that is in the table until the block ends."""
    _BY_NAME[geometry.name] = geometry
    find_geometry.cache_clear()
    try:
        yield
    finally:
        del _BY_NAME[geometry.name]
        find_geometry.cache_clear()


@lru_cache(maxsize=512)
def find_geometry(name: str, place: str = "geometry") -> Geometry:
    """Return the geometry of that name, with the parameters told after it: ``arcade(bays=3)``.

    Raises
    ------
    DesignError
        For an unknown name or parameter, with `place` as the fault's place and the nearest valid name.
    """
    found = GEOMETRIES.get(name)
    if found is not None:
        return found
    call = read_call(name)
    found = GEOMETRIES.get(call[0]) if call is not None else None
    if call is None or found is None:
        known = call[0] if call is not None else name
        message = f"expected one of {', '.join(GEOMETRIES)}; found {name!r}{nearest(known, GEOMETRIES)}"
        raise DesignError(Fault(place, message))
    told = read_values(call[1], found.parameters, found.name, place)
    key, value = found.ajar
    return replace(found, told=told, full=found.full and told.get(key) != value)
