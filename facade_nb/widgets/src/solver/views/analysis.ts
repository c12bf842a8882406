// Analysis: pairs of patterns with their common ends greyed, the equation of each, and both linear systems, solved; an
// equation that contradicts the others in red (supplement 3.1).

import { h, mark, setText } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { offers, Quiz, sign, type Truth } from "../../shared/quiz.ts";
import { AxisChoice } from "../axes.ts";
import { offers as near } from "../equations.ts";
import { linked, target } from "../links.ts";
import { equation, type Term, term, variables } from "../terms.ts";
import type { Axis } from "../timeline.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";

interface Compared {
  event: "PatternsCompared";
  at: number;
  axis: Axis;
  number: number;
  patterns: [string, string];
  prefix: Term[];
  left: Term[];
  right: Term[];
  suffix: Term[];
  coefficients: Record<string, number>;
  text: string;
  system: string;
  strength: Strength;
  symbol: string;
  note: string;
}

interface Reduced {
  event: "SystemReduced";
  at: number;
  axis: Axis;
  system: "counters" | "unsized";
  variables: string[];
  equations: number[];
  reduced: {
    pivot: string;
    coefficients: Record<string, number>;
    text: string;
    sources: number[];
    strength: Strength;
  }[];
  resolved: Record<string, number>;
  free: string[];
}

interface Inconsistent {
  event: "PairInconsistent";
  at: number;
  axis: Axis;
  system: string;
  equation: number;
  against: number[];
  strength: Strength;
  text: string;
}

interface NotAnalysed {
  event: "PatternNotAnalysed";
  at: number;
  axis: Axis;
  pattern: string;
  reason: string;
}

type Told = Compared | Reduced | Inconsistent | NotAnalysed;
type Strength = "binding" | "exact" | "preferred";

const STRENGTH: Record<Strength, string> = {
  binding: "It holds in every layout.",
  exact: "It holds where nothing is inserted beside either pattern.",
  preferred: "It holds as far as sizes stay as preferred.",
};

export const analysis: ViewKind = {
  title: "Pattern analysis",
  subtitle: "What is left of two patterns is equally long (supplement 3.1)",
  needs: ["analysis"],
  make: (context) => new AnalysisView(context),
};

class AnalysisView implements View {
  readonly el = h("div", { class: "fnb-analysis" });
  readonly controls: HTMLElement[];
  readonly quiz: Quiz;
  private readonly told: Told[];
  private readonly choice: AxisChoice;
  private readonly note = h("p", { class: "fnb-empty" });
  private readonly pairs = h("div", { class: "fnb-pairs", role: "list" });
  private readonly systems = h("div", { class: "fnb-systems" });
  /** While the view asks: the sizes that equations are made of. */
  private readonly known = h("p", { class: "fnb-known", hidden: true });
  private by = "";

  constructor(private readonly context: ViewContext) {
    this.told = (context.pieces.analysis as { events: Told[] }).events;
    this.choice = new AxisChoice(context.timeline, context.refresh, context.alternatives);
    this.controls = [this.choice.el];
    this.el.append(this.known, this.note, this.pairs, this.systems);
    const from = () => context.timeline.begins("analysis", this.choice.at(context.player.position));
    this.quiz = new Quiz(() => [
      {
        name: "all pairs",
        prompt: "Which pairs contradict those before them? Which counters and sizes do the others fix? Tick them.",
        hint:
          "put what one equation says into the next. A pair contradicts where no numbers are left that keep both; " +
          "a counter or size is fixed where one number is left for it.",
        truths: () => this.truths(),
        from: from(),
      },
      ...this.equations().map((one) => ({
        name: pairName(one),
        prompt: `What does the equation of ${pairName(one)} say?`,
        hint: "the grey ends are the same in both lines. Add up what is left of each, letter by letter, at the sizes above.",
        truths: () => this.spelled(one),
        single: true,
        from: from(),
      })),
    ]);
  }

  show(position: number): void {
    const axis = this.choice.at(position);
    // A prediction is made of all pairs: the answer is what comes after them.
    const asked = this.quiz.on ? this.equations().find((one) => pairName(one) === this.quiz.asked) : undefined;
    const seen = this.told.filter(
      (event) => event.axis === axis && (this.quiz.on || event.at <= position) && (!asked || event === asked),
    );
    const now = !this.quiz.on && seen.at(-1)?.at === position;
    const by = `${axis}|${seen.length}|${now}|${this.quiz.stamp}`;
    if (by === this.by) return;
    this.by = by;
    const conflicts = this.quiz.hides
      ? []
      : seen.filter((event): event is Inconsistent => event.event === "PairInconsistent");
    const compared = seen.filter((event): event is Compared => event.event === "PatternsCompared");
    const others = seen.filter((event): event is NotAnalysed => event.event === "PatternNotAnalysed");
    this.pairs.replaceChildren(
      ...compared.map((one) => this.pair(one, conflicts, now && one.at === position)),
      ...others.map((one) =>
        h(
          "p",
          { role: "listitem", ...linked([target.pattern(one.pattern)]) },
          h("code", {}, one.pattern),
          ` is not analysed: ${one.reason}`,
        ),
      ),
    );
    const reduced = seen.filter((event): event is Reduced => event.event === "SystemReduced");
    this.known.hidden = !this.quiz.on;
    setText(this.known, this.quiz.on ? sizesText(this.context.timeline.data.sizes, compared) : "");
    this.systems.replaceChildren(...reduced.map((one) => this.system(one, conflicts, now && one.at === position)));
    const all = this.told.some((event) => event.axis === axis);
    const empty = !compared.length && !others.length;
    this.note.hidden = !empty;
    const none = all ? "This axis has no two patterns to compare." : "This axis was not analysed.";
    setText(this.note, seen.length || !all ? none : "No pair is compared yet: play on, or go to Pattern analysis.");
  }

  /** Two lines, the common ends greyed, and what follows. */
  private pair(one: Compared, conflicts: Inconsistent[], now: boolean): HTMLElement {
    const { axis, number, patterns } = one;
    // What the reader was asked for is told beside the answers, and paints nothing red.
    const conflict = this.quiz.on ? undefined : conflicts.find((own) => own.equation === number);
    const against = !this.quiz.on && conflicts.some((own) => own.against.includes(number));
    const asked = this.quiz.on && pairName(one) === this.quiz.asked;
    const hides = asked && this.quiz.hides;
    const content = one.symbol !== "";
    // A content: the symbol as it stands in the second pattern, and what the first puts in its place.
    const names = content ? [`${one.symbol} in ${patterns[1]}`, `its content in ${patterns[0]}`] : patterns;
    const line = (index: 0 | 1, middle: Term[]) => [
      h(
        "span",
        { class: "fnb-pair-name", ...linked([target.pattern(patterns[content ? 1 - index : index] ?? "")]) },
        names[index] ?? "",
      ),
      h("span", { class: "fnb-pair-end fnb-pair-prefix" }, ...one.prefix.map(term)),
      h("span", { class: "fnb-pair-middle" }, ...(middle.length ? middle.map((own) => this.term(own)) : ["ε"])),
      h("span", { class: "fnb-pair-end" }, ...one.suffix.map(term)),
    ];
    // It is about the letters that are left over: they light up with it, on the façade too.
    const left = [...new Set([...one.left, ...one.right].flatMap((own) => this.symbols(own)))];
    const equationText = h("span", { class: "fnb-pair-equation" });
    if (hides) equationText.append("⇒ ?");
    else if (one.text) equationText.append("⇒ ", ...equation(one.text));
    else equationText.append(h("span", { class: "fnb-muted" }, one.note ? `no equation: ${one.note}` : "no equation"));
    const el = h(
      "div",
      {
        class: "fnb-pair",
        role: "listitem",
        tabindex: 0,
        "data-conflict": !!conflict,
        "data-against": against,
        "data-now": now,
        ...linked([target.equation(axis, number), ...left], this.about(one)),
      },
      h("span", { class: "fnb-pair-number" }, `(${number + 1})`),
      h("div", { class: "fnb-pair-lines" }, ...line(0, one.left), ...line(1, one.right)),
      h(
        "div",
        { class: "fnb-pair-follows" },
        equationText,
        one.text && !hides
          ? h(
              "span",
              { class: "fnb-strength", "data-strength": one.strength, title: STRENGTH[one.strength] },
              one.strength,
            )
          : null,
      ),
    );
    if (asked) el.append(this.offered());
    else if (this.quiz.on && one.text) el.append(this.box(pairKey(one), `(${number + 1}) contradicts those before`));
    if (conflict) {
      const mild = conflict.strength === "preferred" ? " That is no fault: sizes may give way a little." : "";
      el.append(
        h("p", { class: "fnb-pair-conflict" }, conflict.text, mild ? h("span", { class: "fnb-muted" }, mild) : null),
      );
    }
    if (!conflict && against)
      el.append(h("p", { class: "fnb-pair-conflict" }, "An equation below contradicts this one."));
    return el;
  }

  private term(own: Term): HTMLElement {
    const el = term(own);
    for (const [name, value] of Object.entries(linked(this.symbols(own)))) mark(el, name, value);
    return el;
  }

  private symbols(own: Term): string[] {
    return own.letters.map((letter) => target.symbol(letter.replace(/'$/, "")));
  }

  private about(one: Compared): string[] {
    const { counters, symbols } = variables(Object.keys(one.coefficients));
    return [
      ...one.patterns.map((name) => target.pattern(name)),
      ...counters.map((name) => target.counter(name)),
      ...symbols.map((name) => target.symbol(name)),
    ];
  }

  /** One of the two systems, solved. */
  private system(one: Reduced, conflicts: Inconsistent[], now: boolean): HTMLElement {
    const title = one.system === "counters" ? "Counters" : "Unsized symbols";
    const conflict = conflicts.find((own) => own.system === one.system);
    const numbers = (list: readonly number[]) => list.map((n) => `(${n + 1})`).join(", ");
    if (this.quiz.on && asked(one).length) {
      const boxes = asked(one).map((name) => this.box(variableKey(one, name), `${name} is fixed`));
      if (this.quiz.hides)
        return h("section", { class: "fnb-system", "data-system": one.system }, h("h4", {}, title), ...boxes);
      return h(
        "section",
        { class: "fnb-system", "data-system": one.system },
        h("h4", {}, title),
        ...boxes,
        this.rows(one),
      );
    }
    const list = this.rows(one);
    const free = one.free.map((name) => {
      const { counters, symbols } = variables([name]);
      const keys = [...counters.map((each) => target.counter(each)), ...symbols.map((each) => target.symbol(each))];
      return h("span", { class: "fnb-free", ...linked(keys) }, name);
    });
    return h(
      "section",
      { class: "fnb-system", "data-system": one.system, "data-now": now },
      h(
        "h4",
        {},
        title,
        h("span", { class: "fnb-muted" }, one.equations.length ? ` from ${numbers(one.equations)}` : ""),
      ),
      one.reduced.length
        ? list
        : h(
            "p",
            { class: "fnb-muted" },
            one.equations.length ? "No row is left that can hold." : "No equation is about them.",
          ),
      free.length ? h("p", { class: "fnb-system-free" }, "free: ", ...free) : null,
      conflict ? h("p", { class: "fnb-pair-conflict" }, `(${conflict.equation + 1}) cannot hold.`) : null,
    );
  }

  /** The rows of a solved system, each with the equations that it follows from. */
  private rows(one: Reduced): HTMLElement {
    const numbers = (list: readonly number[]) => list.map((n) => `(${n + 1})`).join(", ");
    const rows = one.reduced.map((row) => {
      const named = variables([row.pivot, ...Object.keys(row.coefficients)]);
      const text = h("span", { class: "fnb-system-text" });
      text.append(...equation(row.text));
      const is = row.sources.map((n) => target.equation(one.axis, n));
      const about = [
        ...named.counters.map((name) => target.counter(name)),
        ...named.symbols.map((name) => target.symbol(name)),
      ];
      return h(
        "li",
        { "data-resolved": row.pivot in one.resolved, ...linked(is, about) },
        text,
        h("span", { class: "fnb-muted" }, `from ${numbers(row.sources)}`),
      );
    });
    return h("ul", {}, ...rows);
  }

  /** What can be ticked, and, once it is checked, how it stands. */
  private box(key: string, label: string): HTMLElement {
    const { state, why } = this.quiz.verdict(key);
    const box = h("input", { type: "checkbox" });
    box.checked = this.quiz.has(key);
    box.disabled = this.quiz.done;
    box.addEventListener("change", () => this.quiz.choose(key));
    return h(
      "label",
      { class: "fnb-analysis-choice", "data-verdict": state },
      box,
      h("b", {}, label),
      h("span", {}, sign(this.quiz, state), why),
    );
  }

  /** The equations that the reader chooses from for one pair. */
  private offered(): HTMLElement {
    return offers(this.quiz, (text) => {
      const el = h("span", { class: "fnb-pair-equation" });
      el.append(...equation(text));
      return el;
    });
  }

  /** The pairs of the axis that give an equation. */
  private equations(): Compared[] {
    const axis = this.choice.at(this.context.player.position);
    return this.told.filter(
      (event): event is Compared => event.event === "PatternsCompared" && event.axis === axis && event.text !== "",
    );
  }

  private spelled(asked: Compared): ReadonlyMap<string, Truth> {
    const others = this.equations().filter((one) => one !== asked);
    return new Map(near(asked.text, others).map(({ text, right, why }) => [text, { right, why }]));
  }

  private truths(): ReadonlyMap<string, Truth> {
    const axis = this.choice.at(this.context.player.position);
    const told = this.told.filter((event) => event.axis === axis);
    const conflicts = told.filter((event): event is Inconsistent => event.event === "PairInconsistent");
    const found = new Map<string, Truth>();
    for (const one of told) {
      if (one.event === "PatternsCompared" && one.text) {
        const conflict = conflicts.find((own) => own.equation === one.number);
        found.set(pairKey(one), {
          right: conflict !== undefined,
          why: conflict
            ? "No numbers keep it together with those before it."
            : "It holds together with those before it.",
        });
      }
      if (one.event !== "SystemReduced") continue;
      for (const name of asked(one)) {
        const row = one.reduced.find((own) => own.pivot === name);
        const why = row ? row.text : "No equation says what it is: it stays free.";
        const fixed = name in one.resolved;
        found.set(variableKey(one, name), {
          right: fixed,
          why: fixed || !row ? why : `${why}: it follows from others, which are free.`,
        });
      }
    }
    return found;
  }
}

/** The sizes of the letters that are left over: `A 0.9 m, B 1.2 m, e free`. */
function sizesText(sizes: Readonly<Record<string, number | null>> | undefined, compared: readonly Compared[]): string {
  if (!sizes) return ""; // a page that was saved before they were told
  const letters = compared.flatMap(({ left, right }) => [...left, ...right].flatMap((own) => own.letters));
  const symbols = [...new Set(letters.map((letter) => letter.replace(/'$/, "")))];
  const named = symbols.map((symbol) => {
    const size = sizes[symbol] ?? null;
    return `${symbol} ${size === null ? "has no size of its own" : `is ${formatNumber(size)} m`}`;
  });
  return named.length ? `${named.join(", ")}.` : "";
}

/** The variables that a system is asked for: that of the sizes has the counters, too, but they are the other's. */
const asked = ({ system, variables: all }: Reduced): string[] =>
  system === "counters" ? all : all.filter((name) => name.startsWith("|"));

const pairName = ({ number }: Compared): string => `pair (${number + 1})`;
const pairKey = ({ axis, number }: Compared): string => target.equation(axis, number);
const variableKey = ({ axis, system }: Reduced, name: string): string => target.variable(axis, `${system} ${name}`);
