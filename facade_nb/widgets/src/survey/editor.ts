// The editor of a survey: a bar, the façade, and the numbers of what is picked.

import { h, mark, setText } from "../shared/dom.ts";
import { button, formatNumber } from "../shared/fields.ts";
import { type IconName, icon } from "../shared/icons.ts";
import type { WidgetModel } from "../shared/types.ts";
import { download, fileName } from "../studio/files.ts";
import { cornersOf } from "./corners.ts";
import type { Session } from "./session.ts";
import { moved, resized } from "./snapping.ts";
import { stage } from "./stage.ts";
import type { Rect } from "./types.ts";

export function editor(session: Session, model: WidgetModel, signal: AbortSignal): HTMLElement {
  const undo = button("Undo (Ctrl+Z)", "undo", () => session.ask("undo"));
  const redo = button("Redo (Ctrl+Shift+Z)", "redo", () => session.ask("redo"));
  const glazed = kindButton(session, "window");
  const door = kindButton(session, "door");
  const straight = worded("Corners", "fit", () => {
    if (!session.cornering && session.drawn.corners.length !== 4) session.change({ corners: cornersOf(session) });
    session.corner(!session.cornering);
  });
  straight.title = "Place the four corners of the façade in the photograph";
  const picture = picker("image/*", (file) => {
    session.show(file);
    if (session.drawn.corners.length !== 4) session.corner(true);
  });
  const survey = picker(".json,.gml,.xml,application/json", async (file) => session.openFile(await file.text()));
  const photo = worded("Photo", "photo", () => picture.click());
  photo.title = "Open a photograph; it stays in this page";
  photo.dataset.local = "true";
  const openFile = worded("Open", "open", () => survey.click());
  const save = worded("Save", "save", () => {
    const { name } = session.drawn;
    download(`${fileName(name || "survey")}.json`, fileText(session));
  });
  save.dataset.local = "true";
  const bar = h(
    "div",
    { class: "fnb-sur-bar", role: "toolbar", "aria-label": "Survey" },
    undo,
    redo,
    h("span", { class: "fnb-sur-line" }),
    photo,
    straight,
    openFile,
    save,
    h("span", { class: "fnb-sur-gap" }),
    h("span", { class: "fnb-sur-kinds", role: "group", "aria-label": "Draw a" }, glazed, door),
    picture,
    survey,
  );

  // ---- numbers ------------------------------------------------------------------------------------------------------

  const side = (label: string, get: () => number | undefined, put: (value: number) => void) =>
    field(session, label, get, put, signal);
  const rectOf = () => session.opening?.rect;
  const edit = (change: (rect: Rect, value: number) => Rect) => (value: number) => {
    const rect = rectOf();
    if (rect) session.edit(session.picked, { rect: change(rect, value) });
  };
  const wall = h(
    "div",
    { class: "fnb-sur-fields" },
    h("strong", {}, "Façade"),
    side(
      "Width",
      () => session.drawn.width,
      (width) => session.change({ width: least(width, session, 0) }),
    ),
    side(
      "Height",
      () => session.drawn.height,
      (height) => session.change({ height: least(height, session, 1) }),
    ),
  );
  const title = h("strong", {});
  const copy = button("Copy (C)", "copy", () => session.copy());
  const remove = button("Remove (Delete)", "close", () => session.remove());
  const axis = h(
    "select",
    { class: "fnb-select", "aria-label": "Known length" },
    h("option", { value: "x" }, "width"),
    h("option", { value: "y" }, "height"),
  );
  const known = h("input", {
    type: "text",
    inputmode: "decimal",
    class: "fnb-number",
    "aria-label": "True length, metres",
  });
  const scale = worded("Scale", "tune", () => {
    const rect = rectOf();
    const value = Number(known.value.replace(",", "."));
    if (!rect || !(value > 0)) return;
    const x = axis.value === "x";
    session.scale(axis.value as "x" | "y", x ? rect[2] - rect[0] : rect[3] - rect[1], value);
    known.value = "";
  });
  scale.title = "Make the façade so large that this length is true";
  known.addEventListener("keydown", (event) => {
    if (event.key !== "Enter") return;
    event.preventDefault();
    scale.click();
  });
  const own = h(
    "div",
    { class: "fnb-sur-fields" },
    title,
    side(
      "Left",
      () => rectOf()?.[0],
      edit((rect, value) => moved(rect, value - rect[0], 0, session.drawn)),
    ),
    side(
      "Sill",
      () => rectOf()?.[1],
      edit((rect, value) => moved(rect, 0, value - rect[1], session.drawn)),
    ),
    side(
      "Width",
      () => width(rectOf(), 0),
      edit((rect, value) => resized(rect, { 2: rect[0] + value }, session.drawn)),
    ),
    side(
      "Height",
      () => width(rectOf(), 1),
      edit((rect, value) => resized(rect, { 3: rect[1] + value }, session.drawn)),
    ),
    copy,
    remove,
    h("span", { class: "fnb-sur-known" }, h("span", {}, "True"), axis, known, h("span", {}, "m"), scale),
  );
  for (const one of own.querySelectorAll<HTMLElement>("label")) one.dataset.own = "";
  const said = h("div", { class: "fnb-sur-said", role: "status" });
  const trouble = h("pre", { class: "fnb-sur-trouble", role: "alert", hidden: true });

  session.hold(update, signal);
  function update() {
    const { drawn, opening, open } = session;
    undo.disabled = !open || !session.canUndo;
    redo.disabled = !open || !session.canRedo;
    straight.hidden = !session.photo;
    mark(straight, "aria-pressed", String(session.cornering));
    for (const [one, kind] of [
      [glazed, "window"],
      [door, "door"],
    ] as const)
      mark(one, "aria-pressed", String(session.kind === kind));
    for (const one of [straight, openFile, glazed, door, copy, remove, scale]) one.disabled = !open;
    own.hidden = !opening;
    setText(title, opening ? `${opening.kind === "door" ? "Door" : "Window"} ${session.picked + 1}` : "");
    const doors = drawn.openings.filter(({ kind }) => kind === "door").length;
    const windows = drawn.openings.length - doors;
    setText(said, `${count(windows, "window")}, ${count(doors, "door")}`);
    trouble.textContent = session.trouble;
    trouble.hidden = !session.trouble;
  }
  const made = h(
    "div",
    {},
    bar,
    stage(session, model, signal),
    h("div", { class: "fnb-sur-foot" }, wall, own, said),
    trouble,
  );
  update();
  return made;
}

function count(many: number, noun: string): string {
  return `${many} ${noun}${many === 1 ? "" : "s"}`;
}

/** An extent of the façade: openings stay on it. */
function least(value: number, session: Session, axis: 0 | 1): number {
  return Math.max(value, ...session.drawn.openings.map(({ rect }) => rect[axis === 0 ? 2 : 3]));
}

function width(rect: Rect | undefined, axis: 0 | 1): number | undefined {
  return rect && rect[axis + 2] !== undefined ? (rect[axis + 2] as number) - (rect[axis] as number) : undefined;
}

/** The text of the file, as facade_nb/widgets/survey/model.py writes it. */
function fileText(session: Session): string {
  const { name, corners, key: _, ...rest } = session.drawn;
  const facade = { building: name || "facade", ...rest, ...(corners.length ? { corners } : {}) };
  return `${JSON.stringify({ facades: [facade] }, null, 1)}\n`;
}

function worded(label: string, name: IconName, action: () => void): HTMLButtonElement {
  const made = h("button", { type: "button", class: "fnb-button fnb-wide" }, icon(name), label);
  made.addEventListener("click", action);
  return made;
}

function kindButton(session: Session, kind: "window" | "door"): HTMLButtonElement {
  const made = h(
    "button",
    { type: "button", class: "fnb-sur-kind", "data-kind": kind },
    kind === "door" ? "Door" : "Window",
  );
  made.addEventListener("click", () => {
    session.kind = kind;
    if (session.opening) session.edit(session.picked, { kind });
    else session.redraw();
  });
  return made;
}

function picker(accept: string, take: (file: File) => void): HTMLInputElement {
  const input = h("input", { type: "file", accept, hidden: true, "data-local": true, tabindex: -1 });
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    if (file) take(file);
    input.value = "";
  });
  return input;
}

/** A number of metres: taken over by Enter or when the field is left. */
function field(
  session: Session,
  label: string,
  get: () => number | undefined,
  put: (value: number) => void,
  signal: AbortSignal,
): HTMLElement {
  const input = h("input", {
    type: "text",
    inputmode: "decimal",
    class: "fnb-number",
    "aria-label": label,
    autocomplete: "off",
  });
  const shown = () => formatNumber(get(), 3);
  const show = () => {
    if (session.kernel.presence === "saved") input.readOnly = true;
    if (!input.matches(":focus") || input.readOnly) input.value = shown();
  };
  const commit = () => {
    const value = Number(input.value.replace(",", "."));
    if (input.value.trim() !== "" && input.value !== shown() && Number.isFinite(value) && value >= 0 && !input.readOnly)
      put(value);
    input.value = shown();
  };
  input.addEventListener("blur", commit);
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") {
      event.preventDefault();
      commit();
    } else if (event.key === "Escape") input.value = shown();
  });
  session.hold(show, signal);
  show();
  return h("label", {}, h("span", {}, label), input, h("span", {}, "m"));
}
