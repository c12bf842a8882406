import { copy } from "../shared/clipboard.ts";
import { h, setText } from "../shared/dom.ts";
import { button, faultLine } from "../shared/fields.ts";
import type { Keeping } from "../shared/stage.ts";
import type { Store } from "../shared/store.ts";
import type { Fault, Reply } from "../shared/types.ts";
import { download } from "./files.ts";

const BRIEFLY = 6000;
/** Long enough to read it and to change one's mind. */
const LONGER = 20000;

/**
 * What is said once and can be dismissed: a document's faults, a refused change, a design that was opened over another one.
 * Each goes when its cause does: with the next change. Errors of our own stay.
 */
export function notices(store: Store, signal: AbortSignal): { el: HTMLElement; notify(text: string): void } {
  const body = h("div", { class: "fnb-notice-body" });
  const dismiss = button("Dismiss", "close", () => hide(), { "data-local": "" });
  const notice = h("div", { class: "fnb-notice", role: "alert", hidden: true }, body, dismiss);
  const trace = h("pre", {});
  const summary = h("summary", {});
  const trouble = h("details", { class: "fnb-trouble", role: "alert", hidden: true }, summary, trace);
  const kept = keeping(store);
  let timer = 0;
  /** The design as it was when something was said about it; null: what is said is about no design. */
  let about: string | null = null;

  const hide = () => {
    clearTimeout(timer);
    notice.hidden = true;
    about = null;
  };
  const say = (kind: string, stays: number, ...children: (HTMLElement | null)[]) => {
    hide();
    notice.dataset.kind = kind;
    body.replaceChildren(...children.filter((child) => child !== null));
    notice.hidden = false;
    if (Number.isFinite(stays)) timer = window.setTimeout(hide, stays);
  };
  const note = (text: string) => say("note", BRIEFLY, h("span", {}, text));
  const sayFaults = (title: string, faults: Fault[]) => {
    const heading = title ? h("strong", {}, title) : null;
    say("fault", Number.POSITIVE_INFINITY, heading, ...faults.map((fault) => faultLine(fault)));
    about = store.get("document");
  };
  const sayOpened = (reply: Reply, what: string) => {
    // What was opened may still be under way: it is what stands there when its message has been answered.
    const back = h("button", { type: "button", class: "fnb-fix" }, "Undo");
    back.addEventListener("click", () => {
      hide();
      store.ask({ op: "undo" });
    });
    say("note", LONGER, h("span", {}, `${what} What was here before is one step back. `), back);
    const tag = `${reply.client} ${reply.seq}`;
    const settle = () => {
      about = store.get("document");
    };
    if (tagOf(store) === tag) settle();
    else opening = { tag, settle };
  };
  let opening: { tag: string; settle: () => void } | null = null;

  store.onReply((reply) => {
    if (reply.kind === "faults")
      sayFaults(`${reply.name} could not be opened. Your design is as it was.`, reply.faults);
    if (reply.kind === "refused") sayFaults("", reply.faults);
    if (reply.kind === "opened") sayOpened(reply, `Opened ${reply.name}.`);
    if (reply.kind === "note") note(reply.text);
    if (reply.kind === "file") download(reply.name, reply.text, reply.media, reply.binary);
    if (reply.kind === "python")
      void copy(reply.text).then((done) => {
        if (done) note("The Python that makes this design is on the clipboard.");
        else
          say(
            "code",
            Number.POSITIVE_INFINITY,
            h("strong", {}, "The Python that makes this design"),
            codeOf(reply.text),
          );
      });
  });
  store.watch(["document", "ack"], () => {
    if (opening?.tag === tagOf(store)) {
      opening.settle();
      opening = null;
    } else if (about !== null && about !== store.get("document") && store.get("document")) hide();
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
    el: h("div", { class: "fnb-notices" }, kept, notice, trouble),
    notify: note,
  };
}

function tagOf(store: Store): string {
  const { client, seq } = store.get("ack");
  return `${client} ${seq}`;
}

function codeOf(text: string): HTMLElement {
  const code = h("pre", { class: "fnb-copied", tabindex: 0 });
  setText(code, text);
  return code;
}

type Answer = "restore" | "anew" | "settle";

/** What is said of the design that is kept beside the notebook, with what can be done about it. */
export function keptSaying({ state, name, when, reason }: Keeping): [text: string, answers: [Answer, string][]] {
  const what = `“${name ?? ""}”, as it was at ${when ?? ""}`;
  switch (state) {
    case "restored":
      return [
        `Restored ${what}, with its history: the kernel that had it has gone.`,
        [
          ["settle", "Go on with it"],
          ["anew", "Begin anew"],
        ],
      ];
    case "offered":
      return [
        `An earlier run of this cell has left ${what}.`,
        [
          ["restore", "Restore"],
          ["settle", "Leave it"],
        ],
      ];
    case "elsewhere":
      return [
        `Another kernel keeps ${what} under this name. What is edited here is not kept until you say so.`,
        [
          ["restore", "Restore that one"],
          ["settle", "Keep this one instead"],
        ],
      ];
    case "failed":
      return [`The design cannot be kept beside the notebook: ${reason ?? ""}. Save it by the toolbar.`, []];
    default:
      return ["", []];
  }
}

function keeping(store: Store): HTMLElement {
  const text = h("span", {});
  const answers = h("span", { class: "fnb-answers" });
  const el = h(
    "div",
    { class: "fnb-kept", role: "status", hidden: true },
    h("div", { class: "fnb-notice-body" }, text, answers),
  );
  let shown = "";
  store.watch(["stage"], () => {
    const [saying, choices] = keptSaying(store.get("stage").keeping ?? { state: "off" });
    el.hidden = saying === "";
    if (saying === shown) return;
    shown = saying;
    setText(text, saying);
    answers.replaceChildren(
      ...choices.map(([answer, label]) => {
        const choose = h("button", { type: "button", class: "fnb-fix" }, label);
        choose.addEventListener("click", () => store.ask({ op: "keep", answer }));
        return choose;
      }),
    );
  });
  return el;
}
