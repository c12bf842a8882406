import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { colourAt, SHADES, slotsOf, TONES } from "../../src/shared/palette.ts";

type Triple = [number, number, number];

/** A colour of OKLCH in OKLab, and as linear sRGB. */
function read(tones: readonly number[], slot: number): { lab: Triple; rgb: Triple } {
  const [tone, chroma, hue] = SHADES[slot] ?? [0, 0, 0];
  const light = tones[tone] ?? 0;
  const [a, b] = [chroma * Math.cos((hue * Math.PI) / 180), chroma * Math.sin((hue * Math.PI) / 180)];
  const l = (light + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (light - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (light - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return {
    lab: [light, a, b],
    rgb: [
      4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
      -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
      -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
    ],
  };
}

const themes = { light: 1, dark: 0.0056 } as const; // luminance of JupyterLab's pages

test.each(["light", "dark"] as const)("47 symbols can be read and told apart, %s", (theme) => {
  const colours = SHADES.slice(0, 47).map((_, slot) => read(TONES[theme], slot));
  let least = 1;
  for (const [i, { lab, rgb }] of colours.entries()) {
    for (const part of rgb) expect(part).toBeGreaterThan(-0.001);
    for (const part of rgb) expect(part).toBeLessThan(1.001);
    const light = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    const [low, high] = [light, themes[theme]].sort((a, b) => a - b) as [number, number];
    expect((high + 0.05) / (low + 0.05)).toBeGreaterThan(4.45);
    for (const other of colours.slice(0, i))
      least = Math.min(least, Math.hypot(...lab.map((part, n) => part - (other.lab[n] ?? 0))));
  }
  expect(least).toBeGreaterThan(0.045);
});

test("the style sheet has the palette's lightness", () => {
  const css = readFileSync("facade_nb/widgets/src/styles/base.css", "utf8");
  const found = [...css.matchAll(/--fnb-tone-\d: ([\d.]+)/g)].map((match) => Number(match[1]));
  expect(found).toEqual([...TONES.light, ...TONES.dark]);
});

test("a symbol keeps its colour while others come and go, and when it is renamed", () => {
  expect([...slotsOf("p", ["A", "B", "C"]).values()]).toEqual([0, 1, 2]);
  expect(slotsOf("p", ["Z", "A", "B", "C"]).get("C")).toBe(2);
  expect(slotsOf("p", ["Z", "A", "C"]).get("C")).toBe(2);
  expect(slotsOf("p", ["Z", "A", "B2", "C"]).get("B2")).toBe(1);
  expect(slotsOf("q", ["C"]).get("C")).toBe(0);
  const many = Array.from({ length: 48 }, (_, n) => `S${n}`);
  expect(new Set([...slotsOf("r", many).values()].map(colourAt)).size).toBe(48);
});
