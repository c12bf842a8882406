"""The tiles that ship, one line each: what they show, how large that is, and how they are drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from . import (
    doors,
    fabric,
    furniture,
    greenery,
    masks,
    masonry,
    ornament,
    passers,
    plain,
    rooms,
    street,
    timber,
    windows,
)
from .canvas import Canvas

__all__ = ["CATALOGUE", "MAPS", "Recipe"]

Draw = Callable[[Canvas, int], None]

MAPS = ("normal", "specular")
"""What a tile may have beside its colour; ``brick.normal`` is the normal map of ``brick``."""


@dataclass(frozen=True, slots=True)
class Recipe:
    """A tile.

    Attributes
    ----------
    name
        As a grammar writes it after ``Fit:`` or ``Rep:``.
    group
        The heading it stands under.
    width, height
        What it shows, metres; a wall of 2 m is repeated with a scale of 0.5.
    tiling
        Where it goes on at the opposite edge: ``xy``, ``x``, ``y`` or empty.
    draw
        What draws it on a canvas, from a seed.
    summary
        One line for the docs.
    seed
        Of its irregularities.
    maps
        Which of `MAPS` it has.
    mask
        Whether it is made for `SkipMask`.
    shade
        How much of the sky's light is drawn into its colour, 0 to 1.
    even
        Its colour is evened out below that many swings across it, so that it may be repeated often; 0: as drawn.
    relief
        Whether it is deep as it is drawn. Leaves are not: they only look towards where they would.
    """

    name: str
    group: str
    width: float
    height: float
    tiling: str
    draw: Draw
    summary: str
    seed: int = 1
    maps: tuple[str, ...] = MAPS
    mask: bool = False
    shade: float = 1.0
    even: float = 0.0
    relief: bool = True


def _render(colour: str) -> Draw:
    return lambda canvas, seed: plain.plaster(canvas, seed, colour)


def _leafy(draw: Callable[[Canvas, int, Sequence[str]], None], tones: Sequence[str]) -> Draw:
    return lambda canvas, seed: draw(canvas, seed, tones)


def _hole(shape: str) -> Draw:
    return lambda canvas, _: masks.mask(canvas, shape)


def _recipes() -> list[Recipe]:
    wall, window, frame, door = (
        "Walls and roofs",
        "Windows",
        "Frames, open between their bars",
        "Doors, shutters and gates",
    )
    ornament_, cloth, room, thing, ground, green, hole = (
        "Ornament and ironwork",
        "Curtains, blinds, glass",
        "Rooms",
        "Furniture and lamps",
        "Streets and shops",
        "Trees and street lamps",
        "Masks",
    )
    plain_ = ("normal",)
    red = ("#9a5a45", "#8d5140", "#a5654d", "#94553f", "#7f4a3c")
    yellow = ("#cdb283", "#c5a877", "#d6bd91", "#bfa06d", "#c9ad80")
    dark = ("#6d4a43", "#5f433e", "#77524a", "#69504a")
    lime = ("#d2c9b5", "#cec5b0", "#d5ccb9", "#cbc1ac")
    gold = ("#d0b68b", "#c9ad80", "#d5bd95", "#c6a97a")
    oak = ("#a5835a", "#9a7850", "#ae8d64", "#94724c")

    def stack(*rows: tuple[float, ...]) -> tuple[tuple[float, ...], ...]:
        return rows

    courses = (0.3, 0.24, 0.3, 0.24, 0.3, 0.24)
    lengths = stack((3, 4, 3.5), (2.5, 3, 2.5, 3), (4, 3, 3), (3, 2.5, 3, 2), (3.5, 3.5, 3), (2.5, 3.5, 2, 3))
    return [
        Recipe("wall1", wall, 1, 1, "xy", lambda c, s: plain.plaster(c, s, "#e2d8c3"),
            "lime render, warm; repeats every metre", 11, plain_, even=4),
        Recipe("wall2", wall, 1, 1, "xy", lambda c, s: masonry.brick(c, s, red, "#c9bfae"),
            "red brick; repeats every metre", 12),
        Recipe("wall3", wall, 1, 1, "xy",
            lambda c, s: masonry.ashlar(c, s, lime, "#aea48f", (1, 1, 1, 1), stack((1, 1), (1, 1), (1, 1), (1, 1))),
            "limestone blocks; repeat every metre", 13),
        *(
            Recipe(name, wall, 2, 2, "xy", _render(colour),
                f"lime render, {what}", seed, plain_, even=6)
            for name, colour, what, seed in (
                ("plaster", "#e6ddca", "warm white", 21), ("plaster-white", "#efebe2", "nearly white", 22),
                ("plaster-ochre", "#dcc596", "Schönbrunn yellow", 23), ("plaster-rose", "#d9b1a0", "old rose", 24),
                ("plaster-sage", "#bdc5ab", "sage green", 25), ("plaster-grey", "#c8c5be", "light grey", 26),
                ("plaster-blue", "#b5c3cd", "pale blue grey", 20),
            )
        ),
        Recipe("banded", wall, 2, 1.6, "xy", lambda c, s: masonry.rustic(c, s,
            "#e0d8c6", 4, 0, groove=0.05, sink=0.025), "plaster with sunk bands", 27),
        Recipe("rustic", wall, 2, 1.6, "xy", lambda c, s: masonry.rustic(c, s,
            "#cdc3ae", 4, 2, groove=0.07, sink=0.04), "rusticated blocks of a ground floor", 28),
        Recipe("brick", wall, 2, 2, "xy", lambda c, s: masonry.brick(c, s, red, "#c6bba9"),
            "red brick, stretcher bond", 29),
        Recipe("brick-yellow", wall, 2, 2, "xy", lambda c, s: masonry.brick(c, s, yellow, "#d5cbb8", bond="cross"),
            "gault brick, cross bond", 30),
        Recipe("brick-dark", wall, 2, 2, "xy", lambda c, s: masonry.brick(c, s, dark, "#8f867c"),
            "clinker", 31),
        Recipe("ashlar", wall, 2, 1.62, "xy", lambda c, s: masonry.ashlar(c, s, lime, "#aaa08b", courses, lengths),
            "limestone in courses of two heights", 32),
        Recipe("sandstone", wall, 2, 1.62, "xy",
            lambda c, s: masonry.ashlar(c, s, gold, "#a8906a", courses, lengths, bed=0.03),
            "golden sandstone with its beds", 33),
        Recipe("stone", wall, 2, 2, "xy", lambda c, s: plain.plaster(c, s, "#cfc7b6", rough=0.7),
            "dressed limestone without joints", 34, plain_, even=6),
        Recipe("concrete", wall, 2.5, 2.5, "xy", lambda c, s: plain.concrete(c, s, "#b9b6af"),
            "fair-faced concrete", 35, even=1.5),
        Recipe("granite", wall, 2, 2, "xy", lambda c, s: plain.granite(c, s, "#9fa09e"), "grey granite slabs", 94),
        Recipe("wood", wall, 2, 2, "xy", lambda c, s: plain.boards(c, s, oak, 14),
            "upright larch boards", 36),
        Recipe("wood-grey", wall, 2, 2, "xy", lambda c, s: plain.boards(c, s, ("#9b9890", "#8f8c84", "#a6a299"), 14),
            "weathered boards", 37),
        Recipe("weatherboard", wall, 2, 1.6, "xy",
            lambda c, s: plain.boards(c, s, ("#e4e0d6", "#e0dcd1"), 10, upright=False, round_=0.012, figure=0.25),
            "painted boards laid level", 38),
        Recipe("metal", wall, 2.4, 2.4, "xy", lambda c, s: plain.seams(c, s,
            "#969ca0", 5), "zinc with standing seams", 39),
        Recipe("copper", wall, 2.4, 2.4, "xy", lambda c, s: plain.seams(c, s,
            "#82a896", 5), "copper with its patina", 40),
        Recipe("tiles", wall, 2, 2, "xy",
            lambda c, s: masonry.tiles(c, s, ("#9a614c", "#8f5a47", "#a46e57", "#855241"), 6, 8),
            "clay pantiles", 41),
        Recipe("slate", wall, 2, 2, "xy",
            lambda c, s: masonry.slates(c, s, ("#585f69", "#626a73", "#50575f", "#5c5f6a"), 10, 7),
            "roof slates", 42),
        Recipe("timber", wall, 1, 2, "xy", lambda c, s: timber.beam(c, s, "#5a4737"),
            "hewn oak, upright", 43, plain_, even=3),
        Recipe("beam", wall, 2, 1, "xy", lambda c, s: timber.beam(c, s, "#5a4737", upright=False),
            "hewn oak, level", 45, plain_, even=3),
        Recipe("gravel", wall, 2, 2, "xy",
            lambda c, s: street.gravel(c, s, ("#8f8a80", "#a8a297", "#bdb7aa", "#9a8f80")),
            "gravel, also of flat roofs", 44, plain_, even=5),
        Recipe("window1", window, 1, 1.3, "", lambda c, s: windows.casement(c, s, "sheer"),
            "casement with a cornice, about 1890", 51),
        Recipe("window2", window, 1, 1.3, "", lambda c, s: windows.sash(c, s, "drapes"),
            "Georgian sash, six over six", 52),
        Recipe("window3", window, 1, 1.3, "", lambda c, s: windows.modern(c, s, "dark"),
            "dark aluminium, today", 53),
        Recipe("window-cross", window, 1.2, 1.8, "",
            lambda c, s: windows.casement(c, s, "half", wood="#5b4a3b", stone="#cfc5b0", crown=False),
            "brown casement, plain surround", 54),
        Recipe("window-green", window, 1.1, 1.5, "",
            lambda c, s: windows.casement(c, s, "drapes", wood="#4c6155", stone="#e6e0d3", crown=False, transom=0.27),
            "green casement", 55),
        Recipe("window-sash", window, 1.1, 1.9, "",
            lambda c, s: windows.sash(c, s, "sheer", columns=2, rows=1, wood="#e9e5da", stone="#cdbf9f"),
            "Victorian sash, two over two", 56),
        Recipe("window-arch", window, 1.2, 2.1, "", lambda c, s: windows.arched(c, s, "dark"),
            "round-headed, stone arch", 57),
        Recipe("window-leaded", window, 1.3, 1.5, "", lambda c, s: windows.gothic(c, s, "dark"),
            "stone cross with leaded lights, before 1600", 58),
        Recipe("window-steel", window, 2, 2, "", lambda c, s: windows.steel(c, s, "empty"),
            "steel sections of a works, about 1910", 59),
        Recipe("window-blind", window, 1.2, 1.4, "",
            lambda c, s: windows.modern(c, s, "blind", metal="#e4e2dc", split=0.5),
            "white, two leaves, a blind half down", 60),
        Recipe("shop", window, 3.6, 3, "", lambda c, s: windows.shop(c, s, "shop"),
            "shop front with fanlights", 61),
        Recipe("frame-casement", frame, 1.2, 1.8, "", lambda c, s: windows.casement(c, s, None, crown=False),
            "casement in a surround", 54),
        Recipe("frame-crowned", frame, 1.2, 1.9, "", lambda c, s: windows.casement(c, s, None),
            "casement with a cornice", 51),
        Recipe("frame-brown", frame, 1.2, 1.8, "",
            lambda c, s: windows.casement(c, s, None, wood="#5b4a3b", stone="#cfc5b0", crown=False),
            "brown casement", 54),
        Recipe("frame-sash", frame, 1.1, 1.8, "", lambda c, s: windows.sash(c, s, None), "Georgian sash", 52),
        Recipe("frame-modern", frame, 1.4, 1.5, "", lambda c, s: windows.modern(c, s, None),
            "dark aluminium", 53),
        Recipe("frame-arch", frame, 1.2, 2.1, "", lambda c, s: windows.arched(c, s, None),
            "round-headed", 57),
        Recipe("frame-steel", frame, 2, 2, "", lambda c, s: windows.steel(c, s, None), "steel sections", 59),
        Recipe("frame-shop", frame, 3.6, 3, "", lambda c, s: windows.shop(c, s, None), "shop front", 61),
        Recipe("frame-works", frame, 2.4, 2.9, "", lambda c, s: windows.works(c, s, None),
            "steel sections below a segmental brick arch", 62),
        Recipe("frame-balcony", frame, 1.3, 2.6, "", lambda c, s: doors.balcony_door(c, s, None),
            "balcony door", 63),
        Recipe("balcony-door", door, 1.3, 2.6, "", lambda c, s: doors.balcony_door(c, s, "sheer"),
            "two glazed leaves to the floor", 63),
        Recipe("door", door, 1.6, 3, "", doors.panelled,
            "oak, two leaves, fanlight, step", 64),
        Recipe("door-green", door, 1.2, 2.7, "",
            lambda c, s: doors.panelled(c, s, wood="#3f5648", double=False, grain=0.4),
            "green, one leaf", 65),
        Recipe("door-blue", door, 1.6, 3, "",
            lambda c, s: doors.panelled(c, s, wood="#3d566b", glazed=True, grain=0.4),
            "blue, glazed above", 66),
        Recipe("door-modern", door, 1.5, 2.5, "", doors.modern_door,
            "oak strips beside a pane", 67),
        Recipe("gate", door, 3.2, 3.8, "", doors.gate,
            "carriage gate in a stone arch", 68),
        Recipe("shutter", door, 0.55, 1.6, "", doors.louvres, "louvred leaf, green", 69),
        Recipe("shutter-grey", door, 0.55, 1.6, "", doors.panel_shutter,
            "panelled leaf, grey blue", 70),
        Recipe("shutter-roller", door, 1.2, 1.2, "xy", doors.roller, "roller shutter", 71),
        Recipe("cornice", ornament_, 1.2, 0.8, "x", lambda c, s: ornament.cornice(c, s, dentils=6),
            "main cornice with dentils", 72),
        Recipe("cornice-bracketed", ornament_, 1.2, 0.9, "x", lambda c, s: ornament.cornice(c, s, brackets=2),
            "main cornice on brackets", 73),
        Recipe("string-course", ornament_, 1, 0.3, "x", ornament.string_course,
            "moulding between floors", 74),
        Recipe("plinth", ornament_, 1.6, 0.7, "x", ornament.plinth, "foot of a wall", 75),
        Recipe("quoins", ornament_, 0.6, 1.4, "y", ornament.quoins, "corner stones", 76),
        Recipe("surround", ornament_, 1.4, 2, "", ornament.window_surround,
            "moulded surround, open inside", 77),
        Recipe("pediment", ornament_, 1.6, 0.7, "", ornament.pediment,
            "triangular pediment", 78),
        Recipe("column", ornament_, 0.4, 3, "", ornament.column, "round column", 92),
        Recipe("pilaster", ornament_, 0.5, 3, "", ornament.pilaster, "flat pillar", 93),
        Recipe("balustrade", ornament_, 1.2, 0.9, "x", ornament.balusters,
            "stone balusters", 79),
        Recipe("railing", ornament_, 1, 1, "x", ornament.railing,
            "wrought iron with rings", 80),
        Recipe("railing-plain", ornament_, 1, 1, "x", lambda c, s: ornament.railing(c, s, count=9, ornate=False),
            "upright iron bars", 81),
        Recipe("brace", ornament_, 1, 1.1, "",
            lambda c, s: timber.brace(c, s, (((0.1, -0.1), (0.45, 0.5), (1.02, 1.06)),), "#5a4737", 0.15),
            "a brace of a timber frame, leaning to the right", 95, plain_),
        Recipe("brace-cross", ornament_, 0.9, 0.75, "",
            lambda c, s: timber.brace(c, s, (((0, 0), (1, 1)), ((0, 1), (1, 0))), "#5a4737", 0.12),
            "a St Andrew's cross of a timber frame", 96, plain_),
        Recipe("curtain", cloth, 1.2, 1.8, "", fabric.curtain,
            "drawn to both sides, sand", 82, (), shade=0),
        Recipe("curtain-red", cloth, 1.2, 1.8, "", lambda c, s: fabric.curtain(c, s, colour="#8c4a3f"),
            "drawn to both sides, red", 83, (), shade=0),
        Recipe("curtain-green", cloth, 1.2, 1.8, "", lambda c, s: fabric.curtain(c, s, colour="#6f7d68"),
            "drawn to both sides, green", 84, (), shade=0),
        Recipe("net", cloth, 1.2, 1.8, "", fabric.net, "net curtain", 85, (), shade=0),
        Recipe("cafe", cloth, 1.2, 1.8, "", fabric.cafe,
            "curtain across the lower half", 86, (), shade=0),
        Recipe("blind", cloth, 1.2, 1.8, "", fabric.shade_blind,
            "roller blind, partly down", 87, (), shade=0),
        Recipe("slats", cloth, 1.2, 1.8, "", fabric.slats,
            "venetian blind", 88, (), shade=0),
        Recipe("glass", cloth, 1.2, 1.8, "", fabric.glass,
            "what a pane mirrors by day", 89, ("specular",), shade=0),
        Recipe("glass-dusk", cloth, 1.2, 1.8, "", lambda c, s: fabric.glass(c, s, dusk=True),
            "what a pane mirrors at dusk", 90, ("specular",), shade=0),
        Recipe("room-white", room, 4, 2.8, "", lambda c, s: rooms.painted(c, s, "#dcd6c8", pictures=2),
            "painted wall with pictures", 101, ()),
        Recipe("room-sage", room, 4, 2.8, "", lambda c, s: rooms.painted(c, s, "#aab39c", pictures=1),
            "sage wall with a picture", 102, ()),
        Recipe("room-terracotta", room, 4, 2.8, "", lambda c, s: rooms.painted(c, s, "#c08f73"),
            "terracotta wall", 103, ()),
        Recipe("room-blue", room, 4, 2.8, "", lambda c, s: rooms.papered(c, s, ("#9fb0b8", "#8b9fa9")),
            "blue striped paper above a dado", 104, ()),
        Recipe("room-paper", room, 4, 2.8, "", lambda c, s: rooms.papered(c, s, ("#d9c9a3", "#cdbb92")),
            "straw striped paper above a dado", 105, ()),
        Recipe("room-books", room, 4, 2.8, "", rooms.bookshelves,
            "a wall of books", 106, ()),
        Recipe("room-door", room, 4, 2.8, "", lambda c, s: rooms.with_door(c, s, "#d3ccbb"),
            "painted wall with a door", 107, ()),
        Recipe("room-window", room, 4, 2.8, "", lambda c, s: rooms.with_window(c, s, "#d8d2c4"),
            "painted wall with a window, for rooms in corners", 115, ()),
        Recipe("parquet", room, 2, 2, "xy",
            lambda c, s: rooms.herringbone(c, s, ("#a9804f", "#9c7445", "#b48c5b", "#a07a4c")),
            "herringbone oak", 108, ()),
        Recipe("floorboards", room, 2.4, 2.4, "xy",
            lambda c, s: plain.boards(c, s, ("#a47c50", "#997247", "#b0895c"), 16, upright=False, gap=0.003,
                round_=0.001, ends=2, gloss=0.3),
            "pine boards", 109, ()),
        Recipe("floor-tiles", room, 2, 2, "xy", lambda c, s: rooms.stone_floor(c, s, ("#dcd6c8", "#6f6c66")),
            "black and white stone", 110, ()),
        Recipe("carpet", room, 2, 2, "xy", lambda c, s: rooms.carpet(c, s, "#857d72"),
            "grey carpet", 111, ()),
        Recipe("ceiling", room, 4, 4, "", rooms.ceiling, "cove and rosette", 112, ()),
        Recipe("ceiling-plain", room, 4, 4, "", lambda c, s: rooms.ceiling(c, s, rosette=False),
            "cove and frame", 113, ()),
        Recipe("ceiling-office", room, 2.5, 2.5, "xy", rooms.office_ceiling,
            "mineral boards and lamps", 114, ()),
        Recipe("sofa", thing, 2.1, 0.85, "", furniture.sofa, "green sofa", 121, ()),
        Recipe("sofa-blue", thing, 2.1, 0.85, "",
            lambda c, s: furniture.sofa(c, s, colour="#5f7380", pillow="#c7b199"),
            "blue sofa", 122, ()),
        Recipe("table", thing, 1.9, 1.05, "", furniture.table,
            "table and chairs", 123, ()),
        Recipe("bookcase", thing, 1, 2, "", furniture.bookcase,
            "shelves with books", 124, ()),
        Recipe("cupboard", thing, 1.2, 2, "", furniture.cupboard,
            "painted wardrobe", 125, ()),
        Recipe("desk", thing, 1.6, 1.25, "", furniture.desk,
            "desk, screen, chair", 126, ()),
        Recipe("bed", thing, 1.7, 1, "", furniture.bed, "bed from its foot", 127, ()),
        Recipe("plant", thing, 0.9, 1.6, "", furniture.plant, "rubber plant", 128, ()),
        Recipe("lamp", thing, 0.6, 0.8, "", furniture.pendant,
            "hanging lamp", 129, (), shade=0),
        Recipe("lamp-floor", thing, 0.5, 1.6, "", furniture.floor_lamp,
            "standard lamp", 130, (), shade=0),
        Recipe("lamp-ceiling", thing, 1, 1, "", furniture.ceiling_lamp,
            "round lamp seen from below", 131, (), shade=0),
        Recipe("asphalt", ground, 2, 2, "xy", street.asphalt, "rolled asphalt", 151, plain_, even=6),
        Recipe("paving", ground, 2, 2, "xy", lambda c, s: street.paving(c, s, "#a29d94"),
            "concrete flags", 152, plain_),
        Recipe("grass", ground, 2, 2, "xy", lambda c, s: street.grass(c, s, ("#4d5538", "#7b825a")),
            "mown grass", 153, plain_, even=5),
        Recipe("awning", ground, 3.2, 1, "", street.awning, "canvas awning, striped", 154, plain_),
        Recipe("goods", ground, 1.8, 1.5, "", street.goods, "what shops show: below boxes, above fruit", 155, ()),
        Recipe("sign", ground, 3.2, 2, "", lambda c, s: street.sign(c, s, ("BOOKS", "CAFE", "GROCER", "FLORIST")),
            "letters of signs, four rows", 156, (), shade=0.4),
        Recipe("crown", green, 5, 5, "", _leafy(greenery.crown, ("#263319", "#3d4f27", "#5a6f35", "#78894a")),
            "crown of a lime, gaps between its leaves", 211, plain_, shade=0.6, relief=False),
        Recipe("crown-light", green, 4, 5, "", lambda c, s: greenery.crown(
            c, s, ("#33421d", "#526629", "#788b40", "#9aa75e"), bunch=0.38, airy=0.7),
            "crown of a birch", 223, plain_, shade=0.6, relief=False),
        Recipe("tree", green, 4, 5.4, "", lambda c, s: greenery.crown(
            c, s, ("#2b391c", "#445829", "#627838", "#81934f"), bunch=0.4, airy=0.3, trunk=1.3),
            "small tree as a whole", 227, plain_, shade=0.6, relief=False),
        Recipe("spruce", green, 3.6, 9, "", _leafy(greenery.spruce, ("#1b2a1f", "#2b3d2b", "#405541")),
            "spruce", 231, plain_, shade=0.6, relief=False),
        Recipe("street-lamp", green, 0.8, 4.4, "", greenery.post_lamp, "street lamp on its post", 251, plain_,
            relief=False),
        Recipe("people", green, 2.8, 1.86, "", passers.people, "four figures, each in a quarter", 261, (),
            shade=0.8, relief=False),
        Recipe("wheel", green, 0.66, 0.66, "", passers.wheel, "wheel of a car", 262, (), shade=0.5, relief=False),
        *(
            Recipe(f"mask-{shape}", hole, 1.2, 2.1 if shape == "arch" else 1.8, "", _hole(shape),
                what, 1, (), mask=True, shade=0)
            for shape, what in (
                ("rect", "rectangle"), ("arch", "round head"), ("segment", "segmental head"),
                ("pointed", "pointed head"),
                ("round", "bull's eye"), ("gable", "triangle, for the gable of a roof"),
            )
        ),
        Recipe("fade-up", hole, 1, 1, "", lambda c, _: masks.fade(c, "up"),
            "from black below to white above", 1, (), shade=0),
        Recipe("fade-right", hole, 1, 1, "", lambda c, _: masks.fade(c, "right"),
            "from black at the left to white at the right", 1, (), shade=0),
        Recipe("clouds", hole, 8, 8, "xy", masks.clouds,
            "soft patches, to blend and to weather walls", 140, (), shade=0),
    ]  # fmt: skip


CATALOGUE: Mapping[str, Recipe] = MappingProxyType({recipe.name: recipe for recipe in _recipes()})
"""Every tile that ships, by name, in the order of the docs."""
