// Prediction: a view hides its answer, asks, checks what the reader chose, and explains.

/** What there is to be said of a thing that can be chosen. */
export interface Truth {
  right: boolean;
  why: string;
}

export type Verdict = "open" | "right" | "wrong" | "missed" | "passed";

export interface Answer {
  right: string[];
  wrong: string[];
  missed: string[];
}

/** A question of a view: the view draws what can be chosen, and asks here how it stands. */
export class Quiz {
  private asking = false;
  private checked = false;
  private readonly chosen = new Set<string>();
  private readonly watchers = new Set<() => void>();
  /** Goes up whenever something has changed: a view need not draw again before. */
  stamp = 0;

  /**
   * @param prompt the question
   * @param truths what can be chosen at present, by key, and whether it is right to choose it
   * @param single whether one thing is to be chosen, not all that are right
   */
  constructor(
    readonly prompt: string,
    private readonly truths: () => ReadonlyMap<string, Truth>,
    readonly single = false,
  ) {}

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

  has(key: string): boolean {
    return this.chosen.has(key);
  }

  ask(on: boolean): void {
    this.asking = on;
    this.again();
  }

  again(): void {
    this.checked = false;
    this.chosen.clear();
    this.tell();
  }

  choose(key: string): void {
    if (this.checked) return;
    if (this.single) this.chosen.clear();
    if (!this.chosen.delete(key)) this.chosen.add(key);
    this.tell();
  }

  check(): Answer {
    this.checked = true;
    this.tell();
    return this.answer();
  }

  answer(): Answer {
    const answer: Answer = { right: [], wrong: [], missed: [] };
    for (const [key, { right }] of this.truths()) {
      if (this.chosen.has(key)) answer[right ? "right" : "wrong"].push(key);
      else if (right && !this.single) answer.missed.push(key);
    }
    return answer;
  }

  /** How a thing stands, and, once checked, why. */
  verdict(key: string): { state: Verdict; why: string } {
    const truth = this.truths().get(key);
    if (!this.checked || !truth) return { state: "open", why: "" };
    const chosen = this.chosen.has(key);
    const state = truth.right ? (chosen ? "right" : "missed") : chosen ? "wrong" : "passed";
    return { state, why: truth.why };
  }

  /** What came of it, in a sentence. */
  outcome(): string {
    const { right, wrong, missed } = this.answer();
    if (this.single) {
      const [chosen] = [...right, ...wrong];
      if (chosen === undefined) return "Nothing was chosen.";
      return `${right.length ? "Right." : "No."} ${this.truths().get(chosen)?.why ?? ""}`.trim();
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

  private tell(): void {
    this.stamp++;
    for (const watcher of [...this.watchers]) watcher();
  }
}
