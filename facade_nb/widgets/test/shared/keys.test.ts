import { beforeEach, describe, expect, it } from "vitest";
import { holdBack, nameField } from "../../src/shared/fields.ts";
import { historyKey, isHosts, keepKeys, letterOf } from "../../src/shared/keys.ts";
import { stepByKeys, stepped } from "../../src/shared/stepping.ts";
import { difference, write } from "../../src/shared/writing.ts";

const press = (key: string, code = "", held: KeyboardEventInit = {}) =>
  new KeyboardEvent("keydown", { key, code, bubbles: true, cancelable: true, composed: true, ...held });
const ctrl = (key: string, code: string, held: KeyboardEventInit = {}) => press(key, code, { ctrlKey: true, ...held });

describe("a letter", () => {
  it.each([
    ["z", "KeyZ", "z"],
    ["Z", "KeyZ", "z"],
    ["я", "KeyZ", "z"],
    ["Ζ", "KeyZ", "z"], // Greek, not Latin, Z
    ["ผ", "KeyZ", "z"], // Thai
    ["z", "KeyY", "z"], // German
    ["é", "KeyZ", "é"], // a letter of our alphabet, with a place of its own
    [";", "KeyZ", ";"], // Dvorak
    ["н", "KeyY", "y"],
    ["ы", "KeyS", "s"],
    ["Enter", "Enter", ""],
    ["Dead", "KeyZ", "z"],
    ["1", "Digit1", "1"],
    ["١", "Digit1", "١"],
  ])("%s at %s is %s", (key, code, letter) => expect(letterOf(press(key, code))).toBe(letter));
});

describe("undo and redo", () => {
  it.each([
    [ctrl("z", "KeyZ"), "undo"],
    [ctrl("z", "KeyY"), "undo"],
    [ctrl("y", "KeyZ"), "redo"],
    [ctrl("я", "KeyZ"), "undo"],
    [ctrl("Я", "KeyZ", { shiftKey: true }), "redo"],
    [ctrl("υ", "KeyY"), "redo"],
    [press("z", "KeyZ", { metaKey: true, shiftKey: true }), "redo"],
    [ctrl("z", "KeyZ", { altKey: true }), null],
    [ctrl("y", "KeyY", { shiftKey: true }), null],
    [ctrl("w", "KeyZ"), null],
    [press("z", "KeyZ"), null],
  ])("%#", (event, op) => expect(historyKey(event)).toBe(op));
});

describe("the host", () => {
  it.each([
    ctrl("s", "KeyS"),
    ctrl("ы", "KeyS"),
    ctrl("b", "KeyB"),
    ctrl("C", "KeyC", { shiftKey: true }),
    ctrl("'", "Quote", { shiftKey: true }),
    ctrl("a", "KeyA", { altKey: true }),
    press("1", "Digit1", { altKey: true }),
    press("Escape", "Escape"),
    press("F1", "F1"),
  ])("has %#", (event) => expect(isHosts(event)).toBe(true));

  it.each([
    press("d", "KeyD"),
    press("д", "KeyL"),
    press(" ", "Space"),
    press("Enter", "Enter"),
    press("Enter", "Enter", { shiftKey: true }),
    press("Enter", "Enter", { altKey: true }),
    ctrl("Enter", "Enter"),
    ctrl("ArrowLeft", "ArrowLeft"),
    ctrl("Backspace", "Backspace"),
    press("ArrowUp", "ArrowUp", { altKey: true }),
    ...["a", "c", "v", "x", "y", "z"].map((key) => ctrl(key, `Key${key.toUpperCase()}`)),
    ctrl("с", "KeyC"), // Cyrillic
    ctrl("Z", "KeyZ", { shiftKey: true }),
    ctrl("V", "KeyV", { shiftKey: true }),
    press("Dead", "BracketLeft"),
    ctrl("@", "KeyQ", { altKey: true, modifierAltGraph: true }),
  ])("does not have %#", (event) => expect(isHosts(event)).toBe(false));
});

describe("a part", () => {
  let reached: string[];
  let asked: string[];
  let field: HTMLTextAreaElement;
  let end: AbortController;

  beforeEach(() => {
    document.body.innerHTML = "<div><textarea></textarea></div>";
    const root = document.body.firstElementChild as HTMLElement;
    field = root.firstElementChild as HTMLTextAreaElement;
    [reached, asked, end] = [[], [], new AbortController()];
    keepKeys(root, end.signal, (op) => asked.push(op));
    field.addEventListener("keydown", (event) => reached.push(`field ${event.key}`));
    document.body.addEventListener("keydown", (event) => reached.push(event.key), { signal: end.signal });
    return () => end.abort();
  });

  const label = () => field.getAttribute("data-lm-suppress-shortcuts");

  it("keeps what types, and lets the host's through", () => {
    field.dispatchEvent(press("d", "KeyD"));
    expect([reached, label()]).toEqual([["field d"], "true"]);
    field.dispatchEvent(ctrl("s", "KeyS"));
    expect([reached.slice(1), label()]).toEqual([["field s", "s"], null]);
    field.dispatchEvent(press("d", "KeyD"));
    expect(label()).toBe("true");
  });

  it("says so before a host that captures keys looks", () => {
    const seen: (string | null)[] = [];
    document.addEventListener("keydown", () => seen.push(label()), { capture: true, signal: end.signal });
    for (const event of [press("d", "KeyD"), ctrl("s", "KeyS")]) field.dispatchEvent(event);
    expect(seen).toEqual(["true", null]);
  });

  it("hides from the host that a line is broken", () => {
    const event = new InputEvent("beforeinput", { inputType: "insertLineBreak", bubbles: true, cancelable: true });
    field.addEventListener("beforeinput", (own) => own.preventDefault(), { once: true });
    expect(field.dispatchEvent(event)).toBe(true);
  });

  it("sends undo to its history, in place of the field's own", () => {
    const event = ctrl("я", "KeyZ");
    expect(field.dispatchEvent(event)).toBe(false);
    field.dispatchEvent(ctrl("z", "KeyZ", { shiftKey: true }));
    expect(asked).toEqual(["undo", "redo"]);
    expect(reached.filter((key) => !key.startsWith("field"))).toEqual([]);
  });

  it("gives the input method its keys, whatever they are", () => {
    for (const held of [{ isComposing: true }, { keyCode: 229 }])
      for (const event of [press("Enter", "Enter", held), ctrl("z", "KeyZ", held), press("Escape", "Escape", held)])
        expect(field.dispatchEvent(event)).toBe(true);
    expect([reached, asked]).toEqual([[], []]);
  });

  it("tells a field of what was composed when it is whole, and lets it alone until then", () => {
    const heard: string[] = [];
    field.addEventListener("input", () => heard.push(field.value));
    const type = (text: string, isComposing: boolean) => {
      field.value = text;
      field.dispatchEvent(new InputEvent("input", { bubbles: true, isComposing }));
    };
    field.dispatchEvent(new CompositionEvent("compositionstart", { bubbles: true }));
    type("か", true);
    write(field, "from elsewhere");
    expect([heard, field.value]).toEqual([[], "か"]);
    type("間", true);
    field.dispatchEvent(new CompositionEvent("compositionend", { bubbles: true }));
    expect(heard).toEqual(["間"]);
    write(field, "from elsewhere");
    expect(field.value).toBe("from elsewhere");
    type("x", false);
    expect(heard).toEqual(["間", "x"]);
  });

  it("types a line with Ctrl+Enter, once", () => {
    write(field, "ab");
    field.setSelectionRange(1, 1);
    expect(field.dispatchEvent(ctrl("Enter", "Enter"))).toBe(false);
    expect([field.value, field.selectionEnd]).toEqual(["a\nb", 2]);
  });

  it("leaves a field with Escape", () => {
    field.focus();
    field.dispatchEvent(press("Escape", "Escape"));
    expect([document.activeElement, reached.at(-1)]).toEqual([document.body, "Escape"]);
  });

  it("listens no more when its view has ended", () => {
    end.abort();
    field.dispatchEvent(ctrl("z", "KeyZ"));
    expect(asked).toEqual([]);
  });

  it("does not undo the history for what is typed and not committed", () => {
    const input = document.createElement("input");
    field.replaceWith(input);
    holdBack(input, () => "Bx");
    input.value = "Bxy";
    expect(input.dispatchEvent(ctrl("z", "KeyZ"))).toBe(true);
    expect(asked).toEqual([]);
    input.value = "Bx";
    input.dispatchEvent(ctrl("z", "KeyZ"));
    expect(asked).toEqual(["undo"]);
  });

  it("gives back the old name on Escape, and nothing else is given up", () => {
    const names: string[] = [];
    const name = nameField({ label: "Name", value: () => "Bx", commit: (to) => names.push(to) });
    field.replaceWith(name.el);
    const input = name.el as HTMLInputElement;
    name.update();
    input.focus();
    input.value = "Cx";
    expect(input.dispatchEvent(press("Escape", "Escape"))).toBe(false);
    expect([input.value, names, document.activeElement]).toEqual(["Bx", [], document.body]);
    expect(input.dispatchEvent(press("Escape", "Escape"))).toBe(true);
  });
});

describe("a step", () => {
  it.each([
    [0.65, 1, { step: 0.1 }, 0.75],
    [0.65, 1, { step: 0.05 }, 0.7],
    [0.65, 1, { step: 0.15 }, 0.8],
    [1.25, -1, { step: 0.1 }, 1.15],
    [0.1, 2, { step: 0.1 }, 0.3],
    [0.30000000000000004, 1, { step: 0.1 }, 0.4],
    [1.005, 1, { step: 0.1 }, 1.105],
    [1e-7, 1, { step: 0.1 }, 0.1000001],
    [-0.05, 1, { step: 0.05 }, 0],
    [0.05, -1, { step: 0.1, min: 0.1 }, 0.05], // never upwards
    [0.05, 1, { step: 0.1, min: 0.1 }, 0.15],
    [-3, 1, { step: 0.1, min: 0.1 }, 0.1],
    [0.15, -1, { step: 0.1, min: 0.1 }, 0.1],
    [23.9, 1, { step: 0.25, max: 24 }, 24],
    [50, 1, { step: 0.1, max: 40 }, 50], // never downwards
    [50, -1, { step: 0.1, max: 40 }, 40],
    [12345.300000000001, 1, { step: 0.1 }, 12345.4],
    [0.1, -1, { step: 0.1 }, 0],
    [1.5, 1, { step: 1, whole: true }, 2],
    [1.5, -1, { step: 1, whole: true }, 1],
    [3, 10, { step: 1, whole: true, min: -99 }, 13],
  ])("from %d by %d with %o is %d", (value, steps, range, next) => expect(stepped(value, steps, range)).toBe(next));

  it("is told as if it had been typed", () => {
    const input = document.createElement("input");
    stepByKeys(input, { step: 0.05, min: 0 }, () => 0.3);
    const heard: string[] = [];
    for (const name of ["input", "change"]) input.addEventListener(name, () => heard.push(`${name} ${input.value}`));
    const down = (key: string, held: KeyboardEventInit = {}) => input.dispatchEvent(press(key, key, held));
    expect(down("ArrowUp")).toBe(false);
    expect(heard).toEqual(["input 0.3", "change 0.3"]);
    down("ArrowUp", { shiftKey: true });
    expect(input.value).toBe("0.8");
    down("PageDown");
    expect(input.value).toBe("0.3");
    expect([down("ArrowUp", { altKey: true }), down("ArrowLeft")]).toEqual([true, true]);
    input.readOnly = true;
    down("ArrowUp");
    expect(input.value).toBe("0.3");
  });
});

describe("writing into a field", () => {
  it.each([
    ["abc", "abXc", [2, 0, 1]],
    ["abXc", "abc", [2, 1, 0]],
    ["aaa", "aa", [2, 1, 0]],
    ["", "new", [0, 0, 3]],
    ["same", "same", [4, 0, 0]],
  ])("%s to %s", (old, now, [from, gone, come]) => expect(difference(old, now)).toEqual({ from, gone, come }));

  const area = (text: string, at: number) => {
    document.body.innerHTML = "<textarea></textarea>";
    const field = document.body.firstElementChild as HTMLTextAreaElement;
    field.value = text;
    field.focus();
    field.setSelectionRange(at, at);
    return field;
  };

  it("keeps the caret at its letters", () => {
    for (const [at, moved] of [
      [1, 1],
      [5, 8],
    ] as const) {
      const field = area("one two", at);
      write(field, "one or two");
      expect(field.selectionEnd).toBe(moved);
    }
  });

  it("follows what is undone", () => {
    const field = area("one or two", 10);
    write(field, "one two", true);
    expect(field.selectionEnd).toBe(4);
  });

  it("takes ends of lines of other systems for its own", () => {
    const field = area("a\nb", 1);
    write(field, "a\r\nb");
    expect(field.selectionEnd).toBe(1);
  });
});
