// The façade as the events build it: letters as strips while they are placed, then shape by shape; the forces that the
// sizing finds; and what is lit anywhere is outlined on it.

import { h, mark, setText, svg } from "../../shared/dom.ts";
import { type Box, boxOf, type Drawing, parseDrawing } from "../../shared/drawing.ts";
import { formatNumber } from "../../shared/fields.ts";
import { icon } from "../../shared/icons.ts";
import { themeOf, watchDress } from "../../shared/theme.ts";
import type { Alternative } from "../alternatives.ts";
import { linked, target } from "../links.ts";
import type { PathNote } from "../network/story.ts";
import { type Rebuilt, rebuilt } from "../placed.ts";
import { type PlacedLetter, Placing, type PlacingData } from "../placing.ts";
import { type Drawn, drawLoads, loadLegend, loadsOf } from "../sizing/loads.ts";
import { type SizingEvent, type System, systemsOf } from "../sizing/system.ts";
import { type Axis, played } from "../timeline.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";

interface FacadeData {
  svg: { light: string; dark: string };
  shapes: number[];
  holes: number[];
}

const PREFIX = "fnb-traced";
type Forces = "auto" | Axis | "off";

const FORCES: [Forces, string][] = [
  ["auto", "Show forces while the sizing is played"],
  ["x", "Show the forces of the horizontal axis"],
  ["y", "Show the forces of the vertical axis"],
  ["off", "Show no forces"],
];

const ROOM = { width: 620, height: 360 }; // pixels that the drawing has; the width until it is known
const EDGE = 26; // units of the drawing around what stands out of the canvas
const PLAIN = 24; // pixels per metre of the plain frame, where there is no drawing

export const facade: ViewKind = {
  title: "Façade",
  subtitle: "What the events have built so far",
  needs: ["facade", "placing"],
  wants: ["sizing", "alignment"],
  make: (context) => new FacadeView(context),
};

class FacadeView implements View {
  readonly el: HTMLElement;
  private readonly data: FacadeData;
  private readonly placing: Placing;
  private readonly sheet = h("div", { class: "fnb-traced-sheet" });
  private readonly note = h("p", { class: "fnb-traced-note" });
  private readonly other = svg("g", { class: "fnb-traced-other" });
  private copies: Rebuilt[] = [];
  /** Where the canvas ends, for what is longer. */
  private readonly edge = svg("g", { class: "fnb-traced-beyond" });
  private readonly strips = svg("g");
  private readonly loads = svg("g", { class: "fnb-loads" });
  private readonly legend = h("p", { class: "fnb-legend", role: "note", "aria-label": "Forces", hidden: true });
  private drawn: Drawn[] = [];
  private readonly systems: Partial<Record<Axis, System>>;
  private forces: Forces = "auto";
  private loadsBy = "";
  /** Pixels that the drawing may be wide. */
  private room = ROOM.width;
  private readonly marks = svg("g");
  private readonly ids = `fnb-${Math.random().toString(36).slice(2)}`;
  readonly controls: HTMLElement[];
  private preview = false;
  /** The moment that is shown. */
  private at = 0;
  /** Where letters and boundaries are placed. */
  private readonly placed: number[];
  private by = "";
  private theme: "light" | "dark" | null = null;
  private drawing: Drawing | null = null;
  private shapes: SVGGElement[] = [];
  private finish: Element[] = [];

  constructor(private readonly context: ViewContext) {
    this.data = context.pieces.facade as FacadeData;
    this.placing = new Placing(context.pieces.placing as PlacingData, context.timeline.data.chosen);
    const events = (context.pieces.sizing as { events: SizingEvent[] } | undefined)?.events ?? [];
    this.systems = systemsOf(events, (context.pieces.alignment as { paths: PathNote[] } | undefined)?.paths ?? []);
    this.el = h("div", { class: "fnb-traced", "data-preview": false }, this.sheet, this.legend, this.note);
    const { letters, boundaries } = this.placing;
    this.placed = [...letters, ...boundaries].map((own) => own.at).sort((a, b) => a - b);
    const toggle = h(
      "button",
      { type: "button", class: "fnb-button fnb-wide", "aria-pressed": "false", title: "Show faintly what it becomes" },
      icon("eye"),
      h("span", {}, "Preview"),
    );
    toggle.addEventListener("click", () => {
      this.preview = !this.preview;
      mark(toggle, "aria-pressed", String(this.preview));
      context.refresh();
    });
    this.controls = Object.keys(this.systems).length ? [toggle, this.choice()] : [toggle];
    watchDress(() => context.refresh(), context.signal);
    const resized = new ResizeObserver(() => {
      const room = Math.round(this.sheet.clientWidth / 40) * 40;
      if (!room || room === this.room) return;
      this.room = room;
      context.refresh();
    });
    resized.observe(this.sheet);
    context.signal.addEventListener("abort", () => {
      resized.disconnect();
    });
    requestAnimationFrame(() => context.signal.aborted || context.refresh()); // in the page it has a theme
  }

  show(position: number): void {
    this.at = position;
    mark(this.el, "data-preview", this.ghost);
    this.dress();
    this.build(position);
    this.load(position);
  }

  private build(position: number): void {
    const drawn = played(this.data.shapes, position);
    const { alternatives } = this.context;
    const other = alternatives.at(position, alternatives.axis ?? "x");
    const by = [this.theme, drawn, played(this.placed, position), other?.name, other && this.room].join("|");
    if (by === this.by) return;
    this.by = by;
    for (const [n, shape] of this.shapes.entries()) mark(shape, "data-later", n >= drawn);
    // Lines and shadows are those of all shapes of a layer together: they come with the last shape.
    const done = drawn === this.data.shapes.length && drawn > 0;
    for (const element of this.finish) mark(element, "data-later", !done);
    mark(this.el, "data-other", other !== null);
    for (const element of [...this.shapes, ...this.finish]) mark(element, "data-hidden", other !== null);
    this.copies = other ? rebuilt(other, this.placing.shapes, this.shapes, this.drawing as Drawing) : [];
    this.other.replaceChildren(...this.copies.map(({ el }) => el));
    const beyond = this.fit(other);
    this.drawStrips(position, drawn > 0 || other !== null);
    setText(this.note, other ? `${this.sayOther(other)}${beyond}` : this.say(position, drawn));
  }

  /** Units of a drawing to a pixel. */
  private unit(width: number, height: number): number {
    return Math.max(width / this.room, height / ROOM.height);
  }

  /** Have all of a candidate in the picture, with the canvas marked where it is longer. Gives what there is to say of that. */
  private fit(other: Alternative | null): string {
    const { svg: picture, width, height, scale, origin } = this.drawing as Drawing;
    const { canvas } = this.context.timeline.data;
    const [right, top] = [origin.x + canvas.x * scale, origin.y - canvas.y * scale];
    const across = other?.note.axis !== "y";
    const ends = this.copies.map(({ box }) => (across ? box.x + box.width : box.y));
    const end = across ? Math.max(right, ...ends) : Math.min(top, ...ends);
    const long = across ? end - right : top - end;
    if (!other || long < 1) {
      picture.setAttribute("viewBox", `0 0 ${width} ${height}`);
      this.edge.replaceChildren();
      return "";
    }
    const wide = across ? Math.max(width, end + EDGE) : width;
    const up = across ? 0 : Math.min(0, end - EDGE);
    picture.setAttribute("viewBox", `0 ${up} ${wide} ${height - up}`);
    const out = across
      ? { x: right, y: top, width: long, height: origin.y - top }
      : { x: origin.x, y: end, width: right - origin.x, height: long };
    const line = across
      ? { x1: right, x2: right, y1: top - EDGE / 2, y2: origin.y + EDGE / 2 }
      : { x1: origin.x - EDGE / 2, x2: right + EDGE / 2, y1: top, y2: top };
    const unit = this.unit(wide, height - up);
    const at = across ? { x: right - 6, y: top - 6 } : { x: right, y: top - 6 };
    const size = other.note.axis === "x" ? canvas.x : canvas.y;
    this.edge.replaceChildren(
      this.rect("fnb-traced-out", out),
      svg("line", line),
      svg("text", { ...at, "font-size": (11 * unit).toFixed(1) }, `canvas ${formatNumber(size)} m`),
    );
    return ` They reach ${formatNumber(long / scale)} m beyond the canvas.`;
  }

  light(): void {
    const { lit, picked } = this.context.links;
    for (const { el, keys } of this.drawn) {
      mark(
        el,
        "data-lit",
        keys.some((key) => lit.has(key)),
      );
      mark(
        el,
        "data-chosen",
        keys.some((key) => picked.has(key)),
      );
    }
    if (this.el.hasAttribute("data-other")) {
      const of = (keys: ReadonlySet<string>, name: string) =>
        this.copies.filter((own) => own.keys.some((key) => keys.has(key))).map(({ box }) => this.rect(name, box));
      this.marks.replaceChildren(...of(picked, "fnb-traced-pick"), ...of(lit, "fnb-traced-lit"));
      return;
    }
    this.marks.replaceChildren(...this.outlines(picked, "fnb-traced-pick"), ...this.outlines(lit, "fnb-traced-lit"));
  }

  /** Whether it is shown what the façade becomes: not while a view asks, for that tells the answer. */
  private get ghost(): boolean {
    return this.preview && !this.context.asking.on;
  }

  private choice(): HTMLElement {
    const tabs = FORCES.map(([name, title]) => {
      const tab = h(
        "button",
        { type: "button", class: "fnb-tab", title, "aria-label": title, "aria-pressed": String(name === this.forces) },
        name,
      );
      tab.addEventListener("click", () => {
        this.forces = name;
        for (const [n, [other]] of FORCES.entries()) mark(tabs[n] as Element, "aria-pressed", String(other === name));
        this.context.refresh();
      });
      return tab;
    });
    const group = h("span", { class: "fnb-tabs", role: "group", "aria-label": "Forces" }, ...tabs);
    return h("span", { class: "fnb-traced-forces" }, h("span", { class: "fnb-muted" }, "Forces"), group);
  }

  /** The axis whose forces are shown at a position, by the reader's choice or because its sizing is played. */
  private loaded(position: number): Axis | null {
    if (this.forces === "off") return null;
    if (this.forces !== "auto") return this.forces;
    const { axis, stage } = this.context.timeline.data.stages[this.context.timeline.stageAt(position)] ?? {};
    return stage === "sizing" && axis ? axis : null;
  }

  /** The forces of the layout at a position. A candidate has none, and what is asked may be told by them. */
  private load(position: number): void {
    const axis = this.loaded(position);
    const system = axis ? this.systems[axis] : undefined;
    const { asking } = this.context;
    const other = this.el.hasAttribute("data-other");
    const solved = system?.solved && system.solved.at <= position;
    const by = [this.theme, axis, solved, asking.on, other, this.room].join("|");
    if (by === this.loadsBy) return;
    this.loadsBy = by;
    const shown = solved && !asking.on && !other ? loadsOf(system, system.at(position), this.placing) : null;
    const { width, height } = this.drawing as Drawing;
    const unit = this.unit(width, height);
    this.drawn = shown ? drawLoads(shown, this.drawing as Drawing, unit) : [];
    this.loads.replaceChildren(...this.drawn.map(({ el }) => el));
    mark(this.el, "data-forces", this.drawn.length > 0);
    const none = !system
      ? `The axis ${axis} has no least-squares system.`
      : asking.on
        ? "Forces are not shown while a view asks."
        : other
          ? "Forces are told of the layout only."
          : `The forces along ${axis} are known when its system is solved.`;
    this.legend.replaceChildren(...(shown ? loadLegend(shown) : axis ? [h("span", {}, none)] : []));
    this.legend.hidden = !axis;
  }

  /** Put the drawing of the page's theme in the sheet. */
  private dress(): void {
    const theme = themeOf(this.el);
    if (theme === this.theme) return;
    this.theme = theme;
    const text = this.data.svg[theme];
    const { x: width, y: height } = this.context.timeline.data.canvas;
    if (text) {
      this.drawing = parseDrawing(text.replaceAll(PREFIX, this.ids));
    } else {
      const size = { width: width * PLAIN + 20, height: height * PLAIN + 20 };
      const blank = svg("svg", { viewBox: `0 0 ${size.width} ${size.height}` });
      this.drawing = { svg: blank, ...size, scale: PLAIN, origin: { x: 10, y: size.height - 10 } };
    }
    const { svg: picture, scale, origin } = this.drawing;
    this.shapes = [...picture.querySelectorAll<SVGGElement>("[data-shape]")];
    this.shapes.sort((a, b) => Number(a.dataset.shape) - Number(b.dataset.shape));
    this.finish = [...picture.querySelectorAll(":scope > g > :not([data-shape])")];
    for (const [n, shape] of this.shapes.entries()) {
      const told = this.placing.shapes[n];
      if (!told) continue;
      const letters = this.placing.lettersOf(told).map((own) => target.letter(own.axis, own.layer, own.letter));
      for (const [name, value] of Object.entries(linked([target.shape(n), ...letters], this.placing.about(told))))
        mark(shape, name, value);
    }
    const frame = svg("rect", {
      class: "fnb-traced-canvas",
      x: origin.x,
      y: origin.y - height * scale,
      width: width * scale,
      height: height * scale,
    });
    picture.prepend(frame);
    picture.append(this.other, this.edge, this.strips, this.loads, this.marks);
    this.sheet.replaceChildren(picture);
  }

  /** Before there are shapes: the letters that are placed, across and up, and the boundaries of their columns. */
  private drawStrips(position: number, shaped: boolean): void {
    const letters = this.placing.letters.filter((own) => own.at <= position && !own.transparent);
    const lines = this.placing.boundaries.filter((own) => own.at <= position);
    const shown = shaped ? [] : letters.map((own) => this.rect("fnb-traced-strip", this.strip(own)));
    const cuts = shaped
      ? []
      : lines.flatMap((own) =>
          own.boundaries.map((value) => this.rect("fnb-traced-cut", this.band(own.axis, value, value))),
        );
    this.strips.replaceChildren(...shown, ...cuts);
  }

  private sayOther(other: Alternative): string {
    const how = other.aligned
      ? "Its letters stand in its columns at preferred sizes"
      : "Its letters stand at preferred sizes, end to end where no columns are told";
    return `${other.name}, not the layout. ${other.fate} ${how}: sizes are told of the layout only.`;
  }

  private say(position: number, drawn: number): string {
    const { failure } = this.context.timeline.data;
    if (drawn) return `${drawn} of ${this.data.shapes.length} shapes`;
    if (failure) return failure;
    return this.placing.letters.some((own) => own.at <= position)
      ? "Letters are placed; shapes come in Merging"
      : "Nothing is placed yet";
  }

  private outlines(told: ReadonlySet<string>, name: string): SVGElement[] {
    if (!told.size) return [];
    const keys = this.ofTheLayout(told);
    const position = this.at;
    const own: SVGElement[] = [];
    const single = [...keys].some((key) => key.startsWith("shape:"));
    for (const [n, shape] of this.shapes.entries()) {
      if (!this.ghost && shape.hasAttribute("data-later")) continue;
      const told = this.placing.shapes[n];
      const hit = single ? keys.has(target.shape(n)) : told && this.placing.about(told).some((key) => keys.has(key));
      if (hit) own.push(this.rect(name, boxOf(shape)));
    }
    if (single) return own;
    for (const line of this.placing.boundaries) {
      if (!this.ghost && line.at > position) continue;
      for (const [j, value] of line.boundaries.entries()) {
        const next = line.boundaries[j + 1];
        if (keys.has(target.boundary(line.axis, line.group, j)))
          own.push(this.rect(`${name} fnb-traced-edge`, this.band(line.axis, value, value)));
        if (next !== undefined && keys.has(target.column(line.axis, line.group, j)))
          own.push(this.rect(`${name} fnb-traced-column`, this.band(line.axis, value, next)));
      }
    }
    // A letter without a shape of its own: transparent, or masked.
    const hidden = this.placing.letters.filter(
      (each) => (this.ghost || each.at <= position) && keys.has(target.letter(each.axis, each.layer, each.letter)),
    );
    for (const each of hidden) own.push(this.rect(`${name} fnb-traced-letter`, this.strip(each)));
    return own;
  }

  /** The words of another candidate may be the layout's, too; they do not light as the layout's. */
  private ofTheLayout(told: ReadonlySet<string>): ReadonlySet<string> {
    const { chosen } = this.context.timeline.data;
    const own = (["x", "y"] as const).map((axis) => target.candidate(axis, chosen[axis]?.number ?? -1));
    const other = [...told].some((key) => key.startsWith("candidate:") && !own.includes(key));
    return other ? new Set([...told].filter((key) => !key.startsWith("word:"))) : told;
  }

  private strip(own: PlacedLetter): Box {
    return this.band(own.axis, own.start, own.end);
  }

  /** A band across the whole façade, in units of the drawing. */
  private band(axis: Axis, start: number, end: number): Box {
    const { x, y } = this.context.timeline.data.canvas;
    const { scale, origin } = this.drawing as Drawing;
    const size = (end - start) * scale;
    return axis === "x"
      ? { x: origin.x + start * scale, y: origin.y - y * scale, width: size, height: y * scale }
      : { x: origin.x, y: origin.y - end * scale, width: x * scale, height: size };
  }

  private rect(name: string, box: Box): SVGRectElement {
    return svg("rect", { class: name, "pointer-events": "none", ...box });
  }
}
