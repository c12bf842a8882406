// Flying and walking, with keys, pointer and wheel; paths that are played.

import { pointing } from "../shared/pointing.ts";
import { type Goings, Held, type Way } from "./held.ts";
import { along, secondsOf } from "./path.ts";
import type { Session } from "./session.ts";
import type { Place, Stop } from "./types.ts";

const LONGEST = 250; // milliseconds that a frame plays of a path, however long it took
const STRIDE = 2.6; // metres a second on foot

const KEYS: Record<string, Way> = {
  KeyW: "ahead",
  ArrowUp: "ahead",
  KeyS: "back",
  ArrowDown: "back",
  KeyA: "left",
  KeyD: "right",
  ArrowLeft: "turnLeft",
  ArrowRight: "turnRight",
  KeyQ: "down",
  PageDown: "down",
  KeyE: "up",
  PageUp: "up",
};

const limit = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value));

/** Where one is after having gone each way for some milliseconds. */
export function moved(place: Place, gone: Goings, fast: boolean, eye = 0): Place {
  const [x, y, z, yaw, pitch, angle] = place;
  const seconds = (there: Way, back: Way) => ((gone[there] ?? 0) - (gone[back] ?? 0)) / 1000;
  const heading = yaw + 70 * seconds("turnRight", "turnLeft");
  const way = (heading * Math.PI) / 180;
  const walking = eye > 0;
  const speed = (walking ? STRIDE : limit(0.7 * y, 4, 160)) * (fast ? 4 : 1);
  const [forth, side, rise] = [seconds("ahead", "back"), seconds("right", "left"), seconds("up", "down")];
  const steep = walking ? 0 : (pitch * Math.PI) / 180;
  return [
    x + speed * (forth * Math.sin(way) * Math.cos(steep) + side * Math.cos(way)),
    walking ? eye : limit(y + speed * (forth * Math.sin(steep) + rise), 0.6, 8000),
    z + speed * (-forth * Math.cos(way) * Math.cos(steep) + side * Math.sin(way)),
    heading,
    pitch,
    angle,
  ];
}

/** After the pointer has gone so many pixels: the town goes with it. */
export function turned([x, y, z, yaw, pitch, angle]: Place, dx: number, dy: number, wide: number): Place {
  const share = angle / Math.max(wide, 1);
  return [x, y, z, yaw - dx * share, limit(pitch + dy * share, -89, 89), angle];
}

export interface Flying {
  walking: boolean;
  readonly playing: boolean;
  /** Seconds from the path's begin. */
  time: number;
  walk(on: boolean): void;
  go(place: Place): void;
  play(on: boolean): void;
  seek(time: number): void;
  record(on: boolean): void;
  readonly recording: boolean;
}

interface Options {
  /** A click at a place of the picture, 0 to 1 from its lower left. */
  clicked: (across: number, up: number) => void;
  escaped: () => void;
  /** Something that is shown beside the picture has changed. */
  changed: () => void;
}

export function flying(canvas: HTMLCanvasElement, session: Session, options: Options, signal: AbortSignal): Flying {
  const held = new Held();
  let [frame, before, fast] = [0, 0, false];
  let taken: { from: number; stops: Stop[] } | null = null;
  const own: Flying = {
    walking: false,
    playing: false,
    time: 0,
    recording: false,
    walk(on) {
      own.walking = on;
      if (on) {
        const [x, , z, yaw, , angle] = session.place;
        const [px, pz] = session.walls?.outside([x, z]) ?? [x, z];
        go([px, session.head?.eye ?? 1.7, pz, yaw, 4, angle]);
      }
      options.changed();
    },
    go(place) {
      own.walking = false;
      play(false);
      go(place);
      options.changed();
    },
    play: (on) => play(on),
    seek(time) {
      own.time = time;
      const at = along(session.path, time);
      if (at) go(at);
      options.changed();
    },
    record(on) {
      if (on) taken = { from: performance.now(), stops: [] };
      else if (taken && taken.stops.length > 1) session.set("path", thinned(taken.stops));
      if (!on) taken = null;
      Object.assign(own, { recording: on });
      note();
      options.changed();
    },
  };
  const go = (place: Place) => {
    session.move(place);
    note();
  };
  /** What is recorded: a place each half second, and where it ends. */
  const note = () => {
    if (!taken) return;
    const time = (performance.now() - taken.from) / 1000;
    const last = taken.stops.at(-1);
    const [x, y, z, yaw, pitch, angle] = session.place;
    if (!last || time - last.time >= 0.4)
      taken.stops.push({ time: last ? Number(time.toFixed(2)) : 0, eye: [x, y, z], yaw, pitch, angle });
  };
  const play = (on: boolean) => {
    if (own.playing === on) return;
    Object.assign(own, { playing: on });
    if (on && own.time >= secondsOf(session.path)) own.time = 0;
    if (on) begin();
    options.changed();
  };
  const begin = () => {
    if (frame) return;
    before = performance.now();
    frame = requestAnimationFrame(step);
  };
  const step = (now: number) => {
    frame = 0;
    const spent = limit(now - before, 0, LONGEST);
    before = now;
    if (own.playing) {
      own.time = Math.min(own.time + spent / 1000, secondsOf(session.path));
      const at = along(session.path, own.time);
      if (at) session.move(at);
      if (own.time >= secondsOf(session.path)) play(false);
      options.changed();
    }
    if (held.moving) carry(held.take(now));
    if (own.playing || held.moving) frame = requestAnimationFrame(step);
  };
  const carry = (gone: Goings) => {
    const from = session.place;
    const to = moved(from, gone, fast, own.walking ? (session.head?.eye ?? 1.7) : 0);
    if (own.walking && session.walls) [to[0], to[2]] = session.walls.walk([from[0], from[2]], [to[0], to[2]]);
    go(to);
  };

  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    fast = event.shiftKey;
    const name = KEYS[event.code] ?? KEYS[event.key];
    if (name) {
      held.press(name, event.timeStamp);
      play(false);
      begin();
    } else if (event.key === "Home") own.go(Object.values(session.head?.views ?? {})[0] ?? session.place);
    else if (event.key === "Enter") options.clicked(0.5, 0.5);
    else if (event.key === "Escape") options.escaped();
    else if (event.key === "+" || event.key === "=") dolly(1);
    else if (event.key === "-") dolly(-1);
    else return;
    event.preventDefault();
    if (event.key !== "Escape") event.stopPropagation();
  });
  canvas.addEventListener("keyup", (event) => {
    fast = event.shiftKey;
    const name = KEYS[event.code] ?? KEYS[event.key];
    if (name) held.release(name, event.timeStamp);
  });
  canvas.addEventListener("blur", () => {
    held.releaseAll(performance.now());
  });
  const dolly = (by: number) => {
    const [x, y, z, yaw, pitch, angle] = session.place;
    const far = own.walking ? 0.8 * by : by * limit(0.2 * y, 0.5, 60);
    const [way, steep] = [(yaw * Math.PI) / 180, own.walking ? 0 : (pitch * Math.PI) / 180];
    let [nx, nz] = [x + far * Math.sin(way) * Math.cos(steep), z - far * Math.cos(way) * Math.cos(steep)];
    if (own.walking && session.walls) [nx, nz] = session.walls.walk([x, z], [nx, nz]);
    go([nx, limit(y + far * Math.sin(steep), 0.6, 8000), nz, yaw, pitch, angle]);
  };
  pointing(canvas, {
    clicked: options.clicked,
    dragged(dx, dy) {
      play(false);
      go(turned(session.place, dx, dy, canvas.clientWidth));
    },
    wheeled: (by) => dolly(-0.008 * by),
  });
  signal.addEventListener("abort", () => cancelAnimationFrame(frame));
  return own;
}

/** A recorded way, its times from 0. */
function thinned(stops: Stop[]): Stop[] {
  const first = stops[0]?.time ?? 0;
  return stops.map((stop) => ({ ...stop, time: Number((stop.time - first).toFixed(2)) }));
}
