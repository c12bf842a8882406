// The town: picture, controls, the building that is chosen, and the grammar of its style.

import { context } from "../pipeline/context.ts";
import { h, mark } from "../shared/dom.ts";
import type { WidgetModel } from "../shared/types.ts";
import { editor } from "../texture/editor.ts";
import { type Controls, controls } from "./controls.ts";
import { inspector } from "./inspector.ts";
import type { Session } from "./session.ts";
import { stage } from "./stage.ts";
import { stillPicture } from "./still.ts";

export function townView(session: Session, model: WidgetModel, signal: AbortSignal): HTMLElement {
  const root = h("section", { class: "fnb-town-view", "aria-label": "Town" });
  const { whyNot } = context();
  if (whyNot) {
    root.append(stillPicture(session, whyNot, signal));
    return root;
  }
  let bar: Controls | null = null;
  const made = stage(
    session,
    model,
    {
      clicked(across, up) {
        const { canvas } = made;
        const found = session.pick([canvas.width, canvas.height], across, up);
        session.set("chosen", found?.building ?? -1);
      },
      escaped: () => session.set("chosen", -1),
      changed: () => bar?.update(),
    },
    signal,
  );
  root.append(made.el);
  if (!model.get<boolean>("controls")) return root;
  bar = controls(
    session,
    () => made.fly,
    () => made.canvas.focus({ preventScroll: true }),
    signal,
  );
  const side = h("div", { class: "fnb-town-side" }, inspector(session, signal), grammar(session, signal));
  root.append(bar.el, side);
  session.hold(() => mark(side, "hidden", !session.head?.town), signal);
  return root;
}

/** The grammar in parts, one of which is edited. */
function grammar(session: Session, signal: AbortSignal): HTMLElement {
  const part = h("select", { class: "fnb-select fnb-town-edit", "aria-label": "Part of the grammar" });
  part.addEventListener("change", () => session.set("section", part.value));
  let shown = "";
  session.hold(() => {
    const parts = session.head?.town?.parts ?? [];
    if (parts.join() !== shown) {
      shown = parts.join();
      part.replaceChildren(...parts.map((name) => h("option", { value: name }, name)));
    }
    part.value = session.section;
  }, signal);
  const body = editor(session, signal);
  body
    .querySelector(".fnb-tex-tools")
    ?.append(h("label", { class: "fnb-town-choice" }, h("span", {}, "Grammar of"), part));
  return body;
}
