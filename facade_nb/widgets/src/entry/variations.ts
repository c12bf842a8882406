// The bundle of the view of many designs.

import "../styles/base.css";
import "../styles/fields.css";
import "../styles/variations.css";
import { absence } from "../shared/absence.ts";
import { h } from "../shared/dom.ts";
import { keepKeys } from "../shared/keys.ts";
import { keepFocus } from "../shared/staying.ts";
import { adoptStyle, watchTheme } from "../shared/theme.ts";
import type { Mount } from "../shared/types.ts";
import { Session } from "../variations/session.ts";
import { variations } from "../variations/view.ts";

export function mount({ el, model, channel, css }: Mount): () => void {
  const end = new AbortController();
  const { signal } = end;
  adoptStyle(css, el, signal);
  const session = Session.of(channel);
  const root = h("div", { class: "fnb fnb-variations" });
  keepKeys(root, signal, (op) => session.ask({ op }));
  keepFocus(root, signal);
  watchTheme(root, signal, (theme) => session.dress(theme));
  el.append(root);
  root.append(variations(session, model, signal));
  absence(root, session.kernel, signal, {
    what: "table",
    goesOn: "It can be sorted all the same.",
    needs: ".fnb-var-needs",
  });
  return () => {
    end.abort("ended");
    root.remove();
  };
}
