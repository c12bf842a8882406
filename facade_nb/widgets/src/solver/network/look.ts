// Colours and fonts of the Network view's drawing.

/** Colours and fonts, as the page's theme has them. */
export interface Look {
  ink: string;
  muted: string;
  paper: string;
  step: string;
  arc: string;
  path: string;
  error: string;
  good: string;
  bad: string;
  lit: string;
  region: string;
  mono: string;
  onHue: string;
  hue(symbol: string): string;
}

/** The look that a page's style gives an element; `symbols` are the numbers of their colours. */
export function lookOf(el: Element, symbols: Record<string, number>): Look {
  const style = getComputedStyle(el);
  const value = (name: string, other: string) => style.getPropertyValue(name).trim() || other;
  const hues = Array.from({ length: 10 }, (_, n) => value(`--fnb-hue-${n}`, "#ccc"));
  return {
    ink: value("--fnb-text", "#222"),
    muted: value("--fnb-muted", "#777"),
    paper: value("--fnb-paper", "#fff"),
    step: value("--fnb-net-step", "#e08a1e"),
    arc: value("--fnb-net-arc", "#2f6fb2"),
    path: value("--fnb-net-path", "#d32f2f"),
    error: value("--fnb-muted", "#777"),
    good: value("--fnb-good", "#388e3c"),
    bad: value("--fnb-error", "#d32f2f"),
    lit: value("--fnb-lit", "#f2a900"),
    region: value("--fnb-net-region", "rgb(224 138 30 / 22%)"),
    mono: value("--fnb-mono", "monospace"),
    onHue: value("--fnb-on-hue", "#222"),
    hue: (symbol) => hues[(symbols[symbol] ?? 0) % 10] ?? "#ccc",
  };
}
