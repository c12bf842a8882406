import { describe, expect, it } from "vitest";
import { focusMain, h, keyed } from "../../src/shared/dom.ts";
import { scrub, scrubbed } from "../../src/shared/scrub.ts";
import { keepFocus } from "../../src/shared/staying.ts";
import { Store } from "../../src/shared/store.ts";
import { colourOf, swatchField } from "../../src/shared/swatches.ts";
import type { Cell, SelectionState } from "../../src/shared/types.ts";
import { inspector, keyIn, originOf, ownerOf, pairsOf } from "../../src/studio/inspector.ts";
import { shapes } from "../../src/studio/shapes.ts";
import { FakeModel, fakeState } from "../shared/fake.ts";

const look = { value: "brick", level: "layer", key: "B *", varied: false } as const;
const cell = (x: string, y: string): Cell => ({
  rect: [0, 0, 1, 2],
  fields: {
    kind: look,
    geometry: look,
    material: look,
    offset: { ...look, value: 0.1 },
    thickness: { ...look, value: 0.2 },
    visible: { ...look, value: true },
  },
  keys: [
    { key: `${x}[2] ${y}[1]`, means: "this one" },
    { key: `${x} ${y}`, means: `all ${x} ${y}` },
    { key: `${x}[2] *`, means: `all of this ${x}` },
    { key: "* *", means: "everything" },
  ],
  patterns: { x: "Bx", y: "By" },
  set: { layer: {}, x: {}, y: {}, design: {} },
  seed: 0,
});
const selection = (more: [string, string][] = []): SelectionState => ({
  shape: null,
  layer: "base",
  x: "B",
  y: "Q",
  number: null,
  more,
  cell: cell("B", "Q"),
  pairs: null,
});

describe("the place of an edit", () => {
  it("is a path, by whose shapes are edited", () => {
    expect(ownerOf(selection(), { level: "layer", means: "" })).toEqual(["layers", "base"]);
    expect(ownerOf(selection(), { level: "y", means: "" })).toEqual(["patterns", "By"]);
    expect(ownerOf(selection(), { level: "design", means: "" })).toEqual([]);
  });

  it("stays what was chosen from cell to cell, in words", () => {
    expect(keyIn(cell("B", "Q"), { means: "" })).toBe("B Q");
    expect(keyIn(cell("A", "P"), { means: "this one" })).toBe("A[2] P[1]");
    expect(keyIn(cell("A", "P"), { means: "everything" })).toBe("* *");
    expect(keyIn(cell("A", "P"), { means: "unknown" })).toBe("A P");
  });

  it("is several keys for several pairs", () => {
    expect(pairsOf(selection([["A", "front door"]]))).toBe("B Q\nA front door");
  });

  it("is told in words", () => {
    expect(originOf(look, selection())).toBe("B * in base");
    expect(originOf({ ...look, level: "x", varied: true }, selection())).toBe("variant of B * in pattern Bx");
    expect(originOf({ ...look, level: "" }, selection())).toBe("by default");
  });
});

describe("a number that is dragged", () => {
  it("goes in tenths of a step, or in whole ones", () => {
    expect(scrubbed(1, 40, { step: 0.1, min: 0.1 })).toBe(1.2);
    expect(scrubbed(1, -400, { step: 0.1, min: 0.1 })).toBe(0.1);
    expect(scrubbed(3, 17, { step: 1, whole: true })).toBe(5);
    expect(scrubbed(3, 1, { step: 0.1 })).toBe(3);
  });

  it("is told as if it were typed, and a click is no drag", () => {
    const input = h("input", { type: "text" });
    input.value = "2,5";
    document.body.append(input);
    const told: string[] = [];
    input.addEventListener("input", () => told.push(input.value));
    scrub(input, { step: 0.1 }, () => 1);
    const at = (type: string, clientX: number) => new MouseEvent(type, { clientX, button: 0, bubbles: true });
    input.dispatchEvent(at("pointerdown", 100));
    document.dispatchEvent(at("pointermove", 102));
    expect(told).toEqual([]);
    document.dispatchEvent(at("pointermove", 120));
    document.dispatchEvent(at("pointerup", 120));
    document.dispatchEvent(at("pointermove", 160));
    expect(told).toEqual(["2.6"]);
    input.remove();
  });
});

describe("the focus", () => {
  const list = h("div");
  const root = h("div", {}, h("button", {}, "add"), list);
  document.body.append(root);
  const end = new AbortController();
  keepFocus(root, end.signal);
  const show = keyed<string>(
    list,
    (item) => item,
    (item) => ({
      el: h("div", { id: item }, h("input", { type: "text" }), h("textarea", { "data-main": true }, item), h("button")),
      update() {},
    }),
  );
  const within = () => document.activeElement?.parentElement?.id;

  it("goes to where the next thing is typed when its row goes", () => {
    show(["a", "b", "c"]);
    (list.querySelector("#b > button") as HTMLElement).focus();
    show(["a", "c"]);
    expect([within(), document.activeElement?.tagName]).toEqual(["c", "TEXTAREA"]);
    show(["a"]);
    expect(within()).toBe("a");
  });

  it("stays at the same thing, with its caret, when a row has another name", () => {
    const text = list.querySelector("textarea") as HTMLTextAreaElement;
    text.focus();
    text.setSelectionRange(1, 1);
    show(["z"]);
    expect([within(), document.activeElement?.tagName]).toEqual(["z", "TEXTAREA"]);
    expect((document.activeElement as HTMLTextAreaElement).selectionStart).toBe(1);
  });

  it("never leaves the part when what has it goes, or is disabled", async () => {
    show([]);
    await Promise.resolve();
    expect(root.contains(document.activeElement)).toBe(true);
    const add = root.querySelector("button") as HTMLButtonElement;
    add.focus();
    add.disabled = true;
    await Promise.resolve();
    expect(root.contains(document.activeElement) && document.activeElement !== add).toBe(true);
    end.abort();
    root.remove();
  });

  it("is given to the main thing of a row", () => {
    const row = h("div", {}, h("button"), h("input", { "data-main": true }));
    document.body.append(row);
    expect(focusMain(row)).toBe(true);
    expect(document.activeElement?.tagName).toBe("INPUT");
    expect(focusMain(h("div"))).toBe(false);
    row.remove();
  });
});

describe("materials", () => {
  it("are colours, named or their own", () => {
    expect(colourOf("brick", { brick: "#a54" })).toBe("#a54");
    expect(colourOf("#c8b9a0", {})).toBe("#c8b9a0");
    expect(colourOf("rule:Wall", {})).toBe("#bbb");
  });

  it("are chosen by keys from a list that has whole names", () => {
    const chosen: string[] = [];
    const field = swatchField({
      label: "material",
      value: () => "brick",
      choices: () => ["brick", "plaster-ochre", "stone"],
      colours: () => ({}),
      choose: (name) => chosen.push(name),
    });
    field.update();
    document.body.append(field.el);
    field.el.querySelector("button")?.click();
    expect(document.activeElement?.textContent).toBe("brick");
    const key = (name: string) =>
      document.activeElement?.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true }));
    key("ArrowDown");
    key("s");
    (document.activeElement as HTMLElement).click();
    expect(chosen).toEqual(["stone"]);
    expect(document.activeElement).toBe(field.el.querySelector("button"));
    field.el.remove();
  });
});

describe("the inspector", () => {
  const state = fakeState();
  const model = new FakeModel({ ...state, selection: selection() });
  const end = new AbortController();
  const store = new Store(model, end.signal);
  const el = inspector({ store, signal: end.signal, notify: () => {} });
  document.body.append(el);
  const named = (label: string) => el.querySelector(`[aria-label="${label}"]`) as HTMLElement;

  it("has a field for each value of the cell, with who says it", () => {
    expect(el.querySelectorAll(".fnb-look")).toHaveLength(6);
    expect(el.querySelector("[data-look=material] .fnb-origin")?.textContent).toBe("B * in base");
    (named("B Q of base is visible") as HTMLButtonElement).click();
    expect(model.asked.at(-1)).toMatchObject({ path: ["layers", "base", "shapes", "B Q", "visible"], value: false });
  });

  it("edits where it is told to", () => {
    const keys = named("Which shapes are edited") as HTMLSelectElement;
    keys.value = "B[2] Q[1]";
    keys.dispatchEvent(new Event("change"));
    const level = named("Whose shapes are edited") as HTMLSelectElement;
    level.value = "y";
    level.dispatchEvent(new Event("change"));
    model.set({ ack: { client: store.client, seq: model.asked.at(-1)?.seq } });
    (named("B Q of base is visible") as HTMLButtonElement).click();
    expect(model.asked.at(-1)?.path).toEqual(["patterns", "By", "shapes", "B[2] Q[1]", "visible"]);
  });

  it("goes with the selection", async () => {
    model.set({ selection: { ...selection(), cell: null } });
    await Promise.resolve();
    expect(el.childElementCount).toBe(0);
    end.abort();
    el.remove();
  });
});

describe("the table of pairs", () => {
  it("has the first row at the bottom, and picks a pair, or more with Shift", () => {
    const one = { material: "brick", geometry: "box", key: "B *", level: "design" as const, shown: true };
    const pairs = {
      layer: "base",
      columns: ["A", "B"],
      rows: ["P", "Q"],
      cells: [one, one, one, { ...one, shown: false }],
    };
    const picked = { ...selection(), x: "A", y: "P", pairs };
    const model = new FakeModel({ ...fakeState(), selection: picked });
    const end = new AbortController();
    const store = new Store(model, end.signal);
    const el = shapes({ store, signal: end.signal, notify: () => {} });
    const cells = [...el.querySelectorAll<HTMLElement>(".fnb-pair-cell")];
    expect(cells.map((cell) => cell.dataset.pair)).toEqual(["A Q", "B Q", "A P", "B P"]);
    expect(cells[1]?.hasAttribute("data-shown")).toBe(false);
    expect(cells[2]?.getAttribute("aria-pressed")).toBe("true");
    cells[1]?.dispatchEvent(new MouseEvent("click", { shiftKey: true }));
    expect(model.asked.at(-1)).toMatchObject({ op: "toggle", add: true, layer: "base", x: "B", y: "Q" });
    end.abort();
  });
});
