// How long a hand paused between two entries, by the page's clock: what is typed in one go is one step of undo, however late
// and in how many pieces it comes to the kernel. So is what is dragged in one go, however long the hand rests meanwhile.

/** A message that enters something; `after`: seconds since the entry before it. */
export type Entry = { op: string; after?: number; [argument: string]: unknown };

/** The press under way of a mouse, pen or finger, each with a number of its own; 0: none. */
let press = 0;
let presses = 0;
window.addEventListener(
  "pointerdown",
  () => {
    press = ++presses;
  },
  true,
);
for (const name of ["pointerup", "pointercancel"])
  window.addEventListener(
    name,
    () => {
      press = 0;
    },
    true,
  );

export class Pauses {
  private last: { when: number; press: number } | null = null;

  /** The message that enters something now. In the place of one that has not left, it goes on from the entry before that. */
  enter(message: Entry, instead?: Entry): Entry {
    const before = this.last;
    this.last = { when: performance.now(), press };
    const own = instead ? instead.after : before ? pause(before, this.last) : undefined;
    return own === undefined ? message : { ...message, after: own };
  }
}

/** Seconds between two entries; a hand that holds on has not paused. */
function pause(before: { when: number; press: number }, now: { when: number; press: number }): number {
  return now.press !== 0 && now.press === before.press ? 0 : (now.when - before.when) / 1000;
}
