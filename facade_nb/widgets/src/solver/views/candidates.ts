// Candidates: one word of each pattern under one value of each counter, and what became of each (the paper's 5.1). The
// table sorts and filters; a candidate that is chosen is marked in all other views.

import { focused, h, mark, setText } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { Quiz, sign, type Truth } from "../../shared/quiz.ts";
import { type CandidateNote as Candidate, proven } from "../alternatives.ts";
import { AxisChoice } from "../axes.ts";
import { filter } from "../filter.ts";
import { parsed, spelled } from "../letters.ts";
import { linked, target } from "../links.ts";
import { type Rows, rows } from "../rows.ts";
import type { Axis } from "../timeline.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";

const HEIGHT = 27;
const MOST = 14;
const STACKED = 47; // pixels of a row whose words stand on a line of their own
const FEWER = 9;
const WORD = 90; // pixels that a word has at least beside the figures
const GAP = 8;
const BAR = 24;

const FATES: Record<string, string> = {
  best: "It is the layout.",
  tied: "It costs as little as the best; that one has more columns, or deviates less after sizing.",
  dearer: "It was aligned, and costs more than the best.",
  bound: "It was not aligned to the end: what it costs at least is no better than what is known.",
  "no alignment": "No alignment keeps the tolerance and the constraints.",
  "no sizes": "It was aligned, but no sizes keep all bounds.",
  "other axis": "It was aligned, but the other axis has nothing for these counters.",
  stopped: "The search was cut short before it was decided.",
};
const SIGNS: Record<string, string> = { best: "★", tied: "☆", dearer: "○", bound: "·", stopped: "…" };

interface Column {
  name: string;
  label: string;
  title: string;
  width: string;
  value(own: Candidate): number | string | null;
  /** Whether it would give the answer away. */
  tells?: boolean;
  /** What is told of it while the view asks; without it the same as always, or, if it tells, nothing. */
  asked?(own: Candidate): number | null;
  /** What it is called while the view asks. */
  askedLabel?: string;
  digits?: number;
}

const METRICS: Column[] = [
  {
    name: "J",
    label: "J",
    title: "What it costs, metres: see the objective",
    width: "44px",
    value: (own) => own.cost,
    tells: true,
    // J is Ω and this: the reader adds them up
    asked: (own) => (own.cost === null || own.omega === null ? null : own.cost - own.omega),
    askedLabel: "J − Ω",
  },
  {
    name: "omega",
    label: "Ω",
    title: "Alignment error Ω = Σ ωⱼ, metres",
    width: "44px",
    value: (own) => own.omega,
  },
  {
    name: "columns",
    label: "cols",
    title: "Columns of its alignment, all groups",
    width: "36px",
    value: (own) => own.columns,
    tells: true,
  },
  {
    name: "deviation",
    label: "dev.",
    title: "√Σ (size − preferred)² after sizing, metres",
    width: "44px",
    value: (own) => own.deviation,
    tells: true,
  },
  {
    name: "bound",
    label: "J ≥",
    title:
      "What has been proven of it, metres: J is at least that, by its sizes or by what the search has gone through",
    width: "44px",
    value: (own) => proven(own),
    tells: true,
    asked: (own) => (own.cost === null ? proven(own) : null),
  },
  {
    name: "tolerance",
    label: "μ",
    title: "Tolerance it was aligned at, metres",
    width: "46px",
    value: (own) => own.tolerance,
  },
];

export const candidates: ViewKind = {
  title: "Candidates",
  subtitle: "One word of each pattern, and what became of it",
  needs: ["candidates"],
  make: (context) => new CandidatesView(context),
};

class CandidatesView implements View {
  readonly el = h("div", { class: "fnb-candidates" });
  readonly controls: HTMLElement[];
  readonly quiz: Quiz;
  private readonly told: Record<Axis, Candidate[]>;
  private readonly asked: Partial<Record<Axis, ReadonlyMap<string, Truth>>> = {};
  private readonly choice: AxisChoice;
  private readonly list: Rows<Candidate>;
  private readonly head = h("div", { role: "row", class: "fnb-candidate fnb-candidate-head" });
  private readonly note = h("p", { class: "fnb-empty" });
  private readonly count = h("span", { class: "fnb-muted", role: "status" });
  private readonly legend = h("p", { class: "fnb-legend", role: "note" });
  private readonly typed = h("input", {
    type: "search",
    class: "fnb-filter",
    placeholder: "filter: best, k=3, J<1",
    "aria-label": "Filter candidates: text, or comparisons such as k=3 or J<1",
  });
  private sorted: { name: string; down: boolean } = { name: "number", down: false };
  private columns: Column[] = [];
  private now = -1;
  private scale = 1;
  private axis: Axis | null = null;
  private headed = "";
  private explained = "";
  private by = "";
  /** Pixels that there are; 0 where that is not known. */
  private width = 0;
  /** Whether there is no room for the words beside the figures: then they stand below them. */
  private stacked = false;

  constructor(private readonly context: ViewContext) {
    const { events } = context.pieces.candidates as { events: Candidate[] };
    this.told = { x: events.filter((each) => each.axis === "x"), y: events.filter((each) => each.axis === "y") };
    this.choice = new AxisChoice(context.timeline, context.refresh, context.alternatives);
    this.typed.addEventListener("input", context.refresh);
    this.controls = [this.choice.el, this.typed];
    const tall = () => (this.stacked ? STACKED : HEIGHT);
    const most = () => (this.stacked ? FEWER : MOST);
    this.list = rows<Candidate>(
      {
        get height() {
          return tall();
        },
        get most() {
          return most();
        },
        key: (own) => `${own.axis}${own.number} ${own.at === this.now} ${this.quiz.stamp}`,
        make: (own) => this.row(own),
        drawn: () => context.links.apply(this.el),
      },
      context.signal,
    );
    const table = h(
      "div",
      { role: "table", "aria-label": "Candidates", class: "fnb-candidate-table" },
      this.head,
      this.list.el,
    );
    this.el.append(
      h("div", { class: "fnb-candidate-scroll" }, table),
      this.note,
      h("div", { class: "fnb-candidate-foot" }, h("p", { class: "fnb-candidate-count" }, this.count), this.legend),
    );
    this.quiz = new Quiz(() => {
      const truths = this.truths();
      return truths.size > 1
        ? [
            {
              prompt: "Which candidate becomes the layout?",
              hint:
                "J is what counts: add Ω and J − Ω of each that was aligned. Of the others J ≥ is proven; they are out " +
                "where that is no less than the least J. A click on a column's name sorts by it.",
              truths: () => truths,
              single: true,
              from: context.timeline.begins("words", this.choice.at(context.player.position)), // words that are taken
            },
          ]
        : [{ prompt: "There are no two candidates to choose from.", hint: "", truths: () => new Map() }];
    });
    const observer = new ResizeObserver(() => {
      this.width = this.el.clientWidth;
      if (this.narrow() !== this.stacked) context.refresh();
    });
    observer.observe(this.el);
    context.signal.addEventListener("abort", () => observer.disconnect());
  }

  show(position: number): void {
    const axis = this.choice.at(position);
    const own = this.told[axis];
    // A prediction is made before anything is known: it is of all candidates.
    const seen = this.quiz.hides ? own : own.filter((each) => each.at <= position);
    const now = !this.quiz.hides && seen.at(-1)?.at === position ? position : -1;
    if (axis !== this.axis) {
      this.axis = axis;
      this.scale = Math.max(1e-9, ...own.map((each) => Math.max(each.cost ?? 0, proven(each))).filter((n) => n < 1e6));
      this.columns = this.columnsOf(own);
      this.headed = this.by = "";
    }
    this.stacked = this.narrow();
    const { name, down } = this.sorted;
    const by = [axis, seen.length, now, this.quiz.stamp, this.typed.value, name, down, this.stacked].join("|");
    if (by === this.by) return;
    this.by = by;
    this.now = now;
    mark(this.el, "data-stacked", this.stacked);
    const holds = filter(this.typed.value);
    const shown = seen.filter((each) => holds(filterable(each, this.quiz.hides)));
    this.sort(shown);
    this.drawHead(own);
    this.list.set(
      shown,
      shown.findIndex((each) => each.at === now),
    );
    const empty = own.length
      ? "No candidate is judged yet: play on, or go to Candidates."
      : "The trace tells no candidates of this axis.";
    setText(this.note, seen.length ? "No candidate passes the filter." : empty);
    this.note.hidden = shown.length > 0;
    const whole = `${own.length} candidate${own.length === 1 ? "" : "s"}`;
    const kinds = this.quiz.hides ? "" : axis;
    if (kinds !== this.explained) {
      this.explained = kinds;
      this.legend.replaceChildren(...(kinds && own.length ? barLegend(own) : []));
    }
    setText(this.count, shown.length < own.length ? `${shown.length} of ${whole}` : whole);
  }

  private columnsOf(own: readonly Candidate[]): Column[] {
    const counters = [...new Set(own.flatMap((each) => Object.keys(each.counters)))];
    return [
      {
        name: "number",
        label: "#",
        title: "The order in which they are told",
        width: "38px",
        tells: true,
        value: (each) => each.number,
      },
      {
        name: "fate",
        label: "fate",
        title: "What became of it",
        width: "96px",
        value: (each) => each.fate,
        tells: true,
      },
      ...counters.map(
        (name): Column => ({
          name,
          label: name,
          title: `Counter ${name}`,
          width: "32px",
          value: (each) => each.counters[name] ?? null,
        }),
      ),
      ...METRICS.filter((each) => each.name !== "tolerance" || new Set(own.map((one) => one.tolerance)).size > 1),
    ];
  }

  private patterns(): string[] {
    return Object.keys((this.axis ? this.told[this.axis][0] : undefined)?.words ?? {});
  }

  /** Pixels of the figures. */
  private figures(): number {
    return this.columns.reduce((sum, { width }) => sum + Number.parseFloat(width) + GAP, 2 * 12);
  }

  private narrow(): boolean {
    return this.width > 0 && this.width < this.figures() + 80 + this.patterns().length * (WORD + GAP);
  }

  private sort(shown: Candidate[]): void {
    const { name, down } = this.sorted;
    const column = this.columns.find((each) => each.name === name);
    const asked = this.quiz.hides && column?.tells ? column.asked : undefined;
    const value = asked ?? (column ? column.value : (each: Candidate) => each.words[name] ?? null);
    // In the order in which they are told the best often comes first.
    // Nor do rows change places when the answer is told.
    const hidden = (this.quiz.hides && column?.tells && !asked) || (this.quiz.on && name === "number");
    const order = (a: Candidate, b: Candidate): number => {
      const [x, y] = [value(a), value(b)];
      if (x === y) return a.number - b.number;
      if (x === null) return 1; // what is not known comes last, either way
      if (y === null) return -1;
      return (x < y ? -1 : 1) * (down ? -1 : 1);
    };
    shown.sort(hidden ? byCounters : order);
  }

  private drawHead(own: readonly Candidate[]): void {
    const { hides } = this.quiz;
    const by = [this.sorted.name, this.sorted.down, this.stacked, hides].join();
    if (by === this.headed) return;
    this.headed = by;
    const patterns = this.patterns();
    const figures = this.columns.map((each) => each.width);
    const words = (least: number) => patterns.map((name) => `minmax(${least}px, ${widest(own, name)}fr)`);
    const columns = this.stacked ? [...figures, `minmax(${BAR}px, 1fr)`] : [...figures, "80px", ...words(WORD)];
    this.el.style.setProperty("--fnb-columns", columns.join(" "));
    this.el.style.setProperty("--fnb-words", words(0).join(" "));
    this.el.style.setProperty("--fnb-figures", `${this.figures() + BAR}px`);
    const sorter = (name: string, label: string, title: string, number: boolean) => {
      const active = this.sorted.name === name;
      const sort = h(
        "button",
        { type: "button", class: "fnb-sort", title, "data-number": number },
        label,
        active ? (this.sorted.down ? " ▾" : " ▴") : "",
      );
      sort.addEventListener("click", () => {
        this.sorted = { name, down: active && !this.sorted.down };
        this.context.refresh();
      });
      return h(
        "span",
        { role: "columnheader", "aria-sort": active ? (this.sorted.down ? "descending" : "ascending") : null },
        sort,
      );
    };
    const before = focused(this.head)?.closest(".fnb-sort")?.getAttribute("title");
    this.head.replaceChildren(
      ...this.columns.map((each) =>
        sorter(each.name, (hides && each.askedLabel) || each.label, each.title, each.name !== "fate"),
      ),
      h("span", { role: "columnheader", title: "From what it costs at least to what it costs" }, ""),
      h(
        "span",
        { class: "fnb-candidate-words", role: "presentation" },
        ...patterns.map((name) => sorter(name, name, `Word of ${name}`, false)),
      ),
    );
    if (before)
      this.head.querySelector<HTMLElement>(`.fnb-sort[title=${CSS.escape(before)}]`)?.focus({ preventScroll: true });
  }

  private row(own: Candidate): HTMLElement {
    const hides = this.quiz.hides;
    const { state, why } = this.quiz.verdict(String(own.number));
    const cells = this.columns.map((column) => {
      const told = !hides || !column.tells;
      const value = told ? column.value(own) : (column.asked?.(own) ?? null);
      if (column.name === "fate") return this.fate(own, hides, why);
      const text = typeof value === "number" ? formatNumber(value) : (value ?? "");
      return h("span", { role: "cell", class: "fnb-candidate-number" }, text);
    });
    const words = Object.entries(own.words).map(([pattern, word]) => {
      const cell = h("span", {
        role: "cell",
        class: "fnb-candidate-word",
        title: word,
        ...linked([target.word(own.axis, pattern, word)]),
      });
      cell.append(...spelled(parsed(word)));
      return cell;
    });
    const is = [target.candidate(own.axis, own.number)];
    const about = Object.entries(own.words).map(([pattern, word]) => target.word(own.axis, pattern, word));
    return h(
      "div",
      {
        role: "row",
        class: "fnb-candidate",
        "data-pick": true,
        tabindex: 0,
        "data-fate": hides ? null : own.fate,
        "data-now": own.at === this.now,
        "data-verdict": state,
        title: hides ? null : (FATES[own.fate] ?? null),
        ...linked([...is, ...about]),
      },
      ...cells,
      this.bar(own, hides),
      h("span", { class: "fnb-candidate-words", role: "presentation" }, ...words),
    );
  }

  private fate(own: Candidate, hides: boolean, why: string): HTMLElement {
    const cell = h("span", { role: "cell", class: "fnb-candidate-fate" });
    if (this.quiz.on && this.quiz.truths.has(String(own.number))) {
      const radio = h("input", {
        type: "radio",
        name: `fnb-quiz-${this.context.session.client}`,
        "aria-label": `Candidate ${own.number} becomes the layout`,
      });
      radio.checked = this.quiz.has(String(own.number));
      radio.disabled = this.quiz.done;
      radio.addEventListener("change", () => this.quiz.choose(String(own.number)));
      cell.append(radio);
    }
    const { state } = this.quiz.verdict(String(own.number));
    // What is not asked for is out for a reason that no figure shows: that is told.
    const asked = this.quiz.on && this.quiz.truths.has(String(own.number));
    if (this.quiz.done && asked) cell.append(sign(this.quiz, state), own.fate);
    else if (!hides || (this.quiz.truths.size > 1 && !asked)) cell.append(`${SIGNS[own.fate] ?? "✕"} ${own.fate}`);
    if (why) mark(cell, "title", why);
    return cell;
  }

  /** From what it costs at least to what it costs: the candidates on one scale. */
  private bar(own: Candidate, hides: boolean): HTMLElement {
    const place = (value: number) => `${(100 * Math.min(1, value / this.scale)).toFixed(2)}%`;
    const least = h("i", { class: "fnb-bar-least" });
    least.style.width = hides ? "0" : place(own.bound);
    const cell = h("span", { role: "cell", class: "fnb-bar", "aria-hidden": "true" }, least);
    const cost = own.cost ?? proven(own);
    if (!hides && (own.cost !== null || cost > own.bound)) {
      const whole = h("i", { class: own.cost === null ? "fnb-bar-floor" : "fnb-bar-cost" });
      whole.style.left = place(cost);
      cell.append(whole);
    }
    return cell;
  }

  /** Of all candidates of the axis: each row asks for it, and it never changes. */
  private truths(): ReadonlyMap<string, Truth> {
    const axis = this.choice.at(this.context.player.position);
    this.asked[axis] ??= this.truthsOf(this.told[axis]);
    return this.asked[axis];
  }

  private truthsOf(own: readonly Candidate[]): ReadonlyMap<string, Truth> {
    const best = own.find((each) => each.fate === "best");
    const least = best?.cost ?? null;
    if (least === null) return new Map();
    const offered = own.filter((each) => each === best || each.fate === "tied" || isOut(each, least));
    return new Map(
      offered.map((each) => [
        String(each.number),
        { right: each === best || each.fate === "tied", why: because(each, best) },
      ]),
    );
  }
}

/** What became of a candidate, where the word alone does not say it. */
const SHORT: Record<string, string> = {
  tied: "costs as little as the best",
  dearer: "was aligned, costs more",
  bound: "was given up: it cannot cost less than the best",
  "no alignment": "nothing keeps μ and the constraints",
  "other axis": "has no counterpart on the other axis",
};

/** Whether the figures say that a candidate is not the layout: it costs more, also as it is rounded, or at least as much. */
function isOut({ fate, cost, bound, floor }: Candidate, least: number): boolean {
  if (fate === "dearer") return cost !== null && cost > least + 0.002;
  return fate === "bound" && Math.max(bound, floor ?? 0) > least - 0.0005;
}

/** What the bars and the fates mean, as far as there are such; the tolerance, where it has no column. */
function barLegend(own: readonly Candidate[]): Node[] {
  const kinds: [boolean, string, string][] = [
    [true, "fnb-bar-least", "what its sizes alone cost"],
    [own.some((each) => each.cost === null && proven(each) > each.bound), "fnb-bar-floor", "J ≥, proven by the search"],
    [own.some((each) => each.cost !== null), "fnb-bar-cost", "J"],
  ];
  const bars = kinds
    .filter(([is]) => is)
    .map(([, name, text]) => h("span", {}, h("i", { class: `fnb-bar-key ${name}` }), text));
  const fates = new Set(own.map((each) => each.fate));
  const shorts = Object.entries(SHORT).filter(([fate]) => fates.has(fate));
  const tolerances = new Set(own.map((each) => each.tolerance));
  const [tolerance] = tolerances;
  return [
    ...(tolerances.size === 1 ? [h("span", {}, `μ = ${formatNumber(tolerance)} m for all`)] : []),
    ...bars,
    ...shorts.map(([fate, text]) => h("span", {}, h("b", {}, fate), text)),
  ];
}

function byCounters(a: Candidate, b: Candidate): number {
  for (const [name, value] of Object.entries(a.counters)) {
    const other = b.counters[name] ?? 0;
    if (value !== other) return value - other;
  }
  return a.number - b.number;
}

function because(own: Candidate, best: Candidate | undefined): string {
  const why = FATES[own.fate] ?? own.fate;
  if (own === best || !best || best.cost === null) return why;
  const known = own.cost ?? proven(own);
  const least = own.cost === null ? "at least " : "";
  return `${why} ${least}${formatNumber(known)} m against ${formatNumber(best.cost)} m.`;
}

/** @param hides whether the view asks: then nothing is found by its answer */
function filterable(own: Candidate, hides: boolean) {
  const { tolerance, omega, columns, deviation, number } = own;
  const telling = { J: own.cost, columns, deviation, bound: proven(own), number };
  return {
    numbers: { ...own.counters, omega, Ω: omega, tolerance, μ: tolerance, ...(hides ? {} : telling) },
    texts: [
      ...(hides ? [] : [own.fate]),
      ...Object.values(own.words),
      ...Object.values(own.words).map((word) => word.replaceAll(" ", "")),
    ],
  };
}

/** A share of the room for a pattern's words: as many as its longest has signs, within reason. */
function widest(own: readonly Candidate[], pattern: string): number {
  const longest = Math.max(...own.slice(0, 40).map((each) => spelled(parsed(each.words[pattern] ?? "")).length), 1);
  return Math.max(6, Math.min(24, longest));
}
