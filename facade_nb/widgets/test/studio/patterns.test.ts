import { afterEach, describe, expect, test, vi } from "vitest";
import { h } from "../../src/shared/dom.ts";
import { keepKeys } from "../../src/shared/keys.ts";
import { Store } from "../../src/shared/store.ts";
import type { State } from "../../src/shared/types.ts";
import { resolveIn } from "../../src/studio/common.ts";
import { completionsAt, type Known } from "../../src/studio/completion.ts";
import { partners, piecesOf } from "../../src/studio/grammar.ts";
import { inkOf } from "../../src/studio/ink.ts";
import { belongs, link, point, pointedAt } from "../../src/studio/links.ts";
import { patterns } from "../../src/studio/patterns.ts";
import { bandsOf, placesOf } from "../../src/studio/places.ts";
import { suggest } from "../../src/studio/suggesting.ts";
import { drawWord, syntaxCard } from "../../src/studio/syntax.ts";
import { reasonOf, wordList } from "../../src/studio/wordList.ts";
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

const told = (text: string) => piecesOf(text).map(({ kind, start, end }) => `${kind}:${text.slice(start, end)}`);
const names = (text: string, kind: string) =>
  piecesOf(text).flatMap((piece) => (piece.kind === kind ? [piece.name] : []));

describe("the pieces of a text", () => {
  test("are symbols, counts and signs", () => {
    expect(told("A2(BA)^k")).toEqual([
      "symbol:A2",
      "bracket:(",
      "symbol:B",
      "symbol:A",
      "bracket:)",
      "operator:^",
      "counter:k",
    ]);
    expect(told("A^~-3'")).toEqual(["symbol:A", "operator:^", "operator:~", "operator:-", "number:3", "mirror:'"]);
    expect(told("A^|2|B")).toEqual(["symbol:A", "operator:^", "operator:|", "number:2", "operator:|", "symbol:B"]);
    expect(told("c e; c := <front door> # it")).toEqual([
      ...["symbol:c", "blank: ", "symbol:e", "end:;", "blank: ", "symbol:c", "blank: ", "assign::=", "blank: "],
      ...["symbol:<front door>", "blank: ", "comment:# it"],
    ]);
    expect(names("A^{floors} B^{ of  bays } C^{-k}^k2", "counter")).toEqual(["floors", "of bays", "k", "k2"]);
    expect(names("<front  door><B>漢é", "symbol")).toEqual(["front door", "B", "漢", "é"]);
  });

  test("leave no gap, whatever stands there", () => {
    for (const text of ["", "A^", "<ab", "A{b", "ε", "()^^", "A*B", "𝔸𝒜", "A\r\nB := \t^", "a:=", "^:=", "ˆ漢'"]) {
      const pieces = piecesOf(text);
      expect(pieces.map(({ start, end }) => text.slice(start, end)).join("")).toBe(text);
      for (const { start, end } of pieces) expect(end).toBeGreaterThan(start);
    }
  });

  test("tell which brackets belong together", () => {
    const text = "A(B(C)D";
    expect([...partners(piecesOf(text), text)]).toEqual([
      [3, 5],
      [5, 3],
    ]);
  });
});

const KNOWN: Known = {
  symbols: [
    { name: "A", size: 1 },
    { name: "A2", size: 0.5 },
    { name: "front door", size: null },
  ],
  counters: [
    { name: "k", told: "counter, now 3" },
    { name: "floors", told: "counter" },
  ],
  modes: [
    { sign: "", name: "none" },
    { sign: "~", name: "normal inner" },
  ],
  patterns: [
    { name: "bays", text: "A(BA)^k" },
    { name: "set", text: "c; c := A" },
  ],
};
const offered = (text: string, caret = text.length) =>
  completionsAt(text, caret, KNOWN).items.map(({ text: own }) => own);

describe("completion", () => {
  test("offers what may stand at the caret", () => {
    expect(offered("A(BA)^")).toEqual(["k", "{floors}", "~", "-"]);
    expect(offered("A^~")).toEqual(["k", "{floors}"]);
    expect(offered("A^f")).toEqual(["{floors}"]);
    expect(offered("A^{f")).toEqual(["{floors}"]);
    expect(offered("A<fr")).toEqual(["<front door>"]);
    expect(offered("A")).toEqual(["A2"]);
    expect(offered("B(b")).toEqual(["(A(BA)^k)"]);
    expect(offered("")).toEqual(["A", "A2", "<front door>", "(A(BA)^k)", "ε"]);
    expect(offered("A # B^")).toEqual([]);
  });

  test("offers substitutions of what stands in the control pattern", () => {
    expect(offered("cec; ")).toEqual(["c := ", "e := "]);
    expect(offered("cec; c := A; ")).toEqual(["e := "]);
    expect(offered("AcA; A")).toEqual(["A := "]);
    expect(offered("cec; c := A")).toEqual(["A2"]);
  });

  test("replaces what was begun, and the closing sign that stands there", () => {
    expect(completionsAt("A<fr>", 4, KNOWN)).toMatchObject({ from: 1, to: 5 });
    expect(completionsAt("B A", 3, KNOWN)).toMatchObject({ from: 2, to: 3 });
  });
});

function field() {
  const input = h("textarea", {});
  const list = suggest(
    input,
    {
      label: "Completions",
      complete: (text, at) => completionsAt(text, at, KNOWN),
      colour: () => "red",
      at: () => new DOMRect(),
    },
    signal(),
  );
  const root = h("div", {}, h("div", {}, input, list));
  document.body.append(root);
  const heard: string[] = [];
  keepKeys(root, signal());
  document.body.addEventListener("keydown", (event) => heard.push(event.key), { signal: signal() });
  input.focus();
  const press = (key: string, more: KeyboardEventInit = {}) => {
    const event = new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true, ...more });
    input.dispatchEvent(event);
    return event.defaultPrevented;
  };
  const type = (text: string) => {
    for (const sign of text) {
      input.setRangeText(sign, input.selectionStart, input.selectionEnd, "end");
      input.dispatchEvent(new InputEvent("input", { data: sign, bubbles: true }));
    }
  };
  const shown = () => (list.hidden ? [] : [...list.children].map((option) => option.querySelector("b")?.textContent));
  const picked = () => list.querySelector("[aria-selected=true] b")?.textContent;
  return { input, list, press, type, shown, picked, heard };
}

describe("the list under the caret", () => {
  test("comes by Tab where a name is begun, and Enter takes what is chosen", () => {
    const { input, press, type, shown, picked } = field();
    type("B^k f");
    expect(press("Tab")).toBe(true); // the only one is taken at once
    expect(input.value).toBe("B^k <front door>");
    type(" ");
    expect(press("Tab")).toBe(false); // nothing is begun: on to the next field
    expect(press(" ", { ctrlKey: true })).toBe(true);
    expect(shown()[0]).toBe("A");
    press("ArrowDown");
    expect(picked()).toBe("A2");
    press("ArrowUp");
    press("ArrowUp");
    expect(picked()).toBe(shown().at(-1));
    press("ArrowDown");
    expect(press("Enter")).toBe(true);
    expect(input.value).toBe("B^k <front door> A");
    expect(shown()).toEqual([]);
  });

  test("comes by itself after ^, and then takes no Enter until an arrow has chosen", () => {
    const { input, press, type, shown, picked } = field();
    type("A^");
    expect(shown()).toEqual(["k", "floors", "~", "-"]);
    expect(picked()).toBeUndefined();
    expect(press("Enter")).toBe(false);
    expect(shown()).toEqual([]);
    type("^");
    type("f");
    expect(shown()).toEqual(["floors"]);
    type("^");
    press("ArrowDown");
    expect(press("Enter")).toBe(true);
    expect(input.value).toBe("A^^f^k");
  });

  test("Escape closes it, is nobody else's, and gives Tab back", () => {
    const { input, press, type, shown, heard } = field();
    type("A");
    press(" ", { ctrlKey: true });
    expect(shown().length).toBeGreaterThan(0);
    expect(press("Escape")).toBe(true);
    expect(shown()).toEqual([]);
    expect(document.activeElement).toBe(input);
    expect(heard).toEqual([]);
    expect(press("Tab")).toBe(false);
    type("A");
    expect(press("Tab", { shiftKey: true })).toBe(false);
  });

  test("takes no key while an input method composes", () => {
    const { input, press, type, shown } = field();
    type("A^");
    press("ArrowDown");
    for (const key of ["Enter", "Tab", "ArrowDown", "Escape"]) {
      expect(press(key, { isComposing: true })).toBe(false);
      expect(press(key, { keyCode: 229 } as KeyboardEventInit)).toBe(false);
    }
    expect(input.value).toBe("A^");
    expect(shown().length).toBe(4);
  });

  test("a press on it writes, and leaves the focus", () => {
    const { input, list, type } = field();
    type("A^");
    const event = new MouseEvent("pointerdown", { bubbles: true, cancelable: true });
    list.children[1]?.dispatchEvent(event);
    expect(event.defaultPrevented).toBe(true);
    expect(input.value).toBe("A^{floors}");
    expect(list.hidden).toBe(true);
  });
});

describe("ink", () => {
  const ink = () => inkOf({ pattern: "Bx", colour: (symbol) => (symbol === "A" ? "red" : "blue") });
  test("says what the field says, letter by letter", () => {
    const { el, paint } = ink();
    paint("A(<front door>A)^k", [], true);
    expect(el.textContent).toBe("A(<front door>A)^k\u200b");
    const letters = [...el.querySelectorAll<HTMLElement>("[data-letter]")];
    expect(letters.map(({ dataset }) => [dataset.letter, dataset.place])).toEqual([
      ["A", "0"],
      ["front door", "2"],
      ["A", "14"],
    ]);
    expect(letters[0]?.style.getPropertyValue("--fnb-tint")).toBe("red");
    expect(el.querySelector(".fnb-ink-counter")?.textContent).toBe("k");
    paint("AB", [], false); // not the text that was solved
    expect(el.querySelectorAll("[data-place]")).toHaveLength(0);
  });

  test("underlines faults where the reader names them, also after the end", () => {
    const { el, paint } = ink();
    paint("A(BA^k", [{ at: 1, message: "not closed" }], false);
    expect(el.querySelector("[data-fault]")?.textContent).toBe("(");
    paint("A^", [{ at: 2, message: "expected" }], false);
    expect(el.querySelector("[data-fault]")?.textContent).toBe(" ");
  });

  test("marks the brackets at the caret, and lets long texts be", () => {
    const { el, paint, match } = ink();
    paint("A(B)", [], false);
    match(4);
    expect(el.querySelectorAll("[data-matched]")).toHaveLength(2);
    match(null);
    expect(el.querySelectorAll("[data-matched]")).toHaveLength(0);
    paint("A".repeat(5000), [], false);
    expect(el.hasAttribute("data-plain")).toBe(true);
    expect(el.querySelectorAll("span")).toHaveLength(0);
  });
});

/** A(BA)^k with k = 2 across, PQ upwards; e is transparent in another pattern. */
function solved(changes: Partial<State> = {}): Store {
  const side = (pattern: string) => ({ pattern, group: "default", mask: null, letters: [] });
  const state = fakeState();
  state.design.layers = [
    { name: "base", visible: true, unshaped: false, depth: 0, x: side("Bx"), y: side("By") },
    { name: "columns", visible: true, unshaped: false, depth: 1, x: side("Cx"), y: side("By") },
  ];
  const letters: State["letters"] = {
    x: {
      Bx: {
        text: "A(BA)^k",
        letters: [
          ["A", 0, 0, 1, ""],
          ["B", 2, 1, 2, ""],
          ["A", 3, 2, 3, ""],
          ["B", 2, 3, 4, ""],
          ["A", 3, 4, 5, ""],
        ],
      },
      Cx: { text: "e", letters: [["e", 0, 0, 6, "t"]] },
    },
    y: {
      By: {
        text: "PQ",
        letters: [
          ["P", 0, 0, 2, ""],
          ["Q", 1, 2, 3, ""],
        ],
      },
    },
  };
  return new Store(new FakeModel({ ...state, letters, ...changes }), signal());
}

describe("links between letters and cells", () => {
  test("a cell knows the very letters it comes from", () => {
    const store = solved();
    expect(placesOf(store, { layer: "base", x: "B", y: "Q", number: "2 1" })).toEqual([
      { pattern: "Bx", offset: 2, axis: "x", index: 3, copy: [2, 2] },
      { pattern: "By", offset: 1, axis: "y", index: 1, copy: [1, 1] },
    ]);
    expect(placesOf(store, { layer: "base", x: "A", y: "P", number: "3 1" })[0]).toMatchObject({
      offset: 3,
      copy: [2, 2],
    });
    expect(placesOf(store, { layer: "gone", x: "A", y: "P", number: "1 1" })).toEqual([]);
  });

  test("a letter of a text has the cells that come from it, and no others", () => {
    const store = solved();
    const resolve = resolveIn(store);
    const to = (offset: number, index?: number) => ({
      layer: "",
      x: "A",
      y: "A",
      places: [{ pattern: "Bx", offset, axis: "x" as const, index }],
    });
    const cell = (number: string) => ({ layer: "base", x: "A", y: "P", number });
    expect(belongs(cell("1 1"), to(0), resolve)).toBe(true);
    expect(belongs(cell("2 1"), to(0), resolve)).toBe(false);
    expect([cell("2 1"), cell("3 1")].map((own) => belongs(own, to(3), resolve))).toEqual([true, true]);
    expect([cell("2 1"), cell("3 1")].map((own) => belongs(own, to(3, 4), resolve))).toEqual([false, true]);
    expect(bandsOf(store, to(3).places)).toEqual([
      { axis: "x", start: 2, end: 3 },
      { axis: "x", start: 4, end: 5 },
    ]);
    expect(bandsOf(store, [{ pattern: "Cx", offset: 0 }])).toEqual([{ axis: "x", start: 0, end: 6 }]);
  });

  test("are marked in the text: which letter, and which copy of it", () => {
    const store = solved();
    const { el, paint } = inkOf({ pattern: "Bx", colour: () => "red" });
    paint("A(BA)^k", [], true);
    const cell = h("i", {
      "data-shape": "0",
      "data-layer": "base",
      "data-x": "A",
      "data-y": "P",
      "data-number": "3 1",
    });
    const row = h("i", { class: "fnb-layer", "data-layer": "base" });
    const pattern = h("i", { class: "fnb-pattern", "data-pattern": "Bx" }, el);
    const root = h("div", {}, pattern, row, cell);
    document.body.append(root);
    link(root, "letters", signal(), resolveIn(store));
    const lit = () =>
      [...root.querySelectorAll<HTMLElement>("[data-lit]")].map((own) => own.dataset.place ?? own.className);
    cell.dispatchEvent(new MouseEvent("pointerover", { bubbles: true }));
    expect(lit()).toEqual(["3", "fnb-layer"]);
    expect(el.querySelector("[data-lit]")?.getAttribute("data-copy")).toBe("2 of 2");
    row.dispatchEvent(new MouseEvent("pointerover", { bubbles: true }));
    expect(lit()).toEqual(["fnb-pattern", "fnb-layer"]);
    point("letters", pointedAt(el.querySelector("[data-place='0']")), el);
    expect(lit()).toEqual(["0", "fnb-layer"]);
    root.dispatchEvent(new MouseEvent("pointerleave"));
    expect(lit()).toEqual([]);
  });
});

const WORD = {
  letters: [
    ["A", "", 0],
    ["B", "m", 2],
  ] as [string, string, number][],
  left: 0,
  size: 5.6,
  open: false,
  miss: 0.4,
  bound: "",
  counters: { k: 1 },
};

describe("the words of a pattern", () => {
  test("are told with the reason, one marked as chosen", () => {
    const words = [
      { ...WORD, reason: "chosen" as const },
      { ...WORD, reason: "looser" as const, miss: 2.1 },
      { ...WORD, reason: "range" as const, bound: "k ≤ 3" },
      { ...WORD, reason: "too long" as const },
    ];
    const el = wordList(
      "Bx",
      { text: "A(B')^k", note: "", axes: [{ axis: "x", canvas: 6, low: 2, high: 9, words, more: 130 }] },
      () => "red",
    );
    const rows = [...el.querySelectorAll("li")].map((row) => row.textContent);
    expect(rows).toEqual([
      "AB′5.6 mchosen",
      "AB′5.6 mlooser fit, 2.1 m off",
      "AB′5.6 mnot kept: beyond k ≤ 3",
      "AB′5.6 mnot kept: too long",
      "and 130 more that are kept",
    ]);
    expect(el.querySelectorAll("[aria-current=true]")).toHaveLength(1);
    expect(el.querySelectorAll("[data-index]")).toHaveLength(2);
    expect(wordList("Bx", { text: "", axes: [], note: "No visible layer uses it." }, () => "").textContent).toContain(
      "No visible",
    );
    expect(reasonOf({ ...WORD, reason: "fits" })).toBe("fits");
  });

  test("are asked for of the one pattern that is open", () => {
    vi.useFakeTimers();
    const channel = new FakeModel({ ...fakeState() });
    const store = new Store(channel, signal());
    const part = patterns({ store, signal: signal(), notify: () => {} });
    document.body.append(part);
    const answer = () => channel.set("ack", { client: store.client, seq: channel.asked.length });
    answer();
    const open = part.querySelector<HTMLElement>(".fnb-words-open");
    open?.click();
    answer();
    expect(open?.getAttribute("aria-expanded")).toBe("true");
    open?.click();
    expect(channel.asked.map(({ op, what, on }) => [op, what, on])).toEqual([
      ["want", "words:Bx", true],
      ["want", "words:Bx", false],
    ]);
  });
});

test("the card draws what each mode makes, for the copies that are chosen", () => {
  const words = { "2": "E k G G' k' E'", "0": "" };
  const card = syntaxCard(() => [{ sign: "~", name: "normal inner", words }]);
  const drawn = () => [...card.querySelectorAll(".fnb-mode-letter")].map((one) => one.textContent).join("");
  expect(drawn()).toBe("EkGGkE");
  expect(card.querySelectorAll("[data-mirrored]")).toHaveLength(3);
  const copies = card.querySelector("input") as HTMLInputElement;
  copies.value = "0";
  copies.dispatchEvent(new Event("input"));
  expect(card.querySelector(".fnb-mode-word")?.textContent).toBe("nothing");
  expect(drawWord("E'").getAttribute("aria-label")).toBe("E'");
});
