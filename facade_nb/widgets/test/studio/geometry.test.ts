import { expect, test } from "vitest";
import { geometryField, readCall, writeCall } from "../../src/studio/geometry.ts";

test("a geometry with parameters is read and written alike", () => {
  for (const text of [
    "box",
    "arcade(bays=3, depth=1.5)",
    "sign(text=CAFÉ & 7)",
    "file:a (1).obj",
    "file:b.glb(fit=keep)",
  ])
    expect(writeCall(readCall(text))).toBe(text);
  expect(readCall("file:a (1).obj")).toEqual({ name: "file:", told: { file: "a (1).obj" } });
  expect(writeCall({ name: "arcade", told: { bays: "", depth: "2" } })).toBe("arcade(depth=2)");
});

test("a parameter that is typed is set beside the others, and an empty one left to the geometry", () => {
  let value = "arcade(bays=3)";
  const field = geometryField({
    label: "geometry",
    value: () => value,
    names: () => ["box", "arcade"],
    parameters: (name) => (name === "arcade" ? ["bays", "depth"].map((own) => [own, ""]) : []),
    set: (to) => {
      value = to;
      field.update();
    },
  });
  field.update();
  const inputs = [...field.el.querySelectorAll("input")];
  const type = (at: number, text: string) => {
    (inputs[at] as HTMLInputElement).value = text;
    inputs[at]?.dispatchEvent(new Event("change"));
  };
  expect(inputs.map((input) => input.value)).toEqual(["3", ""]);
  type(1, " 2.5 ");
  expect(value).toBe("arcade(bays=3, depth=2.5)");
  type(0, "");
  expect(value).toBe("arcade(depth=2.5)");
  value = "file:urn.obj";
  field.update();
  expect([...field.el.querySelectorAll<HTMLInputElement>(".fnb-parameter")].map((own) => own.value)).toEqual([
    "urn.obj",
    "",
  ]);
});
