// The pipeline in the open.
import { h } from "../shared/dom.ts";
import type { WidgetModel } from "../shared/types.ts";
import type { Session } from "./session.ts";

export function pipelineView(_session: Session, _model: WidgetModel, _signal: AbortSignal): HTMLElement {
  return h("div", {});
}
