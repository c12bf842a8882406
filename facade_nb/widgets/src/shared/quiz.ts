// Prediction: a view hides its answer, asks, hints, checks what the reader chose, and explains.

import { h } from "./dom.ts";

/** What there is to be said of a thing that can be chosen. */
export interface Truth {
  right: boolean;
  why: string;
}

export type Truths = ReadonlyMap<string, Truth>;

export type Verdict = "open" | "right" | "wrong" | "missed" | "passed";

export interface Answer {
  right: string[];
  wrong: string[];
  missed: string[];
}

export interface Question {
  /** What it is called among others that the view can ask. */
  name?: string;
  prompt: string;
  /** What can be chosen at present, by key, and whether it is right to choose it. */
  truths: () => Truths;
  /** What helps to find the answer with what is on the screen. It is told before the answer. */
  hint: string;
  /** Whether one thing is to be chosen, not all that are right. */
  single?: boolean;
  /** Position of the first event that would give the answer away; the first of all where it is not said. */
  from?: number;
}

/** The questions of a view: it draws what can be chosen, and asks here how it stands. */
export class Quiz {
  private asking = false;
  private checked = false;
  private helped = false;
  private tried = false;
  private readonly chosen = new Set<string>();
  private readonly watchers = new Set<() => void>();
  private subject = "";
  /** Goes up whenever something has changed: a view need not draw again before. */
  stamp = 0;
  /** How often the reader has begun anew: a question may have another case each time. */
  round = 0;

  /** @param questions those that can be asked at present: at least one */
  constructor(private readonly questions: () => readonly Question[]) {}

  /** Whether the view asks: then it must not show its answer before `done`. */
  get on(): boolean {
    return this.asking;
  }

  get done(): boolean {
    return this.checked;
  }

  get hides(): boolean {
    return this.asking && !this.checked;
  }

  /** Names of the questions that can be asked. */
  get names(): string[] {
    return this.questions().map(({ name }) => name ?? "");
  }

  /** Name of the question that is asked; of the first where none was chosen, or it cannot be asked any more. */
  get asked(): string {
    return this.question.name ?? "";
  }

  get prompt(): string {
    return this.question.prompt;
  }

  get hint(): string {
    return this.question.hint;
  }

  /** Whether the hint is told: the reader has asked for it, or answered wrong. */
  get hinted(): boolean {
    return this.helped;
  }

  /** Whether the last answer was wrong, and the reader may give another. */
  get missed(): boolean {
    return this.tried && !this.checked;
  }

  get single(): boolean {
    return this.question.single ?? false;
  }

  get from(): number {
    return this.question.from ?? 0;
  }

  get truths(): Truths {
    return this.question.truths();
  }

  private get question(): Question {
    const all = this.questions();
    const found = all.find(({ name }) => name === this.subject) ?? all[0];
    if (!found) throw new Error("This view has no question.");
    return found;
  }

  /** Whether something was chosen, or it is checked. */
  get begun(): boolean {
    return this.checked || this.helped || this.chosen.size > 0;
  }

  has(key: string): boolean {
    return this.chosen.has(key);
  }

  ask(on: boolean): void {
    this.asking = on;
    this.clear();
  }

  /** Ask another of the questions. */
  pose(name: string): void {
    this.subject = name;
    this.round = 0;
    this.clear();
  }

  again(): void {
    this.round++;
    this.clear();
  }

  choose(key: string): void {
    if (this.checked) return;
    if (this.single) this.chosen.clear();
    if (!this.chosen.delete(key)) this.chosen.add(key);
    this.tried = false;
    this.tell();
  }

  /** Tell the hint. */
  help(): void {
    this.helped = true;
    this.tell();
  }

  /** Compare what was chosen. What is wrong for the first time brings the hint, and another try; then all is told. */
  check(): Answer {
    const answer = this.answer();
    if (this.isRight(answer) || this.helped) this.checked = true;
    else this.tried = true;
    this.helped = true;
    this.tell();
    return answer;
  }

  answer(): Answer {
    const answer: Answer = { right: [], wrong: [], missed: [] };
    for (const [key, { right }] of this.truths) {
      if (this.chosen.has(key)) answer[right ? "right" : "wrong"].push(key);
      else if (right && !this.single) answer.missed.push(key);
    }
    return answer;
  }

  private isRight({ right, wrong, missed }: Answer): boolean {
    if (!this.single) return !wrong.length && !missed.length;
    return right.length > 0 || (!wrong.length && ![...this.truths.values()].some((own) => own.right));
  }

  /** How a thing stands, and, once checked, why. */
  verdict(key: string): { state: Verdict; why: string } {
    const truth = this.checked ? this.truths.get(key) : undefined;
    if (!truth) return { state: "open", why: "" };
    const chosen = this.chosen.has(key);
    // one right thing is all that is asked for, where there are others as good
    const enough = this.single && this.answer().right.length > 0;
    const state = truth.right ? (chosen ? "right" : enough ? "passed" : "missed") : chosen ? "wrong" : "passed";
    return { state, why: truth.why };
  }

  /** What came of it, in a sentence. */
  outcome(): string {
    const { right, wrong, missed } = this.answer();
    if (this.single) {
      const [chosen] = [...right, ...wrong];
      if (chosen === undefined)
        return [...this.truths.values()].some((own) => own.right) ? "Nothing was chosen." : "Right: there is none.";
      return `${right.length ? "Right." : "No."} ${this.truths.get(chosen)?.why ?? ""}`.trim();
    }
    if (!wrong.length && !missed.length) return right.length ? "All right." : "Right: there are none.";
    const parts = [`${right.length} right`];
    if (wrong.length) parts.push(`${wrong.length} wrong`);
    if (missed.length) parts.push(`${missed.length} missed`);
    return `${parts.join(", ")}.`;
  }

  watch(callback: () => void, signal: AbortSignal): void {
    this.watchers.add(callback);
    signal.addEventListener("abort", () => this.watchers.delete(callback));
  }

  /** Take back what was chosen. */
  clear(): void {
    this.checked = this.helped = this.tried = false;
    this.chosen.clear();
    this.tell();
  }

  private tell(): void {
    this.stamp++;
    for (const watcher of [...this.watchers]) watcher();
  }
}

let lists = 0;

/** What can be chosen as a list, and, once it is checked, how each thing stands and why. */
export function offers(quiz: Quiz, content: (key: string) => Node | string): HTMLElement {
  const name = `fnb-quiz-offers-${lists++}`;
  const items = [...quiz.truths.keys()].map((key) => {
    const { state, why } = quiz.verdict(key);
    const box = h("input", { type: quiz.single ? "radio" : "checkbox", name });
    box.checked = quiz.has(key);
    box.disabled = quiz.done;
    box.addEventListener("change", () => quiz.choose(key));
    const what = h("span", { class: "fnb-offer-what" }, content(key));
    return h(
      "li",
      { "data-verdict": state },
      h("label", {}, box, what),
      h("span", { class: "fnb-offer-why" }, sign(quiz, state), why),
    );
  });
  return h("ul", { class: "fnb-offers", "aria-label": quiz.prompt }, ...items);
}

/** The sign before the reason of a verdict. Where all that is right is to be chosen, it is also right to leave the rest. */
export function sign(quiz: Quiz, state: Verdict): string {
  const signs = { open: "", right: "✓ ", wrong: "✕ ", missed: "missed: ", passed: quiz.single ? "" : "✓ " };
  return signs[state];
}
