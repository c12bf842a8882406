// The words that a pattern can make at this canvas: a few of them, each kept, or why it is not.

import { h, mark } from "../shared/dom.ts";
import { formatNumber } from "../shared/fields.ts";
import type { AxisWords, PatternWords, WordState } from "../shared/stage.ts";
import { nameOf } from "../solver/letters.ts";

const WAYS = { x: "across", y: "upwards" } as const;
const DRAWN = 40;

const TITLES: Partial<Record<WordState["reason"], string>> = {
  fits: "Kept; another word costs less together with the other rows",
  looser: "Kept; the chosen word fits the canvas closer",
  "left out": "There are so many words that only the nearest to the canvas are looked at",
  "no partner": "Another pattern with this counter has no word of that count",
};

/** Why a word stands in the list, in a word or two. */
export function reasonOf({ reason, bound, miss }: Pick<WordState, "reason" | "bound" | "miss">): string {
  const metres = `${formatNumber(miss, 2)} m`;
  switch (reason) {
    case "chosen":
      return "chosen";
    case "looser":
      return `looser fit, ${metres} off`;
    case "fits":
      return "fits";
    case "range":
      return `not kept: beyond ${bound}`;
    case "left out":
      return "left out: too many";
    case "no partner":
      return `no partner${bound ? ` with this ${bound}` : ""}`;
    default:
      return `not kept: ${reason}`;
  }
}

/** The list, one part for each axis. */
export function wordList(
  name: string,
  told: PatternWords | undefined,
  colour: (symbol: string) => string,
): HTMLElement {
  if (!told) return h("p", { class: "fnb-words-note" }, "Listing the words…");
  if (told.note) return h("p", { class: "fnb-words-note" }, told.note);
  return h("div", {}, ...told.axes.map((axis) => axisList(name, axis, colour)));
}

function axisList(
  name: string,
  { axis, canvas, low, high, words, more }: AxisWords,
  colour: (symbol: string) => string,
) {
  const reach = Math.max(high, ...words.map(({ size }) => size));
  const least = low > 0 ? `from ${formatNumber(low, 2)} ` : "";
  return h(
    "div",
    { class: "fnb-words-axis" },
    h(
      "p",
      { class: "fnb-words-note" },
      `${WAYS[axis]}, ${formatNumber(canvas, 2)} m; kept are words ${least}to ${formatNumber(high, 2)} m`,
    ),
    h(
      "ul",
      { "aria-label": `Words of ${name} ${WAYS[axis]}` },
      ...words.map((word) => {
        const bar = h("span", { class: "fnb-word-bar" }, h("i", {}), h("b", {}));
        bar.style.setProperty("--fnb-size", `${(100 * word.size) / reach}%`);
        bar.style.setProperty("--fnb-canvas", `${(100 * canvas) / reach}%`);
        const row = h(
          "li",
          { class: "fnb-word-row", "data-reason": word.reason, "aria-current": word.reason === "chosen" && "true" },
          strip(name, axis, word, colour),
          h("span", { class: "fnb-word-size" }, word.open ? "any size" : `${formatNumber(word.size, 2)} m`),
          bar,
          h("span", { class: "fnb-word-reason" }, reasonOf(word)),
        );
        const counters = Object.entries(word.counters).map(([counter, value]) => `${counter} = ${value}`);
        mark(row, "title", [counters.join(", "), TITLES[word.reason]].filter(Boolean).join(". "));
        return row;
      }),
      more > 0 ? h("li", { class: "fnb-words-more" }, `and ${more} more that ${more === 1 ? "is" : "are"} kept`) : null,
    ),
  );
}

/** A word letter by letter. Each says where in the text it comes from; those of the chosen one, which it is. */
function strip(name: string, axis: "x" | "y", word: WordState, colour: (symbol: string) => string): HTMLElement {
  const shown = word.letters.slice(0, DRAWN);
  const left = word.left + word.letters.length - shown.length;
  return h(
    "span",
    { class: "fnb-word-letters" },
    ...shown.map(([symbol, flags, place], index) => {
      const letter = h("i", {}, nameOf({ symbol, mirrored: flags.includes("m") }));
      letter.style.setProperty("--fnb-tint", colour(symbol));
      mark(letter, "data-letter", symbol);
      mark(letter, "data-ghost", flags.includes("t"));
      if (place >= 0) {
        mark(letter, "data-pattern", name);
        mark(letter, "data-place", String(place));
        mark(letter, "data-axis", axis);
        if (word.reason === "chosen") mark(letter, "data-index", String(index));
      }
      return letter;
    }),
    word.letters.length === 0 ? "ε" : null,
    left > 0 ? h("small", {}, ` and ${left} more letters`) : null,
  );
}
