// A material chosen by its colour and its whole name.

import { h, mark, setText } from "./dom.ts";
import type { Field } from "./fields.ts";
import { placeUnder } from "./placing.ts";

export interface SwatchOptions {
  label: string;
  value: () => string;
  choices: () => string[];
  colours: () => Record<string, string>;
  choose: (name: string) => void;
}

/** The colour that stands for a material; a material may be a colour itself. */
export function colourOf(name: string, colours: Record<string, string>): string {
  return colours[name] ?? (/^#(?:[0-9a-f]{3}|[0-9a-f]{6})$/i.test(name) ? name : "#bbb");
}

/** A button that shows the material, and opens the list of all of them. */
export function swatchField(options: SwatchOptions): Field {
  const dot = h("span", { class: "fnb-swatch" });
  const name = h("span", { class: "fnb-swatch-name" });
  const open = h(
    "button",
    { type: "button", class: "fnb-swatch-button", "aria-label": options.label, "aria-haspopup": "listbox" },
    dot,
    name,
  );
  const list = h("div", { class: "fnb-swatches", role: "listbox", "aria-label": "Materials" });
  const own = h("input", {
    type: "text",
    class: "fnb-swatch-own",
    "aria-label": "A colour or a rule of a grammar",
    placeholder: "#c8b9a0",
    spellcheck: "false",
    autocomplete: "off",
  });
  const popup = h("div", { class: "fnb-swatch-popup", hidden: true }, list, own);
  const el = h("span", { class: "fnb-swatch-field" }, open, popup);

  const close = (refocus: boolean) => {
    if (refocus) open.focus({ preventScroll: true });
    popup.hidden = true;
    mark(open, "aria-expanded", "false");
  };
  const choose = (material: string) => {
    close(true);
    if (material !== options.value()) options.choose(material);
    update();
  };
  const show = () => {
    const value = options.value();
    list.replaceChildren(
      ...options.choices().map((material) => {
        const colour = h("span", { class: "fnb-swatch" });
        colour.style.background = colourOf(material, options.colours());
        const option = h(
          "button",
          { type: "button", role: "option", class: "fnb-swatch-option", "aria-selected": String(material === value) },
          colour,
          material,
        );
        option.addEventListener("click", () => choose(material));
        return option;
      }),
    );
    own.value = options.choices().includes(value) ? "" : value;
    popup.hidden = false;
    mark(open, "aria-expanded", "true");
    placeUnder(open, popup);
    const picked = list.querySelector<HTMLElement>("[aria-selected=true]") ?? list.querySelector("button");
    picked?.focus({ preventScroll: true });
    picked?.scrollIntoView?.({ block: "nearest" });
  };
  open.addEventListener("click", () => (popup.hidden ? show() : close(true)));
  own.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || !own.value.trim()) return;
    event.preventDefault();
    choose(own.value.trim());
  });
  popup.addEventListener("keydown", (event) => {
    if (event.key === "Escape") {
      event.preventDefault();
      event.stopPropagation();
      close(true);
      return;
    }
    const steps: Record<string, number> = { ArrowDown: 1, ArrowUp: -1, ArrowRight: 1, ArrowLeft: -1 };
    const all = [...list.children] as HTMLElement[];
    const at = all.indexOf(event.target as HTMLElement);
    if (at < 0) return;
    const step = steps[event.key];
    const named = all.findIndex((one, i) => i > at && one.textContent?.startsWith(event.key.toLowerCase()));
    const first = all.findIndex((one) => one.textContent?.startsWith(event.key.toLowerCase()));
    const to =
      step !== undefined ? at + step : event.key.length === 1 && event.key !== " " ? (named < 0 ? first : named) : -1;
    if (step === undefined && to < 0) return;
    event.preventDefault();
    all[Math.max(0, Math.min(all.length - 1, to))]?.focus();
  });
  el.addEventListener("focusout", (event) => {
    if (!popup.hidden && event.relatedTarget instanceof Node && !el.contains(event.relatedTarget)) close(false);
  });
  const update = () => {
    const value = options.value();
    dot.style.background = colourOf(value, options.colours());
    setText(name, value);
    mark(open, "title", value);
  };
  return { el, update };
}
