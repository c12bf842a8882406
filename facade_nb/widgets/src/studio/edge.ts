import { h, mark, setText } from "../shared/dom.ts";
import type { Drawing } from "../shared/drawing.ts";
import { formatNumber } from "../shared/fields.ts";
import { stepped } from "../shared/stepping.ts";
import type { Context } from "./common.ts";

const STEP = 0.05;
const LEAST = 0.1;

export interface Edge {
  el: HTMLElement;
  place(drawing: Drawing, scale: number): void;
}

/** The façade's right or top edge: dragging it, or arrow keys on it, resize the canvas while the façade follows. */
export function edge(
  { store, signal }: Context,
  side: "width" | "height",
  drag: { hold: () => number; release: () => void },
): Edge {
  const path = ["canvas", side];
  const measure = h("span", { class: "fnb-measure" });
  const el = h(
    "div",
    {
      class: `fnb-edge fnb-edge-${side}`,
      tabindex: 0,
      role: "slider",
      "aria-label": `Canvas ${side}: drag, or use the arrow keys`,
      "aria-orientation": side === "width" ? "horizontal" : "vertical",
      "aria-valuemin": LEAST,
    },
    h("span", { class: "fnb-edge-grip" }),
    measure,
  );
  /** What was asked for last, until Python has answered it. */
  let asked: number | null = null;
  const size = () => (store.pending(path) && asked !== null ? asked : store.get("design").canvas[side]);
  const ask = (value: number) => {
    asked = Math.max(LEAST, Number(value.toFixed(9)));
    tell(asked);
    store.set(path, asked);
  };
  const tell = (value: number) => {
    mark(el, "aria-valuenow", formatNumber(value));
    mark(el, "aria-valuetext", `${formatNumber(value)} metres`);
    setText(measure, `${formatNumber(value, 2)} m`);
  };
  store.watch(["design"], () => {
    if (!store.pending(path)) tell(store.get("design").canvas[side]);
  });

  el.addEventListener(
    "pointerdown",
    (down) => {
      if (down.button !== 0) return;
      down.preventDefault();
      el.focus({ preventScroll: true });
      el.setPointerCapture(down.pointerId);
      const from = size();
      const metre = drag.hold();
      mark(el, "data-dragged", true);
      const move = (event: PointerEvent) => {
        const pixels = side === "width" ? event.clientX - down.clientX : down.clientY - event.clientY;
        ask(Math.round((from + pixels / metre) / STEP) * STEP);
      };
      el.addEventListener("pointermove", move, { signal });
      el.addEventListener(
        "lostpointercapture",
        () => {
          el.removeEventListener("pointermove", move);
          mark(el, "data-dragged", false);
          drag.release();
        },
        { once: true, signal },
      );
    },
    { signal },
  );
  el.addEventListener(
    "keydown",
    (event) => {
      const [more, less] = side === "width" ? ["ArrowRight", "ArrowLeft"] : ["ArrowUp", "ArrowDown"];
      if (event.key !== more && event.key !== less) return;
      event.preventDefault();
      event.stopPropagation();
      ask(stepped(size(), (event.key === more ? 1 : -1) * (event.shiftKey ? 10 : 1), { step: 0.1, min: LEAST }));
    },
    { signal },
  );
  return {
    el,
    place(drawing, scale) {
      const solved = store.get("status").solved;
      const [width, height] = [solved?.width ?? 0, solved?.height ?? 0];
      const metre = drawing.scale * scale;
      const [left, bottom] = [drawing.origin.x * scale, drawing.origin.y * scale];
      if (side === "width") {
        el.style.left = `${left + width * metre}px`;
        el.style.top = `${bottom - height * metre}px`;
        el.style.height = `${height * metre}px`;
      } else {
        el.style.left = `${left}px`;
        el.style.top = `${bottom - height * metre}px`;
        el.style.width = `${width * metre}px`;
      }
    },
  };
}
