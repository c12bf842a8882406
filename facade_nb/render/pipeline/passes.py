"""The passes of the pipeline as data: what each reads, writes and runs (the texture paper's 4).

A pass can be added, left out or put in the place of another without touching the rest: what runs them, here and in the
browser, knows no pass by name. `arranged` checks that each reads only what an earlier one has written.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

from ...design.errors import nearest

__all__ = [
    "BARE",
    "BUFFERS",
    "FACADE",
    "PAGE",
    "PASSES",
    "PLAIN",
    "THROUGH",
    "Buffer",
    "Pass",
    "arranged",
    "emptied",
    "image_bytes",
    "seen_through",
    "shared",
    "used",
    "without",
]


@dataclass(frozen=True, slots=True)
class Buffer:
    """An image that passes write and read.

    Attributes
    ----------
    name
        As shaders call it.
    channels
        1 to 4.
    kind
        ``f1``: 8 bits from 0 to 1; ``f2``, ``f4``: floats; ``i4``: whole numbers; ``depth``.
    side
        Pixels of each side where it has a size of its own; 0: those of the picture.
    part
        How many of the picture's pixels go into one of it, across and up.
    tells
        What it holds, in a sentence.
    """

    name: str
    channels: int
    kind: Literal["f1", "f2", "f4", "i4", "depth"]
    tells: str
    side: int = 0
    part: int = 1

    def size(self, pixels: tuple[int, int]) -> tuple[int, int]:
        """Width and height of it for a picture of so many pixels."""
        if self.side:
            return self.side, self.side
        return -(-pixels[0] // self.part), -(-pixels[1] // self.part)


@dataclass(frozen=True, slots=True)
class Pass:
    """A step of the pipeline.

    Attributes
    ----------
    name
        By which it is left out, measured and shown.
    vertex, fragment
        Its shaders, files of ``glsl``.
    reads, writes
        Names of buffers. Outputs are numbered in the order of `writes`.
    draws
        ``mesh``: the scene's triangles, seen through the matrix `through`; ``screen``: every pixel.
    through
        The name of that matrix. A pass that draws the screen is given it, too: it looks something up in a map.
    turning
        Whether it draws those chunks of the mesh that turn to whoever looks, or the others.
    adds
        It draws over what is there; nothing is cleared.
    both
        Whether a triangle is drawn from behind, too: shadows of a mesh that is open are whole all the same.
    defines
        Given to the shader.
    seen
        For a pass that draws the screen: a buffer of depths. Only pixels in which that has something are drawn: a
        software renderer, too, passes over the others without running the shader. They hold zeros in what is read there
        (`emptied`). Such a pass reads the mesh's images, and those of others like it, at its own pixel alone.
    sky
        It draws the other pixels, those in which that buffer has nothing; what there is stays.
    sums
        Whether what it draws of the mesh is summed up with what there is, whatever lies in front.
    under
        Whether it adds its outputs under what there is, where that is transparent, in place of overwriting it.
    after
        It runs only if this pass, which draws the mesh, has drawn something; empty: always.
    when
        It runs only where this is true of the frame: ``shadow``, ``lamps``, ``occlusion``, ``smooth``; empty: always.
    options
        Those that are true of the frame, such as ``relief``, are defined for the shader too, in capitals.
    tells
        What it does, in a sentence.
    """

    name: str
    fragment: str
    reads: tuple[str, ...]
    writes: tuple[str, ...]
    tells: str
    vertex: str = "whole.vert"
    draws: Literal["mesh", "screen"] = "screen"
    through: str = ""
    turning: bool = False
    adds: bool = False
    both: bool = False
    seen: str = ""
    sky: bool = False
    sums: bool = False
    under: bool = False
    after: str = ""
    defines: tuple[str, ...] = ()
    when: str = ""
    options: tuple[str, ...] = ()


SHADOW = 1728
"""Texels of each side of a map of shadows."""

LAMPS = 640
"""Texels of each side of the map of street lamps."""

BUFFERS: tuple[Buffer, ...] = (
    Buffer("shadow_near", 1, "depth", "How far the sun sees, around the camera.", SHADOW),
    Buffer("shadow_far", 1, "depth", "How far the sun sees, all over the scene.", SHADOW),
    Buffer("lamp_map", 1, "depth", "How far the nearest street lamp is, seen from above.", LAMPS),
    Buffer("place", 4, "f4", "Where on its façade a pixel lies, and how large that is, metres."),
    Buffer("rule", 4, "f4", "With which rule its façade begins, and with which seed."),
    Buffer("facing", 4, "f4", "Which way its façade looks, and how deep it lies before the camera, metres."),
    Buffer("along", 4, "f2", "Which way its façade's width runs."),
    Buffer("depth", 1, "depth", "Which triangle is in front."),
    Buffer("color", 4, "f2", "What the grammar gives: colour times alpha; from 2 on, how much sun relief takes."),
    Buffer("normal", 4, "f2", "Its normal, short in rooms; and how near a split is, in pixels."),
    Buffer("specular", 4, "f2", "Its specular value, in rooms a lamp's colour; and how far it lies behind the wall."),
    Buffer("occlusion", 2, "f2", "How much around a point is open, of a few taps; and how deep it lies.", part=2),
    Buffer("softened", 2, "f2", "The same without the pattern of the taps.", part=2),
    Buffer("overhang", 2, "f2", "How much of the sun is left by what stands out of the wall; and how deep.", part=2),
    Buffer("light", 4, "f2", "Light that comes from there, linear."),
    Buffer("air", 4, "f2", "The same after the air between, and the sky."),
    Buffer("toned", 4, "f1", "As a film has it; and how bright that is."),
    Buffer("picture", 4, "f1", "Without the stairs of edges."),
)  # fmt: skip
"""All buffers, in the order in which they are first written."""

_MESH = ("place", "rule", "facing", "along")
PASSES: tuple[Pass, ...] = (
    Pass("shadow near", "shadow.frag", (), ("shadow_near",), "Draws what the sun sees around the camera.",
         "shadow.vert", "mesh", "sun_near", both=True, when="shadow"),
    Pass("shadow far", "shadow.frag", (), ("shadow_far",), "Draws what the sun sees of all.",
         "shadow.vert", "mesh", "sun_far", both=True, when="shadow"),
    Pass("leaves near", "turning_shadow.frag", (), ("shadow_near",), "Adds trees, lamps, chimneys: what turns.",
         "turning_shadow.vert", "mesh", "sun_near", turning=True, adds=True, both=True, when="shadow"),
    Pass("leaves far", "turning_shadow.frag", (), ("shadow_far",), "Adds them to the other map.",
         "turning_shadow.vert", "mesh", "sun_far", turning=True, adds=True, both=True, when="shadow"),
    Pass("lamp map", "lamp_map.frag", (), ("lamp_map",), "Notes how far the nearest street lamp is.",
         "lamp_map.vert", "mesh", "above", turning=True, both=True, when="lamps"),
    Pass("G-buffer", "gbuffer.frag", (), (*_MESH, "depth"), "Draws the mesh, and notes what the grammar will ask.",
         "mesh.vert", "mesh", "camera"),
    Pass("leaves", "turning.frag", (), (*_MESH, "depth"), "Adds what turns to the camera, but where it is open.",
         "turning.vert", "mesh", "camera", turning=True, adds=True),
    Pass("grammar", "grammar.frag", _MESH, ("color", "normal", "specular"),
         "Evaluates the grammar once for each pixel that is seen.", defines=("MIPS", "EDGES", "DEEP"),
         options=("relief",), seen="depth"),
    Pass("occlusion", "occlusion.frag", ("specular", "facing"), ("occlusion",),
         "Looks how much its neighbours hide of a point's surroundings.", when="occlusion"),
    Pass("soften", "soften.frag", ("occlusion",), ("softened",), "Evens that out.", when="occlusion"),
    Pass("overhang", "overhang.frag", ("specular", "facing"), ("overhang",),
         "Looks what stands out of a wall before the sun.", when="relief"),
    Pass("light", "light.frag",
         ("color", "normal", "specular", "facing", "softened", "overhang", "shadow_near", "shadow_far", "lamp_map"),
         ("light",), "Adds up sun, sky, ground and lamps.", options=("relief", "lamps"), seen="depth"),
    Pass("pools", "pools.frag", ("color", "normal", "facing"), ("light",), "Adds pools of light around street lamps.",
         "pools.vert", "mesh", "camera", turning=True, adds=True, sums=True, when="lamps"),
    Pass("air", "air.frag", ("light", "facing"), ("air",), "Lets haze take what is far.", seen="depth"),
    Pass("sky", "sky.frag", (), ("air",), "Draws sky and clouds behind.", seen="depth", sky=True),
    Pass("tone", "tone.frag", ("air",), ("toned",), "Exposes it."),
    Pass("edges", "smooth_edges.frag", ("toned", "facing", "normal"), ("picture",),
         "Smooths edges of the mesh and of splits."),
)  # fmt: skip
"""The pipeline."""

PLAIN: tuple[Pass, ...] = tuple(own for own in PASSES if own.when not in ("relief", "lamps"))
"""The same for who never draws relief, nor street lamps: a building on a page."""

OUTDOORS: tuple[Pass, ...] = tuple(
    replace(own, defines=("LAMPS",)) if own.name == "light" else own for own in PASSES if own.when != "relief"
)
"""The same for a town on a page."""


def arranged(passes: Sequence[Pass] = PASSES, buffers: Sequence[Buffer] = BUFFERS) -> tuple[Pass, ...]:
    """The passes, checked.

    Raises
    ------
    ValueError
        If one reads what none before it writes, names a buffer that there is not, or reads what it writes.
    """
    names = [own.name for own in buffers]
    written: set[str] = set()
    for own in passes:
        for name in (*own.reads, *own.writes):
            if name not in names:
                raise ValueError(f"pass {own.name!r}: there is no buffer {name!r}{nearest(name, names)}")
        if own.seen and own.seen not in written:
            raise ValueError(
                f"pass {own.name!r}: it asks {own.seen!r} what is seen, which no pass before it writes"
            )
        for name in own.reads:
            if name in own.writes:
                raise ValueError(f"pass {own.name!r}: it reads {name!r}, which it writes itself")
            if name not in written:
                raise ValueError(f"pass {own.name!r}: it reads {name!r}, which no pass before it writes")
        written.update(own.writes)
    return tuple(passes)


def shared(
    passes: Sequence[Pass] = PASSES,
    buffers: Sequence[Buffer] = BUFFERS,
    whole: Iterable[str] = ("picture",),
) -> dict[str, str]:
    """Which buffer's image each buffer uses: its own, or that of an earlier one like it which no pass needs any more.

    Parameters
    ----------
    whole
        Buffers that are read after the last pass. Those of a size of their own are kept as well: they may serve the
        next picture.
    """
    by_name = {own.name: own for own in buffers}
    last = dict.fromkeys((*whole, *(own.name for own in buffers if own.side)), len(passes))
    for number, own_pass in enumerate(passes):
        for name in (*own_pass.reads, *own_pass.writes, *filter(None, [own_pass.seen])):
            last[name] = max(number, last.get(name, 0))
    found: dict[str, str] = {}
    free_after: dict[str, int] = {}  # of an image, by the name of the first buffer in it
    for number, own_pass in enumerate(passes):
        for name in own_pass.writes:
            if name in found:
                continue
            own = by_name[name]
            like = (
                image
                for image, until in free_after.items()
                if until < number and _like(own) == _like(by_name[image])
            )
            found[name] = next(like, name)
            free_after[found[name]] = last[name]
    return found


def emptied(own: Pass, passes: Sequence[Pass], whole: Iterable[str] = ("picture",)) -> frozenset[str]:
    """Which buffers have to be empty before a pass draws: those that are read where it draws nothing.

    What is read only by passes that draw no more than what is seen, or what is drawn by one of the sky, may hold there
    what it likes. Software spends as long on emptying all images as on some passes.

    Parameters
    ----------
    passes
        All passes that run, among them this one.
    whole
        Buffers that are read after the last pass.
    """
    left = frozenset(whole)
    asked = own.seen or next(iter(own.writes[-1:]), "")

    def matters(name: str) -> bool:
        drawn = [one for one in passes if one.sky and one.seen == asked and name in one.writes]
        read = [one for one in passes if name in one.reads and (one.seen != asked or one.sky)]
        return name in left or (bool(read) and not drawn)

    return frozenset(filter(matters, own.writes))


def _like(own: Buffer) -> tuple[object, ...]:
    return own.kind, own.channels, own.side, own.part


_BYTES = {"f1": 1, "f2": 2, "f4": 4, "i4": 4, "depth": 4}


def image_bytes(
    pixels: tuple[int, int],
    passes: Sequence[Pass] = PASSES,
    buffers: Sequence[Buffer] = BUFFERS,
    whole: Iterable[str] = ("picture",),
) -> int:
    """Bytes of the images that a picture of so many pixels takes."""
    images = set(shared(passes, buffers, whole).values())
    sizes = {own.name: own.size(pixels) for own in buffers}
    return sum(
        sizes[own.name][0] * sizes[own.name][1] * own.channels * _BYTES[own.kind]
        for own in buffers
        if own.name in images
    )


def without(names: Iterable[str], passes: Sequence[Pass] = PASSES) -> tuple[Pass, ...]:
    """The passes but for some. Raises `ValueError` for an unknown name, or where another needs what is left out."""
    left = set(names)
    known = [own.name for own in passes]
    for name in left - set(known):
        raise ValueError(f"there is no pass {name!r}{nearest(name, known)}")
    return arranged([own for own in passes if own.name not in left])


def seen_through(
    times: int, passes: Sequence[Pass] = PASSES, buffers: Sequence[Buffer] = BUFFERS
) -> tuple[tuple[Pass, ...], tuple[Buffer, ...]]:
    """Passes, and their buffers, that show what stands behind what is transparent, so many times in a row.

    G-buffer, grammar and light run again for what lies further back. They write images of their own, and light goes
    under what there is.
    """
    named = {own.name: own for own in passes}
    again = [named[name] for name in ("G-buffer", "grammar")]
    moved = {name: f"behind_{name}" for own in again for name in own.writes}

    def behind(own: Pass, number: int, **changes: Any) -> Pass:
        names = {*own.reads, *own.writes} & set(moved)
        defines = (*own.defines, "BEHIND", *(f"{name} {moved[name]}" for name in sorted(names)))
        reads, writes = (tuple(moved.get(name, name) for name in held) for held in (own.reads, own.writes))
        return replace(
            own,
            name=f"{own.name} behind {number}",
            defines=defines,
            reads=reads,
            writes=writes,
            seen=moved.get(own.seen, own.seen),
            **changes,
        )

    more: list[Pass] = []
    before = ""
    for number in range(1, times + 1):
        facing, renamed = ("facing", ()) if number == 1 else (moved["facing"], (f"facing {moved['facing']}",))
        more.append(
            Pass(f"see through {number}", "passed.frag", ("light", facing), ("passed",),
                 "Notes up to where a pixel is seen through.", defines=renamed, after=before)
        )  # fmt: skip
        mesh = behind(again[0], number, after=before)
        more.append(replace(mesh, reads=(*mesh.reads, "passed")))
        more.append(behind(again[1], number, after=mesh.name))
        more.append(behind(named["light"], number, after=mesh.name, under=True))
        before = mesh.name
    found: list[Pass] = []
    for own in passes:
        clear = own.name == "air"
        found.append(replace(own, defines=(*own.defines, "THROUGH")) if clear else own)
        if own.name == "light":
            found += more
    extra = [replace(own, name=moved[own.name]) for own in buffers if own.name in moved]
    through = Buffer("passed", 1, "f4", "Up to where a pixel is seen through, metres.")
    return arranged(found, (*buffers, through, *extra)), (*buffers, through, *extra)


THROUGH = 3
"""How many façades, one behind the other, are looked through where they are transparent."""

_FACADE = {own.name: own for own in PASSES}
FACADE: tuple[Pass, ...] = (
    _FACADE["G-buffer"],
    replace(
        _FACADE["grammar"],
        defines=("MIPS", "EDGES", "DEEP", "OUTLINE"),
        options=("relief", "samples", "everywhere", "color_only"),
    ),
    replace(
        _FACADE["light"],
        reads=("color", "normal", "specular", "facing"),
        when="lit",
        defines=("ALONE",),
        options=(),
    ),
    replace(_FACADE["tone"], reads=("light",), defines=("ALONE", "air light"), when="lit"),
)
"""For a façade that stands alone before nothing: nothing shades it, and its splits are sampled in place of smoothed."""

BARE: tuple[Pass, ...] = (
    FACADE[0],
    replace(FACADE[1], defines=("DEEP", "OUTLINE"), options=("relief", "color_only")),
    *FACADE[2:],
)
"""The same with one sample a pixel, and tiles in full size."""

PAGE: tuple[Pass, ...] = (
    FACADE[0],
    replace(FACADE[1], defines=("MIPS", "DEEP", "OUTLINE", "SEEDS"), options=(), when="sharp"),
    replace(
        FACADE[1],
        name="samples",
        defines=("MIPS", "EDGES", "DEEP", "OUTLINE", "SAMPLES", "SEEDS"),
        options=(),
        when="smooth",
    ),
    FACADE[2],
    replace(_FACADE["air"], defines=("ALONE",), seen="", when="lit"),
    replace(_FACADE["tone"], when="lit"),
)
"""For a façade on a page, before the sky: one sample a pixel first (`sharp`), then more around splits (`smooth`)."""


def used(passes: Sequence[Pass], buffers: Sequence[Buffer] = BUFFERS) -> tuple[Buffer, ...]:
    """The buffers that passes read and write."""
    names = {name for own in passes for name in (*own.reads, *own.writes)}
    return tuple(own for own in buffers if own.name in names)
