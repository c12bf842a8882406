// Alignment: the matrix as the paper draws it (Eq. 8), to scale, with sizes and errors below. A boundary can be dragged,
// or moved by keys: then Ω and what the alignment breaks are those of the reader's own, judged in the browser.

import { h, mark } from "../../dom.ts";
import { formatNumber } from "../../fields.ts";
import { asSolved, atPreferred, type Cuts, columnsOf, cutsOf, type Drawn } from "../align/matrix.ts";
import { columnsTable } from "../align/table.ts";
import { Trial } from "../align/trial.ts";
import type { Alternative } from "../alternatives.ts";
import { AxisChoice } from "../axes.ts";
import type { PathNote } from "../network/story.ts";
import { Placing, type PlacingData } from "../placing.ts";
import type { Axis } from "../timeline.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";
import { Group, judge, type Objective, type Verdict } from "../weighing.ts";

interface AlignmentData {
  paths: PathNote[];
  placements: Record<string, string>;
}

export const alignment: ViewKind = {
  title: "Alignment",
  subtitle: "The words in columns, to scale, with the error of each (Eq. 8, 9); drag a boundary to try another",
  needs: ["alignment", "placing"],
  make: (context) => new AlignmentView(context),
};

type Sizes = "auto" | "preferred" | "solved";

class AlignmentView implements View {
  readonly el = h("div", { class: "fnb-alignment" });
  readonly controls: HTMLElement[];
  private readonly data: AlignmentData;
  private readonly placing: Placing;
  private readonly choice: AxisChoice;
  private readonly tabs: [Sizes, HTMLButtonElement][];
  private readonly note = h("p", { class: "fnb-empty" });
  private readonly groups = new Map<PathNote, Group>();
  /** The reader's own alignments, by group. */
  private readonly tried = new Map<PathNote, Cuts>();
  private sizes: Sizes = "auto";
  /** Groups of the chosen candidate that the solver did not align. */
  private unaligned: ReadonlySet<PathNote> = new Set();
  private by = "";

  constructor(private readonly context: ViewContext) {
    this.data = context.pieces.alignment as AlignmentData;
    this.placing = new Placing(context.pieces.placing as PlacingData, context.timeline.data.chosen);
    this.choice = new AxisChoice(context.timeline, context.refresh, context.alternatives);
    const sizes: [Sizes, string][] = [
      ["auto", "As far as it is played"],
      ["preferred", "At preferred sizes, before sizing"],
      ["solved", "At solved sizes"],
    ];
    this.tabs = sizes.map(([name, title]) => {
      const tab = h("button", { type: "button", class: "fnb-tab", title }, name === "auto" ? "auto" : `${name} sizes`);
      tab.addEventListener("click", () => {
        this.sizes = name;
        context.refresh();
      });
      return [name, tab];
    });
    const tabs = h(
      "span",
      { class: "fnb-tabs", role: "group", "aria-label": "Sizes" },
      ...this.tabs.map(([, tab]) => tab),
    );
    this.controls = [this.choice.el, tabs];
  }

  show(position: number): void {
    const axis = this.choice.at(position);
    const other = this.context.alternatives.at(position, axis);
    this.unaligned = new Set(other?.groups.flatMap(({ path, aligned }) => (aligned ? [] : [path])));
    const paths = other
      ? other.groups.map(({ path }) => path)
      : this.data.paths.filter((path) => path.axis === axis && path.at <= position);
    const said = other ? `${other.name}. ${other.fate} ${whatIsShown(other)}` : this.context.alternatives.trouble;
    const solved = other ? [] : paths.filter((path) => this.isPlaced(path, position));
    for (const [name, tab] of this.tabs) mark(tab, "aria-pressed", String(name === this.sizes));
    const shown = this.sizes !== "auto" ? this.sizes : solved.length ? "solved" : "preferred";
    for (const [name, tab] of this.tabs) mark(tab, "data-shown", name === shown);
    const now = paths.find((path) => path.at === position)?.group ?? "";
    const by = [
      axis,
      said,
      this.sizes,
      now,
      ...paths.map((path) => path.group),
      "|",
      ...solved.map((path) => path.group),
      JSON.stringify(paths.map((path) => this.tried.get(path)?.places ?? 0)),
    ].join();
    if (by === this.by) return;
    this.by = by;
    const focused = this.el.contains(document.activeElement)
      ? (document.activeElement as HTMLElement).dataset.handle
      : undefined;
    if (!paths.length) {
      const any = this.data.paths.some((path) => path.axis === axis);
      this.note.textContent = any
        ? "Nothing is aligned yet: play on, to the end of the stage Alignment."
        : "This axis has no alignment: there is no layout.";
      this.el.replaceChildren(this.note);
      return;
    }
    this.el.replaceChildren(
      ...(said ? [h("p", { class: "fnb-alternative", role: "status" }, said)] : []),
      ...paths.map((path) => this.section(path, axis, solved.includes(path), path.group === now)),
    );
    if (!focused) return;
    const handles = [...this.el.querySelectorAll<HTMLElement>("[data-handle]")];
    handles.find((own) => own.dataset.handle === focused)?.focus({ preventScroll: true });
  }

  /** Whether every letter of a group has been placed at a position. */
  private isPlaced(path: PathNote, position: number): boolean {
    const own = this.placing.letters.filter((each) => each.axis === path.axis && each.group === path.group);
    return own.length > 0 && own.every((each) => each.at <= position);
  }

  private section(path: PathNote, axis: Axis, placed: boolean, now: boolean): HTMLElement {
    const tried = this.tried.get(path);
    const cuts = tried ?? cutsOf(path);
    const solved =
      !tried &&
      this.data.paths.includes(path) &&
      (this.sizes === "solved" || (this.sizes === "auto" && placed)) &&
      this.isPlaced(path, 1e9);
    const drawn = solved ? this.solved(path) : atPreferred(path, cuts, this.data.placements);
    const verdicts = judge(this.group(path), columnsOf(cuts));
    const own = judge(this.group(path), columnsOf(cutsOf(path))) ?? [];
    const trial = new Trial(path, cuts, drawn, (next) => this.attempt(path, next), this.context.signal);
    const table = columnsTable({
      path,
      axis,
      drawn,
      verdicts: tried ? (verdicts ?? []) : own.map((each, j) => ({ ...each, ...exact(path, j) })),
      tried: !!tried,
      solved,
      symbols: this.context.timeline.data.symbols,
      trial,
    });
    return h(
      "section",
      { class: "fnb-align-group", "data-group": path.group, "data-now": now, "data-tried": !!tried },
      h(
        "header",
        {},
        h("strong", {}, path.group),
        h(
          "span",
          { class: "fnb-muted" },
          ` ${counted(path.columns.length, "column")}, ${counted(path.bands.length, "word")}; `,
        ),
        h(
          "span",
          { class: "fnb-muted" },
          solved ? "at solved sizes" : "at preferred sizes",
          this.unaligned.has(path) ? ", not aligned by the solver" : null,
        ),
        tried ? this.reset(path) : null,
      ),
      table,
      this.sums(path, drawn, verdicts, own, !!tried),
    );
  }

  private solved(path: PathNote): Drawn {
    const { boundaries, letters } = this.placing;
    const line = boundaries.find((own) => own.axis === path.axis && own.group === path.group);
    const placed = letters.filter((own) => own.axis === path.axis && own.group === path.group);
    return asSolved(path, line?.boundaries ?? [0, path.canvas], placed);
  }

  private attempt(path: PathNote, next: Cuts): void {
    const own = cutsOf(path);
    if (JSON.stringify(next) === JSON.stringify(own)) this.tried.delete(path);
    else this.tried.set(path, next);
    this.context.refresh();
  }

  private reset(path: PathNote): HTMLElement {
    const button = h("button", { type: "button", class: "fnb-fix fnb-align-reset" }, "Back to the solver's");
    button.addEventListener("click", () => this.attempt(path, cutsOf(path)));
    return button;
  }

  /** Ω, W, J, and every constraint that is broken. */
  private sums(
    path: PathNote,
    drawn: Drawn,
    verdicts: Verdict[] | null,
    own: readonly Verdict[],
    tried: boolean,
  ): HTMLElement {
    if (!verdicts) return h("p", { class: "fnb-align-sums" }, "These columns do not hold every word.");
    const omega = tried ? verdicts.reduce((sum, each) => sum + each.omega, 0) : path.error;
    const width = tried ? Math.max(drawn.width, 0) : path.width;
    const fit = this.group(path).objective.fit;
    const cost = (list: readonly Verdict[], w: number) =>
      list.reduce((sum, each) => sum + each.cost, 0) + fit * Math.abs(w - path.canvas);
    const wide = Math.abs(width - path.canvas) > path.tolerance + 1e-9;
    const broken = verdicts.flatMap((each, j) => (each.refusal ? [{ j, refusal: each.refusal }] : []));
    const figure = (name: string, value: number, other: number, title: string) =>
      h(
        "span",
        { class: "fnb-align-figure", title },
        h("b", {}, `${name} ${formatNumber(value)} m`),
        tried ? h("span", { class: "fnb-muted" }, ` solver: ${formatNumber(other)}`) : null,
      );
    return h(
      "div",
      { class: "fnb-align-sums", role: "status" },
      figure("Ω =", omega, path.error, "Sum of the columns' errors"),
      figure("W =", width, path.width, "Sum of the columns' widths"),
      h("span", { class: "fnb-muted" }, `canvas ${formatNumber(path.canvas)} ± μ ${formatNumber(path.tolerance)} m`),
      tried
        ? figure("J ≥", cost(verdicts, width), cost(own, path.width), "The objective, as far as columns show it")
        : null,
      h(
        "ul",
        { class: "fnb-align-broken" },
        wide ? h("li", {}, `✕ W misses the canvas by more than μ.`) : null,
        ...broken.map(({ j, refusal }) =>
          h(
            "li",
            { "data-column": j + 1, "data-constraint": refusal.constraint },
            `✕ column ${j + 1}: ${refusal.text()}`,
          ),
        ),
        !wide && !broken.length ? h("li", { class: "fnb-align-fine" }, "✓ It keeps every constraint.") : null,
      ),
    );
  }

  private group(path: PathNote): Group {
    let made = this.groups.get(path);
    if (!made) {
      const objective = this.context.timeline.data.objective as unknown as Objective;
      made = new Group(path.bands, path.canvas, path.tolerance, objective);
      this.groups.set(path, made);
    }
    return made;
  }
}

function whatIsShown({ aligned, groups }: Alternative): string {
  if (aligned) return "These are its columns, at preferred sizes: sizes are told of the layout only.";
  const some = groups.some((own) => own.aligned);
  return some
    ? "Groups that were aligned are shown so; of the others no columns are told: their words stand uncut. Cut them with +, and drag."
    : "No columns of it are told: its words stand uncut. Cut them with +, drag, and see what that breaks.";
}

const counted = (n: number, what: string): string => `${n} ${what}${n === 1 ? "" : "s"}`;

/** ω and width of a column as the solver has them: with the sizes of its pieces. */
function exact(path: PathNote, j: number): { omega: number; width: number } {
  const column = path.columns[j];
  return { omega: column?.omega ?? 0, width: column?.width ?? 0 };
}
