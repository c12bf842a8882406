// The bundle that every part runs: it makes the part that the model names, inside the shared frame of theme, keys,
// notices and errors.

import "../styles/base.css";
import "../styles/around.css";
import "../styles/fields.css";
import "../styles/editors.css";
import "../styles/views.css";
import "../styles/stage.css";
import "../styles/panel.css";
import "../styles/patterns.css";
import "../styles/building.css";
import "../styles/quiz.css";
import { building } from "../building/view.ts";
import { absence } from "../shared/absence.ts";
import { h, mark } from "../shared/dom.ts";
import { keepKeys, keepKeysAround } from "../shared/keys.ts";
import { keepFocus } from "../shared/staying.ts";
import { Store } from "../shared/store.ts";
import { adoptStyle, type Theme, themeOf, watchTheme } from "../shared/theme.ts";
import type { Mount, WidgetModel } from "../shared/types.ts";
import { canvas } from "../studio/canvas.ts";
import { type Context, type MakePart, resolveIn, section } from "../studio/common.ts";
import { counters } from "../studio/counters.ts";
import { elevation } from "../studio/elevation.ts";
import { inspector } from "../studio/inspector.ts";
import { layers } from "../studio/layers.ts";
import { link } from "../studio/links.ts";
import { massing } from "../studio/massing.ts";
import { notices } from "../studio/notices.ts";
import { patterns } from "../studio/patterns.ts";
import { shapes } from "../studio/shapes.ts";
import { statusLine } from "../studio/status.ts";
import { studio } from "../studio/studio.ts";
import { symbols } from "../studio/symbols.ts";
import { toolbar } from "../studio/toolbar.ts";

type Make = (context: Context, model: WidgetModel) => HTMLElement;

const adding =
  (kind: string, title: string, make: MakePart): Make =>
  (context) =>
    section(title, make(context), {
      add: { label: `Add a ${kind}`, action: () => context.store.ask({ op: "add", kind }) },
    });

const PARTS: Record<string, Make> = {
  studio,
  elevation: (context) => h("div", { class: "fnb-alone" }, elevation(context), inspector(context), statusLine(context)),
  building: (context, model) =>
    h("div", { class: "fnb-alone" }, building(context, model), inspector(context), statusLine(context)),
  massing: (context, model) => h("div", { class: "fnb-alone" }, massing(context, model, context.signal)),
  patterns: adding("pattern", "Patterns", patterns),
  symbols: adding("symbol", "Symbols", symbols),
  counters: (context) => section("Counters", counters(context)),
  layers: adding("layer", "Layers", layers),
  shapes: (context) => section("Shapes", h("div", {}, shapes(context), inspector(context))),
  canvas: (context) => section("Canvas", canvas(context)),
  toolbar,
};

export function mount({ el, model, channel, css }: Mount): () => void {
  const end = new AbortController();
  const { signal } = end;
  adoptStyle(css, el, signal);
  const store = new Store(channel, signal);
  const part = model.get<string>("part");
  const make = PARTS[part];
  if (!make) throw new Error(`facade_nb: no part named ${part}`);

  const { el: noticeArea, notify } = notices(store, signal);
  const root = h("div", { class: `fnb fnb-part-${part}` });
  root.append(make({ store, signal, notify }, model), noticeArea);
  mark(root, "inert", store.kernel.presence === "saved");
  const saves = part === "studio" || part === "toolbar";
  absence(root, store.kernel, signal, {
    what: "façade",
    unsent: () => store.waits,
    after: () => {
      const state = store.get("stage").keeping?.state ?? "off";
      const kept =
        state === "on" || state === "restored"
          ? "Run the cell again: the design comes back."
          : "Run the cell again to go on.";
      return saves ? `${kept} Save writes it as a file, without a kernel too.` : kept;
    },
  });
  link(root, store.prefix, signal, resolveIn(store));
  keepFocus(root, signal);
  keepKeys(root, signal, (op) => store.ask({ op }));
  keepKeysAround(el, signal);
  root.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !event.defaultPrevented) store.ask({ op: "select" });
  });
  const tellTheme = (theme: Theme) => {
    if (store.get("theme") !== theme) store.ask({ op: "theme", theme });
  };
  watchTheme(root, signal, tellTheme);
  store.kernel.watch(() => tellTheme(themeOf(root)), signal);
  el.append(root);
  return () => {
    end.abort("ended");
    root.remove();
  };
}
