// Every view by its name, which is the `part` of its widget; one line each.

import type { ViewKind } from "../view.ts";
import { analysis } from "./analysis.ts";
import { candidates } from "./candidates.ts";
import { facade } from "./facade.ts";
import { player } from "./player.ts";
import { words } from "./words.ts";

export const VIEWS: Record<string, ViewKind> = {
  analysis,
  candidates,
  facade,
  player,
  words,
};
