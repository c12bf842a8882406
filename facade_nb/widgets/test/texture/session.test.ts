import { beforeEach, describe, expect, it } from "vitest";
import { editor } from "../../src/texture/editor.ts";
import { Session } from "../../src/texture/session.ts";
import { FakeModel } from "../shared/fake.ts";

const RED = "S -> Mat(Color, 0, 1, 0, 0, 1)";
let model: FakeModel;
let session: Session;
let field: HTMLTextAreaElement;
let undo: HTMLButtonElement;
let redo: HTMLButtonElement;

beforeEach(() => {
  model = new FakeModel({
    text: RED,
    size: [12, 9],
    seed: [0, 0],
    hour: 11,
    lit: true,
    faults: [],
    steps: [],
    point: [],
    ack: {},
    can_undo: false,
    can_redo: false,
  });
  session = Session.of(model);
  const end = new AbortController();
  document.body.replaceChildren(editor(session, end.signal));
  field = document.querySelector("textarea") as HTMLTextAreaElement;
  [undo, redo] = [...document.querySelectorAll<HTMLButtonElement>(".fnb-tex-tools button")] as [
    HTMLButtonElement,
    HTMLButtonElement,
  ];
  return () => end.abort();
});

const type = (text: string) => {
  field.value = text;
  field.dispatchEvent(new InputEvent("input", { bubbles: true }));
};
const answer = (change: Record<string, unknown> = {}) =>
  model.set({ ...change, ack: { client: session.client, seq: model.asked.at(-1)?.seq } });
const asked = () => model.asked.map((message) => message.value ?? message.op);

describe("a session", () => {
  it("asks for one thing at a time, in order, and of values for one name for the last", () => {
    session.set("hour", 12);
    session.set("hour", 13);
    session.set("hour", 14);
    session.ask("undo");
    session.ask("undo");
    session.set("hour", 15);
    session.set("hour", 16);
    expect(asked()).toEqual([12]);
    for (let n = 0; n < 4; n += 1) answer();
    expect(asked()).toEqual([12, 14, "undo", "undo", 16]);
    expect(session.hour).toBe(16);
    answer({ hour: 16 });
    expect(model.asked).toHaveLength(5);
  });

  it("does not take another page's answer for its own", () => {
    session.set("hour", 12);
    session.set("hour", 13);
    model.set({ ack: { client: "another", seq: 9 } });
    expect(asked()).toEqual([12]);
  });
});

describe("the editor", () => {
  it("says what can be undone", () => {
    expect([undo.disabled, redo.disabled]).toEqual([true, true]);
    type(`${RED} `);
    expect([undo.disabled, redo.disabled]).toEqual([false, true]);
    answer({ text: `${RED} `, can_undo: true });
    undo.click();
    expect(asked().at(-1)).toBe("undo");
    answer({ text: RED, can_undo: false, can_redo: true });
    expect([undo.disabled, redo.disabled]).toEqual([true, false]);
    redo.click();
    expect(asked().at(-1)).toBe("redo");
  });

  it("shows what undo brings back, with the caret where it was edited", () => {
    type(`${RED}\n# end`);
    answer({ text: `${RED}\n# end`, can_undo: true });
    field.setSelectionRange(0, 0);
    session.ask("undo");
    answer({ text: RED });
    expect([field.value, field.selectionEnd]).toEqual([RED, RED.length]);
  });

  it("is not written to while what is typed in it is under way", () => {
    type("a");
    type("ab");
    answer({ text: "a" });
    expect(field.value).toBe("ab");
    type("abc");
    answer({ text: "ab" });
    expect(field.value).toBe("abc");
    answer({ text: "abc" });
    model.set({ text: "from another view" });
    expect(field.value).toBe("from another view");
  });
});
