// One variant: a row of the table or, by its style alone, a picture with its values below.

import { h, mark, setText } from "../shared/dom.ts";
import type { Column } from "./columns.ts";
import type { VariantRow } from "./types.ts";

export interface Item {
  el: HTMLElement;
  update(row: VariantRow | undefined, opened: boolean): void;
}

interface Own {
  open(): void;
  picture(): string | undefined;
  live(): boolean;
}

export function item(
  number: number,
  columns: readonly Column[],
  rank: (column: Column) => Record<string, string>,
  own: Own,
): Item {
  const image = h("img", { alt: "", draggable: "false", hidden: true });
  const blank = h("span", { class: "fnb-var-blank", "aria-hidden": "true" });
  const tag = h("span", { class: "fnb-var-tag", hidden: true }, "in the studio");
  const name = h("span", { class: "fnb-var-number" }, String(number + 1));
  const cells = columns.map((column) => ({ column, el: h("td", { ...rank(column), "data-title": column.title }) }));
  const values = cells.filter(({ column }) => column.rank === 0 && column.key !== "windows").length;
  const error = h("td", { class: "fnb-var-error", colspan: cells.length - values, hidden: true });
  const el = h(
    "tr",
    { class: "fnb-var-row", tabindex: -1, "data-row": number },
    h(
      "th",
      { scope: "row", class: "fnb-var-first" },
      h("span", {}, name, h("span", { class: "fnb-var-sheet" }, image, blank), tag),
    ),
    ...cells.map((cell) => cell.el),
    error,
  );
  let opens = false;
  const open = () => {
    if (opens && own.live()) own.open();
  };
  el.addEventListener("click", open);
  el.addEventListener("keydown", (event) => {
    if ((event.key !== "Enter" && event.key !== " ") || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    open();
  });
  let shown = "";
  return {
    el,
    update(row, opened) {
      if (!row) return;
      ({ opens } = row);
      const failed = row.state === "error";
      for (const { column, el: cell } of cells) {
        setText(cell, column.text(row));
        cell.hidden = failed && (column.rank > 0 || column.key === "windows");
      }
      setText(error, row.error ?? "");
      error.hidden = !failed;
      mark(el, "data-state", row.state);
      mark(el, "data-opens", opens);
      mark(el, "data-opened", opened);
      mark(el, "aria-current", opened ? "true" : null);
      tag.hidden = !opened;
      const text = own.picture() ?? "";
      if (text !== shown) {
        shown = text;
        if (text) image.src = `data:image/svg+xml;utf8,${encodeURIComponent(text)}`;
      }
      image.hidden = shown === "";
      blank.hidden = shown !== "";
      const told = columns.filter(({ rank }) => rank === 0).map((one) => `${one.title} ${one.text(row)}`);
      const state = row.state === "waiting" ? "not solved yet" : (row.error ?? "");
      const what = failed || row.state === "waiting" ? told.slice(0, values) : told;
      const act = opened ? "in the studio" : opens ? "Enter opens it in the studio" : "";
      mark(el, "aria-label", [`Variant ${number + 1}`, ...what, state, act].filter(Boolean).join(", "));
    },
  };
}
