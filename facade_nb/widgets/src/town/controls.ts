// Buttons and sliders under the picture: views, walking, the hour, paths.

import { h, mark, setText } from "../shared/dom.ts";
import { icon, setIcon } from "../shared/icons.ts";
import { slider, timeOf } from "../texture/controls.ts";
import type { Flying } from "./flying.ts";
import { secondsOf } from "./path.ts";
import type { Session } from "./session.ts";

export interface Controls {
  el: HTMLElement;
  update(): void;
}

const NAMES: Record<string, string> = {
  distance: "Distance",
  street: "Street",
  "close-up": "Close-up",
  front: "Front",
};

export function controls(session: Session, fly: () => Flying, focus: () => void, signal: AbortSignal): Controls {
  const button = (label: string, act: () => void, text = label) => {
    const made = h("button", { type: "button", class: "fnb-town-button", "data-local": true, title: label }, text);
    if (text !== label) made.setAttribute("aria-label", label);
    made.addEventListener("click", act);
    return made;
  };
  const views = h("span", { class: "fnb-town-group", role: "group", "aria-label": "Views" });
  const walk = button(
    "Walk on the ground",
    () => {
      fly().walk(!fly().walking);
      focus();
    },
    "Walk",
  );
  const play = h("button", { type: "button", class: "fnb-button", "data-local": true }, icon("play"));
  play.addEventListener("click", () => fly().play(!fly().playing));
  const record = button("Record a path", () => fly().record(!fly().recording), "Record");
  record.classList.add("fnb-town-record");
  const scrub = h("input", { type: "range", min: 0, step: 0.05, "aria-label": "Time on the path", "data-local": true });
  scrub.addEventListener("input", () => fly().seek(Number(scrub.value)));
  const time = h("output", {});
  const hour = slider(
    {
      label: "Hour",
      range: [0, 24, 0.25],
      get: () => session.hour,
      set: (value) => session.set("hour", value),
      show: timeOf,
    },
    session,
    signal,
  );
  hour.querySelector("input")?.setAttribute("data-local", "");
  let named = "";
  const update = () => {
    const names = Object.keys(session.head?.views ?? {});
    if (names.join() !== named) {
      named = names.join();
      views.replaceChildren(
        ...names.map((name) =>
          button(NAMES[name] ?? name, () => {
            const place = session.head?.views[name];
            if (place) fly().go(place);
            focus();
          }),
        ),
      );
    }
    mark(walk, "aria-pressed", String(fly().walking));
    mark(walk, "hidden", !session.walls);
    const { path } = session;
    const [playing, recording, long] = [fly().playing, fly().recording, secondsOf(path)];
    for (const own of [play, scrub, time]) mark(own, "hidden", !path.length);
    setIcon(play, playing ? "pause" : "play");
    const label = playing ? "Pause" : "Play the path";
    mark(play, "aria-label", label);
    mark(play, "title", label);
    scrub.max = String(long);
    if (Math.abs(Number(scrub.value) - fly().time) > 0.02) scrub.value = String(fly().time);
    setText(time, `${fly().time.toFixed(1)} of ${long.toFixed(1)} s`);
    mark(record, "aria-pressed", String(recording));
    setText(record, recording ? "Stop" : "Record");
  };
  const el = h(
    "div",
    { class: "fnb-town-bar" },
    views,
    walk,
    hour,
    h(
      "span",
      { class: "fnb-town-group fnb-town-path", role: "group", "aria-label": "Path" },
      record,
      play,
      scrub,
      time,
    ),
  );
  session.hold(update, signal);
  return { el, update };
}
