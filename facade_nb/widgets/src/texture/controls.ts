// The buttons and sliders under the picture.

import { h, mark, setText } from "../shared/dom.ts";
import { stepped, stepsOf } from "../shared/stepping.ts";
import type { WidgetModel } from "../shared/types.ts";
import type { Session } from "./session.ts";
import type { Steering } from "./steering.ts";

export interface Slider {
  label: string;
  range: [low: number, high: number, step: number];
  get(): number;
  set(value: number): void;
  show(value: number): string;
}

const metres = (value: number) => `${Number(value.toFixed(1))} m`;

/** 9.5 is half past nine. */
export function timeOf(hour: number): string {
  const minutes = Math.round(hour * 60);
  return `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}`;
}

export function buttons(session: Session, model: WidgetModel, steer: Steering, signal: AbortSignal): HTMLElement {
  const button = (label: string, act: () => void, text = "") => {
    const made = h("button", { type: "button", class: "fnb-tex-button", "aria-label": label, title: label }, text);
    made.addEventListener("click", act);
    return made;
  };
  const flat = button("Straight on or in perspective", steer.turnOver);
  const lit = button("Light of the hour or plain colours", () => session.set("lit", !session.lit));
  lit.classList.add("fnb-tex-edit");
  const name = () => {
    setText(flat, model.get<boolean>("flat") ? "Perspective" : "Straight on");
    setText(lit, session.lit ? "Plain colours" : "Light");
  };
  model.on("change:flat", name);
  signal.addEventListener("abort", () => model.off("change:flat", name));
  session.hold(name, signal);
  return h(
    "div",
    { class: "fnb-tex-bar" },
    flat,
    lit,
    button("Nearer", () => steer.dolly(0.7), "+"),
    button("Further", () => steer.dolly(1 / 0.7), "−"),
    button("Whole façade", steer.home, "Reset"),
  );
}

export function sliders(session: Session, signal: AbortSignal): HTMLElement {
  const all: Slider[] = [
    {
      label: "Hour",
      range: [0, 24, 0.25],
      get: () => session.hour,
      set: (value) => session.set("hour", value),
      show: timeOf,
    },
    {
      label: "Width",
      range: [2, 40, 0.1],
      get: () => session.size[0],
      set: (value) => session.set("size", [value, session.size[1]]),
      show: metres,
    },
    {
      label: "Height",
      range: [2, 40, 0.1],
      get: () => session.size[1],
      set: (value) => session.set("size", [session.size[0], value]),
      show: metres,
    },
    {
      label: "Seed",
      range: [0, 100, 1],
      get: () => session.seed[0],
      set: (value) => session.set("seed", [value, value * 2]),
      show: (value) => String(Number(value.toFixed(2))),
    },
  ];
  return h("div", { class: "fnb-tex-slides" }, ...all.map((one) => slider(one, session, signal)));
}

export function slider(
  { label, range, get, set, show }: Slider,
  session: Pick<Session, "hold">,
  signal: AbortSignal,
): HTMLElement {
  const [min, max, step] = range;
  const input = h("input", { type: "range", min, max, step, "aria-label": label });
  const value = h("output", {});
  input.addEventListener("input", () => set(Number(input.value)));
  // By itself a slider steps along its own marks, wherever the value is.
  input.addEventListener("keydown", (event) => {
    const steps = stepsOf(event, true);
    if (!steps) return;
    event.preventDefault();
    set(stepped(get(), steps, { step, min, max }));
  });
  session.hold(() => {
    if (Number(input.value) !== get()) input.value = String(get());
    setText(value, show(get()));
    mark(input, "aria-valuetext", show(get()));
  }, signal);
  return h("label", { class: "fnb-tex-slide" }, h("span", {}, label), input, value);
}
