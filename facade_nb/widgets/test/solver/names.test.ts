import { expect, it } from "vitest";
import { isShort, nameOf } from "../../src/solver/letters.ts";

it("symbols stand bare where patterns read them bare, as tests/design/test_names.py has them", () => {
  for (const name of ["A", "b2", "Δ", "漢", "É", "कि", "กู่", "שָ", "b२", "ㄱ", "ʌ"])
    expect([name, isShort(name)]).toEqual([name, true]);
  for (const name of ["ε", "window", "front door", "ˆ", "ª", "𝔣", "ⁿ", "A_1", "2", "♥", "ᄒ", "ℓ"])
    expect([name, isShort(name)]).toEqual([name, false]);
  expect(nameOf({ symbol: "कि", mirrored: true })).toBe("कि′");
});
