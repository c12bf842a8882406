// The façade, straight: the photograph below, rectangles above; drawn, moved, resized and copied by hand or by keys.

import { h, mark, svg } from "../shared/dom.ts";
import type { WidgetModel } from "../shared/types.ts";
import { corners } from "./corners.ts";
import { cssOf, projection } from "./homography.ts";
import type { Session } from "./session.ts";
import { edges, LEAST, moved, nearest, next, resized, SIDES, type Side, tidy } from "./snapping.ts";
import type { Drawn, Opening, Point, Rect } from "./types.ts";

const REACH = 8; // pixels within which edges snap
const STILL = 3; // pixels up to which a press is a click
const STEP = 0.01; // metres of a key
/** Handles: which sides each of them moves, and where it stands, 0 to 1 from the upper left. */
const HANDLES: readonly [sides: Side[], x: number, y: number][] = [
  [[0, 3], 0, 0],
  [[3], 0.5, 0],
  [[2, 3], 1, 0],
  [[2], 1, 0.5],
  [[1, 2], 1, 1],
  [[1], 0.5, 1],
  [[0, 1], 0, 1],
  [[0], 0, 0.5],
];
const CURSORS = ["nwse", "ns", "nesw", "ew", "nwse", "ns", "nesw", "ew"];

/** What the hand is at, until it is let go. */
interface Held {
  what: "draw" | "move" | "copy" | Side[];
  from: Point;
  before: Rect;
  shown: Opening;
  far: boolean;
}

export function stage(session: Session, model: WidgetModel, signal: AbortSignal): HTMLElement {
  const photo = h("img", { class: "fnb-sur-photo", alt: "", draggable: "false", hidden: true });
  const shapes = svg("g", {});
  const guides = svg("g", { class: "fnb-sur-guides" });
  const grips = svg("g", { class: "fnb-sur-grips" });
  const placed = corners(session);
  const canvas = svg(
    "svg",
    { class: "fnb-sur-canvas", tabindex: 0, role: "application" },
    shapes,
    guides,
    grips,
    placed.el,
  );
  const hint = h("p", { class: "fnb-sur-hint" });
  const paper = h("div", { class: "fnb-sur-paper" }, photo, canvas);
  const el = h("div", { class: "fnb-sur-stage" }, paper, hint);
  canvas.setAttribute("data-lm-suppress-shortcuts", "true");
  let held: Held | null = null;
  let scale = 1; // pixels of a metre
  let lines: { axis: 0 | 1; at: number }[] = [];

  const size = (): Point => {
    const { width, height } = session.drawn;
    const most = model.get<number>("height");
    const wide = Math.max(120, el.clientWidth);
    if (session.cornering) {
      const by = Math.min(wide / Math.max(1, photo.naturalWidth), most / Math.max(1, photo.naturalHeight));
      return [photo.naturalWidth * by, photo.naturalHeight * by];
    }
    scale = Math.min(wide / width, most / height);
    return [width * scale, height * scale];
  };

  /** The photograph as the façade is seen straight on; while corners are placed, as it is. */
  const place = ([wide, high]: Point) => {
    const [w, t] = [photo.naturalWidth, photo.naturalHeight];
    photo.hidden = !session.photo || !w;
    if (photo.hidden) return;
    const own = session.drawn.corners;
    const all: Point[] = [
      [0, t],
      [w, t],
      [w, 0],
      [0, 0],
    ];
    const from = session.cornering || own.length !== 4 ? all : own.map(([x, y]): Point => [x * w, y * t]);
    const made = projection(from, [
      [0, high],
      [wide, high],
      [wide, 0],
      [0, 0],
    ]);
    photo.style.transform = made ? cssOf(made) : "none";
  };

  const boxOf = ([left, bottom, right, top]: Rect) => ({
    x: left * scale,
    y: (session.drawn.height - top) * scale,
    width: (right - left) * scale,
    height: (top - bottom) * scale,
  });

  const update = () => {
    if (photo.src !== session.photo && session.photo) photo.src = session.photo;
    const [wide, high] = size();
    for (const [name, value] of Object.entries({ width: wide, height: high, viewBox: `0 0 ${wide} ${high}` }))
      mark(canvas, name, String(value));
    paper.style.width = `${wide}px`;
    paper.style.height = `${high}px`;
    place([wide, high]);
    mark(el, "data-cornering", session.cornering);
    placed.update([wide, high]);
    const { drawn } = session;
    const openings = drawn.openings.map((own, k) =>
      held?.far && k === session.picked && held.what !== "draw" && held.what !== "copy" ? held.shown : own,
    );
    if (held?.far && (held.what === "draw" || held.what === "copy")) openings.push(held.shown);
    shapes.replaceChildren(
      ...(session.cornering ? [] : openings).map(({ kind, rect }, k) => {
        const picked = k === session.picked;
        const own = svg("rect", { ...boxOf(rect), "data-opening": k, "data-kind": kind, "data-picked": picked });
        own.append(svg("title", {}, `${kind} ${k + 1}`));
        return own;
      }),
    );
    const picked = held?.far ? held.shown : session.opening;
    grips.replaceChildren(
      ...(picked && session.open && !session.cornering && held?.what !== "draw" ? HANDLES : []).map(([, x, y], k) => {
        const box = boxOf((picked as Opening).rect);
        const place = { x: box.x + x * box.width - 4, y: box.y + y * box.height - 4, width: 8, height: 8 };
        return svg("rect", { ...place, "data-grip": k, style: `cursor:${CURSORS[k]}-resize` });
      }),
    );
    guides.replaceChildren(
      ...lines.map(({ axis, at }) =>
        axis === 0
          ? svg("line", { x1: at * scale, x2: at * scale, y1: 0, y2: high })
          : svg("line", { y1: high - at * scale, y2: high - at * scale, x1: 0, x2: wide }),
      ),
    );
    mark(canvas, "aria-label", described(session));
    const empty = !session.photo ? "Open a photograph, or draw on the empty wall. " : "";
    hint.textContent = session.cornering
      ? "Drag the four points to the corners of the façade (arrow keys move the one that has the focus), then say how wide and high it is."
      : drawn.openings.length
        ? ""
        : `${empty}Drag a rectangle for each window and door; W and D put one by the keyboard.`;
    hint.hidden = hint.textContent === "";
  };

  // ---- by hand ------------------------------------------------------------------------------------------------------

  const at = (event: PointerEvent): Point => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / scale, session.drawn.height - (event.clientY - box.top) / scale];
  };
  /** How far a rectangle goes so that some of its sides snap; the lines it snaps to are shown. */
  const snapped = (rect: Rect, sides: readonly Side[], free: boolean): Point => {
    lines = [];
    const shift: Point = [0, 0];
    for (const axis of [0, 1] as const) {
      const own = SIDES[axis]?.filter((side) => sides.includes(side)).map((side) => rect[side]) ?? [];
      const without = held?.what === "copy" || held?.what === "draw" ? -1 : session.picked;
      const found = free ? null : nearest(own, edges(session.drawn, axis, without), REACH / scale);
      if (found === null) continue;
      shift[axis] = found;
      const met = edges(session.drawn, axis, without);
      for (const place of own)
        if (met.some((line) => Math.abs(line - place - found) < 1e-6)) lines.push({ axis, at: place + found });
    }
    return shift;
  };
  const drag = (event: PointerEvent) => {
    if (!held) return;
    const { drawn } = session;
    const now = at(event);
    const [dx, dy] = [now[0] - held.from[0], now[1] - held.from[1]];
    held.far ||= Math.hypot(dx, dy) * scale > STILL;
    if (!held.far) return;
    const free = event.ctrlKey || event.metaKey;
    let rect: Rect;
    if (held.what === "draw") {
      const [x, y] = held.from;
      rect = [Math.min(x, now[0]), Math.min(y, now[1]), Math.max(x, now[0]), Math.max(y, now[1])];
      const sides: Side[] = [now[0] < x ? 0 : 2, now[1] < y ? 1 : 3];
      const shift = snapped(rect, sides, free);
      rect = resized(
        rect,
        {
          [sides[0] as Side]: rect[sides[0] as Side] + shift[0],
          [sides[1] as Side]: rect[sides[1] as Side] + shift[1],
        },
        drawn,
      );
    } else if (held.what === "move" || held.what === "copy") {
      rect = moved(held.before, dx, dy, drawn);
      rect = moved(rect, ...snapped(rect, [0, 1, 2, 3], free), drawn);
    } else {
      const { what, before } = held;
      const put = (by: Point) =>
        Object.fromEntries(what.map((side) => [side, before[side] + (by[side % 2] as number)]));
      rect = resized(before, put([dx, dy]), drawn);
      const shift = snapped(rect, what, free);
      rect = resized(
        rect,
        Object.fromEntries(what.map((side) => [side, rect[side] + (shift[side % 2] as number)])),
        drawn,
      );
    }
    held.shown = { ...held.shown, rect };
    update();
  };
  const drop = () => {
    const done = held;
    held = null;
    lines = [];
    if (done?.far) {
      if (done.what === "draw") session.add(done.shown);
      else if (done.what === "copy") session.copied(done.shown, done.before);
      else session.edit(session.picked, done.shown);
    } else if (done?.what === "draw") session.pick(-1);
    update();
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || session.cornering) return;
    const target = event.target as Element;
    const grip = HANDLES[Number(target.getAttribute("data-grip") ?? Number.NaN)];
    const number = target.getAttribute("data-opening");
    if (number !== null) session.pick(Number(number));
    if (!session.open) return;
    const from = at(event);
    const own = session.opening;
    const what = grip ? grip[0] : number !== null ? (event.altKey ? "copy" : "move") : "draw";
    const start = draft(from, session.drawn);
    const before = what === "draw" || !own ? start : own.rect;
    const kind = what === "draw" || !own ? session.kind : own.kind;
    held = {
      what,
      from: what === "draw" ? corner(from, session.drawn) : from,
      before,
      shown: { kind, rect: before },
      far: false,
    };
    if (what === "draw") {
      const shift = snapped(start, [0, 1], event.ctrlKey || event.metaKey);
      held.from = [held.from[0] + shift[0], held.from[1] + shift[1]];
      lines = [];
    }
    canvas.setPointerCapture(event.pointerId);
    canvas.focus({ preventScroll: true });
    event.preventDefault();
  });
  canvas.addEventListener("pointermove", drag);
  canvas.addEventListener("pointerup", drop);
  canvas.addEventListener("pointercancel", () => {
    held = null;
    lines = [];
    update();
  });

  // ---- by keys ------------------------------------------------------------------------------------------------------

  const arrow = (axis: 0 | 1, direction: 1 | -1, event: KeyboardEvent) => {
    const { drawn, opening: own } = session;
    if (!own) return;
    const [low, high] = SIDES[axis] as readonly [Side, Side];
    const toEdge = event.ctrlKey || event.metaKey;
    const sides = event.shiftKey ? [high] : [low, high];
    const by = toEdge
      ? next(
          sides.map((side) => own.rect[side]),
          edges(drawn, axis, session.picked),
          direction,
        )
      : direction * STEP;
    const rect = event.shiftKey
      ? resized(own.rect, { [high]: own.rect[high] + by }, drawn)
      : moved(own.rect, axis ? 0 : by, axis ? by : 0, drawn);
    session.edit(session.picked, { rect }, `${session.picked} ${event.shiftKey ? "size" : "place"} ${axis}`);
  };
  const put = (kind: Opening["kind"]) => {
    const { drawn } = session;
    const like = session.opening?.kind === kind ? session.opening : drawn.openings.findLast((own) => own.kind === kind);
    const [wide, high] = like
      ? [like.rect[2] - like.rect[0], like.rect[3] - like.rect[1]]
      : kind === "door"
        ? [1, 2.1]
        : [1, 1.4];
    const bottom = kind === "door" ? 0 : like ? like.rect[1] : 0.9;
    const left = (drawn.width - wide) / 2;
    session.kind = kind;
    session.add({ kind, rect: moved(resized([left, bottom, left + wide, bottom + high], {}, drawn), 0, 0, drawn) });
  };
  const KEYS: Record<string, (event: KeyboardEvent) => void> = {
    ArrowLeft: (event) => arrow(0, -1, event),
    ArrowRight: (event) => arrow(0, 1, event),
    ArrowDown: (event) => arrow(1, -1, event),
    ArrowUp: (event) => arrow(1, 1, event),
    w: () => put("window"),
    d: () => put("door"),
    c: () => session.copy(),
    k: () =>
      session.opening && session.edit(session.picked, { kind: session.opening.kind === "door" ? "window" : "door" }),
    Delete: () => session.remove(),
    Backspace: () => session.remove(),
  };
  const go = (by: number) => {
    const count = session.drawn.openings.length;
    if (count) session.pick((session.picked + by + (session.picked < 0 && by < 0 ? 1 : 0) + count) % count);
  };
  canvas.addEventListener("keydown", (event) => {
    if (event.target !== canvas || session.cornering || event.altKey) return;
    const chord = event.ctrlKey || event.metaKey;
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (name === "PageDown" || name === "n") go(1);
    else if (name === "PageUp" || name === "p") go(-1);
    else if (name === "Escape" && (held || session.picked >= 0)) {
      held = null;
      lines = [];
      session.pick(-1);
      update();
    } else if (KEYS[name] && (!chord || name.startsWith("Arrow"))) KEYS[name]?.(event);
    else return;
    event.preventDefault();
    event.stopPropagation();
  });

  photo.addEventListener("load", () => session.redraw());
  const sized = new ResizeObserver(update);
  sized.observe(el);
  signal.addEventListener("abort", () => sized.disconnect());
  session.hold(update, signal);
  model.on("change:height", update);
  signal.addEventListener("abort", () => model.off("change:height", update));
  update();
  return el;
}

/** A point kept on the façade. */
function corner([x, y]: Point, { width, height }: Drawn): Point {
  return [Math.min(Math.max(x, 0), width), Math.min(Math.max(y, 0), height)];
}

function draft(from: Point, drawn: Drawn): Rect {
  const [x, y] = corner(from, drawn);
  return tidy([x, y, x + LEAST, y + LEAST]);
}

function described(session: Session): string {
  const { openings, width, height } = session.drawn;
  const own = session.opening;
  const told = own
    ? `${own.kind} ${session.picked + 1} of ${openings.length}, from ${own.rect[0].toFixed(2)} across and ${own.rect[1].toFixed(2)} up, ` +
      `${(own.rect[2] - own.rect[0]).toFixed(2)} by ${(own.rect[3] - own.rect[1]).toFixed(2)} metres`
    : `${openings.length} openings, none picked`;
  return (
    `Façade of ${width.toFixed(2)} by ${height.toFixed(2)} metres: ${told}. W adds a window, D a door, C copies, Delete removes, ` +
    "N and P pick; arrow keys move, with Shift they resize, with Ctrl they go to the next edge."
  );
}
