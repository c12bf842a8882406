// Where the letters of a candidate that is not the layout would stand, and the façade that they make: every pair that makes a
// shape in the layout is drawn as it is there, on the candidate's letters at preferred sizes.

import { type Box, boxOf, type Drawing } from "../drawing.ts";
import { atPreferred, cutsOf } from "./align/matrix.ts";
import type { Alternative } from "./alternatives.ts";
import { target } from "./links.ts";
import type { PlacedShape } from "./placing.ts";

export interface Standing {
  /** Its number in its word. */
  letter: number;
  symbol: string;
  start: number;
  end: number;
}

/** The solid letters of a candidate by layer, metres along its axis. */
export function standing({ groups }: Alternative): Map<string, Standing[]> {
  const found = new Map<string, Standing[]>();
  for (const { path } of groups) {
    const { elements } = atPreferred(path, cutsOf(path), {});
    for (const [b, band] of path.bands.entries()) {
      const letters = new Map<number, Standing>();
      for (const { letter, start, end } of elements.flatMap((column) => column[b]?.pieces ?? [])) {
        const note = band.letters[letter];
        if (!note || note.transparent) continue;
        const own = letters.get(letter);
        letters.set(letter, { letter, symbol: note.symbol, start: own?.start ?? start, end });
      }
      for (const row of band.rows) found.set(path.layers[row] ?? "", [...letters.values()]);
    }
  }
  return found;
}

/** A copy of a shape: where it stands in the drawing, and the targets that it shows. */
export interface Rebuilt {
  el: SVGGElement;
  box: Box;
  keys: string[];
}

/**
 * Copies of the layout's shapes, moved and stretched to where a candidate's letters stand.
 *
 * @param shapes as they are told, with `elements` as they are drawn, in painting order
 */
export function rebuilt(
  own: Alternative,
  shapes: readonly PlacedShape[],
  elements: readonly SVGGElement[],
  { scale, origin }: Drawing,
): Rebuilt[] {
  const { axis } = own.note;
  const letters = standing(own);
  const seen = new Set<string>();
  const made: Rebuilt[] = [];
  for (const [n, shape] of shapes.entries()) {
    const element = elements[n];
    const [left, bottom, right, top] = shape.rect;
    const across = axis === "x" ? [bottom, top] : [left, right];
    const symbol = axis === "x" ? shape.x : shape.y;
    const key = [shape.layer, symbol, ...across.map((value) => value.toFixed(4))].join("|");
    if (!element || seen.has(key)) continue; // a letter's shape stands once in every row of the other axis
    seen.add(key);
    const box = boxOf(element);
    for (const letter of letters.get(shape.layer) ?? []) {
      if (letter.symbol !== symbol) continue;
      const size = (letter.end - letter.start) * scale;
      const copy = element.cloneNode(true) as SVGGElement;
      for (const name of [
        "data-shape",
        "data-later",
        "data-hidden",
        "data-link",
        "data-about",
        "data-lit",
        "data-chosen",
      ])
        copy.removeAttribute(name);
      const [from, long] = axis === "x" ? [box.x, box.width] : [box.y, box.height];
      const to = axis === "x" ? origin.x + letter.start * scale : origin.y - letter.end * scale;
      const by = size / Math.max(long, 1e-9);
      const move = (to - from * by).toFixed(3);
      copy.setAttribute(
        "transform",
        axis === "x"
          ? `translate(${move} 0) scale(${by.toFixed(5)} 1)`
          : `translate(0 ${move}) scale(1 ${by.toFixed(5)})`,
      );
      const keys = [
        target.letter(axis, shape.layer, letter.letter),
        target.layer(shape.layer),
        target.symbol(shape.x),
        target.symbol(shape.y),
      ];
      const stands = axis === "x" ? { ...box, x: to, width: size } : { ...box, y: to, height: size };
      made.push({ el: copy, box: stands, keys });
    }
  }
  return made;
}
