import { focusables, h, keyed, mark, type Row } from "../shared/dom.ts";
import { button, faultBox, nameField } from "../shared/fields.ts";
import { placeBeside } from "../shared/placing.ts";
import type { PatternState } from "../shared/types.ts";
import { type Context, emptyNote, focusAdded, type MakePart, markPicked, tint } from "./common.ts";
import { relight } from "./links.ts";
import { patternField } from "./patternField.ts";
import { syntaxCard } from "./syntax.ts";
import { wordList } from "./wordList.ts";

/** What the rows share: the card, and which pattern's words are looked at. */
interface Shared {
  help(from: HTMLElement): void;
  opened(): string;
  open(name: string): void;
}

/** The patterns' texts. */
export const patterns: MakePart = (context) => {
  const { store } = context;
  const list = h("div", { class: "fnb-patterns", role: "list" });
  const empty = emptyNote("No patterns yet. A pattern is a row of symbols, such as A(BA)^k.");
  const card = cardOf(context);
  let opened = "";
  const want = (name: string, on: boolean) => store.ask({ op: "want", what: `words:${name}`, on });
  const shared: Shared = {
    help: card.open,
    opened: () => opened,
    open(name) {
      const before = opened;
      opened = before === name ? "" : name;
      if (before) want(before, false);
      if (opened) want(opened, true);
      update();
    },
  };
  store.onReply((reply) => {
    if (reply.kind !== "renamed" || reply.what !== "pattern" || reply.name !== opened) return;
    opened = "";
    shared.open(reply.to);
  });
  const show = keyed<PatternState>(
    list,
    (pattern) => pattern.name,
    (pattern) => patternRow(context, pattern, shared),
  );
  const added = focusAdded(store, "pattern", list);
  const update = () => {
    const all = store.get("design").patterns;
    empty.hidden = all.length > 0;
    show(all);
    added();
  };
  store.watch(["design", "drafts", "selection", "status", "letters", "words"], update);
  return h("div", {}, list, empty, card.el);
};

function patternRow(context: Context, first: PatternState, shared: Shared): Row<PatternState> {
  const { store } = context;
  let pattern = first;
  const name = first.name;
  const path = ["patterns", name, "text"];
  const title = nameField({
    label: `Name of pattern ${name}`,
    value: () => pattern.name,
    commit: (to) => store.ask({ op: "rename", kind: "pattern", name, to }),
    next: () => text.input,
  });
  // The empty word is an empty field; written out, it stays as it is written.
  const value = () =>
    pattern.text !== "ε" ? pattern.text : /^\s*ε?\s*$/.test(text.input.value) ? text.input.value : "";
  const text = patternField(context, name, {
    label: `Pattern ${name}`,
    path,
    value,
    placeholder: "type, such as A(BA)^k",
  });
  mark(text.input, "data-main", true);
  const faults = faultBox(store, () => [path], text.input);
  const words = button(`Words of pattern ${name}`, "list", () => shared.open(name), {
    class: "fnb-button fnb-words-open",
    "aria-expanded": "false",
    "data-local": "",
  });
  const help = button("How patterns are written", "ask", () => shared.help(help), {
    class: "fnb-button fnb-help",
    "aria-haspopup": "dialog",
    "data-local": "",
  });
  const remove = button(`Remove pattern ${name}`, "close", () => store.ask({ op: "remove", kind: "pattern", name }), {
    class: "fnb-button fnb-remove",
  });
  const body = h("div", { class: "fnb-words", hidden: true });
  const el = h(
    "div",
    { class: "fnb-pattern", role: "listitem", "data-pattern": name },
    title.el,
    text.el,
    words,
    help,
    remove,
    faults.el,
    body,
  );
  let told = "";
  const showWords = () => {
    const open = shared.opened() === name;
    mark(words, "aria-expanded", String(open));
    body.hidden = !open;
    if (!open) return;
    const own = store.get("words")[name];
    // What stands there is of the text as it was read last.
    mark(body, "data-old", own !== undefined && own.text !== (text.input.value || "ε"));
    const key = JSON.stringify([own, store.get("design").symbols.map((symbol) => symbol.name)]);
    if (key === told) return;
    told = key;
    body.replaceChildren(wordList(name, own, (symbol) => tint(store, symbol)));
    relight(body, store.prefix);
  };
  return {
    el,
    update(item) {
      pattern = item;
      title.update();
      text.update();
      faults.update();
      remove.disabled = pattern.axes !== "";
      const { layer } = store.get("selection");
      const picked = store.get("design").layers.find((other) => other.name === layer);
      markPicked(el, !!picked && (picked.x.pattern === name || picked.y.pattern === name));
      mark(el, "data-blamed", store.get("status").blame.patterns.includes(name));
      showWords();
    },
  };
}

/** The card of the syntax: opened beside the button that asks for it, which has the focus again when it is closed. */
function cardOf({ store, signal }: Context) {
  const close = button("Close", "close", () => shut(true), { class: "fnb-button fnb-card-close", "data-local": "" });
  const inner = h("div", {});
  const el = h(
    "div",
    { class: "fnb-card", role: "dialog", "aria-label": "How patterns are written", hidden: true, "data-local": true },
    close,
    inner,
  );
  let from: HTMLElement | null = null;
  const shut = (refocus: boolean) => {
    if (el.hidden) return;
    el.hidden = true;
    if (refocus) from?.focus({ preventScroll: true });
    from = null;
  };
  el.addEventListener("keydown", (event) => {
    if (event.key === "Tab") {
      // The card stands at the end of the list: Tab goes round in it.
      const all = focusables(el);
      const edge = event.shiftKey ? all[0] : all.at(-1);
      if (event.target !== edge) return;
      event.preventDefault();
      (event.shiftKey ? all.at(-1) : all[0])?.focus();
    }
    if (event.key !== "Escape") return;
    event.preventDefault(); // nothing else is given up
    event.stopPropagation();
    shut(true);
  });
  document.addEventListener(
    "pointerdown",
    (event) => {
      const path = event.composedPath();
      if (!path.includes(el) && !(from && path.includes(from))) shut(false);
    },
    { signal, capture: true },
  );
  return {
    el,
    open(button: HTMLElement) {
      if (!el.hidden) return shut(true);
      if (!inner.hasChildNodes()) inner.append(syntaxCard(() => store.get("catalogue").modes ?? []));
      from = button;
      el.hidden = false;
      placeBeside(button, el);
      inner.querySelector<HTMLElement>("input")?.focus({ preventScroll: true });
    },
  };
}
