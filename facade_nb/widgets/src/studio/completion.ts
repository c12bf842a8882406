// What may come next in a pattern's text: a list under the caret. Tab asks for it, as in JupyterLab, and Ctrl+Space; it comes
// by itself after ^, { and <.

import { piecesOf, spell, spellCounter } from "./grammar.ts";

export interface Known {
  symbols: readonly { name: string; size: number | null }[];
  counters: readonly { name: string; told: string }[];
  modes: readonly { sign: string; name: string }[];
  patterns: readonly { name: string; text: string }[];
}

export interface Item {
  /** What is written in place of what stands from `from` to `to`. */
  text: string;
  label: string;
  /** What it is, in words. */
  means: string;
  kind: "symbol" | "counter" | "mode" | "pattern" | "sign";
  /** The symbol whose colour it has. */
  symbol?: string;
}

export interface Completion {
  from: number;
  to: number;
  items: Item[];
}

const OWN: Completion = { from: 0, to: 0, items: [] };

/** What may be written at the caret of a text. */
export function completionsAt(text: string, caret: number, known: Known): Completion {
  const before = text.slice(0, caret);
  const pieces = piecesOf(before);
  const last = pieces.at(-1);
  if (last?.kind === "comment") return OWN;
  const inBraces = /\{[^{}\r\n]*$/.exec(before);
  if (inBraces && /\^[~|.:@·∘⊙]?[-−]?$/.test(before.slice(0, inBraces.index)))
    return counters(inBraces.index, caret, inBraces[0].slice(1), known);
  const inAngles = /<[^<>\r\n]*$/.exec(before);
  if (inAngles) {
    const typed = inAngles[0].slice(1).toLowerCase();
    const items = known.symbols
      .filter(({ name }) => name.toLowerCase().startsWith(typed))
      .map((symbol) => symbolItem(symbol, `<${symbol.name}>`));
    return { from: inAngles.index, to: closing(text, caret, ">"), items };
  }
  const count = /\^([~|.:@·∘⊙]?)([-−]?)(\p{L}\p{M}*\p{Nd}*)?$/u.exec(before);
  if (count) {
    const [, mode = "", minus = "", typed = ""] = count;
    const found = counters(caret - typed.length, caret, typed, known);
    if (mode || minus || typed) return found;
    const modes = known.modes.flatMap(({ sign, name }): Item[] =>
      sign ? [{ text: sign, label: sign, means: `reflection: ${name}`, kind: "mode" }] : [],
    );
    const minusItem: Item = { text: "-", label: "-", means: "mirrored copies", kind: "sign" };
    return { ...found, items: [...found.items, ...modes, minusItem] };
  }
  return operands(text, caret, known);
}

function counters(from: number, to: number, typed: string, known: Known): Completion {
  const lower = typed.toLowerCase();
  const items = known.counters
    .filter(({ name }) => name.toLowerCase().startsWith(lower))
    .map(({ name, told }): Item => ({ text: spellCounter(name), label: name, means: told, kind: "counter" }));
  return { from, to, items };
}

/** Where a symbol, a group, or what comes after one may stand. */
function operands(text: string, caret: number, known: Known): Completion {
  const before = text.slice(0, caret);
  const pieces = piecesOf(before);
  const last = pieces.at(-1);
  const word = last?.kind === "symbol" ? last : undefined;
  const typed = word?.name.toLowerCase() ?? "";
  const from = word?.start ?? caret;
  // The statement that the caret stands in: the control pattern, or a substitution.
  const since = pieces.findLastIndex(({ kind }) => kind === "end");
  const own = pieces.slice(since + 1).filter(({ kind }) => kind !== "blank");
  const items: Item[] = [];
  if (since >= 0 && own.length === 1 && word && known.symbols.some(({ name }) => name === word.name)) {
    items.push({ text: `${spell(word.name)} := `, label: ":=", means: "what stands for it", kind: "sign" });
  }
  if (since >= 0 && own.length <= (word ? 1 : 0)) {
    const control = pieces.slice(
      0,
      pieces.findIndex(({ kind }) => kind === "end"),
    );
    const placed = [...new Set(control.flatMap(({ kind, name }) => (kind === "symbol" ? [name] : [])))];
    const done = new Set(substituted(before.slice(0, from)));
    for (const name of placed)
      if (!done.has(name) && name.toLowerCase().startsWith(typed) && name !== word?.name)
        items.push({
          text: `${spell(name)} := `,
          label: `${spell(name)} :=`,
          means: "what stands for it",
          kind: "symbol",
          symbol: name,
        });
    return { from, to: caret, items };
  }
  items.push(
    ...known.symbols
      .filter(({ name }) => name.toLowerCase().startsWith(typed) && name !== word?.name)
      .map((symbol) => symbolItem(symbol, spell(symbol.name))),
  );
  items.push(
    ...known.patterns
      .filter(({ name, text }) => name.toLowerCase().startsWith(typed) && !/[;\n]|:=/.test(text) && text !== "ε")
      .map(
        ({ name, text }): Item => ({
          text: `(${text})`,
          label: name,
          means: `pattern: ${text}`,
          kind: "pattern",
        }),
      ),
  );
  if (!word) items.push({ text: "ε", label: "ε", means: "nothing, the empty word", kind: "sign" });
  if (!word && own.length > 0 && last?.kind !== "operator")
    for (const [sign, means] of SIGNS) items.push({ text: sign, label: sign, means, kind: "sign" });
  return { from, to: caret, items };
}

const SIGNS = [
  ["^", "so many copies"],
  ["'", "mirrored"],
  ["|", "or"],
] as const;

/** The symbols that are substituted in a text. */
function substituted(text: string): string[] {
  const pieces = piecesOf(text).filter(({ kind }) => kind !== "blank");
  return pieces.flatMap(({ kind }, n) => (kind === "assign" && n > 0 ? [pieces[n - 1]?.name ?? ""] : []));
}

function symbolItem({ name, size }: Known["symbols"][number], text: string): Item {
  const means = size === null ? "symbol, as large as it must be" : `symbol, ${Number(size.toFixed(3))} m`;
  return { text, label: name, means, kind: "symbol", symbol: name };
}

/** Up to where a name that is being written is replaced: its closing sign with it, if that stands there. */
function closing(text: string, caret: number, sign: string): number {
  return text[caret] === sign ? caret + 1 : caret;
}

/** Whether the list comes by itself after what was typed. */
export function comesByItself(typed: string | null): boolean {
  return typed === "^" || typed === "{" || typed === "<";
}
