// Words: for each pattern the table of its counters and choices, every word drawn to scale against canvas ± μ, kept or
// dropped and why (the paper's 5.1, Eq. 7). With sampled sizes of unsized symbols it is the paper's Figure 7.

import { focused, h, mark, setText } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { Quiz, type Truth } from "../../shared/quiz.ts";
import { stepByKeys } from "../../shared/stepping.ts";
import { AxisChoice } from "../axes.ts";
import { type Candidate, combined, type GroupNote, inOrder, type Judged, judge, type WordEvent } from "../bounds.ts";
import { lettersLegend } from "../letters.ts";
import { type Axis, played } from "../timeline.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";
import { Section } from "../words/section.ts";
import { free, keyOf, sentence } from "../words/sentences.ts";
import { tupleTable } from "../words/tuples.ts";

interface Posed {
  event: "AxisPosed";
  at: number;
  axis: Axis;
  canvas: number;
  groups: GroupNote[];
}
type Told = { event: "WordJudged"; axis: Axis } & WordEvent;

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
