import { h, keyed, mark, type Row, setText } from "../shared/dom.ts";
import { button, faultBox, formatNumber, numberField } from "../shared/fields.ts";
import type { CounterState } from "../shared/types.ts";
import { type Context, emptyNote, type MakePart, renamed } from "./common.ts";

/** The table of counters. */
export const counters: MakePart = (context) => {
  const { store } = context;
  const body = h("div", { class: "fnb-rows", role: "rowgroup" });
  const head = h(
    "div",
    { class: "fnb-counter fnb-head", role: "row" },
    ...["Counter", "Min", "Max", "Fixed at", "Solved"].map((text) => h("span", { role: "columnheader" }, text)),
  );
  const table = h("div", { class: "fnb-counters", role: "table", "aria-label": "Counters" }, head, body);
  const empty = emptyNote("No counters yet. They appear here when a pattern counts with a letter, as in (BA)^k.");
  const show = keyed<CounterState>(
    body,
    (counter) => counter.name,
    (counter) => counterRow(context, counter),
  );
  store.watch(["design", "drafts", "status"], () => {
    const all = store.get("design").counters;
    empty.hidden = all.length > 0;
    table.hidden = all.length === 0;
    show(all);
  });
  return h("div", {}, table, empty);
};

function counterRow({ store }: Context, first: CounterState): Row<CounterState> {
  let counter = first;
  const name = first.name;
  const whole = (key: "min" | "max" | "value", label: string, placeholder: string) =>
    numberField(store, {
      label: `${label} of counter ${name}`,
      path: ["counters", name, key],
      value: () => formatNumber(counter[key], 0),
      placeholder,
      step: 1,
      min: key === "max" ? 0 : -99,
      whole: true,
      start: () => counter.solved ?? counter.min,
    });
  const fields = [
    whole("min", "Least value", "0"),
    whole("max", "Greatest value", "∞"),
    whole("value", "Fixed value", "free"),
  ];
  const title = h(
    "button",
    { type: "button", class: "fnb-letter", "aria-label": `Counter ${name}`, title: "Double-click or F2 to rename" },
    name,
  );
  const label = renamed(title, {
    label: `Name of counter ${name}`,
    value: () => counter.name,
    commit: (to) => store.ask({ op: "rename", kind: "counter", name, to }),
  });
  const fresh = h("span", { class: "fnb-fresh", title: "It came by itself as you typed" }, "new");
  const fix = h("button", { type: "button", class: "fnb-word" });
  fix.addEventListener("click", () =>
    store.set(["counters", name, "value"], counter.value === null ? counter.solved : null),
  );
  const solved = h("span", { class: "fnb-solved" });
  const faults = faultBox(store, () => ["min", "max", "value"].map((key) => ["counters", name, key]));
  const remove = button(
    `Remove the bounds of counter ${name}`,
    "close",
    () => store.ask({ op: "remove", kind: "counter", name }),
    { class: "fnb-button fnb-remove" },
  );
  const el = h(
    "div",
    { class: "fnb-counter", role: "row", "data-counter": name },
    h("span", { role: "cell", class: "fnb-counter-name" }, label.el, fresh),
    ...fields.map((field) => h("span", { role: "cell" }, field.el)),
    h("span", { role: "cell", class: "fnb-counter-solved" }, solved, fix),
    remove,
    faults.el,
  );
  return {
    el,
    update(item) {
      counter = item;
      for (const field of [...fields, label, faults]) field.update();
      fresh.hidden = !counter.fresh;
      setText(fix, counter.value === null ? "fix" : "free");
      mark(
        fix,
        "aria-label",
        counter.value === null ? `Fix counter ${name} at ${counter.solved}` : `Let counter ${name} go free`,
      );
      fix.disabled = counter.value === null && counter.solved === null;
      mark(el, "data-unused", !counter.used);
      setText(solved, formatNumber(counter.solved, 0));
      mark(el, "data-blamed", store.get("status").blame.counters.includes(name));
    },
  };
}
