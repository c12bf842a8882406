// Which keys move one, and for how long each of them still does.

export type Way = "ahead" | "back" | "left" | "right" | "turnLeft" | "turnRight" | "up" | "down";

/** Milliseconds that each way is gone. */
export type Goings = Partial<Record<Way, number>>;

const LEAST = 60; // milliseconds that a key moves one for, however shortly it is pressed
const LONGEST = 250; // and that a frame moves one for at most, however long it took

interface Press {
  from: number;
  /** When it was let go; null while it is held. */
  until: number | null;
  /** Up to when it has moved one. */
  gone: number;
}

/** Keys by the times of their events: however late a frame comes, each press moves one as long as it lasted. */
export class Held {
  readonly #presses = new Map<Way, Press>();

  get moving(): boolean {
    return this.#presses.size > 0;
  }

  press(way: Way, time: number): void {
    const known = this.#presses.get(way);
    if (known?.until === null) return; // the keyboard repeats it
    const gone = known ? Math.max(known.gone, time) : time;
    this.#presses.set(way, { from: time, until: null, gone });
  }

  release(way: Way, time: number): void {
    const press = this.#presses.get(way);
    if (press?.until === null) press.until = Math.max(time, press.from + LEAST);
  }

  releaseAll(time: number): void {
    for (const way of this.#presses.keys()) this.release(way, time);
  }

  /** How long each way is gone in the frame at this time. */
  take(now: number): Goings {
    const goings: Goings = {};
    for (const [way, press] of this.#presses) {
      const end = press.until ?? now;
      const due = Math.min(Math.max(end - press.gone, 0), LONGEST);
      goings[way] = due;
      press.gone = Math.max(press.gone, now);
      // One that was let go is gone to its end at once: the next frame may be late.
      if (press.until !== null) this.#presses.delete(way);
    }
    return goings;
  }
}
