// What can be asked of the sizing: which symbols grow, which equation a letter has, which constraint becomes active next.

import { formatNumber } from "../../shared/fields.ts";
import type { Truth } from "../../shared/quiz.ts";
import { type ActiveSetStep, type Constraint, isForce, type Moment, type Place, type System } from "./system.ts";

const WRONG = 4;
const FEW = 3; // constraints that become active in one step, at most, for the step to be asked for

/** Where a letter of a symbol stands once sizes are known, piece by piece. */
export type Ends = Map<string, [start: number, end: number][]>;

/** A letter of every symbol with a preferred size, as it stands in the end. */
export function endsOf(system: System, solved: Moment): Ends {
  const found: Ends = new Map();
  for (const row of system.constraints) {
    if (row.kind !== "=" || row.number < system.count || !row.symbol || found.has(row.symbol)) continue;
    const pieces = row.places.map((place): [number, number] => {
      const [s, t] = system.boundsOf(place);
      return [solved.values[s] ?? 0, solved.values[t] ?? 0];
    });
    if (pieces.length) found.set(row.symbol, pieces);
  }
  return found;
}

/** Whether words at preferred sizes say it all: every one is shorter than its canvas and all grow, or longer and all shrink. */
export function isPlain(system: System, truths: ReadonlyMap<string, Truth>): boolean {
  const { meaning, target } = system.posed;
  const likes = new Map(
    meaning.flatMap((own, v) => (own.kind === "size" ? [[own.symbol, target[v] ?? 0] as const] : [])),
  );
  const rights = new Set([...truths.values()].map(({ right }) => right));
  if (rights.size !== 1) return false;
  const grow = rights.has(true);
  return system.paths.every(({ bands, columns, canvas }) => {
    const widths = columns.map(({ letters }) =>
      letters.map((element, b) =>
        element.reduce((sum, n) => sum + (likes.get(bands[b]?.letters[n]?.symbol ?? "") ?? 0), 0),
      ),
    );
    const least = widths.reduce((sum, own) => sum + Math.min(...own.filter((size) => size > 0)), 0);
    const most = widths.reduce((sum, own) => sum + Math.max(...own), 0);
    return grow ? most < canvas : least > canvas;
  });
}

/** Which symbols end larger than they like? */
export function grown(system: System, solved: Moment): Map<string, Truth> {
  const { meaning, weight, target } = system.posed;
  const found = new Map<string, Truth>();
  for (const [v, own] of meaning.entries()) {
    if (own.kind !== "size" || !((weight[v] ?? 0) > 0)) continue;
    const [likes, is] = [target[v] ?? 0, solved.values[v] ?? 0];
    const off = is - likes;
    if (isForce(off) && Math.abs(off) < 0.0005) continue; // no figure shows it
    const said = isForce(off) ? `${formatNumber(Math.abs(off), 4)} m ${off > 0 ? "more" : "less"}` : "as it likes";
    found.set(own.symbol, {
      right: isForce(off) && off > 0,
      why: `|${own.symbol}| likes ${formatNumber(likes)} m and gets ${formatNumber(is, 4)} m: ${said}.`,
    });
  }
  return found;
}

/** A letter whose equation is asked for. */
export interface Lettered {
  place: Place;
  row: Constraint;
  truths: Map<string, Truth>;
}

/** A letter of every symbol in turn; those that are cut come soon, for theirs is the least obvious. */
export function letteredCases(system: System): Lettered[] {
  const rows = system.constraints.filter(
    (own) => own.kind === "=" && own.number >= system.count && own.symbol && own.places.length,
  );
  const bySymbol = new Map<string, Constraint[]>();
  for (const own of rows) bySymbol.set(own.symbol, [...(bySymbol.get(own.symbol) ?? []), own]);
  const isCut = (list: readonly Constraint[]) => list.some(({ places }) => places.length > 1);
  const [whole, cut] = [true, false].map((is) => [...bySymbol.values()].filter((list) => isCut(list) !== is));
  const lists = [...(whole ?? []).slice(0, 1), ...(cut ?? []), ...(whole ?? []).slice(1)];
  const most = Math.max(0, ...lists.map((list) => list.length));
  const turns = Array.from({ length: most }, (_, n) => lists.flatMap((list) => list.slice(n, n + 1))).flat();
  return turns.flatMap((row): Lettered[] => {
    const [place] = row.places;
    const truths = spelled(system, row, rows);
    return place && truths.size > 2 ? [{ place, row, truths }] : [];
  });
}

function spelled(system: System, row: Constraint, rows: readonly Constraint[]): Map<string, Truth> {
  const { symbol, text, places } = row;
  const found = new Map<string, Truth>([
    [text, { right: true, why: `It begins at s and ends at t; in between it is as long as every ${symbol}.` }],
  ]);
  const offer = (other: string, why: string) => {
    if (found.size <= WRONG && !found.has(other)) found.set(other, { right: false, why });
  };
  const ends = (value: string) => text.replace(`= |${symbol}|`, `= ${value}`);
  const [first] = places;
  if (first && places.length > 1) {
    const alone = text.replace(/[^ ]*\(.*\)/, `${system.ijk(first)}.t − ${system.ijk(first)}.s`);
    offer(alone, `${symbol} is cut: only its pieces together are as long as ${symbol}.`);
  }
  const size = system.posed.meaning.findIndex((own) => own.kind === "size" && own.symbol === symbol);
  if ((system.posed.weight[size] ?? 0) > 0) {
    const likes = formatNumber(system.posed.target[size]);
    offer(ends(likes), `${likes} m is what ${symbol} likes: that stands in the objective, and gives way.`);
  }
  const near = rows.filter((own) => own !== row && own.places[0]?.group === first?.group);
  const twin = near.find((own) => own.symbol === symbol);
  if (twin) offer(twin.text, `That is another ${symbol}, ${names(system, twin)}.`);
  const neighbour = near.find((own) => own.symbol !== symbol);
  if (neighbour) {
    offer(ends(`|${neighbour.symbol}|`), `The letter is ${symbol}, not ${neighbour.symbol}.`);
    offer(neighbour.text, `That is the letter ${neighbour.symbol}, ${names(system, neighbour)}.`);
  }
  return new Map([...found].sort(([a], [b]) => a.localeCompare(b, "en", { numeric: true })));
}

/** A text that has room for few pieces of a letter. */
export function abridged(text: string): string {
  const [sum = "", size = ""] = text.split(" = ");
  const parts = sum.split(" + ");
  return parts.length > 3 ? `${parts[0]} + ${parts[1]} + … + ${parts.at(-1)} = ${size}` : text;
}

const names = (system: System, { places }: Constraint): string => places.map((place) => system.ijk(place)).join(", ");

/** A step of the active-set method at which few constraints become active. */
export interface Entering {
  before: ActiveSetStep;
  step: ActiveSetStep;
  truths: Map<string, Truth>;
  /** By how much each of them is broken (below 0), or holds, at the sizes before, metres. */
  slacks: Map<string, number>;
}

/** The next such step behind a position, or the last one; null where all become active at once. */
export function entering(system: System, position: number): Entering | null {
  const found = system.steps.flatMap((step, n): Entering[] => {
    const before = system.steps[n - 1];
    const few = step.entered.length > 0 && step.entered.length <= FEW;
    if (!before || before.round !== step.round || !few) return [];
    const moment = system.at(before.at);
    const truths = new Map<string, Truth>();
    const slacks = new Map<string, number>();
    const inequalities = system.constraints.filter((own) => own.kind === "≤" && !moment.active.has(own.number));
    const slack = (own: Constraint) => slackOf(own, moment.values);
    const right = inequalities.filter((own) => step.entered.includes(own.number));
    if (!right.length) return [];
    // One that is broken as far may as well be taken up.
    const worst = Math.max(...right.map(slack));
    const wrong = inequalities
      .filter((own) => !right.includes(own) && slack(own) > worst + 2e-4)
      .sort((a, b) => slack(a) - slack(b));
    for (const own of [...right, ...wrong.slice(0, WRONG)].sort((a, b) => a.number - b.number)) {
      const is = right.includes(own);
      slacks.set(own.text, slack(own));
      const by = formatNumber(Math.abs(slack(own)), 4);
      const holds =
        slack(own) >= 0 ? `It holds here, with ${by} m to spare.` : `It is broken by ${by} m, but less than others.`;
      truths.set(own.text, {
        right: is,
        why: is ? `It is broken by ${by} m at these sizes: from now on it holds exactly.` : holds,
      });
    }
    return [{ before, step, truths, slacks }];
  });
  return found.find(({ step }) => step.at > position) ?? found.at(-1) ?? null;
}

/** How far a constraint is from its bound; negative where it is broken. */
function slackOf({ terms, lower, upper }: Constraint, values: readonly number[]): number {
  const value = terms.reduce((sum, [v, coefficient]) => sum + coefficient * (values[v] ?? 0), 0);
  return Math.min(lower === null ? Infinity : value - lower, upper === null ? Infinity : upper - value);
}
