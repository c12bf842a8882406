// How long a hand paused between two entries, by the page's clock: what is typed in one go is one step of undo, however late
// and in how many pieces it comes to the kernel.

/** A message that enters something; `after`: seconds since the entry before it. */
export type Entry = { op: string; after?: number; [argument: string]: unknown };

export class Pauses {
  private last: number | null = null;

  /** The message that enters something now. In the place of one that has not left, it goes on from the entry before that. */
  enter(message: Entry, instead?: Entry): Entry {
    const now = performance.now();
    const after = this.last === null ? undefined : (now - this.last) / 1000;
    this.last = now;
    const own = instead ? instead.after : after;
    return own === undefined ? message : { ...message, after: own };
  }
}
