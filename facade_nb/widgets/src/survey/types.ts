// What facade_nb/widgets/survey/model.py tells: a façade in metres, and where its corners lie in the photograph.

export type Kind = "window" | "door";
/** Left, bottom, right, top: metres from the façade's lower left corner. */
export type Rect = [left: number, bottom: number, right: number, top: number];
export type Point = [x: number, y: number];

export interface Opening {
  kind: Kind;
  rect: Rect;
}

export interface Drawn {
  name: string;
  width: number;
  height: number;
  openings: Opening[];
  /** Lower left, lower right, upper right, upper left: parts of the picture, from its upper left. Empty: all of it. */
  corners: Point[];
  /** What is being changed: a run of changes with one key is one step of undo. */
  key?: string;
}
