// The bundle of the views of a town.

import "../styles/base.css";
import "../styles/fields.css";
import "../styles/texture.css";
import "../styles/town.css";
import { absence } from "../shared/absence.ts";
import { h } from "../shared/dom.ts";
import { keepKeys } from "../shared/keys.ts";
import { adoptStyle, watchTheme } from "../shared/theme.ts";
import type { Mount, WidgetModel } from "../shared/types.ts";
import { pipelineView } from "../town/buffers.ts";
import { Session } from "../town/session.ts";
import { townView } from "../town/view.ts";

/** What changes the model: to look around asks nothing of Python. */
const EDITS = ".fnb-tex-text, .fnb-tex-tools button, .fnb-town-edit";
const GOES_ON = "One can fly, walk, choose buildings and change the hour all the same.";

/** Shaders are compiled while the kernel draws the still picture. */
export function prepare(channel: WidgetModel): void {
  Session.of(channel).prepare();
}

export function mount({ el, model, channel, css }: Mount): () => void {
  const end = new AbortController();
  adoptStyle(css, el, end.signal);
  const session = Session.of(channel);
  const part = model.get<string>("part");
  const make = { view: townView, pipeline: pipelineView }[part];
  if (!make) throw new Error(`facade_nb: no view of a town named ${part}`);
  const root = h("div", { class: `fnb fnb-town fnb-town-${part}` });
  keepKeys(root, end.signal, (op) => session.ask(op));
  watchTheme(root, end.signal, () => {});
  el.append(root);
  const trouble = h("pre", { class: "fnb-tex-trouble", role: "alert", hidden: true });
  root.append(make(session, model, end.signal), trouble);
  absence(root, session.kernel, end.signal, {
    what: "town",
    goesOn: GOES_ON,
    needs: EDITS,
    unsent: () => session.waits,
  });
  session.hold(() => {
    trouble.textContent = session.trouble;
    trouble.hidden = !session.trouble;
  }, end.signal);
  return () => {
    end.abort("ended");
    root.remove();
  };
}
