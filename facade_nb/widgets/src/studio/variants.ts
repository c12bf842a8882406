import { focused, focusMain, h, setText } from "../shared/dom.ts";
import { button, type Field, formatNumber } from "../shared/fields.ts";
import type { Store } from "../shared/store.ts";
import { swatchField } from "../shared/swatches.ts";
import type { Path, VariantState } from "../shared/types.ts";
import { materialsOf, swatchesOf } from "./common.ts";
import { geometryField } from "./geometry.ts";

interface VariantsOptions {
  label: string;
  path: () => Path;
  own: () => VariantState[];
}

type Loose = { [name: string]: unknown };

const INHERITED = "as the shape";

/** The variants of a shape: each with a weight and what it has of its own. Each instance takes one, by the seed. */
export function variantsForm(store: Store, { label, path, own }: VariantsOptions): Field {
  const count = h("span", { class: "fnb-count" });
  const list = h("div", { class: "fnb-variants-list" });
  const seed = h("input", {
    type: "text",
    inputmode: "numeric",
    class: "fnb-number",
    "aria-label": "Seed of the design, which chooses among variants",
    spellcheck: "false",
    autocomplete: "off",
  });
  onChange(seed, () => store.set(["seed"], seed.value));
  let sent: Loose[] = [];
  /** The variants with what was changed and is not answered yet. */
  const current = (): Loose[] => (store.pending(path()) ? sent : own().map((variant) => ({ ...variant })));
  const send = (next: Loose[]) => {
    sent = next;
    store.set(path(), next);
  };
  const add = h("button", { type: "button", class: "fnb-fix" }, "Add a variant");
  add.addEventListener("click", () => {
    const materials = materialsOf(store);
    const taken = current().map((variant) => variant.material);
    const material = materials.find((name) => !taken.includes(name));
    send([...current(), { weight: 1, material }]);
  });
  const seeded = h("label", { title: "Another seed chooses other variants, the same ones each time" }, "seed", seed);
  const el = h(
    "div",
    { class: "fnb-variants", role: "group", "aria-label": `Variants of ${label}` },
    h(
      "div",
      { class: "fnb-variants-head" },
      h("span", { title: "Each instance takes one of them, by their weights and the seed" }, "variants", count),
      add,
      seeded,
    ),
    list,
  );

  const change = (at: number, name: string, value: unknown) => {
    const next = [...current()];
    if (!next[at]) return;
    next[at] = { ...next[at], [name]: value === "" || value === INHERITED ? null : value };
    send(next);
  };
  const row = (variant: VariantState, at: number): HTMLElement => {
    const named = (name: string) => `${name} of variant ${at + 1} of ${label}`;
    const text = (name: "weight" | "kind" | "offset" | "thickness", placeholder: string) => {
      const value = variant[name];
      const input = h("input", {
        type: "text",
        class: name === "kind" ? "fnb-kind" : "fnb-number",
        "aria-label": named(name),
        placeholder,
        spellcheck: "false",
        autocomplete: "off",
      });
      input.value = typeof value === "number" ? formatNumber(value) : (value ?? "");
      onChange(input, () => change(at, name, input.value.trim()));
      return h("label", {}, name, input);
    };
    const material = swatchField({
      label: named("material"),
      value: () => variant.material ?? INHERITED,
      choices: () => [INHERITED, ...materialsOf(store)],
      colours: () => swatchesOf(store),
      choose: (to) => change(at, "material", to),
    });
    material.update();
    const geometry = geometryField({
      label: named("geometry"),
      value: () => variant.geometry ?? INHERITED,
      names: () => [INHERITED, ...store.get("catalogue").geometries],
      parameters: (name) => store.get("catalogue").parameters?.[name] ?? [],
      set: (to) => change(at, "geometry", to),
    });
    geometry.update();
    const remove = button(`Remove variant ${at + 1} of ${label}`, "close", () =>
      send(current().filter((_, i) => i !== at)),
    );
    return h(
      "div",
      { class: "fnb-variant" },
      text("weight", "1"),
      h("label", {}, "material", material.el),
      h("label", {}, "geometry", geometry.el),
      text("kind", "–"),
      text("offset", "–"),
      text("thickness", "–"),
      remove,
    );
  };
  let shown = "";
  return {
    el,
    update() {
      const variants = own();
      setText(count, variants.length ? String(variants.length) : "");
      seeded.hidden = variants.length === 0;
      const { cell } = store.get("selection");
      if (focused(seed) !== seed) seed.value = String(cell?.seed ?? 0);
      const key = JSON.stringify(variants);
      if (key === shown) return;
      shown = key;
      const at = focused(list)?.getAttribute("aria-label");
      const held = list.contains(focused(list));
      list.replaceChildren(...variants.map(row));
      if (!held) return;
      const again = [...list.querySelectorAll<HTMLElement>("[aria-label]")].find(
        (other) => other.getAttribute("aria-label") === at,
      );
      if (again) again.focus({ preventScroll: true });
      else if (!focusMain(list)) add.focus({ preventScroll: true });
    },
  };
}

/** Tell what was typed when the field is left, or by Enter. */
function onChange(input: HTMLInputElement, commit: () => void): void {
  input.addEventListener("change", commit);
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") input.dispatchEvent(new Event("change"));
  });
}
