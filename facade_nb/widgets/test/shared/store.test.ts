import { beforeEach, describe, expect, it, vi } from "vitest";
import { codeField, numberField } from "../../src/shared/fields.ts";
import { Store } from "../../src/shared/store.ts";
import { FakeModel, fakeState } from "./fake.ts";

const BX = ["patterns", "Bx", "text"];
let model: FakeModel;
let end: AbortController;
let store: Store;

beforeEach(() => {
  document.body.replaceChildren();
  model = new FakeModel({ ...fakeState() });
  end = new AbortController();
  store = new Store(model, end.signal);
});

const answer = (change: Record<string, unknown> = {}) => {
  const seq = model.asked.at(-1)?.seq;
  model.set({ ...change, ack: { client: store.client, seq } });
};

describe("the queue", () => {
  it("sends the first edit at once and one at a time, the newest value of a field only", () => {
    for (const text of ["A", "AB", "ABA"]) store.set(BX, text);
    expect(model.asked.map((m) => m.value)).toEqual(["A"]);
    answer();
    expect(model.asked.map((m) => m.value)).toEqual(["A", "ABA"]);
    answer();
    expect(model.asked).toHaveLength(2);
  });

  it("keeps other fields and operations in order", () => {
    store.set(BX, "A");
    store.set(["canvas", "width"], "7");
    store.ask({ op: "undo" });
    store.set(["canvas", "width"], "8");
    for (let i = 0; i < 3; i++) answer();
    expect(model.asked.map((m) => m.value ?? m.op)).toEqual(["A", "7", "undo", "8"]);
  });

  it("says how long the hand paused, whenever a message leaves", () => {
    let now = 5000;
    vi.spyOn(performance, "now").mockImplementation(() => now);
    const typed = (at: number, text: string) => {
      now = at;
      store.set(BX, text);
    };
    typed(5000, "A");
    typed(5250, "AB");
    typed(5500, "ABA"); // in the place of the one before: it goes on from the first
    now = 9000;
    answer();
    typed(9500, "ABAB");
    answer();
    expect(model.asked.map(({ value, after }) => [value, after])).toEqual([
      ["A", undefined],
      ["ABA", 0.25],
      ["ABAB", 4],
    ]);
    vi.restoreAllMocks();
  });

  it("takes a drag for one entry, however long the hand rests on the way", () => {
    let now = 5000;
    vi.spyOn(performance, "now").mockImplementation(() => now);
    const width = (at: number, value: string) => {
      now = at;
      store.set(["canvas", "width"], value);
      answer();
    };
    const pointer = (name: string) => document.body.dispatchEvent(new PointerEvent(name, { bubbles: true }));
    width(5000, "6");
    pointer("pointerdown");
    width(8000, "6.5");
    width(12000, "7");
    pointer("pointerup");
    pointer("pointerdown");
    width(15000, "7.5");
    pointer("pointercancel");
    width(17000, "8");
    expect(model.asked.map(({ after }) => after)).toEqual([undefined, 3, 0, 3, 2]);
  });

  it("knows which fields Python has not answered", () => {
    store.set(BX, "A");
    store.set(["canvas", "width"], "7");
    expect([store.pending(BX), store.pending(["canvas", "width"])]).toEqual([true, true]);
    answer();
    expect([store.pending(BX), store.pending(["canvas", "width"])]).toEqual([false, true]);
  });

  it("does not take another view's answer for its own", () => {
    store.set(BX, "A");
    model.set({ ack: { client: "somebody else", seq: 1 } });
    expect(store.pending(BX)).toBe(true);
  });

  it("ends with its view", () => {
    store.watch(["design"], () => {});
    end.abort();
    expect(model.listening).toBe(0);
    expect(model.sent.filter((m) => m.op === "view").map((m) => m.here)).toEqual([true, false]);
  });
});

describe("a text field", () => {
  const make = () => {
    const field = codeField(store, {
      label: "Pattern Bx",
      path: BX,
      value: () => store.get("design").patterns[0]?.text ?? "",
    });
    document.body.append(field.el);
    store.watch(["design", "drafts"], field.update);
    return field.input;
  };
  const type = (input: HTMLTextAreaElement, text: string) => {
    input.value = text;
    input.dispatchEvent(new Event("input"));
  };
  const design = (text: string) => {
    const { design } = fakeState();
    return { ...design, patterns: [{ ...design.patterns[0], text }] };
  };

  it("is not written to while its text is under way", async () => {
    const input = make();
    type(input, "A");
    type(input, "AB");
    answer({ design: design("A") });
    await Promise.resolve();
    expect(input.value).toBe("AB");
    answer({ design: design("AB") });
    await Promise.resolve();
    expect(input.value).toBe("AB");
  });

  it("shows what undo brings back", async () => {
    const input = make();
    type(input, "AB");
    answer({ design: design("AB") });
    model.set({ design: design("A(BA)^k") });
    await Promise.resolve();
    expect(input.value).toBe("A(BA)^k");
  });

  it("shows its draft, marked as faulty", async () => {
    const input = make();
    model.set({ drafts: [{ path: BX, value: "A(", faults: [] }] });
    await Promise.resolve();
    expect(input.value).toBe("A(");
    expect(input.getAttribute("aria-invalid")).toBe("true");
  });
});

describe("a number field", () => {
  const make = (text = "6") => {
    const field = numberField(store, {
      label: "Width",
      path: ["canvas", "width"],
      value: () => text,
      step: 0.1,
      min: 0.1,
    });
    document.body.append(field.el);
    field.update();
    return field.el as HTMLInputElement;
  };

  it("steps without rounding errors", () => {
    const input = make();
    for (const expected of ["6.1", "6.2", "6.3"]) {
      input.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowUp" }));
      expect(input.value).toBe(expected);
    }
    input.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowDown", shiftKey: true }));
    expect(input.value).toBe("5.3");
  });

  it("does not step below its least value", () => {
    const input = make("0.2");
    for (let i = 0; i < 5; i++) input.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowDown" }));
    expect(input.value).toBe("0.1");
  });
});

describe("another drawing", () => {
  it("is shown first; the parts follow once it is painted, and then what was replied", async () => {
    const told: string[] = [];
    store.watch(["svg"], () => told.push("drawing"), "first");
    store.watch(["design"], () => told.push("design"));
    store.onReply((reply) => told.push(reply.kind));
    told.length = 0;
    model.set({ design: { ...fakeState().design }, svg: "<svg/>" });
    model.emit("msg:custom", { client: store.client, kind: "note", text: "" });
    await Promise.resolve();
    expect(told).toEqual(["drawing"]);
    await vi.waitFor(() => expect(told).toEqual(["drawing", "design", "note"]));
    // Without another drawing nothing waits for a frame.
    model.set({ design: { ...fakeState().design } });
    await Promise.resolve();
    expect(told.slice(3)).toEqual(["design"]);
  });
});
