// Words as the paper writes them, and drawn to scale. A letter has the colour of its symbol in every view.

import { h } from "../shared/dom.ts";

/** A letter of a word, as the trace tells it. */
export interface LetterNote {
  symbol: string;
  size: number | null;
  transparent: boolean;
  opaque: boolean;
  attached: boolean;
  unoccludable: boolean;
  mirrored: boolean;
}

const HUES = 10;

/** The class that colours a symbol. */
export function hueOf(symbols: Record<string, number>, symbol: string): string {
  return `fnb-hue-${(symbols[symbol] ?? 0) % HUES}`;
}

/** A word in short: equal letters in a run, and groups from three on, are counted; mirrored ones have a dash. `AC⁵A`. */
export function spelled(letters: readonly LetterNote[]): Node[] {
  const keys = letters.map((a) => `${a.symbol}|${a.mirrored}|${a.transparent}`);
  const nodes: Node[] = [];
  for (let n = 0; n < letters.length; ) {
    const [period, times] = repetition(keys, n);
    if (period > 1) nodes.push(document.createTextNode("("));
    for (const one of letters.slice(n, n + period))
      nodes.push(h("span", { class: one.transparent ? "fnb-ghost" : "fnb-solid" }, nameOf(one)));
    if (period > 1) nodes.push(document.createTextNode(")"));
    if (times > 1) nodes.push(h("sup", {}, String(times)));
    n += period * times;
  }
  return nodes.length ? nodes : [document.createTextNode("ε")];
}

/** The letters of a word's text as the trace writes it, `A B' <door>`: what is transparent it does not say. */
export function parsed(word: string): LetterNote[] {
  return (word.match(/<[^>]*>'?|[^\s<]+/g) ?? []).map((text) => ({
    symbol: text.replace(/'$/, "").replace(/^<(.*)>$/, "$1"),
    size: null,
    transparent: false,
    opaque: true,
    attached: false,
    unoccludable: false,
    mirrored: text.endsWith("'"),
  }));
}

export function nameOf({ symbol, mirrored }: Pick<LetterNote, "symbol" | "mirrored">): string {
  return (isShort(symbol) ? symbol : `⟨${symbol}⟩`) + (mirrored ? "′" : "");
}

/** One letter with its marks, then digits. */
const SHORT = /^\p{L}\p{M}*\p{Nd}*$/u;
/** Letters that patterns do not read bare: parts of syllables, lone accents, and raised or ornate forms of letters. */
const FORMS =
  /^[\u1100-\u11ff\ua960-\ua97f\ud7b0-\ud7ff\u02b0-\u02ff\u0374ªº\u1d2c-\u1d6a\u1d78\u1d9b-\u1dbf\u2071\u207f\u2090-\u209c\u210a-\u2131\u2133\u2134\u2139-\u2149\u2c7c\u2c7d\u{1d400}-\u{1d7ff}]/u;

/** Whether patterns write a symbol without angle brackets, as `spell` in facade_nb/design/text.py has it. */
export function isShort(symbol: string): boolean {
  return SHORT.test(symbol) && symbol !== "ε" && !FORMS.test(symbol);
}

/** The repetition that begins at `n`: so many letters, so many times. Groups count from three times on. */
function repetition(keys: readonly string[], n: number): [number, number] {
  let best: [number, number] = [1, 1];
  for (let period = 1; period <= 6 && n + period <= keys.length; period++) {
    let times = 1;
    const again = (from: number) => keys.slice(n, n + period).every((key, i) => keys[from + i] === key);
    while (n + period * (times + 1) <= keys.length && again(n + period * times)) times++;
    if (times >= (period === 1 ? 2 : 3) && period * times > best[0] * best[1]) best = [period, times];
  }
  return best;
}

/** What the looks of letters mean, as far as they occur. */
export function lettersLegend(
  letters: readonly LetterNote[],
  { cut = false, gaps = false, empty = false, free = false }: Record<string, boolean> = {},
): HTMLElement {
  const box = (attributes: Record<string, boolean>, ...content: (Node | string)[]) =>
    h("i", { class: "fnb-box fnb-legend-box fnb-hue-1", ...attributes }, ...content);
  const kinds: [boolean, Node, string][] = [
    [letters.some((a) => a.opaque && !a.transparent), box({}, "A"), "a letter, in its symbol's colour"],
    [letters.some((a) => !a.opaque && !a.transparent), box({ "data-open": true }, "A"), "not opaque"],
    [letters.some((a) => a.transparent), box({ "data-ghost": true }, "a"), "transparent: it may be cut"],
    [letters.some((a) => a.mirrored), box({}, h("i", { class: "fnb-mirrored" }, "B")), "mirrored"],
    [cut, box({ "data-ghost": true, "data-cut": true }, "a", h("sub", {}, "1")), "first piece of a letter that is cut"],
    [free, box({ "data-free": true }), "its size is free"],
    [gaps, h("i", { class: "fnb-legend-sign" }, "γ"), "gap beside a letter that does not fill its column"],
    [empty, h("i", { class: "fnb-legend-sign" }, "ε"), "empty element"],
  ];
  const shown = kinds.filter(([is]) => is).map(([, sign, text]) => h("span", {}, sign, text));
  return h("p", { class: "fnb-legend", role: "note" }, ...shown);
}

export interface DrawnLetter {
  letter: LetterNote;
  /** Metres. */
  start: number;
  end: number;
  /** It has no size of its own: it takes what is left. */
  free: boolean;
  attributes?: Record<string, string | null>;
}

/** Letters as boxes on a line of `span` metres. A name that its box has no room for is not seen. */
export function boxes(drawn: readonly DrawnLetter[], span: number, symbols: Record<string, number>): HTMLElement[] {
  return drawn.map(({ letter, start, end, free, attributes }) => {
    const name = h(letter.mirrored ? "i" : "b", { class: letter.mirrored ? "fnb-mirrored" : null }, letter.symbol);
    const box = h(
      "span",
      {
        class: `fnb-box ${hueOf(symbols, letter.symbol)}`,
        "data-ghost": letter.transparent,
        "data-open": !letter.opaque && !letter.transparent,
        "data-free": free,
        ...attributes,
      },
      name,
    );
    box.style.left = `${((100 * start) / span).toFixed(3)}%`;
    box.style.width = `${((100 * (end - start)) / span).toFixed(3)}%`;
    return box;
  });
}
