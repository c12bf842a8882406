// Whether there is still a kernel behind a channel, and a way to it that never fails.
//
// Jupyter's widget managers have the connection to their kernel, which says what becomes of it: it answers a shut-down or a
// restart, whoever asked for it, and the server tells when it has died. A kernel that is busy says nothing and is there all
// the same. Other hosts, such as marimo, have no such object: there a message goes out every second, and what counts is
// whether it could be handed over, not whether it is answered soon.

import { oneFor } from "./one.ts";
import type { Connection, WidgetModel } from "./types.ts";

/**
 * live: there is a kernel. away: there is no connection at present. gone: that kernel will never answer again.
 * saved: there has been none since the page was opened.
 */
export type Presence = "live" | "away" | "gone" | "saved";

const BEAT = 1000; // milliseconds between messages where nothing else tells whether there is a kernel
const DIED = "died and was started anew";
const PARTED = ["restarting", "autorestarting", "terminating", "dead"];

export class Kernel {
  static readonly of = oneFor((channel) => new Kernel(channel));

  presence: Presence;
  /** What became of it, to go on after "The kernel". */
  fate = "";
  private readonly client = Math.random().toString(36).slice(2);
  private readonly watchers = new Set<() => void>();
  /** By client, the number of the last message that Python had got after a gap. */
  private readonly heard = new Map<string, number>();
  private watching: AbortController | null = null;

  constructor(private readonly channel: WidgetModel) {
    this.presence = channel.comm_live === false ? "saved" : "live";
  }

  get live(): boolean {
    return this.presence === "live";
  }

  /** Call back when the presence has changed, until the signal ends. */
  watch(callback: () => void, signal: AbortSignal): void {
    if (this.watchers.size === 0) this.begin();
    this.watchers.add(callback);
    signal.addEventListener("abort", () => {
      this.watchers.delete(callback);
      if (this.watchers.size > 0) return;
      // With a word for a reason: an error would hold the calls that have led here, and with them the view that has gone.
      this.watching?.abort("nobody looks");
      this.watching = null;
    });
  }

  /** Send a message, if there is a kernel to send it to. */
  tell(message: Record<string, unknown>, model: WidgetModel = this.channel): void {
    if (this.live) this.hand(message, model);
  }

  /** Have Python know what was set, if there is a kernel to know it. */
  save(model: WidgetModel = this.channel): void {
    if (!this.live || model.comm_live === false) return;
    try {
      model.save_changes();
    } catch {
      this.turn("away");
    }
  }

  /** Number of the last message of a client that had come to Python when the connection returned. */
  received(client: string): number {
    return this.heard.get(client) ?? 0;
  }

  private begin(): void {
    if (this.presence === "saved" || this.presence === "gone") return;
    const end = new AbortController();
    this.watching = end;
    this.listen("msg:custom", (content: { kind?: string; heard?: Record<string, number> }) => {
      if (content.kind !== "pong") return;
      for (const [client, seq] of Object.entries(content.heard ?? {})) this.heard.set(client, seq);
      if (this.presence === "away") this.turn("live");
    });
    this.listen("comm_live_update", () => {
      if (this.channel.comm_live === false) this.part(this.fate || "was restarted");
    });
    this.listen("comm:close", () => this.part("has closed this view"));
    const connection = this.channel.widget_manager.kernel;
    if (connection?.iopubMessage) this.follow(connection, end.signal);
    else if (connection === null) this.part("is not there any more");
    else this.beat(end.signal);
  }

  /** Follow the connection that Jupyter has. */
  private follow(connection: Connection, signal: AbortSignal): void {
    const message = (
      _: unknown,
      { header, content }: { header: { msg_type: string }; content: { restart?: boolean } },
    ) => {
      if (header.msg_type !== "shutdown_reply") return;
      if (content.restart) forgetSubshells(connection);
      this.part(content.restart ? "was restarted" : "was shut down");
    };
    const look = () => {
      const { status } = connection;
      if (status === "autorestarting") this.part(DIED);
      else if (status === "restarting") this.part("was restarted");
      else if (connection.isDisposed || PARTED.includes(status)) this.part(this.fate || "has ended");
      else if (connection.connectionStatus !== "connected") this.turn("away");
      else if (this.presence === "away" || status === "starting") void this.verify(connection);
    };
    const signals = [connection.statusChanged, connection.connectionStatusChanged, connection.disposed];
    connection.iopubMessage.connect(message);
    for (const one of signals) one.connect(look);
    signal.addEventListener("abort", () => {
      connection.iopubMessage.disconnect(message);
      for (const one of signals) one.disconnect(look);
    });
    look();
  }

  /** Whether the kernel that is connected now is the one that this channel belongs to. */
  private async verify(connection: Connection): Promise<void> {
    this.ping();
    try {
      const { content } = await connection.requestCommInfo({ target_name: "jupyter.widget" });
      if (content.comms && !(this.channel.model_id in content.comms)) this.part("was restarted");
    } catch {
      // The connection was lost again: the next time it returns, this is asked anew.
    }
  }

  /** Send a message every second. */
  private beat(signal: AbortSignal): void {
    const timer = window.setInterval(() => this.ping(), BEAT);
    signal.addEventListener("abort", () => clearInterval(timer));
  }

  /** Ask for an answer; after a gap also for all that may have been missed. */
  private ping(): void {
    this.hand({ op: "ping", renew: this.presence === "away", client: this.client });
  }

  private hand(message: Record<string, unknown>, model = this.channel): void {
    try {
      // In marimo sending takes a while, and ends with an error where the server has gone.
      const sent = model.send(message) as Promise<void> | undefined;
      sent?.catch?.(() => this.turn("away"));
    } catch {
      this.turn("away");
    }
  }

  private part(fate: string): void {
    // That it has died is told a moment after that it restarts; nothing else is news of one that has gone.
    if (this.presence === "gone" && (fate !== DIED || fate === this.fate)) return;
    this.fate = fate;
    this.presence = "gone";
    this.notify();
  }

  private turn(presence: "live" | "away"): void {
    if (this.presence === presence || this.presence === "gone") return;
    this.presence = presence;
    this.notify();
  }

  private notify(): void {
    for (const watcher of [...this.watchers]) watcher();
  }

  // biome-ignore lint/suspicious/noExplicitAny: the events carry different arguments
  private listen(name: string, callback: (...args: any[]) => void): void {
    this.channel.on(name, callback);
    this.watching?.signal.addEventListener("abort", () => this.channel.off(name, callback));
  }
}

/**
 * Where somebody else has restarted the kernel, JupyterLab 4.6 goes on sending to a thread that the new one does not have:
 * of widgets that are made then, nothing would be heard. They speak to the main thread instead.
 */
function forgetSubshells(connection: Connection): void {
  if (connection.status !== "restarting" && connection.commsOverSubshells) connection.commsOverSubshells = "disabled";
}
