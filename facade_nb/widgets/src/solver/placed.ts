// Where the letters of a candidate that is not the layout would stand, and the façade that they make: every pair that makes a
// shape in the layout is drawn as it is there, on the candidate's letters at preferred sizes.

import { type Box, boxOf, type Drawing } from "../shared/drawing.ts";
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

const symbols = ({ layer, x, y }: PlacedShape): string => [layer, x, y].join("|");

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
  // A shape that is behind others in the layout is drawn plain; one of the same symbols that is not has all its parts.
  const fullest = new Map<string, SVGGElement>();
  for (const [n, shape] of shapes.entries()) {
    const [element, before] = [elements[n], fullest.get(symbols(shape))];
    if (element && element.childElementCount > (before?.childElementCount ?? 0)) fullest.set(symbols(shape), element);
  }
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
    const source = fullest.get(symbols(shape)) ?? element;
    const like = boxOf(source);
    for (const letter of letters.get(shape.layer) ?? []) {
      if (letter.symbol !== symbol) continue;
      const size = (letter.end - letter.start) * scale;
      const copy = source.cloneNode(true) as SVGGElement;
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
      const to = axis === "x" ? origin.x + letter.start * scale : origin.y - letter.end * scale;
      const stands = axis === "x" ? { ...box, x: to, width: size } : { ...box, y: to, height: size };
      const [sx, sy] = [stands.width / Math.max(like.width, 1e-9), stands.height / Math.max(like.height, 1e-9)];
      const [dx, dy] = [stands.x - like.x * sx, stands.y - like.y * sy];
      copy.setAttribute(
        "transform",
        `translate(${dx.toFixed(3)} ${dy.toFixed(3)}) scale(${sx.toFixed(5)} ${sy.toFixed(5)})`,
      );
      const keys = [
        target.letter(axis, shape.layer, letter.letter),
        target.layer(shape.layer),
        target.symbol(shape.x),
        target.symbol(shape.y),
      ];
      made.push({ el: copy, box: stands, keys });
    }
  }
  return made;
}
