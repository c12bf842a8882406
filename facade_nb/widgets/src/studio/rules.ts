import { h, mark } from "../shared/dom.ts";
import { codeField, faultLine } from "../shared/fields.ts";
import type { MakePart } from "./common.ts";

const EXAMPLE = "Stripes -> RepeatX(0.4, Stripe)";

/** The design's texture grammar, whose rules are materials. */
export const rules: MakePart = ({ store }) => {
  const field = codeField(store, {
    label: "Rules of materials",
    path: ["grammar"],
    value: () => store.get("design").grammar ?? "",
    className: "fnb-rules-text",
    placeholder: EXAMPLE,
  });
  const faults = h("div", { class: "fnb-faults", role: "alert", hidden: true });
  const hint = h("p", { class: "fnb-empty" });
  let told = "";
  store.watch(["design", "drafts"], () => {
    field.update();
    const { grammarFaults = [], rules = {} } = store.get("design");
    const state = JSON.stringify(grammarFaults);
    if (state !== told) {
      told = state;
      faults.replaceChildren(...grammarFaults.map((fault) => faultLine(fault)));
    }
    faults.hidden = grammarFaults.length === 0;
    mark(field.el, "aria-invalid", grammarFaults.length ? "true" : null);
    hint.hidden = !faults.hidden;
    const names = Object.keys(rules);
    hint.textContent = names.length
      ? `Materials now: ${names.join(", ")}.`
      : "A texture grammar. Each of its rules is a material of shapes, such as rule:Stripes.";
  });
  return h("div", { class: "fnb-rules" }, field.el, faults, hint);
};
