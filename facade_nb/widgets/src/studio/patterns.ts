import { h, keyed, mark, type Row } from "../shared/dom.ts";
import { button, codeField, faultBox, nameField } from "../shared/fields.ts";
import type { PatternState } from "../shared/types.ts";
import { type Context, emptyNote, focusAdded, type MakePart, markPicked } from "./common.ts";

/** The patterns' texts. */
export const patterns: MakePart = (context) => {
  const { store } = context;
  const list = h("div", { class: "fnb-patterns", role: "list" });
  const empty = emptyNote("No patterns yet. A pattern is a row of symbols, such as A(BA)^k.");
  const show = keyed<PatternState>(
    list,
    (pattern) => pattern.name,
    (pattern) => patternRow(context, pattern),
  );
  const added = focusAdded(store, "pattern", list);
  store.watch(["design", "drafts", "selection", "status"], () => {
    const all = store.get("design").patterns;
    empty.hidden = all.length > 0;
    show(all);
    added();
  });
  return h("div", {}, list, empty);
};

function patternRow({ store }: Context, first: PatternState): Row<PatternState> {
  let pattern = first;
  const name = first.name;
  const path = ["patterns", name, "text"];
  const title = nameField({
    label: `Name of pattern ${name}`,
    value: () => pattern.name,
    commit: (to) => store.ask({ op: "rename", kind: "pattern", name, to }),
    next: () => text.input,
  });
  // The empty word is an empty field; written out, it stays as it is written.
  const value = () =>
    pattern.text !== "ε" ? pattern.text : /^\s*ε?\s*$/.test(text.input.value) ? text.input.value : "";
  const text = codeField(store, { label: `Pattern ${name}`, path, value, placeholder: "type, such as A(BA)^k" });
  mark(text.input, "data-main", true);
  const faults = faultBox(store, () => [path], text.input);
  const remove = button(`Remove pattern ${name}`, "close", () => store.ask({ op: "remove", kind: "pattern", name }), {
    class: "fnb-button fnb-remove",
  });
  const el = h(
    "div",
    { class: "fnb-pattern", role: "listitem", "data-pattern": name },
    title.el,
    text.el,
    remove,
    faults.el,
  );
  return {
    el,
    update(item) {
      pattern = item;
      title.update();
      text.update();
      faults.update();
      remove.disabled = pattern.axes !== "";
      const { layer } = store.get("selection");
      const picked = store.get("design").layers.find((other) => other.name === layer);
      markPicked(el, !!picked && (picked.x.pattern === name || picked.y.pattern === name));
      mark(el, "data-blamed", store.get("status").blame.patterns.includes(name));
    },
  };
}
