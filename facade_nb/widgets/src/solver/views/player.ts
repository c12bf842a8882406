// The player, with all events as sentences, and the code that does what is played.

import { h, mark, setText } from "../../shared/dom.ts";
import { icon } from "../../shared/icons.ts";
import { type CodeData, CodePanel } from "../codepanel.ts";
import { type Rows, rows } from "../rows.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";

interface Captions {
  text: string[];
}

const HEIGHT = 22;
const MOST = 12;

export const player: ViewKind = {
  title: "Events",
  subtitle: "What the solver did, one after the other",
  needs: ["captions"],
  make: (context) => new PlayerView(context),
};

class PlayerView implements View {
  readonly el: HTMLElement;
  readonly controls: HTMLElement[];
  private readonly list: Rows<number>;
  private readonly positions: number[];
  private readonly kept = h("p", { class: "fnb-events-kept", role: "status", hidden: true });
  private readonly panel = new CodePanel();
  private readonly code = this.panel.el;
  private now = -1;
  /** How many events are listed: while a view asks, not those that give its answer away. */
  private told = -1;

  constructor(private readonly context: ViewContext) {
    const { text } = context.pieces.captions as Captions;
    this.positions = text.map((_, at) => at);
    this.list = rows<number>(
      {
        height: HEIGHT,
        most: MOST,
        key: (at) => `${at} ${Math.sign(at - this.now)}`,
        make: (at) => this.row(at, text[at] ?? ""),
      },
      context.signal,
    );
    this.code.hidden = true;
    const log = h("div", { class: "fnb-events", role: "table", "aria-label": "Events" }, this.kept, this.list.el);
    this.el = h("div", { class: "fnb-player" }, log, this.code);
    const toggle = h(
      "button",
      {
        type: "button",
        class: "fnb-button fnb-wide",
        "aria-pressed": "false",
        title: "Show the code of what is played",
      },
      icon("code"),
      h("span", {}, "Code"),
    );
    toggle.addEventListener("click", () => {
      this.code.hidden = !this.code.hidden;
      mark(toggle, "aria-pressed", String(!this.code.hidden));
      mark(this.el, "data-code", !this.code.hidden);
      void this.load();
    });
    this.controls = [toggle];
    if (context.model.get<boolean>("code")) toggle.click();
  }

  show(position: number): void {
    const told = Math.min(this.positions.length, this.context.asking.from);
    if (position !== this.now || told !== this.told) {
      this.now = position;
      this.told = told;
      this.list.set(this.positions.slice(0, told), position < told ? position : told - 1);
      const rest = this.positions.length - told;
      this.kept.hidden = !rest;
      const first = rest === 1 ? "Event" : "Events";
      const range = rest === 1 ? `${told + 1}` : `${told + 1} to ${this.positions.length}`;
      setText(this.kept, `${first} ${range}: kept back while a view asks`);
    }
    // While a view asks, the variables would tell the answer.
    if (!this.code.hidden && !this.context.asking.on) this.panel.show(position);
  }

  private async load(): Promise<void> {
    if (this.panel.loaded || this.code.hidden) return;
    this.panel.say("Loading…");
    try {
      this.panel.load(await this.context.session.piece<CodeData>("code"));
      if (!this.context.signal.aborted) this.context.refresh();
    } catch (error) {
      this.panel.say(error instanceof Error ? error.message : String(error));
    }
  }

  private row(at: number, caption: string): HTMLElement {
    const { player, timeline } = this.context;
    // What an event says is told when it is played: a list that says it before tells the answer.
    const later = at > this.now;
    const said = later ? "" : caption;
    const row = h(
      "div",
      { role: "row", class: "fnb-event", "data-now": at === this.now, "data-later": later, title: said || null },
      h("span", { role: "cell", class: "fnb-event-at" }, String(at + 1)),
      h("span", { role: "cell", class: "fnb-event-kind" }, timeline.kindAt(at)),
      h("span", { role: "cell", class: "fnb-event-text" }, said),
    );
    row.addEventListener("click", () => {
      player.pause();
      player.go(at);
    });
    return row;
  }
}
