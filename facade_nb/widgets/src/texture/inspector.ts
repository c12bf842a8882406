// How the pixel that was clicked came about, step by step.

import { focused, h, mark, setText } from "../shared/dom.ts";
import { offers, type Question, Quiz } from "../shared/quiz.ts";
import { quizBar } from "../shared/quizbar.ts";
import { type Split, splitsOf } from "./question.ts";
import { revealer } from "./revealing.ts";
import type { Session } from "./session.ts";
import type { Step } from "./types.ts";

/** The scope and the seed stack of a step, in words. */
export function about({ scope, seeds, faces }: Step): string {
  const [left, bottom, right, top] = scope.map((value) => String(Number(value.toFixed(2))));
  const on = faces.length ? ` on the ${faces.at(-1)} of the room` : "";
  const stack = seeds.length ? seeds.map((corner) => corner.join(", ")).join(" · ") : "empty";
  return `Scope ${left} to ${right} × ${bottom} to ${top} m${on}; seed stack: ${stack}`;
}

export function inspector(session: Session, signal: AbortSignal): HTMLElement {
  const head = h("div", { class: "fnb-tex-hint", role: "status" });
  const list = h("ol", { class: "fnb-tex-steps" });
  const detail = h("div", { class: "fnb-tex-detail" });
  const reveal = revealer(list, signal);
  const offered = h("div", { class: "fnb-tex-asked" });
  let [round, offeredBy] = [0, ""];
  const splits = () => splitsOf(session.text, session.allSteps);
  const asked = (): Split | undefined => {
    const all = splits();
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
  const bar = quizBar(quiz, () => {});
  let veiled: { from: Step[]; by: string; steps: Step[] } | null = null;
  const veil = (steps: Step[]) => {
    const split = quiz.hides ? asked() : undefined;
    if (!split) return steps;
    const by = String(split.step);
    if (veiled?.from !== steps || veiled.by !== by) {
      const now = steps[split.step] as Step;
      // The part is what is asked for, and what was read of the texture ends with it.
      const hidden = { ...now, text: "which part?", records: now.records.slice(0, 1) };
      veiled = { from: steps, by, steps: [...steps.slice(0, split.step), hidden] };
    }
    return veiled.steps;
  };
  session.veil = veil;
  signal.addEventListener("abort", () => {
    if (session.veil === veil) session.veil = null;
  });
  quiz.watch(() => {
    round = quiz.round;
    session.look(session.steps.length - 1);
  }, signal);
  let shown: unknown = null;
  list.addEventListener("keydown", (event) => {
    const by = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    const to = Math.min(session.steps.length - 1, Math.max(0, session.step + by));
    session.look(to);
    list.children[to]?.querySelector("button")?.focus();
  });
  const top = h("div", { class: "fnb-tex-top" }, head, bar.toggle);
  session.hold(() => {
    bar.show();
    if (quiz.on) top.after(bar.el);
    else bar.el.remove();
    const split = quiz.on ? asked() : undefined;
    offered.hidden = !split;
    const by = split ? `${quiz.stamp}|${quiz.prompt}` : "";
    if (by !== offeredBy) {
      offeredBy = by;
      const inputs = () => [...offered.querySelectorAll("input")];
      const at = inputs().indexOf(focused(offered) as HTMLInputElement);
      const rule = split && h("p", { class: "fnb-known" }, h("code", {}, split.rule));
      offered.replaceChildren(...(rule ? [rule, offers(quiz, (key) => h("code", {}, key))] : []));
      inputs()[at]?.focus();
    }
    const { steps, point } = session;
    if (shown !== steps) {
      shown = steps;
      list.replaceChildren(
        ...steps.map((step, k) => {
          const layer = step.layers.length ? `layer ${step.layers.map(([, number]) => number).join(" › ")}` : "";
          const where = [...step.faces, layer].filter(Boolean).join(" · ");
          const swatch = step.color && h("i", { class: "fnb-tex-swatch" });
          if (swatch && step.color)
            swatch.style.background = `rgb(${step.color
              .slice(0, 3)
              .map((v) => Math.round(255 * v))
              .join(" ")})`;
          const go = h(
            "button",
            { type: "button" },
            h("b", {}, step.rule),
            " ",
            h("code", {}, step.operator),
            " ",
            h("span", {}, step.text),
            swatch,
            where ? h("small", {}, where) : null,
          );
          go.addEventListener("click", () => session.look(k));
          return h("li", {}, go);
        }),
      );
    }
    [...list.children].forEach((row, k) => {
      mark(row, "aria-current", k === session.step ? "step" : null);
    });
    reveal(list.children[session.step]);
    const now = steps[session.step];
    setText(detail, now ? about(now) : "");
    detail.hidden = !now;
    setText(
      head,
      point && steps.length
        ? `At ${point.map((v) => v.toFixed(2)).join(", ")} m: ${steps.length} steps`
        : "Click the façade, or press Enter on it, to see how a pixel comes about.",
    );
  }, signal);
  return h("section", { class: "fnb-tex-inspector", "aria-label": "Pixel inspector" }, top, offered, list, detail);
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
