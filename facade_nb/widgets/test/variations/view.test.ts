import { beforeEach, expect, it } from "vitest";
import { Session } from "../../src/variations/session.ts";
import { variations } from "../../src/variations/view.ts";
import { FakeModel } from "../shared/fake.ts";

class Sight {
  observe(): void {}
  disconnect(): void {}
}

let channel: FakeModel;
let model: FakeModel;
let end: AbortController;
const rows = () => [...document.querySelectorAll<HTMLElement>(".fnb-var-row")];
const order = () => rows().map((row) => row.dataset.row);

function open(live: boolean): void {
  Object.assign(globalThis, { IntersectionObserver: Sight });
  channel = new FakeModel({
    name: "House",
    columns: ["width"],
    rows: [
      { values: [9], opens: true, state: "done", windows: 13, shapes: 33, cost: [1, 2], seconds: 0.1 },
      { values: [0.3], opens: true, state: "error", error: "too <b>narrow</b>" },
      { values: [6], opens: true, state: "waiting" },
    ],
    state: { running: live, opened: -1 },
    pictures: null,
    trouble: "",
  });
  channel.comm_live = live;
  model = new FakeModel({ sort: "", look: "table" });
  end = new AbortController();
  document.body.replaceChildren(variations(Session.of(channel), model, end.signal));
}

beforeEach(() => () => end.abort());

it("without a kernel is read and sorted, and asks for nothing", () => {
  open(false);
  document.querySelector<HTMLElement>("th button")?.click();
  expect(order()).toEqual(["1", "2", "0"]);
  for (const row of rows()) row.click();
  expect(channel.asked).toEqual([]);
  expect(document.querySelector<HTMLElement>(".fnb-var-run")?.hidden).toBe(true);
  expect(rows()[0]?.querySelector(".fnb-var-error")?.textContent).toBe("too <b>narrow</b>");
});

it("opens a row by Enter where it stands, and keeps the focus there as the rows are sorted anew", () => {
  open(true);
  rows()[0]?.focus();
  rows()[0]?.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));
  expect(channel.asked.at(-1)).toMatchObject({ op: "open", row: 0 });
  model.set("sort", "width");
  expect(order()).toEqual(["1", "2", "0"]);
  expect((document.activeElement as HTMLElement).dataset.row).toBe("0");
  expect(rows().filter((row) => row.tabIndex === 0)).toHaveLength(1);
  expect(document.querySelector(".fnb-var-said")?.textContent).toBe("2 of 3 solved, 1 without a layout");
});
