// The style sheet, once per page; and the page's theme, which the elevation is drawn for.

import { mark } from "./dom.ts";

const sheets = new Map<string, CSSStyleSheet>();

export function adoptStyle(css: string): void {
  if (sheets.has(css)) return;
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(css);
  sheets.set(css, sheet);
  document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];
}

export type Theme = "light" | "dark";

/** The theme around an element: what JupyterLab says, else what the background looks like. */
export function themeOf(element: Element): Theme {
  const said = element.closest("[data-jp-theme-light]")?.getAttribute("data-jp-theme-light");
  if (said) return said === "false" ? "dark" : "light";
  for (let at: Element | null = element; at; at = at.parentElement) {
    const [r = 0, g = 0, b = 0, a = 1] = (
      getComputedStyle(at).backgroundColor.match(/[\d.]+/g) ?? ["0", "0", "0", "0"]
    ).map(Number);
    if (a > 0.5) return 0.3 * r + 0.59 * g + 0.11 * b < 128 ? "dark" : "light";
  }
  return "light";
}

/** Mark the root with the theme, now and when it changes, and say which it is. */
export function watchTheme(root: HTMLElement, signal: AbortSignal, tell: (theme: Theme) => void): void {
  const look = () => {
    const theme = themeOf(root);
    mark(root, "data-theme", theme);
    tell(theme);
  };
  const observer = new MutationObserver(look);
  observer.observe(document.body, { attributes: true, attributeFilter: ["data-jp-theme-light", "class"] });
  signal.addEventListener("abort", () => observer.disconnect());
  // Only when it stands in the page does it have a background to judge.
  requestAnimationFrame(look);
}
