import { h, mark } from "../shared/dom.ts";
import { button, formatNumber } from "../shared/fields.ts";
import type { SnapshotState } from "../shared/stage.ts";
import type { MakePart } from "./common.ts";
import { factsTable } from "./facts.ts";

const NOW = "now";
/** The event that tells a view that it is looked at. */
export const SHOWN = "fnb-shown";

/** Two snapshots side by side, or one and the design as it is now. */
export const compare: MakePart = ({ store }) => {
  const sides = ["left", "right"].map((where, i) => {
    const choice = h("select", {
      class: "fnb-select",
      "aria-label": `What stands at the ${where}`,
      "data-local": true,
    });
    const picture = h("img", { alt: "" });
    const facts = h("div", { class: "fnb-facts-body" });
    const back = button("Bring this snapshot back", "undo", () => {
      store.ask({ op: "bring-back", number: Number(choice.value) });
    });
    const forget = button("Forget this snapshot", "close", () =>
      store.ask({ op: "forget", number: Number(choice.value) }),
    );
    const el = h(
      "div",
      { class: "fnb-compared" },
      h("div", { class: "fnb-compared-head" }, choice, back, forget),
      picture,
      facts,
    );
    choice.addEventListener("change", () => show());
    return { el, choice, picture, facts, back, forget, first: i === 0 };
  });
  const empty = h(
    "p",
    { class: "fnb-empty fnb-stage-note" },
    "No snapshot yet: take one by the toolbar, go on, and compare.",
  );
  const el = h(
    "div",
    { class: "fnb-paper fnb-compare", role: "group", "aria-label": "Snapshots side by side" },
    ...sides.map((side) => side.el),
    empty,
  );
  let listed = "";
  const list = () => {
    if (el.hidden) return;
    const all = store.get("snapshots");
    const names = [...all.map((one) => [String(one.number), `Snapshot ${one.number}`]), [NOW, "Now"]] as [
      string,
      string,
    ][];
    const key = JSON.stringify(names);
    if (key !== listed) {
      listed = key;
      for (const side of sides) {
        const before = side.choice.value;
        side.choice.replaceChildren(...names.map(([value, text]) => h("option", { value }, text)));
        const known = names.some(([value]) => value === before);
        side.choice.value = known && before !== NOW ? before : side.first ? (names.at(-2)?.[0] ?? NOW) : NOW;
      }
    }
    empty.hidden = all.length > 0;
    for (const side of sides) side.el.hidden = all.length === 0;
    show();
  };
  const show = () => {
    const all = store.get("snapshots");
    for (const side of sides) {
      const chosen = all.find((one) => String(one.number) === side.choice.value);
      const text = chosen ? chosen.svg : store.get("svg");
      const src = text ? `data:image/svg+xml;utf8,${encodeURIComponent(text)}` : null;
      mark(side.picture, "src", src);
      side.picture.hidden = !text;
      const facts = chosen ? chosen.facts : (store.get("stage").facts ?? []);
      side.facts.replaceChildren(h("p", {}, saying(chosen, store)), ...(facts.length ? [factsTable(facts)] : []));
      side.back.disabled = side.forget.disabled = !chosen;
    }
  };
  el.addEventListener(SHOWN, list);
  store.watch(["snapshots", "svg", "stage", "design"], list);
  return el;
};

function saying(
  chosen: SnapshotState | undefined,
  store: {
    get(key: "design"): { name: string; canvas: { width: number; height: number } };
    get(key: "status"): { solved: { shapes: number } | null };
  },
): string {
  const { name, canvas } = chosen ?? store.get("design");
  const shapes = chosen ? chosen.shapes : (store.get("status").solved?.shapes ?? 0);
  return `${name}: ${formatNumber(canvas.width)} × ${formatNumber(canvas.height)} m, ${shapes} shapes`;
}
