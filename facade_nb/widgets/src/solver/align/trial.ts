// Trying an alignment by hand: the handles on its boundaries, for the pointer and for keys.

import { h, mark } from "../../shared/dom.ts";
import { type PathNote, restOf } from "../network/story.ts";
import { type Cuts, choices, type Drawn, merged, moved, positionOf, split } from "./matrix.ts";

/** A boundary of one word, or, without one, of all. */
interface Grip {
  boundary: number;
  band: number | null;
}

export class Trial {
  constructor(
    private readonly path: PathNote,
    private cuts: Cuts,
    private readonly drawn: Drawn,
    private readonly attempt: (next: Cuts) => void,
    private readonly signal: AbortSignal,
  ) {}

  get count(): number {
    return this.cuts.places.length;
  }

  /** The handle of a boundary, in the row of a band or above all. */
  handle(boundary: number, band: number | null, row: string): HTMLElement {
    const { path } = this;
    const grip: Grip = { boundary, band };
    const bands = band === null ? path.bands.map((_, b) => b) : [band];
    const options = band === null ? [] : choices(path, this.cuts, boundary, band);
    const place = band === null ? boundary : (this.cuts.places[boundary]?.[band] ?? 0);
    const rest = band === null ? "" : restOf(path.bands[band] as never, place);
    const handle = h("span", {
      class: band === null ? "fnb-align-grip" : "fnb-align-handle",
      role: "slider",
      tabindex: 0,
      "data-handle": `${path.axis}:${path.group}:${boundary}:${row}`,
      "aria-label": band === null ? `Boundary ${boundary} of all rows` : `Boundary ${boundary} of ${row}`,
      "aria-valuemin": band === null ? boundary : (options[0] ?? 0),
      "aria-valuemax": band === null ? boundary : (options.at(-1) ?? 0),
      "aria-valuenow": place,
      "aria-valuetext": band === null ? null : `before ${rest}`,
      title: "Drag, or move by the arrow keys; Delete takes the boundary away",
    });
    handle.style.left = `${((100 * (this.drawn.boundaries[boundary] ?? 0)) / this.drawn.width).toFixed(3)}%`;
    handle.addEventListener("keydown", (event) => this.key(event, grip, bands));
    handle.addEventListener("pointerdown", (event) => this.drag(event, handle, grip, bands));
    return handle;
  }

  /** The button that cuts a column in two. */
  splitter(column: number): HTMLElement {
    const label = `Cut column ${column + 1} in two`;
    const button = h("button", { type: "button", class: "fnb-align-split", title: label, "aria-label": label }, "+");
    button.addEventListener("click", () => this.attempt(split(this.path, this.cuts, column)));
    return button;
  }

  private key(event: KeyboardEvent, { boundary }: Grip, bands: readonly number[]): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Delete" || event.key === "Backspace") {
      event.preventDefault();
      this.attempt(merged(this.cuts, boundary));
      return;
    }
    const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!by) return;
    event.preventDefault();
    let next = this.cuts;
    for (const band of bands) {
      const options = choices(this.path, next, boundary, band);
      const at = options.indexOf(next.places[boundary]?.[band] ?? 0) + by;
      const place = options[Math.max(0, Math.min(options.length - 1, at))];
      if (place !== undefined) next = moved(next, boundary, band, place);
    }
    this.attempt(next);
  }

  private drag(down: PointerEvent, handle: HTMLElement, { boundary }: Grip, bands: readonly number[]): void {
    down.preventDefault();
    handle.focus({ preventScroll: true });
    const track = handle.parentElement;
    if (!track) return;
    const box = track.getBoundingClientRect();
    // Where each place lies stays as it was when the drag began, so that the boundary does not run away from the pointer.
    const lies = bands.map((band) =>
      choices(this.path, this.cuts, boundary, band).map(
        (place) => [place, positionOf(this.path, this.drawn, band, place)] as const,
      ),
    );
    const end = new AbortController();
    let last = "";
    mark(document.documentElement, "data-fnb-dragging", true);
    const move = (event: PointerEvent) => {
      const at = ((event.clientX - box.left) / box.width) * this.drawn.width;
      let next = this.cuts;
      for (const [n, band] of bands.entries()) {
        const nearest = lies[n]?.reduce((a, b) => (Math.abs(b[1] - at) < Math.abs(a[1] - at) ? b : a));
        if (nearest) next = moved(next, boundary, band, nearest[0]);
      }
      const stamp = JSON.stringify(next);
      if (stamp === last) return;
      last = stamp;
      this.attempt(next);
    };
    const stop = () => {
      mark(document.documentElement, "data-fnb-dragging", null);
      end.abort();
    };
    // The handle is made anew at every step: the pointer is followed on the page.
    window.addEventListener("pointermove", move, { signal: end.signal });
    window.addEventListener("pointerup", stop, { signal: end.signal });
    window.addEventListener("pointercancel", stop, { signal: end.signal });
    this.signal.addEventListener("abort", stop, { signal: end.signal });
  }
}
