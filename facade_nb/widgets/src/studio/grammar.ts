// A pattern's text in pieces, for colouring and completing it as it is typed. Whether it can be read, Python says: here what
// cannot be read has a kind, too. The pieces are those of facade_nb/design/grammar.py.

import { isShort } from "../solver/letters.ts";

export type Kind =
  | "symbol" // a letter
  | "empty" // ε
  | "counter" // after ^
  | "number"
  | "operator" // ^ | . and the mode
  | "mirror"
  | "bracket"
  | "assign" // :=
  | "end" // ; or a new line
  | "comment"
  | "blank"
  | "other";

export interface Piece {
  kind: Kind;
  start: number;
  end: number;
  /** Of a symbol or a counter: its name without brackets or braces. */
  name: string;
}

const MODES = "~|.:@·∘⊙";
const WORD = /[\p{L}]\p{M}*\p{Nd}*/uy;
const LONG = /<[^<>\r\n]*>?/y;
const BRACED = /\{[^{}\r\n]*\}?/y;
const NUMBER = /\p{Nd}+/uy;
const BLANK = /[^\S\r\n]+/y;
const COMMENT = /#[^\r\n]*/y;

type Found = [kind: Kind, length: number, name?: string];

/** The pieces of a text, without gaps, in order. */
export function piecesOf(text: string): Piece[] {
  const pieces: Piece[] = [];
  /** Whether a count is being written: after ^ its mode, a sign and its value may follow. */
  let counting = false;
  for (let at = 0; at < text.length; ) {
    const blank = blankAt(text, at);
    const counted = blank || !counting ? null : countAt(text, at);
    if (!blank && !counted) counting = false;
    const [kind, length, name = ""] = blank ?? counted ?? pieceAt(text, at);
    if (kind === "number" || kind === "counter") counting = false;
    if (!counted && kind === "operator" && text[at] === "^") counting = true;
    pieces.push({ kind, start: at, end: at + length, name });
    at += length;
  }
  return pieces;
}

function match(rule: RegExp, text: string, at: number): string {
  rule.lastIndex = at;
  return rule.exec(text)?.[0] ?? "";
}

function blankAt(text: string, at: number): Found | null {
  const blank = match(BLANK, text, at);
  if (blank) return ["blank", blank.length];
  const comment = match(COMMENT, text, at);
  return comment ? ["comment", comment.length] : null;
}

/** What stands after ^: a mode, a sign, and the value. */
function countAt(text: string, at: number): Found | null {
  const sign = text[at] as string;
  if (MODES.includes(sign) && !text.startsWith(":=", at)) return ["operator", 1];
  if (sign === "-" || sign === "−") return ["operator", 1];
  const number = match(NUMBER, text, at);
  if (number) return ["number", number.length];
  const braced = match(BRACED, text, at);
  if (braced) {
    const name = tidy(braced.replace(/^\{|\}$/g, "")).replace(/^[-−]\s*/, "");
    return [/^\p{Nd}+$/u.test(name) ? "number" : "counter", braced.length, name];
  }
  const word = match(WORD, text, at);
  return word ? ["counter", word.length, tidy(word)] : null;
}

const SIGNS: Record<string, Kind> = {
  "^": "operator",
  "|": "operator",
  ".": "operator",
  "·": "operator",
  "'": "mirror",
  "’": "mirror",
  "′": "mirror",
  "(": "bracket",
  ")": "bracket",
  ";": "end",
  "\n": "end",
  "\r": "end",
};

function pieceAt(text: string, at: number): Found {
  const sign = String.fromCodePoint(text.codePointAt(at) ?? 0);
  if (sign === "ε" && !/^ε[\p{M}\p{Nd}]/u.test(text.slice(at, at + 3))) return ["empty", 1];
  const long = match(LONG, text, at);
  if (long) return ["symbol", long.length, tidy(long.replace(/^<|>$/g, ""))];
  const word = match(WORD, text, at);
  if (word) return [isShort(tidy(word)) ? "symbol" : "other", word.length, tidy(word)];
  if (text.startsWith(":=", at)) return ["assign", 2];
  return [SIGNS[sign] ?? "other", sign.length];
}

function tidy(name: string): string {
  return name.trim().split(/\s+/).join(" ").normalize("NFC");
}

/** The bracket that belongs to each, by where they stand; those without a partner are missing. */
export function partners(pieces: readonly Piece[], text: string): Map<number, number> {
  const open: number[] = [];
  const found = new Map<number, number>();
  for (const { kind, start } of pieces) {
    if (kind === "end") open.length = 0;
    if (kind !== "bracket") continue;
    if (text[start] === "(") open.push(start);
    else {
      const from = open.pop();
      if (from === undefined) continue;
      found.set(from, start);
      found.set(start, from);
    }
  }
  return found;
}

/** How a symbol is written in a pattern, as `spell` in facade_nb/design/text.py has it. */
export function spell(symbol: string): string {
  return isShort(symbol) ? symbol : `<${symbol}>`;
}

/** How a counter is written after ^. */
export function spellCounter(counter: string): string {
  return isShort(counter) ? counter : `{${counter}}`;
}
