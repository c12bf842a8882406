import { afterEach, expect, test, vi } from "vitest";
import { emptyStage, type Rect } from "../../src/shared/stage.ts";
import { Store } from "../../src/shared/store.ts";
import type { State } from "../../src/shared/types.ts";
import { factsTable } from "../../src/studio/facts.ts";
import { bytesOf, fileName } from "../../src/studio/files.ts";
import { belongs, link, pointedAt, watchLinks } from "../../src/studio/links.ts";
import { dimensionsOf, gridOf, type Sheet, transparentOf } from "../../src/studio/marks.ts";
import { between, summary, transformTo } from "../../src/studio/naive.ts";
import { keptSaying, notices } from "../../src/studio/notices.ts";
import { clear, fitted, navigate, PADDING, zoomed } from "../../src/studio/viewport.ts";
import { FakeModel, fakeState } from "../shared/fake.ts";

const ends: AbortController[] = [];
afterEach(() => {
  for (const end of ends.splice(0)) end.abort();
  document.body.replaceChildren();
  vi.useRealTimers();
});

function signal(): AbortSignal {
  const end = new AbortController();
  ends.push(end);
  return end.signal;
}

/** 60 by 30 metres at 10 units a metre, with 20 units around. */
function drawing() {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  return { svg, width: 640, height: 340, scale: 10, origin: { x: 20, y: 320 } };
}
const sheet = (): Sheet => ({ drawing: drawing(), canvas: { width: 60, height: 30 }, scale: 1 });
const ROOM = { width: 800, height: 600 };

test("a fitted drawing is wholly in view, with the foot kept free", () => {
  for (const room of [ROOM, { width: 900, height: 200 }, { width: 200, height: 900 }]) {
    const { metre, left, bottom } = fitted(room, drawing());
    const scale = metre / 10;
    expect(left - 20 * scale).toBeGreaterThanOrEqual(PADDING.side - 1e-9);
    expect(left + 620 * scale).toBeLessThanOrEqual(room.width - PADDING.side + 1e-9);
    expect(bottom - 320 * scale).toBeGreaterThanOrEqual(PADDING.top - 1e-9);
    expect(bottom + 20 * scale).toBeLessThanOrEqual(room.height - PADDING.foot + 1e-9);
  }
});

test("a zoom keeps the point under the pointer, and has its limits", () => {
  const camera = { metre: 10, left: 50, bottom: 500 };
  const next = zoomed(camera, 2, { x: 250, y: 300 });
  expect((250 - next.left) / next.metre).toBeCloseTo((250 - camera.left) / camera.metre);
  expect((next.bottom - 300) / next.metre).toBeCloseTo((camera.bottom - 300) / camera.metre);
  expect(zoomed(camera, 1e9, { x: 0, y: 0 }).metre).toBeLessThan(1e5);
  expect(zoomed(camera, 1e-9, { x: 0, y: 0 }).metre).toBeGreaterThan(0);
});

test("a façade that grows stays clear of the panel, with its corner kept", () => {
  const held = { metre: 10, left: 100, bottom: 500 };
  expect(clear(held, ROOM, drawing())).toBe(held);
  const wide = { ...drawing(), width: 1640 };
  const shrunk = clear(held, ROOM, wide);
  expect(shrunk.left).toBe(100);
  expect(100 + (1620 * shrunk.metre) / 10).toBeCloseTo(ROOM.width - PADDING.side);
});

function stage() {
  const el = document.createElement("div");
  const shape = document.createElement("span");
  el.append(shape);
  document.body.append(el);
  const moves: [number, number, boolean][] = [];
  let camera = { metre: 10, left: 0, bottom: 100 };
  navigate(el, signal(), {
    camera: () => camera,
    move: (to, rough) => {
      camera = to;
      moves.push([to.left, to.bottom, rough]);
    },
    fit: () => moves.push([-1, -1, false]),
    taken: (target) => target === shape,
  });
  const point = (target: Element, name: string, x: number, button = 0) =>
    target.dispatchEvent(new MouseEvent(name, { bubbles: true, cancelable: true, clientX: x, button }));
  return { el, shape, moves, point, at: () => camera };
}

test("a drag beside the façade pans and is no click; one on a shape does not", () => {
  const { el, shape, moves, point } = stage();
  let clicks = 0;
  el.addEventListener("click", () => clicks++);
  point(el, "pointerdown", 10);
  point(el, "pointermove", 40);
  point(el, "pointerup", 40);
  point(el, "click", 40);
  expect(moves).toEqual([
    [30, 100, true],
    [30, 100, false],
  ]);
  expect(clicks).toBe(0);
  point(shape, "pointerdown", 10);
  point(shape, "pointermove", 40);
  point(shape, "pointerup", 40);
  point(shape, "click", 40);
  expect(moves).toHaveLength(2);
  expect(clicks).toBe(1);
  point(shape, "pointerdown", 10, 1);
  point(shape, "pointermove", 60);
  point(shape, "pointerup", 60);
  expect(moves.at(-1)).toEqual([80, 100, false]);
});

test("a press that does not move is a click, and the wheel zooms with Ctrl only", () => {
  const { el, moves, point, at } = stage();
  let clicks = 0;
  el.addEventListener("click", () => clicks++);
  point(el, "pointerdown", 10);
  point(el, "pointermove", 12);
  point(el, "pointerup", 12);
  point(el, "click", 12);
  expect([clicks, moves.length]).toEqual([1, 0]);
  el.dispatchEvent(new WheelEvent("wheel", { deltaY: -100 }));
  expect(moves).toHaveLength(0);
  const zoom = new WheelEvent("wheel", { deltaY: -100, ctrlKey: true, cancelable: true });
  el.dispatchEvent(zoom);
  expect(zoom.defaultPrevented).toBe(true);
  expect(at().metre).toBeGreaterThan(10);
});

test("keys zoom and fit, and those that are held with Ctrl are the host's", () => {
  const { el, moves, at } = stage();
  const press = (key: string, ctrlKey = false) => el.dispatchEvent(new KeyboardEvent("keydown", { key, ctrlKey }));
  press("+");
  expect(at().metre).toBeCloseTo(12.5);
  press("-");
  expect(at().metre).toBeCloseTo(10);
  press("+", true);
  expect(moves).toHaveLength(2);
  press("0");
  expect(moves.at(-1)).toEqual([-1, -1, false]);
});

test("grid lines stand at the columns of each group, and dimensions add up to the canvas", () => {
  const marks = {
    x: [
      { group: "a", columns: [0, 20, 60], rows: [] },
      { group: "b", columns: [0, 30, 60], rows: [] },
    ],
  };
  const [first, second] = gridOf(sheet(), marks, ["a", "b"]);
  expect(first?.getAttribute("d")).toBe("M20 320L20 20M220 320L220 20M620 320L620 20");
  expect(second?.getAttribute("class")).toContain("fnb-hue-1");
  const words = dimensionsOf(sheet(), marks).map((el) => el.textContent);
  expect(words).toEqual(expect.arrayContaining(["20.00", "10.00", "30.00", "60.00"]));
});

test("transparent letters have dashed cells, solid ones have none", () => {
  const row = (letters: [string, number, number, boolean][]) => [
    { group: "g", columns: [0, 60], rows: [{ layer: "l", pattern: "p", letters }] },
  ];
  const marks = {
    x: row([
      ["A", 0, 20, false],
      ["T", 20, 60, true],
    ]),
    y: row([["Q", 0, 30, false]]),
  };
  const drawn = transparentOf(sheet(), marks);
  expect(drawn.filter((el) => el.localName === "rect")).toHaveLength(1);
  expect(drawn.map((el) => el.textContent).join("")).toBe("T");
});

test("between side by side and aligned a shape is where the slider says", () => {
  const [a, b]: [Rect, Rect] = [
    [0, 0, 10, 10],
    [20, 0, 40, 10],
  ];
  expect(between(a, b, 0)).toEqual(a);
  expect(between(a, b, 1)).toEqual(b);
  expect(between(a, b, 0.5)).toEqual([10, 0, 25, 10]);
  const shape = document.createElementNS("http://www.w3.org/2000/svg", "g");
  shape.innerHTML = '<rect class="cell" x="20" y="220" width="100" height="100"/>';
  expect(transformTo(drawing(), shape, [0, 0, 10, 10])).toBe("matrix(1 0 0 1 0 0)");
  expect(transformTo(drawing(), shape, [20, 0, 40, 10])).toBe("matrix(2 0 0 1 180 0)");
});

test("flaws are counted by kind", () => {
  const rect: Rect = [0, 0, 1, 1];
  const flaws = [
    { kind: "hole", rect, text: "" },
    { kind: "hole", rect, text: "" },
    { kind: "occlusion", rect, text: "" },
  ] as const;
  expect(summary([...flaws], 0)).toBe("1 place covered, 2 holes");
  expect(summary([...flaws], 1)).toContain("Aligned");
  expect(summary([], 0)).toContain("Nothing is wrong");
});

test("what is pointed at is marked in every part of the design, and in no other", () => {
  const roots = ["one", "one", "two"].map((key) => {
    const root = document.createElement("div");
    root.innerHTML =
      '<i data-shape="0" data-layer="base" data-x="A" data-y="Q"></i><i class="row" data-symbol="A"></i>' +
      '<i class="row" data-symbol="B"></i><i class="row" data-letter="Q"></i><i class="fnb-layer" data-layer="base"></i>';
    document.body.append(root);
    link(root, key, signal());
    return root;
  });
  const seen: unknown[] = [];
  watchLinks("one", (pointed) => seen.push(pointed), signal());
  const lit = () => roots.map((root) => root.querySelectorAll("[data-lit]").length);
  roots[0]?.querySelector("[data-shape]")?.dispatchEvent(new MouseEvent("pointerover", { bubbles: true }));
  expect(lit()).toEqual([3, 3, 0]);
  expect(seen).toEqual([{ layer: "base", x: "A", y: "Q", places: [] }]);
  roots[1]?.querySelector("[data-symbol=B]")?.dispatchEvent(new MouseEvent("pointerover", { bubbles: true }));
  expect(lit()).toEqual([1, 1, 0]);
  roots[1]?.dispatchEvent(new MouseEvent("pointerleave"));
  expect(lit()).toEqual([0, 0, 0]);
});

test("a symbol has the shapes of both axes, a layer its own", () => {
  const shape = { layer: "base", x: "A", y: "Q" };
  const el = document.createElement("i");
  el.dataset.symbol = "Q";
  expect(belongs(shape, pointedAt(el))).toBe(true);
  expect(belongs(shape, { layer: "base", x: "", y: "", places: [] })).toBe(true);
  expect(belongs(shape, { layer: "base", x: "B", y: "Q", places: [] })).toBe(false);
  expect(belongs(shape, { layer: "", x: "", y: "", places: [] })).toBe(false);
});

function told(changes: Partial<State> = {}) {
  const channel = new FakeModel({ ...fakeState(), document: "{1}", ...changes });
  const store = new Store(channel, signal());
  const { el } = notices(store, signal());
  document.body.append(el);
  const reply = (content: Record<string, unknown>, seq = 1) =>
    channel.emit("msg:custom", { client: store.client, seq, ...content });
  const notice = () => el.querySelector<HTMLElement>(".fnb-notice");
  return { channel, store, el, reply, notice };
}

test("what was opened over other work can be undone from its notice, which goes with the next change", async () => {
  const { channel, store, reply, notice } = told();
  channel.set({ ack: { client: store.client, seq: 1 }, document: "{2}" });
  await Promise.resolve();
  reply({ kind: "opened", name: "house.json" });
  expect(notice()?.hidden).toBe(false);
  expect(notice()?.textContent).toContain("house.json");
  channel.set("document", "{3}");
  await Promise.resolve();
  expect(notice()?.hidden).toBe(true);
  reply({ kind: "opened", name: "house.json" });
  notice()?.querySelector<HTMLButtonElement>(".fnb-fix")?.click();
  expect(channel.asked.at(-1)).toMatchObject({ op: "undo" });
  expect(notice()?.hidden).toBe(true);
});

test("its notice stays when its own change comes after it", async () => {
  const { channel, store, reply, notice } = told();
  reply({ kind: "opened", name: "house.json" }, 4);
  channel.set({ ack: { client: store.client, seq: 4 }, document: "{2}" });
  await Promise.resolve();
  expect(notice()?.hidden).toBe(false);
  channel.set({ ack: { client: store.client, seq: 5 }, document: "{3}" });
  await Promise.resolve();
  expect(notice()?.hidden).toBe(true);
});

test("a fault that was told goes when the design changes", async () => {
  const { channel, reply, notice } = told();
  reply({ kind: "refused", faults: [{ place: "", message: "no", line: null, column: null, excerpt: "" }] });
  channel.set("ack", { client: "another", seq: 1 });
  await Promise.resolve();
  expect(notice()?.hidden).toBe(false);
  channel.set("document", "{2}");
  await Promise.resolve();
  expect(notice()?.hidden).toBe(true);
});

test("each state of what is kept says what can be done", () => {
  const labels = (state: "on" | "restored" | "offered" | "elsewhere" | "failed") =>
    keptSaying({ state, name: "House", when: "14:03", reason: "disk full" })[1].map(([answer]) => answer);
  expect(labels("on")).toEqual([]);
  expect(labels("restored")).toEqual(["settle", "anew"]);
  expect(labels("offered")).toEqual(["restore", "settle"]);
  expect(labels("elsewhere")).toEqual(["restore", "settle"]);
  expect(keptSaying({ state: "failed", reason: "disk full" })[0]).toContain("disk full");
});

test("figures say J, its terms, and whether they are proven", () => {
  const one = {
    axis: "x",
    cost: 1.65,
    error: 0.2,
    terms: { empty: [0.5, 0.8], loose: [3.6, 0.25], fit: [0.6, 0.25] } as Record<string, [number, number]>,
    gap: 0.1,
    proven: false,
    deviation: 0.25,
    groups: [],
  } as const;
  const words = factsTable([{ ...one, groups: [] }]).textContent;
  for (const part of ["1.65 m", "0.2 m", "0.4 m", "0.9 m", "0.15 m", "0.25 m", "at most 0.1 m from it"])
    expect(words).toContain(part);
  expect(factsTable([{ ...one, proven: true, groups: [] }]).textContent).toContain("proven");
});

test("files have names that every system takes, and binary ones their bytes", () => {
  expect(fileName("Haus am Ring/7")).toBe("haus-am-ring-7");
  expect(fileName("///")).toBe("design");
  expect([...bytesOf(btoa("\u0000\u00ff"))]).toEqual([0, 255]);
  expect(emptyStage().document).toBe("");
});
