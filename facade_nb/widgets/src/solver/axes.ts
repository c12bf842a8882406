// Which axis a view shows: the one that is played, until the reader chooses.

import { h, mark } from "../shared/dom.ts";
import type { Alternatives } from "./alternatives.ts";
import type { Axis, Timeline } from "./timeline.ts";

export class AxisChoice {
  private chosen: Axis | null = null;
  readonly el: HTMLElement;
  private readonly tabs: [Axis | null, HTMLButtonElement][];

  constructor(
    private readonly timeline: Timeline,
    refresh: () => void,
    /** Where a candidate is chosen, its axis is shown. */
    private readonly alternatives?: Pick<Alternatives, "axis">,
  ) {
    const choices: [Axis | null, string, string][] = [
      [null, "auto", "Show the axis that is played"],
      ["x", "x", "Show the horizontal axis"],
      ["y", "y", "Show the vertical axis"],
    ];
    this.tabs = choices.map(([axis, text, label]) => {
      const tab = h("button", { type: "button", class: "fnb-tab", "aria-label": label, title: label }, text);
      tab.addEventListener("click", () => {
        this.chosen = axis;
        refresh();
      });
      return [axis, tab];
    });
    this.el = h("span", { class: "fnb-tabs", role: "group", "aria-label": "Axis" }, ...this.tabs.map(([, tab]) => tab));
  }

  /** The axis to show at a position. */
  at(position: number): Axis {
    for (const [axis, tab] of this.tabs) mark(tab, "aria-pressed", String(axis === this.chosen));
    const axis = this.chosen ?? this.alternatives?.axis ?? this.timeline.axisAt(position);
    for (const [own, tab] of this.tabs) mark(tab, "data-shown", own === axis);
    return axis;
  }
}
