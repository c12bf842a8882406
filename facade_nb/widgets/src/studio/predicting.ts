// Prediction in the studio: what a wider or narrower canvas will bring is said by the reader first. The design stays as it
// is until the reader makes it so.

import { h, setText } from "../shared/dom.ts";
import { formatNumber } from "../shared/fields.ts";
import { offers, type Question, Quiz, type Truth } from "../shared/quiz.ts";
import { quizBar } from "../shared/quizbar.ts";
import type { Foretold } from "../shared/types.ts";
import type { MakePart } from "./common.ts";

const FACTORS = [1.5, 0.75, 2, 1.25, 1.75]; // of the width, one after the other
const STEP = 0.5; // metres that a width is rounded to

const metres = (value: number): string => `${formatNumber(Math.round(1000 * value) / 1000)} m`;

/** The widths that are asked about, one for each round; never the present one. */
export function widthOf(now: number, round: number): number {
  const factor = FACTORS[round % FACTORS.length] as number;
  const asked = Math.max(STEP, Math.round((now * factor) / STEP) * STEP);
  return asked === now ? asked + STEP : asked;
}

/** The questions about what was worked out; one without a choice where nothing is known. */
export function questionsOf(told: Foretold | null): Question[] {
  if (!told)
    return [{ prompt: "The solver works it out, and keeps it to itself …", hint: "", truths: () => new Map() }];
  const wide = `The canvas becomes ${metres(told.width)} wide.`;
  const found = [
    ...told.counts.map((own) => howMany(own, wide)),
    ...(told.moves.length ? [whichMoves(told, wide)] : []),
  ];
  const none = `${wide} Nothing can be asked about that: no pattern across has a counter, or nothing fits.`;
  return found.length ? found : [{ prompt: none, hint: "", truths: () => new Map() }];
}

const MOST = 7; // numbers to choose among

/** Numbers in a row around both, as far as there is room; elsewise those beside the answer, and the present one. */
function around(now: number, later: number): number[] {
  const [first, last] = [Math.max(0, Math.min(now, later) - 1), Math.max(now, later) + 1];
  if (last - first < MOST) return Array.from({ length: last - first + 1 }, (_, n) => first + n);
  return [...new Set([later - 2, later - 1, later, later + 1, now])].filter((n) => n >= 0).sort((a, b) => a - b);
}

function howMany({ pattern, symbol, now, later, length }: Foretold["counts"][number], wide: string): Question {
  const [before, after] = length;
  const numbers = around(now, later);
  const each =
    later === now
      ? ""
      : ` Each ${symbol} more or less, with what stands beside it, makes ${metres((after - before) / (later - now))}.`;
  return {
    name: `${symbol} of ${pattern}`,
    prompt: `${wide} How many ${symbol} will ${pattern} have? Now there are ${now}.`,
    hint: `at the sizes that its letters like, ${pattern} is ${metres(before)} long now.${each} What comes nearest to the canvas has to be stretched or squeezed least.`,
    single: true,
    truths: () =>
      new Map(
        numbers.map((n): [string, Truth] => [
          String(n),
          {
            right: n === later,
            why: n === later ? `The solver takes it: ${metres(after)} at the sizes that its letters like.` : "",
          },
        ]),
      ),
  };
}

function whichMoves({ moves }: Foretold, wide: string): Question {
  return {
    name: "what gives way",
    prompt: `${wide} Which symbol then differs most from the size that it likes?`,
    hint: "each symbol counts once, however many letters it has. So one that stands often takes up most of what is missing or too much, unless another layer holds it.",
    single: true,
    truths: () =>
      new Map(
        moves.map(({ symbol, by, count, most }): [string, Truth] => [
          symbol,
          {
            right: most,
            why: `${count} of it, each ${metres(Math.abs(by))} ${by < 0 ? "less" : "more"} than it likes.`,
          },
        ]),
      ),
  };
}

export const predicting: MakePart = ({ store, signal }) => {
  let [told, waits]: [Foretold | null, number] = [null, 0];
  const quiz = new Quiz(() => questionsOf(told));
  const offered = h("div", { class: "fnb-quiz-choices" });
  const bar = quizBar(quiz, () => {}, offered);
  const make = h("button", { type: "button", class: "fnb-fix", hidden: true }, "Make it so wide");
  make.addEventListener("click", () => {
    if (told) store.set(["canvas", "width"], told.width);
    quiz.ask(false);
  });
  const width = () => widthOf(store.get("design").canvas.width, quiz.round);
  const ask = () => {
    if (!quiz.on || waits === width() || store.get("status").busy) return;
    [told, waits] = [null, width()];
    store.ask({ op: "foretell", width: waits });
  };
  let [shown, begun] = ["", ""];
  const show = () => {
    ask();
    bar.show();
    if (quiz.on) bar.toggle.after(bar.el);
    else bar.el.remove();
    const by = quiz.on ? `${quiz.stamp}|${quiz.prompt}|${told?.width}` : "";
    if (by === shown) return;
    shown = by;
    offered.replaceChildren(...(quiz.on && quiz.truths.size ? [offers(quiz, (key) => h("code", {}, key))] : []));
    make.hidden = !quiz.on || !quiz.done || !told;
    if (told) setText(make, `Make it ${metres(told.width)} wide`);
  };
  store.onReply((reply) => {
    if (reply.kind !== "foretold" || reply.width !== waits) return;
    told = reply;
    show();
  });
  quiz.watch(() => {
    if (!quiz.on) waits = 0;
    show();
  }, signal);
  store.watch(["design", "status"], () => {
    const now = `${JSON.stringify(store.get("design"))}|${store.get("status").busy}`;
    if (now === begun) return;
    begun = now;
    waits = 0; // another design, another answer
    if (quiz.on) quiz.clear();
  });
  const el = h("div", { class: "fnb-predicting" }, bar.toggle, make);
  show();
  return el;
};
