// What stands beside the network: the columns that leave the node that is looked at, and the question's choices.

import { h } from "../../dom.ts";
import { formatNumber } from "../../fields.ts";
import type { LetterNote } from "../letters.ts";
import { linked, target } from "../links.ts";
import type { Arc } from "./scene.ts";
import { restOf, type Subject } from "./story.ts";

const MOST = 40;

/** A column as it stands in the alignment: an element of each word, ε where it is empty. */
export function columnText(subject: Subject, column: readonly (readonly number[] | null)[], to: readonly number[]) {
  return h(
    "span",
    { class: "fnb-net-column" },
    ...column.map((letters, b) => {
      if (letters === null) return h("span", { class: "fnb-net-element" }, "∗");
      if (!letters.length) return h("span", { class: "fnb-net-element fnb-muted" }, "ε");
      const cut = ((to[b] ?? 0) & 1) === 1;
      const names = letters.map((n) => name(subject.bands[b]?.letters[n])).join("");
      const short = names.length > 9 ? `${names.slice(0, 8)}…` : names;
      return h("span", { class: "fnb-net-element", title: names }, short + (cut ? "…" : ""));
    }),
  );
}

const name = (letter: LetterNote | undefined): string =>
  letter ? (letter.symbol.length > 2 ? `⟨${letter.symbol}⟩` : letter.symbol) + (letter.mirrored ? "′" : "") : "";

/** The columns that leave a node, those that may come next first. */
export function leavingList(subject: Subject, places: readonly number[], arcs: readonly Arc[]): HTMLElement {
  const permitted = arcs.filter((arc) => !arc.constraint);
  const forbidden = arcs.filter((arc) => arc.constraint);
  const shown = [...permitted.slice(0, MOST), ...forbidden.slice(0, MOST)];
  const rests = subject.bands.map((band, b) => restOf(band, places[b] ?? 0));
  return h(
    "div",
    { class: "fnb-net-leaving" },
    h(
      "h4",
      {},
      "At ",
      h("code", {}, rests.map((rest) => (rest.length > 14 ? `${rest.slice(0, 13)}…` : rest)).join(" / ")),
      h("span", { class: "fnb-muted" }, ` ${permitted.length} edges permitted, ${forbidden.length} forbidden`),
    ),
    h(
      "ul",
      {},
      ...shown.map((arc) =>
        h(
          "li",
          {
            class: "fnb-net-edge",
            tabindex: 0,
            "data-constraint": arc.constraint || null,
            "data-path": arc.kind === "path",
            ...linked([arc.key]),
          },
          columnText(subject, arc.column, arc.to),
          h("span", { class: "fnb-net-omega" }, arc.omega === null ? "" : `ω ${formatNumber(arc.omega, 2)}`),
          h("span", { class: "fnb-net-why" }, arc.constraint ? `✕ ${arc.text}` : arc.text),
        ),
      ),
    ),
    arcs.length > shown.length ? h("p", { class: "fnb-muted" }, `… ${arcs.length - shown.length} more`) : null,
  );
}

/** The letters of a network's words that some targets light, as band:number. */
export function litLetters(subject: Subject, keys: ReadonlySet<string>): Set<string> {
  const found = new Set<string>();
  if (!keys.size) return found;
  const layers = subject.path?.layers ?? [];
  for (const [b, band] of subject.bands.entries())
    for (const [n, letter] of band.letters.entries()) {
      const own = [
        target.symbol(letter.symbol),
        ...band.rows.map((row) => target.letter(subject.axis, layers[row] ?? "", n)),
      ];
      if (own.some((key) => keys.has(key))) found.add(`${b}:${n}`);
    }
  return found;
}
