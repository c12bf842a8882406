import { beforeEach, describe, expect, it } from "vitest";
import { editor } from "../../src/texture/editor.ts";
import { Session } from "../../src/texture/session.ts";
import { FakeConnection, FakeModel } from "../shared/fake.ts";

const RED = "S -> Mat(Color, 0, 1, 0, 0, 1)";
let connection: FakeConnection;
let model: FakeModel;
let session: Session;
let end: AbortController;
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
  connection = new FakeConnection();
  Object.assign(model.widget_manager, { kernel: connection });
  session = Session.of(model);
  end = new AbortController();
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

describe("a connection that is lost", () => {
  const lose = () => connection.turn({ connectionStatus: "connecting" });
  const back = (heard: number) => {
    connection.turn({ connectionStatus: "connected" });
    expect(session.live).toBe(false); // not before the kernel has answered
    model.emit("msg:custom", { kind: "pong", heard: { [session.client]: heard } });
    expect(session.live).toBe(true);
  };
  const edits = () => model.asked.filter(({ op }) => op !== "ping").map(({ op, value, seq }) => [value ?? op, seq]);

  it("keeps what was entered, and sends again what was lost", () => {
    session.set("hour", 12);
    lose();
    session.set("hour", 13);
    session.ask("undo"); // of a kernel that is away nothing is asked
    expect(session.hour).toBe(13);
    back(0);
    expect(edits()).toEqual([
      [12, 1],
      [12, 1],
    ]);
    answer({ hour: 12 });
    expect(edits().at(-1)).toEqual([13, 2]);
    answer({ hour: 13 });
    expect([session.waits, edits().length]).toEqual([false, 3]);
  });

  it("does nothing twice", () => {
    session.ask("undo");
    session.set("hour", 12);
    lose();
    back(1);
    expect(edits()).toEqual([
      ["undo", 1],
      [12, 2],
    ]);
  });

  it("waits for the connection where the answer comes before it is known to be back", () => {
    session.set("hour", 12);
    session.set("hour", 13);
    lose();
    answer({ hour: 12 }); // all traits are told again before the kernel says what it has heard
    expect(edits()).toHaveLength(1);
    back(1);
    expect(edits().at(-1)).toEqual([13, 2]);
    expect(edits()).toHaveLength(2);
  });

  it("makes the editor read only meanwhile", () => {
    answer({ can_undo: true, can_redo: true });
    expect([field.readOnly, undo.disabled, redo.disabled]).toEqual([false, false, false]);
    lose();
    expect([field.readOnly, undo.disabled, redo.disabled]).toEqual([true, true, true]);
    back(0);
    expect([field.readOnly, undo.disabled, redo.disabled]).toEqual([false, false, false]);
  });
});

describe("a kernel that has gone", () => {
  it("leaves what was entered for every view, and for those that are made later", () => {
    type(`${RED} `);
    type(`${RED}  `);
    session.ask("undo");
    session.set("hour", 13);
    connection.say(true);
    expect([session.waits, model.get("text"), model.get("hour")]).toEqual([true, `${RED}  `, 13]);
    expect([field.value, field.readOnly, undo.disabled]).toEqual([`${RED}  `, true, true]);
    end.abort();
    end = new AbortController();
    document.body.replaceChildren(editor(session, end.signal));
    field = document.querySelector("textarea") as HTMLTextAreaElement;
    expect([field.value, field.readOnly, session.waits]).toEqual([`${RED}  `, true, true]);
    expect(model.asked).toHaveLength(1);
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

  it("shows at once what is typed in another editor of the grammar", () => {
    document.body.append(editor(session, end.signal));
    type("a");
    expect([...document.querySelectorAll("textarea")].map(({ value }) => value)).toEqual(["a", "a"]);
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
