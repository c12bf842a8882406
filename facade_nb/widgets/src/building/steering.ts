// Going around a building, with pointer, wheel and keys.

import { setTraits } from "../shared/dom.ts";
import { pointing } from "../shared/pointing.ts";
import type { WidgetModel } from "../shared/types.ts";
import { ANGLE, axesOf, distanceOf, FIRST, type Look, targetOf } from "./orbit.ts";
import type { Vector } from "./types.ts";

const SETTLED = 250; // milliseconds after which Python is told
const [LOWEST, HIGHEST] = [-15, 88]; // degrees
const NEAREST = 0.3; // metres
const FARTHEST = 6; // times as far as the whole building is seen from
const [TURN, RISE] = [180, 90]; // degrees that a drag across the picture turns

/** How the building is looked at. */
export function lookOf(model: WidgetModel): Look {
  const target = model.get<number[]>("target");
  return {
    turn: model.get<number>("turn"),
    rise: model.get<number>("rise"),
    distance: model.get<number>("distance"),
    target: target.length === 3 ? (target as Vector) : null,
  };
}

export interface Steering {
  zoom(by: number): void;
  home(): void;
}

interface Steered {
  body(): number[];
  aspect(): number;
  /** The point of the building that is seen at a place of the picture; null: none. */
  meet(across: number, up: number): Vector | null;
  clicked(across: number, up: number): void;
  hovered(at: { across: number; up: number } | null): void;
  save(): void;
}

const limit = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value));

export function steering(canvas: HTMLCanvasElement, model: WidgetModel, own: Steered, signal: AbortSignal): Steering {
  let telling = 0;
  const change = (values: Record<string, unknown>) => {
    setTraits(model, values);
    clearTimeout(telling);
    telling = window.setTimeout(own.save, SETTLED);
  };
  const distance = () => distanceOf(lookOf(model), own.body(), own.aspect());
  const orbit = (turn: number, rise: number) => {
    const now = lookOf(model);
    const turned = ((((now.turn + turn) % 360) + 540) % 360) - 180;
    change({ turn: turned, rise: limit(now.rise + rise, LOWEST, HIGHEST) });
  };
  /** By parts of the picture's width. */
  const pan = (across: number, up: number) => {
    const now = lookOf(model);
    const [right, above] = axesOf(now);
    const metres = 2 * distance() * Math.tan((ANGLE * Math.PI) / 360);
    move(
      targetOf(now, own.body()).map(
        (at, k) => at + metres * (across * (right[k] as number) + up * (above[k] as number)),
      ) as Vector,
      distance(),
    );
  };
  /** The target stays within reach of the building. */
  const move = (to: Vector, far: number) => {
    const body = own.body();
    const rim = 0.5 * Math.max(...[0, 1, 2].map((k) => (body[k + 3] as number) - (body[k] as number)));
    const kept = to.map((at, k) => limit(at, k === 1 ? 0 : (body[k] as number) - rim, (body[k + 3] as number) + rim));
    change({ target: kept, distance: far });
  };
  /** Nearer, with the point under the pointer kept where it is. */
  const zoom = (by: number, at?: [across: number, up: number]) => {
    const now = lookOf(model);
    const before = distance();
    const most = FARTHEST * distanceOf({ ...now, distance: 0 }, own.body(), own.aspect());
    const found = at ? own.meet(...at) : null;
    const after = limit(before * by, NEAREST, most);
    const target = targetOf(now, own.body());
    const part = after / before;
    const to = found
      ? (target.map((own_, k) => (found[k] as number) + part * (own_ - (found[k] as number))) as Vector)
      : target;
    move(to, after);
  };
  const home = () => change({ ...FIRST, distance: 0, target: [] });

  pointing(canvas, {
    all: true,
    clicked: own.clicked,
    hovered: own.hovered,
    dragged(dx, dy, event) {
      own.hovered(null);
      const [across, up] = [-dx / canvas.clientWidth, dy / canvas.clientWidth];
      if (event.shiftKey || event.buttons !== 1) pan(across, up);
      else orbit(across * TURN, up * RISE);
    },
    wheeled: (by, across, up) => zoom(Math.exp(0.0015 * by), [across, up]),
  });
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrows: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    };
    const arrow = arrows[event.key];
    if (arrow && event.shiftKey) pan(0.05 * arrow[0], 0.05 * arrow[1]);
    else if (arrow) orbit(6 * arrow[0], 4 * arrow[1]);
    else if (event.key === "+" || event.key === "=") zoom(0.85);
    else if (event.key === "-") zoom(1 / 0.85);
    else if (event.key === "0" || event.key === "Home") home();
    else if (event.key === "Enter") own.clicked(0.5, 0.5);
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  signal.addEventListener("abort", () => clearTimeout(telling));
  return { zoom, home };
}
