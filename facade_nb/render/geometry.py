"""The geometries a shape can have, each a small recipe of parts (see `parts` for their frame).

``offset`` places the face of a shape: positive towards the viewer, 0 in the plane of the façade. ``thickness`` goes
backwards from there. A few geometries have parts that reach out of that box; each says so in `Geometry.overhang`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from ..design.errors import DesignError, Fault, nearest
from .materials import DEFAULT_MATERIAL
from .openings import archway, door, french_window, reveal, shop, window
from .parts import Block, Moulding, Part, Ring, Turned
from .roofs import gable, hip, pitched

__all__ = ["DEFAULT_GEOMETRY", "GEOMETRIES", "Geometry", "find_geometry"]

DEFAULT_GEOMETRY = "box"
"""What a shape looks like where the design says nothing."""

Recipe = Callable[[float, float, float], tuple[Part, ...]]
"""Width, height and depth (from the face backwards), all in metres, to parts."""


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
    base = [
        (plinth, radius * 1.02),
        (plinth + 0.15 * torus, radius * 1.18),
        (plinth + 0.5 * torus, radius * 1.22),
        (plinth + 0.85 * torus, radius * 1.1),
    ]
    shaft = [  # entasis: the upper two thirds draw in along a curve
        (foot + t * (head - foot), radius * (1 - 0.16 * max(0.0, (t - 0.3) / 0.7) ** 1.6)) for t in _STEPS
    ]
    top = shaft[-1][1]
    capital = [
        (head + 0.15 * neck, top * 1.1),
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


def balcony(w: float, h: float, d: float) -> tuple[Part, ...]:
    """A slab on the cell's floor with a railing of iron bars around its front and sides."""
    slab = min(0.16, 0.12 * h)
    return (Block(0, 0, w, slab, -d, 0), *_railing(w, slab, slab + min(0.95, 0.5 * h), d))


def railing(w: float, h: float, d: float) -> tuple[Part, ...]:
    """The railing alone, as high as a rail should be; the rest of the cell stays open."""
    return _railing(w, 0.0, min(1.05, h), min(d, 0.05))


def _railing(w: float, foot: float, head: float, d: float) -> tuple[Part, ...]:
    bar, rail = 0.018, 0.045
    inset = min(0.05, 0.06 * w)
    x0, x1, front = inset, w - inset, -min(0.05, d / 3)
    parts: list[Part] = [
        Block(x0, head - rail, x1, head, front - rail, front, "rail"),
        Block(x0, foot + 0.07, x1, foot + 0.1, front - rail, front, "rail"),
    ]
    for x in (x0, x1 - rail):
        parts.append(Block(x, foot, x + rail, head, front - rail, front, "rail"))
        if d > 0.2:  # the sides, back to the wall
            parts.append(Block(x, head - rail, x + rail, head, -d, front - rail, "rail"))
            parts.append(Block(x, foot + 0.07, x + rail, foot + 0.1, -d, front - rail, "rail"))
            count = round(d / 0.14)
            for i in range(1, count):
                z = front - rail - (d + front - rail) * i / count
                parts.append(Block(x, foot + 0.1, x + bar, head - rail, z - bar, z, "rail"))
    count = max(2, min(60, round((x1 - x0) / 0.13)))
    pitch = (x1 - x0) / count
    for i in range(1, count):
        x = x0 + i * pitch - bar / 2
        parts.append(Block(x, foot + 0.1, x + bar, head - rail, front - 0.03, front - 0.012, "rail"))
    return tuple(parts)


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
    least
        The width and height below which it is a plain block, metres.
    slots
        Materials of the parts that do not have the shape's own: slot to material.
    own
        The material of the shape where the design names one of `unsuited` (the default, plaster, glass for a door).
    """

    name: str
    recipe: Recipe
    summary: str
    overhang: str = ""
    full: bool = True
    recess: Callable[[float], float] = lambda d: 0.0
    stand: Callable[[float, float], float] = lambda w, h: 0.0
    slots: Mapping[str, str] = field(default_factory=dict)
    own: str = ""
    least: float = 0.0
    unsuited: frozenset[str] = frozenset()

    def parts(self, w: float, h: float, d: float) -> tuple[Part, ...]:
        """The parts of a shape `w` by `h`, `d` deep, metres; a plain block where there is no room for more."""
        return (box if min(w, h) < self.least else self.recipe)(w, h, d)

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
    Geometry("panel", panel, "wall with a sunk field", recess=lambda d: min(0.02, d / 2)),
    Geometry(
        "window", window, "frame, leaves, glazing bars by size, sill", "the sill comes 0.06 m forward",
        recess=reveal, least=0.3, slots=_WINDOW, own="painted-wood", unsuited=_PLAIN | {"glass"},
    ),
    Geometry(
        "french-window", french_window, "glazed doors to the floor behind a low railing",
        "the railing comes 0.1 m forward",
        recess=reveal, least=0.3, slots=_WINDOW, own="painted-wood", unsuited=_PLAIN | {"glass"},
    ),
    Geometry(
        "shop", shop, "shop window: stall riser, large panes, fanlights", "the sill comes 0.04 m forward",
        recess=reveal, least=0.3, slots=_WINDOW, own="painted-green", unsuited=_PLAIN | {"glass"},
    ),
    Geometry(
        "door", door, "frame, panelled leaves, step, fanlight where it is tall", "the step comes 0.3 m forward",
        recess=reveal, least=0.3, slots=_WINDOW | {"metal": "bronze"}, own="oak", unsuited=_PLAIN | {"glass"},
    ),
    Geometry(
        "arch", archway, "wall with an arched, glazed opening", "the keystone comes 0.03 m forward",
        least=0.3, slots=_WINDOW | {"frame": "painted-wood"},
    ),
    Geometry(
        "column", column, "round column with base, swelling shaft and capital",
        "as deep as it is wide, whatever the thickness",
        full=False, stand=lambda w, h: 0.85 * w,
    ),
    Geometry("pilaster", pilaster, "flat pillar with base and capital", stand=lambda w, h: 0.1, full=False),
    Geometry("cornice", cornice, "moulded cornice", stand=cornice_stand),
    Geometry("ledge", ledge, "string course with a weathered top", stand=ledge_stand),
    Geometry(
        "balcony", balcony, "slab with an iron railing; open above", full=False, least=0.3,
        stand=lambda w, h: 0.9, slots={"rail": "iron"}, own="stone", unsuited=_PLAIN,
    ),
    Geometry(
        "railing", railing, "iron railing alone; open above", full=False, least=0.3,
        stand=lambda w, h: 0.08, slots={"rail": "iron"},
    ),
    Geometry(
        "roof", gable, "gabled roof, its gable to the viewer",
        "eaves 0.25 m to the sides and below, verge 0.25 m forward",
        full=False, slots=_ROOF, own="tiles", unsuited=_PLAIN,
    ),
    Geometry(
        "hip", hip, "hipped roof, its slope to the viewer", "eaves 0.3 m to the sides and forward, gutter 0.1 m below",
        full=False, slots=_ROOF, own="tiles", unsuited=_PLAIN,
    ),
    Geometry(
        "pitched", pitched, "pitched roof, its slope to the viewer", "eaves 0.3 m forward, gutter 0.1 m below",
        full=True, slots=_ROOF, own="tiles", unsuited=_PLAIN,
    ),
)  # fmt: skip

GEOMETRIES: Mapping[str, Geometry] = MappingProxyType({geometry.name: geometry for geometry in _TABLE})
"""Every geometry, in the order menus show them."""


def find_geometry(name: str, place: str = "geometry") -> Geometry:
    """Return the geometry of that name.

    Raises
    ------
    DesignError
        For an unknown name, with `place` as the fault's place and the nearest valid name.
    """
    found = GEOMETRIES.get(name)
    if found is None:
        message = f"expected one of {', '.join(GEOMETRIES)}; found {name!r}{nearest(name, GEOMETRIES)}"
        raise DesignError(Fault(place, message))
    return found
