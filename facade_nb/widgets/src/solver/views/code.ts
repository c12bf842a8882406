// Code: the function that is played, beside the other views.

import { type CodeData, CodePanel } from "../codepanel.ts";
import type { View, ViewContext, ViewKind } from "../view.ts";

export const code: ViewKind = {
  title: "Code by line",
  subtitle: "The function that is played, its line, and its variables",
  needs: ["code"],
  make: (context) => new CodeView(context),
};

class CodeView implements View {
  readonly el: HTMLElement;
  private readonly panel = new CodePanel();

  constructor(private readonly context: ViewContext) {
    this.panel.load(context.pieces.code as CodeData);
    this.el = this.panel.el;
  }

  show(position: number): void {
    // While a view asks, the variables are not told: they would be the answer.
    this.el.hidden = this.context.asking.on;
    if (!this.el.hidden) this.panel.show(position);
  }
}
