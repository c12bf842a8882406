// The bundle of the editor of surveys.

import "../styles/base.css";
import "../styles/fields.css";
import "../styles/survey.css";
import { absence } from "../shared/absence.ts";
import { h } from "../shared/dom.ts";
import { keepKeys } from "../shared/keys.ts";
import { keepFocus } from "../shared/staying.ts";
import { adoptStyle, watchTheme } from "../shared/theme.ts";
import type { Mount } from "../shared/types.ts";
import { editor } from "../survey/editor.ts";
import { Session } from "../survey/session.ts";

export function mount({ el, model, channel, css }: Mount): () => void {
  const end = new AbortController();
  const { signal } = end;
  adoptStyle(css, el, signal);
  const session = Session.of(channel);
  const root = h("div", { class: "fnb fnb-survey" });
  keepKeys(root, signal, (op) => session.ask(op));
  keepFocus(root, signal);
  watchTheme(root, signal, () => {});
  el.append(root);
  root.append(editor(session, model, signal));
  absence(root, session.kernel, signal, {
    what: "survey",
    after: () => "Save writes it as a file, without a kernel too.",
    unsent: () => session.waits,
  });
  return () => {
    end.abort("ended");
    root.remove();
  };
}
