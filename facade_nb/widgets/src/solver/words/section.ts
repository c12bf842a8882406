// The table of one pattern's words, each drawn to scale against canvas ± μ, and why it is kept or dropped.

import { h, mark, setText } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { type Quiz, sign } from "../../shared/quiz.ts";
import type { Candidate, Judged } from "../bounds.ts";
import { boxes, type DrawnLetter, spelled } from "../letters.ts";
import { linked, target } from "../links.ts";
import { type Rows, rows } from "../rows.ts";
import type { Axis, PatternInfo } from "../timeline.ts";
import type { ViewContext } from "../view.ts";
import { boundsText, free, keyOf, reasonText, sentence, subscript } from "./sentences.ts";

const HEIGHT = 27;
const MOST = 12;

/** One pattern's table. */
export class Section {
  readonly el: HTMLElement;
  private readonly list: Rows<Candidate>;
  private readonly bounds = h("span", { class: "fnb-eq" });
  private readonly band = h("i", { class: "fnb-band" });
  private readonly ruler: HTMLElement;
  private readonly table: HTMLElement;
  private readonly span: number;
  private shown: Judged | null = null;
  private now = -1;
  private taken: string | null = null;
  private unsized: string[] = [];
  private columns = "";
  private headed = "";
  private by: string | null = null;
  /** Changes with the verdicts and the question. */
  stamp = "";

  constructor(
    private readonly number: number,
    private readonly info: PatternInfo,
    private readonly axis: Axis,
    private readonly canvas: number,
    longest: number,
    private readonly context: ViewContext,
    private readonly quiz: Quiz,
  ) {
    this.span = longest * 1.02;
    this.list = rows<Candidate>(
      {
        height: HEIGHT,
        most: MOST,
        key: (word) => this.keyOf(word),
        make: (word) => this.row(word),
        drawn: () => context.links.apply(this.el),
      },
      context.signal,
    );
    this.ruler = h("div", { role: "row", class: "fnb-word fnb-word-head" });
    this.table = h(
      "div",
      { class: "fnb-word-table", role: "table", "aria-label": `Words of ${info.name}` },
      this.ruler,
      this.list.el,
    );
    const layers = info.layers[axis];
    this.el = h(
      "section",
      { class: "fnb-words-of", "data-pattern": info.name },
      h(
        "header",
        linked([target.pattern(info.name)]),
        h("span", { class: "fnb-words-number" }, `Pattern ${number}`),
        h("code", {}, info.text),
        h(
          "span",
          { class: "fnb-words-layers" },
          `${info.name} · ${layers.length > 1 ? "layers" : "layer"} ${layers.join(", ")}`,
        ),
        this.bounds,
      ),
      this.table,
    );
  }

  /** Bring the word that was picked into sight, also by picking a candidate with it. */
  reveal(picked: ReadonlySet<string>): void {
    const words = this.shown?.words ?? [];
    const { axis, info } = this;
    this.list.reveal(words.findIndex(({ event }) => picked.has(target.word(axis, info.name, event.word))));
  }

  /** Whether it shows that already; from now on it does. */
  is(by: string): boolean {
    const same = by === this.by;
    this.by = by;
    return same;
  }

  show(own: Judged | null, told: number, now: number, taken: string | null): void {
    this.shown = own;
    this.taken = taken;
    this.now = now;
    this.unsized = [...new Set(own?.words.flatMap((word) => Object.keys(word.sizes)) ?? [])];
    this.head(own);
    this.list.set(own?.words ?? [], own?.words.findIndex((word) => word.event.at === now) ?? -1);
    mark(this.el, "data-empty", told === 0);
  }

  private head(own: Judged | null): void {
    const choices = !!own?.words.some((word) => word.event.choices.length);
    const names = [...this.info.counters, ...this.unsized.map((name) => `|${name}|`), ...(choices ? ["choice"] : [])];
    this.columns = `${names.map((name) => (name === "choice" ? "64px" : "28px")).join(" ")} minmax(0, 1fr)`;
    const by = [names, own?.low, own?.high, this.quiz.hides].join("|");
    if (by === this.headed) return;
    this.headed = by;
    this.table.style.setProperty("--fnb-columns", this.columns);
    const index = subscript(this.number);
    const scale = h(
      "div",
      { role: "columnheader", class: "fnb-scale", "aria-label": "drawn to scale" },
      this.band,
      ...this.ticks(own),
    );
    this.ruler.replaceChildren(
      h(
        "div",
        { class: "fnb-word-left", role: "presentation" },
        ...names.map((name) => h("span", { role: "columnheader", class: "fnb-word-value" }, name)),
        h("span", { role: "columnheader" }, "w", index),
      ),
      scale,
      h("span", { role: "columnheader", class: "fnb-word-size" }, "|w", index.cloneNode(true), "|, m"),
      h("span", { role: "columnheader" }, this.quiz.hides ? "fits?" : ""),
    );
    if (!own) {
      setText(this.bounds, "");
      return;
    }
    setText(this.bounds, `${formatNumber(Math.max(own.low, 0), 2)} ≤ |w| ≤ ${formatNumber(own.high, 2)} m`);
    mark(this.bounds, "title", boundsText(own, this.canvas));
    this.place(this.band, own);
  }

  private place(band: HTMLElement, own: Judged): void {
    const low = Math.max(0, own.low);
    band.style.left = `${(100 * low) / this.span}%`;
    band.style.width = `${(100 * (own.high - low)) / this.span}%`;
  }

  private ticks(own: Judged | null): HTMLElement[] {
    const canvas = h("b", { class: "fnb-tick" }, `canvas ${formatNumber(this.canvas)} m`);
    canvas.style.left = `${(100 * this.canvas) / this.span}%`;
    if (!own || own.high <= this.canvas) return [canvas];
    const band = h("b", { class: "fnb-tick fnb-tick-band" }, `± μ ${formatNumber(own.high - this.canvas, 2)}`);
    band.style.left = canvas.style.left;
    return [canvas, band];
  }

  /** A word, and all that its row depends on besides. */
  private keyOf(word: Candidate): string {
    const { at } = word.event;
    const state = `${at === this.now} ${word.event.word === this.taken} ${this.stamp} ${this.columns}`;
    return `${keyOf(this.info.name, word)} ${state}`;
  }

  private row(word: Candidate): HTMLElement {
    const { event, sizes } = word;
    const { symbols } = this.context.timeline.data;
    const own = this.shown as Judged;
    const key = keyOf(this.info.name, word);
    const hides = this.quiz.hides;
    const { state, why } = this.quiz.verdict(key);
    const line = h("i", { class: "fnb-canvas-line" });
    line.style.left = `${(100 * this.canvas) / this.span}%`;
    const band = h("i", { class: "fnb-band" });
    this.place(band, own);
    const drawing = h(
      "div",
      {
        role: "cell",
        class: "fnb-scale",
        "aria-label": `${formatNumber(word.size)} metres of ${formatNumber(this.canvas)}`,
      },
      band,
      ...boxes(this.drawn(word), this.span, symbols),
      line,
    );
    const values = [
      ...this.info.counters.map((name) => formatNumber(event.counters[name])),
      ...this.unsized.map((name) => formatNumber(sizes[name])),
      ...(this.columns && own.words.some((each) => each.event.choices.length) ? [event.choices.join(", ")] : []),
    ];
    const text = h("span", { role: "cell", class: "fnb-word-text" });
    text.append(...spelled(event.letters));
    const row = h(
      "div",
      {
        role: "row",
        class: "fnb-word",
        "data-reason": hides ? null : word.reason,
        "data-now": event.at === this.now,
        "data-taken": event.word === this.taken,
        "data-verdict": state,
        tabindex: 0,
        ...linked([target.word(this.axis, event.pattern, event.word)], [target.pattern(event.pattern)]),
      },
      h(
        "div",
        { class: "fnb-word-left", role: "presentation" },
        ...values.map((value) => h("span", { role: "cell", class: "fnb-word-value" }, value)),
        text,
      ),
      drawing,
      h("span", { role: "cell", class: "fnb-word-size" }, formatNumber(word.size, 2) + (free(word) ? " +" : "")),
      h(
        "span",
        { role: "cell", class: "fnb-word-reason" },
        this.quiz.on && this.quiz.truths.has(key) ? this.box(key, word) : null,
        hides ? null : sign(this.quiz, state),
        hides ? null : reasonText(word, event.word === this.taken, state !== "open"),
      ),
    );
    mark(row, "title", hides ? null : why || sentence(word, own));
    return row;
  }

  private box(key: string, word: Candidate): HTMLElement {
    const box = h("input", { type: "checkbox", "aria-label": `${word.event.word} fits` });
    box.checked = this.quiz.has(key);
    box.disabled = this.quiz.done;
    box.addEventListener("change", () => this.quiz.choose(key));
    return box;
  }

  /** The letters end to end; those that are free share what is left of the canvas. */
  private drawn(word: Candidate): DrawnLetter[] {
    const { letters, pattern } = word.event;
    const open = letters.filter((a) => a.size === null && !(a.symbol in word.sizes)).length;
    const left = open ? Math.max(0, this.canvas - word.size) / open : 0;
    const chosen = this.taken === word.event.word;
    let at = 0;
    return letters.map((letter, n) => {
      const start = at;
      const size = letter.size ?? word.sizes[letter.symbol];
      at += size ?? left;
      // A letter of the word that was taken is one of the layout's; one of another word stands for its symbol only.
      const symbol = target.symbol(letter.symbol);
      const about = [symbol, target.word(this.axis, pattern, word.event.word)];
      const placed = this.info.layers[this.axis].map((layer) => target.letter(this.axis, layer, n));
      const attributes = chosen ? linked(placed, about) : linked([symbol], about);
      return { letter, start, end: at, free: size === undefined, attributes };
    });
  }
}
