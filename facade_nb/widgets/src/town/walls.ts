// Walking between the walls: their feet on the ground, in a net of cells.

export type Spot = [x: number, z: number];

const CELL = 16; // metres
const STEP = 0.2; // metres that one goes at a time: less than one is wide
/** Metres that one keeps from a wall. */
export const KEPT = 0.45;

export class Walls {
  private readonly left: number = 0;
  private readonly top: number = 0;
  private readonly columns: number = 1;
  private readonly rows: number = 1;
  /** Walls of each cell: where they begin in `inside`. */
  private readonly begin: Int32Array;
  private readonly inside: Int32Array;

  /** `edges`: x and z of both ends of each wall. */
  constructor(private readonly edges: Float32Array) {
    const count = edges.length / 4;
    let [low, high, up, down] = [Infinity, -Infinity, Infinity, -Infinity];
    for (let k = 0; k < edges.length; k += 2) {
      low = Math.min(low, edges[k] as number);
      high = Math.max(high, edges[k] as number);
      up = Math.min(up, edges[k + 1] as number);
      down = Math.max(down, edges[k + 1] as number);
    }
    if (count > 0) {
      this.left = low;
      this.top = up;
      this.columns = Math.floor((high - low) / CELL) + 1;
      this.rows = Math.floor((down - up) / CELL) + 1;
    }
    const sizes = new Int32Array(this.columns * this.rows + 1);
    const each = (act: (cell: number, wall: number) => void) => {
      for (let wall = 0; wall < count; wall += 1) {
        const [x0, z0, x1, z1] = this.ends(wall);
        const [c0, c1] = [this.column(Math.min(x0, x1)), this.column(Math.max(x0, x1))];
        const [r0, r1] = [this.row(Math.min(z0, z1)), this.row(Math.max(z0, z1))];
        for (let r = r0; r <= r1; r += 1) for (let c = c0; c <= c1; c += 1) act(r * this.columns + c, wall);
      }
    };
    each((cell) => {
      sizes[cell + 1] = (sizes[cell + 1] as number) + 1;
    });
    for (let k = 1; k < sizes.length; k += 1) sizes[k] = (sizes[k] as number) + (sizes[k - 1] as number);
    this.begin = sizes;
    this.inside = new Int32Array(sizes.at(-1) as number);
    const filled = sizes.slice();
    each((cell, wall) => {
      this.inside[filled[cell] as number] = wall;
      filled[cell] = (filled[cell] as number) + 1;
    });
  }

  /** Where one gets to, going from one spot to another: along a wall, never through it. */
  walk(from: Spot, to: Spot): Spot {
    const steps = Math.max(1, Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / STEP));
    const [dx, dz] = [(to[0] - from[0]) / steps, (to[1] - from[1]) / steps];
    let at = from;
    for (let k = 0; k < steps; k += 1) {
      const next = this.pushed([at[0] + dx, at[1] + dz]);
      if (this.crossed(at, next)) return at;
      at = next;
    }
    return at;
  }

  /** The nearest spot that lies out of doors. */
  outside(spot: Spot): Spot {
    if (!this.within(spot)) return this.pushed(spot);
    for (let radius = 1; radius < 200; radius += 1)
      for (let k = 0; k < 16; k += 1) {
        const turn = (k * Math.PI) / 8;
        const near: Spot = [spot[0] + radius * Math.cos(turn), spot[1] + radius * Math.sin(turn)];
        const free = this.pushed(near);
        if (!this.within(near) && !this.within(free)) return free;
      }
    return spot;
  }

  /** Whether a spot lies within a building: a line to the east crosses an odd number of its walls. */
  within([x, z]: Spot): boolean {
    const row = Math.floor((z - this.top) / CELL);
    if (row < 0 || row >= this.rows) return false;
    const seen = new Set<number>();
    let odd = false;
    for (let c = this.column(x); c < this.columns; c += 1)
      for (const wall of this.of(row * this.columns + c)) {
        if (seen.has(wall)) continue;
        seen.add(wall);
        const [x0, z0, x1, z1] = this.ends(wall);
        if (z0 > z !== z1 > z && x < x0 + ((z - z0) / (z1 - z0)) * (x1 - x0)) odd = !odd;
      }
    return odd;
  }

  /** The spot, pushed away from the walls near to it. */
  private pushed(spot: Spot): Spot {
    let [x, z] = spot;
    for (let turn = 0; turn < 3; turn += 1) {
      let free = true;
      for (const wall of this.near(x, z)) {
        const [x0, z0, x1, z1] = this.ends(wall);
        const [wx, wz] = [x1 - x0, z1 - z0];
        const part = Math.min(1, Math.max(0, ((x - x0) * wx + (z - z0) * wz) / Math.max(wx * wx + wz * wz, 1e-9)));
        const [ax, az] = [x - x0 - part * wx, z - z0 - part * wz];
        const away = Math.hypot(ax, az);
        if (away >= KEPT - 1e-6 || away < 1e-9) continue;
        x += (ax / away) * (KEPT - away);
        z += (az / away) * (KEPT - away);
        free = false;
      }
      if (free) break;
    }
    return [x, z];
  }

  /** Whether the way between two spots near to each other crosses a wall. */
  private crossed(a: Spot, b: Spot): boolean {
    for (const wall of this.near(a[0], a[1])) {
      const [x0, z0, x1, z1] = this.ends(wall);
      const side = ([x, z]: Spot) => (x1 - x0) * (z - z0) - (z1 - z0) * (x - x0);
      const other = (x: number, z: number) => (b[0] - a[0]) * (z - a[1]) - (b[1] - a[1]) * (x - a[0]);
      if (side(a) > 0 !== side(b) > 0 && other(x0, z0) > 0 !== other(x1, z1) > 0) return true;
    }
    return false;
  }

  private *near(x: number, z: number): Generator<number> {
    const [c0, c1] = [this.column(x - 1), this.column(x + 1)];
    const [r0, r1] = [this.row(z - 1), this.row(z + 1)];
    for (let r = r0; r <= r1; r += 1) for (let c = c0; c <= c1; c += 1) yield* this.of(r * this.columns + c);
  }

  private of(cell: number): Int32Array {
    return this.inside.subarray(this.begin[cell], this.begin[cell + 1]);
  }

  private column(x: number): number {
    return Math.min(this.columns - 1, Math.max(0, Math.floor((x - this.left) / CELL)));
  }

  private row(z: number): number {
    return Math.min(this.rows - 1, Math.max(0, Math.floor((z - this.top) / CELL)));
  }

  private ends(wall: number): [number, number, number, number] {
    const { edges } = this;
    const at = 4 * wall;
    return [edges[at] as number, edges[at + 1] as number, edges[at + 2] as number, edges[at + 3] as number];
  }
}
