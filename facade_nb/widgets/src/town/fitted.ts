// The tiles that the card has: as fine as the view needs, within a bound.

import type { Texture, Tiles } from "./tiles.ts";

interface Bounds {
  bytes: number;
  /** Pixels a side. */
  most: number;
}

export class Fitted {
  images: Record<"atlas" | "tile_table", Texture> | null = null;
  private side = 0;
  private version = -1;

  /** Whether these are of the tiles that have come, not of earlier ones. */
  of(tiles: Tiles): boolean {
    return this.version === tiles.version;
  }

  /**
   * Take other sizes where the view needs finer ones and they have come, or where it may have fewer: no fewer until there are
   * four times as many texels as it needs. `moving`: one size up at a time. Says whether anything has changed.
   */
  fit(tiles: Tiles, needed: number, { bytes, most }: Bounds, moving: boolean): boolean {
    if (!tiles.complete) return false;
    const wanted = this.side > needed && this.side <= 2 * needed ? this.side : needed;
    const step = moving && this.of(tiles) ? Math.min(wanted, 2 * this.side) : wanted;
    const side = tiles.sideFor(step, bytes, most);
    if (side === this.side && this.of(tiles)) return false;
    [this.side, this.version] = [side, tiles.version];
    this.images = tiles.arranged(side);
    return true;
  }
}
