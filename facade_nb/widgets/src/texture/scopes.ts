// The scopes of a pixel's derivation, drawn over the picture: those on the façade, and those in the rooms behind it.

import { svg } from "../shared/dom.ts";
import type { Session } from "./session.ts";
import { outline, project, type Sight } from "./sight.ts";
import type { Pair } from "./types.ts";

/** Draw them into `overlay`, for a picture `wide` by `tall` pixels of the page: both above 0. */
export function drawScopes(overlay: SVGElement, session: Session, sight: Sight, wide: number, tall: number): void {
  const [now, ...before] = session.steps.slice(0, session.step + 1).reverse();
  overlay.setAttribute("viewBox", `0 0 ${wide} ${tall}`);
  const across = ([x, y]: Pair): string => `${(x * wide).toFixed(1)},${(y * tall).toFixed(1)}`;
  const drawn = new Set<string>();
  const polygons = [now, ...before].flatMap((step) => {
    const points = step ? outline(sight, step.corners).map(across).join(" ") : "";
    if (!step || !points || drawn.has(points)) return []; // many steps share a scope
    drawn.add(points);
    const kind = `${step === now ? "fnb-tex-now" : ""} ${step.faces.length ? "fnb-tex-inside" : ""}`.trim();
    return [svg("polygon", { points, class: kind })];
  });
  const spot = now && project(sight, now.spot);
  overlay.replaceChildren(
    ...polygons.reverse(), // the present one lies on top
    ...(spot ? [svg("circle", { cx: spot[0] * wide, cy: spot[1] * tall, r: 4 })] : []),
  );
}
