// How the pixel that was clicked came about, step by step.

import { h, mark, setText } from "../shared/dom.ts";
import { asking } from "./asking.ts";
import { revealer } from "./revealing.ts";
import type { Session } from "./session.ts";
import type { Step } from "./types.ts";

/** The scope and the seed stack of a step, in words. */
export function about({ scope, seeds, faces }: Step): string {
  const [left, bottom, right, top] = scope.map((value) => String(Number(value.toFixed(2))));
  const on = faces.length ? ` on the ${faces.at(-1)} of the room` : "";
  const stack = seeds.length ? seeds.map((corner) => corner.join(", ")).join(" · ") : "empty";
  return `Scope ${left} to ${right} × ${bottom} to ${top} m${on}; seed stack: ${stack}`;
}

export function inspector(session: Session, signal: AbortSignal): HTMLElement {
  const head = h("div", { class: "fnb-tex-hint", role: "status" });
  const list = h("ol", { class: "fnb-tex-steps" });
  const detail = h("div", { class: "fnb-tex-detail" });
  const reveal = revealer(list, signal);
  const asked = asking(session, signal);
  let shown: unknown = null;
  list.addEventListener("keydown", (event) => {
    const by = event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    const to = Math.min(session.steps.length - 1, Math.max(0, session.step + by));
    session.look(to);
    list.children[to]?.querySelector("button")?.focus();
  });
  const top = h("div", { class: "fnb-tex-top" }, head, asked.toggle);
  session.hold(() => {
    asked.show();
    const { steps, point } = session;
    if (shown !== steps) {
      shown = steps;
      list.replaceChildren(
        ...steps.map((step, k) => {
          const layer = step.layers.length ? `layer ${step.layers.map(([, number]) => number).join(" › ")}` : "";
          const where = [...step.faces, layer].filter(Boolean).join(" · ");
          const swatch = step.color && h("i", { class: "fnb-tex-swatch" });
          if (swatch && step.color)
            swatch.style.background = `rgb(${step.color
              .slice(0, 3)
              .map((v) => Math.round(255 * v))
              .join(" ")})`;
          const go = h(
            "button",
            { type: "button" },
            h("b", {}, step.rule),
            " ",
            h("code", {}, step.operator),
            " ",
            h("span", {}, step.text),
            swatch,
            where ? h("small", {}, where) : null,
          );
          go.addEventListener("click", () => session.look(k));
          return h("li", {}, go);
        }),
      );
    }
    [...list.children].forEach((row, k) => {
      mark(row, "aria-current", k === session.step ? "step" : null);
    });
    reveal(list.children[session.step]);
    const now = steps[session.step];
    setText(detail, now ? about(now) : "");
    detail.hidden = !now;
    setText(
      head,
      point && steps.length
        ? `At ${point.map((v) => v.toFixed(2)).join(", ")} m: ${steps.length} steps`
        : "Click the façade, or press Enter on it, to see how a pixel comes about.",
    );
  }, signal);
  return h("section", { class: "fnb-tex-inspector", "aria-label": "Pixel inspector" }, top, asked.el, list, detail);
}
