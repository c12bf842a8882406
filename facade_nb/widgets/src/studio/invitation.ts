import { focused, h, mark } from "../shared/dom.ts";
import { faultLine } from "../shared/fields.ts";
import { icon } from "../shared/icons.ts";
import type { Context } from "./common.ts";
import { gallery } from "./gallery.ts";

/** What an empty studio offers: a new canvas, a pattern to type, the gallery, a surveyed façade. */
export function invitation(context: Context): HTMLElement {
  const { store, signal } = context;
  const size = (label: string, value: string) =>
    h("input", {
      type: "text",
      inputmode: "decimal",
      class: "fnb-number",
      "aria-label": `${label} of the new canvas in metres`,
      value,
      autocomplete: "off",
    });
  const [width, height] = [size("Width", "12"), size("Height", "9")];
  const create = h(
    "button",
    { type: "submit", class: "fnb-button fnb-wide fnb-primary" },
    icon("create"),
    h("span", {}, "New"),
  );
  const fresh = h(
    "form",
    { class: "fnb-invite-row" },
    h("label", {}, "Canvas", width),
    h("span", {}, "×"),
    h("label", {}, height, "m"),
    create,
  );
  fresh.addEventListener("submit", (event) => {
    event.preventDefault();
    store.ask({ op: "new", width: width.value, height: height.value });
  });

  const pattern = h("input", {
    type: "text",
    class: "fnb-invite-pattern",
    "aria-label": "A pattern to begin with",
    placeholder: "A(BA)^k",
    spellcheck: "false",
    autocomplete: "off",
    autocapitalize: "off",
  });
  const faults = h("div", { class: "fnb-faults", role: "alert", hidden: true });
  const begin = h("button", { type: "submit", class: "fnb-button fnb-wide" }, h("span", {}, "Begin"));
  const typed = h("form", { class: "fnb-invite-row" }, pattern, begin);
  typed.addEventListener("submit", (event) => {
    event.preventDefault();
    if (pattern.value.trim()) store.ask({ op: "begin", text: pattern.value, width: width.value, height: height.value });
    else pattern.focus();
  });
  pattern.addEventListener("input", () => {
    faults.hidden = true;
    mark(pattern, "aria-invalid", null);
  });

  const survey = h("div", { class: "fnb-invite-survey" });
  const pictures = gallery(context, () => {});
  const el = h(
    "div",
    { class: "fnb-invitation", hidden: true, "data-beside": true, role: "region", "aria-label": "Begin a façade" },
    h(
      "div",
      { class: "fnb-invite" },
      h("h3", {}, "Begin a façade"),
      fresh,
      h("p", {}, "or type a pattern: a letter is a part of the façade, (…)^k repeats"),
      typed,
      faults,
      survey,
      h("p", {}, "or begin with a design of the gallery"),
      pictures.el,
    ),
  );
  /** The pattern whose field is to have the focus as soon as there is one. */
  let due = "";
  const seek = () => {
    if (due && focusPattern(el, due)) due = "";
  };
  store.onReply((reply) => {
    if (reply.kind === "unbegun") {
      mark(pattern, "aria-invalid", "true");
      faults.hidden = false;
      faults.replaceChildren(...reply.faults.map((fault) => faultLine(fault)));
      pattern.focus();
    }
    if (reply.kind === "begun") {
      pattern.value = "";
      due = reply.pattern;
      requestAnimationFrame(seek);
    }
  });
  // The reply may come ahead of the design that has the pattern.
  store.watch(["design"], () => due && requestAnimationFrame(seek));
  store.watch(["menus"], () => {
    const buildings = store.get("menus").surveyed ?? [];
    survey.hidden = buildings.length === 0;
    survey.replaceChildren(
      h("p", {}, "or with a surveyed façade, its openings to be drawn over"),
      h(
        "div",
        { class: "fnb-invite-row" },
        ...buildings.map((building) => {
          const open = h("button", { type: "button", class: "fnb-invite-chip" }, building);
          open.addEventListener("click", () => store.ask({ op: "survey", building }));
          return open;
        }),
      ),
    );
  });
  store.watch(["design", "drafts", "status"], () => {
    const { layers, patterns, symbols } = store.get("design");
    const bare = layers.length + patterns.length + symbols.length + store.get("drafts").length === 0;
    // A widget that was saved is only looked at.
    const hidden = !bare || store.kernel.presence === "saved";
    if (el.hidden === hidden) return;
    // Whoever typed here goes on where the first pattern is.
    const inside = el.contains(focused(el));
    el.hidden = hidden;
    if (hidden && inside) el.closest<HTMLElement>(".fnb-paper")?.focus({ preventScroll: true });
    if (!hidden) requestAnimationFrame(() => signal.aborted || pictures.show());
  });
  return el;
}

/** Go to the field of a pattern, its text selected: it is the next to be typed. False: there is none yet. */
export function focusPattern(from: HTMLElement, name: string): boolean {
  const root = from.closest(".fnb");
  const row = [...(root?.querySelectorAll<HTMLElement>("[data-pattern]") ?? [])].find(
    (own) => own.dataset.pattern === name,
  );
  const field = row?.querySelector<HTMLElement>("textarea, [contenteditable], input:not(.fnb-name)");
  if (!field) return false;
  field.focus();
  if (field instanceof HTMLTextAreaElement || field instanceof HTMLInputElement) field.select();
  return true;
}
