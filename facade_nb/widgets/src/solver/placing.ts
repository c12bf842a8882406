// Where every letter stands in the end, by the targets that other views name: letters, columns, boundaries, shapes.

import { target } from "./links.ts";
import type { Axis } from "./timeline.ts";

export interface PlacedLetter {
  event: "LetterPlaced";
  at: number;
  axis: Axis;
  group: string;
  layer: string;
  pattern: string;
  column: number;
  place: number;
  letter: number;
  symbol: string;
  start: number;
  end: number;
  mirrored: boolean;
  transparent: boolean;
}

export interface Boundaries {
  event: "BoundariesPlaced";
  at: number;
  axis: Axis;
  group: string;
  boundaries: number[];
}

export interface PlacedShape {
  event: "ShapeMerged";
  at: number;
  layer: string;
  x: string;
  y: string;
  rect: [number, number, number, number];
}

export interface PlacingData {
  events: (PlacedLetter | Boundaries | PlacedShape | { event: "AxisPosed" | "PathChosen" | "HoleFound"; at: number })[];
}

const NEAR = 1e-6;

/** An index of what is placed. */
export class Placing {
  readonly letters: PlacedLetter[];
  readonly boundaries: Boundaries[];
  readonly shapes: PlacedShape[];

  constructor({ events }: PlacingData) {
    this.letters = events.filter((event): event is PlacedLetter => event.event === "LetterPlaced");
    this.boundaries = events.filter((event): event is Boundaries => event.event === "BoundariesPlaced");
    this.shapes = events.filter((event): event is PlacedShape => event.event === "ShapeMerged");
  }

  /** The letters of an axis that a shape is made of. */
  lettersOf(shape: PlacedShape): Partial<Record<Axis, PlacedLetter>> {
    const [left, bottom, right, top] = shape.rect;
    return {
      x: this.find("x", shape.layer, shape.x, left, right),
      y: this.find("y", shape.layer, shape.y, bottom, top),
    } as never;
  }

  /** What a shape is about: its letters, their columns, symbols, layer. */
  about(shape: PlacedShape): string[] {
    const keys = [target.layer(shape.layer), target.symbol(shape.x), target.symbol(shape.y)];
    for (const letter of Object.values(this.lettersOf(shape)))
      if (letter)
        keys.push(
          target.letter(letter.axis, letter.layer, letter.letter),
          target.column(letter.axis, letter.group, letter.column),
        );
    return keys;
  }

  private find(axis: Axis, layer: string, symbol: string, start: number, end: number): PlacedLetter | undefined {
    return this.letters.find(
      (own) =>
        own.axis === axis &&
        own.layer === layer &&
        own.symbol === symbol &&
        own.start <= start + NEAR &&
        own.end >= end - NEAR,
    );
  }
}
