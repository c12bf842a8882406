// Arrow keys in whatever holds a number: one step up or down from what stands there, in decimals.

export interface Range {
  step: number;
  min?: number;
  max?: number;
  /** Whether only whole numbers are meant. */
  whole?: boolean;
}

const MOST = 12; // decimals
const DIGITS = 14; // in all; what lies behind them is the noise of sums
const FAR = 10; // steps at a time, with Shift or by page

function decimals(value: number): number {
  const [digits = "", power = "0"] = String(value).split("e");
  return Math.max(0, (digits.split(".")[1]?.length ?? 0) - Number(power));
}

/** So many steps from a value. It goes no further than the bounds, and never the other way, wherever the value is. */
export function stepped(value: number, steps: number, { step, min = -Infinity, max = Infinity, whole }: Range): number {
  const digits = Math.min(MOST, Math.max(decimals(value), decimals(step)));
  let next = Number(Number((value + steps * step).toFixed(digits)).toPrecision(DIGITS));
  if (whole) next = steps > 0 ? Math.floor(next) : Math.ceil(next);
  next = Math.min(max, Math.max(min, next));
  return steps > 0 ? Math.max(value, next) : Math.min(value, next);
}

const STEPS: Record<string, number> = { ArrowUp: 1, ArrowDown: -1, PageUp: FAR, PageDown: -FAR };
const SIDEWAYS: Record<string, number> = { ...STEPS, ArrowRight: 1, ArrowLeft: -1 };

/** How many steps a key asks for; 0: none. Sideways, where the arrows have no caret to move. */
export function stepsOf(event: KeyboardEvent, sideways = false): number {
  if (event.ctrlKey || event.metaKey || event.altKey) return 0;
  const steps = (sideways ? SIDEWAYS : STEPS)[event.key] ?? 0;
  return event.shiftKey && Math.abs(steps) === 1 ? steps * FAR : steps;
}

/** Have the arrow keys step the number in a field, which is told as if it had been typed. Empty, it begins with `start`. */
export function stepByKeys(input: HTMLInputElement, range: Range, start = () => range.min ?? 0): void {
  input.addEventListener("keydown", (event) => {
    const steps = stepsOf(event);
    if (!steps || input.readOnly) return;
    event.preventDefault();
    const typed = Number(input.value.replace(",", "."));
    const none = input.value.trim() === "" || !Number.isFinite(typed);
    const next = none ? start() : stepped(typed, steps, range);
    if (!none && next === typed) return;
    input.value = String(next);
    for (const name of ["input", "change"]) input.dispatchEvent(new Event(name, { bubbles: true }));
  });
}
