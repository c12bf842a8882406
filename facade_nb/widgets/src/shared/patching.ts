// A drawing on the page that follows its text: what the text has as before keeps its elements, and of the rest only the
// attributes that differ are set. The text is one piece a line: a whole element, or a tag that opens or closes one around
// others (`elevation_pieces` in Python).

interface Piece {
  line: string;
  /** What it is known by among its neighbours; of two texts, pieces with one key are the same thing. */
  key: string;
  /** The pieces in it; null: it is one line. */
  inner: Piece[] | null;
}

interface Drawn extends Piece {
  el: Element;
  /** The line at its quotation marks; found when it is first asked for. */
  parts: string[] | null;
  /** Whose attribute each value in the line is, and its name; found when they are first asked for. */
  values: [Element, string][] | null;
  inner: Drawn[] | null;
}

const ENTITIES: Record<string, string> = { amp: "&", lt: "<", gt: ">", quot: '"', "#x27": "'", "#10": "\n" };
const SVG = "http://www.w3.org/2000/svg";

export class Sheet {
  private readonly root: Drawn | null;
  /** Line by line, what it is of; a closing tag is of nothing. */
  private lines: (Drawn | string)[];

  /** `svg` is what the text was parsed to. */
  constructor(text: string, svg: Element) {
    const piece = outline(text);
    this.root = piece && drawn(piece, svg);
    this.lines = this.root ? listed(this.root) : [];
  }

  /** Show another text; false: the drawing has to be made anew. */
  follow(text: string): boolean {
    if (!this.root) return false;
    if (this.keepsPlaces(text)) return true;
    const next = outline(text);
    if (next === null || !amend(this.root, next)) return false;
    this.lines = listed(this.root);
    return true;
  }

  /** Most edits move things and leave them as many: then each line goes on as it was, and nothing has to be looked up. */
  private keepsPlaces(text: string): boolean {
    const next = text.split("\n");
    if (next.length !== this.lines.length) return false;
    const differ: [Drawn, string][] = [];
    for (const [n, own] of this.lines.entries()) {
      const line = next[n] as string;
      if (typeof own === "string") {
        if (own !== line) return false;
      } else if (own.line !== line) {
        if (keyOf(own.line) !== keyOf(line)) return false;
        differ.push([own, line]);
      }
    }
    return differ.every(([own, line]) => setValues(own, line));
  }
}

function listed(own: Drawn): (Drawn | string)[] {
  if (!own.inner) return [own];
  return [own, ...own.inner.flatMap(listed), `</${/^<(\w+)/.exec(own.line)?.[1]}>`];
}

/** The pieces of a text; null: it is not in pieces. */
function outline(text: string): Piece | null {
  const open: Piece[] = [];
  let root: Piece | null = null;
  for (const line of text.split("\n")) {
    if (line.startsWith("</")) {
      const closed = open.pop();
      if (!closed) return null;
      named(closed.inner ?? []);
      if (open.length === 0) root = closed;
      continue;
    }
    const opens = !line.endsWith("/>") && line.indexOf("<", 1) < 0;
    const piece: Piece = { line, key: keyOf(line), inner: opens ? [] : null };
    if (open.length > 0) open.at(-1)?.inner?.push(piece);
    else if (root || !opens) return null;
    if (opens) open.push(piece);
  }
  return open.length === 0 ? root : null;
}

/** A shape is known by its layer, symbols and instances, a definition by its id, all else by its tag and class. */
function keyOf(line: string): string {
  const end = line.indexOf(">");
  const cell = line.indexOf(" data-layer=");
  if (cell > 0 && cell < end) return line.slice(cell, end);
  return /^<\w+ (?:id|class)="[^"]*"/.exec(line)?.[0] ?? /^<\w+/.exec(line)?.[0] ?? "";
}

/** A group around others is known by the layer of what is in it; of equal neighbours the second has another key. */
function named(pieces: Piece[]): void {
  const seen = new Map<string, number>();
  for (const piece of pieces) {
    const layer = piece.inner?.[0]?.key.match(/data-layer="[^"]*"/)?.[0];
    if (layer) piece.key += layer;
    const n = seen.get(piece.key) ?? 0;
    seen.set(piece.key, n + 1);
    if (n > 0) piece.key += ` ${n}`;
  }
}

/** Pieces with the elements that they were parsed to; null: they do not go together. */
function drawn(piece: Piece, el: Element): Drawn | null {
  const inner: Drawn[] = [];
  if (piece.inner && piece.inner.length !== el.childElementCount) return null;
  for (const [n, own] of (piece.inner ?? []).entries()) {
    const child = el.children[n];
    const made = child ? drawn(own, child) : null;
    if (!made) return null;
    inner.push(made);
  }
  return { ...piece, el, parts: null, values: null, inner: piece.inner && inner };
}

/** Change what is drawn into another piece; false: it cannot be, and nothing of this piece was changed. */
function amend(own: Drawn, next: Piece): boolean {
  if ((own.inner === null) !== (next.inner === null) || !setValues(own, next.line)) return false;
  if (!own.inner || !next.inner) return true;
  const before = new Map(own.inner.map((piece) => [piece.key, piece]));
  const after: (Drawn | Piece)[] = next.inner.map((piece) => {
    const same = before.get(piece.key);
    if (!same || !amend(same, piece)) return piece;
    before.delete(piece.key);
    return same;
  });
  for (const gone of before.values()) gone.el.remove();
  const fresh = made(after.filter((piece): piece is Piece => !("el" in piece)));
  const inner = after.map((piece) => ("el" in piece ? piece : (fresh.shift() as Drawn)));
  let behind: Element | null = null;
  for (const { el } of inner.toReversed()) {
    if (el.parentNode !== own.el || el.nextElementSibling !== behind) own.el.insertBefore(el, behind);
    behind = el;
  }
  own.inner = inner;
  return true;
}

/** New pieces, parsed together. */
function made(pieces: Piece[]): Drawn[] {
  if (pieces.length === 0) return [];
  const text = `<svg xmlns="${SVG}">${pieces.map(textOf).join("")}</svg>`;
  const parsed = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  const children = [...document.importNode(parsed, true).children];
  return pieces.map((piece, n) => {
    const own = children[n] && drawn(piece, children[n]);
    if (!own) throw new Error("facade_nb: the elevation is not readable SVG");
    return own;
  });
}

function textOf(piece: Piece): string {
  if (!piece.inner) return piece.line;
  const tag = /^<(\w+)/.exec(piece.line)?.[1];
  return `${piece.line}${piece.inner.map(textOf).join("")}</${tag}>`;
}

/** Set the attributes that another line has otherwise; false: the lines differ in more than values. */
function setValues(own: Drawn, line: string): boolean {
  if (own.line === line) return true;
  // In an attribute or a text a quotation mark is written as an entity, so that what is between two of them is a value.
  own.parts ??= own.line.split('"');
  const [was, is] = [own.parts, line.split('"')];
  if (was.length !== is.length) return false;
  for (let n = 0; n < is.length; n += 2) if (was[n] !== is[n]) return false;
  own.values ??= valuesOf(own, is);
  for (let n = 1; n < is.length; n += 2) {
    const value = is[n] as string;
    if (value === was[n]) continue;
    const [el, name] = own.values[n >> 1] as [Element, string];
    el.setAttribute(name, decoded(value));
  }
  own.line = line;
  own.parts = is;
  return true;
}

function valuesOf(own: Drawn, parts: string[]): [Element, string][] {
  const all = own.inner ? [own.el] : [own.el, ...own.el.querySelectorAll("*")];
  const found: [Element, string][] = [];
  let at = -1;
  for (let n = 0; n + 1 < parts.length; n += 2) {
    const text = parts[n] as string;
    for (let tag = text.indexOf("<"); tag >= 0; tag = text.indexOf("<", tag + 1)) if (text[tag + 1] !== "/") at += 1;
    found.push([all[at] as Element, text.slice(text.lastIndexOf(" ") + 1, -1)]);
  }
  return found;
}

function decoded(value: string): string {
  return value.includes("&") ? value.replace(/&([#\w]+);/g, (whole, name) => ENTITIES[name] ?? whole) : value;
}
