// The elevation's SVG text as a drawing: parsed, and measured in metres.

import { Sheet } from "./patching.ts";

export interface Drawing {
  svg: SVGSVGElement;
  width: number;
  height: number;
  /** Units of the drawing per metre. */
  scale: number;
  /** Where the façade's lower left corner lies, in units of the drawing. */
  origin: { x: number; y: number };
}

/** A drawing that follows its text. */
export interface LiveDrawing extends Drawing {
  sheet: Sheet;
}

export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** Parse what `elevation_svg` wrote. It is read as XML, so nothing in it can act as HTML. */
export function parseDrawing(text: string): Drawing {
  const root = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  const size = measured(root);
  root.removeAttribute("style");
  return { svg: document.importNode(root, true) as unknown as SVGSVGElement, ...size };
}

/** What a root says of itself. */
function measured(root: Element): Omit<Drawing, "svg"> {
  const number = (name: string) => Number(root.getAttribute(name));
  const [x = 0, y = 0] = (root.getAttribute("data-origin") ?? "").split(" ").map(Number);
  if (root.localName !== "svg" || !number("data-scale"))
    throw new Error("facade_nb: the elevation is not readable SVG");
  return { width: number("width"), height: number("height"), scale: number("data-scale"), origin: { x, y } };
}

/** The drawing of a text: the same one, changed where the text differs, or, where that cannot be, a new one. */
export function redraw(before: LiveDrawing | null, text: string): LiveDrawing {
  if (before?.sheet.follow(text)) return Object.assign(before, measured(before.svg));
  const drawing = parseDrawing(text.replaceAll("\n", ""));
  return { ...drawing, sheet: new Sheet(text, drawing.svg) };
}

/** The shape an element of the drawing belongs to. */
export function shapeAt(target: EventTarget | null): SVGGElement | null {
  return target instanceof Element ? target.closest<SVGGElement>("[data-shape]") : null;
}

/** The rectangle of a shape, in units of the drawing. */
export function boxOf(shape: Element): Box {
  const cell = shape.querySelector("rect.cell");
  const number = (name: string) => Number(cell?.getAttribute(name) ?? 0);
  return { x: number("x"), y: number("y"), width: number("width"), height: number("height") };
}

/** The shape that lies next in a direction from another, or the first one where none is picked. */
export function neighbour(shapes: Element[], from: Element | null, dx: number, dy: number): Element | null {
  if (!from) return shapes[0] ?? null;
  const centre = (shape: Element) => {
    const box = boxOf(shape);
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  };
  const here = centre(from);
  let best: Element | null = null;
  let least = Number.POSITIVE_INFINITY;
  for (const shape of shapes) {
    const there = centre(shape);
    const along = (there.x - here.x) * dx + (there.y - here.y) * dy;
    const across = Math.abs((there.x - here.x) * dy) + Math.abs((there.y - here.y) * dx);
    if (shape === from || along < 1) continue;
    const distance = along + 3 * across;
    if (distance < least) {
      least = distance;
      best = shape;
    }
  }
  return best;
}
