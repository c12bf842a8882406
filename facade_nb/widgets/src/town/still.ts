// What is shown where the browser cannot draw the town: why, what would help, and a still picture that Python has drawn.

import { stillOf } from "../texture/still.ts";
import type { Session } from "./session.ts";

export function stillPicture(session: Session, whyNot: string, signal: AbortSignal): HTMLElement {
  return stillOf(session, { whyNot, what: () => "Town", label: "Still picture of the town" }, signal);
}
