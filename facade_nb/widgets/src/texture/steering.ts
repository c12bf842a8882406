// Moving about in front of the façade, with pointer, wheel and keys; a click looks into a pixel.

import { setTraits } from "../shared/dom.ts";
import { pointing } from "../shared/pointing.ts";
import type { WidgetModel } from "../shared/types.ts";
import type { Session } from "./session.ts";
import { distanceOf, type Look, meet, sightOf, targetOf } from "./sight.ts";
import type { Pair } from "./types.ts";

const NEAREST = 0.15; // metres
const SETTLED = 200; // milliseconds after which Python is told where one stands

/** How the façade is looked at. */
export function lookOf(model: WidgetModel): Look {
  const target = model.get<number[]>("target");
  return {
    turn: model.get<number>("turn"),
    rise: model.get<number>("rise"),
    distance: model.get<number>("distance"),
    target: target.length === 2 ? (target as Pair) : null,
    flat: model.get<boolean>("flat"),
  };
}

export interface Steering {
  dolly(by: number): void;
  home(): void;
  /** From straight on to perspective, and back. */
  turnOver(): void;
}

export function steering(
  canvas: HTMLCanvasElement,
  session: Session,
  model: WidgetModel,
  signal: AbortSignal,
): Steering {
  let telling = 0;
  const look = () => lookOf(model);
  const aspect = () => canvas.width / Math.max(1, canvas.height);
  const limit = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value));

  const change = (values: Record<string, unknown>) => {
    setTraits(model, values);
    clearTimeout(telling);
    telling = window.setTimeout(() => session.kernel.save(model), SETTLED);
  };
  const dolly = (by: number) => {
    const far = distanceOf({ ...look(), distance: 0 }, session.size, aspect());
    const now = distanceOf(look(), session.size, aspect());
    change({ distance: limit(now * by, NEAREST, 4 * far) });
  };
  const orbit = (turn: number, rise: number) => {
    const now = look();
    change({ turn: limit(now.turn + turn, -80, 80), rise: limit(now.rise + rise, -60, 60) });
  };
  const pan = (across: number, up: number) => {
    const now = look();
    const [x, y] = targetOf(now, session.size);
    const wide = 0.93 * distanceOf(now, session.size, aspect());
    const [w, t] = session.size;
    change({ target: [limit(x + across * wide, 0, w), limit(y + up * wide, 0, t)] });
  };
  /** By parts of the picture's width. */
  const move = (across: number, up: number, panning: boolean) => {
    if (look().flat || panning) pan(across, up);
    else orbit(across * 90, up * 60);
  };
  const inspect = (across: number, down: number) => {
    const found = meet(sightOf(look(), session.size, aspect()), across, down);
    const inside = (at: number, k: number) => at >= 0 && at <= (session.size[k] as number);
    if (found?.point.every(inside)) session.pick(found.point, found.ray);
    else session.pick(null);
  };
  const home = () => change({ turn: 0, rise: 0, distance: 0, target: [] });

  pointing(canvas, {
    clicked: (across, up) => inspect(across, 1 - up),
    dragged: (dx, dy, event) => move(-dx / canvas.clientWidth, dy / canvas.clientWidth, event.shiftKey),
    wheeled: (by) => dolly(Math.exp(0.0015 * by)),
  });
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrows: Record<string, Pair> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    };
    const arrow = arrows[event.key];
    if (arrow) move(arrow[0] * 0.06, arrow[1] * 0.06, event.shiftKey);
    else if (event.key === "+" || event.key === "=") dolly(0.85);
    else if (event.key === "-") dolly(1 / 0.85);
    else if (event.key === "Home") home();
    else if (event.key === "Enter") inspect(0.5, 0.5);
    else if (event.key === "Escape") session.pick(null);
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  signal.addEventListener("abort", () => clearTimeout(telling));
  return {
    dolly,
    home,
    turnOver() {
      const now = look();
      change({ flat: !now.flat, ...(now.flat && !now.turn ? { turn: 25, rise: -12 } : {}) });
    },
  };
}
