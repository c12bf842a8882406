import { h, mark, setText } from "../shared/dom.ts";
import { parseDrawing, shapeAt } from "../shared/drawing.ts";
import type { MakePart } from "./common.ts";

/** The stack drawn apart in depth, as the paper's Figure 1: click picks a shape, or a layer by its sheet. */
export const exploded: MakePart = ({ store, signal }) => {
  const note = h("p", { class: "fnb-empty fnb-stage-note" });
  const sheet = h("div", { class: "fnb-exploded-sheet" });
  const el = h(
    "div",
    { class: "fnb-paper fnb-exploded", role: "group", "aria-label": "Layers drawn apart" },
    sheet,
    note,
  );
  const ids = `fnb-x-${Math.random().toString(36).slice(2)}`;
  let shown = "";
  const show = () => {
    const text = store.get("exploded");
    note.hidden = text !== "";
    setText(note, store.get("status").busy ? "Solving…" : "Nothing to show yet.");
    if (text === shown) return;
    shown = text;
    if (!text) {
      sheet.replaceChildren();
      return;
    }
    sheet.replaceChildren(parseDrawing(text.replaceAll(store.prefix.replace(/^f/, "x"), ids)).svg);
    showPicked();
  };
  const showPicked = () => {
    const { shape, layer } = store.get("selection");
    for (const own of sheet.querySelectorAll<SVGGElement>("[data-sheet]"))
      mark(own, "data-picked", layer !== "" && own.dataset.sheet === layer);
    for (const own of sheet.querySelectorAll<SVGGElement>("[data-shape]"))
      mark(own, "data-picked", shape !== null && own.dataset.shape === String(shape));
  };
  store.watch(["exploded", "status"], show);
  store.watch(["selection"], showPicked);
  el.addEventListener("click", (event) => {
    const shape = shapeAt(event.target)?.getAttribute("data-shape");
    const layer =
      event.target instanceof Element ? event.target.closest<SVGGElement>("[data-sheet]")?.dataset.sheet : "";
    if (shape) store.ask({ op: "select", shape: Number(shape) });
    else store.ask(layer ? { op: "select", layer } : { op: "select" });
  });
  signal.addEventListener("abort", () => {
    shown = "";
  });
  return el;
};
