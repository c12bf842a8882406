// The choice of a lesson, what to look at in it, and the notice that what is shown is not the present design.

import { h, setText } from "../shared/dom.ts";
import type { Session } from "./session.ts";

const SOON = 400; // milliseconds that a solve may take before anything is said

/** A list of the lessons; it is away where there is no kernel to solve one. */
export function lessonChoice(session: Session, signal: AbortSignal): HTMLElement {
  const own = h("option", { value: "" }, "Lessons…");
  const list = h(
    "select",
    {
      class: "fnb-select fnb-lessons",
      "aria-label": "Lesson",
      title: "Small designs in which the search has something to decide",
    },
    own,
    ...session.lessons.map(([name, title], n) => h("option", { value: name }, `${n + 1} ${title}`)),
  );
  list.value = session.lesson;
  if (session.lesson) setText(own, "Back to this design");
  list.addEventListener("change", () => session.learn(list.value));
  const box = h("div", { class: "fnb-play-lessons" }, list);
  const show = () => {
    box.hidden = !session.lessons.length || (!session.live && !session.lesson);
    list.disabled = !session.live;
  };
  session.kernel?.watch(show, signal);
  show();
  return box;
}

/** What to look at in the lesson. */
export function lessonNote(session: Session): HTMLElement {
  const title = session.lessons.find(([name]) => name === session.lesson)?.[1] ?? "";
  const note = h(
    "p",
    { class: "fnb-play-lesson", role: "note" },
    h("b", {}, `${title}. `),
    h("span", {}, session.about),
  );
  note.hidden = !session.about;
  return note;
}

/** Says above a view that the design has been changed since, or has no layout. */
export function staleNotice(session: Session, signal: AbortSignal): HTMLElement {
  const el = h("p", { class: "fnb-stale", role: "status", hidden: true });
  let waiting = 0;
  const show = () => {
    clearTimeout(waiting);
    const text = session.lesson ? "" : session.stale;
    const tell = () => {
      setText(el, text);
      el.hidden = !text;
    };
    // A solve that is over in a moment need not be told of.
    if (text && el.hidden) waiting = window.setTimeout(tell, SOON);
    else tell();
  };
  session.watchStale(show, signal);
  signal.addEventListener("abort", () => clearTimeout(waiting));
  show();
  return el;
}
