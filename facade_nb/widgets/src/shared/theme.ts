// The style sheet, once in each document or shadow tree that has views; and the theme around them, which the elevation is
// drawn for.

import { mark } from "./dom.ts";

type Root = Document | ShadowRoot;

/** What ends the rules that all bundles have, at the end of fields.css. */
const OWN = "@layer fnb-own;";

const sheets = new Map<string, CSSStyleSheet>();
/** How many views hold a sheet, by where they stand. */
const holders = new WeakMap<Root, Map<CSSStyleSheet, number>>();

function sheetOf(css: string): CSSStyleSheet {
  let sheet = sheets.get(css);
  if (!sheet) {
    sheet = new CSSStyleSheet();
    sheet.replaceSync(css);
    sheets.set(css, sheet);
  }
  return sheet;
}

/**
 * A bundle's sheets. What is common goes before all else: a bundle that comes later must not undo what another one adds. Its
 * own rules are those of its own elements alone: two bundles may have one name for two things.
 */
function sheetsOf(css: string): { common: CSSStyleSheet | null; own: CSSStyleSheet; name: string } {
  const [common, own] = css.split(OWN);
  if (own === undefined) return { common: null, own: sheetOf(css), name: "" };
  const name = nameOf(own);
  const scoped = "CSSScopeRule" in globalThis ? `@scope ([data-fnb-sheet="${name}"]) {${own}}` : own;
  return { common: sheetOf(common ?? ""), own: sheetOf(scoped), name };
}

const names = new Map<string, string>();

/** A short name for a text: the same one wherever it is made, as each bundle has a copy of this module. */
function nameOf(text: string): string {
  let name = names.get(text);
  if (name === undefined) {
    let sum = text.length;
    for (let at = 0; at < text.length; at++) sum = (Math.imul(sum, 31) + text.charCodeAt(at)) | 0;
    name = (sum >>> 0).toString(36);
    names.set(text, name);
  }
  return name;
}

function count(root: Root, sheet: CSSStyleSheet, by: 1 | -1, first: boolean): void {
  const counts = holders.get(root) ?? new Map<CSSStyleSheet, number>();
  holders.set(root, counts);
  const now = (counts.get(sheet) ?? 0) + by;
  counts.set(sheet, now);
  const others = root.adoptedStyleSheets.filter((other) => other !== sheet);
  if (now > 0 !== others.length < root.adoptedStyleSheets.length)
    root.adoptedStyleSheets = now <= 0 ? others : first ? [sheet, ...others] : [...others, sheet];
}

/** Have the sheet wherever the element stands, until the signal ends. Some hosts attach it only later, or in a shadow tree. */
export function adoptStyle(css: string, el: HTMLElement, signal: AbortSignal): void {
  const { common, own, name } = sheetsOf(css);
  if (name) mark(el, "data-fnb-sheet", name);
  let at: Root | null = null;
  const tell = (root: Root, by: 1 | -1) => {
    if (common) count(root, common, by, true);
    count(root, own, by, false);
  };
  const move = (to: Root | null) => {
    if (to === at) return;
    if (to) tell(to, 1);
    if (at) tell(at, -1);
    at = to;
  };
  const settle = () => {
    if (signal.aborted) return;
    const root = el.getRootNode();
    move(root instanceof ShadowRoot ? root : document);
  };
  settle();
  // An element that is attached, or moved to another tree, gets a size there.
  const observer = new ResizeObserver(settle);
  observer.observe(el);
  signal.addEventListener("abort", () => {
    observer.disconnect();
    move(null);
  });
}

export type Theme = "light" | "dark";

/** The element around another one, that of a shadow tree around what stands in it. */
function around(element: Element): Element | null {
  const root = element.getRootNode();
  return element.parentElement ?? (root instanceof ShadowRoot ? root.host : null);
}

/** The theme around an element: what JupyterLab says, else what the background looks like. */
export function themeOf(element: Element): Theme {
  for (let at: Element | null = element; at; at = around(at)) {
    const said = at.getAttribute("data-jp-theme-light");
    if (said) return said === "false" ? "dark" : "light";
  }
  for (let at: Element | null = around(element); at; at = around(at)) {
    const [r = 0, g = 0, b = 0, a = 1] = rgba(getComputedStyle(at).backgroundColor);
    if (a > 0.5) return 0.3 * r + 0.59 * g + 0.11 * b < 128 ? "dark" : "light";
  }
  return "light";
}

/** A colour as the browser paints it: it may be told in any colour space. */
function rgba(colour: string): number[] {
  const told = /^rgba?\(([^)]*)\)$/.exec(colour)?.[1];
  if (told) return (told.match(/[\d.]+/g) ?? []).map(Number);
  const paper = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  if (!paper) return [255, 255, 255, 0];
  paper.fillStyle = colour;
  paper.fillRect(0, 0, 1, 1);
  const [r = 0, g = 0, b = 0, a = 0] = paper.getImageData(0, 0, 1, 1).data;
  return [r, g, b, a / 255];
}

/** Call back when the page may have changed its theme, until the signal ends. */
export function watchDress(changed: () => void, signal: AbortSignal): void {
  const observer = new MutationObserver(changed);
  const options = { attributes: true, attributeFilter: ["data-jp-theme-light", "data-theme", "class"] };
  for (const element of [document.documentElement, document.body]) observer.observe(element, options);
  signal.addEventListener("abort", () => observer.disconnect());
}

/** Mark the root with the theme, now and when it changes, and say which it is. */
export function watchTheme(root: HTMLElement, signal: AbortSignal, tell: (theme: Theme) => void): void {
  const look = () => {
    const theme = themeOf(root);
    mark(root, "data-theme", theme);
    tell(theme);
  };
  watchDress(look, signal);
  // Only when it stands in the page does it have a background to judge.
  requestAnimationFrame(look);
}
