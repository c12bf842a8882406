import { h, mark, setText } from "../shared/dom.ts";
import { button, nameField } from "../shared/fields.ts";
import { icon } from "../shared/icons.ts";
import type { MakePart } from "./common.ts";

/** Undo, redo, open, save, gallery, and the design's name. */
export const toolbar: MakePart = ({ store, notify }) => {
  const undo = button("Undo (Ctrl+Z)", "undo", () => store.ask({ op: "undo" }));
  const redo = button("Redo (Ctrl+Shift+Z)", "redo", () => store.ask({ op: "redo" }));

  const file = h("input", {
    type: "file",
    accept: ".json,application/json",
    hidden: true,
    "aria-label": "Design to open",
  });
  file.addEventListener("change", async () => {
    const chosen = file.files?.[0];
    file.value = "";
    if (chosen) store.ask({ op: "open", name: chosen.name, text: await chosen.text() });
  });
  const open = textButton("Open", "Open a design from a JSON file", "open", () => file.click());
  const save = textButton("Save", "Save the design as a JSON file", "save", () => {
    const drafts = store.get("drafts").length;
    if (drafts)
      notify(`Saved without ${drafts === 1 ? "the field that is" : `the ${drafts} fields that are`} at fault.`);
    store.ask({ op: "save" });
  });

  const gallery = h("select", { class: "fnb-select fnb-gallery", "aria-label": "Open a design of the gallery" });
  gallery.addEventListener("change", () => {
    if (gallery.value) store.ask({ op: "gallery", name: gallery.value });
    gallery.value = "";
  });
  const name = nameField({
    label: "Name of the design",
    value: () => store.get("design").name,
    commit: (to) => store.set(["name"], to),
  });
  name.el.classList.add("fnb-design-name");

  store.watch(["gallery"], () =>
    gallery.replaceChildren(
      h("option", { value: "" }, "Gallery…"),
      ...store.get("gallery").map((item) => h("option", { value: item }, item.replaceAll("-", " "))),
    ),
  );
  store.watch(["status", "design"], () => {
    undo.disabled = !store.get("status").canUndo;
    redo.disabled = !store.get("status").canRedo;
    name.update();
  });
  return h(
    "div",
    { class: "fnb-toolbar", role: "toolbar", "aria-label": "Design" },
    undo,
    redo,
    h("span", { class: "fnb-divider" }),
    open,
    save,
    file,
    gallery,
    name.el,
  );
};

function textButton(text: string, label: string, name: "open" | "save", action: () => void): HTMLButtonElement {
  const element = h("button", { type: "button", class: "fnb-button fnb-wide", title: label }, icon(name));
  const caption = h("span", {});
  setText(caption, text);
  mark(element, "aria-label", label);
  element.append(caption);
  element.addEventListener("click", action);
  return element;
}
