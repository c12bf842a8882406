// Prediction of a pixel: its steps end before a split until the reader has said which part it falls into.

import { focused, h } from "../shared/dom.ts";
import { offers, type Question, Quiz } from "../shared/quiz.ts";
import { quizBar } from "../shared/quizbar.ts";
import { type Split, splitsOf } from "./question.ts";
import type { Session } from "./session.ts";
import type { Step } from "./types.ts";

export interface Asking {
  /** The button that begins and ends asking. */
  toggle: HTMLButtonElement;
  el: HTMLElement;
  /** Show how it stands. */
  show(): void;
}

export function asking(session: Session, signal: AbortSignal): Asking {
  const offered = h("div", { class: "fnb-quiz-choices" });
  let [round, offeredBy] = [0, ""];
  const asked = (): Split | undefined => {
    const all = splitsOf(session.text, session.allSteps);
    return all[round % Math.max(1, all.length)];
  };
  const quiz = new Quiz(() => {
    const split = asked();
    const none = {
      prompt: "Click a pixel that falls into one of several parts of a split.",
      hint: "",
      truths: () => new Map(),
    };
    return [split ? questionOf(split) : none];
  });
  const bar = quizBar(quiz, () => {}, offered);
  let veiled: { from: Step[]; by: string; steps: Step[] } | null = null;
  const veil = (steps: Step[]) => {
    const split = quiz.hides ? asked() : undefined;
    const now = split && steps[split.step];
    if (!split || !now) return steps; // another view keeps back more
    const by = String(split.step);
    if (veiled?.from !== steps || veiled.by !== by) {
      // The part is what is asked for, and what was read of the texture ends with it.
      const hidden = { ...now, text: "which part?", records: now.records.slice(0, 1) };
      veiled = { from: steps, by, steps: [...steps.slice(0, split.step), hidden] };
    }
    return veiled.steps;
  };
  session.veils.add(veil);
  signal.addEventListener("abort", () => session.veils.delete(veil));
  quiz.watch(() => {
    round = quiz.round;
    session.look(session.steps.length - 1);
  }, signal);
  const el = h("div", { hidden: true });
  const show = () => {
    bar.show();
    el.hidden = !quiz.on;
    if (quiz.on) el.prepend(bar.el);
    else bar.el.remove();
    const split = quiz.on ? asked() : undefined;
    offered.hidden = !split;
    const by = split ? `${quiz.stamp}|${quiz.prompt}` : "";
    if (by === offeredBy) return;
    offeredBy = by;
    const inputs = () => [...offered.querySelectorAll("input")];
    const at = inputs().indexOf(focused(offered) as HTMLInputElement);
    const rule = split && h("p", { class: "fnb-known" }, h("code", {}, split.rule));
    offered.replaceChildren(...(rule ? [rule, offers(quiz, (key) => h("code", {}, key))] : []));
    inputs()[at]?.focus();
  };
  return { toggle: bar.toggle, el, show };
}

function questionOf({ options, right, at, size, across }: Split): Question {
  const [end, where] = across ? ["left", "wide"] : ["bottom", "high"];
  const metres = (value: number) => `${Number(value.toFixed(2))} m`;
  return {
    prompt: `The pixel is ${metres(at)} from the ${end} of a scope that is ${metres(size)} ${where}. Which rule does it go on with?`,
    hint: `parts are put one after the other from the ${end}. Abs is metres; Rel parts share what is left, each by its number. Add them up until the pixel is passed.`,
    single: true,
    truths: () =>
      new Map(
        options.map((name) => [
          name,
          { right: name === right, why: name === right ? "It lies in this part." : "This part lies elsewhere." },
        ]),
      ),
  };
}
