import { h, mark, setText } from "../shared/dom.ts";
import { formatNumber } from "../shared/fields.ts";
import type { Store } from "../shared/store.ts";
import type { MakePart } from "./common.ts";
import { details } from "./facts.ts";

const PATIENCE = 1500;
/** Milliseconds of solving after which it can be cancelled. */
const LONG = 400;

/** One line that says how things stand: solved, solving, at fault, or why there is no layout. */
export const statusLine: MakePart = ({ store, signal }) => {
  const dot = h("span", { class: "fnb-dot", "aria-hidden": "true" });
  const text = h("span", { class: "fnb-status-text" });
  const facts = h("span", { class: "fnb-facts" });
  const warnings = h("details", { class: "fnb-warnings", hidden: true });
  const changes = h("div", { class: "fnb-suggestions", role: "group", "aria-label": "Changes that would work" });
  const cancel = h("button", { type: "button", class: "fnb-fix fnb-cancel", hidden: true }, "Cancel");
  cancel.addEventListener("click", () => store.ask({ op: "stop" }));
  const line = h("div", { class: "fnb-status-line" }, dot, text, cancel, facts, details(store));
  let slow = 0;
  const el = h("div", { class: "fnb-status", role: "status", "aria-live": "polite" }, line, changes, warnings);

  let timer = 0;
  const show = () => {
    const [state, sentence] = describe(store);
    mark(el, "data-state", state);
    setText(text, sentence);
    setText(facts, describeFacts(store));
    showSuggestions(changes, store);
    showWarnings(warnings, store);
    // A solve that takes longer than a moment can be ended; what it has found by then is taken.
    clearTimeout(slow);
    const { busy } = store.get("status");
    if (!busy || !store.live) cancel.hidden = true;
    else if (cancel.hidden)
      slow = window.setTimeout(() => {
        cancel.hidden = false;
      }, LONG);
    clearTimeout(timer);
    if (store.waiting && store.waiting < PATIENCE) timer = window.setTimeout(show, PATIENCE + 50 - store.waiting);
  };
  store.watch(["status", "drafts", "stage"], show);
  store.watchQueue(() => {
    clearTimeout(timer);
    if (!store.live || el.dataset.state === "waiting") show();
    else if (store.waiting) timer = window.setTimeout(show, PATIENCE);
  });
  signal.addEventListener("abort", () => {
    clearTimeout(timer);
    clearTimeout(slow);
  });
  return el;
};

function describe(store: Store): [state: string, sentence: string] {
  const status = store.get("status");
  const drafts = store.get("drafts");
  const { presence } = store.kernel;
  if (presence === "saved") return ["off", "No kernel: the façade as it was saved, read only"];
  if (presence === "gone") return ["off", "The kernel has gone: the façade as it was last, read only"];
  if (presence === "away") return ["waiting", "No connection to the kernel: read only until it is back"];
  if (store.waiting > PATIENCE) return ["waiting", "The kernel is busy; edits will follow when it answers"];
  // What is at fault comes first: what the solver says is about the design as it was before.
  if (drafts.length) {
    const [first] = drafts;
    const where = first ? first.path.slice(0, 2).reverse().join(" in ") : "";
    return ["fault", drafts.length > 1 ? `${drafts.length} fields are at fault` : `At fault: ${where}`];
  }
  if (status.message) return ["none", status.message];
  if (status.busy) return ["busy", status.proving ? "The best so far is shown; proving…" : "Solving…"];
  if (!status.solved || !store.get("design").layers.length) return ["off", "Nothing to solve yet"];
  if (!status.solved.complete) return ["warn", `Best layout found in ${time(status.milliseconds)}, not proven`];
  return [status.solved.warnings.length ? "warn" : "good", `Solved in ${time(status.milliseconds)}`];
}

function time(milliseconds: number): string {
  return milliseconds < 1000 ? `${Math.max(1, Math.round(milliseconds))} ms` : `${(milliseconds / 1000).toFixed(1)} s`;
}

function describeFacts(store: Store): string {
  const { solved, proving } = store.get("status");
  if (!solved || !store.get("design").layers.length) return "";
  const { x, y } = solved.deviation;
  return [
    `${solved.shapes} ${solved.shapes === 1 ? "shape" : "shapes"}`,
    `deviation ${formatNumber(x, 2)} × ${formatNumber(y, 2)} m`,
    // While the search goes on it is not known how good it is.
    solved.proven ? "proven best" : proving ? "" : `within ${formatNumber(solved.gap, 2)} of the best`,
    solved.holes ? `${solved.holes} ${solved.holes === 1 ? "hole" : "holes"}` : "",
  ]
    .filter(Boolean)
    .join("  ·  ");
}

/** A button for each change that the solver has found to work, which makes it. */
function showSuggestions(el: HTMLElement, store: Store): void {
  const { suggestions, busy } = store.get("status");
  const texts = store.live ? (suggestions ?? []) : [];
  const key = texts.join("\n");
  el.hidden = texts.length === 0 || busy;
  if (el.dataset.key === key) return;
  el.dataset.key = key;
  el.replaceChildren(
    ...texts.map((text) => {
      const take = h("button", { type: "button", class: "fnb-fix" }, `Fix: ${text}`);
      take.addEventListener("click", () => store.ask({ op: "take", text }));
      return take;
    }),
  );
}

function showWarnings(el: HTMLDetailsElement, store: Store): void {
  const warnings = store.get("status").solved?.warnings ?? [];
  const remedies = store.get("stage").remedies ?? [];
  const key = JSON.stringify([warnings, remedies, store.live]);
  if (el.dataset.key === key) return;
  el.dataset.key = key;
  el.hidden = warnings.length === 0;
  el.replaceChildren(
    h("summary", {}, warnings.length === 1 ? "1 warning" : `${warnings.length} warnings`),
    h(
      "ul",
      {},
      ...warnings.map((warning, i) => {
        const own = store.live ? remedies.filter((one) => one.warning === i) : [];
        return h("li", {}, warning, ...own.map((one) => remedyButton(store, one)));
      }),
    ),
  );
}

function remedyButton(store: Store, { warning, text }: { warning: number; text: string }): HTMLElement {
  const fix = h("button", { type: "button", class: "fnb-fix" }, `Fix: ${text}`);
  fix.addEventListener("click", () => store.ask({ op: "remedy", warning, text }));
  return fix;
}
