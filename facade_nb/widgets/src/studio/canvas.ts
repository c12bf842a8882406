import { h } from "../shared/dom.ts";
import { faultBox, formatNumber, numberField } from "../shared/fields.ts";
import type { MakePart } from "./common.ts";

/** Width and height of the canvas. */
export const canvas: MakePart = ({ store }) => {
  const sides = (["width", "height"] as const).map((side) =>
    numberField(store, {
      label: `Canvas ${side} in metres`,
      path: ["canvas", side],
      value: () => formatNumber(store.get("design").canvas[side]),
      step: 0.1,
      min: 0.1,
    }),
  );
  const faults = faultBox(store, () => [
    ["canvas", "width"],
    ["canvas", "height"],
  ]);
  const [width, height] = sides.map((side) => side.el);
  const el = h(
    "div",
    { class: "fnb-canvas" },
    h("label", {}, "Width", width, h("span", { class: "fnb-unit" }, "m")),
    h("label", {}, "Height", height, h("span", { class: "fnb-unit" }, "m")),
    faults.el,
  );
  store.watch(["design", "drafts"], () => {
    for (const side of sides) side.update();
    faults.update();
  });
  return el;
};
