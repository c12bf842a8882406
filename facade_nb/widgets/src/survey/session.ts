// What the editors of one survey on a page share: what is drawn, which opening is picked, and the photograph.

import { Entering } from "../shared/entering.ts";
import { oneFor } from "../shared/one.ts";
import { type Bytes, byteLength, bytesOf } from "../shared/packing.ts";
import { moved } from "./snapping.ts";
import type { Drawn, Kind, Opening, Point, Rect } from "./types.ts";

const TRAITS = ["drawn", "can_undo", "can_redo", "trouble"] as const;

export class Session extends Entering<"drawn"> {
  static readonly of = oneFor((channel) => new Session(channel));

  /** The opening that is picked; -1: none is. */
  picked = -1;
  /** What is drawn next. */
  kind: Kind = "window";
  /** Whether the four corners are being placed. */
  cornering = false;
  /** Address of the photograph in this page; "": there is none. */
  photo = "";
  private shift: Point = [0, 0];

  get drawn(): Drawn {
    return this.value<Drawn>("drawn");
  }
  get opening(): Opening | undefined {
    return this.drawn.openings[this.picked];
  }
  /** Whether something can be changed. */
  get open(): boolean {
    return this.live;
  }

  pick(opening: number): void {
    if (opening === this.picked) return;
    this.picked = opening;
    this.shift = [0, 0];
    this.tell();
  }

  /** Draw something else. With a key, a run of it is one step of undo. */
  change(what: Partial<Drawn>, key?: string): void {
    if (!this.open) return;
    const { key: _, ...now } = this.drawn;
    this.set("drawn", { ...now, ...what, ...(key ? { key } : {}) });
  }

  /** Give an opening another rectangle or kind. */
  edit(number: number, what: Partial<Opening>, key?: string): void {
    const openings = this.drawn.openings.map((own, k) => (k === number ? { ...own, ...what } : own));
    this.change({ openings }, key);
  }

  add(opening: Opening): void {
    if (!this.open) return;
    this.picked = this.drawn.openings.length;
    this.shift = [0, 0];
    this.change({ openings: [...this.drawn.openings, opening] });
  }

  /** A copy of the picked one beside it: as far as the last copy went, else as its neighbour on the left stands from it. */
  copy(): void {
    const own = this.opening;
    if (!own) return;
    const [, , right] = own.rect;
    const { width } = this.drawn;
    const far = this.shift[0] || this.shift[1] ? this.shift : ([pitch(own.rect, this.drawn), 0] as Point);
    const step: Point = right + far[0] > width + 1e-6 && !far[1] ? [-far[0], 0] : far;
    this.add({ kind: own.kind, rect: moved(own.rect, step[0], step[1], this.drawn) });
    this.shift = step;
  }

  /** A copy was put so far from what it is one of: the next one goes as far. */
  copied(opening: Opening, from: Rect): void {
    this.add(opening);
    this.shift = [opening.rect[0] - from[0], opening.rect[1] - from[1]];
  }

  remove(): void {
    if (!this.opening || !this.open) return;
    const openings = this.drawn.openings.filter((_, k) => k !== this.picked);
    this.picked = Math.min(this.picked, openings.length - 1);
    this.change({ openings });
  }

  /** Make the façade so large that a length of the picked opening is what is known. */
  scale(axis: "x" | "y", length: number, known: number): void {
    this.request({ op: "scale", axis, length, known });
  }

  openFile(text: string): void {
    this.picked = -1;
    this.request({ op: "open", text });
  }

  /** Show a photograph of the page's; it goes nowhere. */
  show(file: Blob): void {
    URL.revokeObjectURL(this.photo);
    this.photo = URL.createObjectURL(file);
    this.tell();
  }

  corner(on: boolean): void {
    this.cornering = on;
    this.tell();
  }

  redraw(): void {
    this.tell();
  }

  private readonly onPhoto = (): void => {
    const bytes = this.channel.get<Bytes | null>("photo");
    if (byteLength(bytes) && bytes) this.show(new Blob([bytesOf(bytes)]));
  };

  protected override begin(): void {
    super.begin();
    for (const name of TRAITS)
      this.listen(name, () => {
        this.picked = Math.min(this.picked, this.drawn.openings.length - 1);
        this.tell();
      });
    this.listen("photo", this.onPhoto);
    if (!this.photo) this.onPhoto();
  }
}

/** From the next opening on the left in the same row to this one; twice its width where there is none. */
function pitch([left, bottom, right, top]: Rect, { openings }: Drawn): number {
  const row = openings.filter(({ rect }) => rect[0] < left - 1e-6 && rect[1] < top && rect[3] > bottom);
  const nearest = Math.max(...row.map(({ rect }) => rect[0]));
  return row.length ? left - nearest : 2 * (right - left);
}
