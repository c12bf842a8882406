// Runs: the same design searched twice, with one thing changed. Both networks stand side by side and go on node by node
// together, so that it is seen, and counted, what each of them expands.

import { h, mark, setText } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { Alternatives } from "../alternatives.ts";
import { Asking } from "../asking.ts";
import { AxisChoice } from "../axes.ts";
import { Links } from "../links.ts";
import { Player } from "../player.ts";
import { type Axis, Timeline, type TimelineData } from "../timeline.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";
import { network } from "./network.ts";

interface Counts {
  nodes: number;
  told: number;
  edges: number;
  pruned: number;
  passes: number;
  J: number | null;
}

interface Run {
  timeline: TimelineData;
  network: unknown;
  search: string;
  counts: Record<Axis, [Counts, Counts]>;
}

const CHANGES: [name: string, label: string][] = [
  ["heuristic", "the heuristic off: h = 0"],
  ["table", "the table off: no path is dropped for another"],
  ["paper", "the other search: the paper’s, or ours"],
];

const SEARCHES: Record<string, string> = {
  best: "Ours: best first",
  ida: "The paper’s: iterative deepening from both ends",
  "no-heuristic": "Ours, without the heuristic",
  "no-table": "Ours, without the table",
};

const COUNTED: [keyof Counts, string][] = [
  ["nodes", "nodes expanded"],
  ["edges", "edges weighed"],
  ["pruned", "edges pruned"],
  ["passes", "passes"],
  ["J", "J, m"],
];

export const runs: ViewKind = {
  title: "Runs",
  subtitle: "The same design searched twice, with one thing changed",
  needs: ["network"],
  make: (context) => new RunsView(context),
};

interface Side {
  el: HTMLElement;
  title: HTMLElement;
  said: HTMLElement;
  body: HTMLElement;
  view: View | null;
  player: Player | null;
  /** Where the nodes of the axis are expanded. */
  stops: number[];
}

class RunsView implements View {
  readonly el = h("div", { class: "fnb-runs" });
  readonly controls: HTMLElement[];
  private readonly change: HTMLSelectElement;
  private readonly choice: AxisChoice;
  private readonly slider = h("input", { type: "range", min: 0, value: 0, "aria-label": "Nodes expanded" });
  private readonly at = h("output", { class: "fnb-runs-at" });
  private readonly table = h("div", { class: "fnb-runs-counts" });
  private readonly note = h("p", { class: "fnb-empty", role: "status" });
  private readonly kept = h("p", { class: "fnb-empty", role: "status", hidden: true }, "Kept back while a view asks.");
  private readonly sides: [Side, Side];
  private own: AbortController | null = null;
  private run: Run | null = null;
  private axis: Axis = "x";

  constructor(private readonly context: ViewContext) {
    this.change = h("select", { "aria-label": "What is changed" });
    for (const [name, label] of CHANGES) this.change.append(h("option", { value: name }, label));
    this.change.value = context.model.get<string>("change") || "heuristic";
    this.change.addEventListener("change", () => {
      context.model.set("change", this.change.value);
      context.session.kernel?.save(context.model);
      void this.load();
    });
    this.choice = new AxisChoice(context.timeline, context.refresh);
    this.controls = [this.change, this.choice.el];
    this.sides = [side(), side()];
    this.slider.addEventListener("input", () => this.go());
    context.signal.addEventListener("abort", () => this.own?.abort("ended"));
    this.el.append(
      this.kept,
      this.note,
      h("label", { class: "fnb-runs-steps" }, "Node by node", this.slider, this.at),
      h("div", { class: "fnb-runs-sides" }, ...this.sides.map(({ el }) => el)),
      this.table,
    );
    void this.load();
  }

  show(position: number): void {
    // What both runs come to is what a view may ask for.
    const { on } = this.context.asking;
    mark(this.el, "data-asked", on);
    for (const part of this.el.children) if (part !== this.kept) (part as HTMLElement).inert = on;
    this.kept.hidden = !on;
    const axis = this.choice.at(position);
    if (axis === this.axis) return;
    this.axis = axis;
    this.begin();
  }

  private async load(): Promise<void> {
    const name = this.change.value;
    setText(this.note, "The other run is under way…");
    this.note.hidden = false;
    try {
      const run = await this.context.session.piece<Run>(`run_${name}`);
      if (this.context.signal.aborted || name !== this.change.value) return;
      this.run = run;
      this.note.hidden = true;
      this.begin();
    } catch (error) {
      setText(this.note, error instanceof Error ? error.message : String(error));
    }
  }

  /** Make both networks, and stand before the first node. */
  private begin(): void {
    if (!this.run) return;
    this.own?.abort("another run");
    const own = new AbortController();
    this.own = own;
    const { context, run } = this;
    const [ours, other] = this.sides;
    this.fill(ours, context.timeline, context.pieces.network, own.signal);
    this.fill(other, new Timeline(run.timeline), run.network, own.signal);
    this.slider.max = String(Math.max(ours.stops.length, other.stops.length));
    this.slider.value = "0";
    this.counted();
    this.go();
  }

  private fill(own: Side, timeline: Timeline, piece: unknown, signal: AbortSignal): void {
    const player = new Player(timeline, 0);
    const links = new Links([]);
    const taken = timeline.data.kinds.indexOf("NodeTaken");
    own.stops = Array.from(timeline.data.kind.keys()).filter(
      (at) => taken >= 0 && timeline.data.kind[at] === taken && timeline.axisAt(at) === this.axis,
    );
    own.player = player;
    const { session, model } = this.context;
    const alternatives = new Alternatives(() => new Promise(() => {}), timeline, links, signal);
    const refresh = () => own.view?.show(player.position);
    own.view = network.make({
      session,
      model,
      timeline,
      player,
      links,
      alternatives,
      asking: new Asking(),
      pieces: { network: piece },
      signal,
      refresh,
    });
    links.listen(own.view.el, signal);
    links.watch(() => own.view?.light?.(), signal);
    player.watch(refresh, signal);
    own.body.replaceChildren(own.view.el);
    setText(own.title, SEARCHES[timeline.data.search] ?? timeline.data.search);
  }

  /** Both after so many nodes; one that is done stays where it came to. */
  private go(): void {
    const n = Number(this.slider.value);
    setText(this.at, `${n}`);
    for (const own of this.sides) {
      if (!own.player) continue;
      const { timeline } = own.player;
      const first = timeline.begins("alignment", this.axis);
      const done = n > own.stops.length || (n > 0 && n === own.stops.length);
      const at = n === 0 ? first : (own.stops[n - 1] ?? own.stops.at(-1) ?? first);
      const end =
        timeline.data.stages.find(({ axis, stage }) => axis === this.axis && stage === "alignment")?.last ?? at;
      own.player.go(done ? end : at);
      own.view?.show(own.player.position);
      const many = (count: number) => `${count} node${count === 1 ? "" : "s"}`;
      const { length } = own.stops;
      setText(own.said, done ? `done after ${many(length)}` : `${many(Math.min(n, length))} expanded`);
      mark(own.el, "data-done", done);
    }
    this.table.hidden = n < Number(this.slider.max);
  }

  /** What both did in all; it is told when both are done. */
  private counted(): void {
    const { run } = this;
    if (!run) return;
    const [ours, other] = run.counts[this.axis];
    const text = (value: number | null) => (value === null ? "–" : formatNumber(value, 3));
    const names = this.sides.map(({ title }) => h("th", { scope: "col" }, title.textContent ?? ""));
    this.table.replaceChildren(
      h(
        "table",
        { class: "fnb-ledger", "aria-label": "What both runs did" },
        h("thead", {}, h("tr", {}, h("th", { scope: "col" }, `axis ${this.axis}`), ...names)),
        h(
          "tbody",
          {},
          ...COUNTED.map(([name, label]) =>
            h(
              "tr",
              {},
              h("th", { scope: "row" }, label),
              h("td", {}, text(ours[name])),
              h("td", {}, text(other[name])),
            ),
          ),
        ),
      ),
    );
  }
}

function side(): Side {
  const title = h("h4", {});
  const said = h("p", { class: "fnb-muted", role: "status" });
  const body = h("div", {});
  const el = h("section", { class: "fnb-runs-side" }, title, said, body);
  return { el, title, said, body, view: null, player: null, stops: [] };
}
