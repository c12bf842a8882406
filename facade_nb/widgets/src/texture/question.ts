// What can be asked of a pixel before its steps are shown: into which part of a split it falls.

import type { Step } from "./types.ts";

/** A split on the way of a pixel, and the rules that its parts go on with. */
export interface Split {
  /** Number of the step. */
  step: number;
  /** The rule as it is written. */
  rule: string;
  options: string[];
  right: string;
  /** Where the pixel is in the scope that is split, and how large that is, metres. */
  at: number;
  size: number;
  across: boolean;
}

const NAME = /[\p{L}_][\p{L}\p{M}\p{Nd}_]*/gu;
const KINDS = new Set(["Rel", "Abs"]);
const NEAR = 0.02; // metres from the border of a part: what is read off is not as exact

/** The splits that a pixel has gone through, where there is something to choose. */
export function splitsOf(text: string, steps: readonly Step[]): Split[] {
  return steps.flatMap((own, step): Split[] => {
    const next = steps[step + 1];
    if (!/^Split[XY]$/.test(own.operator) || !next) return [];
    const rule = ruleOf(text, own.rule);
    const list = /\((.*)\)/su.exec(rule)?.[1] ?? "";
    const options = [...new Set(list.match(NAME) ?? [])].filter((name) => !KINDS.has(name));
    const across = own.operator === "SplitX";
    const [at, size] = alongOf(own, across);
    const [low, high] = [own.text, own.text].map((said, n) =>
      Number(/from ([\d.]+) to ([\d.]+) m/.exec(said)?.[n + 1]),
    );
    if (options.length < 2 || !options.includes(next.rule) || low === undefined || high === undefined) return [];
    const start = across ? own.scope[0] : own.scope[1];
    const inside = [low, high].every((border) => Math.abs(border - start - at) > NEAR);
    return inside ? [{ step, rule, options, right: next.rule, at, size, across }] : [];
  });
}

/** A rule as it is written, on one line. */
function ruleOf(text: string, name: string): string {
  const lines = text.split("\n");
  const first = lines.findIndex((line) => line.match(/^\s*([^\s-]+)\s*->/)?.[1] === name);
  if (first < 0) return "";
  const rest = lines.slice(first + 1);
  const end = rest.findIndex((line) => line.includes("->"));
  return [lines[first] ?? "", ...rest.slice(0, end < 0 ? undefined : end)].join(" ").replace(/\s+/g, " ").trim();
}

/** How far along a scope the pixel is, and how long that is. */
function alongOf({ corners, spot }: Step, across: boolean): [at: number, size: number] {
  const [origin, right, , top] = corners;
  const end = across ? right : top;
  if (!origin || !end) return [0, 0];
  const side = end.map((value, n) => value - (origin[n] ?? 0));
  const size = Math.hypot(...side);
  const dot = side.reduce((sum, value, n) => sum + value * ((spot[n] ?? 0) - (origin[n] ?? 0)), 0);
  return [dot / size, size];
}
