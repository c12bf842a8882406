"""Grammars of the three kinds that the texture paper times (its Figure 11)."""

__all__ = ["FULL", "RANDOM", "SIMPLE", "SIZE"]

SIZE = (12.0, 9.0)

SIMPLE = """
# Subdivisions and a fixed set of tiles, as in Figure 13 (a).
S -> SplitY(Abs, 3, Ground, Rel, 1, Middle, Abs, 0.5, Crown)
Ground -> SplitX(Rel, 1, Shops, Abs, 1.6, Entrance, Rel, 1, Shops)
Shops -> RepeatX(2.6, Shop)
Shop -> SplitX(Rel, 1, Stone, Abs, 2, ShopColumn, Rel, 1, Stone)
ShopColumn -> SplitY(Abs, 2.4, ShopFront, Rel, 1, Stone)
ShopFront -> Mat(Color, Fit:shop, 0, 0, 1, 1)
Entrance -> SplitY(Abs, 2.7, Door, Rel, 1, Stone)
Door -> Mat(Color, Fit:door, 0, 0, 1, 1)
Middle -> RepeatY(2.8, Floor)
Floor -> RepeatX(2, Bay)
Bay -> SplitX(Rel, 1, Wall, Abs, 1, Column, Rel, 1, Wall)
Column -> SplitY(Rel, 1, Wall, Abs, 1.6, Window, Rel, 1, Wall)
Window -> Mat(Color, Fit:window-cross, 0, 0, 1, 1)
Wall -> Mat(Color, Rep:brick, 0, 0, 0.5, 0.5)
Stone -> Mat(Color, Rep:rustic, 0, 0, 0.5, 0.625)
Crown -> Mat(Color, Rep:cornice, 0, 0, 0.833, 2)
"""

RANDOM = """
# Subdivisions with randomization, as in Figures 12 and 13 (b).
S -> Layer(Wall, Assets)
Wall -> RandUni(0, Wall1, Wall2, Wall3)
Wall1 -> Mat(Color, Rep:wall1, 0, 0, 1, 1)
Wall2 -> Mat(Color, Rep:wall2, 0, 0, 1, 1)
Wall3 -> Mat(Color, Rep:wall3, 0, 0, 1, 1)
Assets -> SplitY(Abs, 3, BottomFloor, Rel, 1, Middle, Abs, 2.5, TopFloor)
BottomFloor -> RandStack(BottomBays)
BottomBays -> RepeatX(2.5, WindowTile)
Middle -> RandStack(MiddleFloors)
MiddleFloors -> RepeatY(2.8, MiddleFloor)
MiddleFloor -> RepeatX(2, WindowTile)
TopFloor -> RandStack(TopBays)
TopBays -> RepeatX(3, WindowTile)
WindowTile -> SplitX(Rel, 1, Skip, Abs, 1, WindowTileColumn, Rel, 1, Skip)
WindowTileColumn -> SplitY(Rel, 1, Skip, Abs, 1.3, WindowMat, Rel, 1, Skip)
WindowMat -> RandUni(1, WindowMat1, WindowMat2, WindowMat3)
WindowMat1 -> Mat(Color, Fit:window1, 0, 0, 1, 1)
WindowMat2 -> Mat(Color, Fit:window2, 0, 0, 1, 1)
WindowMat3 -> Mat(Color, Fit:window3, 0, 0, 1, 1)
Skip -> Skip(0)
"""

FULL = """
# All operators, as in Figure 10: rooms with furniture, seen through masks, curtains, glass and frames.
namespace room {
  walls = Fit:room-white
  floor = Rep:parquet
  thing = Fit:sofa
  high = 0.85
  S -> Intrusion(4, Side, Back, Side, Floor, Ceiling)
  Side -> Mat(Color, walls, 0, 0, 1, 1)
  Back -> Layer(Side, Shine, Place)
  Shine -> Mat(Specular, 0, 0.1, 0.1, 0.1, 1)
  Place -> SplitX(Rel, 1, Skip, Abs, 1.3, Stand, Rel, 1, Skip)
  Stand -> SplitY(Abs, high, Thing, Rel, 1, Skip)
  Thing -> Mat(Color, thing, 0, 0, 1, 1)
  Floor -> Mat(Color, floor, 0, 0, 0.5, 0.5)
  Ceiling -> Mat(Color, Fit:ceiling, 0, 0, 1, 1)
}
namespace sage = room(walls = Fit:room-sage, thing = Fit:bookcase, high = 1.9)
namespace blue = room(walls = Fit:room-blue, floor = Rep:carpet, thing = Fit:table, high = 1.05)
namespace books = room(walls = Fit:room-books, floor = Rep:floorboards, thing = Fit:desk, high = 1.25)

S -> Layer(Grid(Behind), Bumpy, Grid(Hole), Grid(Frame), Trim)
Bumpy -> Layer(Wall, Bump)
Wall -> RandUni(0, Brick, Ochre)
Brick -> Mat(Color, Rep:brick, 0, 0, 0.5, 0.5)
Ochre -> Mat(Color, Rep:plaster-ochre, 0, 0, 0.5, 0.5)
Bump -> Mat(Normal, Rep:brick.normal, 0, 0, 0.5, 0.5)
Hole -> SkipMask(Fit:mask-rect, 0, 1)
Trim -> SplitY(Abs, 0.7, Plinth, Rel, 1, Skip, Abs, 0.4, Cornice)
Plinth -> Mat(Color, Rep:plinth, 0, 0, 0.625, 1.43)
Cornice -> Mat(Color, Rep:cornice, 0, 0, 0.833, 2.5)

Grid(what) -> RepeatY(3, Floor(what))
Floor(what) -> RandStack(Bays(what))
Bays(what) -> RepeatX(2.4, Bay(what))
Bay(what) -> SplitX(Rel, 1, Skip, Abs, 1.3, Column(what), Rel, 1, Skip)
Column(what) -> SplitY(Abs, 0.85, Skip, Abs, 1.8, what, Rel, 1, Skip)

Behind -> Layer(Room, Drapes, Pane)
Room -> Rand(0, 0.3, room.S, 0.3, sage.S, 0.2, blue.S, 0.2, books.S)
Drapes -> RandUni(0, Drapes1, Drapes2, Drapes3, Skip)
Drapes1 -> Mat(Color, Fit:curtain, 0, 0, 1, 1)
Drapes2 -> Mat(Color, Fit:net, 0, 0, 1, 1)
Drapes3 -> Mat(Color, Fit:blind, 0, 0, 1, 1)
Pane -> MatAlpha(Color, Fit:glass, 0, 0, 1, 1, 0, 1, 1, 1, 0.6)
Frame -> Layer(Sash, Gloss)
Gloss -> Mat(Specular, Fit:frame-casement.specular, 0, 0, 1, 1)
Sash -> RandUni(1, Sash1, Sash2)
Sash1 -> Mat(Color, Fit:frame-casement, 0, 0, 1, 1)
Sash2 -> Mat(Color, Fit:frame-brown, 0, 0, 1, 1)
Skip -> Skip(0)
"""
