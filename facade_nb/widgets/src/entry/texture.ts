// The bundle of the views of a texture grammar.

import "../styles/base.css";
import "../styles/fields.css";
import "../styles/quiz.css";
import "../styles/texture.css";
import { absence } from "../shared/absence.ts";
import { h } from "../shared/dom.ts";
import { keepKeys } from "../shared/keys.ts";
import { adoptStyle, watchTheme } from "../shared/theme.ts";
import type { Mount } from "../shared/types.ts";
import { editor } from "../texture/editor.ts";
import { inspector } from "../texture/inspector.ts";
import { picture } from "../texture/picture.ts";
import { Session } from "../texture/session.ts";
import { table } from "../texture/table.ts";

/** What changes the model: to look around asks nothing of Python. */
const EDITS = ".fnb-tex-text, .fnb-tex-slide input, .fnb-tex-edit";

export function mount({ el, model, channel, css }: Mount): () => void {
  const end = new AbortController();
  adoptStyle(css, el, end.signal);
  const session = Session.of(channel);
  const parts: Record<string, () => HTMLElement> = {
    view: () => picture(session, model, end.signal, true),
    editor: () => editor(session, end.signal),
    inspector: () => inspector(session, end.signal),
    table: () => table(session, end.signal),
    studio: () =>
      h(
        "div",
        { class: "fnb-tex-studio" },
        h("div", {}, picture(session, model, end.signal), inspector(session, end.signal)),
        h("div", {}, editor(session, end.signal), table(session, end.signal)),
      ),
  };
  const part = model.get<string>("part");
  const make = parts[part];
  if (!make) throw new Error(`facade_nb: no view of a texture named ${part}`);
  const root = h("div", { class: `fnb fnb-texture fnb-texture-${part}` });
  keepKeys(root, end.signal, (op) => session.ask(op));
  watchTheme(root, end.signal, () => {});
  el.append(root);
  const trouble = h("pre", { class: "fnb-tex-trouble", role: "alert", hidden: true });
  root.append(make(), trouble);
  const what = part === "view" ? "façade" : "grammar";
  absence(root, session.kernel, end.signal, { what, needs: EDITS, unsent: () => session.waits });
  session.hold(() => {
    trouble.textContent = session.trouble;
    trouble.hidden = !session.trouble;
  }, end.signal);
  return () => {
    end.abort("ended");
    root.remove();
  };
}
