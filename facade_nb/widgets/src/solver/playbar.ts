// The player as it is seen: buttons, the stages, a track to scrub on, and a sentence for the event.

import { copy } from "../shared/clipboard.ts";
import { h, mark, setText } from "../shared/dom.ts";
import { type IconName, icon, setIcon } from "../shared/icons.ts";
import type { Asking } from "./asking.ts";
import { lessonChoice, lessonNote } from "./lessons.ts";
import { fragmentOf } from "./moments.ts";
import { type Player, SPEEDS, UNITS, type Unit } from "./player.ts";
import type { Session } from "./session.ts";
import type { Stage } from "./timeline.ts";

/** Width of each stage on the track, in shares: some have a hundred times the events of others, and all have a name. */
export function shares(stages: readonly Stage[]): number[] {
  const share = (weights: readonly number[]) => {
    const sum = weights.reduce((total, weight) => total + weight, 0);
    return weights.map((weight) => weight / sum);
  };
  const named = share(stages.map(({ title }, n) => title.length + (opens(stages, n) ? 3.8 : 1.8)));
  const events = share(stages.map(({ first, last }) => Math.sqrt(last - first + 1)));
  return named.map((own, n) => 0.93 * own + 0.07 * (events[n] ?? 0));
}

/** Whether a stage is the first of its axis, or the first after another axis. */
const opens = (stages: readonly Stage[], n: number): boolean =>
  stages[n]?.axis !== "" && stages[n]?.axis !== stages[n - 1]?.axis;

/** Between positions and places on the track, both ways; a place is between 0 and 1. */
export class Scale {
  private readonly starts: number[] = [];
  private readonly widths: number[];

  constructor(private readonly stages: readonly Stage[]) {
    this.widths = shares(stages);
    let at = 0;
    for (const width of this.widths) {
      this.starts.push(at);
      at += width;
    }
  }

  place(position: number): number {
    const n = Math.max(
      0,
      this.stages.findLastIndex((stage) => stage.first <= position),
    );
    const { first = 0, last = 0 } = this.stages[n] ?? {};
    return (this.starts[n] ?? 0) + ((this.widths[n] ?? 1) * (position - first + 0.5)) / (last - first + 1);
  }

  position(place: number): number {
    const n = Math.max(
      0,
      this.starts.findLastIndex((start) => start <= place),
    );
    const { first = 0, last = 0 } = this.stages[n] ?? {};
    const share = (place - (this.starts[n] ?? 0)) / (this.widths[n] ?? 1);
    return Math.max(first, Math.min(last, Math.floor(first + share * (last - first + 1))));
  }
}

function control(label: string, name: IconName, act: () => void): HTMLButtonElement {
  const button = h("button", { type: "button", class: "fnb-button", "aria-label": label, title: label }, icon(name));
  button.addEventListener("click", act);
  return button;
}

export function playbar(session: Session, player: Player, asking: Asking, signal: AbortSignal): HTMLElement {
  const { timeline } = player;
  const { stages, marks } = timeline.data;
  const scale = new Scale(stages);

  const play = control("Play", "play", () => (player.playing ? player.pause() : player.play()));
  const back = control("Step back", "back", () => player.step(-1));
  const forward = control("Step forward", "forward", () => player.step(1));
  const stageBack = control("Previous stage", "stageBack", () => player.stage(-1));
  const stageForward = control("Next stage", "stageForward", () => player.stage(1));
  const speed = h("select", { class: "fnb-select fnb-speed", "aria-label": "Speed in events per second" });
  for (const each of SPEEDS) speed.append(h("option", { value: each }, `${each}/s`));
  speed.value = String(player.speed);
  speed.addEventListener("change", () => player.setSpeed(Number(speed.value)));
  const unit = h("select", {
    class: "fnb-select fnb-unit",
    "aria-label": "What a step goes to",
    title: "What a step goes to: the next event, node that is expanded, pass, or improvement",
  });
  for (const each of Object.keys(UNITS)) unit.append(h("option", { value: each }, `by ${each}`));
  unit.value = player.unit;
  unit.addEventListener("change", () => player.setUnit(unit.value as Unit));
  const link = control("Copy a link to this moment", "link", () => {
    const fragment = fragmentOf({ moment: timeline.momentOf(player.position), design: timeline.data.name });
    void copy(location.href.replace(/#.*$/, "") + fragment).then((done) =>
      setText(count, done ? "Link copied" : "The browser does not let the link be copied"),
    );
  });
  const count = h("span", { class: "fnb-play-count" });

  const tabs = stages.map((stage, n) => {
    const axis = stage.axis ? `${stage.axis} ` : "";
    const label = `${stage.axis ? `${stage.axis}: ` : ""}${stage.title}`;
    const tab = h("button", {
      type: "button",
      class: "fnb-play-stage",
      title: label,
      "aria-label": label,
      "data-axis": stage.axis,
      "data-opens": opens(stages, n),
    });
    tab.append(h("i", {}, axis), stage.title);
    tab.style.flexGrow = String(Math.round(1e4 * (shares(stages)[n] ?? 0)));
    tab.addEventListener("click", () => player.go(stage.first));
    return tab;
  });
  const cursor = h("div", { class: "fnb-play-cursor" });
  const past = h("div", { class: "fnb-play-past" });
  const track = h("div", {
    class: "fnb-play-track",
    role: "slider",
    tabindex: 0,
    "aria-label": "Position in the trace",
    "aria-valuemin": 0,
    "aria-valuemax": timeline.last,
  });
  track.append(past);
  const ticks = marks.map((one) => {
    const tick = h("i", { class: "fnb-play-mark" });
    tick.style.left = `${100 * scale.place(one.at)}%`;
    track.append(tick);
    return tick;
  });
  track.append(cursor);

  const scrub = (event: PointerEvent) => {
    const box = track.getBoundingClientRect();
    player.pause();
    player.go(scale.position(Math.max(0, Math.min(0.999999, (event.clientX - box.left) / box.width))));
  };
  track.addEventListener("pointerdown", (event) => {
    track.setPointerCapture(event.pointerId);
    scrub(event);
  });
  track.addEventListener("pointermove", (event) => track.hasPointerCapture(event.pointerId) && scrub(event));
  track.addEventListener("keydown", (event) => {
    const steps: Record<string, () => void> = {
      ArrowLeft: () => player.step(-1),
      ArrowRight: () => player.step(1),
      PageUp: () => player.stage(-1),
      PageDown: () => player.stage(1),
      Home: () => player.go(0),
      End: () => player.go(timeline.last),
      " ": () => (player.playing ? player.pause() : player.play()),
    };
    const act = steps[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });

  const caption = h("p", { class: "fnb-play-caption", "aria-live": "polite" });
  let said: string[] = [];
  const el = h(
    "div",
    { class: "fnb-playbar" },
    h(
      "div",
      { class: "fnb-play-buttons", role: "group", "aria-label": "Player" },
      stageBack,
      back,
      play,
      forward,
      stageForward,
      unit,
      speed,
    ),
    h("div", { class: "fnb-play-line" }, h("div", { class: "fnb-play-stages" }, ...tabs), track),
    caption,
    h("div", { class: "fnb-play-end" }, count, link),
    lessonChoice(session, signal),
    lessonNote(session),
  );

  const show = () => {
    const { position } = player;
    const here = timeline.stageAt(position);
    setIcon(play, player.playing ? "pause" : "play");
    mark(play, "aria-label", player.playing ? "Pause" : "Play");
    mark(play, "title", player.playing ? "Pause" : "Play");
    back.disabled = !player.canStep(-1);
    forward.disabled = !player.canStep(1);
    stageBack.disabled = position === 0;
    stageForward.disabled = player.atEnd;
    for (const [button, way] of [
      [back, "back"],
      [forward, "forward"],
    ] as const) {
      const label = `Step ${way}${player.unit === "event" ? "" : ` to ${player.unit === "improvement" ? "an" : "a"} ${player.unit}`}`;
      mark(button, "title", label);
    }
    if (unit.value !== player.unit) unit.value = player.unit;
    // What a mark says, and how it ended, is told when it is played.
    for (const [n, tick] of ticks.entries()) {
      const one = marks[n];
      const played = one && one.at <= position;
      mark(tick, "title", played ? one.text : null);
      mark(tick, "data-kind", played ? one.kind : null);
    }
    const left = `${(100 * scale.place(position)).toFixed(3)}%`;
    cursor.style.left = left;
    past.style.width = left;
    for (const [n, tab] of tabs.entries()) mark(tab, "aria-current", n === here ? "step" : null);
    mark(track, "aria-valuenow", String(position));
    setText(count, `${position + 1} / ${timeline.count}`);
    // What an event says may be the answer to what a view asks.
    const text = asking.on ? "" : said[position];
    mark(track, "aria-valuetext", text ?? timeline.kindAt(position));
    setText(caption, text ?? "");
    mark(caption, "title", text || null);
  };
  const keep = () => {
    const { from } = asking;
    for (const [n, tick] of ticks.entries()) tick.hidden = (marks[n]?.at ?? 0) >= from;
    show();
  };
  keep();
  player.watch(show, signal);
  asking.watch(keep, signal);
  session.piece<{ text: string[] }>("captions").then(
    ({ text }) => {
      said = text;
      if (!signal.aborted) show();
    },
    (error: Error) => setText(caption, error.message),
  );
  return el;
}
