// What holds of every view: it shows a moment, not the way there; it steps in time; what it links is in the vocabulary.

import { afterEach, describe, expect, it } from "vitest";
import { target } from "../../src/solver/links.ts";
import { VIEWS } from "../../src/solver/views/index.ts";
import { DESIGNS, type Design, type Shown, show } from "./fixtures.ts";

let shown: Shown[] = [];
afterEach(() => {
  for (const one of shown.splice(0)) one.end();
  shown = [];
});

const open = async (name: string, design: string): Promise<Shown> => {
  const kind = VIEWS[name];
  if (!kind) throw new Error(`no view ${name}`);
  const made = await show(kind, design);
  shown.push(made);
  return made;
};

/** Positions that matter: where stages begin and end, and their middles. */
function cuts({ timeline }: Shown): number[] {
  const places = timeline.data.stages.flatMap(({ first, last }) => [
    first,
    first + 1,
    Math.floor((first + last) / 2),
    last,
  ]);
  return [...new Set([0, ...places, timeline.last].map((at) => Math.max(0, Math.min(timeline.last, at))))].sort(
    (a, b) => a - b,
  );
}

/** So many of them: the first, the last, and others between, which are not the same for each view and design. */
function positions(one: Shown, name: string, design: Design, many: number): number[] {
  const all = cuts(one);
  const most = design === "apartment-house" ? many / 2 : many; // it takes as long as all others together
  if (all.length <= most) return all;
  const names = Object.keys(VIEWS);
  const step = (all.length - 2) / Math.max(1, most - 2);
  const shift = (names.indexOf(name) / names.length + DESIGNS.indexOf(design) / DESIGNS.length) % 1;
  const between = Array.from({ length: Math.max(1, most - 2) }, (_, n) => all[1 + Math.floor((n + shift) * step)] ?? 0);
  const first = most > 2 ? [all[0] ?? 0] : [];
  return [...new Set([...first, ...between, one.timeline.last])];
}

/** Ids that a view makes up may differ; what it shows may not. */
const seen = ({ view }: Shown): string => view.el.outerHTML.replaceAll(/fnb-[a-z0-9]{6,}-/g, "fnb-id-");

/** Kinds of what is linked there. */
function linked(html: string): string[] {
  const tokens = [...html.matchAll(/ data-(?:link|about)="([^"]*)"/g)].flatMap(([, own]) => (own ?? "").split(" "));
  return [...new Set(tokens.filter(Boolean).map((token) => token.split(":")[0] ?? ""))];
}

describe.each(Object.keys(VIEWS))("the view %s", (name) => {
  it.each(DESIGNS)("shows the same stepping back as forward, and links known targets only: %s", async (design) => {
    const one = await open(name, design);
    const places = positions(one, name, design, 6);
    const forward = places.map((at) => {
      one.go(at);
      return seen(one);
    });
    expect(forward.flatMap(linked).filter((kind) => !(kind in target))).toEqual([]);
    for (const [n, at] of [...places.entries()].reverse()) {
      one.go(at);
      expect(seen(one), `back at ${at}`).toBe(forward[n]);
    }
    // Nor does it matter where one jumps from.
    const middle = places[Math.floor(places.length / 2)] ?? 0;
    for (const from of [0, one.timeline.last]) {
      one.go(from);
      one.go(middle);
      expect(seen(one), `at ${middle} from ${from}`).toBe(forward[places.indexOf(middle)]);
    }
  });

  it.each(DESIGNS)("asks at any moment what can be asked, and takes it back: %s", async (design) => {
    const one = await open(name, design);
    const { quiz } = one.view;
    if (!quiz) return;
    for (const at of positions(one, name, design, 3)) {
      one.go(at);
      const before = seen(one);
      quiz.ask(true);
      for (const asked of quiz.names) {
        quiz.pose(asked);
        for (let round = 0; round < 2; round++) {
          one.go(at);
          expect(quiz.prompt).not.toBe("");
          const truths = [...quiz.truths];
          if (quiz.single) expect(truths.length, `${asked} at ${at}`).not.toBe(1); // there is something to choose from
          expect(truths.filter(([, { why }]) => !why)).toEqual([]); // everything is explained
          for (const [key, { right }] of truths) if (right) quiz.choose(key);
          const { wrong, missed } = quiz.check();
          one.go(at);
          expect([wrong, missed]).toEqual([[], []]);
          expect(quiz.outcome()).toMatch(/^(All right\.|Right)/);
          quiz.again();
        }
      }
      quiz.ask(false);
      one.go(at);
      expect(seen(one), `at ${at}`).toBe(before);
    }
  });

  it("leaves nothing behind when it ends", async () => {
    const one = await open(name, "figure-7");
    one.end();
    expect(() => one.player.go(0)).not.toThrow();
  });
});
