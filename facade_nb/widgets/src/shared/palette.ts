// One colour for each symbol, in texts, tables and on the façade. Each is legible as a letter on the page, light or dark (4.5
// to 1), and any two of the first 48 can be told apart in both (0.045 in OKLab, where 0.02 is just seen). They were
// chosen one after the other, each as far as can be from those before; so few symbols are far apart.

/** Step of lightness, which each theme has its own of (base.css), then chroma and hue of OKLCH. */
export type Shade = readonly [tone: 0 | 1 | 2, chroma: number, hue: number];

export const SHADES: readonly Shade[] = [
  [2, 0.14, 246],
  [2, 0.145, 48],
  [2, 0.175, 144],
  [2, 0.2, 324],
  [1, 0.095, 102],
  [1, 0.12, 0],
  [2, 0.043, 180],
  [1, 0.105, 288],
  [0, 0.115, 144],
  [2, 0.2, 6],
  [2, 0.175, 288],
  [0, 0.03, 258],
  [2, 0.09, 324],
  [1, 0.085, 222],
  [0, 0.07, 84],
  [1, 0.145, 144],
  [2, 0.11, 90],
  [1, 0.185, 330],
  [1, 0.12, 48],
  [2, 0.09, 18],
  [1, 0.05, 156],
  [1, 0.05, 24],
  [2, 0.2, 30],
  [2, 0.074, 270],
  [2, 0.12, 162],
  [0, 0.065, 174],
  [2, 0.095, 216],
  [2, 0.13, 120],
  [2, 0.054, 66],
  [1, 0.045, 270],
  [1, 0.083, 330],
  [2, 0.2, 348],
  [2, 0.2, 306],
  [1, 0.14, 312],
  [0, 0.035, 24],
  [2, 0.165, 270],
  [2, 0.077, 138],
  [1, 0.1, 258],
  [1, 0.1, 162],
  [1, 0.041, 90],
  [0, 0.085, 120],
  [1, 0.15, 342],
  [1, 0.095, 72],
  [2, 0.095, 186],
  [1, 0.11, 24],
  [2, 0.12, 66],
  [0, 0.055, 324],
  [1, 0.115, 126],
];

/** Lightness by step, as base.css has it. */
export const TONES = { light: [0.36, 0.46, 0.55], dark: [0.93, 0.8, 0.68] } as const;

/** The colour of a place in the palette, for CSS. After 48 they come again. */
export function colourAt(slot: number): string {
  const [tone, chroma, hue] = SHADES[slot % SHADES.length] as Shade;
  return `oklch(var(--fnb-tone-${tone}) ${chroma} ${hue})`;
}

const given = new Map<string, Map<string, number>>();

/**
 * The places of a design's symbols. A symbol keeps its place while it is there, whatever comes and goes beside it; a new one
 * takes the first that is free, so that one that is renamed keeps its colour.
 */
export function slotsOf(key: string, names: readonly string[]): ReadonlyMap<string, number> {
  const before = given.get(key) ?? new Map<string, number>();
  if (before.size === names.length && names.every((name) => before.has(name))) return before;
  const slots = new Map<string, number>();
  for (const name of names) {
    const slot = before.get(name);
    if (slot !== undefined) slots.set(name, slot);
  }
  const taken = new Set(slots.values());
  let next = 0;
  for (const name of names) {
    if (slots.has(name)) continue;
    while (taken.has(next)) next += 1;
    taken.add(next);
    slots.set(name, next);
  }
  given.set(key, slots);
  return slots;
}
