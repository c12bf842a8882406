import { h, keyed, setText } from "../shared/dom.ts";
import { button, choiceField, faultBox, formatNumber, numberField } from "../shared/fields.ts";
import type { Cell } from "../shared/types.ts";
import type { MakePart } from "./common.ts";

/** What is picked, in one line under the façade; the looks of the cell can be changed there, for its layer. */
export const inspector: MakePart = ({ store }) => {
  const slot = h("div", { class: "fnb-inspector-slot" });
  const show = keyed<string>(
    slot,
    (key) => key,
    () => line(),
  );
  const line = () => {
    const { layer, x, y } = store.get("selection");
    const key = `${x} ${y}`;
    const path = (attribute: string) => ["layers", layer, "shapes", key, attribute];
    const cell = () => store.get("selection").cell;
    const choice = (attribute: "geometry" | "material") =>
      choiceField(store, {
        label: `${attribute} of ${key} in ${layer}`,
        path: path(attribute),
        value: () => cell()?.[attribute] ?? "",
        choices: () =>
          attribute === "geometry" ? store.get("catalogue").geometries : store.get("catalogue").materials,
      });
    const number = (attribute: "offset" | "thickness") =>
      numberField(store, {
        label: `${attribute} of ${key} in ${layer} in metres`,
        path: path(attribute),
        value: () => formatNumber(cell()?.[attribute]),
        step: 0.05,
        min: attribute === "offset" ? -9 : 0.05,
      });
    const fields = [choice("geometry"), choice("material"), number("offset"), number("thickness")];
    const names = ["geometry", "material", "offset", "thickness"];
    const faults = faultBox(store, () => names.map(path));
    const size = h("span", { class: "fnb-inspector-size" });
    const el = h(
      "div",
      { class: "fnb-inspector", role: "group", "aria-label": `Shape ${key} of layer ${layer}` },
      h("span", { class: "fnb-inspector-title" }, h("b", {}, layer), h("code", {}, x), "×", h("code", {}, y)),
      size,
      ...fields.map((field, i) => h("label", {}, names[i] ?? "", field.el)),
      button("Clear the selection (Esc)", "close", () => store.ask({ op: "select" })),
      faults.el,
    );
    return {
      el,
      update() {
        for (const field of fields) field.update();
        faults.update();
        setText(size, sizeText(cell()));
      },
    };
  };
  store.watch(["selection", "drafts", "catalogue"], () => {
    const { layer, x, y, shape } = store.get("selection");
    show(shape === null ? [] : [JSON.stringify([layer, x, y])]);
  });
  return slot;
};

function sizeText(cell: Cell | null): string {
  if (!cell) return "";
  const [left, bottom, right, top] = cell.rect;
  return `${formatNumber(right - left, 2)} × ${formatNumber(top - bottom, 2)} m`;
}
