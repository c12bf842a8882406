"""Figure 12 of the texture paper as its scan has it, without what it leaves out (`, ...` and lines of `:`)."""

__all__ = ["FIGURE_12"]

FIGURE_12 = """
S->Layer(Wall, Assets)
Wall->RandUni(0, Wall1, Wall2, Wall3)
Wall1->Mat(Color, Rep:wall1, 0.0, 0.0, 1.0, 1.0)
Wall2->Mat(Color, Rep:wall2, 0.0, 0.0, 1.0, 1.0)
Wall3->Mat(Color, Rep:wall3, 0.0, 0.0, 1.0, 1.0)
Assets->SplitY(Abs, 3.0, BottomFloor,
              Rel, 1.0, Middle,
              Abs, 2.5, TopFloor)
BottomFloor->RandStack(BottomFloorSeedStored)
BottomFloorSeedStored->RepeatX(2.5, WindowTile)
Middle->RandStack(MiddleSeedStored)
MiddleSeedStored->RepeatY(2.8, MiddleFloor)
MiddleFloor->RepeatX(2, WindowTile)
TopFloor->RandStack(TopFloorSeedStored)
TopFloorSeedStored->RepeatX(3, WindowTile)
WindowTile->SplitX(Rel, 1.0, Skip,
                  Abs, 1.0, WindowTileColumn,
                  Rel, 1.0, Skip)
WindowTileColumn->SplitY(Rel, 1.0, Skip,
                          Abs, 1.3, WindowMat,
                          Rel, 1.0, Skip)
WindowMat->RandUni(1, WindowMat1, WindowMat2, WindowMat3)
WindowMat1->Mat(Color, Fit>window1, 0.0, 0.0, 1.0, 1.0)
WindowMat2->Mat(Color, Fit>window2, 0.0, 0.0, 1.0, 1.0)
WindowMat3->Mat(Color, Fit>window3, 0.0, 0.0, 1.0, 1.0)
Skip->Skip(0)
"""
