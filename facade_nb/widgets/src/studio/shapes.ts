import { focused, h, mark, setText } from "../shared/dom.ts";
import { colourOf } from "../shared/swatches.ts";
import type { Pairs } from "../shared/types.ts";
import { emptyNote, type MakePart, swatchesOf, tint } from "./common.ts";

/** The table of pairs of the picked layer: what each pair of its symbols looks like, and by which key. */
export const shapes: MakePart = ({ store }) => {
  const layer = h("select", { class: "fnb-select fnb-pairs-layer", "aria-label": "Layer whose pairs are shown" });
  const hint = h("span", { class: "fnb-pairs-hint" }, "Click a pair to edit it; Shift adds more");
  const head = h("div", { class: "fnb-pairs-head" }, layer, hint);
  const table = h("div", { class: "fnb-pairs", role: "grid", "aria-label": "Pairs of symbols" });
  const empty = emptyNote("Pick a layer, or a shape of it, to see what each pair of its symbols looks like.");
  const none = emptyNote("This layer has no letters yet, or too many pairs to show.");
  layer.addEventListener("change", () => store.ask({ op: "select", layer: layer.value }));

  let shown = "";
  let cells = new Map<string, HTMLButtonElement>();
  const build = (pairs: Pairs) => {
    const kept = focused(table)?.getAttribute("data-pair") ?? null;
    cells = new Map();
    const header = (symbol: string, role: string) => {
      const el = h("span", { role, class: "fnb-pairs-letter" }, symbol);
      el.style.setProperty("--fnb-tint", tint(store, symbol));
      return el;
    };
    table.style.setProperty("--fnb-columns", String(pairs.columns.length));
    const swatches = swatchesOf(store);
    // The first letter of a vertical pattern is at the bottom.
    const rows = pairs.rows.map((y, j) => ({ y, j })).reverse();
    table.replaceChildren(
      h("span", { class: "fnb-pairs-corner" }),
      ...pairs.columns.map((x) => header(x, "columnheader")),
      ...rows.flatMap(({ y, j }) => [
        header(y, "rowheader"),
        ...pairs.columns.map((x, i) => {
          const cell = pairs.cells[j * pairs.columns.length + i];
          const button = h(
            "button",
            {
              type: "button",
              class: "fnb-pair-cell",
              "data-pair": `${x} ${y}`,
              "data-shown": cell?.shown ?? false,
              "data-own": cell?.level === "layer",
              "aria-label": `Pair ${x} ${y} of ${pairs.layer}`,
              title: `${x} ${y}: ${cell?.geometry} of ${cell?.material}, ${whence(pairs, cell?.level ?? "", cell?.key ?? "")}${cell?.shown ? "" : "; draws nothing"}`,
            },
            h("span", { class: "fnb-pair-key" }, cell?.key || "–"),
          );
          button.style.setProperty("--fnb-swatch", colourOf(cell?.material ?? "", swatches));
          button.addEventListener("click", (event) => {
            const add = event.shiftKey || event.ctrlKey || event.metaKey;
            store.ask({ ...(add ? { op: "toggle", add } : { op: "select" }), layer: pairs.layer, x, y });
          });
          cells.set(`${x} ${y}`, button);
          return button;
        }),
      ]),
    );
    if (kept !== null) cells.get(kept)?.focus({ preventScroll: true });
  };
  table.addEventListener("keydown", (event) => {
    const all = [...cells.values()];
    const at = all.indexOf(event.target as HTMLButtonElement);
    const wide = store.get("selection").pairs?.columns.length ?? 1;
    const step = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -wide, ArrowDown: wide }[event.key];
    if (at < 0 || step === undefined) return;
    event.preventDefault();
    all[at + step]?.focus();
  });

  store.watch(["selection", "design", "catalogue"], () => {
    const { pairs, layer: picked, x, y, more } = store.get("selection");
    const names = store.get("design").layers.map((other) => other.name);
    head.hidden = names.length === 0;
    const choices = JSON.stringify(names);
    if (layer.dataset.key !== choices) {
      layer.dataset.key = choices;
      layer.replaceChildren(
        h("option", { value: "", disabled: true }, "choose a layer…"),
        ...names.map((name) => h("option", { value: name }, name)),
      );
    }
    layer.value = names.includes(picked) ? picked : "";
    empty.hidden = pairs !== null;
    table.hidden = !pairs || pairs.cells.length === 0;
    none.hidden = !pairs || pairs.cells.length > 0;
    const key = JSON.stringify([pairs, store.get("design").symbols.map((symbol) => symbol.name)]);
    if (key !== shown) {
      shown = key;
      if (pairs) build(pairs);
    }
    const all = [[x, y], ...more].map((pair) => pair.join(" "));
    for (const [pair, cell] of cells) mark(cell, "aria-pressed", String(all.includes(pair)));
    setText(hint, more.length ? `${all.length} pairs picked` : "Click a pair to edit it; Shift adds more");
  });
  return h("div", { class: "fnb-shapes" }, head, table, none, empty);
};

/** Who says so, in words. */
function whence(pairs: Pairs, level: string, key: string): string {
  if (level === "") return "as nothing says otherwise";
  const owner = level === "layer" ? `layer ${pairs.layer}` : level === "design" ? "the design" : `the ${level} pattern`;
  return `by ${key} of ${owner}`;
}
