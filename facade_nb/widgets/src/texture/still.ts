// What is shown where the browser cannot draw: why, what would help, and a still picture that Python has drawn.

import { h, setText } from "../shared/dom.ts";
import type { Session } from "./session.ts";

const PNG = 0x89; // how such a file begins

/** Whose picture it is. */
interface Pictured {
  readonly still: Uint8Array<ArrayBuffer> | null;
  readonly live: boolean;
  askStill(): void;
  hold(update: () => void, signal: AbortSignal): void;
}

export function stillPicture(session: Session, whyNot: string, signal: AbortSignal): HTMLElement {
  const what = () => `Façade, ${session.size[0]} by ${session.size[1]} metres, straight on`;
  return stillOf(session, { whyNot, what, label: "Still picture of the façade" }, signal);
}

/** The still picture of whatever has one. */
export function stillOf(
  session: Pictured,
  { whyNot, what, label }: { whyNot: string; what: () => string; label: string },
  signal: AbortSignal,
): HTMLElement {
  const image = h("img", { class: "fnb-tex-still", hidden: true });
  const note = h("p", {});
  const stage = h(
    "div",
    { class: "fnb-tex-stage fnb-tex-without", role: "group", "aria-label": label },
    h("div", { class: "fnb-tex-why", role: "alert" }, h("strong", {}, whyNot), note),
    image,
  );
  let shown: DataView | ArrayBuffer | Uint8Array | null = null;
  let address = "";
  const forget = () => URL.revokeObjectURL(address);
  session.hold(() => {
    const { still } = session;
    image.alt = what();
    image.hidden = !still;
    setText(note, help(session.live, !!still));
    if (!still || still.buffer === shown) return;
    shown = still.buffer;
    forget();
    address = URL.createObjectURL(new Blob([still], { type: still[0] === PNG ? "image/png" : "image/jpeg" }));
    image.src = address;
  }, signal);
  session.askStill();
  signal.addEventListener("abort", forget);
  return stage;
}

function help(live: boolean, pictured: boolean): string {
  const cure =
    "To look around, switch on hardware acceleration in the browser's settings, or open the page in a current Chrome, " +
    "Edge, Firefox or Safari.";
  if (!pictured) return cure + (live ? "" : " Run the notebook for a still picture.");
  return live
    ? `Python draws a still picture, which follows what you change. ${cure}`
    : `This is a still picture. ${cure}`;
}
