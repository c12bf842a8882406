// Variants as a table or as pictures: sorted by a column, one of them opened in the studio by a click or Enter.

import { h, keyed, mark, setText, setTraits } from "../shared/dom.ts";
import { button } from "../shared/fields.ts";
import { icon } from "../shared/icons.ts";
import type { WidgetModel } from "../shared/types.ts";
import { type Column, columnsOf, ordered } from "./columns.ts";
import { type Item, item } from "./item.ts";
import type { Session } from "./session.ts";

type Look = "table" | "pictures";

export function variations(session: Session, model: WidgetModel, signal: AbortSignal): HTMLElement {
  const columns = columnsOf(session.columns);
  const local = (name: string, value: string) => {
    setTraits(model, { [name]: value });
    session.kernel.save(model);
  };
  const sortBy = (key: string) => {
    const now = model.get<string>("sort");
    local("sort", now === key ? `-${key}` : now === `-${key}` ? "" : key);
  };

  const heads = columns.map((column) => head(column, sortBy));
  const rank = (column: Column) => ({ "data-rank": String(column.rank) });
  const body = h("tbody", {});
  const table = h(
    "table",
    { class: "fnb-var-table", "aria-label": `Variants of ${session.name}` },
    h(
      "thead",
      {},
      h(
        "tr",
        {},
        h("th", { scope: "col", class: "fnb-var-first" }, h("span", {}, "variant")),
        ...heads.map(({ el }) => el),
      ),
    ),
    body,
  );
  const box = h("div", { class: "fnb-var-box" }, table);
  const items: Item[] = [];
  const sight = new IntersectionObserver(
    (entries) => {
      for (const entry of entries)
        if (entry.isIntersecting) session.want(Number((entry.target as HTMLElement).dataset.row));
    },
    { rootMargin: "300px" },
  );
  const show = keyed<number>(body, String, (row) => {
    const made = item(row, columns, rank, {
      open: () => session.ask({ op: "open", row }),
      picture: () => session.picture(row),
      live: () => session.live,
    });
    items[row] = made;
    sight.observe(made.el);
    return {
      el: made.el,
      update: () => made.update(session.rows[row], session.state.opened === row),
    };
  });
  walk(body, () => (model.get<Look>("look") === "pictures" ? across(body) : 1));

  // ---- the bar ------------------------------------------------------------------------------------------------------

  const progress = h("progress", { class: "fnb-var-progress", "aria-label": "Variants solved" });
  const said = h("span", { class: "fnb-var-said", role: "status" });
  const cancel = h("button", { type: "button", class: "fnb-var-run fnb-var-needs" });
  cancel.addEventListener("click", () => session.ask({ op: session.state.running ? "stop" : "run" }));
  const looks = (["table", "pictures"] as const).map((look) => {
    const one = button(look === "table" ? "Table" : "Pictures", look === "table" ? "list" : "pictures", () =>
      local("look", look),
    );
    one.dataset.local = "true";
    return one;
  });
  const chosen = h("select", { class: "fnb-select fnb-var-sort", "aria-label": "Sort by", "data-local": true });
  chosen.append(
    h("option", { value: "" }, "as given"),
    ...columns.flatMap(({ key, title }) => [
      h("option", { value: key }, `${title}, least first`),
      h("option", { value: `-${key}` }, `${title}, most first`),
    ]),
  );
  chosen.addEventListener("change", () => local("sort", chosen.value));
  const bar = h(
    "div",
    { class: "fnb-var-bar" },
    said,
    progress,
    cancel,
    h("span", { class: "fnb-var-gap" }),
    chosen,
    h("span", { class: "fnb-var-looks", role: "group", "aria-label": "Shown as" }, ...looks),
  );
  const trouble = h("pre", { class: "fnb-var-trouble", role: "alert", hidden: true });

  const update = () => {
    const { rows, state } = session;
    const sort = model.get<string>("sort");
    const look = model.get<Look>("look");
    const focus = body.contains(document.activeElement) ? document.activeElement : null;
    show(ordered(rows, columns, sort));
    if (focus instanceof HTMLElement && body.contains(focus) && focus !== document.activeElement)
      focus.focus({ preventScroll: true });
    rove(body);
    for (const { column, update } of heads) update(sort === column.key ? 1 : sort === `-${column.key}` ? -1 : 0);
    chosen.value = sort;
    mark(box, "data-look", look);
    for (const [k, one] of looks.entries()) mark(one, "aria-pressed", String((k === 0) === (look === "table")));
    const done = rows.filter((row) => row.state !== "waiting").length;
    const failed = rows.filter((row) => row.state === "error").length;
    progress.max = Math.max(1, rows.length);
    progress.value = done;
    progress.hidden = !state.running;
    cancel.hidden = session.kernel.presence === "saved" || (!state.running && done === rows.length);
    if (cancel.textContent !== (state.running ? "Cancel" : "Go on"))
      cancel.replaceChildren(icon(state.running ? "close" : "play"), state.running ? "Cancel" : "Go on");
    setText(said, told(done, failed, rows.length, state.running));
    trouble.textContent = session.trouble;
    trouble.hidden = !session.trouble;
  };
  session.hold(update, signal);
  for (const name of ["sort", "look"]) {
    model.on(`change:${name}`, update);
    signal.addEventListener("abort", () => model.off(`change:${name}`, update));
  }
  signal.addEventListener("abort", () => sight.disconnect());
  update();
  return h("div", {}, bar, box, trouble);
}

function told(done: number, failed: number, all: number, running: boolean): string {
  const without = failed ? `, ${failed} without a layout` : "";
  if (running) return `${done} of ${all} solved${without}`;
  if (done < all) return `Stopped: ${done} of ${all} solved${without}`;
  return `${all} variant${all === 1 ? "" : "s"}${without}`;
}

/** The head of a column: a button that sorts by it, one way, the other way, and not at all. */
function head(column: Column, sort: (key: string) => void) {
  const arrow = h("span", { class: "fnb-var-arrow", "aria-hidden": "true" });
  const own = h("button", { type: "button", title: column.hint, "data-local": true }, column.title, arrow);
  own.addEventListener("click", () => sort(column.key));
  const el = h("th", { scope: "col", "data-rank": String(column.rank) }, own);
  return {
    el,
    column,
    update(way: -1 | 0 | 1) {
      mark(el, "aria-sort", way === 0 ? "none" : way > 0 ? "ascending" : "descending");
      setText(arrow, way === 0 ? "" : way > 0 ? "▲" : "▼");
    },
  };
}

/** How many pictures stand side by side. */
function across(body: HTMLElement): number {
  const all = [...body.children] as HTMLElement[];
  const top = all[0]?.offsetTop ?? 0;
  return Math.max(1, all.filter((el) => el.offsetTop === top).length);
}

/** Arrow keys, Home and End go from row to row; one of them can be reached by Tab. */
function walk(body: HTMLElement, beside: () => number): void {
  body.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const all = [...body.children] as HTMLElement[];
    const at = all.indexOf(event.target as HTMLElement);
    if (at < 0) return;
    const wide = beside();
    const steps: Record<string, number> = {
      ArrowUp: at - wide,
      ArrowDown: at + wide,
      ArrowLeft: wide > 1 ? at - 1 : at,
      ArrowRight: wide > 1 ? at + 1 : at,
      Home: 0,
      End: all.length - 1,
    };
    const to = steps[event.key];
    if (to === undefined) return;
    event.preventDefault();
    const next = all[to];
    if (!next) return;
    for (const el of all) el.tabIndex = el === next ? 0 : -1;
    next.focus();
  });
}

/** Keep one row within reach of Tab: the one that has been, else the opened, else the first. */
function rove(body: HTMLElement): void {
  const all = [...body.children] as HTMLElement[];
  const now = all.find((el) => el.tabIndex === 0) ?? all.find((el) => el.hasAttribute("data-opened")) ?? all[0];
  for (const el of all) el.tabIndex = el === now ? 0 : -1;
}
