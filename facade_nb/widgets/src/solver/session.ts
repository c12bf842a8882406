// What all views of one trace on a page share: its pieces, the player, the links. There is one session for a channel.

import { setTraits } from "../shared/dom.ts";
import { oneFor } from "../shared/one.ts";
import { type Bytes, byteLength, unpack } from "../shared/packing.ts";
import { Shared } from "../shared/shared.ts";
import { Alternatives } from "./alternatives.ts";
import { Links } from "./links.ts";
import { type Moment, visit, watchMoments } from "./moments.ts";
import { Player } from "./player.ts";
import { Timeline, type TimelineData } from "./timeline.ts";

const SETTLED = 250; // milliseconds after which Python is told where the player stands

/** A trace that is loaded: another one comes where the model that is followed was solved again. */
export interface Loaded {
  timeline: Timeline;
  player: Player;
  links: Links;
  /** The candidate that the reader has chosen. */
  alternatives: Alternatives;
}

export class Session extends Shared {
  static readonly of = oneFor((channel) => new Session(channel));

  private readonly pieces = new Map<string, Promise<unknown>>();
  private loading: Promise<Loaded> | null = null;
  private loaded: AbortController | null = null;
  private telling = 0;
  /** The last position that came from Python or was told to it: -1 is the end. */
  private known = -1;

  /** The lesson that is shown; empty: what the views were made of is. */
  get lesson(): string {
    return this.channel.get<string>("lesson") ?? "";
  }

  /** What to look at in it. */
  get about(): string {
    return this.channel.get<string>("about") ?? "";
  }

  /** Names and titles of all lessons. */
  get lessons(): [name: string, title: string][] {
    return this.channel.get<[string, string][]>("lessons") ?? [];
  }

  /** Why what is shown is not the present design; empty: it is. */
  get stale(): string {
    return this.channel.get<string>("stale") ?? "";
  }

  /** Have Python show a lesson, or, without a name, what the views were made of. */
  learn(name: string): void {
    this.save({ lesson: name }, "lesson");
  }

  /** Call back when the present design is not that of the trace any more, or is again. */
  watchStale(callback: () => void, signal: AbortSignal): void {
    this.channel.on("change:stale", callback);
    signal.addEventListener("abort", () => this.channel.off("change:stale", callback));
  }

  /** Timeline, player and links of the present trace. */
  load(): Promise<Loaded> {
    this.loading ??= this.make();
    return this.loading;
  }

  /** A piece of the trace, asked for where it is not there. */
  piece<T>(name: string): Promise<T> {
    let found = this.pieces.get(name);
    if (!found) {
      found = this.fetch(name).then((bytes) => unpack<T>(bytes));
      this.pieces.set(name, found);
    }
    return found as Promise<T>;
  }

  protected begin(): void {
    this.listen("serial", () => {
      this.forget();
      this.tell(); // another trace has come
    });
    this.listen("position", () => {
      const position = this.channel.get<number>("position");
      if (position === this.known) return;
      this.known = position;
      this.loading?.then(({ player, timeline }) => player.go(position < 0 ? timeline.last : position), ignore);
    });
    this.listen("picked", () => {
      this.loading?.then(({ links }) => links.pick(this.channel.get<string[]>("picked")), ignore);
    });
  }

  protected end(): void {
    this.forget();
  }

  private forget(): void {
    clearTimeout(this.telling);
    this.loading?.then(({ player }) => player.pause(), ignore);
    this.loaded?.abort("ended");
    this.loaded = this.loading = null;
    this.pieces.clear();
  }

  private async make(): Promise<Loaded> {
    const end = new AbortController();
    this.loaded = end;
    const timeline = new Timeline(await this.piece<TimelineData>("timeline"));
    this.known = this.channel.get<number>("position");
    const player = new Player(timeline, this.known);
    const links = new Links(this.channel.get<string[]>("picked"));
    const go = ({ moment, design }: Moment): boolean => {
      const position = !design || design === timeline.data.name ? timeline.locate(moment) : undefined;
      if (position === undefined) return false;
      player.pause();
      player.go(position);
      return true;
    };
    visit(go);
    watchMoments(go, end.signal);
    player.watch(() => this.tellSoon(player), end.signal);
    links.watch(() => this.save({ picked: [...links.picked] }, "picked"), end.signal);
    const alternatives = new Alternatives((name) => this.piece(name), timeline, links, end.signal);
    return { timeline, player, links, alternatives };
  }

  /** Python learns where the player has come to rest, so that a reload, and a saved notebook, find it there. */
  private tellSoon(player: Player): void {
    clearTimeout(this.telling);
    if (player.playing) return;
    this.telling = window.setTimeout(() => {
      this.known = player.atEnd ? -1 : player.position;
      this.save({ position: this.known }, "position");
    }, SETTLED);
  }

  private save(values: Record<string, unknown>, name: string): void {
    if (JSON.stringify(this.channel.get(name)) === JSON.stringify(values[name])) return;
    setTraits(this.channel, values);
    this.kernel.save();
  }

  private async fetch(name: string): Promise<Bytes> {
    const bytes = this.channel.get<Bytes>(name);
    if (byteLength(bytes)) return bytes;
    if (this.trouble) throw new Error(this.trouble);
    if (this.kernel.presence === "saved")
      throw new Error(`This saved page has no piece “${name}”: run the notebook to see it.`);
    const arrived = new Promise<Bytes>((resolve, reject) => {
      const end = new AbortController();
      const finish = (act: () => void) => {
        end.abort("ended");
        this.channel.off(`change:${name}`, look);
        this.channel.off("change:trouble", fail);
        act();
      };
      const look = () => {
        const found = this.channel.get<Bytes>(name);
        if (byteLength(found)) finish(() => resolve(found));
      };
      const fail = () => {
        if (this.trouble) finish(() => reject(new Error(this.trouble)));
      };
      this.channel.on(`change:${name}`, look);
      this.channel.on("change:trouble", fail);
      const ask = () => {
        this.kernel.tell({ op: "provide", names: [name] });
        if (this.kernel.presence === "gone") {
          const why = `The kernel ${this.kernel.fate} before it had sent the piece “${name}”: run the cell again to see it.`;
          finish(() => reject(new Error(why)));
        }
      };
      this.kernel.watch(ask, end.signal);
      ask();
    });
    return arrived;
  }
}

/** What failed to load is told where it was to be shown. */
function ignore(): void {}
