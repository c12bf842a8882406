// The text of the grammar. Faults are underlined in it, and stand below it, each with its line and a caret; a click goes to
// the place.

import { h, mark, setText } from "../shared/dom.ts";
import { button } from "../shared/fields.ts";
import type { Fault } from "../shared/types.ts";
import { write } from "../shared/writing.ts";

/** What the editor edits: the text of a grammar, and what is wrong with it. */
export interface Edited {
  readonly text: string;
  readonly faults: Fault[];
  /** Whether a text is on its way; whether what changes does so because it is undone. */
  readonly typing: boolean;
  readonly undoing: boolean;
  readonly live: boolean;
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  /** What is told of a text without faults. */
  readonly report: string;
  set(name: "text", value: string): void;
  ask(op: "undo" | "redo"): void;
  hold(update: () => void, signal: AbortSignal): void;
}

/** The offset of a line and column, both from 1. */
export function offsetOf(text: string, line: number, column: number): number {
  const lines = text.split("\n").slice(0, line - 1);
  return Math.min(text.length, lines.reduce((sum, one) => sum + one.length + 1, 0) + column - 1);
}

/** What is underlined: the line up to a fault, and the word, number or sign that stands there. */
export function marked(text: string, line: number, column: number): [before: string, word: string] {
  const own = text.split("\n")[line - 1] ?? "";
  const rest = own.slice(column - 1);
  return [own.slice(0, column - 1), /^[\p{L}\p{N}_.:-]+/u.exec(rest)?.[0] || [...rest][0] || " "];
}

export function editor(session: Edited, signal: AbortSignal): HTMLElement {
  const area = h("textarea", {
    class: "fnb-tex-text",
    spellcheck: "false",
    autocomplete: "off",
    placeholder: "S -> Mat(Color, Rep:brick, 0, 0, 0.5, 0.5)",
    wrap: "off",
    "aria-label": "Grammar",
  });
  const undo = button("Undo (Ctrl+Z)", "undo", () => session.ask("undo"));
  const redo = button("Redo (Ctrl+Shift+Z)", "redo", () => session.ask("redo"));
  const gutter = h("div", { class: "fnb-tex-gutter", "aria-hidden": "true" });
  const marks = h("div", {});
  const list = h("div", { class: "fnb-tex-faults", role: "status" });
  let numbered = "";

  const number = () => {
    const count = area.value.split("\n").length;
    const faulty = new Set(session.faults.map((fault) => fault.line));
    const now = `${count}:${[...faulty]}`;
    if (now === numbered) return;
    numbered = now;
    gutter.replaceChildren(
      ...Array.from({ length: count }, (_, k) => h("div", { "data-faulty": faulty.has(k + 1) }, String(k + 1))),
    );
    gutter.scrollTop = area.scrollTop;
  };
  /** They lie over the text, line by line, in the same letters, of which only the underline is seen. */
  const underline = () => {
    marks.hidden = session.typing; // they belong to the text that Python has read
    marks.replaceChildren(
      ...session.faults.flatMap(({ line, column }) => {
        if (!line || !column) return [];
        const [before, word] = marked(area.value, line, column);
        const made = h("div", {}, before, h("u", {}, word));
        made.style.setProperty("--line", String(line - 1));
        return [made];
      }),
    );
  };
  area.addEventListener("input", () => {
    session.set("text", area.value);
    number();
  });
  area.addEventListener("scroll", () => {
    gutter.scrollTop = area.scrollTop;
    marks.style.transform = `translate(${-area.scrollLeft}px, ${-area.scrollTop}px)`;
  });
  session.hold(() => {
    write(area, session.text, session.undoing); // in every editor what was typed in one, also while it is under way
    area.readOnly = !session.live;
    undo.disabled = !session.live || !session.canUndo;
    redo.disabled = !session.live || !session.canRedo;
    mark(area, "aria-invalid", session.faults.length ? "true" : null);
    number();
    underline();
    if (!session.faults.length) setText(list, session.report);
    const key = JSON.stringify(session.faults);
    if (list.dataset.key === key) return;
    list.dataset.key = key;
    if (!session.faults.length) return;
    list.replaceChildren(
      ...session.faults.map((fault) => {
        const place = fault.line ? `Line ${fault.line}, column ${fault.column}` : fault.place;
        const go = h(
          "button",
          { type: "button", class: "fnb-tex-fault" },
          h("strong", {}, `${place}:`),
          " ",
          h("span", {}, fault.message),
          /^\s*\n/.test(fault.excerpt) ? null : h("pre", {}, fault.excerpt),
        );
        go.addEventListener("click", () => {
          area.focus();
          const at = offsetOf(area.value, fault.line ?? 1, fault.column ?? 1);
          area.setSelectionRange(at, at);
        });
        return go;
      }),
    );
  }, signal);
  return h(
    "section",
    { class: "fnb-tex-editor", "aria-label": "Grammar editor" },
    h("div", { class: "fnb-tex-tools", role: "toolbar", "aria-label": "History" }, undo, redo),
    h(
      "div",
      { class: "fnb-tex-code" },
      gutter,
      area,
      h("div", { class: "fnb-tex-marks", "aria-hidden": "true" }, marks),
    ),
    list,
  );
}
