// Real traces for the tests of the views: the pieces of gallery designs, as Python packs them (tests/widgets/solver/pieces.py).

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { unpack } from "../../src/shared/packing.ts";
import { Alternatives } from "../../src/solver/alternatives.ts";
import { Asking } from "../../src/solver/asking.ts";
import { Links } from "../../src/solver/links.ts";
import { Player } from "../../src/solver/player.ts";
import type { Session } from "../../src/solver/session.ts";
import { Timeline, type TimelineData } from "../../src/solver/timeline.ts";
import type { View, ViewKind } from "../../src/solver/view.ts";
import { FakeModel } from "../shared/fake.ts";
import { FOLDER } from "./pieces.ts";

export const DESIGNS = [
  "figure-7",
  "figure-7-paper",
  "residential-house",
  "apartment-house",
  "alternation",
  "contradiction",
  "figure-8",
  "figure-8-ida",
] as const;

export type Design = (typeof DESIGNS)[number];

/** A piece of a design's trace, as it travels. */
export function pieceOf(design: string, name: string): Uint8Array {
  return new Uint8Array(readFileSync(join(FOLDER, `${design}.${name}.bin`)));
}

// jsdom lays nothing out, so there is nothing to observe.
globalThis.ResizeObserver ??= class {
  observe(): void {}
  unobserve(): void {}
  disconnect(): void {}
};

export interface Shown {
  view: View;
  player: Player;
  links: Links;
  asking: Asking;
  alternatives: Alternatives;
  timeline: Timeline;
  /** Go to a position, and show it at once. */
  go(position: number): void;
  end(): void;
}

/** A view of a design's trace, without a page around it. */
export async function show(kind: ViewKind, design: string, traits: Record<string, unknown> = {}): Promise<Shown> {
  const end = new AbortController();
  const timeline = new Timeline(await unpack<TimelineData>(pieceOf(design, "timeline")));
  const player = new Player(timeline, -1);
  const links = new Links([]);
  const pieces: Record<string, unknown> = {};
  for (const name of [...kind.needs, ...(kind.wants ?? [])]) pieces[name] = await unpack(pieceOf(design, name));
  const session = { live: true } as unknown as Session;
  const alternatives = new Alternatives((name) => unpack(pieceOf(design, name)), timeline, links, end.signal);
  const asking = new Asking();
  let view: View | null = null;
  const refresh = () => {
    view?.show(player.position);
    if (view?.light) view.light();
    else if (view) links.apply(view.el);
  };
  view = kind.make({
    timeline,
    player,
    links,
    alternatives,
    asking,
    session,
    model: new FakeModel(traits),
    pieces,
    signal: end.signal,
    refresh,
  });
  alternatives.watch(refresh, end.signal);
  document.body.append(view.el);
  refresh();
  const shown = view;
  return {
    view,
    player,
    links,
    asking,
    alternatives,
    timeline,
    go(position) {
      player.go(position);
      refresh();
    },
    end() {
      end.abort();
      shown.el.remove();
    },
  };
}
