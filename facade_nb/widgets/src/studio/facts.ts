// How good the layout is: J and its terms, deviation, what is proven; and what would help where it warns.

import { h } from "../shared/dom.ts";
import { formatNumber } from "../shared/fields.ts";
import type { AxisFacts } from "../shared/stage.ts";
import type { Store } from "../shared/store.ts";

const HEADS = ["Axis", "J", "Ω", "E", "Λ", "Fit", "Deviation", "Best?"];
const TITLES: Record<string, string> = {
  J: "What the solver makes least: Ω, and E, Λ and the fit, each times its price; metres",
  Ω: "How much rows differ in the columns that they share (Eq. 9 of the paper); metres",
  E: "Column that rows leave empty, as it counts in J; metres",
  Λ: "Looseness as it counts in J: letters that share an element, or do not fill their column; metres",
  Fit: "|W − canvas| as it counts in J: by how much the columns miss the canvas; metres",
  Deviation: "Root of the squared differences between solved and preferred sizes; metres",
};

const TERMS = ["empty", "loose", "fit"] as const;

/** The figures as a table, one line for each axis. */
export function factsTable(facts: AxisFacts[]): HTMLElement {
  const cell = (text: string, tag: "td" | "th" = "td", title?: string) => h(tag, { title }, text);
  return h(
    "table",
    { class: "fnb-figures" },
    h("thead", {}, h("tr", {}, ...HEADS.map((head) => cell(head, "th", TITLES[head])))),
    h(
      "tbody",
      {},
      ...facts.map((one) =>
        h(
          "tr",
          { "data-axis": one.axis },
          cell(one.axis, "th"),
          cell(metres(one.cost)),
          cell(
            metres(one.error) +
              (one.groups.length > 1 ? ` (${one.groups.map((g) => `${g.name} ${metres(g.error)}`).join(", ")})` : ""),
          ),
          ...TERMS.map((term) => {
            const [value, price] = one.terms?.[term] ?? [null, 1];
            const part = value === null ? null : value * price;
            return cell(metres(part), "td", value === null ? undefined : `${price} × ${metres(value)}`);
          }),
          cell(metres(one.deviation)),
          cell(one.proven ? "proven" : `at most ${metres(one.gap)} from it`),
        ),
      ),
    ),
  );
}

function metres(value: number | null): string {
  return value === null ? "unknown" : `${formatNumber(value, 3)} m`;
}

/** The state of the solve in full, folded: figures, and how long may be searched. */
export function details(store: Store): HTMLElement {
  const figures = h("div", { class: "fnb-facts-body" });
  const limit = h("input", {
    type: "text",
    inputmode: "decimal",
    class: "fnb-number fnb-limit",
    "aria-label": "Search for at most so many seconds",
  });
  const commit = () => {
    const now = store.get("stage").limit;
    if (limit.readOnly || limit.value.trim() === String(now)) return;
    store.ask({ op: "limit", seconds: limit.value });
  };
  limit.addEventListener("blur", commit);
  limit.addEventListener("keydown", (event) => {
    if (event.key === "Enter") commit();
  });
  const el = h(
    "details",
    { class: "fnb-details" },
    h("summary", {}, "Details"),
    figures,
    h("label", { class: "fnb-limit-row" }, "Search for at most", limit, "s"),
  );
  let shown = "";
  store.watch(["stage"], () => {
    const { facts = [], limit: seconds = 0 } = store.get("stage");
    const key = JSON.stringify(facts);
    if (key !== shown) {
      shown = key;
      figures.replaceChildren(...(facts.length ? [factsTable(facts)] : []));
    }
    if (!limit.matches(":focus")) limit.value = String(seconds);
  });
  return el;
}
