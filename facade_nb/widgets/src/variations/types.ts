// What facade_nb/widgets/variations/channel.py tells.

export interface VariantRow {
  values: (number | null)[];
  /** Whether it has a design that can be opened. */
  opens: boolean;
  state: "waiting" | "done" | "error";
  error?: string;
  seconds?: number;
  windows?: number;
  shapes?: number;
  cost?: [x: number, y: number];
  proven?: boolean;
}

export interface RunState {
  running: boolean;
  /** The row whose design is that of the studio; -1: none is. */
  opened: number;
}

/** Elevations by row, drawn for a theme. */
export interface Pictures {
  theme: string;
  drawn: Record<string, string>;
}
