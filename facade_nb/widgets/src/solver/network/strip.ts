// The course of a search in time: its passes, the limit of each, what is proven, and the best that was found. A click goes
// to the moment. What has not been played is not told.

import { h, mark, svg } from "../../shared/dom.ts";
import type { Player } from "../player.ts";
import { played } from "../timeline.ts";
import { metres } from "./numbers.ts";
import { MET, type Story, type Subject, TAKEN } from "./story.ts";

const [WIDE, HIGH, TOP, BOTTOM] = [1000, 74, 6, 8];

interface Course {
  first: number;
  last: number;
  /** Of each: where it is told, and its value. */
  limits: [number, number][];
  bounds: [number, number][];
  best: [number, number][];
}

/** What is told of a network's search, each list in its order. */
export function courseOf(story: Story, subject: Subject): Course {
  const { data } = story;
  const own = (note: { axis: string; network: number }) =>
    note.axis === subject.axis && note.network === subject.network;
  const closed = data.networks.find(own)?.closed;
  const limits = data.limits.filter(own);
  const bounds: [number, number][] = [];
  const prove = (at: number, value: number | null | undefined) => {
    const known = bounds.at(-1)?.[1] ?? Number.NEGATIVE_INFINITY;
    if (value != null && value > known + 1e-9) bounds.push([at, value]);
  };
  const proofs: [number, number | null][] = limits.map(({ at, bound }) => [at, bound]);
  if (subject.search !== "ida")
    for (const step of subject.kinds[TAKEN]?.steps ?? [])
      proofs.push([data.steps.at[step] ?? 0, data.steps.bound[step] ?? null]);
  for (const [at, value] of proofs.sort((a, b) => a[0] - b[0])) prove(at, value);
  if (closed) prove(closed.at, closed.bound);
  const found: [number, number | null][] = [
    ...data.priced.filter(own).map(({ at, cost }): [number, number | null] => [at, cost]),
    ...data.merged.filter(own).map(({ at, cost }): [number, number | null] => [at, cost]),
  ];
  const index = data.networks.findIndex(own);
  for (const [step, kind] of data.steps.kind.entries())
    if (kind === MET && data.steps.network[step] === index)
      found.push([data.steps.at[step] ?? 0, data.steps.cost[step] ?? null]);
  const best: [number, number][] = [];
  for (const [at, cost] of found.sort((a, b) => a[0] - b[0]))
    if (cost !== null && cost < (best.at(-1)?.[1] ?? Number.POSITIVE_INFINITY) - 1e-9) best.push([at, cost]);
  const first = subject.first;
  return {
    first,
    last: Math.max(first + 1, closed?.at ?? subject.at.at(-1) ?? first + 1),
    limits: limits.flatMap(({ at, limit }): [number, number][] => (limit === null ? [] : [[at, limit]])),
    bounds,
    best,
  };
}

export class Strip {
  private readonly drawing = svg("svg", {
    class: "fnb-strip-drawing",
    viewBox: `0 0 ${WIDE} ${HIGH}`,
    preserveAspectRatio: "none",
  });
  private readonly said = h("p", { class: "fnb-strip-said" });
  private readonly track = h("div", {
    class: "fnb-strip-track",
    role: "slider",
    tabindex: 0,
    "aria-label": "Course of the search",
    title: "The course of the search: click to go there",
  });
  readonly el = h("div", { class: "fnb-strip" }, this.track, this.said);
  private readonly courses = new Map<Subject, Course>();
  private course: Course | null = null;

  constructor(
    private readonly story: Story,
    private readonly player: Player,
  ) {
    this.track.append(this.drawing as unknown as Node);
    const go = (event: PointerEvent) => {
      if (!this.course) return;
      const box = this.track.getBoundingClientRect();
      const share = Math.max(0, Math.min(1, (event.clientX - box.left) / Math.max(1, box.width)));
      const { first, last } = this.course;
      this.player.pause();
      this.player.go(Math.round(first + share * (last - first)));
    };
    this.track.addEventListener("pointerdown", (event) => {
      this.track.setPointerCapture?.(event.pointerId);
      go(event);
    });
    this.track.addEventListener("pointermove", (event) => this.track.hasPointerCapture?.(event.pointerId) && go(event));
    this.track.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!by || !this.course) return;
      event.preventDefault();
      const stops = this.course.limits.map(([at]) => at);
      const before = played(stops, this.player.position);
      const to = by > 0 ? stops[before] : stops[before - (stops[before - 1] === this.player.position ? 2 : 1)];
      if (to !== undefined) this.player.go(to);
    });
  }

  /** Tell nothing: while a question is asked it would say what comes next. */
  hide(): void {
    this.el.hidden = true;
    this.drawing.replaceChildren();
    this.said.replaceChildren();
  }

  /** Draw what is told up to a moment; false: nothing is, of this network. */
  show(subject: Subject, position: number): boolean {
    let course = this.courses.get(subject);
    if (!course) {
      course = courseOf(this.story, subject);
      this.courses.set(subject, course);
    }
    this.course = course;
    const { first, last } = course;
    this.el.hidden = subject.network < 0 || !course.limits.length;
    if (this.el.hidden) return false;
    const seen = (list: [number, number][]) => list.filter(([at]) => at <= position);
    const [limits, bounds, best] = [seen(course.limits), seen(course.bounds), seen(course.best)];
    const values = [...limits, ...bounds, ...best].map(([, value]) => value);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const spread = Math.max(high - low, 1e-9);
    const x = (at: number) => (WIDE * (at - first)) / (last - first);
    const y = (value: number) =>
      high - low < 1e-9 ? HIGH / 2 : TOP + ((HIGH - TOP - BOTTOM) * (high - value)) / spread;
    const now = Math.max(first, Math.min(last, position));
    const parts: SVGElement[] = limits.map(([at], n) =>
      svg("rect", {
        class: "fnb-strip-pass",
        "data-odd": n % 2 === 1,
        x: x(at),
        y: 0,
        width: Math.max(0, x(limits[n + 1]?.[0] ?? now) - x(at)),
        height: HIGH,
      }),
    );
    const line = (list: [number, number][], kind: string) => {
      const begun = list[0];
      if (!begun) return;
      const turns = list.slice(1).map(([at, value]) => `H${x(at)}V${y(value)}`);
      const d = `M${x(begun[0])} ${y(begun[1])}${turns.join("")}H${x(now)}`;
      parts.push(svg("path", { class: `fnb-strip-line fnb-strip-${kind}`, d }));
    };
    line(limits, "limit");
    line(bounds, "bound");
    line(best, "best");
    parts.push(svg("line", { class: "fnb-strip-now", x1: x(now), x2: x(now), y1: 0, y2: HIGH }));
    this.drawing.replaceChildren(...parts);
    const value = (list: [number, number][]) => {
      const own = list.at(-1);
      return own ? `${metres(own[1])} m` : "–";
    };
    const key = (kind: string, text: string) =>
      h("span", {}, h("i", { class: `fnb-strip-key fnb-strip-key-${kind}` }), text);
    this.said.replaceChildren(
      h("span", {}, `Pass ${limits.length}`),
      key("limit", `limit ${value(limits)}`),
      key("bound", `proven: J ≥ ${value(bounds)}`),
      key("best", `best so far ${value(best)}`),
    );
    mark(this.track, "aria-valuemin", String(first));
    mark(this.track, "aria-valuemax", String(last));
    mark(this.track, "aria-valuenow", String(now));
    mark(this.track, "aria-valuetext", this.said.textContent);
    return true;
  }
}
