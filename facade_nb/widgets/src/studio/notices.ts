import { h, setText } from "../shared/dom.ts";
import { button, faultLine } from "../shared/fields.ts";
import type { Store } from "../shared/store.ts";
import type { Fault } from "../shared/types.ts";

/** What is said once and can be dismissed: a document's faults, a refused change; and errors of our own, which stay. */
export function notices(store: Store, signal: AbortSignal): { el: HTMLElement; notify(text: string): void } {
  const body = h("div", { class: "fnb-notice-body" });
  const notice = h(
    "div",
    { class: "fnb-notice", role: "alert", hidden: true },
    body,
    button(
      "Dismiss",
      "close",
      () => {
        notice.hidden = true;
      },
      { "data-local": "" },
    ),
  );
  const trace = h("pre", {});
  const summary = h("summary", {});
  const trouble = h("details", { class: "fnb-trouble", role: "alert", hidden: true }, summary, trace);
  let timer = 0;

  const say = (kind: string, ...children: HTMLElement[]) => {
    clearTimeout(timer);
    notice.dataset.kind = kind;
    body.replaceChildren(...children);
    notice.hidden = false;
    if (kind === "note")
      timer = window.setTimeout(() => {
        notice.hidden = true;
      }, 6000);
  };
  const sayFaults = (title: string, faults: Fault[]) =>
    say("fault", ...(title ? [h("strong", {}, title)] : []), ...faults.map((fault) => faultLine(fault)));

  store.onReply((reply) => {
    if (reply.kind === "faults")
      sayFaults(`${reply.name} could not be opened. Your design is as it was.`, reply.faults);
    if (reply.kind === "refused") sayFaults("", reply.faults);
    if (reply.kind === "opened") say("note", h("span", {}, `Opened ${reply.name}`));
    if (reply.kind === "file") download(reply.name, reply.text);
  });
  store.watch(["trouble", "status"], () => {
    const text = store.get("trouble") || store.get("status").trouble;
    trouble.hidden = text === "";
    const last = text.trim().split("\n").at(-1) ?? "";
    setText(summary, `Something went wrong inside facade_nb: ${last}`);
    setText(trace, text);
  });
  signal.addEventListener("abort", () => clearTimeout(timer));
  return {
    el: h("div", { class: "fnb-notices" }, notice, trouble),
    notify: (text) => say("note", h("span", {}, text)),
  };
}

function download(name: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type: "application/json" }));
  const link = h("a", { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
