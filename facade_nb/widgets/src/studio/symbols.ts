import { h, keyed, mark, type Row, setText } from "../shared/dom.ts";
import { button, faultBox, formatNumber, numberField, toggleField } from "../shared/fields.ts";
import { AXES, type SymbolState } from "../shared/types.ts";
import { type Context, emptyNote, focusAdded, type MakePart, markPicked, renamed, tint } from "./common.ts";

const QUALIFIERS = {
  opaque: "Hides what is behind it, and may stand where nothing is",
  attached: "Nothing is put between it and its neighbour",
  unoccludable: "Nothing may cover it",
  transparent: "Draws nothing and may be cut",
} as const;
type Qualifier = keyof typeof QUALIFIERS;

const PLACEMENTS = ["center", "left", "right"] as const;

/** Symbols up to which each shows all its qualifiers; of more, those that hold, and all of the picked ones. */
const MANY = 16;

/** The table of symbols. */
export const symbols: MakePart = (context) => {
  const { store } = context;
  const body = h("div", { class: "fnb-rows fnb-list", role: "rowgroup" });
  const head = h(
    "div",
    { class: "fnb-symbol fnb-head", role: "row" },
    ...["Symbol", "Size", "Solved", "Min", "Max"].map((text) => h("span", { role: "columnheader" }, text)),
  );
  const table = h("div", { class: "fnb-symbols", role: "table", "aria-label": "Symbols" }, head, body);
  const empty = emptyNote("No symbols yet. They appear here when a pattern names them.");
  const show = keyed<SymbolState>(
    body,
    (symbol) => symbol.name,
    (symbol) => symbolRow(context, symbol),
  );
  const sweep = h("button", { type: "button", class: "fnb-fix fnb-sweep", hidden: true });
  sweep.addEventListener("click", () => store.ask({ op: "sweep" }));
  const added = focusAdded(store, "symbol", body);
  store.watch(["design", "drafts", "selection", "status"], () => {
    const all = store.get("design").symbols;
    const unused = all.filter((symbol) => !symbol.used);
    sweep.hidden = unused.length === 0;
    setText(sweep, unused.length === 1 ? "Remove the unused symbol" : `Remove ${unused.length} unused symbols`);
    mark(sweep, "title", unused.map((symbol) => symbol.name).join(", "));
    empty.hidden = all.length > 0;
    table.hidden = all.length === 0;
    mark(table, "data-many", all.length > MANY);
    show(all);
    added();
  });
  return h("div", {}, table, sweep, empty);
};

function symbolRow({ store }: Context, first: SymbolState): Row<SymbolState> {
  let symbol = first;
  const name = first.name;
  const at = (key: string) => ["symbols", name, key];
  const dot = h("span", { class: "fnb-tint" });
  const title = h(
    "button",
    {
      type: "button",
      class: "fnb-letter",
      "aria-label": `Pick symbol ${name}`,
      title: "Click: show where it stands. Double-click or F2: rename it",
    },
    dot,
    name,
  );
  const label = renamed(title, {
    label: `Name of symbol ${name}`,
    value: () => symbol.name,
    commit: (to) => store.ask({ op: "rename", kind: "symbol", name, to }),
  });
  const fresh = h("span", { class: "fnb-fresh", title: "It came by itself as you typed" }, "new");
  const unused = h("span", { class: "fnb-unused", title: "No pattern writes it" }, "unused");
  title.addEventListener("click", () => {
    store.ask({ op: "toggle", [symbol.axes === "y" ? "y" : "x"]: name });
  });
  const size = (key: "size" | "min" | "max", label: string, placeholder: string) =>
    numberField(store, {
      label: `${label} of ${name} in metres`,
      path: at(key),
      value: () => formatNumber(symbol[key]),
      placeholder,
      step: 0.1,
      min: 0.1,
      start: () => symbol.solved.x ?? symbol.solved.y ?? symbol.size ?? 1,
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
      word: key,
      value: () => symbol[key],
    }),
  );
  // Most are, so of many symbols only those that are not say so, by where they are placed.
  mark(toggles[0]?.el as HTMLElement, "data-usual", true);
  const placement = h("button", { type: "button", class: "fnb-word fnb-placement" });
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
  for (const field of fields.slice(0, 1)) mark(field.el, "data-main", true);
  const qualifiers = cell(...toggles.map((toggle) => toggle.el), placement, unused, remove);
  qualifiers.className = "fnb-qualifiers";
  const el = h(
    "div",
    { class: "fnb-symbol", role: "row", "data-symbol": name },
    h("span", { role: "cell", class: "fnb-symbol-name" }, label.el, fresh),
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
      for (const field of [...fields, ...toggles, label, faults]) field.update();
      dot.style.background = tint(store, name);
      fresh.hidden = !symbol.fresh;
      unused.hidden = symbol.used;
      mark(el, "data-unused", !symbol.used);
      showSolved(solved, symbol);
      setText(placement, symbol.placement);
      mark(placement, "aria-label", `Placement of ${name}: ${symbol.placement}`);
      mark(
        placement,
        "title",
        symbol.opaque
          ? "Where it is placed in a wider column: for symbols that are not opaque"
          : "Where it is placed in a wider column",
      );
      placement.disabled = symbol.opaque || symbol.transparent;
      remove.disabled = symbol.used;
      remove.hidden = symbol.used;
      const { x, y } = store.get("selection");
      markPicked(el, x === name || y === name);
      mark(el, "data-blamed", store.get("status").blame.symbols.includes(name));
    },
  };
}

/** The size that it has, on each axis apart, and by how much it is not the preferred one. */
function showSolved(el: HTMLElement, { solved, size, name }: SymbolState): void {
  const axes = AXES.filter((axis) => solved[axis] !== undefined);
  const parts = axes.map((axis) => {
    const value = solved[axis] ?? 0;
    const off = size === null ? 0 : value - size;
    const sign = off > 0 ? "+" : "−";
    const deviation = Math.abs(off) < 0.005 ? "" : ` ${sign}${Math.abs(off).toFixed(2)}`;
    return { axis, value: formatNumber(value, 2), deviation };
  });
  const key = JSON.stringify(parts);
  if (el.dataset.key === key) return;
  el.dataset.key = key;
  el.replaceChildren(
    ...parts.map(({ axis, value, deviation }) =>
      h(
        "span",
        { title: `${name} is ${value} m ${axis === "x" ? "wide" : "high"}` },
        axes.length > 1 && h("i", {}, `${axis} `),
        value,
        deviation && h("span", { class: "fnb-deviation" }, deviation),
      ),
    ),
  );
}
