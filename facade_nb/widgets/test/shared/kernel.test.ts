import { beforeEach, describe, expect, it, vi } from "vitest";
import { absence } from "../../src/shared/absence.ts";
import { h } from "../../src/shared/dom.ts";
import { nameField } from "../../src/shared/fields.ts";
import { Kernel } from "../../src/shared/kernel.ts";
import { Store } from "../../src/shared/store.ts";
import { FakeConnection, FakeModel, fakeState } from "./fake.ts";

const BX = ["patterns", "Bx", "text"];

let connection: FakeConnection;
let model: FakeModel;
let end: AbortController;
let store: Store;

beforeEach(() => {
  document.body.replaceChildren();
  connection = new FakeConnection();
  model = new FakeModel({ ...fakeState() });
  Object.assign(model.widget_manager, { kernel: connection });
  end = new AbortController();
  store = new Store(model, end.signal);
});

describe("a kernel that ends", () => {
  it.each<[string, () => void, string]>([
    ["restarted by anyone", () => connection.say(true), "was restarted"],
    ["shut down by anyone", () => connection.say(false), "was shut down"],
    ["dead", () => connection.turn({ status: "autorestarting" }), "died and was started anew"],
    ["restarted here", () => connection.turn({ status: "restarting" }), "was restarted"],
    ["given up", () => connection.turn({ isDisposed: true }), "has ended"],
    ["closed by Python", () => model.emit("comm:close"), "has closed this view"],
  ])("is gone: %s", (_, act, fate) => {
    expect(store.kernel.presence).toBe("live");
    act();
    expect([store.kernel.presence, store.kernel.fate]).toEqual(["gone", fate]);
    const sent = model.sent.length;
    store.ask({ op: "undo" });
    end.abort();
    expect(model.sent).toHaveLength(sent);
  });

  it("stays gone, and a busy one does not go", () => {
    connection.turn({ status: "busy" });
    expect(store.live).toBe(true);
    connection.say(true);
    connection.turn({ status: "idle" });
    expect(store.kernel.presence).toBe("gone");
  });

  it("has died where that is told after the restart", () => {
    const told: string[] = [];
    store.kernel.watch(() => told.push(store.kernel.fate), end.signal);
    connection.turn({ status: "restarting" });
    connection.turn({ status: "autorestarting" });
    expect(told).toEqual(["was restarted", "died and was started anew"]);
  });

  it("takes its threads with it, where the application does not know that", () => {
    connection.say(true);
    expect(connection.commsOverSubshells).toBe("disabled");
  });

  it("leaves its threads to the application that restarts it", () => {
    connection.turn({ status: "restarting" });
    connection.say(true);
    expect(connection.commsOverSubshells).toBe("perCommTarget");
  });

  it("leaves what was typed in the browser's model, for every view", () => {
    store.set(BX, "A");
    store.set(BX, "AB");
    store.set(["canvas", "width"], "7");
    connection.say(false);
    expect(store.waits).toBe(true);
    expect(model.get("unsent")).toEqual([
      { path: BX, value: "A" },
      { path: BX, value: "AB" },
      { path: ["canvas", "width"], value: "7" },
    ]);
    const later = new Store(model, end.signal);
    expect([later.unsent(BX), later.waits]).toEqual(["AB", true]);
  });

  it("is no error where a message cannot be sent", () => {
    vi.spyOn(model, "send").mockImplementation(() => {
      throw new Error("Cannot send");
    });
    store.set(BX, "A");
    expect(store.kernel.presence).toBe("away");
  });

  it("is followed by nobody when its views have gone", () => {
    end.abort();
    expect(connection.statusChanged.size + connection.iopubMessage.size).toBe(0);
    expect(model.listening).toBe(0);
  });
});

describe("a connection that is lost", () => {
  const back = (heard: number) => {
    connection.turn({ connectionStatus: "connected" });
    expect(store.live).toBe(false); // not before the kernel has answered
    model.emit("msg:custom", { kind: "pong", heard: { [store.client]: heard } });
    expect(store.live).toBe(true);
  };

  it("keeps edits, and sends again what was lost", () => {
    store.set(BX, "A");
    connection.turn({ connectionStatus: "connecting" });
    expect(store.kernel.presence).toBe("away");
    store.set(BX, "AB");
    back(0);
    expect(model.asked.filter(({ op }) => op === "set").map(({ value }) => value)).toEqual(["A", "A"]);
  });

  it("does nothing twice", () => {
    store.ask({ op: "add", kind: "pattern" });
    store.set(BX, "A");
    connection.turn({ connectionStatus: "connecting" });
    back(1);
    expect(model.asked.filter(({ op }) => op !== "ping").map(({ op }) => op)).toEqual(["add", "set"]);
  });

  it("has gone if it comes back to another kernel", async () => {
    connection.turn({ connectionStatus: "connecting" });
    connection.comms = {};
    connection.turn({ connectionStatus: "connected" });
    await Promise.resolve();
    await Promise.resolve();
    expect([store.kernel.presence, store.kernel.fate]).toEqual(["gone", "was restarted"]);
  });
});

describe("a host that says nothing of its kernel", () => {
  it("is asked every second, and has lost it where nothing can be handed over", async () => {
    vi.useFakeTimers();
    const other = new FakeModel({ ...fakeState() });
    const kernel = Kernel.of(other);
    kernel.watch(() => {}, end.signal);
    await vi.advanceTimersByTimeAsync(5000);
    expect(kernel.live).toBe(true); // no answer is needed: it may be busy
    vi.spyOn(other, "send").mockImplementation(() => Promise.reject(new Error("no server")) as unknown as undefined);
    await vi.advanceTimersByTimeAsync(1000);
    expect(kernel.presence).toBe("away");
    vi.useRealTimers();
  });
});

describe("the notice", () => {
  it("holds the controls and keeps what stands in the fields", () => {
    const commit = vi.fn();
    const name = nameField({ label: "Name", value: () => "Bx", commit });
    name.update();
    const press = vi.fn();
    const button = h("button", {}, "Press");
    const local = h("button", { "data-local": true }, "Fold");
    for (const one of [button, local]) one.addEventListener("click", press);
    const group = h("input", { type: "text", value: "roof" });
    const change = vi.fn();
    group.addEventListener("change", change);
    const root = h("div", {}, name.el, button, local, group);
    document.body.append(root);
    const notice = absence(root, store.kernel, end.signal, { what: "façade", unsent: () => true }).el;
    const field = name.el as HTMLInputElement;
    field.focus();
    field.value = "Byy";

    expect(notice.hidden).toBe(true);
    connection.turn({ connectionStatus: "connecting" });
    expect(notice.textContent).toMatch(/^No connection.*still stands in its field/);
    expect([field.readOnly, button.ariaDisabled, local.ariaDisabled]).toEqual([true, "true", null]);
    field.blur();
    name.update();
    expect(field.value).toBe("Byy");
    button.click();
    local.click();
    group.dispatchEvent(new Event("change", { bubbles: true })); // it had been typed in, and was left now
    expect(change).not.toHaveBeenCalled();
    expect(press).toHaveBeenCalledTimes(1);

    const went: string[] = [];
    document.addEventListener("keydown", ({ key }) => went.push(key), { signal: end.signal });
    const pressed = (key: string, ctrlKey: boolean) =>
      field.dispatchEvent(new KeyboardEvent("keydown", { key, ctrlKey, bubbles: true, cancelable: true }));
    expect([pressed("z", true), pressed("a", true), pressed("x", false), pressed("s", true)]).toEqual([
      false, // the browser's own undo
      true,
      true,
      true,
    ]);
    expect(went).toEqual(["s"]); // the host's alone

    connection.turn({ connectionStatus: "connected" });
    model.emit("msg:custom", { kind: "pong", heard: {} });
    expect([notice.hidden, field.readOnly, button.ariaDisabled]).toEqual([true, false, null]);
    expect(commit).toHaveBeenCalledExactlyOnceWith("Byy");
    expect(change).toHaveBeenCalledTimes(1);
  });
});
