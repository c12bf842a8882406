import { h, mark, setText } from "../shared/dom.ts";
import { button, nameField } from "../shared/fields.ts";
import { type IconName, icon } from "../shared/icons.ts";
import type { MakePart } from "./common.ts";
import { download, fileName } from "./files.ts";
import { gallery } from "./gallery.ts";
import { menu, popover } from "./popover.ts";

/** Undo, redo, open, save, export, gallery, snapshots, and the design's name. */
export const toolbar: MakePart = (context) => {
  const { store, notify, signal } = context;
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
    if (store.live) store.ask({ op: "save" });
    else {
      // Without a kernel: the page has the design as it was last.
      download(`${fileName(store.get("design").name)}.json`, store.get("document"));
      if (store.waits) notify("Saved as the kernel had it last: what was typed since then is not part of it.");
    }
  });
  mark(save, "data-local", true);

  const pictures = gallery(context, () => collection.open(false));
  const collection = popover("Open a design of the gallery", "pictures", pictures.el, signal, {
    text: "Gallery",
    opened: () => pictures.show(),
  });
  const formats = h("div", {});
  const exports = popover("Export", "export", formats, signal, { text: "Export" });
  store.watch(["menus"], () =>
    formats.replaceChildren(
      menu(
        [
          ...(store.get("menus").exports ?? []).map(({ key, title }) => ({
            label: title,
            key,
            action: () => {
              if (key === "png") notify("The picture is being drawn; it is saved when it is ready.");
              store.ask({ op: "export", key });
            },
          })),
          { label: "Copy Python", key: "copy-python", action: () => store.ask({ op: "python" }) },
        ],
        () => exports.open(false),
      ),
    ),
  );
  const snapshot = button("Take a snapshot, to compare with later", "photo", () => store.ask({ op: "snapshot" }));
  const name = nameField({
    label: "Name of the design",
    value: () => store.get("design").name,
    commit: (to) => store.set(["name"], to),
  });
  name.el.classList.add("fnb-design-name");

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
    exports.el,
    collection.el,
    snapshot,
    name.el,
  );
};

function textButton(text: string, label: string, name: IconName, action: () => void): HTMLButtonElement {
  const element = h("button", { type: "button", class: "fnb-button fnb-wide", title: label }, icon(name));
  const caption = h("span", {});
  setText(caption, text);
  mark(element, "aria-label", label);
  element.append(caption);
  element.addEventListener("click", action);
  return element;
}
