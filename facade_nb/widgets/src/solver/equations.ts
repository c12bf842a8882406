// “What does this pair's equation say?”: the equation among others that are nearly it, each with the slip that leads to it.

import type { Truth } from "../shared/quiz.ts";

const MOST = 4;
const NUMBER = /^(\d+(?:\.\d+)?)?(.*)$/u;

interface Part {
  sign: 1 | -1;
  body: string;
}

interface Sides {
  left: Part[];
  right: Part[];
}

export interface Offer extends Truth {
  text: string;
}

/** The choices for an equation; `others`: those of other pairs, with their numbers. Nothing is offered that says the same. */
export function offers(text: string, others: readonly { number: number; text: string }[]): Offer[] {
  const own = sidesOf(text);
  const found: Offer[] = [{ text, right: true, why: "What is left of both lines is equally long." }];
  const offer = (other: string, why: string) => {
    if (found.length < MOST && !found.some((known) => same(known.text, other)))
      found.push({ text: other, right: false, why });
  };
  const last = own.right.length > 1 || own.left.length < 2 ? "right" : "left";
  const parts = own[last];
  const [slip, rest] = [parts.at(-1), parts.slice(0, -1)];
  if (slip && slip.body !== "0") {
    offer(
      spell({ ...own, [last]: [...rest, { ...slip, sign: slip.sign > 0 ? -1 : 1 }] }),
      `${slip.body} has the wrong sign: look on which line more is left.`,
    );
    offer(spell({ ...own, [last]: rest }), `${slip.body} is missing: every letter that is left counts, with its size.`);
  }
  const [a, b] = [own.left[0], own.right[0]];
  if (a && b && a.body !== b.body && a.sign > 0 && b.sign > 0)
    offer(
      spell({ left: [b, ...own.left.slice(1)], right: [a, ...own.right.slice(1)] }),
      `${a.body} and ${b.body} have changed sides.`,
    );
  for (const each of others) offer(each.text, `That is what pair (${each.number + 1}) says.`);
  return found.sort((x, y) => x.text.localeCompare(y.text, "en", { numeric: true }));
}

function sidesOf(text: string): Sides {
  const [left = "", right = ""] = text.split(" = ");
  return { left: partsOf(left), right: partsOf(right) };
}

function partsOf(side: string): Part[] {
  const pieces = side.trim().split(/\s+([+−])\s+/u);
  return pieces.flatMap((piece, n): Part[] => {
    if (n % 2) return [];
    const minus = piece.startsWith("−");
    return [{ sign: minus !== (pieces[n - 1] === "−") ? -1 : 1, body: minus ? piece.slice(1) : piece }];
  });
}

function spell({ left, right }: Sides): string {
  const side = (parts: readonly Part[]) =>
    parts
      .map(({ sign, body }, n) => (n ? ` ${sign > 0 ? "+" : "−"} ${body}` : `${sign > 0 ? "" : "−"}${body}`))
      .join("") || "0";
  return `${side(left)} = ${side(right)}`;
}

/** What an equation comes to: right side minus left, by variable ("" for the number). */
function weights(text: string): Map<string, number> {
  const { left, right } = sidesOf(text);
  const sum = new Map<string, number>();
  for (const [parts, factor] of [
    [left, -1],
    [right, 1],
  ] as const)
    for (const { sign, body } of parts) {
      const [, digits, name = ""] = NUMBER.exec(body) ?? [];
      sum.set(name, (sum.get(name) ?? 0) + factor * sign * Number(digits ?? 1));
    }
  for (const [name, value] of sum) if (Math.abs(value) < 1e-9) sum.delete(name);
  return sum;
}

/** Whether two equations say the same: they are multiples of each other. */
export function same(one: string, other: string): boolean {
  const [a, b] = [weights(one), weights(other)];
  if (a.size !== b.size) return false;
  const [name] = a.keys();
  if (name === undefined) return true;
  const factor = (b.get(name) ?? 0) / (a.get(name) ?? 1);
  return [...a].every(([key, value]) => Math.abs(value * factor - (b.get(key) ?? 0)) < 1e-9 * Math.abs(factor || 1));
}
