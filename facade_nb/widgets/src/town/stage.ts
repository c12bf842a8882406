// The canvas that the town is seen in, with what is told over it.

import { context } from "../pipeline/context.ts";
import type { Shown } from "../pipeline/pipeline.ts";
import { h, mark, setText } from "../shared/dom.ts";
import type { WidgetModel } from "../shared/types.ts";
import { timeOf } from "../texture/controls.ts";
import { type Flying, flying } from "./flying.ts";
import { type Painting, painting, type Told } from "./painting.ts";
import type { Session } from "./session.ts";

const TALLEST = 640; // pixels of the page
const STEPS = 16; // how often it is drawn anew while the town is on its way
const MOST = 1_400_000; // pixels of a picture: what its buffers hold is a hundred times as many bytes

export interface Stage {
  el: HTMLElement;
  canvas: HTMLCanvasElement;
  fly: Flying;
  paint: Painting;
}

interface Options {
  off?: () => readonly string[];
  shown?: () => [name: string, shown: Shown] | null;
  told?: (told: Told) => void;
  clicked: (across: number, up: number) => void;
  escaped: () => void;
  changed: () => void;
}

export function stage(session: Session, model: WidgetModel, options: Options, signal: AbortSignal): Stage {
  const canvas = h("canvas", { class: "fnb-town-canvas", tabindex: 0, role: "img", "data-state": "empty" });
  const note = h("div", { class: "fnb-town-note", role: "status" });
  const told = h("div", { class: "fnb-town-told", "aria-hidden": "true" });
  const el = h("div", { class: "fnb-town-stage" }, canvas, told, note);
  let failure = "";
  let [drawn, come] = ["", ""];

  const say = () => {
    const loaded = session.loading.part;
    const text = context().lost
      ? "The browser has taken the graphics card away; the picture comes back with it."
      : failure ||
        (session.trouble && !session.head
          ? session.trouble
          : !session.head
            ? session.live
              ? "Reading the town …"
              : "This saved page holds no town: run the notebook to see it."
            : !session.drawable
              ? "The town is on its way …"
              : session.pipeline?.ready() === false
                ? "Compiling shaders …"
                : loaded < 1 && session.live
                  ? `${Math.round(100 * loaded)} % of the town is here …`
                  : "");
    setText(note, text);
    note.hidden = text === "";
    mark(note, "data-over", (failure !== "" || context().lost) && paint.last !== null);
    mark(note, "data-small", session.drawable && !failure && !context().lost);
    mark(canvas, "data-loaded", loaded.toFixed(3));
  };
  const tell = (own: Told) => {
    const {
      milliseconds,
      pixels: [w, t],
      factor,
    } = own;
    failure = "";
    const coarse = factor === 1 ? "" : `, 1 : ${factor}`;
    const spent = milliseconds < 1000 ? `${Math.round(milliseconds)} ms` : `${(milliseconds / 1000).toFixed(1)} s`;
    setText(told, `${spent} · ${w} × ${t}${coarse}`);
    say();
    options.told?.(own);
  };
  const failed = (message: string) => {
    failure = message;
    say();
  };
  /** What has come of the same town. */
  const more = () => [session.finer, Math.floor(session.loading.part * STEPS)].join();
  const rested = () => {
    const changed = session.arrange();
    come = more();
    if (changed) session.tell(); // other views of it
  };
  const paint = painting(canvas, session, { ...options, told: tell, failed, rested, stated: () => state() });
  const fly = flying(canvas, session, options, signal);

  /** `moving`: it is being drawn; `loading`: what it shows has not come as a whole; `sharp`: it will stay as it is. */
  const state = () => {
    const now = !paint.done ? "moving" : session.settled ? "sharp" : "loading";
    mark(canvas, "data-state", paint.last ? now : "empty");
  };
  const resize = () => {
    const wide = el.clientWidth;
    if (!wide) return;
    const tall = model.get<number>("height") || Math.round(Math.min(TALLEST, wide * 0.6));
    canvas.style.height = `${tall}px`;
    const dense = Math.min(window.devicePixelRatio || 1, 2, Math.sqrt(MOST / (wide * tall)));
    const [width, height] = [Math.round(wide * dense), Math.round(tall * dense)];
    if (canvas.width === width && canvas.height === height) return;
    canvas.width = width;
    canvas.height = height;
    session.wide = Math.max(session.wide, width);
    drawn = "";
  };
  const update = () => {
    resize();
    mark(
      canvas,
      "aria-label",
      `Town at ${timeOf(session.hour)}. W, A, S, D or arrow keys fly, Q and E down and up, Shift faster; Enter chooses ` +
        "the building in the middle, Home goes to the first view.",
    );
    const { head } = session;
    const small = head ? Math.max(head.sunlight.side, ...Object.values(head.textures).flatMap(({ size }) => size)) : 0;
    const why = small ? context().tooSmall(small) : "";
    if (why) failure = why;
    const now = [session.hour, session.chosen, session.drawable, canvas.width, canvas.height, session.touched].join();
    if (!why && (now !== drawn || more() !== come)) {
      if (head && session.drawable && now !== drawn) paint.redraw();
      else if (head && session.drawable) paint.refresh();
      [drawn, come] = [now, more()];
    }
    state();
    say();
  };
  const watching = new ResizeObserver(update);
  watching.observe(el);
  session.onMove(paint.redraw, signal);
  context().watch((lost) => {
    say();
    if (!lost) paint.redraw();
  }, signal);
  signal.addEventListener("abort", () => {
    watching.disconnect();
    paint.stop();
  });
  session.hold(update, signal);
  return { el, canvas, fly, paint };
}
