// The façade as a building: the picture, what is marked on it, the hour, and what is said where there is none.

import { context } from "../pipeline/context.ts";
import { h, mark, setText } from "../shared/dom.ts";
import { button } from "../shared/fields.ts";
import type { WidgetModel } from "../shared/types.ts";
import type { Context } from "../studio/common.ts";
import { fullScreen } from "../studio/screen.ts";
import { timeOf } from "../texture/controls.ts";
import { painting } from "../town/painting.ts";
import { BuildingData } from "./data.ts";
import { marking } from "./marking.ts";
import { BuildingScenery } from "./scenery.ts";
import { lookOf, type Steering, steering } from "./steering.ts";
import { keptPicture } from "./still.ts";

const MOST = 1_400_000; // pixels of a picture: what its buffers hold is a hundred times as many bytes
const COARSEST = 6; // of frames in motion: coarser, one does not see where one goes
const UNSEEN = 4000; // milliseconds after which a view that nobody sees gives back what it holds
const WATCHED = ["turn", "rise", "distance", "target", "hour"];

export function building(view: Context, model: WidgetModel): HTMLElement {
  const { store, signal } = view;
  const canvas = h("canvas", { class: "fnb-building-canvas", tabindex: 0, role: "img", "data-state": "empty" });
  const over = h("canvas", { class: "fnb-building-marks", "aria-hidden": "true" });
  const note = h("div", { class: "fnb-building-note", role: "status" });
  const tag = h("span", { class: "fnb-tag", hidden: true }, "Last good layout");
  const stage = h("div", { class: "fnb-building-stage" }, canvas, over, tag, note);
  const el = h("div", { class: "fnb-building" }, stage);
  const kept = keptPicture(canvas, model, store.kernel);
  stage.prepend(kept.el);

  const data = BuildingData.of(store.channel);
  const scenery = new BuildingScenery(data, () => ({ look: lookOf(model), hour: model.get<number>("hour") }));
  let failure = "";
  let shown = false; // whether somebody sees it
  let wanted = false;
  let leaving = 0;

  const say = () => {
    const { whyNot, lost } = context();
    const drawn = paint?.last !== null && paint !== null;
    const { busy, message } = store.get("status");
    const text =
      whyNot ||
      (lost
        ? "The browser has taken the graphics card away; the picture comes back with it."
        : failure ||
          (drawn || kept.shown
            ? ""
            : !store.live
              ? "There is no kernel to build this view: run the cell again."
              : store.get("svg") === ""
                ? message || (busy ? "Solving …" : "Nothing to show yet.")
                : scenery.pipeline && !scenery.pipeline.ready()
                  ? "Compiling shaders …"
                  : "Building the 3D view …"));
    setText(note, text);
    note.hidden = text === "";
    mark(note, "data-over", text !== "" && (drawn || kept.shown));
  };
  const failed = (message: string) => {
    failure = message;
    say();
  };

  // ---- painting ----------------------------------------------------------------------------------------------------

  const paint = context().whyNot
    ? null
    : painting(canvas, scenery, {
        coarsest: COARSEST,
        told({ milliseconds, factor }) {
          failure = "";
          kept.hide();
          mark(canvas, "data-milliseconds", `${Math.round(milliseconds)} 1:${factor}`);
          marks.show(true);
          say();
        },
        failed,
        rested: () => void scenery.arrange(),
        stated() {
          state();
          if (!paint?.done) return;
          kept.keep();
          marks.show();
        },
      });
  /** `moving`: it is being drawn; `loading`: finer tiles are on their way; `sharp`: it will stay as it is. */
  const state = () => {
    const now = !paint?.done ? "moving" : scenery.settled ? "sharp" : "loading";
    mark(canvas, "data-state", paint?.last ? now : "empty");
  };
  const marks = marking(view, { canvas, over, data, scenery, painting: () => paint });
  const redraw = () => {
    if (paint && shown) paint.redraw();
  };
  const resize = () => {
    const [wide, tall] = [stage.clientWidth, stage.clientHeight];
    if (!wide || !tall) return;
    const dense = Math.min(window.devicePixelRatio || 1, 2, Math.sqrt(MOST / (wide * tall)));
    const [width, height] = [Math.round(wide * dense), Math.round(tall * dense)];
    if (canvas.width === width && canvas.height === height) return;
    kept.show(); // a canvas that is resized is empty
    canvas.width = width;
    canvas.height = height;
    scenery.wide = width;
    scenery.aspect = width / height;
    redraw();
  };
  const update = () => {
    const what = shown ? scenery.take() : null;
    if (what === "mesh") {
      marks.hover(null);
      redraw();
    } else if (what === "tiles") paint?.refresh();
    state();
    say();
  };
  const want = (on: boolean) => {
    if (on === wanted || !store.live) return;
    wanted = on;
    store.ask({ op: "want", what: "building", on });
  };
  /** Somebody sees it, or does no more. */
  const show = (on: boolean) => {
    clearTimeout(leaving);
    if (on) {
      shown = true;
      want(true);
      resize();
      update();
      if (!paint?.done) redraw();
    } else if (shown) {
      leaving = window.setTimeout(() => {
        shown = false;
        paint?.stop();
        scenery.drop();
        want(false);
      }, UNSEEN);
    }
  };

  // ---- controls ----------------------------------------------------------------------------------------------------

  const steer: Steering = steering(
    canvas,
    model,
    {
      body: () => scenery.body,
      aspect: () => scenery.aspect,
      meet: (across, up) => marks.meet(across, up)?.point ?? null,
      clicked(across, up) {
        const shape = marks.meet(across, up)?.shape ?? -1;
        const wall = marks.wallOf(shape);
        if (wall >= 0) store.ask({ op: "wall", wall });
        else store.ask(shape >= 0 ? { op: "select", shape } : { op: "select" });
      },
      hovered: marks.hover,
      save: () => store.kernel.save(model),
    },
    signal,
  );
  stage.append(
    hourSlider(model, () => store.kernel.save(model), signal),
    tools(steer, view),
  );

  const describe = () =>
    mark(
      canvas,
      "aria-label",
      `The façade as a building at ${timeOf(model.get<number>("hour"))}. Drag or arrow keys go around it, with Shift they ` +
        "move it, wheel or plus and minus come nearer, 0 shows all of it; a click picks a shape.",
    );
  const changed = () => {
    describe();
    redraw();
  };
  describe();
  for (const name of WATCHED) model.on(`change:${name}`, changed);
  store.watch(["status", "svg"], () => {
    const { stale } = store.get("status");
    tag.hidden = !stale;
    mark(stage, "data-stale", stale);
    say();
  });
  context().watch((lost) => {
    say();
    if (!lost) redraw();
  }, signal);
  store.kernel.watch(() => {
    wanted = false; // a kernel that has come back may not know
    if (shown) want(true);
    say();
  }, signal);
  const sized = new ResizeObserver(resize);
  sized.observe(stage);
  const sight = new IntersectionObserver((entries) => show(entries.at(-1)?.isIntersecting ?? false), {
    rootMargin: "200px",
  });
  sight.observe(stage);
  data.hold(update, signal);
  signal.addEventListener("abort", () => {
    sized.disconnect();
    sight.disconnect();
    clearTimeout(leaving);
    paint?.stop();
    scenery.drop();
    kept.end();
    for (const name of WATCHED) model.off(`change:${name}`, changed);
  });
  return el;
}

function tools(steer: Steering, context: Context): HTMLElement {
  return h(
    "div",
    { class: "fnb-stage-tools", role: "toolbar", "aria-label": "View of the building", "data-local": true },
    button("Further (−)", "minus", () => steer.zoom(1 / 0.75)),
    button("Nearer (+)", "plus", () => steer.zoom(0.75)),
    button("The whole building (0)", "fit", steer.home),
    fullScreen(context),
  );
}

/** The hour of the day. */
function hourSlider(model: WidgetModel, save: () => void, signal: AbortSignal): HTMLElement {
  const input = h("input", { type: "range", min: 0, max: 24, step: 0.25, "aria-label": "Hour", "data-local": true });
  const value = h("output", {});
  const show = () => {
    const hour = model.get<number>("hour");
    if (Number(input.value) !== hour) input.value = String(hour);
    setText(value, timeOf(hour));
    mark(input, "aria-valuetext", timeOf(hour));
  };
  input.addEventListener("input", () => model.set("hour", Number(input.value)));
  input.addEventListener("change", save);
  model.on("change:hour", show);
  signal.addEventListener("abort", () => model.off("change:hour", show));
  show();
  return h("label", { class: "fnb-building-hour", "data-local": true }, h("span", {}, "Hour"), input, value);
}
