// What is asked at present, in the views of one widget: what would give an answer away is kept back in it meanwhile. In
// other widgets it is not: a notebook may have many questions of one trace, each with a player of its own.

export class Asking {
  private readonly asked = new Map<object, number>();
  private readonly watchers = new Set<() => void>();

  /** Whether a view asks. */
  get on(): boolean {
    return this.asked.size > 0;
  }

  /** Position of the first event that would give an answer away; none does where it is infinite. */
  get from(): number {
    return Math.min(Number.POSITIVE_INFINITY, ...this.asked.values());
  }

  /** The same of what all others than one ask. */
  fromOf(who: object | undefined): number {
    const others = [...this.asked].flatMap(([own, from]) => (own === who ? [] : [from]));
    return Math.min(Number.POSITIVE_INFINITY, ...others);
  }

  /** Say what someone asks: the first event that tells the answer, or null where nothing is asked any more. */
  set(who: object, from: number | null): void {
    const before = this.asked.get(who) ?? null;
    if (from === before) return;
    if (from === null) this.asked.delete(who);
    else this.asked.set(who, from);
    for (const watcher of [...this.watchers]) watcher();
  }

  /** Call back when that has changed. */
  watch(callback: () => void, signal: AbortSignal): void {
    this.watchers.add(callback);
    signal.addEventListener("abort", () => this.watchers.delete(callback));
  }
}
