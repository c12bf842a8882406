// The bundle that every part runs: it makes the part that the model names, inside the shared frame of theme, keys,
// notices and errors.

import "../styles/base.css";
import "../styles/fields.css";
import "../styles/editors.css";
import "../styles/views.css";
import { h, mark } from "../dom.ts";
import { keepKeys } from "../keys.ts";
import { canvas } from "../parts/canvas.ts";
import { type Context, type MakePart, section } from "../parts/common.ts";
import { counters } from "../parts/counters.ts";
import { elevation } from "../parts/elevation.ts";
import { layers } from "../parts/layers.ts";
import { massing } from "../parts/massing.ts";
import { notices } from "../parts/notices.ts";
import { patterns } from "../parts/patterns.ts";
import { statusLine } from "../parts/status.ts";
import { studio } from "../parts/studio.ts";
import { symbols } from "../parts/symbols.ts";
import { toolbar } from "../parts/toolbar.ts";
import { Store } from "../store.ts";
import { adoptStyle, watchTheme } from "../theme.ts";
import type { Mount, WidgetModel } from "../types.ts";

type Make = (context: Context, model: WidgetModel) => HTMLElement;

const adding =
  (kind: string, title: string, make: MakePart): Make =>
  (context) =>
    section(title, make(context), {
      add: { label: `Add a ${kind}`, action: () => context.store.ask({ op: "add", kind }) },
    });

const PARTS: Record<string, Make> = {
  studio,
  elevation: (context) => h("div", { class: "fnb-alone" }, elevation(context), statusLine(context)),
  massing: (context, model) => h("div", { class: "fnb-alone" }, massing(context, model, context.signal)),
  patterns: adding("pattern", "Patterns", patterns),
  symbols: adding("symbol", "Symbols", symbols),
  counters: (context) => section("Counters", counters(context)),
  layers: adding("layer", "Layers", layers),
  canvas: (context) => section("Canvas", canvas(context)),
  toolbar,
};

export function mount({ el, model, channel, css }: Mount): () => void {
  const end = new AbortController();
  const { signal } = end;
  adoptStyle(css);
  const store = new Store(channel, signal);
  const part = model.get<string>("part");
  const make = PARTS[part];
  if (!make) throw new Error(`facade_nb: no part named ${part}`);

  const { el: noticeArea, notify } = notices(store, signal);
  const root = h("div", { class: `fnb fnb-part-${part}` });
  root.append(make({ store, signal, notify }, model), noticeArea);
  mark(root, "inert", !store.live);
  keepKeys(root, signal, (op) => store.ask({ op }));
  root.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !event.defaultPrevented) store.ask({ op: "select" });
  });
  watchTheme(root, signal, (theme) => {
    if (store.get("theme") !== theme) store.ask({ op: "theme", theme });
  });
  el.append(root);
  return () => {
    end.abort();
    root.remove();
  };
}
