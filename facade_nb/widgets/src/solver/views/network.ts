// Network: the alignment decision network as the paper's Figure 8 (states as pairs of suffixes, steps of the automaton,
// arcs of the closure, the path), with weights, the tolerance region of the supplement's Figure 6, and what is forbidden.
// More than two words are seen as a pair of them, as a path across all, and as they are joined.

import { h, mark, setText } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { Quiz, type Truth } from "../../shared/quiz.ts";
import { watchDress } from "../../shared/theme.ts";
import { ledgerOfPath } from "../align/question.ts";
import type { Alternative } from "../alternatives.ts";
import { target } from "../links.ts";
import { BuildBar } from "../network/buildbar.ts";
import { arcAt, boundsOf, nodeAt, nodeTowards, pointOf } from "../network/curves.ts";
import { arcSentence, LeavingList, litLetters, meanings, nodeSentence } from "../network/lists.ts";
import { type Look, lookOf } from "../network/look.ts";
import { edgesAt, gone } from "../network/numbers.ts";
import { MARGIN, paint } from "../network/paint.ts";
import { Plane, type Point } from "../network/plane.ts";
import { type Choice, choicesOf, keyOf, nameOf, question } from "../network/question.ts";
import {
  type Arc,
  type Base,
  baseOf,
  edgeKey,
  leaving,
  nodeKey,
  type Scene,
  sceneBuilt,
  sceneOf,
} from "../network/scene.ts";
import { type NetworkData, PRUNED, Story, type Subject, sizeOf, TAKEN, type Told } from "../network/story.ts";
import { Strip } from "../network/strip.ts";
import { warp } from "../network/warp.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";
import type { Objective } from "../weights.ts";

const HINT =
  "g is what the columns cost so far, with this edge; h is what is still to come at least. No alignment through the edge " +
  "costs less than g + h: add them.";

export const network: ViewKind = {
  title: "Network",
  subtitle: "Every way to cut the words into columns; the shortest path is the alignment (5.2)",
  needs: ["network"],
  make: (context) => new NetworkView(context),
};

class NetworkView implements View {
  readonly el: HTMLElement;
  readonly controls: HTMLElement[];
  readonly quiz: Quiz;
  private readonly story: Story;
  private readonly plane: Plane;
  private readonly select = h("select", { class: "fnb-net-select", "aria-label": "Network" });
  private readonly downs = h("select", { "aria-label": "Word drawn downwards" });
  private readonly rights = h("select", { "aria-label": "Word drawn to the right" });
  private readonly pairs: HTMLElement;
  private readonly cuts: HTMLInputElement;
  private readonly forbidden: HTMLInputElement;
  private readonly status = h("p", { class: "fnb-net-status", role: "status" });
  private readonly leaving = new LeavingList();
  private readonly beside = h("div", { class: "fnb-net-beside" });
  private readonly below = h("div", { class: "fnb-net-below" });
  private readonly legend = h("p", { class: "fnb-net-legend" });
  private readonly note = h("p", { class: "fnb-empty" });
  private readonly body: HTMLElement;
  private readonly bases = new Map<string, Base>();
  private chosen = "";
  private pair: Record<string, [number, number]> = {};
  private scene: Scene | null = null;
  private told: Told | null = null;
  private hovered: Arc | null = null;
  private hovering: number[] | null = null;
  private readonly strip: Strip;
  private readonly build: BuildBar;
  private looked: Look | null = null;
  private by = "";
  private belowBy = "";
  private readonly said = h("p", { class: "fnb-alternative", role: "status", hidden: true });
  private shownOther: Alternative | null = null;
  private others: Subject[] = [];
  private legendBy = "";
  private optionsBy = "";
  private ratio = "";
  private pickedNow = "";

  constructor(private readonly context: ViewContext) {
    this.story = new Story(context.pieces.network as NetworkData, context.timeline);
    this.strip = new Strip(this.story, context.player);
    const check = (label: string, title: string, on: boolean) => {
      const input = h("input", { type: "checkbox" });
      input.checked = on;
      input.addEventListener("change", () => context.refresh());
      return { input, label: h("label", { class: "fnb-field", title }, input, label) };
    };
    const cuts = check("cut letters", "Transparent letters may be cut: nodes within them", true);
    const forbidden = check("forbidden", "Edges that a constraint forbids", true);
    this.cuts = cuts.input;
    this.forbidden = forbidden.input;
    this.select.addEventListener("change", () => {
      this.chosen = this.select.value;
      this.context.links.release();
      context.refresh();
    });
    this.build = new BuildBar(() => context.refresh());
    this.pairs = h("span", { class: "fnb-field" }, "words", this.downs, "×", this.rights);
    for (const [side, select] of [this.downs, this.rights].entries())
      select.addEventListener("change", () => {
        const own = this.scene?.subject;
        if (!own) return;
        const pair = this.pairOf(own);
        const next = Number(select.value);
        const before = pair[side] as number;
        const other = pair[1 - side] as number;
        const made: [number, number] = [...pair];
        made[side] = next;
        if (next === other) made[1 - side] = before;
        this.choose(own, made);
      });
    this.controls = [this.select, this.pairs, cuts.label, forbidden.label, this.build.toggle];
    this.plane = new Plane(
      {
        label: "Network",
        margin: MARGIN,
        bounds: () => (this.scene ? boundsOf(this.scene) : { left: 0, top: 0, right: 1, bottom: 1 }),
        draw: (drawing, camera, width, height) => {
          if (!this.scene) return;
          const { lit, picked } = context.links;
          paint(drawing, this.scene, camera, width, height, this.look(), {
            lit,
            picked,
            hovered: this.hovered,
            hovering: this.hovering,
            letters: litLetters(this.scene.subject, new Set([...lit, ...picked])),
            choices: this.quiz.on ? this.marks() : new Map(),
            verdict: (key) => this.quiz.verdict(key).state,
          });
        },
        hover: (at) => this.hover(at),
        press: (at) => this.press(at),
        key: (event) => this.key(event),
      },
      context.signal,
    );
    this.body = h(
      "div",
      { class: "fnb-net-body" },
      h(
        "div",
        { class: "fnb-net-main" },
        this.plane.el,
        this.build.el,
        this.strip.el,
        this.legend,
        meanings(),
        this.status,
      ),
      this.beside,
    );
    this.el = h("div", { class: "fnb-network" }, this.said, this.note);
    this.quiz = new Quiz(() => [
      { prompt: "Which edge is next?", hint: HINT, truths: () => this.truths(), single: true, from: this.tells() },
    ]);
    watchDress(() => {
      this.looked = null;
      setTimeout(() => this.plane.invalidate(), 50); // when the page has its colours
    }, context.signal);
    requestAnimationFrame(() => {
      this.looked = null; // in the page it has a theme
      this.plane.invalidate();
    });
  }

  show(position: number): void {
    const other = this.alternative(position);
    const subject = other
      ? (this.others.find((own) => own.key === this.chosen) ?? largestOf(this.others))
      : (this.story.subjects.find((own) => own.key === this.chosen) ?? this.story.subjectAt(position));
    if (!subject || subject.first > position) {
      this.el.replaceChildren(this.said, this.note); // nothing of another moment is left behind
      const none = "The trace tells of no network: there was no layout before one was made.";
      setText(this.note, subject ? "No network is opened yet: play on, or go to the stage Alignment." : none);
      this.below.replaceChildren();
      this.belowBy = "";
      this.by = "";
      this.pairs.hidden = true;
      this.build.toggle.hidden = true;
      return;
    }
    if (this.note.parentNode === this.el) this.el.replaceChildren(this.said, this.body, this.below);
    const picked = this.pickedIn(subject);
    this.told = this.story.told(subject, position);
    const base = this.base(subject, this.cuts.checked);
    const pair = this.pairOf(subject);
    const choices = { pair, cuts: this.cuts.checked || !base.lattice, forbidden: this.forbidden.checked, picked };
    const built = this.build.show(subject, base, this.quiz.on);
    let scene = sceneOf(this.story, subject, base, this.told, position, choices, this.quiz.hides);
    if (built) scene = sceneBuilt(scene, built);
    if (this.quiz.on)
      scene.arcs.push(...this.choices(position).map(({ arc }) => ({ ...arc, kind: "choice" as const })));
    const fresh = this.scene?.subject !== subject || this.scene.pair.join() !== pair.join();
    this.scene = scene;
    this.hovered = null;
    this.hovering = null;
    if (this.quiz.on || built) this.strip.hide();
    else this.strip.show(subject, position);
    const by = [
      subject.key,
      pair.join(),
      picked?.join(),
      position,
      this.cuts.checked,
      this.forbidden.checked,
      this.quiz.stamp,
      this.build.stamp,
    ];
    if (by.join("|") !== this.by) {
      this.by = by.join("|");
      this.words(subject, base, position);
    }
    this.shape();
    if (fresh) this.plane.fit();
    else this.plane.settle();
  }

  /** The candidate that is chosen and is not the layout; its networks are then those that can be looked at. */
  private alternative(position: number): Alternative | null {
    const { alternatives, timeline } = this.context;
    const own = alternatives.at(position, alternatives.axis ?? timeline.axisAt(position));
    if (own !== this.shownOther || !this.select.options.length) {
      this.shownOther = own;
      this.others = own ? this.story.subjectsOf(own) : [];
      const list = own ? this.others : this.story.subjects;
      this.select.replaceChildren(
        h("option", { value: "" }, "auto"),
        ...list.map((each) => h("option", { value: each.key }, labelOf(each))),
      );
      if (!list.some((each) => each.key === this.chosen)) this.chosen = "";
      this.select.value = this.chosen;
    }
    setText(this.said, own ? `${own.name}. ${own.fate} ${this.whatIsShown(own)}` : alternatives.trouble);
    this.said.hidden = !this.said.textContent;
    return own;
  }

  private whatIsShown({ groups }: Alternative): string {
    if (groups.every(({ aligned }) => aligned)) return "The paths are those of its own alignment.";
    const told = groups.some(({ network }) => network >= 0);
    return told
      ? "What the search did in its networks is shown as far as the trace tells it; where none is told, the lattice as it would have been."
      : "No network of it is told: the lattice is what it would have been, without a path.";
  }

  light(): void {
    const { links } = this.context;
    links.apply(this.beside);
    links.apply(this.below);
    const picked = [...links.picked].find((key) => key.startsWith("node:")) ?? "";
    if (picked !== this.pickedNow) {
      this.pickedNow = picked;
      this.context.refresh(); // another node is looked at
      return;
    }
    this.plane.invalidate();
  }

  /** Text around the drawing: legend, what is looked at, what leaves it, the path across all words. */
  private words(subject: Subject, base: Base, position: number): void {
    const scene = this.scene as Scene;
    const many = subject.bands.length > 2;
    this.pairs.hidden = !many;
    (this.cuts.parentElement as HTMLElement).hidden = !scene.exact;
    if (many) this.options(subject);
    const [rows, cols] = scene.size;
    const steps = scene.arcs.filter((arc) => arc.kind === "path");
    const omega = steps.reduce((sum, arc) => sum + (arc.omega ?? 0), 0);
    const size = sizeOf(subject);
    const nodes = many
      ? `${size.toLocaleString("en")} nodes, seen as ${rows} × ${cols}`
      : rows > 1
        ? `${rows} × ${cols} nodes`
        : `${cols} nodes`;
    const cut = scene.cut.length ? ` and ${scene.cut.length} within cut letters` : "";
    const told = this.told as Told;
    // Where letters are not cut it is another path than the layout's, of which the objective is not told.
    const ledger = scene.cutting && subject.path ? ledgerOfPath(subject.path, base.group) : null;
    const found = steps.length
      ? ` The path has ${steps.length} columns, Ω = ${formatNumber(omega, 3)} m${ledger ? `, J = ${formatNumber(ledger.cost)} m` : ""}.`
      : "";
    const search = subject.at.length
      ? ` ${told.taken.length} expanded, ${told.weighed.length} edges weighed, ${this.counts(subject, told, position)}.`
      : "";
    setText(
      this.status,
      `${labelOf(subject)}: ${this.directions(subject)}${nodes}${cut}, μ = ${formatNumber(subject.tolerance)} m.${search}${found}`,
    );
    mark(this.plane.canvas, "aria-label", `Network of ${this.status.textContent} Arrow keys go from node to node.`);
    const legend: [string, string][] = [
      ["node", many ? "node" : `node: what is left of ${subject.bands.length > 1 ? "both words" : "the word"}`],
      ...(scene.exact ? ([["faint", "on no way to the end"]] as [string, string][]) : []),
      ...(scene.cut.length ? ([["cut", "within a cut letter"]] as [string, string][]) : []),
      ["step", "automaton steps"],
      [
        "arc",
        scene.exact && !scene.built && !scene.focus && base.arcs.length > scene.arcs.length + 200
          ? "closure: the lightest of its permitted arcs"
          : "closure",
      ],
      ...(steps.length ? ([["path", "path, with ω"]] as [string, string][]) : []),
      ...(scene.delta
        ? ([["region", "|δ| ≤ μ, traced along its border; numbers: δ from ✕"]] as [string, string][])
        : []),
      ...(scene.arcs.some((arc) => arc.constraint) ? ([["forbidden", "forbidden"]] as [string, string][]) : []),
      ...(told.taken.length ? ([["taken", "expanded"]] as [string, string][]) : []),
    ];
    const legendBy = legend.join("|");
    if (legendBy !== this.legendBy) {
      this.legendBy = legendBy;
      this.legend.replaceChildren(
        ...legend.map(([kind, text]) => h("span", {}, h("i", { class: `fnb-net-key fnb-net-key-${kind}` }), text)),
      );
    }
    if (this.quiz.on) {
      const searching = this.story.next(subject, position, TAKEN) !== undefined;
      this.beside.replaceChildren(question(subject, this.choices(position), searching, this.quiz));
    } else if (scene.built) {
      // What leaves the node that is spoken of, as far as it has come.
      const { now, arcs } = scene.built;
      const from = now.kind === "arc" ? now.arc.from : now.kind === "step" ? now.segment.from : null;
      const places = from ?? (now.kind === "node" ? now.places : subject.bands.map(() => 0));
      const here = arcs.filter((arc) => arc.from.join() === places.join());
      const standing = (arc: Arc) => (arc.constraint ? "forbidden" : "permitted");
      const listed = here.map((arc) => ({ arc, numbers: null, standing: standing(arc) }) as const);
      this.leaving.show(subject, places, listed, null);
      if (this.leaving.el.parentNode !== this.beside) this.beside.replaceChildren(this.leaving.el);
    } else {
      const focus = scene.focus ?? subject.bands.map(() => 0);
      const arcs = leaving(this.story, subject, base, told, focus);
      const onPath = new Set(steps.map((arc) => arc.key));
      const nameOf = (column: (number[] | null)[], to: readonly (number | null)[]) =>
        `${edgeKey(subject, focus, column)}>${to.map((place, b) => place ?? focus[b] ?? 0).join()}`;
      const numbers = edgesAt(this.story, subject, told, focus, position, nameOf);
      const marked = arcs.map((own) => {
        const arc = onPath.has(own.key) ? { ...own, kind: "path" as const } : own;
        const found = numbers.get(nameOf(own.column, own.to)) ?? null;
        const forbidden = !!own.constraint && !PRUNED.includes(own.constraint);
        const standing = forbidden ? "forbidden" : (found?.standing ?? (own.constraint ? "pruned" : "permitted"));
        return { arc, numbers: forbidden ? null : found, standing } as const;
      });
      const at = scene.nodes.get([focus[scene.pair[0]] ?? 0, focus[scene.pair[1]] ?? 0].join())?.numbers ?? null;
      this.leaving.show(subject, focus, marked, at);
      if (this.leaving.el.parentNode !== this.beside) this.beside.replaceChildren(this.leaving.el);
    }
    const chosen = subject.path && subject.path.at <= position && !this.quiz.hides;
    const merged = this.story.data.merged.findLast(
      (own) => own.at <= position && own.axis === subject.axis && own.network === subject.network,
    );
    const by = many && chosen ? [subject.key, this.pairOf(subject), merged?.at].join() : "";
    if (by === this.belowBy) return;
    this.belowBy = by;
    this.below.replaceChildren(
      ...(by
        ? [
            warp(subject, this.context.timeline.data.symbols, this.pairOf(subject), merged, (pair) =>
              this.choose(subject, pair),
            ),
          ]
        : []),
    );
  }

  /** How many edges were pruned and forbidden, as far as that is told. */
  private counts(subject: Subject, told: Told, position: number): string {
    const { story } = this;
    let pruned = 0;
    for (const step of told.refused) if (PRUNED.includes(story.reasonOf(step))) pruned++;
    const forbidden = told.refused.length - pruned;
    for (const step of told.weighed) if (gone(story, subject, step, position)) pruned++;
    return `${pruned} pruned, ${forbidden} forbidden`;
  }

  /** Which word is read downwards, and which to the right. */
  private directions(subject: Subject): string {
    const [down, right] = this.pairOf(subject).map((b) => {
      const row = subject.bands[b]?.rows[0];
      return row === undefined ? "" : ((subject.path?.layers ?? subject.layers)?.[row] ?? "");
    });
    return `${down ? `↓ ${down}, ` : ""}${right ? `→ ${right}; ` : ""}`;
  }

  private options(subject: Subject): void {
    const pair = this.pairOf(subject);
    const by = [subject.key, pair].join();
    if (by === this.optionsBy) return;
    this.optionsBy = by;
    for (const [side, select] of [this.downs, this.rights].entries()) {
      select.replaceChildren(
        ...subject.bands.map((band, b) => {
          const name = (subject.path?.layers ?? subject.layers)?.[band.rows[0] ?? 0] ?? `word ${b + 1}`;
          return h("option", { value: b, selected: b === pair[side] }, name);
        }),
      );
      select.value = String(pair[side]);
    }
  }

  private choose(subject: Subject, pair: [number, number]): void {
    this.pair[subject.key] = pair;
    this.context.refresh();
  }

  /** Which bands are drawn downwards and to the right. */
  private pairOf(subject: Subject): [number, number] {
    if (subject.bands.length === 1) return [-1, 0];
    return this.pair[subject.key] ?? [0, subject.bands.length > 2 ? longest(subject) || 1 : 1];
  }

  private base(subject: Subject, cuts: boolean): Base {
    const key = `${subject.key}|${cuts}`;
    let made = this.bases.get(key);
    if (!made) {
      made = baseOf(subject, this.context.timeline.data.objective as unknown as Objective, cuts);
      this.bases.set(key, made);
    }
    return made;
  }

  /** Room for the rows, and no more. */
  private shape(): void {
    const { left, right, top, bottom } = boundsOf(this.scene as Scene);
    const ratio = ((bottom - top) / (right - left)).toFixed(3);
    if (ratio === this.ratio) return;
    this.ratio = ratio;
    this.plane.el.style.setProperty("--fnb-net-ratio", ratio);
  }

  /** The node of this network that the reader has picked. */
  private pickedIn(subject: Subject): number[] | null {
    for (const key of this.context.links.picked) {
      if (!key.startsWith("node:")) continue;
      const places = (decodeURIComponent(key.split(":").at(-1) ?? "") || "").split(",").map(Number);
      if (nodeKey(subject, places) === key && places.length === subject.bands.length) return places;
    }
    return null;
  }

  // The question

  private choices(position = this.context.player.position): Choice[] {
    const subject = this.scene?.subject;
    return subject ? choicesOf(this.story, subject, () => this.base(subject, true), position) : [];
  }

  /** The first event that gives the answer away: the step that comes next, or, after the search, all of it. */
  private tells(): number {
    const { position } = this.context.player;
    const subject = this.scene?.subject;
    if (!subject) return 0;
    const next = this.story.next(subject, position, TAKEN);
    const at = next === undefined ? undefined : this.story.data.steps.at[next];
    return at ?? this.context.timeline.begins("alignment", subject.axis);
  }

  private truths(): ReadonlyMap<string, Truth> {
    return new Map(this.choices().map((own) => [keyOf(own), { right: own.right, why: own.why }]));
  }

  /** The choices' letters, by which the drawing names them. */
  private marks(): Map<string, string> {
    return new Map(this.choices().map((own, n) => [keyOf(own), nameOf(n)]));
  }

  // The pointer and the keys

  private hover(at: Point | null): void {
    const { links } = this.context;
    const scene = this.scene;
    if (!scene || !at) {
      if (this.hovered || this.hovering) this.plane.invalidate();
      this.hovered = this.hovering = null;
      links.hover([]);
      return;
    }
    const node = nodeAt(scene, this.plane.camera.scale, at);
    const arc = node ? null : arcAt(scene, this.plane.camera.scale, at);
    this.hovered = arc;
    this.hovering = node;
    mark(this.plane.canvas, "title", arc ? arcSentence(scene.subject, arc) : node ? nodeSentence(scene, node) : null);
    if (node) links.hover([nodeKey(scene.subject, node)]);
    else if (arc) {
      const path = scene.subject.path;
      links.hover(arc.kind === "path" && path ? [arc.key, target.column(path.axis, path.group, arc.step)] : [arc.key]);
    } else links.hover([]);
    this.plane.invalidate();
  }

  private press(at: Point): void {
    const scene = this.scene;
    if (!scene) return;
    this.plane.canvas.focus({ preventScroll: true });
    const arc = nodeAt(scene, this.plane.camera.scale, at) ? null : arcAt(scene, this.plane.camera.scale, at);
    if (this.quiz.on && arc) {
      const own = this.choices().find((one) => keyOf(one) === `${arc.key}>${arc.to.join(",")}`);
      if (own) this.quiz.choose(keyOf(own));
      return;
    }
    const node = nodeAt(scene, this.plane.camera.scale, at);
    if (node) this.context.links.toggle([nodeKey(scene.subject, node)]);
    else if (arc) this.context.links.toggle([arc.key]);
    else this.context.links.release();
  }

  private key(event: KeyboardEvent): boolean {
    const scene = this.scene;
    const places = scene && nodeTowards(scene, event.key);
    if (!scene || !places) return false;
    this.context.links.release();
    this.context.links.toggle([nodeKey(scene.subject, places)]);
    this.plane.reveal(pointOf(scene, places));
    return true;
  }

  private look(): Look {
    this.looked ??= lookOf(this.plane.canvas, this.context.timeline.data.symbols as Record<string, number>);
    return this.looked;
  }
}

const labelOf = (subject: Subject): string =>
  `${subject.axis}, group ${subject.name}${subject.path || subject.network < 0 ? "" : ` (network ${subject.network})`}`;

const largestOf = (list: readonly Subject[]): Subject | undefined =>
  list.reduce<Subject | undefined>((a, b) => (a && sizeOf(a) >= sizeOf(b) ? a : b), undefined);

/** The band, but the first, with the longest word. */
function longest(subject: Subject): number {
  let found = 0;
  for (const [b, band] of subject.bands.entries())
    if (b && (!found || band.letters.length > (subject.bands[found]?.letters.length ?? 0))) found = b;
  return found;
}
