// The timeline of a trace, as facade_nb/widgets/solver/timeline.py tells it.

export type Axis = "x" | "y";

export interface Stage {
  axis: Axis | "";
  stage: string;
  title: string;
  first: number;
  last: number;
  seconds: number | null;
}

export interface Mark {
  at: number;
  kind: string;
  text: string;
}

export interface PatternInfo {
  name: string;
  text: string;
  counters: string[];
  layers: Record<Axis, string[]>;
}

export interface TimelineData {
  name: string;
  canvas: Record<Axis, number>;
  kinds: string[];
  kind: Uint8Array;
  stages: Stage[];
  marks: Mark[];
  /** Where an alignment is found that is cheaper than all before it in its network. */
  improved: Int32Array;
  patterns: PatternInfo[];
  /** A number for each symbol, by which every view colours it. */
  symbols: Record<string, number>;
  /** Preferred sizes of symbols, metres; null: it has none. A page that was saved earlier may not have them. */
  sizes?: Record<string, number | null>;
  /** The candidate that became the layout: where that is told, its number, the word of each pattern. */
  chosen: Record<Axis, { at: number; number: number; words: Record<string, string> } | null>;
  objective: Record<string, unknown>;
  search: string;
  seconds: number | null;
  failure: string;
}

export class Timeline {
  readonly count: number;

  constructor(readonly data: TimelineData) {
    this.count = data.kind.length;
  }

  get last(): number {
    return this.count - 1;
  }

  kindAt(position: number): string {
    return this.data.kinds[this.data.kind[position] ?? 0] ?? "";
  }

  /** Number of the stage that an event belongs to. */
  stageAt(position: number): number {
    const { stages } = this.data;
    let [low, high] = [0, stages.length - 1];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if ((stages[middle]?.first ?? 0) <= position) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** The axis that is spoken of at a position; x where both are. */
  axisAt(position: number): Axis {
    return this.data.stages[this.stageAt(position)]?.axis || "x";
  }

  /** The first event of a stage of an axis; the first of all where there is no such stage. */
  begins(stage: string, axis: Axis): number {
    return this.data.stages.find((own) => own.stage === stage && own.axis === axis)?.first ?? 0;
  }

  /** A position as text: the axis, the stage, and how many events into it, `x/words+12` (widgets/solver/timeline.py). */
  momentOf(position: number): string {
    const at = this.stageAt(position);
    const own = this.data.stages[at];
    if (!own) return "both/merging+0";
    const before = this.data.stages.slice(0, at).filter((s) => s.axis === own.axis && s.stage === own.stage).length;
    return `${own.axis || "both"}/${own.stage}${before ? `.${before + 1}` : ""}+${position - own.first}`;
  }

  /** The position that `momentOf` wrote, or the one nearest to it; undefined for what is no moment of this trace. */
  locate(moment: string): number | undefined {
    const found = /^(x|y|both)\/([a-z]+)(?:\.(\d+))?(?:\+(\d+))?$/.exec(moment);
    if (!found) return undefined;
    const [, axis, stage, turn = "1", offset = "0"] = found;
    const own = this.data.stages.filter((s) => (s.axis || "both") === axis && s.stage === stage);
    const chosen = own[Math.min(Number(turn), own.length) - 1];
    return chosen && Math.min(chosen.first + Number(offset), chosen.last);
  }
}

/** How many of some events, by their ascending positions, have been played at a position. */
export function played(at: ArrayLike<number>, position: number): number {
  let [low, high] = [0, at.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((at[middle] ?? 0) <= position) low = middle + 1;
    else high = middle;
  }
  return low;
}
