// Words: for each pattern the table of its counters and choices, every word drawn to scale against canvas ± μ, kept or
// dropped and why (the paper's 5.1, Eq. 7). With sampled sizes of unsized symbols it is the paper's Figure 7.

import { focused, h, mark, setText } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { Quiz, sign, type Truth } from "../../shared/quiz.ts";
import { stepByKeys } from "../../shared/stepping.ts";
import { AxisChoice } from "../axes.ts";
import { type Candidate, combined, type GroupNote, inOrder, type Judged, judge, type WordEvent } from "../bounds.ts";
import { boxes, type DrawnLetter, lettersLegend, spelled } from "../letters.ts";
import { linked, target } from "../links.ts";
import { type Rows, rows } from "../rows.ts";
import { type Axis, type PatternInfo, played } from "../timeline.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";

interface Posed {
  event: "AxisPosed";
  at: number;
  axis: Axis;
  canvas: number;
  groups: GroupNote[];
}
type Told = { event: "WordJudged"; axis: Axis } & WordEvent;

const HEIGHT = 27;
const MOST = 12;
const TUPLES = 24;
const LONGEST = 1.4; // words are drawn up to so many times canvas + μ, and cut off there

/** The words of an axis that were told at one tolerance. */
interface Round {
  first: number;
  tolerance: number;
  words: Map<string, WordEvent[]>;
}

class Story {
  readonly posed: Posed | undefined;
  readonly rounds: Round[] = [];

  constructor(events: readonly (Posed | Told)[], axis: Axis) {
    const own = events.filter((event) => event.axis === axis);
    this.posed = own.find((event): event is Posed => event.event === "AxisPosed");
    for (const event of own) {
      if (event.event !== "WordJudged") continue;
      let round = this.rounds.at(-1);
      if (!round || round.tolerance !== event.tolerance) {
        round = { first: event.at, tolerance: event.tolerance, words: new Map() };
        this.rounds.push(round);
      }
      const list = round.words.get(event.pattern) ?? [];
      list.push(event);
      round.words.set(event.pattern, list);
    }
  }

  /** The tolerance that is tried at a position; before the first, the first. */
  roundAt(position: number): Round | undefined {
    return this.rounds.findLast((round) => round.first <= position) ?? this.rounds[0];
  }
}

export const words: ViewKind = {
  title: "Words",
  subtitle: "What each pattern can write, against the canvas (Eq. 7)",
  needs: ["words"],
  make: (context) => new WordsView(context),
};

interface Asked {
  by: string;
  truths: ReadonlyMap<string, Truth>;
  hint: string;
}

class WordsView implements View {
  readonly el = h("div", { class: "fnb-words" });
  readonly controls: HTMLElement[];
  readonly quiz: Quiz;
  private readonly stories: Record<Axis, Story>;
  private readonly choice: AxisChoice;
  private readonly tolerance = h("input", {
    type: "text",
    inputmode: "decimal",
    class: "fnb-number fnb-mu",
    "aria-label": "Tolerance μ in metres",
  });
  private readonly step = h("input", {
    type: "text",
    inputmode: "decimal",
    class: "fnb-number fnb-mu",
    "aria-label": "Step in metres at which unsized symbols are sampled; empty: they are free",
  });
  private mu: number | null = null;
  private sample: number | null;
  private sections = new Map<string, Section>();
  /** The sections of both axes: long tables stay as they are while the other axis is spoken of. */
  private readonly built: Partial<Record<Axis, Map<string, Section>>> = {};
  private readonly said = h("p", { class: "fnb-alternative", role: "status", hidden: true });
  private readonly note = h("p", { class: "fnb-empty" });
  private readonly tuples = h("div", { class: "fnb-tuples" });
  private axis: Axis | null = null;
  private judged = new Map<string, Judged>();
  private judgedBy = "";
  private askedOf: Asked | null = null;
  private picked = "";
  private tuplesBy: string | null = null;

  constructor(private readonly context: ViewContext) {
    const { events } = context.pieces.words as { events: (Posed | Told)[] };
    this.stories = { x: new Story(events, "x"), y: new Story(events, "y") };
    this.choice = new AxisChoice(context.timeline, context.refresh, context.alternatives);
    this.mu = context.model.get<number | null>("tolerance") ?? null;
    this.sample = context.model.get<number | null>("step") ?? null;
    this.step.value = formatNumber(this.sample);
    const field = (label: string, input: HTMLInputElement, take: (value: number | null) => void) => {
      stepByKeys(input, { step: 0.05, min: 0 });
      input.addEventListener("input", () => {
        const value = Number(input.value.replace(",", "."));
        const empty = input.value.trim() === "";
        const bad = !empty && !(value >= 0 && Number.isFinite(value));
        mark(input, "aria-invalid", bad ? "true" : null);
        if (bad) return;
        take(empty ? null : value);
        context.refresh();
      });
      return h("label", { class: "fnb-field" }, label, input, "m");
    };
    this.controls = [
      this.choice.el,
      field("μ", this.tolerance, (value) => {
        this.mu = value;
      }),
      field("step", this.step, (value) => {
        this.sample = value || null;
      }),
    ];
    const prompt = "Which words fit? Tick them; the shaded band is canvas ± μ.";
    this.quiz = new Quiz(() => {
      const from = context.timeline.begins("words", this.choice.at(context.player.position));
      return [{ prompt, hint: this.asked().hint, truths: () => this.asked().truths, from }];
    });
  }

  show(position: number): void {
    const axis = this.choice.at(position);
    const story = this.stories[axis];
    const round = story.roundAt(position);
    if (axis !== this.axis) this.build(axis, story);
    const { alternatives } = this.context;
    const other = alternatives.at(position, axis);
    setText(this.said, other ? `${other.name}. ${other.fate} Its words are marked.` : alternatives.trouble);
    this.said.hidden = !this.said.textContent;
    const started = round !== undefined && round.first <= position;
    // Whether another pattern has a word for it is seen only where all words are: a question is of all of them.
    const all = this.quiz.on && !!round;
    setText(this.note, this.told(axis, story, round, started));
    this.note.hidden = started || all;
    if (!round || !story.posed) {
      for (const section of this.sections.values()) if (!section.is("")) section.show(null, 0, -1, null);
      this.tuples.replaceChildren();
      return;
    }
    const mu = Math.min(this.mu ?? round.tolerance, round.tolerance);
    if (focused(this.tolerance) !== this.tolerance) this.tolerance.value = formatNumber(mu);
    mark(
      this.tolerance,
      "title",
      `The solver's own: ${formatNumber(round.tolerance)} m. A smaller one is tried here only.`,
    );
    this.judgeAt(axis, story.posed, round, mu);
    const stamp = `${this.judgedBy}|${this.quiz.stamp}`;
    const chosen = this.context.timeline.data.chosen[axis];
    for (const [pattern, section] of this.sections) {
      const own = this.judged.get(pattern);
      const told = round.words.get(pattern) ?? [];
      const at = told.map((event) => event.at);
      const seen = all ? told.length : started ? played(at, position) : 0;
      const now = !all && told[seen - 1]?.at === position ? position : -1;
      const taken = chosen && chosen.at <= position && !this.quiz.hides ? (chosen.words[pattern] ?? null) : null;
      if (section.is(`${stamp}|${seen}|${now}|${taken}`)) continue;
      section.stamp = stamp;
      section.show(
        own ? { ...own, words: own.words.filter((word) => all || word.event.at <= position) } : null,
        told.length,
        now,
        taken,
      );
    }
    this.showTuples(axis, position, round, stamp);
  }

  light(): void {
    const { links } = this.context;
    const picked = [...links.picked];
    if (picked.join() !== this.picked) {
      this.picked = picked.join();
      for (const section of this.sections.values()) section.reveal(links.picked);
    }
    links.apply(this.el);
  }

  /** The verdicts: the solver's own at its tolerance, else by the same rule. */
  private judgeAt(axis: Axis, posed: Posed, round: Round, mu: number): void {
    const by = [axis, round.first, mu, this.sample].join();
    if (by === this.judgedBy) return;
    this.judgedBy = by;
    this.judged = judge(round.words, posed.groups, posed.canvas, mu, this.sample);
    if (mu !== round.tolerance || this.sample !== null) return;
    for (const own of this.judged.values())
      for (const word of own.words) word.reason = word.event.reason as Candidate["reason"];
  }

  private build(axis: Axis, story: Story): void {
    this.axis = axis;
    this.tuplesBy = null;
    const { timeline } = this.context;
    const before = this.built[axis];
    this.sections = before ?? new Map();
    this.built[axis] = this.sections;
    const letters = story.rounds.flatMap((round) => [...round.words.values()].flat().flatMap((word) => word.letters));
    const legend = lettersLegend(letters, { free: letters.some(({ size }) => size === null) });
    const swap = () =>
      this.el.replaceChildren(
        this.said,
        this.note,
        ...[...this.sections.values()].map((section) => section.el),
        this.tuples,
        legend,
      );
    if (before) {
      swap();
      return;
    }
    const order = inOrder(story.posed?.groups ?? []);
    const canvas = story.posed?.canvas ?? timeline.data.canvas[axis];
    const most = canvas + Math.max(...story.rounds.map((round) => round.tolerance), 0);
    const sizes = story.rounds.flatMap((round) => [...round.words.values()].flat().map((word) => word.size));
    const longest = Math.max(most, Math.min(Math.max(0, ...sizes), LONGEST * most));
    for (const [n, name] of order.entries()) {
      const info = timeline.data.patterns.find((pattern) => pattern.name === name);
      if (info) this.sections.set(name, new Section(n + 1, info, axis, canvas, longest, this.context, this.quiz));
    }
    swap();
  }

  private told(axis: Axis, story: Story, round: Round | undefined, started: boolean): string {
    if (!story.posed) return `The ${axis} axis was not solved.`;
    if (!round) return "The trace tells no words of this axis: there was no layout before any were made.";
    return started ? "" : "No word has been judged yet: play on, or go to the stage Words.";
  }

  private showTuples(axis: Axis, position: number, round: Round, stamp: string): void {
    const all = [...this.judged.values()];
    const told = [...round.words.values()].every((list) => (list.at(-1)?.at ?? 0) <= position);
    const shows = told && !this.quiz.hides && all.length > 0;
    const by = shows ? stamp : "";
    if (by === this.tuplesBy) return;
    this.tuplesBy = by;
    if (!shows) {
      this.tuples.replaceChildren();
      return;
    }
    const { tuples, more } = combined(all, TUPLES);
    this.tuples.replaceChildren(tupleTable([...this.judged.keys()], tuples, more, axis));
  }

  /** What the question is of; each row asks for it, and it stays until words are judged anew. */
  private asked(): Asked {
    if (this.askedOf?.by !== this.judgedBy)
      this.askedOf = { by: this.judgedBy, truths: this.truths(), hint: this.hint() };
    return this.askedOf;
  }

  private truths(): ReadonlyMap<string, Truth> {
    const found = new Map<string, Truth>();
    for (const [pattern, own] of this.judged)
      for (const word of own.words)
        if (canBeAsked(word, own))
          found.set(keyOf(pattern, word), { right: word.reason === "fits", why: sentence(word, own) });
    return found;
  }

  private hint(): string {
    const all = [...this.judged.values()];
    const open = all.some(({ words }) => words.some(free));
    const shared = all.some(({ words }) => words.some((word) => word.reason === "no partner"));
    const parts = [
      "the length of a word stands at its right, and what it may be beside the pattern.",
      open ? "Where it ends with +, letters without a size take what is left: such a word is never too short." : "",
      shared
        ? "And a word needs a partner: every pattern with the same counters must have one with the same values."
        : "",
    ];
    return parts.filter(Boolean).join(" ");
  }
}

/** Whether what is shown says how a word stands: a length that is rounded to its bound does not. */
function canBeAsked({ size, reason }: Candidate, { low, high }: Judged): boolean {
  const near = [low, high].some((bound) => Math.abs(size - bound) > 1e-9 && Math.abs(size - bound) < 0.006);
  return reason !== "left out" && !near;
}

const keyOf = (pattern: string, word: Candidate): string =>
  [pattern, word.event.at, ...Object.values(word.sizes)].join("|");

/** One pattern's table. */
class Section {
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

const free = (word: Candidate): boolean => word.event.letters.some((a) => a.size === null && !(a.symbol in word.sizes));

/** @param bare without a sign: before it stands whether the reader was right */
function reasonText(word: Candidate, taken: boolean, bare: boolean): string {
  if (taken && word.reason === "fits") return bare ? "fits, taken" : "✓ fits, taken";
  const by = word.missed ? ` by ${formatNumber(word.missed, 2)}` : "";
  const signed = word.reason === "fits" ? "✓ " : word.reason === "no partner" ? "– " : "✕ ";
  return `${bare ? "" : signed}${word.reason}${by}`;
}

function sentence(word: Candidate, own: Judged): string {
  const size = formatNumber(word.size, 2);
  switch (word.reason) {
    case "too long":
      return `${size} m is longer than canvas + μ = ${formatNumber(own.high, 2)} m.`;
    case "too short":
      return `${size} m is shorter than ${formatNumber(own.low, 2)} m, which is all that can be left open.`;
    case "no partner":
      return "It fits, but another pattern has no word with these values of the counters.";
    case "left out":
      return "The pattern has more words than can be looked at.";
    default:
      return free(word) ? `${size} m is sized; unsized letters take what is left.` : `${size} m is within the bounds.`;
  }
}

function boundsText(own: Judged, canvas: number): string {
  const push = own.push ? `, less ${formatNumber(own.push, 2)} m that opaque letters above may push aside` : "";
  return `Eq. 7: the canvas of ${formatNumber(canvas)} m, ± μ = ${formatNumber(own.high - canvas, 3)} m${push}.`;
}

function subscript(number: number): HTMLElement {
  return h("sub", {}, String(number));
}

/** “Candidates for alignment”: one column each, as in the paper's figure. */
function tupleTable(patterns: string[], tuples: Candidate[][], more: boolean, axis: Axis): HTMLElement {
  const counters = [...new Set(tuples.flatMap((tuple) => tuple.flatMap((word) => Object.keys(word.event.counters))))];
  const sampled = [...new Set(tuples.flatMap((tuple) => tuple.flatMap((word) => Object.keys(word.sizes))))];
  const value = (tuple: Candidate[], name: string) =>
    formatNumber(tuple.find((word) => name in word.event.counters)?.event.counters[name]);
  const size = (tuple: Candidate[], name: string) =>
    formatNumber(tuple.find((word) => name in word.sizes)?.sizes[name]);
  const body: HTMLElement[] = [];
  if (counters.length)
    body.push(
      h(
        "tr",
        {},
        h("th", {}, counters.length > 1 ? `(${counters.join(", ")})` : (counters[0] ?? "")),
        ...tuples.map((tuple) => {
          const values = counters.map((name) => value(tuple, name));
          return h("td", {}, values.length > 1 ? `(${values.join(", ")})` : values.join());
        }),
      ),
    );
  for (const name of sampled)
    body.push(h("tr", {}, h("th", {}, `|${name}|`), ...tuples.map((tuple) => h("td", {}, size(tuple, name)))));
  for (const [n, pattern] of patterns.entries())
    body.push(
      h(
        "tr",
        {},
        h("th", { title: pattern }, "w", subscript(n + 1)),
        ...tuples.map((tuple) => {
          const word = tuple[n] as Candidate;
          const cell = h("td", linked([target.word(axis, pattern, word.event.word)]));
          cell.append(...spelled(word.event.letters));
          return cell;
        }),
      ),
    );
  const count = more ? `the first ${tuples.length}` : String(tuples.length);
  return h(
    "div",
    { class: "fnb-tuple-box" },
    h("h4", {}, `Candidates for alignment (${count})`),
    tuples.length
      ? h("div", { class: "fnb-tuple-scroll" }, h("table", {}, h("tbody", {}, ...body)))
      : h("p", { class: "fnb-empty" }, "No words agree on their counters."),
  );
}
