// The grammar texture, a rule in each row, its channels with their names: the paper's Figure 3 for this grammar. What the
// pixel looked into has read is lit.

import { h, mark } from "../shared/dom.ts";
import { revealer } from "./revealing.ts";
import type { Session } from "./session.ts";

export function table(session: Session, signal: AbortSignal): HTMLElement {
  const empty = h("div", { class: "fnb-tex-none", role: "status" }, "There is no grammar without faults yet.");
  const head = h(
    "thead",
    {},
    h("tr", {}, ...["rule", "operator", "pixels"].map((name) => h("th", { scope: "col" }, name))),
  );
  const body = h("tbody", {});
  const box = h(
    "div",
    {
      class: "fnb-tex-table",
      tabindex: 0,
      role: "region",
      "aria-label": "Grammar texture",
    },
    h("table", {}, head, body),
    empty,
  );
  const reveal = revealer(box, signal, () => head.offsetHeight);
  let shown: unknown = null;
  let cells = new Map<string, HTMLElement>();
  let looked = "";
  session.hold(() => {
    const { scene } = session;
    empty.hidden = !!scene;
    if (scene && shown !== scene) {
      shown = scene;
      cells = new Map();
      body.replaceChildren(
        ...scene.table.map((rule) => {
          const pixels = rule.pixels.map(({ at, channels }) => {
            const cell = h(
              "div",
              { class: "fnb-tex-pixel" },
              h("small", {}, at.join(", ")),
              ...channels.map(([label, value]) =>
                h("span", { "data-empty": label === "" }, h("i", {}, label || "–"), label ? value : ""),
              ),
            );
            cells.set(at.join(), cell);
            return cell;
          });
          return h(
            "tr",
            {},
            h("th", { scope: "row", title: rule.name }, h("div", {}, rule.name)),
            h("td", {}, rule.operator),
            h("td", {}, h("div", { class: "fnb-tex-pixels" }, ...pixels)),
          );
        }),
      );
    }
    const read = new Set(session.steps.flatMap((step) => step.records.map((at) => at.join())));
    const now = new Set(session.steps[session.step]?.records.map((at) => at.join()) ?? []);
    const first = [...now].join(" ");
    if (first !== looked) reveal(cells.get([...now][0] ?? "")?.closest("tr"));
    if (cells.size) looked = first;
    for (const [at, cell] of cells) mark(cell, "data-lit", now.has(at) ? "now" : read.has(at) ? "read" : null);
  }, signal);
  return box;
}
