// The pipeline in the open: a row for each pass, with what it reads on its left and what it writes on its right; one of the
// buffers large, with the values under the pointer.

import { context } from "../pipeline/context.ts";
import type { Shown } from "../pipeline/pipeline.ts";
import { h, mark, setText } from "../shared/dom.ts";
import type { WidgetModel } from "../shared/types.ts";
import type { Session } from "./session.ts";
import { type Stage, stage } from "./stage.ts";
import { stillPicture } from "./still.ts";
import type { Buffer, Pass, Pixels } from "./types.ts";

const THUMB: Pixels = [176, 110];
const SAMPLES: Pixels = [32, 20];
const KINDS = { f1: "8 bits", f2: "16-bit floats", f4: "32-bit floats", i4: "whole numbers", depth: "depth, 24 bits" };
const SIGNED: Shown = { mode: 1, low: [-1, -1, -1, 0], high: [1, 1, 1, 1] };
const UNIT: Shown = { mode: 1, low: [0, 0, 0, 0], high: [1, 1, 1, 1] };

/** How buffers are made visible whose values are no colours; all others by their own range. */
const LOOKS: Record<string, Shown> = {
  place: { mode: 4, high: [3, 3, 3, 3] },
  rule: { mode: 2 },
  depth: { mode: 5 },
  facing: SIGNED,
  along: SIGNED,
  normal: SIGNED,
  color: UNIT,
  specular: UNIT,
  occlusion: { mode: 3, low: [0], high: [1] },
  softened: { mode: 3, low: [0], high: [1] },
  lamp_map: { mode: 3, low: [1], high: [0] },
  light: { mode: 1, low: [0, 0, 0, 0], high: [1.6, 1.6, 1.6, 1] },
  air: { mode: 1, low: [0, 0, 0, 0], high: [1.6, 1.6, 1.6, 1] },
  toned: { mode: 6 },
  picture: { mode: 6 },
  marked: { mode: 6 },
};

/** Between which values a buffer is shown: nearly all of its own. */
export function rangeOf(values: Float32Array, depth: boolean): Shown {
  const low: number[] = [];
  const high: number[] = [];
  for (let c = 0; c < 4; c += 1) {
    const own: number[] = [];
    for (let k = c; k < values.length; k += 4) {
      const value = values[k] as number;
      if (!depth || value < 1) own.push(value);
    }
    own.sort((a, b) => a - b);
    const at = (share: number) => own[Math.min(own.length - 1, Math.floor(share * own.length))] ?? 0;
    low.push(at(0.02));
    high.push(at(0.98));
  }
  return { mode: depth ? 3 : 1, low, high };
}

/** A number in few letters. */
export function brief(value: number): string {
  if (!Number.isFinite(value)) return String(value);
  const text =
    Math.abs(value) >= 1e5 || (value !== 0 && Math.abs(value) < 1e-3) ? value.toExponential(1) : value.toFixed(3);
  return text.includes("e") ? text : String(Number(text));
}

interface Thumb {
  el: HTMLElement;
  paper: CanvasRenderingContext2D | null;
  buffer: Buffer;
  about: HTMLElement;
  value: HTMLElement;
}

export function pipelineView(session: Session, model: WidgetModel, signal: AbortSignal): HTMLElement {
  const root = h("section", { class: "fnb-pipe", "aria-label": "Pipeline" });
  const { whyNot } = context();
  if (whyNot) {
    root.append(stillPicture(session, whyNot, signal));
    return root;
  }
  const off = () => model.get<string[]>("off");
  const ranges = new Map<string, Shown>();
  const thumbs = new Map<string, Thumb>();
  const minis: { name: string; paper: CanvasRenderingContext2D | null }[] = [];
  const cards = new Map<string, { el: HTMLElement; spent: HTMLElement }>();
  let pixels: Pixels = [1, 1];
  let shownPasses = "";

  const written = () => new Set(session.passes(off()).flatMap(({ writes }) => writes));
  const enlarged = (): string => {
    const name = model.get<string>("enlarged");
    const can = written();
    return can.has(name) ? name : (session.passes(off()).at(-1)?.writes[0] ?? "");
  };
  const lookOf = (name: string): Shown => LOOKS[name] ?? ranges.get(name) ?? UNIT;
  const made: Stage = stage(
    session,
    model,
    {
      off,
      shown: () => (session.pipeline ? [enlarged(), lookOf(enlarged())] : null),
      told({ pixels: now, spent, factor }) {
        pixels = now;
        draw(factor <= 3);
        for (const [name, milliseconds] of spent) {
          const card = cards.get(name);
          if (card) setText(card.spent, `${milliseconds < 10 ? milliseconds.toFixed(1) : Math.round(milliseconds)} ms`);
        }
      },
      clicked() {},
      escaped() {},
      changed() {},
    },
    signal,
  );
  const title = h("h4", {});
  const about = h("p", { class: "fnb-pipe-about" });
  const value = h(
    "p",
    { class: "fnb-pipe-value", role: "status" },
    "Move the pointer over the picture to read its values.",
  );
  const flow = h("div", { class: "fnb-pipe-flow", role: "list", "aria-label": "Passes" });
  root.append(
    h("div", { class: "fnb-pipe-top" }, made.el, h("div", { class: "fnb-pipe-caption" }, title, about, value)),
    flow,
  );

  const enlarge = (name: string) => {
    model.set("enlarged", name);
    session.kernel.save(model);
  };
  const light = (name: string | null) => {
    for (const own of root.querySelectorAll("[data-buffer]"))
      mark(own, "data-lit", name !== null && own.getAttribute("data-buffer") === name);
  };
  const watch = (el: HTMLElement, name: string) => {
    el.addEventListener("pointerenter", () => light(name));
    el.addEventListener("pointerleave", () => light(null));
    el.addEventListener("focus", () => light(name));
    el.addEventListener("blur", () => light(null));
    el.addEventListener("click", () => enlarge(name));
  };
  const paperOf = (wide: number, tall: number) => {
    const canvas = h("canvas", { width: wide, height: tall, "aria-hidden": "true" });
    return { canvas, paper: canvas.getContext("2d", { alpha: false, willReadFrequently: context().software }) };
  };
  const thumb = (buffer: Buffer): HTMLElement => {
    const { canvas, paper } = paperOf(...THUMB);
    const size = h("span", { class: "fnb-pipe-size" });
    const at = h("span", { class: "fnb-pipe-at" });
    const el = h(
      "button",
      {
        type: "button",
        class: "fnb-pipe-thumb",
        "data-local": true,
        "data-buffer": buffer.name,
        title: buffer.tells,
        "aria-label": `${buffer.name}: ${buffer.tells}`,
      },
      canvas,
      h("b", {}, buffer.name),
      size,
      at,
    );
    el.style.setProperty("--hue", String(hueOf(buffer.name)));
    watch(el, buffer.name);
    thumbs.set(buffer.name, { el, paper, buffer, about: size, value: at });
    return el;
  };
  const mini = (name: string): HTMLElement => {
    const { canvas, paper } = paperOf(56, 35);
    const el = h(
      "button",
      { type: "button", class: "fnb-pipe-mini", "data-local": true, "data-buffer": name, title: `Reads ${name}` },
      canvas,
      h("span", {}, name),
    );
    el.style.setProperty("--hue", String(hueOf(name)));
    watch(el, name);
    minis.push({ name, paper });
    return el;
  };
  /** Which passes are switched together with this one; none where others need it. */
  const together = (pass: Pass): string[] => {
    const all = session.head?.passes ?? [];
    if (pass.when) return all.filter(({ when }) => when === pass.when).map(({ name }) => name);
    return pass === all.at(-1) ? [pass.name] : [];
  };
  const row = (pass: Pass): HTMLElement => {
    const group = together(pass);
    const box = h("input", { type: "checkbox", "data-local": true, "aria-label": `Run ${pass.name}` });
    box.addEventListener("change", () => {
      const others = off().filter((name) => !group.includes(name));
      model.set("off", box.checked ? others : [...others, ...group]);
      session.kernel.save(model);
    });
    const spent = h("span", { class: "fnb-pipe-spent" });
    const { vertex, fragment } = pass;
    const card = h(
      "div",
      { class: "fnb-pipe-pass", "data-draws": pass.draws },
      h("div", { class: "fnb-pipe-name" }, group.length ? box : null, h("b", {}, pass.name), spent),
      h("p", {}, pass.tells),
      h("code", {}, pass.draws === "mesh" ? `${vertex} · ${fragment}` : fragment),
    );
    cards.set(pass.name, { el: card, spent });
    const reads = pass.reads.length
      ? pass.reads.map(mini)
      : [
          h("span", { class: "fnb-pipe-mesh" }, "the mesh"),
          h("span", { class: "fnb-pipe-mesh" }, pass.through.replace("_", ", ")),
        ];
    return h(
      "div",
      { class: "fnb-pipe-row", role: "listitem", "data-pass": pass.name },
      h("div", { class: "fnb-pipe-reads" }, ...reads),
      card,
      h(
        "div",
        { class: "fnb-pipe-writes" },
        // what a pass adds to is shown where it is first written
        ...pass.writes.map((name) =>
          pass.adds || pass.sky ? mini(name) : thumb(session.pipeline?.buffer(name) as Buffer),
        ),
      ),
    );
  };
  /** Draw what the buffers hold now; at rest their ranges are found anew. */
  const draw = (rested: boolean) => {
    const { pipeline } = session;
    if (!pipeline) return;
    const can = written();
    const large = enlarged();
    for (const [name, { el, paper, buffer, about: size }] of thumbs) {
      mark(el, "data-off", !can.has(name));
      mark(el, "aria-pressed", String(name === large));
      const [w, t] = pipeline.sizeOf(buffer, pixels);
      setText(size, can.has(name) ? `${w} × ${t} · ${buffer.channels} × ${KINDS[buffer.kind]}` : "not drawn");
      if (!can.has(name) || !paper) continue;
      if (!LOOKS[name] && (rested || !ranges.has(name))) {
        const values = pipeline.values(name, pixels, SAMPLES);
        if (values) ranges.set(name, rangeOf(values, buffer.kind === "depth"));
      }
      pipeline.show(name, pixels, paper, lookOf(name), null, THUMB);
    }
    for (const { name, paper } of minis) {
      const from = thumbs.get(name)?.paper?.canvas;
      if (from && paper) paper.drawImage(from, 0, 0, paper.canvas.width, paper.canvas.height);
    }
    const own = thumbs.get(large)?.buffer;
    setText(title, large);
    setText(about, own ? own.tells : "");
    mark(made.canvas, "data-buffer-shown", large);
  };
  let reading = 0;
  made.canvas.addEventListener("pointermove", (event) => {
    cancelAnimationFrame(reading);
    reading = requestAnimationFrame(() => read(event));
  });
  const read = (event: PointerEvent) => {
    const { pipeline } = session;
    if (!pipeline || context().lost) return;
    const box = made.canvas.getBoundingClientRect();
    const [u, v] = [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
    if (u < 0 || u >= 1 || v < 0 || v >= 1) return;
    const can = written();
    const large = enlarged();
    for (const [name, { buffer, value: at }] of thumbs) {
      if (!can.has(name) || (buffer.side && name !== large)) {
        setText(at, "");
        continue;
      }
      const [w, t] = pipeline.sizeOf(buffer, pixels);
      const [x, y] = [Math.floor(u * w), Math.floor(v * t)];
      const found = pipeline.values(name, pixels, [1, 1], [x, y]);
      const text = found ? [...found.slice(0, buffer.channels)].map(brief).join("  ") : "";
      setText(at, text);
      if (name === large) setText(value, `At ${x}, ${t - 1 - y}: ${text}`);
    }
  };
  const update = () => {
    const passes = session.pipeline?.passes.filter(({ when }) => when !== "chosen") ?? [];
    const key = passes.map(({ name }) => name).join("\n");
    if (key !== shownPasses) {
      shownPasses = key;
      thumbs.clear();
      minis.length = 0;
      cards.clear();
      flow.replaceChildren(...passes.map(row));
    }
    const runs = new Set(session.passes(off()).map(({ name }) => name));
    for (const [name, { el }] of cards) {
      mark(el, "data-off", !runs.has(name));
      const box = el.querySelector("input");
      if (box) box.checked = !off().includes(name);
    }
  };
  const changed = () => {
    update();
    if (session.drawable) made.paint.redraw();
  };
  for (const name of ["off", "enlarged"]) model.on(`change:${name}`, changed);
  signal.addEventListener("abort", () => {
    cancelAnimationFrame(reading);
    for (const name of ["off", "enlarged"]) model.off(`change:${name}`, changed);
  });
  session.hold(update, signal);
  return root;
}

/** A hue for a name: the same wherever the buffer stands. */
function hueOf(name: string): number {
  let sum = 7;
  for (const letter of name) sum = (sum * 31 + letter.charCodeAt(0)) % 3600;
  return (sum * 137) % 360;
}
