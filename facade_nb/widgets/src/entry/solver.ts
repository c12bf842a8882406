// The bundle of the views of the solver: it makes the view, or the page of views, that the widget names.

import "../styles/base.css";
import "../styles/fields.css";
import "../styles/solver.css";
import "../styles/playbar.css";
import "../styles/alignment.css";
import "../styles/analysis.css";
import "../styles/candidates.css";
import "../styles/network.css";
import "../styles/page.css";
import "../styles/player.css";
import "../styles/quiz.css";
import "../styles/qualifiers.css";
import "../styles/runs.css";
import "../styles/sizing.css";
import "../styles/solver-views.css";
import { absence } from "../shared/absence.ts";
import { h } from "../shared/dom.ts";
import { Kernel } from "../shared/kernel.ts";
import { keepKeys } from "../shared/keys.ts";
import { adoptStyle, watchTheme } from "../shared/theme.ts";
import type { Mount } from "../shared/types.ts";
import { alone, apology } from "../solver/frame.ts";
import { staleNotice } from "../solver/lessons.ts";
import { page } from "../solver/page.ts";
import { qualifiers } from "../solver/qualifiers.ts";
import { Session } from "../solver/session.ts";
import { VIEWS } from "../solver/views/index.ts";

export function mount({ el, model, channel, css }: Mount): () => void {
  const end = new AbortController();
  adoptStyle(css, el, end.signal);
  const part = model.get<string>("part");
  const kind = VIEWS[part];
  if (!kind && part !== "solver" && part !== "qualifiers") throw new Error(`facade_nb: no view named ${part}`);
  const root = h("div", { class: `fnb fnb-solver fnb-part-${part}` });
  keepKeys(root, end.signal);
  watchTheme(root, end.signal, () => {});
  el.append(root);
  const leave = () => {
    end.abort("ended");
    root.remove();
  };
  if (part === "qualifiers") {
    root.append(qualifiers(channel, end.signal));
    absence(root, Kernel.of(channel), end.signal, { what: "view" });
    return leave;
  }

  const session = Session.of(channel);
  // All that is asked of a trace is answered here: a view goes on being read.
  const notice = absence(root, session.kernel, end.signal, { what: "solve", needs: "" });
  const stale = staleNotice(session, end.signal);
  let shown: AbortController | null = null;
  const show = async () => {
    shown?.abort("ended");
    const own = new AbortController();
    shown = own;
    try {
      const loaded = await session.load();
      const make = kind ? alone(kind, session, model, loaded, own.signal) : page(session, model, loaded, own.signal);
      const made = await make;
      if (!own.signal.aborted) root.replaceChildren(notice.el, stale, made);
    } catch (error) {
      if (!own.signal.aborted) root.replaceChildren(notice.el, stale, apology(error));
    }
  };
  session.hold(() => void show(), end.signal);
  void show();
  end.signal.addEventListener("abort", () => shown?.abort("ended"));
  return leave;
}
