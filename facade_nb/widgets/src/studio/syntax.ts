// A card of the pattern language: what can be written, what each reflection mode makes of a word, and the keys.

import { h, mark, setText } from "../shared/dom.ts";
import { colourAt } from "../shared/palette.ts";
import type { ModeState } from "../shared/types.ts";
import { nameOf, parsed } from "../solver/letters.ts";

const SIGNS: readonly [written: string, means: string][] = [
  ["A  b2  <front door>", "a symbol: one letter and digits, or a longer name"],
  ["A B", "one beside the other; on y, one above the other"],
  ["A|B", "one or the other"],
  ["(AB)", "a group"],
  ["ε  ()", "nothing"],
  ["A'", "mirrored"],
  ["A^3", "three copies"],
  ["A^k  A^{floors}", "as many as a counter says, which the solver chooses"],
  ["A^-k", "copies of the mirror image"],
  ["cec; c := C", "C stands for c; what is left standing, e, takes up room and draws nothing"],
  ["# …", "a comment"],
];

const KEYS: readonly [key: string, means: string][] = [
  ["Tab, Ctrl+Space", "complete"],
  ["↑ ↓ Enter", "choose"],
  ["Esc", "close"],
];

/** A word, letter by letter: mirrored ones are turned, as the cells they stand for are. */
export function drawWord(word: string): HTMLElement {
  const order = ["E", "k", "G"];
  return h(
    "span",
    { class: "fnb-mode-word", role: "img", "aria-label": word },
    ...parsed(word).map((letter) => {
      const cell = h("i", { class: "fnb-mode-letter", title: nameOf(letter) }, letter.symbol);
      mark(cell, "data-mirrored", letter.mirrored);
      cell.style.setProperty("--fnb-tint", colourAt(Math.max(0, order.indexOf(letter.symbol))));
      return cell;
    }),
  );
}

/** The card; its drawings follow the number of copies that is chosen on it. */
export function syntaxCard(modes: () => readonly ModeState[]): HTMLElement {
  const told = h("output", {});
  const copies = h("input", { type: "range", min: -2, max: 3, step: 1, value: 2, "aria-label": "Copies" });
  const body = h("div", { class: "fnb-modes" });
  const draw = () => {
    setText(told, copies.value.replace("-", "−"));
    body.replaceChildren(
      ...modes().map(({ sign, name, words }) => {
        const text = words[copies.value] ?? "";
        return h(
          "div",
          { class: "fnb-mode", "data-mode": sign },
          h("code", {}, `(EkG)^${sign}${copies.value}`),
          h("span", { class: "fnb-mode-name" }, sign === "" ? "no reflection" : name),
          text === "" ? h("span", { class: "fnb-mode-word" }, "nothing") : drawWord(text),
        );
      }),
    );
  };
  copies.addEventListener("input", draw);
  draw();
  const rows = (list: readonly [string, string][], tag: "code" | "kbd") =>
    list.flatMap(([written, means]) => [h("dt", {}, h(tag, {}, written)), h("dd", {}, means)]);
  return h(
    "div",
    { class: "fnb-syntax" },
    h("h4", {}, "What can be written"),
    h("dl", {}, ...rows(SIGNS, "code")),
    h("h4", {}, "Reflection modes", h("label", { class: "fnb-mode-copies" }, "copies", copies, told)),
    h("p", {}, "A sign after ^ joins each copy with its mirror image. At a pivot both share a letter."),
    body,
    h("h4", {}, "Keys"),
    h("dl", {}, ...rows(KEYS, "kbd")),
  );
}
