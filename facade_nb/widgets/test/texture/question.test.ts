// Which part of a split a pixel falls into is asked before its steps are shown, and can be worked out.

import { describe, expect, it } from "vitest";
import { inspector } from "../../src/texture/inspector.ts";
import { splitsOf } from "../../src/texture/question.ts";
import { Session } from "../../src/texture/session.ts";
import type { Step } from "../../src/texture/types.ts";
import { FakeModel } from "../shared/fake.ts";

// jsdom lays nothing out, so there is nothing to observe.
globalThis.ResizeObserver ??= class {
  observe(): void {}
  unobserve(): void {}
  disconnect(): void {}
};

const TEXT = `Bay -> SplitX(Rel, 1, Side, Abs, 1.2,
  Column, Rel, 1, Side)
Column -> SplitY(Abs, 0.9, Side, Rel, 1, Window)
Window -> Mat(Color, 0, 0, 0, 1, 1)
Side -> Skip(0)`;

const step = (rule: string, operator: string, text: string, [l, b, r, t]: [number, number, number, number]): Step => ({
  rule,
  operator,
  text,
  scope: [l, b, r, t],
  corners: [
    [l, b, 0],
    [r, b, 0],
    [r, t, 0],
    [l, t, 0],
  ],
  spot: [3.7, 1.5, 0],
  faces: [],
  layers: [],
  seeds: [],
  records: [[0, 0]],
  color: null,
});

const STEPS = [
  step("Bay", "SplitX", "part 2 of 3, from 3.15 to 4.35 m", [2.5, 0, 5, 3]),
  step("Column", "SplitY", "part 2 of 2, from 0.9 to 3 m", [3.15, 0, 4.35, 3]),
  step("Window", "Mat", "adds color 0, 0, 1, 1", [3.15, 0.9, 4.35, 3]),
];

describe("the splits of a pixel", () => {
  it("have what they can be worked out from", () => {
    const [bay, column] = splitsOf(TEXT, STEPS);
    expect(bay).toMatchObject({ options: ["Side", "Column"], right: "Column", at: 1.2000000000000002, size: 2.5 });
    expect(bay?.rule).toBe("Bay -> SplitX(Rel, 1, Side, Abs, 1.2, Column, Rel, 1, Side)");
    expect(column).toMatchObject({ options: ["Side", "Window"], right: "Window", at: 1.5, size: 3, across: false });
  });

  it("are not asked for where the pixel lies at a border, or the rule is not written", () => {
    const near = { ...(STEPS[0] as Step), spot: [3.16, 1.5, 0] as [number, number, number] };
    expect(splitsOf(TEXT, [near, ...STEPS.slice(1)]).map(({ step }) => step)).toEqual([1]);
    expect(splitsOf("", STEPS)).toEqual([]);
  });
});

describe("the inspector", () => {
  it("keeps the steps back while it asks, hints, and tells them then", () => {
    const model = new FakeModel({
      text: TEXT,
      size: [10, 9],
      seed: [0, 0],
      hour: 11,
      lit: true,
      faults: [],
      steps: STEPS,
      point: [3.7, 1.5],
    });
    const session = Session.of(model);
    const end = new AbortController();
    const el = inspector(session, end.signal);
    document.body.replaceChildren(el);
    const press = (name: string) => [...el.querySelectorAll("button")].find((own) => own.textContent === name)?.click();
    const listed = () => [...el.querySelectorAll(".fnb-tex-steps b")].map((own) => own.textContent);
    const choose = (name: string) =>
      [...el.querySelectorAll("li label")]
        .find((own) => own.textContent === name)
        ?.querySelector("input")
        ?.dispatchEvent(new Event("change"));
    expect(listed()).toEqual(["Bay", "Column", "Window"]);
    expect(el.querySelectorAll("[role=status]")).toHaveLength(1); // calm: nothing is there before it is asked for
    press("Predict");
    expect(listed()).toEqual(["Bay"]);
    expect(el.textContent).not.toContain("part 2 of 3");
    expect(session.steps).toHaveLength(1); // what all views of the texture show
    expect(el.querySelector(".fnb-quiz-prompt")?.textContent).toContain(
      "1.2 m from the left of a scope that is 2.5 m wide",
    );
    choose("Side");
    press("Check");
    expect(el.querySelector(".fnb-quiz-outcome")?.textContent).toBe("Not yet.");
    expect(el.querySelector(".fnb-quiz-hint")?.textContent).toContain("Rel parts share what is left");
    expect(listed()).toEqual(["Bay"]);
    choose("Column");
    press("Check");
    expect(el.querySelector(".fnb-quiz-outcome")?.textContent).toBe("Right. It lies in this part.");
    expect(listed()).toEqual(["Bay", "Column", "Window"]);
    press("Again"); // the next split
    expect(listed()).toEqual(["Bay", "Column"]);
    press("Predict");
    expect(listed()).toEqual(["Bay", "Column", "Window"]);
    end.abort();
  });
});
