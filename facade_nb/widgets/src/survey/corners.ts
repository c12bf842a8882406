// The four points that are put on the corners of the façade in the photograph.

import { mark, svg } from "../shared/dom.ts";
import type { Session } from "./session.ts";
import type { Point } from "./types.ts";

const NAMES = ["lower left", "lower right", "upper right", "upper left"];
/** Where they stand at first. */
const FIRST: Point[] = [
  [0.1, 0.9],
  [0.9, 0.9],
  [0.9, 0.1],
  [0.1, 0.1],
];

/** The points as they are, or as they stand at first. */
export function cornersOf(session: Session): Point[] {
  return session.drawn.corners.length === 4 ? session.drawn.corners : FIRST;
}

export function corners(session: Session) {
  const outline = svg("polygon", { class: "fnb-sur-outline" });
  let [wide, high]: Point = [1, 1];
  let shown: Point[] | null = null; // while one is dragged
  const points = () => shown ?? cornersOf(session);
  const put = (k: number, [x, y]: Point, key?: string) => {
    const now = points().map((own, n): Point => (n === k ? [limit(x), limit(y)] : own));
    if (key) session.change({ corners: now }, key);
    else shown = now;
    draw();
  };
  const grips = NAMES.map((name, k) => {
    const grip = svg("circle", {
      r: 8,
      tabindex: 0,
      role: "button",
      class: "fnb-sur-corner",
      "aria-label": `Corner, ${name}`,
    });
    grip.setAttribute("data-lm-suppress-shortcuts", "true");
    grip.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || !session.open) return;
      grip.setPointerCapture(event.pointerId);
      grip.focus({ preventScroll: true });
      shown = points();
      event.preventDefault();
      event.stopPropagation();
    });
    grip.addEventListener("pointermove", (event) => {
      const box = grip.ownerSVGElement?.getBoundingClientRect();
      if (shown && box) put(k, [(event.clientX - box.left) / wide, (event.clientY - box.top) / high]);
    });
    grip.addEventListener("pointerup", () => {
      const done = shown;
      shown = null;
      if (done) session.change({ corners: done });
    });
    grip.addEventListener("keydown", (event) => {
      const steps: Record<string, Point> = {
        ArrowLeft: [-1, 0],
        ArrowRight: [1, 0],
        ArrowUp: [0, -1],
        ArrowDown: [0, 1],
      };
      const step = steps[event.key];
      if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
      const by = event.shiftKey ? 10 : 1;
      const [x, y] = points()[k] as Point;
      put(k, [x + (step[0] * by) / wide, y + (step[1] * by) / high], `corner ${k}`);
      event.preventDefault();
      event.stopPropagation();
    });
    return grip;
  });
  const el = svg("g", { class: "fnb-sur-corners" }, outline, ...grips);
  const draw = () => {
    const places = points().map(([x, y]): Point => [x * wide, y * high]);
    mark(outline, "points", places.map((own) => own.join()).join(" "));
    for (const [k, [x, y]] of places.entries()) {
      mark(grips[k] as Element, "cx", String(x));
      mark(grips[k] as Element, "cy", String(y));
    }
  };
  return {
    el,
    update(size: Point) {
      [wide, high] = size;
      el.style.display = session.cornering ? "" : "none";
      if (session.cornering) draw();
    },
  };
}

function limit(part: number): number {
  return Math.min(1, Math.max(0, part));
}
