// The frame of every view: its head, the player above it, the question under it, errors; and the moment to show.

import { h } from "../shared/dom.ts";
import type { Quiz } from "../shared/quiz.ts";
import { type QuizBar, quizBar } from "../shared/quizbar.ts";
import type { WidgetModel } from "../shared/types.ts";
import { Asking } from "./asking.ts";
import { playbar } from "./playbar.ts";
import { cancelFrame, inFrame } from "./redraw.ts";
import type { Loaded, Session } from "./session.ts";
import type { Hosted, View, ViewKind } from "./view.ts";

const REST = 120; // milliseconds that the player rests before what is out of sight is drawn, too
const NEAR = 200; // pixels around what is in sight

export interface Panel {
  el: HTMLElement;
  /** Show the present moment: a panel that was hidden has missed some. */
  refresh(): void;
  /** Whether it is drawn with every step, also out of sight: the page is going to scroll to it. */
  follow(on: boolean): void;
  /** Take it off the page, and with it what it asks. */
  hide(): void;
}

/** Make a view of a kind in its panel, and have it follow the player and the links until the signal ends. */
export async function panel(
  kind: ViewKind,
  session: Session,
  model: WidgetModel,
  loaded: Hosted,
  signal: AbortSignal,
): Promise<Panel> {
  const made = await Promise.all(kind.needs.map((name) => session.piece(name)));
  const pieces: Record<string, unknown> = Object.fromEntries(kind.needs.map((name, n) => [name, made[n]]));
  for (const name of kind.wants ?? []) pieces[name] = await session.piece(name).catch(() => undefined);
  const { player, links, alternatives, asking } = loaded;
  let view: View | null = null;
  const light = () => {
    if (view?.light) view.light();
    else if (view) links.apply(view.el);
  };
  let ask = () => {};
  // While another view asks, this one shows no moment that would tell the answer.
  const moment = () =>
    view?.quiz?.on ? player.position : Math.max(0, Math.min(player.position, asking.fromOf(view?.quiz) - 1));
  const refresh = () => {
    view?.show(moment());
    light();
    ask(); // what is asked may be about the moment
  };
  view = kind.make({ ...loaded, session, model, pieces, signal, refresh });

  const controls = h("div", { class: "fnb-view-controls" }, ...(view.controls ?? []));
  const body = h("div", { class: "fnb-view-body" }, view.el);
  const el = h(
    "section",
    { class: "fnb-view", "aria-label": kind.title },
    h(
      "header",
      { class: "fnb-view-head" },
      h("h3", { class: "fnb-view-title" }, kind.title),
      h("p", { class: "fnb-view-subtitle" }, kind.subtitle),
      controls,
    ),
  );
  if (view.quiz) {
    const { quiz } = view;
    const bar = question(quiz, session, model, refresh, signal);
    ask = () => {
      bar.show();
      asking.set(quiz, quiz.hides && quiz.truths.size && !signal.aborted ? quiz.from : null);
    };
    signal.addEventListener("abort", () => asking.set(quiz, null));
    controls.append(bar.toggle);
    el.append(bar.el);
  }
  el.append(body);

  // A view that is out of sight waits until the player rests, or until it comes into sight.
  let [seen, followed, stale, resting] = [true, false, false, 0];
  const draw = () => {
    clearTimeout(resting);
    if (signal.aborted || el.hidden) return;
    stale = false;
    refresh();
  };
  const soon = () => {
    if (seen || followed) {
      inFrame(draw); // several steps within a frame are drawn once
      return;
    }
    stale = true;
    clearTimeout(resting);
    resting = window.setTimeout(() => stale && inFrame(draw), REST);
  };
  if (typeof IntersectionObserver !== "undefined") {
    const margin = `${NEAR}px`;
    const options = { rootMargin: margin, scrollMargin: margin };
    const observer = new IntersectionObserver((entries) => {
      seen = entries.at(-1)?.isIntersecting ?? true;
      if (seen && stale) draw();
    }, options);
    observer.observe(el);
    signal.addEventListener("abort", () => observer.disconnect());
  }
  player.watch(soon, signal);
  links.watch(() => el.hidden || light(), signal);
  alternatives.watch(soon, signal);
  asking.watch(soon, signal);
  links.listen(el, signal);
  signal.addEventListener("abort", () => {
    clearTimeout(resting);
    cancelFrame(draw);
  });
  refresh();
  const follow = (on: boolean) => {
    followed = on;
    if (on && stale) inFrame(draw);
  };
  const hide = () => {
    el.hidden = true;
    if (view.quiz) asking.set(view.quiz, null);
  };
  return { el, refresh, follow, hide };
}

/** A widget that shows one view, with a player of its own above it if its traits say so. */
export async function alone(
  kind: ViewKind,
  session: Session,
  model: WidgetModel,
  loaded: Loaded,
  signal: AbortSignal,
): Promise<HTMLElement> {
  const el = h("div", { class: "fnb-solver-alone" });
  const asking = new Asking();
  if (model.get<boolean>("player")) el.append(playbar(session, loaded.player, asking, signal));
  el.append((await panel(kind, session, model, { ...loaded, asking }, signal)).el);
  return el;
}

/** The bar of a view's question; what came of it is the widget's `answer`. */
function question(quiz: Quiz, session: Session, model: WidgetModel, refresh: () => void, signal: AbortSignal): QuizBar {
  const bar = quizBar(quiz, (answer) => {
    model.set("answer", answer);
    session.kernel.save(model);
  });
  if (model.get<boolean>("predict")) quiz.ask(true);
  quiz.watch(refresh, signal);
  bar.show();
  return bar;
}

/** What is shown where a view cannot be. */
export function apology(error: unknown): HTMLElement {
  const text = error instanceof Error ? error.message : String(error);
  const last = text.trim().split("\n").at(-1) ?? "";
  return h("details", { class: "fnb-trouble", role: "alert" }, h("summary", {}, last), h("pre", {}, text));
}
