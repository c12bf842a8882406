import { h, mark } from "../shared/dom.ts";
import { draftOf, type Field, holdBack } from "../shared/fields.ts";
import type { Store } from "../shared/store.ts";
import type { Path } from "../shared/types.ts";
import { groupTint } from "./common.ts";

const NEW = "\u0000new";
const RENAME = "\u0000rename";

/** An alignment group as a coloured chip, chosen from a list in which a new one can be made and this one renamed. */
export function groupField(store: Store, options: { label: string; path: Path; value: () => string }): Field {
  const select = h("select", {
    class: "fnb-group",
    "aria-label": options.label,
    title: "Alignment group: only patterns of one group are aligned",
  });
  const input = h("input", {
    type: "text",
    class: "fnb-group-name",
    "aria-label": `Name for ${options.label.charAt(0).toLowerCase()}${options.label.slice(1)}`,
    placeholder: "name",
    hidden: true,
    spellcheck: "false",
    autocomplete: "off",
  });
  let renaming = false;
  const write = (rename: boolean) => {
    renaming = rename;
    input.value = rename ? options.value() : "";
    select.hidden = true;
    input.hidden = false;
    input.focus();
    input.select();
  };
  const end = (refocus: boolean) => {
    if (input.hidden) return;
    select.hidden = false;
    if (refocus) select.focus();
    input.hidden = true;
    update();
  };
  const commit = () => {
    const name = input.value.trim();
    if (!name || input.readOnly || name === options.value()) return;
    input.value = ""; // once: leaving the field commits, too
    if (renaming) store.ask({ op: "rename", kind: "group", name: options.value(), to: name });
    else store.set(options.path, name);
  };
  select.addEventListener("change", () => {
    if (select.value === NEW || select.value === RENAME) write(select.value === RENAME);
    else store.set(options.path, select.value);
  });
  select.addEventListener("keydown", (event) => {
    if (event.key !== "F2") return;
    event.preventDefault();
    write(true);
  });
  select.addEventListener("dblclick", () => write(true));
  holdBack(input, () => (renaming ? options.value() : ""));
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") {
      event.preventDefault(); // the list that gets the focus is not to be opened
      commit();
      end(true);
    }
    if (event.key !== "Escape") return;
    event.preventDefault();
    event.stopPropagation();
    input.value = "";
    end(true);
  });
  input.addEventListener("blur", () => {
    commit();
    end(false);
  });
  let shown = "";
  const update = () => {
    const value = String(draftOf(store, options.path)?.value ?? options.value());
    const groups = store.get("design").groups;
    const all = groups.includes(value) ? groups : [value, ...groups];
    const key = JSON.stringify([all, value]);
    if (key !== shown) {
      shown = key;
      select.replaceChildren(
        ...all.map((name) => h("option", { value: name }, name)),
        h("option", { value: NEW }, "new group…"),
        h("option", { value: RENAME }, `rename ${value}…`),
      );
    }
    if (!store.pending(options.path)) select.value = value;
    mark(select, "data-default", value === "default");
    select.style.setProperty("--fnb-tint", groupTint(store, value));
  };
  return { el: h("span", { class: "fnb-group-field" }, select, input), update };
}
