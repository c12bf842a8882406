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
  private readonly abouts = new Map<PlacedShape, string[]>();

  /** @param chosen the word of each pattern in the layout, by axis */
  constructor(
    { events }: PlacingData,
    private readonly chosen: Record<Axis, { words: Record<string, string> } | null>,
  ) {
    this.letters = events.filter((event): event is PlacedLetter => event.event === "LetterPlaced");
    this.boundaries = events.filter((event): event is Boundaries => event.event === "BoundariesPlaced");
    this.shapes = events.filter((event): event is PlacedShape => event.event === "ShapeMerged");
  }

  /** The letters that a shape is made of, across and up. */
  lettersOf(shape: PlacedShape): PlacedLetter[] {
    const [left, bottom, right, top] = shape.rect;
    const across = this.find("x", shape.layer, shape.x, left, right);
    const up = this.find("y", shape.layer, shape.y, bottom, top);
    return [across, up].filter((letter) => letter !== undefined);
  }

  /** What a shape is about: its letters, their columns, symbols, words and patterns, its layer. */
  about(shape: PlacedShape): readonly string[] {
    const known = this.abouts.get(shape);
    if (known) return known;
    const keys = [target.layer(shape.layer), target.symbol(shape.x), target.symbol(shape.y)];
    for (const letter of this.lettersOf(shape)) {
      const { axis, pattern } = letter;
      const word = this.chosen[axis]?.words[pattern];
      keys.push(
        target.letter(axis, letter.layer, letter.letter),
        target.column(axis, letter.group, letter.column),
        target.pattern(pattern),
        ...(word === undefined ? [] : [target.word(axis, pattern, word)]),
      );
    }
    this.abouts.set(shape, keys);
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
