// Draws the Network view's scene on a canvas: everything that is in sight, in as much detail as there is room for.

import type { Verdict } from "../../shared/quiz.ts";
import type { LetterNote } from "../letters.ts";
import type { Built } from "./building.ts";
import { ASPECT, curveOf, pointOf } from "./curves.ts";
import type { Look } from "./look.ts";
import type { Camera, Point } from "./plane.ts";
import type { Arc, ArcKind, Scene } from "./scene.ts";
import { restOf } from "./story.ts";

export const MARGIN = { left: 46, top: 44, right: 44, bottom: 26 };
const BOXES = 58; // pixels between columns from which nodes are boxes with words in them
const DOTS = 11; // from which every node is drawn
const STRIP = 30;

export interface Marks {
  lit: ReadonlySet<string>;
  picked: ReadonlySet<string>;
  hovered: Arc | null;
  /** The node under the pointer. */
  hovering: readonly number[] | null;
  /** Letters of the words that are lit: bands and numbers. */
  letters: ReadonlySet<string>;
  /** Choices of the question, by key: what stands beside them. */
  choices: ReadonlyMap<string, string>;
  /** How a choice stands, by its key. */
  verdict(key: string): Verdict;
}

export function paint(
  context: CanvasRenderingContext2D,
  scene: Scene,
  camera: Camera,
  width: number,
  height: number,
  look: Look,
  marks: Marks,
): void {
  new Painter(context, scene, camera, width, height, look, marks).run();
}

/** How arcs are drawn; faint: while another node's edges are looked at. */
const KINDS: Record<ArcKind, { alpha: number; faint: number; width: number; dash: number[] }> = {
  forbidden: { alpha: 0.3, faint: 0.08, width: 0.9, dash: [2, 3] },
  refused: { alpha: 0.45, faint: 0.1, width: 0.9, dash: [2, 3] },
  permitted: { alpha: 0.32, faint: 0.13, width: 1.1, dash: [] },
  weighed: { alpha: 0.95, faint: 0.4, width: 1.5, dash: [] },
  choice: { alpha: 1, faint: 1, width: 2.2, dash: [] },
  path: { alpha: 1, faint: 1, width: 3.2, dash: [] },
};

const choiceKey = (arc: Arc): string => `${arc.key}>${arc.to.join()}`;

class Painter {
  private readonly cell: number;

  constructor(
    private readonly c: CanvasRenderingContext2D,
    private readonly scene: Scene,
    private readonly camera: Camera,
    private readonly width: number,
    private readonly height: number,
    private readonly look: Look,
    private readonly marks: Marks,
  ) {
    this.cell = camera.scale;
  }

  run(): void {
    this.region();
    this.grid();
    for (const kind of ["forbidden", "refused", "permitted", "weighed", "path", "choice"] as const) this.arcs(kind);
    this.highlights();
    this.walks();
    this.nodes();
    this.weights();
    this.headers();
  }

  private sx(x: number): number {
    return (x - this.camera.x) * this.cell;
  }

  private sy(y: number): number {
    return (y - this.camera.y) * this.cell;
  }

  private screen({ x, y }: Point): Point {
    return { x: this.sx(x), y: this.sy(y) };
  }

  /** The rows and columns that are in sight. */
  private seen(): { rows: [number, number]; cols: [number, number] } {
    const [rows, cols] = this.scene.size;
    const range = (from: number, to: number, most: number): [number, number] => [
      Math.max(0, Math.floor(from)),
      Math.min(most - 1, Math.ceil(to)),
    ];
    const { x, y } = this.camera;
    return {
      cols: range(x, x + this.width / this.cell, cols),
      rows: range(y / ASPECT, (y + this.height / this.cell) / ASPECT, rows),
    };
  }

  /** The transitions of the automaton: one letter of one word, so all of them together are the lines of a grid. */
  private grid(): void {
    const { c, scene } = this;
    if (scene.built) {
      this.steps(scene.built);
      return;
    }
    const [rows, cols] = scene.size;
    const seen = this.seen();
    const every = Math.max(1, Math.ceil(3 / (this.cell * ASPECT)));
    const [right, bottom] = [this.sx(cols - 1), this.sy((rows - 1) * ASPECT)];
    c.beginPath();
    for (let i = seen.rows[0]; i <= seen.rows[1]; i++) {
      if (i % every && i !== rows - 1) continue;
      const y = this.sy(i * ASPECT);
      c.moveTo(this.sx(0), y);
      c.lineTo(right, y);
    }
    for (let j = seen.cols[0]; j <= seen.cols[1] && rows > 1; j++) {
      if (j % every && j !== cols - 1) continue;
      const x = this.sx(j);
      c.moveTo(x, this.sy(0));
      c.lineTo(x, bottom);
    }
    c.strokeStyle = this.look.step;
    c.globalAlpha = this.cell >= BOXES ? 1 : this.cell >= DOTS ? 0.7 : 0.4;
    c.lineWidth = this.cell >= BOXES ? 1.6 : this.cell >= DOTS ? 1 : 0.6;
    c.stroke();
    c.globalAlpha = 1;
  }

  /** The steps that have come, while the network is built up; that which comes now, and that an arc follows from, bold. */
  private steps({ segments, now }: Built): void {
    const { c } = this;
    const bold = now.kind === "step" ? now.segment : now.kind === "arc" ? now.step : null;
    c.strokeStyle = this.look.step;
    for (const own of segments) {
      const [from, to] = [own.from, own.to].map((places) => this.screen(pointOf(this.scene, places))) as [Point, Point];
      c.lineWidth = own === bold ? 4.5 : 1.4;
      c.beginPath();
      c.moveTo(from.x, from.y);
      c.lineTo(to.x, to.y);
      c.stroke();
    }
  }

  private arcs(kind: ArcKind): void {
    const { c, look } = this;
    const style = KINDS[kind];
    c.strokeStyle = kind === "path" ? look.path : kind === "refused" || kind === "forbidden" ? look.error : look.arc;
    c.lineWidth = this.cell < DOTS && kind !== "path" ? 0.7 : style.width;
    c.setLineDash(this.cell < DOTS ? [] : style.dash);
    if (kind === "path") {
      this.strokes((arc) => arc.kind === kind, kind, style.alpha);
      return;
    }
    if (kind === "choice") {
      this.choices(style.alpha);
      return;
    }
    // Of the node that is looked at, or pointed at, all edges are plain to see; the others are faint.
    const near = this.near();
    const ours = (arc: Arc) => near !== null && this.shown(arc.from) === near;
    this.strokes((arc) => arc.kind === kind && !ours(arc), kind, near === null ? style.alpha : style.faint);
    this.strokes((arc) => arc.kind === kind && ours(arc), kind, Math.min(1, 1.7 * style.alpha));
  }

  /** The edges that can be chosen, above the path, which is red: what was right is not. */
  private choices(alpha: number): void {
    for (const state of ["open", "passed", "wrong", "missed", "right"] as const) {
      this.c.strokeStyle = this.verdictColour(state);
      this.c.lineWidth = state === "right" || state === "missed" ? 4.2 : 2.2;
      this.c.setLineDash(state === "missed" ? [6, 4] : []);
      this.strokes((arc) => arc.kind === "choice" && this.marks.verdict(choiceKey(arc)) === state, "choice", alpha);
    }
  }

  private verdictColour(state: Verdict): string {
    const { look } = this;
    return { open: look.arc, passed: look.muted, wrong: look.bad, missed: look.good, right: look.good }[state];
  }

  /** The node whose edges are looked at: the one under the pointer, else the one that is picked or expanded. */
  private near(): string | null {
    const { hovering } = this.marks;
    const own = hovering ?? this.scene.focus;
    return own && this.shown(own);
  }

  private strokes(chosen: (arc: Arc) => boolean, kind: ArcKind, alpha: number): void {
    const { c, scene } = this;
    c.globalAlpha = alpha;
    c.beginPath();
    const heads: [Point, Point, boolean][] = [];
    for (const arc of scene.arcs) {
      if (!chosen(arc)) continue;
      const [from, bend, to] = curveOf(scene, arc).map((point) => this.screen(point)) as [Point, Point, Point];
      if (Math.max(from.x, to.x, bend.x) < 0 || Math.min(from.x, to.x, bend.x) > this.width) continue;
      if (Math.max(from.y, to.y, bend.y) < 0 || Math.min(from.y, to.y, bend.y) > this.height) continue;
      c.moveTo(from.x, from.y);
      if (this.cell < DOTS) c.lineTo(to.x, to.y);
      else c.quadraticCurveTo(bend.x, bend.y, to.x, to.y);
      if ((kind === "path" || kind === "choice") && this.cell >= 24) heads.push([bend, to, this.half(arc.to)]);
    }
    c.stroke();
    c.setLineDash([]);
    c.fillStyle = c.strokeStyle;
    for (const [bend, to, half] of heads) this.head(bend, to, kind === "path" ? 7 : 6, half);
    c.globalAlpha = 1;
  }

  /** An arrow's head, before the node that it points at. */
  private head(bend: Point, to: Point, size: number, half: boolean): void {
    const { c } = this;
    const length = Math.hypot(to.x - bend.x, to.y - bend.y) || 1;
    const [ux, uy] = [(to.x - bend.x) / length, (to.y - bend.y) / length];
    const { w, h } = half ? { w: 8, h: 8 } : this.box();
    const gap = Math.min(w / 2 / Math.max(Math.abs(ux), 1e-6), h / 2 / Math.max(Math.abs(uy), 1e-6));
    const [x, y] = [to.x - ux * gap, to.y - uy * gap];
    c.beginPath();
    c.moveTo(x, y);
    c.lineTo(x - ux * size * 1.4 - uy * size * 0.7, y - uy * size * 1.4 + ux * size * 0.7);
    c.lineTo(x - ux * size * 1.4 + uy * size * 0.7, y - uy * size * 1.4 - ux * size * 0.7);
    c.fill();
  }

  private highlights(): void {
    const { c, scene, marks, look } = this;
    if (!marks.lit.size && !marks.picked.size && !marks.hovered) return;
    for (const arc of scene.arcs) {
      const own = marks.lit.has(arc.key) || marks.picked.has(arc.key) || arc === marks.hovered;
      if (!own) continue;
      const [from, bend, to] = curveOf(scene, arc).map((point) => this.screen(point)) as [Point, Point, Point];
      c.beginPath();
      c.moveTo(from.x, from.y);
      c.quadraticCurveTo(bend.x, bend.y, to.x, to.y);
      c.strokeStyle = look.lit;
      c.lineWidth = 5;
      c.globalAlpha = 0.8;
      c.stroke();
      c.globalAlpha = 1;
    }
  }

  /** Where a letter count from the node that is looked at lies. */
  private from(place: number, n: number): number {
    return n === 0 ? place / 2 : (place >> 1) + n;
  }

  private region(): void {
    const { c, scene, look } = this;
    const { focus, delta, pair } = scene;
    if (!focus || !delta?.region) return;
    const [pa, pb] = [focus[pair[0]] ?? 0, focus[pair[1]] ?? 0];
    c.fillStyle = look.region;
    for (const [i, first] of delta.region.first.entries()) {
      const last = delta.region.last[i] ?? -1;
      if (first > last) continue;
      const y = this.from(pa, i) * ASPECT;
      const [x0, x1] = [this.sx(this.from(pb, first) - 0.5), this.sx(this.from(pb, last) + 0.5)];
      c.fillRect(x0, this.sy(y - ASPECT / 2), x1 - x0, this.cell * ASPECT + 0.5);
    }
  }

  /** The two pointers that trace the region's borders: they read one letter a step. */
  private walks(): void {
    const { c, scene, look } = this;
    const { focus, delta, pair } = scene;
    if (!focus || !delta?.region || this.cell < 5) return;
    const [pa, pb] = [focus[pair[0]] ?? 0, focus[pair[1]] ?? 0];
    const shift = Math.min(0.16, 7 / this.cell);
    for (const [walk, side] of [
      [delta.region.lower, 1],
      [delta.region.upper, -1],
    ] as const) {
      const points = walk.map(([i, j]) => ({
        x: this.sx(this.from(pb, j) + side * shift),
        y: this.sy((this.from(pa, i) - side * shift) * ASPECT),
      }));
      c.strokeStyle = look.step;
      c.fillStyle = look.step;
      c.lineWidth = this.cell >= BOXES ? 2.4 : 1.4;
      c.beginPath();
      for (const [n, { x, y }] of points.entries()) n ? c.lineTo(x, y) : c.moveTo(x, y);
      c.stroke();
      if (this.cell < 34) continue;
      for (let n = 1; n < points.length; n++) {
        const [p, q] = [points[n - 1] as Point, points[n] as Point];
        const [dx, dy] = [Math.sign(q.x - p.x), Math.sign(q.y - p.y)];
        const [x, y] = [(p.x + q.x) / 2 + dx * 3, (p.y + q.y) / 2 + dy * 3];
        c.beginPath();
        c.moveTo(x + dx * 4, y + dy * 4);
        c.lineTo(x - dx * 4 - dy * 4, y - dy * 4 + dx * 4);
        c.lineTo(x - dx * 4 + dy * 4, y - dy * 4 - dx * 4);
        c.fill();
      }
    }
  }

  /** How large a node is drawn. */
  private box(): { w: number; h: number } {
    if (this.cell >= BOXES) return { w: Math.min(this.cell * 0.6, 74), h: Math.min(this.cell * ASPECT * 0.66, 34) };
    const r = Math.max(2.4, Math.min(9, this.cell * 0.24));
    return { w: r, h: r };
  }

  private nodes(): void {
    const { scene } = this;
    const seen = this.seen();
    const [a, b] = scene.pair;
    const boxes = this.cell >= BOXES;
    if (this.cell >= DOTS) {
      for (let i = seen.rows[0]; i <= seen.rows[1]; i++)
        for (let j = seen.cols[0]; j <= seen.cols[1]; j++) {
          const places = scene.subject.bands.map((_, n) => (n === a ? 2 * i : n === b ? 2 * j : 0));
          if (a < 0 && i > 0) continue;
          if (scene.built && !scene.built.nodes.has(places.join())) continue;
          if (!scene.nodes.has(`${places[a] ?? 0},${places[b] ?? 0}`)) this.node(places, boxes, 0, false);
        }
      if (this.cell >= 22) for (const places of scene.cut) this.node(places, false, 0, false);
    }
    for (const own of scene.nodes.values()) {
      this.node(own.places, boxes && !this.half(own.places), own.taken, own.onPath);
    }
    const now = scene.built?.now;
    if (now?.kind === "node") this.focus(now.places);
    if (scene.focus) this.focus(scene.focus);
  }

  private node(places: readonly number[], boxed: boolean, taken: number, onPath: boolean): void {
    const { c, scene, look } = this;
    const { x, y } = this.screen(pointOf(scene, places));
    if (x < -40 || y < -40 || x > this.width + 40 || y > this.height + 40) return;
    const inside = scene.exact && scene.subject.bands.length <= 2 ? scene.alive.has(places.join()) : true;
    const ahead = this.ahead(places);
    const shape = () => {
      c.beginPath();
      if (boxed) c.roundRect(x - w / 2, y - h / 2, w, h, 4);
      else if (this.half(places) && this.cell >= DOTS) {
        const r = Math.min(5, Math.max(2.6, this.cell * 0.07)) + (taken ? 0.6 : 0);
        c.moveTo(x, y - r);
        c.lineTo(x + r, y);
        c.lineTo(x, y + r);
        c.lineTo(x - r, y);
        c.closePath();
      } else
        c.arc(
          x,
          y,
          Math.max(w / 2, taken && scene.subject.bands.length > 2 ? Math.min(7, 1.6 + taken ** 0.4) : 0),
          0,
          7,
        );
    };
    const { w, h } = this.box();
    shape();
    c.fillStyle = look.paper;
    c.fill(); // what is behind a faint node is not to be read through it
    c.globalAlpha = ahead === false ? 0.35 : inside || onPath || taken ? 1 : 0.55;
    c.fillStyle = taken ? look.arc : look.paper;
    c.strokeStyle = onPath ? look.path : taken ? look.arc : inside ? look.ink : look.muted;
    c.lineWidth = onPath ? 2.2 : taken ? 1.4 : 1;
    shape();
    if (boxed && taken) {
      c.fillStyle = look.paper;
      c.fill();
      c.save();
      c.globalAlpha *= 0.22;
      c.fillStyle = look.arc;
      c.fill();
      c.restore();
    } else c.fill();
    c.stroke();
    if (boxed) this.label(places, x, y, w, ahead === true);
    c.globalAlpha = 1;
    if (this.cell >= BOXES) this.numbers(places, x, y + (boxed ? h / 2 : 4));
  }

  /** Whether a node can be come to from the one that is looked at; null: none is. */
  private ahead(places: readonly number[]): boolean | null {
    const { focus, pair } = this.scene;
    if (!focus) return null;
    return pair.every((band) => band < 0 || (places[band] ?? 0) >= (focus[band] ?? 0));
  }

  /** g + h of a node, under it. */
  private numbers(places: readonly number[], x: number, bottom: number): void {
    const { c, scene, look } = this;
    const own = scene.nodes.get(this.shown(places))?.numbers;
    if (!own || own.f === null) return;
    // Below a node within a cut letter there may be no room: the words of the next node are rather read.
    const room = (this.cell * ASPECT) / 2 - this.box().h / 2 - 5;
    if (this.half(places) && this.cell >= BOXES && room < 12) return;
    const short = (value: number) => String(Number(value.toFixed(2)));
    const text = `${short(own.g)}+${short(Math.max(0, own.f - own.g))}`;
    c.font = `${own.standing === "expanded" ? "600 " : ""}9.5px ${look.mono}`;
    c.textAlign = "center";
    c.textBaseline = "top";
    const wide = c.measureText(text).width + 4;
    c.globalAlpha = 0.85;
    c.fillStyle = look.paper;
    c.fillRect(x - wide / 2, bottom + 1, wide, 11);
    c.globalAlpha = 1;
    c.fillStyle = own.standing === "expanded" ? look.arc : look.muted;
    c.fillText(text, x, bottom + 2);
  }

  private label(places: readonly number[], x: number, y: number, w: number, ahead: boolean): void {
    const { c, scene, look } = this;
    const [a, b] = scene.pair;
    c.textAlign = "center";
    c.textBaseline = "middle";
    const { focus, delta } = scene;
    if (focus && this.shown(places) === this.shown(focus)) return;
    const value = ahead && focus && delta ? this.delta(places) : null;
    if (value !== null) {
      c.font = `600 13px ${look.mono}`;
      c.fillStyle = look.ink;
      c.fillText(String(Number(value.toFixed(2))), x, y + 0.5);
      return;
    }
    const { h } = this.box();
    const size = Math.min(11, (h - 3.5) / 2); // two lines stay within a low box
    c.font = `${size}px ${look.mono}`;
    c.fillStyle = look.ink;
    const fits = Math.max(2, Math.floor((w - 4) / (0.618 * size)));
    const short = (text: string) => (text.length > fits ? `${text.slice(0, fits - 1)}…` : text);
    const own = (band: number) => {
      const word = scene.subject.bands[band];
      return word ? short(restOf(word, places[band] ?? 0)) : "";
    };
    if (a < 0) c.fillText(own(b), x, y);
    else {
      c.fillText(own(a), x, y - Math.min(6.5, 0.22 * h));
      c.fillText(own(b), x, y + Math.min(7, 0.25 * h));
    }
  }

  private shown(places: readonly number[]): string {
    return this.scene.pair.map((band) => places[band] ?? 0).join();
  }

  /** Whether a node lies within a letter of one of the words that are drawn. */
  private half(places: readonly number[]): boolean {
    return this.scene.pair.some((band) => ((places[band] ?? 0) & 1) === 1);
  }

  /** What both words differ by at a node, read from the one that is looked at. */
  private delta(places: readonly number[]): number | null {
    const { focus, delta, pair } = this.scene;
    if (!focus || !delta) return null;
    const index = (band: number) => ((places[band] ?? 0) >> 1) - ((focus[band] ?? 0) >> 1);
    const [row, col] = [delta.rows[index(pair[0])], delta.cols[index(pair[1])]];
    if (row === null || col === null || row === undefined || col === undefined) return null;
    return Math.abs(row - col);
  }

  private focus(places: readonly number[]): void {
    const { c, look } = this;
    const { x, y } = this.screen(pointOf(this.scene, places));
    const { w, h } = this.box();
    c.strokeStyle = look.ink;
    c.lineWidth = 2.2;
    c.beginPath();
    const half = this.half(places);
    if (this.cell >= BOXES && !half) c.roundRect(x - w / 2, y - h / 2, w, h, 4);
    else c.arc(x, y, half ? 8 : Math.max(5, w / 2 + 2), 0, 7);
    c.stroke();
    const r = this.cell >= BOXES && !half ? 7 : 4;
    c.beginPath();
    c.moveTo(x - r, y - r);
    c.lineTo(x + r, y + r);
    c.moveTo(x - r, y + r);
    c.lineTo(x + r, y - r);
    c.stroke();
  }

  /** ω of the edges of the path, of choices, and, where they are few, of all. */
  private weights(): void {
    const { c, scene, look, marks } = this;
    if (this.cell < 38) return;
    const near = this.near();
    const own = (arc: Arc) => near !== null && this.shown(arc.from) === near;
    const few =
      scene.arcs.filter((arc) => arc.kind !== "forbidden" && (near === null || own(arc))).length <= 24 &&
      !marks.choices.size &&
      this.cell >= 80 &&
      !scene.delta;
    c.font = `600 11px ${look.mono}`;
    c.textAlign = "center";
    c.textBaseline = "middle";
    for (const arc of scene.arcs) {
      const beside = arc.kind === "choice" ? marks.choices.get(choiceKey(arc)) : undefined;
      const shown =
        arc.kind === "path" || beside !== undefined || (few && arc.kind !== "forbidden" && (near === null || own(arc)));
      if (!shown || (arc.omega === null && beside === undefined)) continue;
      const [from, bend, to] = curveOf(scene, arc);
      const middle = { x: (from.x + 2 * bend.x + to.x) / 4, y: (from.y + 2 * bend.y + to.y) / 4 };
      const at = this.screen(middle);
      const text = beside ?? String(Number((arc.omega ?? 0).toFixed(2)));
      const wide = 6.8 * text.length + 8;
      // A label is not cut off by the edge of the canvas, nor by the words along it.
      const inside = (value: number, low: number, high: number) => Math.max(low, Math.min(high, value));
      const outside = at.x < 0 || at.y < 0 || at.x > this.width || at.y > this.height;
      if (outside) continue;
      const x = inside(at.x, STRIP + 6 + wide / 2, this.width - wide / 2 - 2);
      const y = inside(at.y, STRIP + 9, this.height - 10);
      c.fillStyle = look.paper;
      c.beginPath();
      c.roundRect(x - wide / 2, y - 8, wide, 16, 8);
      c.fill();
      c.lineWidth = 1;
      const colour = arc.kind === "path" ? look.path : look.arc;
      c.strokeStyle = beside === undefined ? colour : this.verdictColour(marks.verdict(choiceKey(arc)));
      c.stroke();
      c.fillStyle = c.strokeStyle;
      c.fillText(text, x, y + 0.5);
    }
  }

  /** The words along both sides, which stay in sight. */
  private headers(): void {
    const { c, scene, look } = this;
    const [a, b] = scene.pair;
    c.fillStyle = look.paper;
    c.fillRect(0, 0, this.width, STRIP);
    if (a >= 0) c.fillRect(0, 0, STRIP + 4, this.height);
    const seen = this.seen();
    const side = Math.min(20, this.cell * 0.8);
    for (let j = Math.max(0, seen.cols[0] - 1); j < scene.right.length && j <= seen.cols[1]; j++)
      this.letter(scene.right[j] as LetterNote, this.sx(j + 0.5), STRIP / 2, side, 20, `${b}:${j}`);
    if (a < 0) return;
    const tall = Math.min(20, this.cell * ASPECT * 0.8);
    for (let i = Math.max(0, seen.rows[0] - 1); i < scene.down.length && i <= seen.rows[1]; i++)
      this.letter(scene.down[i] as LetterNote, STRIP / 2, this.sy((i + 0.5) * ASPECT), 20, tall, `${a}:${i}`);
    c.fillRect(0, 0, STRIP + 4, STRIP);
  }

  private letter(letter: LetterNote, x: number, y: number, w: number, h: number, key: string): void {
    const { c, look, marks } = this;
    if (x < 4 || y < 4 || x > this.width || y > this.height) return;
    c.globalAlpha = letter.transparent ? 0.4 : 1;
    c.fillStyle = look.hue(letter.symbol);
    c.fillRect(x - w / 2, y - h / 2, w, h);
    c.globalAlpha = 1;
    const lit = marks.letters.has(key);
    c.strokeStyle = lit ? look.lit : letter.transparent ? look.muted : look.onHue;
    c.lineWidth = lit ? 2.5 : 0.6;
    c.setLineDash(letter.transparent && !lit ? [3, 2] : []);
    if (lit || Math.min(w, h) > 6) c.strokeRect(x - w / 2, y - h / 2, w, h);
    c.setLineDash([]);
    c.fillStyle = look.paper;
    if (Math.min(w, h) < 11) return;
    c.font = `${letter.transparent ? "italic " : "600 "}11px ${look.mono}`;
    c.textAlign = "center";
    c.textBaseline = "middle";
    c.fillStyle = letter.transparent ? look.ink : look.onHue;
    const name = letter.symbol.slice(0, 2);
    if (letter.mirrored) {
      c.save();
      c.translate(x, y + 0.5);
      c.scale(-1, 1);
      c.font = `italic 600 11px ${look.mono}`;
      c.fillText(`′${name}`, 0, 0); // the prime stands behind it once it is turned
      c.restore();
    } else c.fillText(name, x, y + 0.5);
    c.fillStyle = look.paper;
  }
}
