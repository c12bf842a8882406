// The code of what is played: the function, its current line, and the values of its variables (widgets/solver/code.py).

import { h, mark, setText } from "../shared/dom.ts";

export interface CodeData {
  names: string[];
  /** Of each event: its function, the line in it (0: the whole), and what its variables are. */
  function: Int16Array;
  line: Int16Array;
  value: Int32Array;
  values: string[];
  functions: Record<string, { file: string; line: number; tokens: [string, string][] }>;
}

export class CodePanel {
  private readonly title = h("p", { class: "fnb-code-title" });
  private readonly text = h("pre", { class: "fnb-code-text", tabindex: 0, "aria-label": "Code of what is played" });
  private readonly values = h("dl", { class: "fnb-code-values", "aria-label": "Values of its variables" });
  readonly el = h("div", { class: "fnb-code-panel" }, this.title, this.values, this.text);
  private data: CodeData | null = null;
  private shown = "";
  private lines: HTMLElement[] = [];

  say(text: string): void {
    setText(this.title, text);
  }

  load(data: CodeData): void {
    this.data = data;
    this.shown = "";
  }

  get loaded(): boolean {
    return this.data !== null;
  }

  show(position: number): void {
    const { data } = this;
    if (!data) return;
    const name = data.names[data.function[position] ?? 0] ?? "";
    if (name !== this.shown) {
      this.shown = name;
      const found = data.functions[name];
      setText(this.title, found ? `${name}  ·  ${found.file}, line ${found.line}` : "");
      this.lines = linesOf(found?.tokens ?? []);
      this.text.replaceChildren(...this.lines);
      this.text.scrollTop = 0;
    }
    const now = (data.line[position] ?? 0) - 1;
    for (const [n, line] of this.lines.entries()) mark(line, "data-now", n === now);
    const line = this.lines[now];
    if (line) {
      const { offsetTop, offsetHeight } = line;
      const { scrollTop, clientHeight } = this.text;
      const top = offsetTop - this.text.offsetTop;
      if (top < scrollTop || top + offsetHeight > scrollTop + clientHeight)
        this.text.scrollTop = Math.max(0, top - clientHeight / 3);
    }
    const told = (data.values[data.value[position] ?? 0] ?? "").split("\n").filter(Boolean);
    this.values.replaceChildren(
      ...told.flatMap((pair) => {
        const at = pair.indexOf(" = ");
        return [h("div", {}, h("dt", {}, `${pair.slice(0, at)} = `), h("dd", {}, pair.slice(at + 3)))];
      }),
    );
  }
}

/** The tokens line by line. */
function linesOf(tokens: readonly [string, string][]): HTMLElement[] {
  const lines: HTMLElement[] = [];
  let line = h("span", { class: "fnb-code-line" });
  for (const [text, kind] of tokens)
    for (const [n, part] of text.split("\n").entries()) {
      if (n) {
        if (!line.childNodes.length) line.append(" "); // an empty line is as high as the others
        lines.push(line);
        line = h("span", { class: "fnb-code-line" });
      }
      if (part) line.append(kind ? h("span", { class: `fnb-code-${kind}` }, part) : part);
    }
  lines.push(line);
  return lines;
}
