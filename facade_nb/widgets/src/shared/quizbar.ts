// The bar of a question, the same wherever one is asked: which, what, Hint, Check, Again; and the hint below it.

import { h, mark, setText } from "./dom.ts";
import { icon } from "./icons.ts";
import type { Answer, Quiz } from "./quiz.ts";

export interface QuizBar {
  /** The button that begins and ends asking. */
  toggle: HTMLButtonElement;
  el: HTMLElement;
  /** Show how it stands. */
  show(): void;
}

/**
 * @param done called with what was chosen, once the answer is told
 * @param choices what is offered, between question and buttons; without, the reader answers in the view itself
 */
export function quizBar(quiz: Quiz, done: (answer: Answer) => void, choices?: HTMLElement): QuizBar {
  const press = (label: string, act: () => void) => {
    const button = h("button", { type: "button", class: "fnb-fix" }, label);
    button.addEventListener("click", act);
    return button;
  };
  const toggle = h(
    "button",
    { type: "button", class: "fnb-button fnb-wide fnb-predict", title: "Hide the answer, and ask" },
    icon("ask"),
    h("span", {}, "Predict"),
  );
  toggle.addEventListener("click", () => quiz.ask(!quiz.on));
  const which = h("select", { class: "fnb-quiz-which", "aria-label": "Question" });
  which.addEventListener("change", () => quiz.pose(which.value));
  const prompt = h("span", { class: "fnb-quiz-prompt" });
  const outcome = h("strong", { class: "fnb-quiz-outcome", role: "status" });
  const help = press("Hint", () => quiz.help());
  const check = press("Check", () => {
    const answer = quiz.check();
    if (quiz.done) done(answer);
  });
  const again = press("Again", () => quiz.again());
  const hint = h("p", { class: "fnb-quiz-hint", role: "note" });
  const el = h("div", { class: "fnb-quiz" }, which, prompt, choices, outcome, help, check, again, hint);
  let [offered, about] = ["", ""];
  const show = () => {
    mark(toggle, "aria-pressed", String(quiz.on));
    el.hidden = !quiz.on;
    if (!quiz.on) return;
    const now = [quiz.asked, quiz.prompt, ...quiz.truths.keys()].join("|");
    const other = about !== "" && now !== about;
    about = now;
    if (other && quiz.begun) {
      quiz.clear(); // another moment, another question: what was chosen is not about it
      return;
    }
    const { names } = quiz;
    which.hidden = names.length < 2;
    if (names.join("|") !== offered) {
      offered = names.join("|");
      which.replaceChildren(...names.map((name) => h("option", { value: name }, name)));
    }
    which.value = quiz.asked;
    setText(prompt, quiz.prompt);
    setText(outcome, quiz.done ? quiz.outcome() : quiz.missed ? "Not yet." : "");
    const open = !quiz.done && quiz.truths.size > 0;
    check.hidden = !open;
    help.hidden = !open || quiz.hinted;
    again.hidden = !quiz.done;
    hint.hidden = !open || !quiz.hinted;
    setText(hint, hint.hidden ? "" : `Hint: ${quiz.hint}`);
  };
  return { toggle, el, show };
}
