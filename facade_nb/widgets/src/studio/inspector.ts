import { h, keyed, mark, setText } from "../shared/dom.ts";
import { button, draftOf, type Field, faultBox, formatNumber, numberField } from "../shared/fields.ts";
import { swatchField } from "../shared/swatches.ts";
import type { Cell, Level, LookState, Looks, Path, SelectionState } from "../shared/types.ts";
import { type Context, type MakePart, materialsOf, swatchesOf, tint } from "./common.ts";
import { geometryField } from "./geometry.ts";
import { variantsForm } from "./variants.ts";

/** Where an edit goes: to the shapes of whom, under which key. */
interface Place {
  /** Kept while one goes from shape to shape. */
  level: Level;
  /**
   * What the key means in words, as "this one"; the key itself is another one for each cell. Of a pair that is picked
   * next only "this one" is kept: whoever has edited a whole row means the next pair, not that row again.
   */
  means: string;
}

const NAMES = ["geometry", "material", "kind", "offset", "thickness", "visible"] as const;

/** The looks of what is picked: each value, who says it, and a field to change it for this one or for all like it. */
export const inspector: MakePart = (context) => {
  const { store } = context;
  const slot = h("div", { class: "fnb-inspector-slot" });
  const place: Place = { level: "layer", means: "" };
  const show = keyed<string>(
    slot,
    (key) => key,
    () => form(context, place),
  );
  store.watch(["selection", "drafts", "catalogue", "design"], () => {
    const { layer, x, y, more, cell } = store.get("selection");
    show(cell ? [JSON.stringify([layer, x, y, more.length > 0])] : []);
  });
  return slot;
};

function form({ store }: Context, place: Place): { el: HTMLElement; update(): void } {
  const selection = () => store.get("selection");
  const { layer, x, y, more } = selection();
  const key = `${x} ${y}`;
  const several = more.length > 0;
  const cell = () => selection().cell as Cell;
  const what = several ? "the picked pairs" : key;

  if (!place.means.startsWith("this one")) place.means = "";
  const chosen = () => (several ? pairsOf(selection()) : keyIn(cell(), place));
  const path = (attribute: string): Path => [...ownerOf(selection(), place), "shapes", chosen(), attribute];
  const own = () => (several ? undefined : cell().set[place.level]?.[chosen()]);
  /** What the field shows: what is said at the place that is edited, else what the cell looks like. */
  const value = (name: keyof Looks) => own()?.[name] ?? cell().fields[name].value;
  const set = (name: string, to: unknown) => store.set(path(name), to);

  const fields: Record<(typeof NAMES)[number], Field> = {
    geometry: geometryField({
      label: `geometry of ${what} in ${layer}`,
      value: () => String(draftOf(store, path("geometry"))?.value ?? value("geometry")),
      names: () => store.get("catalogue").geometries,
      parameters: (name) => store.get("catalogue").parameters?.[name] ?? [],
      set: (to) => set("geometry", to),
    }),
    material: swatchField({
      label: `material of ${what} in ${layer}`,
      value: () => String(draftOf(store, path("material"))?.value ?? value("material")),
      choices: () => materialsOf(store),
      colours: () => swatchesOf(store),
      choose: (to) => set("material", to),
    }),
    kind: kindField(
      `kind of ${what} in ${layer}`,
      () => String(value("kind")),
      (to) => set("kind", to),
    ),
    offset: number("offset"),
    thickness: number("thickness"),
    visible: visibleField(
      `${what} of ${layer} is visible`,
      () => value("visible") !== false,
      (to) => set("visible", to),
    ),
  };
  function number(name: "offset" | "thickness"): Field {
    return numberField(store, {
      label: `${name} of ${what} in ${layer} in metres`,
      get path() {
        return path(name);
      },
      value: () => formatNumber(value(name) as number),
      step: 0.05,
      min: name === "offset" ? -9 : 0,
    });
  }
  const boxes = NAMES.map((name) => {
    const origin = h("span", { class: "fnb-origin" });
    const reset = button(`Reset ${name} of ${what}`, "reset", () => set(name, null), {
      class: "fnb-button fnb-reset",
    });
    const el = h(
      "div",
      { class: "fnb-look", "data-look": name },
      h("span", { class: "fnb-look-name" }, name, reset),
      fields[name].el,
      origin,
    );
    const update = () => {
      fields[name].update();
      const look = cell().fields[name];
      const here = several || own()?.[name] !== undefined;
      setText(origin, several ? "" : originOf(look, selection()));
      mark(origin, "title", several ? null : originOf(look, selection()));
      mark(el, "data-here", here && !several);
      reset.hidden = !here;
    };
    return { el, update };
  });

  const level = h("select", { class: "fnb-select", "aria-label": "Whose shapes are edited" });
  level.addEventListener("change", () => {
    place.level = level.value as Level;
    update();
  });
  const keys = h("select", { class: "fnb-select fnb-place-key", "aria-label": "Which shapes are edited" });
  keys.addEventListener("change", () => {
    place.means = means(cell(), keys.value);
    update();
  });
  const places = h("div", { class: "fnb-places" }, h("span", {}, "edits"), keys, h("span", {}, "in"), level);

  const faults = faultBox(store, () => [...NAMES, "variants"].map(path));
  const size = h("span", { class: "fnb-inspector-size" });
  const variants = variantsForm(store, { path: () => path("variants"), own: () => own()?.variants ?? [], label: what });
  const letter = (symbol: string) => {
    const el = h("code", { class: "fnb-tinted" }, symbol);
    el.style.setProperty("--fnb-tint", tint(store, symbol));
    return el;
  };
  const title = h("span", { class: "fnb-inspector-title" }, h("b", {}, layer));
  if (several) title.append(h("span", {}, `${more.length + 1} pairs`));
  else title.append(letter(x), "×", letter(y));
  const head = h("div", { class: "fnb-inspector-head" }, title, size, places);
  const el = h(
    "div",
    { class: "fnb-inspector", role: "group", "aria-label": `Shape ${key} of layer ${layer}` },
    head,
    h("div", { class: "fnb-looks" }, ...boxes.map((box) => box.el)),
    variants.el,
    button("Clear the selection (Esc)", "close", () => store.ask({ op: "select" })),
    faults.el,
  );
  const update = () => {
    const { patterns, keys: known } = cell();
    const owners: [Level, string][] = [
      ["layer", `layer ${layer}`],
      ["x", `pattern ${patterns.x} ↔`],
      ["y", `pattern ${patterns.y} ↕`],
      ["design", "the design"],
    ];
    options(level, owners);
    level.value = place.level;
    keys.hidden = several;
    options(
      keys,
      known.map((own) => [own.key, `${own.means} · ${own.key}`]),
    );
    keys.value = keyIn(cell(), place);
    for (const box of boxes) box.update();
    variants.el.hidden = several;
    variants.update();
    faults.update();
    setText(size, sizeText(cell()));
  };
  return { el, update };
}

/** Whose shapes an edit changes, as the beginning of a path. */
export function ownerOf({ layer, cell }: SelectionState, { level }: Place): Path {
  if (level === "layer") return ["layers", layer];
  if (level === "design" || !cell) return [];
  return ["patterns", cell.patterns[level]];
}

/** All pairs that are picked, as keys on lines of their own. */
export function pairsOf({ x, y, more }: SelectionState): string {
  return [[x, y], ...more].map((pair) => pair.join(" ")).join("\n");
}

/** The key of a cell that means what was chosen last: "this one", or else all like it. */
export function keyIn(cell: Cell, { means: wanted }: { means: string }): string {
  const { keys } = cell;
  const like = keys.find((own) => own.means.startsWith("all ") && !own.means.startsWith("all of"));
  return (keys.find((own) => kindOf(own.means) === wanted) ?? like ?? keys[0])?.key ?? "";
}

function means(cell: Cell, key: string): string {
  return kindOf(cell.keys.find((own) => own.key === key)?.means ?? "");
}

/** The words without the symbols in them, which are others in another cell. */
function kindOf(words: string): string {
  if (words.startsWith("this one") || words === "everything") return words;
  if (words.startsWith("all of this")) return words;
  return words.startsWith("all ") ? "" : words;
}

/** Who says so, in words. */
export function originOf({ level, key, varied }: LookState, { layer, cell }: SelectionState): string {
  if (level === "") return "by default";
  const owner =
    level === "layer" ? layer : level === "design" ? "the design" : `pattern ${cell?.patterns[level as "x" | "y"]}`;
  return `${varied ? "variant of " : ""}${key} in ${owner}`;
}

function options(select: HTMLSelectElement, choices: [value: string, text: string][]): void {
  const state = JSON.stringify(choices);
  if (select.dataset.key === state) return;
  select.dataset.key = state;
  select.replaceChildren(...choices.map(([value, text]) => h("option", { value }, text)));
}

/** A free word, with those that are usual to choose from. */
function kindField(label: string, value: () => string, set: (to: string) => void): Field {
  const input = h("input", {
    type: "text",
    class: "fnb-kind",
    "aria-label": label,
    spellcheck: "false",
    autocomplete: "off",
  });
  const commit = () => {
    if (!input.readOnly && input.value.trim() !== value()) set(input.value.trim());
  };
  input.addEventListener("change", commit);
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") commit();
  });
  return {
    el: input,
    update() {
      if (!input.matches(":focus")) input.value = value();
    },
  };
}

function visibleField(label: string, value: () => boolean, set: (to: boolean) => void): Field {
  const toggle = h("button", { type: "button", class: "fnb-word", "aria-label": label });
  toggle.addEventListener("click", () => set(!value()));
  return {
    el: toggle,
    update() {
      mark(toggle, "aria-pressed", String(value()));
      setText(toggle, value() ? "visible" : "hidden");
    },
  };
}

function sizeText({ rect }: Cell): string {
  if (!rect) return "";
  const [left, bottom, right, top] = rect;
  return `${formatNumber(right - left, 2)} × ${formatNumber(top - bottom, 2)} m`;
}
