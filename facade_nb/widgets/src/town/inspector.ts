// What is told of the building that was chosen, and what can be done with it.

import { h, mark, setText } from "../shared/dom.ts";
import type { Session } from "./session.ts";

const metres = (value: number) => `${value.toFixed(1)}\u00a0m`;

const heightOf = (eaves: number, rise: number) =>
  rise > 0.05 ? `${metres(eaves + rise)}, walls ${metres(eaves)}` : metres(eaves);
const keyed = (...names: string[]) => names.map((name) => h("kbd", {}, name));

export function inspector(session: Session, signal: AbortSignal): HTMLElement {
  const hint = h(
    "div",
    { class: "fnb-town-hint" },
    h("p", {}, "Click a building, or press Enter, to see what it is made of."),
    h(
      "p",
      {},
      "Drag to look around. ",
      ...keyed("W", "A", "S", "D"),
      " fly, ",
      ...keyed("Q", "E"),
      " sink and rise, ",
      ...keyed("Shift"),
      " is faster.",
    ),
  );
  const title = h("h4", {});
  const list = h("dl", {});
  const style = h("select", { class: "fnb-select fnb-town-edit", "aria-label": "Style of this building" });
  const edit = h("button", { type: "button", class: "fnb-town-button fnb-town-edit" }, "Edit its grammar");
  const leave = h("button", { type: "button", class: "fnb-town-button", "data-local": true }, "Let go");
  const row = h("label", { class: "fnb-town-choice" }, h("span", {}, "Style"), style);
  const body = h(
    "div",
    { class: "fnb-town-facts" },
    title,
    list,
    row,
    h("div", { class: "fnb-town-group" }, edit, leave),
  );
  let options = "";
  style.addEventListener("change", () => session.set("restyled", [session.chosen, Number(style.value)]));
  leave.addEventListener("click", () => session.set("chosen", -1));
  edit.addEventListener("click", () => {
    const town = session.head?.town;
    if (!town) return;
    const name = town.styles[session.styleOf(session.chosen)] ?? "";
    session.set("section", town.parts.includes(name) ? name : (town.parts.at(-1) ?? ""));
  });
  session.hold(() => {
    const town = session.head?.town;
    const own = session.chosen;
    const some = !!town && own >= 0;
    hint.hidden = some;
    body.hidden = !some;
    if (!town || own < 0) return;
    setText(title, `Building ${own}`);
    const at = (values: ArrayLike<number>) => values[own] as number;
    const facts: [string, string][] = [
      ["Use", town.kinds[at(town.kind)] ?? ""],
      ["Storeys", String(at(town.storeys))],
      ["Height", heightOf(at(town.eaves), at(town.rise))],
      ["Roof", town.roofs[at(town.roof)] ?? ""],
      ["Seed", `${(town.seed[2 * own] as number) / 64}, ${(town.seed[2 * own + 1] as number) / 64}\u00a0m`],
    ];
    const key = JSON.stringify(facts);
    if (list.dataset.key !== key) {
      list.dataset.key = key;
      list.replaceChildren(...facts.flatMap(([name, value]) => [h("dt", {}, name), h("dd", {}, value)]));
    }
    if (town.styles.join() !== options) {
      options = town.styles.join();
      style.replaceChildren(...town.styles.map((name, k) => h("option", { value: k }, name)));
    }
    style.value = String(session.styleOf(own));
    mark(body, "data-building", String(own));
  }, signal);
  return h("section", { class: "fnb-town-inspector", "aria-label": "Building" }, hint, body);
}
