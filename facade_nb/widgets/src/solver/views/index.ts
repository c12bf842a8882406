// Every view by its name, which is the `part` of its widget; one line each.

import type { ViewKind } from "../view.ts";
import { alignment } from "./alignment.ts";
import { analysis } from "./analysis.ts";
import { candidates } from "./candidates.ts";
import { code } from "./code.ts";
import { facade } from "./facade.ts";
import { network } from "./network.ts";
import { player } from "./player.ts";
import { runs } from "./runs.ts";
import { sizing } from "./sizing.ts";
import { words } from "./words.ts";

export const VIEWS: Record<string, ViewKind> = {
  alignment,
  analysis,
  candidates,
  code,
  facade,
  network,
  player,
  runs,
  sizing,
  words,
};
