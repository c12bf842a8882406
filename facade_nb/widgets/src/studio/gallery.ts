import { h, mark } from "../shared/dom.ts";
import type { Context } from "./common.ts";

/** What was drawn of the gallery, by name and theme: the same in all studios of a page. */
const drawn = new Map<string, string>();

export interface Gallery {
  el: HTMLElement;
  /** It is looked at: draw what is not drawn yet, one after the other. */
  show(): void;
}

/** The gallery's designs as pictures. They are drawn by the kernel when they are first looked at, and kept. */
export function gallery({ store, signal }: Context, chosen: () => void): Gallery {
  const el = h("div", { class: "fnb-gallery-grid", role: "list", "aria-label": "Designs of the gallery" });
  let shown = false;
  let asked = "";
  const key = (name: string) => `${store.get("theme")} ${name}`;
  const paint = () => {
    for (const picture of el.querySelectorAll<HTMLImageElement>("img")) {
      const text = drawn.get(key(picture.dataset.name ?? ""));
      if (text) mark(picture, "src", `data:image/svg+xml;utf8,${encodeURIComponent(text)}`);
    }
  };
  const next = () => {
    if (!shown || asked || !el.checkVisibility?.()) return;
    const missing = store.get("gallery").find((name) => !drawn.has(key(name)));
    if (!missing) return;
    asked = missing;
    store.ask({ op: "thumbnail", name: missing });
  };
  store.onReply((reply) => {
    if (reply.kind !== "thumbnail") return;
    drawn.set(`${reply.theme} ${reply.name}`, reply.svg);
    if (reply.name === asked) asked = "";
    paint();
    next();
  });
  store.watch(["gallery"], () => {
    el.replaceChildren(
      ...store.get("gallery").map((name) => {
        const title = name.replaceAll("-", " ");
        const item = h(
          "button",
          { type: "button", class: "fnb-gallery-item", role: "listitem", "aria-label": `Open ${title}` },
          h("img", { alt: "", "data-name": name }),
          h("span", {}, title),
        );
        item.addEventListener("click", () => {
          chosen();
          store.ask({ op: "gallery", name });
        });
        return item;
      }),
    );
    paint();
  });
  store.watch(["theme"], () => {
    paint();
    next();
  });
  signal.addEventListener("abort", () => {
    shown = false;
  });
  return {
    el,
    show() {
      shown = true;
      asked = "";
      next();
    },
  };
}
