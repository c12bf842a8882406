// What the views of one set of variants on a page share: its rows, and the pictures that have come.

import { oneFor } from "../shared/one.ts";
import { type Bytes, byteLength, inflated } from "../shared/packing.ts";
import { Shared } from "../shared/shared.ts";
import type { Theme } from "../shared/theme.ts";
import type { Pictures, RunState, VariantRow } from "./types.ts";

const TRAITS = ["rows", "columns", "state", "trouble"] as const;
/** So many pictures are asked for at once. */
const BATCH = 8;

export class Session extends Shared {
  static readonly of = oneFor((channel) => new Session(channel));

  private theme: Theme = "light";
  private readonly drawn = new Map<string, string>();
  private readonly wanted = new Set<number>();
  /** What has been asked for and has not come. */
  private asked: number[] = [];

  get name(): string {
    return this.channel.get<string>("name");
  }
  get columns(): string[] {
    return this.channel.get<string[]>("columns");
  }
  get rows(): VariantRow[] {
    return this.channel.get<VariantRow[]>("rows");
  }
  get state(): RunState {
    return this.channel.get<RunState>("state");
  }

  ask(message: { op: string; [argument: string]: unknown }): void {
    this.kernel.tell({ ...message, client: this.client });
  }

  /** The theme that pictures are drawn for. */
  dress(theme: Theme): void {
    if (theme === this.theme) return;
    this.theme = theme;
    this.fetch();
    this.tell();
  }

  /** The picture of a row; one that has come for another theme is better than none. */
  picture(row: number): string | undefined {
    return (
      this.drawn.get(`${this.theme} ${row}`) ?? this.drawn.get(`${this.theme === "dark" ? "light" : "dark"} ${row}`)
    );
  }

  /** A row has come into sight: its picture is wanted as soon as it is solved. */
  want(row: number): void {
    this.wanted.add(row);
    this.fetch();
  }

  private fetch(): void {
    if (!this.live || this.asked.length > 0) return;
    const missing = [...this.wanted].filter(
      (row) => this.rows[row]?.state === "done" && !this.drawn.has(`${this.theme} ${row}`),
    );
    this.asked = missing.slice(0, BATCH);
    if (this.asked.length) this.ask({ op: "pictures", rows: this.asked, theme: this.theme });
  }

  private readonly onMessage = (content: { kind?: string; client?: string }, buffers: Bytes[] = []): void => {
    if (content.kind !== "pictures" || content.client !== this.client || !buffers[0]) return;
    void this.take(buffers[0]).then(() => {
      this.asked = [];
      this.fetch();
    });
  };

  private async take(bytes: Bytes): Promise<void> {
    const { theme, drawn } = JSON.parse(new TextDecoder().decode(await inflated(bytes))) as Pictures;
    for (const [row, text] of Object.entries(drawn)) this.drawn.set(`${theme} ${row}`, text);
    this.tell();
  }

  private readonly onKept = (): void => {
    const bytes = this.channel.get<Bytes>("pictures");
    if (byteLength(bytes)) void this.take(bytes);
  };

  protected override kernelChanged(): void {
    this.asked = []; // what was under way may have been lost
    this.fetch();
    super.kernelChanged();
  }

  protected begin(): void {
    for (const name of TRAITS)
      this.listen(name, () => {
        this.fetch();
        this.tell();
      });
    this.listen("pictures", this.onKept);
    this.channel.on("msg:custom", this.onMessage);
    this.present.signal.addEventListener("abort", () => this.channel.off("msg:custom", this.onMessage));
    this.onKept();
  }

  protected end(): void {
    this.wanted.clear();
    this.drawn.clear();
    this.asked = [];
  }
}
