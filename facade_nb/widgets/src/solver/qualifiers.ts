// The four cases of the paper's Figure 4 side by side: the words of both layers to scale over the façade they make, and
// the qualifiers as switches. Python solves a case again when one of its switches is thrown.

import { focused, h, mark, setText, svg } from "../shared/dom.ts";
import { parseDrawing } from "../shared/drawing.ts";
import { formatNumber, holdBack } from "../shared/fields.ts";
import { type IconName, icon } from "../shared/icons.ts";
import { Kernel } from "../shared/kernel.ts";
import { type Bytes, byteLength, unpack } from "../shared/packing.ts";
import { announce } from "../shared/presence.ts";
import { stepByKeys } from "../shared/stepping.ts";
import { themeOf, watchDress } from "../shared/theme.ts";
import type { WidgetModel } from "../shared/types.ts";
import { hueOf } from "./letters.ts";
import { Links, linked, target } from "./links.ts";

interface SymbolCase {
  name: string;
  size: number;
  opaque: boolean;
  attached: boolean;
  unoccludable: boolean;
}

interface Case {
  name: string;
  canvas: { x: number; y: number };
  changed: boolean;
  message: string;
  symbols: SymbolCase[];
  hues: Record<string, number>;
  patterns: { layer: string; text: string }[];
  letters: { layer: string; symbol: string; start: number; end: number; transparent: boolean; mirrored: boolean }[];
  cuts: number[];
  svg: { light: string; dark: string };
  told: string;
  cost: number | null;
}

const QUALIFIERS = [
  ["opaque", "Opaque: its shapes cover their whole cell, so nothing need stand behind"],
  ["unoccludable", "Unoccludable: only what is opaque or transparent may stand in front"],
  ["attached", "Attached: no gap may open beside it"],
] as const;
const PREFIX = "fnb-traced";
const ROW = 22;
const GAP = 5;

export function qualifiers(channel: WidgetModel, signal: AbortSignal): HTMLElement {
  const client = Math.random().toString(36).slice(2);
  const kernel = Kernel.of(channel);
  const links = new Links([]);
  const cards: Card[] = [];
  const grid = h("div", { class: "fnb-cases" });
  const trouble = h("p", { class: "fnb-pair-conflict", role: "alert" });
  const el = h(
    "section",
    { class: "fnb-view", "aria-label": "Alignment qualifiers" },
    h(
      "header",
      { class: "fnb-view-head" },
      h("h3", { class: "fnb-view-title" }, "Alignment qualifiers"),
      h("p", { class: "fnb-view-subtitle" }, "What the upper layer may cover, and where it may stand (Figure 4)"),
    ),
    trouble,
    grid,
  );
  const ask = (message: Record<string, unknown>) => {
    kernel.tell({ ...message, client });
  };
  let cases: Case[] = [];
  const load = async () => {
    const bytes = channel.get<Bytes>("cases");
    if (!byteLength(bytes)) return; // put away: they come when Python has heard of this view
    const told = await unpack<Case[]>(bytes);
    if (signal.aborted || bytes !== channel.get<Bytes>("cases")) return; // newer ones have come
    cases = told;
    show();
  };
  const show = () => {
    setText(trouble, channel.get<string>("trouble").trim().split("\n").at(-1) ?? "");
    while (cards.length < cases.length) {
      const card = new Card(cards.length, ask);
      cards.push(card);
      grid.append(card.el);
    }
    grid.style.setProperty("--fnb-count", String(cards.length));
    for (const [n, one] of cases.entries()) cards[n]?.show(one);
    links.apply(el);
  };
  channel.on("change:cases", load);
  channel.on("change:trouble", show);
  watchDress(() => requestAnimationFrame(show), signal);
  requestAnimationFrame(show); // in the page it has a theme
  links.listen(el, signal);
  links.watch(() => links.apply(el), signal);
  announce(channel, client, signal);
  signal.addEventListener("abort", () => {
    channel.off("change:cases", load);
    channel.off("change:trouble", show);
  });
  void load();
  return el;
}

class Card {
  readonly el: HTMLElement;
  private readonly title: HTMLElement;
  private readonly drawing = h("div", { class: "fnb-case-drawing" });
  private readonly told = h("p", { class: "fnb-case-told", role: "status" });
  private readonly cost = h("span", { class: "fnb-muted" });
  private readonly switches = h("table", { class: "fnb-case-switches" });
  private readonly reset: HTMLButtonElement;
  private readonly width: HTMLInputElement;
  private committed = "";
  private readonly ids = `fnb-${Math.random().toString(36).slice(2)}`;
  private readonly buttons = new Map<string, HTMLButtonElement>();
  private drawn = "";
  private patterns = h("div", { class: "fnb-case-patterns" });

  constructor(
    private readonly number: number,
    private readonly ask: (message: Record<string, unknown>) => void,
  ) {
    this.title = h("h4", {});
    this.reset = h("button", { type: "button", class: "fnb-fix" }, "As printed");
    this.reset.addEventListener("click", () => ask({ op: "reset", case: number }));
    this.width = h("input", {
      type: "text",
      inputmode: "decimal",
      class: "fnb-number fnb-mu",
      "aria-label": `Canvas width of case ${letterOf(number)}`,
    });
    holdBack(this.width, () => this.committed);
    stepByKeys(this.width, { step: 0.1, min: 0.1 });
    this.width.addEventListener("change", () =>
      ask({ op: "set", case: number, path: ["canvas", "width"], value: this.width.value }),
    );
    this.el = h(
      "article",
      { class: "fnb-case", "data-case": letterOf(number) },
      h("header", {}, this.title, this.reset),
      this.patterns,
      this.drawing,
      h("div", { class: "fnb-case-line" }, this.told, this.cost),
      this.switches,
      h("label", { class: "fnb-field" }, "canvas", this.width, "m"),
    );
  }

  show(one: Case): void {
    setText(this.title, `(${letterOf(this.number)}) ${one.name.split(": ").at(-1) ?? ""}`);
    mark(this.title, "title", one.name);
    setText(this.told, one.message || one.told);
    mark(this.told, "data-failed", one.message !== "");
    setText(this.cost, one.cost === null ? "" : `J = ${formatNumber(one.cost)} m`);
    this.reset.hidden = !one.changed;
    this.committed = formatNumber(one.canvas.x);
    if (focused(this.width) !== this.width) this.width.value = this.committed;
    this.patterns.replaceChildren(
      ...one.patterns.map(({ layer, text }) => h("code", { title: `Layer ${layer}` }, text)),
    );
    this.showSwitches(one);
    this.draw(one);
  }

  private showSwitches(one: Case): void {
    const names = one.symbols.map(({ name }) => name).join();
    if (this.switches.dataset.names !== names) {
      this.switches.dataset.names = names;
      this.buttons.clear();
      const head = h("tr", {}, h("th", {}), ...QUALIFIERS.map(([name, title]) => h("th", { title }, name)));
      const body = one.symbols.map((own) =>
        h(
          "tr",
          linked([target.symbol(own.name)]),
          h("th", {}, h("span", { class: `fnb-case-symbol ${hueOf(one.hues, own.name)}` }, own.name)),
          ...QUALIFIERS.map(([name]) => h("td", {}, this.toggle(own.name, name))),
        ),
      );
      this.switches.replaceChildren(head, ...body);
    }
    for (const own of one.symbols)
      for (const [name] of QUALIFIERS)
        mark(this.buttons.get(`${own.name} ${name}`) as Element, "aria-pressed", String(own[name]));
  }

  private toggle(symbol: string, name: IconName & (typeof QUALIFIERS)[number][0]): HTMLButtonElement {
    const label = `${symbol} is ${name}, case ${letterOf(this.number)}`;
    const button = h("button", { type: "button", class: "fnb-toggle", "aria-label": label, title: label }, icon(name));
    button.addEventListener("click", () => {
      const value = button.getAttribute("aria-pressed") !== "true";
      this.ask({ op: "set", case: this.number, path: ["symbols", symbol, name], value });
    });
    this.buttons.set(`${symbol} ${name}`, button);
    return button;
  }

  /** The façade, and over it the words of both layers, on one scale. */
  private draw(one: Case): void {
    const theme = themeOf(this.el);
    const by = `${theme}|${one.svg[theme]}|${JSON.stringify(one.letters)}`;
    if (by === this.drawn) return;
    this.drawn = by;
    if (!one.svg[theme]) {
      this.drawing.replaceChildren(h("p", { class: "fnb-empty" }, "No layout"));
      return;
    }
    const { svg: picture, width, height, scale, origin } = parseDrawing(one.svg[theme].replaceAll(PREFIX, this.ids));
    const layers = [...new Set(one.letters.map((own) => own.layer))];
    const top = layers.length * (ROW + GAP) + 4;
    const x = (metres: number) => origin.x + metres * scale;
    const strips = layers.flatMap((layer, row) =>
      one.letters
        .filter((own) => own.layer === layer)
        .map((own) => this.letter(one, own, x(own.start), row * (ROW + GAP) + 2, (own.end - own.start) * scale)),
    );
    const cuts = one.cuts.map((value) =>
      svg("path", { class: "fnb-case-cut", d: `M${x(value)} 0V${top + origin.y - one.canvas.y * scale}` }),
    );
    for (const [name, value] of [
      ["width", null],
      ["height", null],
      ["style", null],
    ] as const)
      mark(picture, name, value);
    picture.setAttribute("viewBox", `0 ${-top} ${width} ${height + top}`);
    const over = svg("g", { transform: `translate(0 ${-top})` }, ...cuts, ...strips);
    for (const shape of picture.querySelectorAll<SVGElement>("[data-shape]"))
      for (const [name, value] of Object.entries(linked([target.symbol(shape.dataset.x ?? "")])))
        mark(shape, name, value);
    picture.append(over);
    this.drawing.replaceChildren(picture);
  }

  private letter(one: Case, own: Case["letters"][number], x: number, y: number, width: number): SVGGElement {
    const group = svg("g", {
      class: `fnb-case-letter ${hueOf(one.hues, own.symbol)}`,
      "data-ghost": own.transparent,
      "data-open": one.symbols.some((each) => each.name === own.symbol && !each.opaque),
      ...linked([target.symbol(own.symbol)]),
    });
    group.append(svg("rect", { x, y, width, height: ROW }));
    if (width > 6) {
      const middle = x + width / 2;
      const text = svg("text", { x: middle, y: y + ROW / 2 + 4 }, own.symbol);
      if (own.mirrored) text.setAttribute("transform", `translate(${2 * middle} 0) scale(-1 1)`);
      group.append(text);
    }
    return group;
  }
}

const letterOf = (number: number): string => String.fromCharCode(97 + number);
