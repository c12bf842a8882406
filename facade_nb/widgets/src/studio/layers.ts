import { h, keyed, mark, type Row, setText } from "../shared/dom.ts";
import { button, choiceField, type Field, faultBox, nameField } from "../shared/fields.ts";
import { icon, setIcon } from "../shared/icons.ts";
import { AXES, type Axis, type LayerState } from "../shared/types.ts";
import { type Context, emptyNote, focusAdded, type MakePart, markPicked, tint } from "./common.ts";
import { groupField } from "./groups.ts";

/** Layers up to which all are shown with their patterns and masks; of more, those that are picked or edited. */
const MANY = 8;

/** The stack, topmost layer first. */
export const layers: MakePart = (context) => {
  const { store } = context;
  const list = h("div", { class: "fnb-layers fnb-list", role: "list", "aria-label": "Layers, topmost first" });
  const empty = emptyNote(
    "No layers yet. A layer has a pattern for each direction; a new one makes them where there are none.",
  );
  const show = keyed<LayerState>(
    list,
    (layer) => layer.name,
    (layer) => layerRow(context, list, layer),
  );
  const added = focusAdded(store, "layer", list);
  store.watch(["design", "drafts", "selection"], () => {
    const all = store.get("design").layers;
    empty.hidden = all.length > 0;
    mark(list, "data-many", all.length > MANY);
    show(all);
    added();
  });
  return h("div", {}, list, empty);
};

function layerRow(context: Context, list: HTMLElement, first: LayerState): Row<LayerState> {
  const { store } = context;
  let layer = first;
  const name = first.name;
  const position = () => store.get("design").layers.findIndex((other) => other.name === name);
  const move = (to: number) => {
    if (to >= 0 && to < store.get("design").layers.length && to !== position()) store.ask({ op: "move", name, to });
  };

  const grip = h(
    "button",
    {
      type: "button",
      class: "fnb-grip",
      title: "Drag to reorder; Alt+↑ and Alt+↓ do the same",
      "aria-label": `Move layer ${name}`,
    },
    icon("grip"),
  );
  const visible = h("button", { type: "button", class: "fnb-eye" }, icon("eye"));
  visible.addEventListener("click", () => store.set(["layers", name, "visible"], !layer.visible));
  const title = nameField({
    label: `Name of layer ${name}`,
    value: () => layer.name,
    commit: (to) => store.ask({ op: "rename", kind: "layer", name, to }),
  });
  const up = button(`Move layer ${name} up`, "up", () => move(position() - 1));
  const down = button(`Move layer ${name} down`, "down", () => move(position() + 1));
  const remove = button(`Remove layer ${name}`, "close", () => store.ask({ op: "remove", kind: "layer", name }));
  const solo = button(`Show layer ${name} alone, or all again`, "solo", () => store.ask({ op: "solo", name }));
  const copy = button(`Duplicate layer ${name}`, "copy", () => store.ask({ op: "duplicate", name }));
  const fresh = h(
    "span",
    { class: "fnb-fresh", title: "It draws nothing until a shape of it is chosen: click a cell in the table of pairs" },
    "no shapes yet",
  );
  const showAll = h(
    "button",
    {
      type: "button",
      class: "fnb-word",
      "aria-label": `Show all shapes of layer ${name}`,
      title: "Draw all its shapes",
    },
    "show all",
  );
  showAll.addEventListener("click", () => store.set(["layers", name, "shapes", "* *", "visible"], null));
  const unshaped = h("span", { class: "fnb-unshaped" }, fresh, showAll);
  const tools = h("span", { class: "fnb-tools" }, solo, copy, up, down, remove);
  const brief = h("span", { class: "fnb-layer-brief" });
  const sides = AXES.map((axis) => layerSide(context, axis, () => layer));
  const faults = faultBox(store, () =>
    AXES.flatMap((axis) => ["pattern", "group", "mask"].map((key) => ["layers", name, axis, key])).concat([
      ["layers", name, "visible"],
    ]),
  );
  const el = h(
    "div",
    { class: "fnb-layer", role: "listitem", "data-layer": name },
    h("div", { class: "fnb-layer-head" }, grip, visible, title.el, brief, unshaped, tools),
    ...sides.map((side) => side.el),
    faults.el,
  );

  el.addEventListener("keydown", (event) => {
    if (!event.altKey || (event.key !== "ArrowUp" && event.key !== "ArrowDown")) return;
    event.preventDefault();
    event.stopPropagation();
    move(position() + (event.key === "ArrowUp" ? -1 : 1));
  });
  el.addEventListener("click", (event) => {
    const inField = (event.target as Element).closest("button, select, input");
    if (!inField) store.ask({ op: "toggle", layer: name });
  });
  dragToReorder(grip, el, list, move, context.signal);

  return {
    el,
    update(item) {
      layer = item;
      title.update();
      for (const side of sides) side.update();
      faults.update();
      unshaped.hidden = !layer.unshaped;
      setText(brief, `${layer.x.pattern} × ${layer.y.pattern}`);
      mark(brief, "title", `${layer.x.pattern} × ${layer.y.pattern}`);
      const at = position();
      up.disabled = at === 0;
      down.disabled = at === store.get("design").layers.length - 1;
      if (!store.pending(["layers", name, "visible"])) {
        mark(el, "data-hidden", !layer.visible);
        setIcon(visible, layer.visible ? "eye" : "hidden");
        const label = layer.visible ? `Hide layer ${name}` : `Show layer ${name}`;
        mark(visible, "aria-label", label);
        mark(
          visible,
          "title",
          layer.visible ? "Visible: takes part in the layout" : "Hidden: takes no part in the layout",
        );
      }
      markPicked(el, store.get("selection").layer === name);
    },
  };
}

/** One axis of a layer: its pattern, its group, and a chip per symbol that says whether it is visible. */
function layerSide({ store }: Context, axis: Axis, layer: () => LayerState): Field {
  const name = layer().name;
  const side = () => layer()[axis];
  const direction = axis === "x" ? "horizontal" : "vertical";
  const pattern = choiceField(store, {
    label: `The ${direction} pattern of ${name}`,
    path: ["layers", name, axis, "pattern"],
    value: () => side().pattern,
    choices: () => store.get("design").patterns.map((other) => other.name),
  });
  if (axis === "x") mark(pattern.el, "data-main", true);
  const group = groupField(store, {
    label: `The ${direction} alignment group of ${name}`,
    path: ["layers", name, axis, "group"],
    value: () => side().group,
  });
  const chips = h("span", { class: "fnb-chips", role: "group", "aria-label": `The ${direction} mask of ${name}` });
  const maskPath = ["layers", name, axis, "mask"];
  let mask: string[] | null = side().mask;
  const toggle = (symbol: string) => {
    const letters = side().letters;
    const shown = letters.filter((letter) => mask === null || mask.includes(letter));
    const next = shown.includes(symbol) ? shown.filter((other) => other !== symbol) : [...shown, symbol];
    mask = next.length === letters.length ? null : letters.filter((letter) => next.includes(letter));
    store.set(maskPath, mask);
    showChips(side().letters);
  };
  const showChips = keyed<string>(
    chips,
    (symbol) => symbol,
    (symbol) => {
      const chip = h("button", { type: "button", class: "fnb-chip" }, symbol);
      chip.addEventListener("click", () => toggle(symbol));
      return {
        el: chip,
        update() {
          const on = mask === null || mask.includes(symbol);
          chip.style.setProperty("--fnb-tint", tint(store, symbol));
          mark(chip, "aria-pressed", String(on));
          mark(chip, "title", on ? `${symbol} is visible; click to mask it` : `${symbol} is masked; click to show it`);
        },
      };
    },
  );
  const only = h("select", {
    class: "fnb-only",
    "aria-label": `Only this symbol of the ${direction} pattern of ${name}`,
    title: "Show only this symbol, or all",
  });
  only.addEventListener("change", () => {
    mask = only.value === "*" ? null : [only.value];
    store.set(maskPath, mask);
    only.value = "";
    showChips(side().letters);
  });
  let offered = "";
  const showOnly = () => {
    const letters = side().letters;
    only.hidden = letters.length < 2;
    if (offered === letters.join("\n")) return;
    offered = letters.join("\n");
    const choices = letters.map((symbol) => h("option", { value: symbol }, `only ${symbol}`));
    only.replaceChildren(h("option", { value: "" }, "only…"), ...choices, h("option", { value: "*" }, "all of them"));
  };
  const el = h(
    "div",
    { class: "fnb-side" },
    h("span", { class: "fnb-axis", title: direction }, axis),
    pattern.el,
    group.el,
    h("span", { class: "fnb-mask" }, chips, only),
  );
  return {
    el,
    update() {
      pattern.update();
      group.update();
      showOnly();
      if (!store.pending(maskPath)) mask = side().mask;
      showChips(side().letters);
    },
  };
}

/** Reorder by dragging the grip: the row follows the pointer, a line shows where it will go. */
function dragToReorder(
  grip: HTMLElement,
  row: HTMLElement,
  list: HTMLElement,
  move: (to: number) => void,
  signal: AbortSignal,
): void {
  grip.addEventListener(
    "pointerdown",
    (down) => {
      if (down.button !== 0) return;
      grip.setPointerCapture(down.pointerId);
      const rows = [...list.children] as HTMLElement[];
      const middles = rows.map((other) => {
        const box = other.getBoundingClientRect();
        return box.top + box.height / 2;
      });
      const from = rows.indexOf(row);
      let to = from;
      const drag = (event: PointerEvent) => {
        row.style.transform = `translateY(${event.clientY - down.clientY}px)`;
        mark(row, "data-dragged", true);
        to = middles.filter((middle, i) => i !== from && middle < event.clientY).length;
        rows.forEach((other, i) => {
          mark(
            other,
            "data-drop",
            i !== from && to !== from && i === (to > from ? to : to) ? (to > from ? "below" : "above") : null,
          );
        });
      };
      const end = (event: Event) => {
        grip.removeEventListener("pointermove", drag);
        row.style.transform = "";
        mark(row, "data-dragged", false);
        for (const other of rows) mark(other, "data-drop", null);
        if (event.type === "pointerup" && to !== from) move(to);
      };
      grip.addEventListener("pointermove", drag, { signal });
      grip.addEventListener("lostpointercapture", end, { once: true, signal });
      grip.addEventListener("pointerup", end, { once: true, signal });
    },
    { signal },
  );
}
