// The whole page: the player above, the façade and the events beside the views; the view of the stage that is played
// comes by itself.

import { h, mark, setTraits } from "../shared/dom.ts";
import type { WidgetModel } from "../shared/types.ts";
import { Asking } from "./asking.ts";
import { apology, type Panel, panel } from "./frame.ts";
import { playbar } from "./playbar.ts";
import { afterDrawing } from "./redraw.ts";
import type { Loaded, Session } from "./session.ts";
import { VIEWS } from "./views/index.ts";

/** The views that speak of each stage, the best first: one that there is not is passed over. */
const SPEAKS: Record<string, string[]> = {
  analysis: ["analysis"],
  words: ["words"],
  candidates: ["candidates"],
  alignment: ["network", "alignment", "candidates"],
  sizing: ["sizing", "alignment"],
  merging: ["alignment", "words"],
};
/** Views that stand in the first column. */
const BESIDE = ["code", "facade", "player"];
/** The order of the buttons: that of the stages. */
const ORDER = ["code", "facade", "player", "analysis", "words", "candidates", "network", "alignment", "runs", "sizing"];

export async function page(
  session: Session,
  model: WidgetModel,
  loaded: Loaded,
  signal: AbortSignal,
): Promise<HTMLElement> {
  const { player, timeline } = loaded;
  const asking = new Asking();
  const names = [
    ...ORDER.filter((name) => name in VIEWS),
    ...Object.keys(VIEWS).filter((name) => !ORDER.includes(name)),
  ];
  const made = new Map<string, Promise<Panel>>();
  const panels = new Map<string, Panel>();
  const columns = [h("div", { class: "fnb-page-column" }), h("div", { class: "fnb-page-column" })];
  const slots = new Map(names.map((name) => [name, h("div", { class: "fnb-page-slot", hidden: true })]));
  for (const [name, slot] of slots) columns[BESIDE.includes(name) ? 0 : 1]?.append(slot);

  let kept = new Set(model.get<string[]>("views").filter((name) => names.includes(name)));
  let follow = model.get<boolean>("follow");
  const save = () => {
    setTraits(model, { views: [...kept], follow });
    session.kernel.save(model);
  };

  const chip = (label: string, title: string, act: () => void) => {
    const button = h("button", { type: "button", class: "fnb-page-chip", title }, label);
    button.addEventListener("click", () => {
      act();
      save();
      show();
    });
    return button;
  };
  const following = chip("Follow the stage", "Show the view of the stage that is played", () => {
    follow = !follow;
  });
  const chips = names.map((name) => {
    const kind = VIEWS[name];
    const button = chip(kind?.title ?? name, `Keep ${kind?.title ?? name} on the page`, () => {
      const added = !kept.has(name);
      kept = new Set(added ? [...kept, name] : [...kept].filter((other) => other !== name));
      if (added)
        queueMicrotask(() =>
          made.get(name)?.then(
            () => slots.get(name)?.scrollIntoView({ block: "nearest" }),
            () => {}, // what failed to load is told in its slot
          ),
        );
    });
    return { name, button };
  });

  const spoken = (): string | undefined => {
    const stage = timeline.data.stages[timeline.stageAt(player.position)]?.stage ?? "";
    return (SPEAKS[stage] ?? []).find((name) => names.includes(name));
  };

  /** Have a view's panel in its slot: it is made when it is first shown, and its pieces loaded. */
  const bring = (name: string, slot: HTMLElement): void => {
    const kind = VIEWS[name];
    if (!kind) return;
    const before = panels.get(name);
    if (before?.el.hidden) {
      before.el.hidden = false;
      before.refresh();
    }
    if (made.has(name)) return;
    slot.replaceChildren(h("p", { class: "fnb-empty" }, `Loading ${kind.title}…`));
    const own = panel(kind, session, model, { ...loaded, asking }, signal);
    made.set(name, own);
    own.then(
      (made) => {
        if (signal.aborted) return;
        panels.set(name, made);
        slot.replaceChildren(made.el);
        show();
      },
      (error) => {
        if (!signal.aborted) slot.replaceChildren(apology(error));
      },
    );
  };

  const show = () => {
    const told = spoken();
    const now = follow ? told : undefined;
    mark(following, "aria-pressed", String(follow));
    for (const { name, button } of chips) {
      mark(button, "aria-pressed", String(kept.has(name)));
      mark(button, "data-spoken", name === now);
    }
    for (const [name, slot] of slots) {
      const shown = kept.has(name) || name === now;
      if (slot.hidden === shown) slot.hidden = !shown;
      if (shown) bring(name, slot);
      const panel = panels.get(name);
      if (!panel) continue;
      if (!shown) panel.hide();
      panel.follow(shown && (name === told || BESIDE.includes(name)));
    }
    for (const column of columns) column.hidden = [...column.children].every((slot) => (slot as HTMLElement).hidden);
  };
  /** Have what is spoken of in sight, within its column: a step must not move the notebook. */
  const reveal = () => {
    for (const [n, name] of ["player", spoken() ?? ""].entries()) {
      const [column, slot] = [columns[n] as HTMLElement, slots.get(name)];
      if (!slot || slot.hidden || column.scrollHeight <= column.clientHeight) continue;
      const now = slot.querySelector("[data-now]");
      const [outer, inner] = [column.getBoundingClientRect(), (now ?? slot).getBoundingClientRect()];
      if (!now) {
        if (inner.bottom < outer.top + 40 || inner.top > outer.bottom - 40) column.scrollTop += inner.top - outer.top;
      } else if (inner.top < outer.top) column.scrollTop -= outer.top - inner.top + 40;
      else if (inner.bottom > outer.bottom) column.scrollTop += inner.bottom - outer.bottom + 40;
    }
  };
  player.watch(show, signal);
  const drawn = () => afterDrawing(reveal); // when the lists have scrolled
  player.watch(() => afterDrawing(drawn), signal);
  show();
  await Promise.allSettled(made.values());
  const height = () => el.style.setProperty("--fnb-height", `${model.get<number>("height")}px`);
  const el = h(
    "div",
    { class: "fnb-page" },
    h("div", { class: "fnb-page-top" }, playbar(session, player, asking, signal)),
    h(
      "div",
      { class: "fnb-page-chips", role: "group", "aria-label": "Views" },
      following,
      ...chips.map(({ button }) => button),
    ),
    h("div", { class: "fnb-page-columns" }, ...columns),
  );
  height();
  model.on("change:height", height);
  signal.addEventListener("abort", () => model.off("change:height", height));
  return el;
}
