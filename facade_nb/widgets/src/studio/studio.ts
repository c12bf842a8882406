import { building } from "../building/view.ts";
import { h, mark } from "../shared/dom.ts";
import type { WidgetModel } from "../shared/types.ts";
import { canvas } from "./canvas.ts";
import { type Context, type MakePart, section } from "./common.ts";
import { compare, SHOWN } from "./compare.ts";
import { counters } from "./counters.ts";
import { elevation } from "./elevation.ts";
import { exploded } from "./exploded.ts";
import { inspector } from "./inspector.ts";
import { layers } from "./layers.ts";
import { patterns } from "./patterns.ts";
import { predicting } from "./predicting.ts";
import { rules } from "./rules.ts";
import { shapes } from "./shapes.ts";
import { statusLine } from "./status.ts";
import { symbols } from "./symbols.ts";
import { toolbar } from "./toolbar.ts";

const VIEWS = { elevation: "Elevation", both: "Both", building: "3D", exploded: "Layers", compare: "Compare" } as const;
type View = keyof typeof VIEWS;
/** Views that are made when they are first looked at. */
const OTHERS: Partial<Record<View, MakePart>> = { exploded, compare };

/** All parts together. */
export function studio(context: Context, model: WidgetModel): HTMLElement {
  const { store, signal } = context;
  const add = (kind: string) => ({ label: `Add a ${kind}`, action: () => store.ask({ op: "add", kind }) });
  const panel = h(
    "div",
    { class: "fnb-panel" },
    section("Canvas", h("div", {}, canvas(context), predicting(context))),
    section("Patterns", patterns(context), { add: add("pattern") }),
    section("Layers", layers(context), { add: add("layer") }),
    section("Shapes", shapes(context)),
    section("Symbols", symbols(context), { add: add("symbol") }),
    section("Counters", counters(context)),
    section("Rules", rules(context), { open: Boolean(store.get("design").grammar) }),
  );
  const flat = elevation(context);
  const stage = h("div", { class: "fnb-stage" }, flat);

  // Beside the façade, or under it where the studio is narrow, never over it.
  const hint = h("p", { class: "fnb-dock-hint" }, "Pick a shape, or a pair of symbols, to change its looks.");
  const looks = inspector(context);
  const dock = h("div", { class: "fnb-dock" }, looks, hint);
  store.watch(["selection"], () => {
    const picked = store.get("selection").cell !== null;
    hint.hidden = picked;
    if (picked) mark(dock, "data-used", true);
  });

  let solid: HTMLElement | null = null;
  const others = new Map<string, HTMLElement>();
  let apart = false;
  const tabs = (Object.keys(VIEWS) as View[]).map((view) => {
    const tab = h("button", { type: "button", class: "fnb-tab", "data-local": true }, VIEWS[view]);
    tab.addEventListener("click", () => choose(view));
    return { view, tab };
  });
  const choose = (view: View) => {
    for (const other of tabs) mark(other.tab, "aria-pressed", String(other.view === view));
    mark(stage, "data-view", view);
    flat.hidden = view !== "elevation" && view !== "both";
    if ((view === "building" || view === "both") && !solid) {
      solid = building(context, model);
      stage.append(solid);
    }
    if (solid) solid.hidden = view !== "building" && view !== "both";
    if ((view === "exploded") !== apart) {
      apart = !apart;
      store.ask({ op: "want", what: "exploded", on: apart });
    }
    for (const [name, make] of Object.entries(OTHERS)) {
      let own = others.get(name);
      if (!own && view === name) {
        own = make(context);
        others.set(name, own);
        stage.append(own);
      }
      if (!own) continue;
      own.hidden = view !== name;
      if (!own.hidden) own.dispatchEvent(new Event(SHOWN));
    }
    if (model.get("view") !== view) {
      model.set("view", view);
      store.kernel.save(model);
    }
  };
  const bar = toolbar(context);
  bar.append(h("span", { class: "fnb-tabs", role: "group", "aria-label": "View" }, ...tabs.map(({ tab }) => tab)));
  choose(model.get<View>("view"));

  const el = h(
    "div",
    { class: "fnb-studio" },
    bar,
    h("div", { class: "fnb-main" }, stage, panel, dock),
    statusLine(context),
  );
  const resize = () => el.style.setProperty("--fnb-height", `${model.get<number>("height")}px`);
  resize();
  model.on("change:height", resize);
  signal.addEventListener("abort", () => model.off("change:height", resize));
  return el;
}
