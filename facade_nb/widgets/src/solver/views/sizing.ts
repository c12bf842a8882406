// Sizing: the least-squares system as a matrix with the equation of every row, its objective, the active set step by step,
// and its multipliers as forces on the façade, before and after (the paper's 5.3, the supplement's Figure 7).

import { h, mark, setText } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { offers, type Question, Quiz } from "../../shared/quiz.ts";
import { AxisChoice } from "../axes.ts";
import { hueOf } from "../letters.ts";
import { linked, target } from "../links.ts";
import type { PathNote } from "../network/story.ts";
import { type Rows, rows } from "../rows.ts";
import { forces } from "../sizing/forces.ts";
import { abridged, endsOf, entering, grown, isPlain, type Lettered, letteredCases } from "../sizing/question.ts";
import {
  type Constraint,
  isForce,
  type Moment,
  type SizingEvent,
  type System,
  systemsOf,
  writtenOut,
} from "../sizing/system.ts";
import type { Axis } from "../timeline.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";

const BESIDE = 370; // pixels beside the matrix, for its equations
const HEIGHT = 20;
const MOST = 18;

export const sizing: ViewKind = {
  title: "Sizing",
  subtitle: "Sizes as near to the preferred ones as the alignment lets them (5.3, supplement 3.5)",
  needs: ["sizing", "alignment"],
  make: (context) => new SizingView(context),
};

const SIZES = "sizes";
const EQUATION = "an equation";
const ACTIVE = "the active set";
const LETTERED =
  "i-j-k counts words, columns and letters from 1. A letter that is cut has all its pieces in its equation, and all " +
  "letters of a symbol share one size.";

type Tab = "all" | "equations" | "inequalities" | "active" | "written";

const TABS: [Tab, string, string][] = [
  ["all", "all", "Every row of the system, and bounds"],
  ["equations", "Bx = d", "Equations"],
  ["inequalities", "Cx ≤ e", "Inequalities and bounds"],
  ["active", "active", "What is active at this moment"],
  ["written", "written out", "Letter by letter, as the supplement's Figure 7"],
];

/** What the matrix and its equations are read by. */
function systemLegend(): HTMLElement {
  const swatch = (name: string) => h("i", { class: `fnb-legend-swatch ${name}` });
  return h(
    "p",
    { class: "fnb-legend", role: "note" },
    h("span", {}, swatch("fnb-size-plus"), "+1"),
    h("span", {}, swatch("fnb-size-minus"), "−1"),
    h("span", {}, swatch("fnb-size-place"), "ends of columns (xj) and letters"),
    h("span", {}, swatch("fnb-hue-1 fnb-size-size"), "size of a symbol"),
    h("span", {}, "i-j-k: word, column, letter, counted from 1; from s to t"),
    h("span", {}, h("b", { class: "fnb-size-dot" }, "●"), "active"),
  );
}

class SizingView implements View {
  readonly el: HTMLElement;
  readonly controls: HTMLElement[];
  private readonly systems: Partial<Record<Axis, System>>;
  private readonly choice: AxisChoice;
  private readonly note = h("p", { class: "fnb-empty" });
  private readonly sum = h("p", { class: "fnb-size-sum", role: "status" });
  private readonly picture = h("div");
  private readonly terms = h("div", { class: "fnb-size-terms" });
  private readonly steps = h("div", { class: "fnb-size-steps" });
  private readonly head = h("div", { class: "fnb-size-row fnb-size-head", role: "row" });
  private readonly list: Rows<Constraint>;
  private readonly written = h("div", { class: "fnb-size-written" });
  private readonly table: HTMLElement;
  private readonly legend = systemLegend();
  private readonly tabs: [Tab, HTMLButtonElement][];
  private readonly body: HTMLElement;
  private readonly said = h("p", { class: "fnb-alternative", role: "status", hidden: true });
  readonly quiz: Quiz;
  private readonly lettered = new Map<System, Lettered[]>();
  /** Pixels that there are for a drawing. */
  private width = 900;
  private tab: Tab = "all";
  private system: System | null = null;
  private moment: Moment | null = null;
  private by = "";
  /** What all rows depend on: the axis, and what is known of its solution. */
  private rowsBy = "";

  constructor(private readonly context: ViewContext) {
    const { events } = context.pieces.sizing as { events: SizingEvent[] };
    const { paths } = context.pieces.alignment as { paths: PathNote[] };
    this.systems = systemsOf(events, paths);
    this.choice = new AxisChoice(context.timeline, context.refresh, context.alternatives);
    this.controls = [this.choice.el];
    this.tabs = TABS.map(([name, text, title]) => {
      const tab = h("button", { type: "button", class: "fnb-tab", title }, text);
      tab.addEventListener("click", () => {
        this.tab = name;
        context.refresh();
      });
      return [name, tab];
    });
    this.list = rows<Constraint>(
      {
        height: HEIGHT,
        most: MOST,
        key: (own) => `${this.rowsBy}|${own.number}`,
        make: (own) => this.row(own),
        drawn: () => context.links.apply(this.table),
      },
      context.signal,
    );
    this.table = h(
      "div",
      { class: "fnb-size-table", role: "table", "aria-label": "The system, row by row" },
      this.head,
      this.list.el,
    );
    const choose = h(
      "div",
      { class: "fnb-size-tabs" },
      h("h4", {}, "The system"),
      h("span", { class: "fnb-tabs", role: "group", "aria-label": "Rows" }, ...this.tabs.map(([, tab]) => tab)),
    );
    this.body = h(
      "div",
      {},
      this.sum,
      this.picture,
      h("div", { class: "fnb-size-halves" }, this.terms, this.steps),
      choose,
      this.legend,
      this.table,
      this.written,
    );
    this.el = h("div", { class: "fnb-sizing" }, this.said, this.note);
    this.quiz = new Quiz(() => this.questions());
    if (typeof ResizeObserver === "undefined") return;
    const observer = new ResizeObserver(() => {
      const width = Math.round(this.el.clientWidth / 20) * 20 - 24;
      if (width <= 0 || width === this.width) return;
      this.width = width;
      context.refresh();
    });
    observer.observe(this.el);
    context.signal.addEventListener("abort", () => observer.disconnect());
  }

  show(position: number): void {
    const axis = this.choice.at(position);
    for (const [name, tab] of this.tabs) mark(tab, "aria-pressed", String(name === this.tab));
    const system = this.systems[axis];
    if (this.quiz.on) {
      this.ask(system, axis, position);
      return;
    }
    const moment = system?.at(position);
    const other = this.context.alternatives.at(position, axis);
    const said = other
      ? `${other.name}. ${other.fate} Sizes of it are not told: this is the system of the layout.`
      : this.context.alternatives.trouble;
    setText(this.said, said);
    this.said.hidden = !said;
    const by = [
      axis,
      this.tab,
      moment?.posed,
      moment?.step?.at,
      moment?.solved?.at,
      this.now(system, position),
      this.width,
    ].join();
    if (by === this.by) return;
    this.by = by;
    if (!system || !moment?.posed) {
      this.note.textContent = system
        ? "The system is not posed yet: play on, or go to the stage Sizing."
        : "This axis has no least-squares system: there was no alignment to size.";
      this.el.replaceChildren(this.said, this.note);
      return;
    }
    this.system = system;
    this.moment = moment;
    this.rowsBy = [axis, moment.step?.at, moment.solved?.at, this.width].join();
    if (this.body.parentNode !== this.el) this.el.replaceChildren(this.said, this.body);
    this.sum.replaceChildren(...this.summary(system, moment));
    this.picture.replaceChildren(forces(system, moment, this.context.timeline.data.symbols, { width: this.width }));
    this.terms.replaceChildren(this.objective(system, moment));
    this.steps.replaceChildren(this.iterations(system, moment, position));
    const written = this.tab === "written";
    this.table.hidden = written;
    this.legend.hidden = written;
    this.written.hidden = !written;
    if (written) {
      this.list.set([]);
      this.written.replaceChildren(...this.figure7(system));
      return;
    }
    this.written.replaceChildren();
    const count = system.count;
    const cell = Math.max(1, Math.min(17, Math.floor((2 * (this.width - BESIDE)) / count) / 2));
    this.table.style.setProperty("--fnb-cell", `${cell}px`);
    this.table.style.setProperty("--fnb-matrix", `${cell * count}px`);
    this.header(system, cell);
    const kinds = {
      all: () => true,
      equations: (own: Constraint) => own.kind === "=",
      inequalities: (own: Constraint) => own.kind === "≤",
      active: (own: Constraint) => moment.active.has(own.number),
    };
    this.list.set(system.constraints.filter(kinds[this.tab as keyof typeof kinds]));
  }

  private questions(): Question[] {
    const { position } = this.context.player;
    const system = this.systems[this.choice.at(position)];
    const solved = system?.solved && system.at(system.solved.at);
    if (!system || !solved)
      return [{ prompt: "This axis has no sizes that could be asked for.", hint: "", truths: () => new Map() }];
    const found: Question[] = [];
    const from = system.posed.at;
    const truths = grown(system, solved);
    if (truths.size)
      found.push({
        name: SIZES,
        prompt: "Which symbols end larger than they like? Tick them.",
        hint: isPlain(system, truths)
          ? "all words fill the canvas in the end. Are they longer or shorter than it at the sizes that symbols like?"
          : "a letter is as long as from where it begins to where it ends; compare that with what its symbol likes.",
        truths: () => truths,
        from,
      });
    const letter = this.letter(system);
    if (letter) {
      const named = `${letter.row.symbol} (${system.ijk(letter.place)})`;
      const prompt = `Which equation says how long the marked letter ${named} is?`;
      found.push({ name: EQUATION, prompt, hint: LETTERED, truths: () => letter.truths, single: true, from });
    }
    const next = entering(system, position);
    if (next) {
      const few = next.step.entered.length > 1 ? "Which constraints become" : "Which constraint becomes";
      found.push({
        name: ACTIVE,
        prompt: `${few} active next?`,
        hint: "what is broken most at these sizes is taken up: the number beside each is below 0 by as much as it is broken.",
        truths: () => next.truths,
        single: next.step.entered.length === 1,
        from: next.step.at,
      });
    }
    return found;
  }

  /** The letter whose equation is asked for: another one each time. */
  private letter(system: System): Lettered | undefined {
    const made = this.lettered.get(system) ?? letteredCases(system);
    this.lettered.set(system, made);
    return made[this.quiz.round % made.length];
  }

  /** The question: what is known, what can be chosen, and, once it is checked, the answer. */
  private ask(system: System | undefined, axis: Axis, position: number): void {
    const { quiz } = this;
    const { asked } = quiz;
    const next = system && asked === ACTIVE ? entering(system, position) : null;
    const by = ["asks", axis, quiz.stamp, next?.step.at, this.width].join();
    if (by === this.by) return;
    this.by = by;
    this.said.hidden = true;
    if (!system?.solved || !asked) {
      this.note.textContent = quiz.prompt;
      this.el.replaceChildren(this.note);
      return;
    }
    const { symbols } = this.context.timeline.data;
    const chip = (symbol: string) => h("span", { class: `fnb-size-chip ${hueOf(symbols, symbol)}` }, symbol);
    const known = (key: string) => {
      if (asked === ACTIVE) return `now ${formatNumber(next?.slacks.get(key), 4)} m`;
      return asked === SIZES ? this.known(system, key) : "";
    };
    const list = offers(quiz, (key) =>
      h(
        "span",
        { class: "fnb-size-offer" },
        asked === SIZES ? chip(key) : h("code", { title: key }, abridged(key)),
        h("span", { class: "fnb-offer-known" }, known(key)),
      ),
    );
    const moment = system.at(next ? (quiz.hides ? next.before.at : next.step.at) : system.solved.at);
    const letter = asked === EQUATION ? this.letter(system) : undefined;
    const how = { before: asked === SIZES && quiz.hides, ...(letter ? { marked: letter.place } : {}) };
    const answer = asked === SIZES && !quiz.hides ? this.objective(system, moment) : null;
    this.el.replaceChildren(forces(system, moment, symbols, how), h("div", { class: "fnb-size-asked" }, list, answer));
  }

  /** What is known of a symbol while its size is asked for: what it likes, and, where words do not say it all, its ends. */
  private known(system: System, symbol: string): string {
    const v = system.posed.meaning.findIndex((own) => own.kind === "size" && own.symbol === symbol);
    const likes = `likes ${formatNumber(system.posed.target[v])} m`;
    if (!system.solved) return likes;
    const solved = system.at(system.solved.at);
    const pieces = isPlain(system, grown(system, solved)) ? [] : (endsOf(system, solved).get(symbol) ?? []);
    const ends = pieces.map(([start, end]) => `from ${formatNumber(start, 4)} to ${formatNumber(end, 4)} m`);
    return ends.length ? `${likes}; a letter of it stands ${ends.join(", and ")}` : likes;
  }

  /** Which of its own events is told right now. */
  private now(system: System | undefined, position: number): number {
    const own = [system?.posed.at, system?.solved?.at, ...(system?.steps.map((step) => step.at) ?? [])];
    return own.includes(position) ? position : -1;
  }

  private summary(system: System, moment: Moment): Node[] {
    const { posed } = system;
    const equations = system.constraints.filter((own) => own.number >= system.count && own.kind === "=").length;
    const text = `${system.count} variables, ${equations} equations, ${posed.rows.length - equations} inequalities. `;
    const at = moment.solved
      ? `Solved: deviation √Σ(size − preferred)² = ${formatNumber(moment.solved.deviation)} m.`
      : moment.step
        ? `Round ${moment.step.round} (${moment.step.round === 1 ? "sizes" : "places"}), step ${moment.step.step}: ${moment.active.size} active.`
        : "Posed; nothing is solved yet.";
    return [
      h("b", {}, "min ‖Ax − b‖² "),
      document.createTextNode("subject to Bx = d, Cx ≤ e: "),
      h("span", { class: "fnb-muted" }, text),
      document.createTextNode(at),
    ];
  }

  /** What each symbol adds to the objective. */
  private objective(system: System, moment: Moment): HTMLElement {
    const { posed } = system;
    const sizes = posed.meaning.flatMap((own, v) => (own.kind === "size" ? [v] : []));
    const off = (v: number) => (moment.values[v] ?? 0) - (posed.target[v] ?? 0);
    const sized = sizes.filter((v) => (posed.weight[v] ?? 0) > 0);
    const free = sizes.filter((v) => !((posed.weight[v] ?? 0) > 0));
    const largest = Math.max(1e-9, ...sized.map((v) => Math.abs(off(v))));
    const line = (v: number, counts: boolean) => {
      const symbol = posed.meaning[v]?.symbol ?? "";
      const delta = off(v);
      const bar = h("i", { class: "fnb-size-bar", "data-kind": delta > 0 ? "pull" : "push" });
      bar.style.width = `${(46 * Math.abs(delta)) / largest}%`;
      bar.style[delta > 0 ? "left" : "right"] = "50%";
      return h(
        "tr",
        { ...linked([target.symbol(symbol)], [target.variable(posed.axis, posed.variables[v] ?? "")]) },
        h("td", {}, h("span", { class: `fnb-size-chip ${hueOf(this.context.timeline.data.symbols, symbol)}` }, symbol)),
        h(
          "td",
          { class: "fnb-size-figure" },
          counts ? formatNumber(posed.target[v]) : `(${formatNumber(posed.target[v])})`,
        ),
        h("td", { class: "fnb-size-figure" }, formatNumber(moment.values[v])),
        h("td", { class: "fnb-size-scale" }, counts && Math.abs(delta) > 1e-9 ? bar : null),
        h("td", { class: "fnb-size-figure" }, counts ? formatNumber(delta ** 2, 5) : "free"),
      );
    };
    return h(
      "div",
      {},
      h("h4", {}, "Objective: Σ (size − preferred)²"),
      h(
        "div",
        { class: "fnb-size-scroll" },
        h(
          "table",
          {},
          h(
            "thead",
            {},
            h(
              "tr",
              {},
              ...["", "preferred, m", "size, m", "less | more", "squared, m²"].map((text) => h("th", {}, text)),
            ),
          ),
          h("tbody", {}, ...sized.map((v) => line(v, true)), ...free.map((v) => line(v, false))),
          h(
            "tfoot",
            {},
            h(
              "tr",
              {},
              h("td", {}, "Σ"),
              h("td"),
              h("td"),
              h("td"),
              h("td", { class: "fnb-size-figure" }, h("b", {}, formatNumber(moment.objective, 5))),
            ),
          ),
        ),
      ),
    );
  }

  /** The steps of the active-set method, each a way to its moment. */
  private iterations(system: System, moment: Moment, position: number): HTMLElement {
    const byNumber = new Map(system.constraints.map((own) => [own.number, own.text]));
    const name = (number: number) => byNumber.get(number) ?? system.posed.variables[number] ?? String(number);
    const list = system.steps.map((step) => {
      const moves = [
        step.entered.length > 3
          ? `${step.entered.length} enter`
          : step.entered.map((own) => `+ ${name(own)}`).join(", "),
        step.left.length > 3 ? `${step.left.length} leave` : step.left.map((own) => `− ${name(own)}`).join(", "),
      ].filter(Boolean);
      const button = h(
        "button",
        { type: "button", class: "fnb-size-step", "data-now": moment.step === step, "data-ahead": step.at > position },
        h("span", {}, `round ${step.round}, step ${step.step}`),
        h("span", { class: "fnb-size-moves" }, moves.join("; ") || "nothing changes"),
        h("span", { class: "fnb-size-figure" }, `${step.active} active`),
        h("span", { class: "fnb-size-figure", title: "The round's objective" }, formatNumber(step.objective, 5)),
      );
      button.addEventListener("click", () => this.context.player.go(step.at));
      return h("li", {}, button);
    });
    return h(
      "div",
      {},
      h("h4", {}, "Active set, step by step"),
      h(
        "p",
        { class: "fnb-muted" },
        "Round 1 finds the sizes, round 2, with these, where letters stand. Last: the round's objective, m².",
      ),
      list.length ? h("ol", {}, ...list) : h("p", { class: "fnb-muted" }, "No step is told."),
    );
  }

  private header(system: System, cell: number): void {
    const wide = cell >= 9;
    mark(this.table, "data-narrow", !wide);
    mark(this.table, "data-blank", cell < 13);
    const names = system.posed.variables.map((name, v) => {
      const own = system.posed.meaning[v];
      const label = h(
        "span",
        {
          class: `fnb-size-variable ${own?.kind === "size" ? hueOf(this.context.timeline.data.symbols, own.symbol) : ""}`,
          title: system.variableName(v, true),
          ...linked([target.variable(system.posed.axis, name)], this.variableAbout(system, v)),
        },
        h("span", {}, wide ? system.variableName(v) : ""),
      );
      label.style.left = `${v * cell}px`;
      return label;
    });
    this.head.replaceChildren(
      h("div", { class: "fnb-size-matrix", role: "columnheader" }, ...names),
      h("span", { role: "columnheader" }, "equation"),
      h("span", { role: "columnheader", class: "fnb-size-figure" }, "value"),
      h("span", { role: "columnheader", class: "fnb-size-figure" }, "multiplier"),
    );
  }

  private variableAbout(system: System, v: number): string[] {
    const own = system.posed.meaning[v];
    if (!own) return [];
    if (own.kind === "size") return [target.symbol(own.symbol)];
    const group = system.paths[own.group]?.group ?? "";
    return own.kind === "boundary" ? [target.boundary(system.posed.axis, group, own.column)] : system.letterKeys(own);
  }

  private row(own: Constraint): HTMLElement {
    const system = this.system as System;
    const moment = this.moment as Moment;
    const value = own.terms.reduce((sum, [v, coefficient]) => sum + coefficient * (moment.values[v] ?? 0), 0);
    const force = system.multiplier(own.number, moment);
    const active = moment.active.has(own.number);
    const cells = own.terms.map(([v, coefficient]) => {
      const text = coefficient === 1 ? "1" : coefficient === -1 ? "−1" : formatNumber(coefficient, 1);
      const cell = h(
        "i",
        {
          class: "fnb-size-cell",
          "data-sign": coefficient > 0 ? "plus" : "minus",
          title: `${text} · ${system.variableName(v, true)}`,
        },
        text,
      );
      cell.style.left = `calc(${v} * var(--fnb-cell))`;
      return cell;
    });
    return h(
      "div",
      {
        role: "row",
        class: "fnb-size-row",
        tabindex: 0,
        "data-kind": own.kind === "=" ? "equation" : "inequality",
        "data-active": active,
        "data-force": isForce(force) ? (force > 0 ? "pull" : "push") : null,
        title: `${own.name}${active ? " · active" : ""}`,
        ...system.links(own),
      },
      h("div", { class: "fnb-size-matrix", role: "cell" }, ...cells),
      h(
        "span",
        { role: "cell", class: "fnb-size-text" },
        this.isKept(own) ? `|${own.symbol}| is kept from round 1` : own.text,
      ),
      h(
        "span",
        { role: "cell", class: "fnb-size-figure" },
        own.kind === "=" && own.number >= system.count ? this.right(own) : formatNumber(value),
      ),
      h(
        "span",
        { role: "cell", class: "fnb-size-figure" },
        isForce(force) ? formatNumber(force) : moment.solved ? "0" : "",
      ),
    );
  }

  /** In the second round sized symbols keep the sizes of the first. */
  private isKept(own: Constraint): boolean {
    const [system, moment] = [this.system as System, this.moment as Moment];
    const second = !moment.solved && moment.step?.round === 2;
    return second && own.number < system.count && (system.posed.weight[own.number] ?? 0) > 0;
  }

  /** What both sides of an equation are. */
  private right(own: Constraint): string {
    const moment = this.moment as Moment;
    const positive = own.terms.filter(([v]) => this.system?.posed.meaning[v]?.kind !== "size");
    if (!own.symbol) return "";
    return formatNumber(
      Math.abs(positive.reduce((sum, [v, coefficient]) => sum + coefficient * (moment.values[v] ?? 0), 0)),
    );
  }

  /** Letter by letter. */
  private figure7(system: System): HTMLElement[] {
    const titles = {
      ends: "Fill the façade",
      stitch: "Stitch",
      order: "Order",
      size: "One size for a symbol",
      column: "Columns share their ends",
    };
    return system.paths.map((path, g) => {
      const { objective, constraints } = writtenOut(system, g);
      const item = (own: {
        text: string;
        places: { group: number; band: number; column: number; place: number }[];
        symbol: string;
      }) =>
        h(
          "li",
          {
            ...linked(
              own.places.slice(0, 1).flatMap((place) => system.letterKeys(place)),
              own.symbol ? [target.symbol(own.symbol)] : [],
            ),
          },
          own.text,
        );
      return h(
        "section",
        {},
        h("h4", {}, path.group, h("span", { class: "fnb-muted" }, " i-j-k: word, column, letter, counted from 1")),
        h(
          "div",
          { class: "fnb-size-boxes" },
          h("div", { class: "fnb-size-boxed fnb-size-min" }, h("b", {}, "min"), h("ul", {}, ...objective.map(item))),
          ...(Object.keys(titles) as (keyof typeof titles)[]).map((kind) => {
            const own = constraints.filter((each) => each.kind === kind);
            return own.length
              ? h("div", { class: "fnb-size-boxed" }, h("b", {}, titles[kind]), h("ul", {}, ...own.map(item)))
              : null;
          }),
        ),
      );
    });
  }
}
