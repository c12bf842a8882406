import { focused, h, mark } from "../shared/dom.ts";
import { type IconName, icon } from "../shared/icons.ts";

export interface Popover {
  el: HTMLElement;
  body: HTMLElement;
  button: HTMLButtonElement;
  open(on: boolean): void;
}

/** A button with a panel that opens below it, and closes by Esc, by a press beside it, or when `open(false)` is called. */
export function popover(
  label: string,
  name: IconName,
  body: HTMLElement,
  signal: AbortSignal,
  options: { text?: string; opened?: () => void; local?: boolean } = {},
): Popover {
  const button = h(
    "button",
    {
      type: "button",
      class: options.text ? "fnb-button fnb-wide" : "fnb-button",
      "aria-label": label,
      title: label,
      "aria-expanded": "false",
      "aria-haspopup": "true",
      "data-local": options.local ?? false,
    },
    icon(name),
    options.text ? h("span", {}, options.text) : null,
  );
  const panel = h("div", { class: "fnb-popover", hidden: true, "data-local": options.local ?? false }, body);
  const el = h("span", { class: "fnb-pop" }, button, panel);
  const open = (on: boolean) => {
    if (panel.hidden === !on) return;
    panel.hidden = !on;
    mark(button, "aria-expanded", String(on));
    if (on) {
      options.opened?.();
      // Near the right end it would stick out.
      mark(panel, "data-end", null);
      const own = panel.getBoundingClientRect();
      const root = el.closest(".fnb")?.getBoundingClientRect();
      if (root !== undefined && own.right > root.right) mark(panel, "data-end", true);
    } else if (el.contains(focused(el))) button.focus({ preventScroll: true });
  };
  button.addEventListener("click", () => open(panel.hidden !== false));
  el.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || panel.hidden) return;
    event.preventDefault(); // nothing else is given up
    event.stopPropagation();
    open(false);
  });
  // A press anywhere else; one within a shadow tree has its target there.
  document.addEventListener(
    "pointerdown",
    (event) => {
      if (!panel.hidden && !event.composedPath().includes(el)) open(false);
    },
    { signal, capture: true },
  );
  return { el, body, button, open };
}

/** A list of actions for a popover. */
export function menu(items: { label: string; action: () => void; key?: string }[], close: () => void): HTMLElement {
  return h(
    "div",
    { class: "fnb-menu", role: "menu" },
    ...items.map(({ label, action, key }) => {
      const item = h("button", { type: "button", class: "fnb-menu-item", role: "menuitem", "data-key": key }, label);
      item.addEventListener("click", () => {
        close();
        action();
      });
      return item;
    }),
  );
}
