// The façade, drawn by the page's one renderer and copied into a canvas of its own: moved with pointer and keys, coarse
// while it moves and sharp when it rests.

import { h, mark, setText, svg } from "../dom.ts";
import type { WidgetModel } from "../types.ts";
import { type Job, lightAt, renderer } from "./renderer.ts";
import type { Session } from "./session.ts";
import { distanceOf, type Look, meet, project, type Sight, sightOf, targetOf } from "./sight.ts";
import type { Pair } from "./types.ts";

const BUDGET = 45; // milliseconds of a frame while it moves
const RESTED = 160; // milliseconds after which it is drawn sharply
const NEAREST = 0.15; // metres

/** How coarse the next frame should be: 1 is sharp. From the time that the last one took, of so many pixels. */
export function coarser(milliseconds: number, pixels: number, full: number): number {
  const affordable = (pixels * BUDGET) / Math.max(milliseconds, 1);
  return Math.min(12, Math.max(1, Math.sqrt(full / affordable)));
}

export function picture(session: Session, model: WidgetModel, signal: AbortSignal): HTMLElement {
  const canvas = h("canvas", {
    class: "fnb-tex-canvas",
    tabindex: 0,
    role: "img",
    "data-lm-suppress-shortcuts": "true",
  });
  const overlay = svg("svg", { class: "fnb-tex-overlay", "aria-hidden": "true" });
  const note = h("div", { class: "fnb-tex-note", role: "status" });
  const stage = h("div", { class: "fnb-tex-stage" }, canvas, overlay, note);
  const painter = renderer();
  const paper = canvas.getContext("2d", { willReadFrequently: painter.software }) as CanvasRenderingContext2D;
  let coarse = 1;
  let timer = 0;
  let frame = 0;
  let drawn = "";
  let rows = 24;

  const look = (): Look => {
    const target = model.get<number[]>("target");
    return {
      turn: model.get<number>("turn"),
      rise: model.get<number>("rise"),
      distance: model.get<number>("distance"),
      target: target.length === 2 ? (target as Pair) : null,
      flat: model.get<boolean>("flat"),
    };
  };
  const aspect = () => canvas.width / Math.max(1, canvas.height);
  const sight = (): Sight => sightOf(look(), session.size, aspect());
  const job = (): Job | null => {
    const { scene, tiles, common } = session;
    if (!scene || !tiles || !common) return null;
    const light = session.lit ? lightAt(common.hours, session.hour) : null;
    return { common, scene, tiles, sight: sight(), size: session.size, seed: session.seed, light };
  };

  const say = (text: string) => {
    setText(note, text);
    note.hidden = text === "";
  };
  const attempt = (act: () => void) => {
    try {
      act();
    } catch (error) {
      say(error instanceof Error ? error.message : String(error));
    }
  };

  /** The whole picture at once, as coarse as the time allows. */
  const rough = () =>
    attempt(() => {
      const now = job();
      if (!now || !canvas.width) return;
      const full = canvas.width * canvas.height;
      const [width, height] = [Math.ceil(canvas.width / coarse), Math.ceil(canvas.height / coarse)];
      const before = performance.now();
      if (!painter.draw(now, paper, width, height)) return;
      coarse = coarser(performance.now() - before, width * height, full);
      mark(canvas, "data-state", coarse > 1.2 ? "coarse" : "moving");
      say("");
    });
  /** Sharply, a band of rows at a time, so that the page never stalls. */
  const sharp = (low: number) =>
    attempt(() => {
      const now = job();
      if (!now || !canvas.width) return;
      const high = Math.min(canvas.height, low + rows);
      const before = performance.now();
      if (!painter.draw(now, paper, canvas.width, canvas.height, low, high)) return;
      const taken = performance.now() - before;
      rows = Math.min(1024, Math.max(4, Math.round((rows * BUDGET) / Math.max(taken, 1))));
      if (high < canvas.height) timer = window.setTimeout(() => sharp(high), 0);
      else {
        mark(canvas, "data-state", "sharp");
        say("");
      }
    });
  const redraw = () => {
    clearTimeout(timer);
    timer = window.setTimeout(() => sharp(0), RESTED);
    mark(canvas, "data-state", "moving");
    if (!frame)
      frame = requestAnimationFrame(() => {
        frame = 0;
        rough();
        scopes();
      });
  };

  const scopes = () => {
    const steps = session.steps.slice(0, session.step + 1);
    const now = sight();
    const [wide, tall] = [canvas.clientWidth, canvas.clientHeight];
    overlay.setAttribute("viewBox", `0 0 ${wide || 1} ${tall || 1}`);
    const place = (at: Pair): string | null => {
      const found = project(now, at);
      return found && `${(found[0] * wide).toFixed(1)},${(found[1] * tall).toFixed(1)}`;
    };
    const outlines = steps
      .filter((step) => step.faces.length === 0)
      .map((step, k, all) => {
        const [left, bottom, right, top] = step.scope;
        const corners = [
          [left, bottom],
          [right, bottom],
          [right, top],
          [left, top],
        ].map((at) => place(at as Pair));
        if (corners.includes(null)) return null;
        return svg("polygon", { points: corners.join(" "), class: k === all.length - 1 ? "fnb-tex-now" : "" });
      });
    const dot = session.point && place(session.point);
    const [x, y] = dot ? dot.split(",") : ["", ""];
    overlay.replaceChildren(
      ...outlines.filter((one) => one !== null),
      ...(dot ? [svg("circle", { cx: x, cy: y, r: 4 })] : []),
    );
  };

  const change = (values: Record<string, unknown>) => {
    model.set(values);
    redraw();
  };
  const save = () => {
    if (session.live) model.save_changes();
  };
  const dolly = (by: number) => {
    const far = distanceOf({ ...look(), distance: 0 }, session.size, aspect());
    const now = distanceOf(look(), session.size, aspect());
    change({ distance: Math.min(4 * far, Math.max(NEAREST, now * by)) });
  };
  const orbit = (turn: number, rise: number) => {
    const now = look();
    change({
      turn: Math.min(80, Math.max(-80, now.turn + turn)),
      rise: Math.min(60, Math.max(-60, now.rise + rise)),
    });
  };
  const pan = (across: number, up: number) => {
    const now = look();
    const [x, y] = targetOf(now, session.size);
    const wide = 0.93 * distanceOf(now, session.size, aspect());
    const [w, t] = session.size;
    change({
      target: [Math.min(w, Math.max(0, x + across * wide)), Math.min(t, Math.max(0, y + up * wide))],
    });
  };
  const home = () => change({ turn: 0, rise: 0, distance: 0, target: [] });
  const move = (across: number, up: number, panning: boolean) => {
    if (look().flat || panning) pan(across, up);
    else orbit(across * 90, up * 60);
  };

  let held: { x: number; y: number; moved: number } | null = null;
  canvas.addEventListener("pointerdown", (event) => {
    held = { x: event.clientX, y: event.clientY, moved: 0 };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    const [dx, dy] = [event.clientX - held.x, event.clientY - held.y];
    held = { x: event.clientX, y: event.clientY, moved: held.moved + Math.abs(dx) + Math.abs(dy) };
    if (held.moved > 4) move(-dx / canvas.clientWidth, dy / canvas.clientWidth, event.shiftKey);
  });
  const inspect = (across: number, down: number) => {
    const found = meet(sight(), across, down);
    const inside = (at: number, k: number) => at >= 0 && at <= (session.size[k] as number);
    if (found?.point.every(inside)) session.pick(found.point, found.ray);
    else session.pick(null);
  };
  canvas.addEventListener("pointerup", (event) => {
    if (held && held.moved <= 4) {
      const box = canvas.getBoundingClientRect();
      inspect((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
    }
    held = null;
    save();
  });
  canvas.addEventListener("pointercancel", () => {
    held = null;
  });
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== canvas) return; // the page scrolls until the picture is chosen
      event.preventDefault();
      dolly(Math.exp(event.deltaY * 0.0015));
      save();
    },
    { passive: false },
  );
  canvas.addEventListener("keydown", (event) => {
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
    save();
  });

  const resize = () => {
    const wide = stage.clientWidth;
    if (!wide) return;
    const [w, t] = session.size;
    const tall = Math.round(wide * Math.min(0.8, Math.max(0.45, t / w)));
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
    if (!session.scene)
      say(
        session.trouble ||
          (session.faults.length ? "The text has faults: there is no picture yet." : "Reading the grammar …"),
      );
    else {
      const now = JSON.stringify([session.size, session.seed, session.hour, session.lit, canvas.width, canvas.height]);
      if (now !== drawn || scene !== session.scene) redraw();
      drawn = now;
      scene = session.scene;
    }
    mark(stage, "data-stale", session.faults.length > 0);
    scopes();
  };
  let scene = session.scene;
  const watching = new ResizeObserver(update);
  watching.observe(stage);
  painter.watch(redraw, signal);
  const moved = () => redraw();
  const names = ["turn", "rise", "distance", "target", "flat"].map((name) => `change:${name}`);
  for (const name of names) model.on(name, moved);
  signal.addEventListener("abort", () => {
    watching.disconnect();
    for (const name of names) model.off(name, moved);
    clearTimeout(timer);
    cancelAnimationFrame(frame);
  });
  session.hold(update, signal);

  const root = h("section", { class: "fnb-tex-picture", "aria-label": "Façade" }, stage);
  if (model.get<boolean>("controls")) {
    const key = (name: string, label: string, act: () => void) => {
      const made = h(
        "button",
        {
          type: "button",
          class: "fnb-tex-button",
          "aria-label": label,
          title: label,
          "data-lm-suppress-shortcuts": "true",
        },
        name,
      );
      made.addEventListener("click", () => {
        act();
        save();
      });
      return made;
    };
    const flat = key("", "Straight on or in perspective", () =>
      change({ flat: !look().flat, ...(look().flat && !look().turn ? { turn: 25, rise: -12 } : {}) }),
    );
    const lit = key("", "Light of the hour or plain colours", () => session.set("lit", !session.lit));
    const bar = h(
      "div",
      { class: "fnb-tex-bar" },
      flat,
      lit,
      key("+", "Nearer", () => dolly(0.7)),
      key("−", "Further", () => dolly(1 / 0.7)),
      key("Reset", "Whole façade", home),
    );
    const slide = (
      label: string,
      low: number,
      high: number,
      step: number,
      get: () => number,
      set: (value: number) => void,
      show: (value: number) => string,
    ) => {
      const input = h("input", {
        type: "range",
        min: low,
        max: high,
        step,
        "aria-label": label,
        "data-lm-suppress-shortcuts": "true",
      });
      const value = h("output", {});
      input.addEventListener("input", () => set(Number(input.value)));
      session.hold(() => {
        if (Number(input.value) !== get()) input.value = String(get());
        setText(value, show(get()));
        mark(input, "aria-valuetext", show(get()));
      }, signal);
      return h("label", { class: "fnb-tex-slide" }, h("span", {}, label), input, value);
    };
    const metres = (value: number) => `${Number(value.toFixed(1))} m`;
    root.append(
      bar,
      h(
        "div",
        { class: "fnb-tex-slides" },
        slide(
          "Hour",
          0,
          24,
          0.25,
          () => session.hour,
          (value) => session.set("hour", value),
          (value) => `${Math.floor(value)}:${String(Math.round((value % 1) * 60)).padStart(2, "0")}`,
        ),
        slide(
          "Width",
          2,
          40,
          0.1,
          () => session.size[0],
          (value) => session.set("size", [value, session.size[1]]),
          metres,
        ),
        slide(
          "Height",
          2,
          40,
          0.1,
          () => session.size[1],
          (value) => session.set("size", [session.size[0], value]),
          metres,
        ),
        slide(
          "Seed",
          0,
          100,
          1,
          () => session.seed[0],
          (value) => session.set("seed", [value, value * 2]),
          String,
        ),
      ),
    );
    const buttons = () => {
      setText(flat, look().flat ? "Perspective" : "Straight on");
      setText(lit, session.lit ? "Plain colours" : "Light");
    };
    model.on("change:flat", buttons);
    signal.addEventListener("abort", () => model.off("change:flat", buttons));
    session.hold(buttons, signal);
  }
  return root;
}
