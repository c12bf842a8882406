// Alignment: the matrix as the paper draws it (Eq. 8), to scale, with sizes and errors below. A boundary can be dragged,
// or moved by keys: then Ω and what the alignment breaks are those of the reader's own, judged in the browser.

import { focused, h, mark } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { offers, type Question, Quiz } from "../../shared/quiz.ts";
import { ledgerTable } from "../align/ledger.ts";
import { asSolved, atPreferred, type Cuts, columnsOf, cutsOf, type Drawn, sizeIn } from "../align/matrix.ts";
import {
  CONSTRAINTS,
  elementText,
  ledgerOfPath,
  type Moved,
  movedCases,
  movedTruths,
  type Next,
  nextCases,
} from "../align/question.ts";
import { columnsTable, type MatrixOptions } from "../align/table.ts";
import { Trial } from "../align/trial.ts";
import type { Alternative } from "../alternatives.ts";
import { AxisChoice } from "../axes.ts";
import { lettersLegend } from "../letters.ts";
import type { PathNote } from "../network/story.ts";
import { Placing, type PlacingData } from "../placing.ts";
import type { Axis } from "../timeline.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";
import { Group, judge, ledgerOf, type Objective, rowsNamed, type Verdict } from "../weights.ts";

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
  readonly quiz: Quiz;
  private readonly groups = new Map<PathNote, Group>();
  private readonly cases = new Map<Axis, { moved: Moved[]; next: Next[] }>();
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
    this.quiz = new Quiz(() => this.questions());
  }

  show(position: number): void {
    const axis = this.choice.at(position);
    if (this.quiz.on) {
      this.ask();
      return;
    }
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
    const active = focused(this.el);
    const before = this.el.contains(active) ? (active as HTMLElement).dataset.handle : undefined;
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
      legendOf(paths),
    );
    if (!before) return;
    const handles = [...this.el.querySelectorAll<HTMLElement>("[data-handle]")];
    handles.find((own) => own.dataset.handle === before)?.focus({ preventScroll: true });
  }

  private questions(): Question[] {
    const { round } = this.quiz;
    const { moved, next } = this.asked();
    const found: Question[] = [];
    const from = this.context.timeline.begins("alignment", this.choice.at(this.context.player.position));
    const [column, boundary] = [next[round % next.length], moved[round % moved.length]];
    if (column)
      found.push({
        name: NEXT,
        prompt: `${this.named(column.path)}Where does column ${column.column + 1} end?`,
        hint:
          "take what breaks nothing: no ω above μ, something opaque in every column (C1), no part of an element " +
          "transparent (C2). And J with it must not be more than J of the whole.",
        truths: () => column.offers,
        single: true,
        from,
      });
    if (boundary) {
      const { path, band } = boundary;
      const row = path.layers[path.bands[band]?.rows[0] ?? 0] ?? "";
      const way = boundary.right ? "right" : "left";
      found.push({
        name: MOVED,
        hint:
          "compare the two columns beside the boundary with the others. Add up the sizes of each element: their " +
          "difference is ω, the larger one is the column's share of W.",
        prompt: `${this.named(path)}In the row “${row}” boundary ${boundary.boundary} was moved to the ${way}. What does that break? Tick all.`,
        truths: () => movedTruths(boundary),
        from,
      });
    }
    const nothing = "This alignment has nothing to ask: there is only one way to cut it.";
    return found.length ? found : [{ prompt: nothing, hint: "", truths: () => new Map() }];
  }

  /** What can be asked of the axis that is shown. */
  private asked(): { moved: Moved[]; next: Next[] } {
    const axis = this.choice.at(this.context.player.position);
    let made = this.cases.get(axis);
    if (!made) {
      const paths = this.data.paths
        .filter((path) => path.axis === axis)
        .sort((a, b) => b.bands.length - a.bands.length); // of one word alone there is little to ask
      made = {
        moved: inTurn(paths.map((path) => movedCases(path, this.group(path), this.data.placements))),
        next: inTurn(paths.map((path) => nextCases(path, this.group(path)))),
      };
      this.cases.set(axis, made);
    }
    return made;
  }

  /** The group, where there are several. */
  private named({ axis, group }: PathNote): string {
    return this.data.paths.filter((path) => path.axis === axis).length > 1 ? `Group ${group}: ` : "";
  }

  /** The question: an alignment as far as it is known, what can be chosen, and, once it is checked, the answer. */
  private ask(): void {
    const { quiz } = this;
    const by = `asks ${this.choice.at(this.context.player.position)} ${quiz.stamp}`;
    if (by === this.by) return;
    this.by = by;
    const { moved, next } = this.asked();
    const [boundary, column] = [moved[quiz.round % moved.length], next[quiz.round % next.length]];
    if (quiz.asked === NEXT && column) {
      const cuts = quiz.hides ? column.cuts : cutsOf(column.path);
      const asked = quiz.hides ? { open: column.column } : null;
      const marked = { boundary: column.column, band: null };
      const list = offers(quiz, (key) => {
        const offer = column.offers.get(key);
        const elements = column.path.bands.map(({ rows }, b) =>
          h(
            "span",
            { class: "fnb-align-offer" },
            h("span", { class: "fnb-muted" }, `${column.path.layers[rows[0] ?? 0] ?? ""}: `),
            h("code", {}, offer ? elementText(column.path, b, offer) : ""),
          ),
        );
        const cost = h("span", { class: "fnb-offer-known" }, `J with it ${formatNumber(offer?.cost)} m`);
        return h("span", { class: "fnb-align-offered" }, ...elements, cost);
      });
      const so = this.laid(column);
      this.el.replaceChildren(this.posed(column.path, cuts, { asked, marked }, list, so));
    } else if (quiz.asked === MOVED && boundary) {
      const marked = { boundary: boundary.boundary, band: boundary.band };
      const asked = quiz.hides ? { open: Number.POSITIVE_INFINITY } : null;
      const list = offers(quiz, (kind) => CONSTRAINTS[kind] ?? kind);
      this.el.replaceChildren(this.posed(boundary.path, boundary.cuts, { asked, marked }, list, ""));
    } else {
      this.note.textContent = quiz.prompt;
      this.el.replaceChildren(this.note);
    }
  }

  /** An alignment that something is asked about. */
  private posed(
    path: PathNote,
    cuts: Cuts,
    how: Pick<MatrixOptions, "asked" | "marked">,
    list: HTMLElement,
    laid: string,
  ): HTMLElement {
    const drawn = atPreferred(path, cuts, this.data.placements);
    const verdicts = how.asked ? [] : (judge(this.group(path), columnsOf(cuts), sizeIn(drawn)) ?? []);
    const tried = JSON.stringify(cuts) !== JSON.stringify(cutsOf(path));
    const { symbols } = this.context.timeline.data;
    const exactly = tried ? verdicts : verdicts.map((each, j) => ({ ...each, ...exact(path, j) }));
    const head = h(
      "header",
      {},
      h("strong", {}, `Group ${path.group}`),
      h("span", { class: "fnb-muted" }, "at preferred sizes"),
    );
    return h(
      "section",
      { class: "fnb-align-group", "data-group": path.group, "data-asked": true },
      head,
      h("p", { class: "fnb-known" }, lettersText(path), ` ${limitsText(path)} `, laid),
      columnsTable({
        path,
        axis: path.axis,
        drawn,
        verdicts: exactly,
        tried: true,
        solved: false,
        symbols,
        trial: null,
        ...how,
      }),
      how.asked ? null : this.sums(path, drawn, verdicts, tried),
      list,
      legendOf([path]),
    );
  }

  /** What the alignment costs, and what of it is laid: by that a column that is too dear is known. */
  private laid({ path, column }: Next): string {
    const { columns, cost } = ledgerOfPath(path, this.group(path));
    const sofar = columns.slice(0, column).reduce((sum, own) => sum + own.cost, 0);
    return `J of the whole is ${formatNumber(cost)} m; J so far, ${formatNumber(sofar)} m.`;
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
    const verdicts = judge(this.group(path), columnsOf(cuts), sizeIn(drawn));
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
        h("strong", {}, `Group ${path.group}`),
        h(
          "span",
          { class: "fnb-muted" },
          ` ${counted(path.columns.length, "column")}, ${counted(path.bands.length, "word")}; `,
        ),
        h(
          "span",
          { class: "fnb-muted" },
          solved ? "at solved sizes; errors, Ω, W, J at preferred sizes" : "at preferred sizes",
          this.unaligned.has(path) ? ", not aligned by the solver" : null,
        ),
        tried ? this.reset(path) : null,
      ),
      table,
      this.sums(path, drawn, verdicts, !!tried),
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
  private sums(path: PathNote, drawn: Drawn, verdicts: Verdict[] | null, tried: boolean): HTMLElement {
    if (!verdicts) return h("p", { class: "fnb-align-sums" }, "These columns do not hold every word.");
    const omega = tried ? verdicts.reduce((sum, each) => sum + each.omega, 0) : path.error;
    const width = tried || this.unaligned.has(path) ? drawn.width : path.width;
    const own = ledgerOfPath(path, this.group(path));
    const whole = own.cost;
    const ledger = tried ? ledgerOf(this.group(path), verdicts, width) : own;
    const wide = Math.abs(width - path.canvas) > path.tolerance + 1e-9;
    const broken = verdicts.flatMap((each, j) => each.refusals.map((refusal) => ({ j, refusal })));
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
        ? figure("J ≥", ledger.cost, whole, "The objective, as far as columns show it")
        : this.unaligned.has(path)
          ? null
          : figure(
              "J =",
              whole,
              whole,
              "The objective: errors, empty elements, letters that share an element, and |W − canvas|",
            ),
      !tried && this.unaligned.has(path) ? null : ledgerTable(ledger, this.group(path).objective, tried),
      h(
        "ul",
        { class: "fnb-align-broken" },
        wide ? h("li", {}, `✕ W misses the canvas by more than μ.`) : null,
        ...broken.map(({ j, refusal }) =>
          h(
            "li",
            { "data-column": j + 1, "data-constraint": refusal.constraint },
            `✕ column ${j + 1}: ${rowsNamed(refusal.text(), path.layers)}`,
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

/** Sizes and kinds of the letters of an alignment: `A 0.9 m opaque, e free transparent`. */
function lettersText({ bands }: PathNote): string {
  const letters = new Map(bands.flatMap((band) => band.letters.map((letter) => [letter.symbol, letter] as const)));
  const named = [...letters.values()].map((own) => {
    const size = own.size === null ? "without a size" : `${formatNumber(own.size)} m`;
    const kinds = [
      own.transparent ? "transparent" : own.opaque ? "" : "not opaque",
      own.unoccludable ? "unoccludable" : "",
      own.attached ? "attached" : "",
    ];
    return [own.symbol, size, ...kinds].filter(Boolean).join(" ");
  });
  return `${named.join(", ")}.`;
}

const limitsText = ({ canvas, tolerance }: PathNote): string =>
  `Canvas ${formatNumber(canvas)} m, μ = ${formatNumber(tolerance)} m.`;

function whatIsShown({ aligned, groups }: Alternative): string {
  if (aligned) return "These are its columns, at preferred sizes: sizes are told of the layout only.";
  const some = groups.some((own) => own.aligned);
  return some
    ? "Groups that were aligned are shown so; of the others no columns are told: their words stand uncut. Cut them with +, and drag."
    : "No columns of it are told: its words stand uncut. Cut them with +, drag, and see what that breaks.";
}

function legendOf(paths: readonly PathNote[]): HTMLElement {
  const letters = paths.flatMap(({ bands }) => bands.flatMap((band) => band.letters));
  const columns = paths.flatMap((path) => columnsOf(cutsOf(path)));
  return lettersLegend(letters, {
    cut: paths.some((path) => path.columns.some(({ after }) => after.some((place) => place & 1))),
    gaps: letters.some((a) => !a.opaque && !a.transparent),
    empty: columns.some((column) => column.some((element) => !element.length)),
  });
}

const NEXT = "the next column";
const MOVED = "a moved boundary";

/** The first of each list, then the second of each, and so on. */
function inTurn<T>(lists: readonly T[][]): T[] {
  const most = Math.max(0, ...lists.map((list) => list.length));
  return Array.from({ length: most }, (_, n) => lists.flatMap((list) => list.slice(n, n + 1))).flat();
}

const counted = (n: number, what: string): string => `${n} ${what}${n === 1 ? "" : "s"}`;

/** ω and width of a column as the solver has them: with the sizes of its pieces. */
function exact(path: PathNote, j: number): { omega: number; width: number } {
  const column = path.columns[j];
  return { omega: column?.omega ?? 0, width: column?.width ?? 0 };
}
