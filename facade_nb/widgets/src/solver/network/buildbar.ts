// The bar with which a network is built up: a slider, a part back and on, and what the part is, in words.

import { h, mark, setText } from "../../shared/dom.ts";
import { icon } from "../../shared/icons.ts";
import { type Built, builtUp, type Part, partsOf, tell } from "./building.ts";
import type { Base } from "./scene.ts";
import type { Subject } from "./story.ts";

export class BuildBar {
  readonly toggle = h(
    "button",
    {
      type: "button",
      class: "fnb-button fnb-wide",
      "aria-pressed": "false",
      title: "See the network come about, part by part",
    },
    h("span", {}, "Build up"),
  );
  private readonly slider = h("input", { type: "range", min: 1, value: 1, "aria-label": "Parts of the network" });
  private readonly count = h("output", { class: "fnb-net-built-count" });
  private readonly text = h("p", { class: "fnb-net-built-text", role: "status" });
  readonly el: HTMLElement;
  private asked = false;
  private by = "";
  private parts: Part[] = [];
  private at = 1;

  constructor(private readonly changed: () => void) {
    const step = (label: string, name: "back" | "forward", by: number) => {
      const button = h(
        "button",
        { type: "button", class: "fnb-button", "aria-label": label, title: label },
        icon(name),
      );
      button.addEventListener("click", () => this.go(this.at + by));
      return button;
    };
    this.slider.addEventListener("input", () => this.go(Number(this.slider.value)));
    this.toggle.addEventListener("click", () => {
      this.asked = !this.asked;
      changed();
    });
    this.el = h(
      "div",
      { class: "fnb-net-built", hidden: true },
      h(
        "div",
        { class: "fnb-net-built-line" },
        step("A part less", "back", -1),
        this.slider,
        step("A part more", "forward", 1),
        this.count,
      ),
      this.text,
    );
  }

  /** What stands so far; null where the network is shown as a whole. It goes up whenever that changes. */
  show(subject: Subject, base: Base, quiet: boolean): Built | null {
    const can = base.lattice !== null && !quiet;
    this.toggle.hidden = !can;
    const on = can && this.asked;
    this.el.hidden = !on;
    mark(this.toggle, "aria-pressed", String(on));
    if (!on) return null;
    const by = `${subject.key}|${base.arcs.length}|${base.cut.length}`;
    if (by !== this.by) {
      this.by = by;
      this.parts = partsOf(subject, base);
      this.at = Math.min(this.at, this.parts.length);
      this.slider.max = String(this.parts.length);
    }
    const built = builtUp(this.parts, this.at);
    this.slider.value = String(this.at);
    mark(this.slider, "aria-valuetext", `${this.at} of ${this.parts.length}`);
    setText(this.count, `${this.at} / ${this.parts.length}`);
    setText(this.text, tell(subject, base, built.now));
    return built;
  }

  /** What tells one state from another. */
  get stamp(): string {
    return this.el.hidden ? "" : String(this.at);
  }

  private go(at: number): void {
    this.at = Math.max(1, Math.min(this.parts.length, at));
    this.changed();
  }
}
