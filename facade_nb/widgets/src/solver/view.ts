// What a view of a solve is, for its frame and for the registry.

import type { Quiz } from "../shared/quiz.ts";
import type { WidgetModel } from "../shared/types.ts";
import type { Asking } from "./asking.ts";
import type { Loaded, Session } from "./session.ts";

/** A trace, as the views of one widget have it. */
export interface Hosted extends Loaded {
  /** What these views ask at present. */
  asking: Asking;
}

export interface ViewContext extends Hosted {
  session: Session;
  /** The widget's own traits: a view's options. */
  model: WidgetModel;
  /** The pieces that the view needs, by name. */
  pieces: Record<string, unknown>;
  signal: AbortSignal;
  /** Show the present moment again: a choice in the view has changed what it shows of it. */
  refresh(): void;
}

export interface View {
  el: HTMLElement;
  /** Fields and buttons of the view's own, for its head. */
  controls?: HTMLElement[];
  /** Show a moment. What is seen depends on the position and the reader's choices only, never on where one came from. */
  show(position: number): void;
  /** What is lit or picked has changed; without it `Links.apply` marks the linked elements. */
  light?(): void;
  /** What the reader can be asked. */
  quiz?: Quiz;
}

export interface ViewKind {
  title: string;
  /** What it shows, in a line. */
  subtitle: string;
  /** Pieces of the trace (widgets/solver/chunks.py). */
  needs: readonly string[];
  /** Pieces that it can do without: a page that was saved may not have them. */
  wants?: readonly string[];
  make(context: ViewContext): View;
}
