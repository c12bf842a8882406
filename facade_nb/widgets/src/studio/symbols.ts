import { h, keyed, mark, type Row, setText } from "../shared/dom.ts";
import { button, faultBox, formatNumber, numberField, toggleField } from "../shared/fields.ts";
import { icon, setIcon } from "../shared/icons.ts";
import type { SymbolState } from "../shared/types.ts";
import { type Context, emptyNote, type MakePart, markPicked } from "./common.ts";

const QUALIFIERS = {
  opaque: "Opaque: hides what is behind it, and may stand where nothing is",
  attached: "Attached: nothing is put between it and its neighbour",
  unoccludable: "Unoccludable: nothing may cover it",
  transparent: "Transparent: draws nothing and may be cut",
} as const;
type Qualifier = keyof typeof QUALIFIERS;

const PLACEMENTS = ["center", "left", "right"] as const;

/** The table of symbols. */
export const symbols: MakePart = (context) => {
  const { store } = context;
  const body = h("div", { class: "fnb-rows", role: "rowgroup" });
  const head = h(
    "div",
    { class: "fnb-symbol fnb-head", role: "row" },
    ...["Symbol", "Size", "Solved", "Min", "Max", "Qualifiers"].map((text) =>
      h("span", { role: "columnheader" }, text),
    ),
  );
  const table = h("div", { class: "fnb-symbols", role: "table", "aria-label": "Symbols" }, head, body);
  const empty = emptyNote("No symbols yet. They appear here when a pattern names them.");
  const show = keyed<SymbolState>(
    body,
    (symbol) => symbol.name,
    (symbol) => symbolRow(context, symbol),
  );
  store.watch(["design", "drafts", "selection", "status"], () => {
    const all = store.get("design").symbols;
    empty.hidden = all.length > 0;
    table.hidden = all.length === 0;
    show(all);
  });
  return h("div", {}, table, empty);
};

function symbolRow({ store }: Context, first: SymbolState): Row<SymbolState> {
  let symbol = first;
  const name = first.name;
  const at = (key: string) => ["symbols", name, key];
  const title = h(
    "button",
    { type: "button", class: "fnb-letter", "aria-label": `Pick symbol ${name}`, title: "Show where it stands" },
    name,
  );
  title.addEventListener("click", () => {
    const { x, y } = store.get("selection");
    const axis = symbol.axes === "y" ? "y" : "x";
    store.ask({ op: "select", ...((axis === "x" ? x : y) === name ? {} : { [axis]: name }) });
  });
  const size = (key: "size" | "min" | "max", label: string, placeholder: string) =>
    numberField(store, {
      label: `${label} of ${name} in metres`,
      path: at(key),
      value: () => formatNumber(symbol[key]),
      placeholder,
      step: 0.1,
      min: 0.1,
      start: () => symbol.solved[0] ?? symbol.size ?? 1,
    });
  const fields = [
    size("size", "Preferred size", "free"),
    size("min", "Least size", "–"),
    size("max", "Greatest size", "–"),
  ];
  const toggles = (Object.keys(QUALIFIERS) as Qualifier[]).map((key) =>
    toggleField(store, {
      label: `${name} is ${key}`,
      title: QUALIFIERS[key],
      path: at(key),
      icon: key,
      value: () => symbol[key],
    }),
  );
  const placement = h("button", { type: "button", class: "fnb-toggle fnb-placement" }, icon("center"));
  placement.addEventListener("click", () => {
    const next = PLACEMENTS[(PLACEMENTS.indexOf(symbol.placement) + 1) % PLACEMENTS.length] ?? "center";
    store.set(at("placement"), next);
  });
  const solved = h("span", { class: "fnb-solved", role: "cell" });
  const faults = faultBox(store, () =>
    ["size", "min", "max", "opaque", "attached", "unoccludable", "transparent"].map(at),
  );
  const remove = button(`Remove symbol ${name}`, "close", () => store.ask({ op: "remove", kind: "symbol", name }), {
    class: "fnb-button fnb-remove",
  });
  const cell = (...children: HTMLElement[]) => h("span", { role: "cell" }, ...children);
  const [preferred, least, greatest] = fields.map((field) => cell(field.el));
  const qualifiers = cell(...toggles.map((toggle) => toggle.el), placement, remove);
  qualifiers.className = "fnb-qualifiers";
  const el = h(
    "div",
    { class: "fnb-symbol", role: "row", "data-symbol": name },
    h("span", { role: "cell", class: "fnb-symbol-name" }, title),
    preferred,
    solved,
    least,
    greatest,
    qualifiers,
    faults.el,
  );
  return {
    el,
    update(item) {
      symbol = item;
      for (const field of [...fields, ...toggles, faults]) field.update();
      setText(solved, symbol.solved.map((value) => formatNumber(value, 2)).join(" / "));
      setIcon(placement, symbol.placement);
      const label = `Placement of ${name}: ${symbol.placement}`;
      mark(placement, "aria-label", label);
      mark(placement, "title", symbol.opaque ? "Placement is for symbols that are not opaque" : label);
      placement.disabled = symbol.opaque || symbol.transparent;
      remove.disabled = symbol.axes !== "";
      remove.hidden = symbol.axes !== "";
      const { x, y } = store.get("selection");
      markPicked(el, x === name || y === name);
      mark(el, "data-blamed", store.get("status").blame.symbols.includes(name));
    },
  };
}
