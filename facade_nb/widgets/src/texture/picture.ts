// The façade, drawn by the page's one renderer and copied into a canvas of its own; where a page cannot draw, a still one.

import { lightAt } from "../pipeline/camera.ts";
import { context } from "../pipeline/context.ts";
import { h, mark, setText, svg } from "../shared/dom.ts";
import type { WidgetModel } from "../shared/types.ts";
import { asking } from "./asking.ts";
import { buttons, sliders } from "./controls.ts";
import { painting } from "./painting.ts";
import { type Job, watch } from "./renderer.ts";
import { drawScopes } from "./scopes.ts";
import type { Session } from "./session.ts";
import { sightOf } from "./sight.ts";
import { lookOf, steering } from "./steering.ts";
import { stillPicture } from "./still.ts";

const TALLEST = 620; // pixels of the page: more than that would not fit beside what it is changed with

const WATCHED = ["turn", "rise", "distance", "target", "flat", "antialias"];

/** @param asks whether the picture itself asks for predictions; where an inspector stands beside it, that does */
export function picture(session: Session, model: WidgetModel, signal: AbortSignal, asks = false): HTMLElement {
  const root = h("section", { class: "fnb-tex-picture", "aria-label": "Façade" });
  const controlled = model.get<boolean>("controls");
  const { whyNot } = context();
  if (whyNot) {
    root.append(stillPicture(session, whyNot, signal));
    if (controlled) root.append(sliders(session, signal));
    return root;
  }
  const canvas = h("canvas", { class: "fnb-tex-canvas", tabindex: 0, role: "img" });
  root.append(stage(canvas, session, model, signal));
  const steer = steering(canvas, session, model, signal);
  if (!controlled) return root;
  const row = buttons(session, model, steer, signal);
  root.append(row, sliders(session, signal));
  if (asks) {
    const asked = asking(session, signal);
    row.append(asked.toggle);
    row.after(asked.el);
    session.hold(asked.show, signal);
  }
  return root;
}

/** The canvas with the scopes over it and a note where there is nothing to draw. */
function stage(canvas: HTMLCanvasElement, session: Session, model: WidgetModel, signal: AbortSignal): HTMLElement {
  const overlay = svg("svg", { class: "fnb-tex-overlay", "aria-hidden": "true" });
  const note = h("div", { class: "fnb-tex-note", role: "status" });
  const made = h("div", { class: "fnb-tex-stage" }, canvas, overlay, note);
  /** Its size on the page when it last had one: a stage that is hidden, if only for a moment, has none. */
  let [wide, tall] = [0, 0];
  let drawn = "";
  let scene = session.scene;
  let failure = "";

  const sight = () => sightOf(lookOf(model), session.size, canvas.width / Math.max(1, canvas.height));
  const job = (): Job | null => {
    const { scene, tiles, common } = session;
    if (!scene || !tiles || !common) return null;
    const light = session.lit ? lightAt(common.hours, session.hour) : null;
    return { owner: session, common, scene, tiles, sight: sight(), size: session.size, seed: session.seed, light };
  };
  const say = () => {
    const text = failure || (!session.scene ? nothing(session) : session.faults.length ? STALE : "");
    setText(note, text);
    note.hidden = text === "";
    mark(made, "data-empty", !session.scene);
  };
  const failed = (message: string) => {
    failure = message;
    say();
  };
  const scopes = () => {
    if (wide && tall) drawScopes(overlay, session, sight(), wide, tall);
  };
  const paint = painting(canvas, job, () => model.get("antialias") !== "none", scopes, failed);

  const resize = () => {
    if (!made.clientWidth) return;
    wide = made.clientWidth;
    const [w, t] = session.size;
    tall = Math.round(Math.min(TALLEST, wide * Math.min(0.8, Math.max(0.45, t / w))));
    const dense = Math.min(window.devicePixelRatio || 1, 2, 1600 / wide);
    const [width, height] = [Math.round(wide * dense), Math.round(tall * dense)];
    if (canvas.width === width && canvas.height === height) return;
    canvas.width = width;
    canvas.height = height;
    drawn = "";
  };
  const update = () => {
    resize();
    const [w, t] = session.size;
    mark(
      canvas,
      "aria-label",
      `Façade, ${w} by ${t} metres. Arrow keys turn, plus and minus come nearer, Enter looks into the middle.`,
    );
    if (session.scene) {
      const now = JSON.stringify([session.size, session.seed, session.hour, session.lit, canvas.width, canvas.height]);
      if (now !== drawn || scene !== session.scene) {
        failure = "";
        paint.redraw();
      }
      drawn = now;
      scene = session.scene;
    }
    say();
    scopes();
  };

  const watching = new ResizeObserver(update);
  watching.observe(made);
  watch(paint.redraw, signal);
  for (const name of WATCHED) model.on(`change:${name}`, paint.redraw);
  signal.addEventListener("abort", () => {
    watching.disconnect();
    for (const name of WATCHED) model.off(`change:${name}`, paint.redraw);
    paint.stop();
  });
  session.hold(update, signal);
  return made;
}

const STALE = "The text has faults: this is the picture of what it was before.";

/** Why there is no picture yet. */
export function nothing(session: Session): string {
  if (session.trouble) return session.trouble;
  const [first] = session.faults;
  if (first) {
    const place = first.line ? `line ${first.line}, column ${first.column}` : first.place;
    return `There is no picture yet, for the text has faults. The first, at ${place}: ${first.message}`;
  }
  return session.live ? "Reading the grammar …" : "This saved page holds no picture: run the notebook to see it.";
}
