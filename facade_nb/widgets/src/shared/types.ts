// The state of a model as Python describes it (facade_nb/widgets/studio/wire.py), and the little that is used of the widget
// manager. Both are plain data: nothing here runs.

import type { StageState } from "./stage.ts";

export type Path = string[];
export type Axis = "x" | "y";
export const AXES: readonly Axis[] = ["x", "y"];

export interface LayerSide {
  pattern: string;
  group: string;
  mask: string[] | null;
  letters: string[];
}

export interface LayerState {
  name: string;
  visible: boolean;
  /** Whether it draws nothing yet: no shape has been chosen in it. */
  unshaped: boolean;
  depth: number;
  x: LayerSide;
  y: LayerSide;
}

export interface PatternState {
  name: string;
  text: string;
  hidden: string[];
  letters: string[];
  axes: string;
}

export interface SymbolState {
  name: string;
  axes: string;
  size: number | null;
  opaque: boolean;
  attached: boolean;
  unoccludable: boolean;
  transparent: boolean;
  placement: "center" | "left" | "right";
  min: number | null;
  max: number | null;
  solved: { x?: number; y?: number };
  /** Whether it came by itself as it was typed, and was not touched since. */
  fresh: boolean;
  /** Whether a pattern writes it. */
  used: boolean;
}

export interface CounterState {
  name: string;
  min: number;
  max: number | null;
  value: number | null;
  solved: number | null;
  fresh: boolean;
  used: boolean;
}

export interface DesignState {
  name: string;
  canvas: { width: number; height: number };
  layers: LayerState[];
  patterns: PatternState[];
  symbols: SymbolState[];
  counters: CounterState[];
  groups: string[];
  /** The design's texture grammar, what is wrong with it, and the materials that its rules are, with their colours. */
  grammar?: string;
  grammarFaults?: Fault[];
  rules?: Record<string, string>;
}

export interface Solved {
  shapes: number;
  holes: number;
  warnings: string[];
  complete: boolean;
  proven: boolean;
  gap: number;
  deviation: { x: number; y: number };
  width: number;
  height: number;
}

export interface StatusState {
  busy: boolean;
  /** The layout that is shown is the best so far, and the search goes on. */
  proving?: boolean;
  stale: boolean;
  message: string;
  blame: { patterns: string[]; symbols: string[]; counters: string[] };
  suggestions: string[];
  canUndo: boolean;
  canRedo: boolean;
  milliseconds: number;
  trouble: string;
  solved: Solved | null;
}

export interface Fault {
  place: string;
  message: string;
  line: number | null;
  column: number | null;
  excerpt: string;
}

export interface DraftState {
  path: Path;
  value: unknown;
  faults: Fault[];
}

/** Who says what a cell looks like: a layer, its pattern of an axis, or the design; "": nobody, it is the default. */
export type Level = "layer" | "x" | "y" | "design";
export const LEVELS: readonly Level[] = ["layer", "x", "y", "design"];

export type Look = string | number | boolean;

export interface Looks {
  kind?: string;
  geometry?: string;
  material?: string;
  offset?: number;
  thickness?: number;
  visible?: boolean;
}

export type VariantState = Looks & { weight: number };

export interface LookState {
  value: Look;
  level: Level | "";
  key: string;
  varied: boolean;
}

export interface Cell {
  rect: [number, number, number, number] | null;
  fields: Record<keyof Looks, LookState>;
  /** The keys under which it can be edited, and what each means in words. */
  keys: { key: string; means: string }[];
  patterns: { x: string; y: string };
  /** What each of these keys says, by level. */
  set: Record<Level, Record<string, Looks & { variants?: VariantState[] }>>;
  seed: number;
}

/** The table of a layer's pairs, row by row. */
export interface Pairs {
  layer: string;
  columns: string[];
  rows: string[];
  cells: { material: string; geometry: string; key: string; level: Level | ""; shown: boolean }[];
}

export interface SelectionState {
  shape: number | null;
  layer: string;
  x: string;
  y: string;
  number: [number, number] | null;
  /** Further pairs that are picked. */
  more: [string, string][];
  cell: Cell | null;
  pairs: Pairs | null;
}

export interface State extends StageState {
  design: DesignState;
  status: StatusState;
  drafts: DraftState[];
  selection: SelectionState;
  svg: string;
  theme: "light" | "dark";
  gallery: string[];
  catalogue: {
    geometries: string[];
    /** By the name of a geometry. */
    parameters?: Record<string, ParameterState[]>;
    materials: string[];
    swatches: Record<string, string>;
    modes?: ModeState[];
  };
  trouble: string;
  ack: { client?: string; seq?: number };
}

/** A parameter of a geometry: its name, what it says, and the words that it may be; without them it is typed. */
export type ParameterState = [name: string, hint: string, ...words: string[]];

/** A reflection mode, and what it makes of the word EkG, by the count. */
export interface ModeState {
  sign: string;
  name: string;
  words: Record<string, string>;
}

/** What Python sends besides the state. */
export type Reply = { client: string; seq: number } & (
  | { kind: "file"; name: string; text: string; media?: string; binary?: boolean }
  | { kind: "python"; name: string; text: string }
  | { kind: "thumbnail"; name: string; theme: string; svg: string }
  | { kind: "begun"; pattern: string }
  | { kind: "unbegun"; faults: Fault[] }
  | { kind: "note"; text: string }
  | { kind: "opened"; name: string }
  | { kind: "faults"; name: string; faults: Fault[] }
  | { kind: "refused"; faults: Fault[] }
  | { kind: "added"; what: string; name: string }
  | { kind: "renamed"; what: string; name: string; to: string }
  | ({ kind: "foretold" } & Foretold)
);

/** What a canvas of another width would bring (Python: studio/foretold.py). */
export interface Foretold {
  width: number;
  counts: { pattern: string; symbol: string; now: number; later: number; length: [now: number, then: number] }[];
  moves: { symbol: string; by: number; count: number; most: boolean }[];
}

/** The part of a widget model (Backbone's) that is used here. */
export interface WidgetModel {
  get<T = unknown>(name: string): T;
  /** One trait at a time: marimo's models take no more. */
  set(name: string, value: unknown): void;
  save_changes(): void;
  send(content: unknown): void;
  // biome-ignore lint/suspicious/noExplicitAny: the events carry different arguments
  on(names: string, callback: (...args: any[]) => void): void;
  // biome-ignore lint/suspicious/noExplicitAny: as above
  off(names: string, callback: (...args: any[]) => void): void;
  readonly model_id: string;
  comm_live?: boolean;
  /** Makes of its state what is saved. */
  serialize?(state: Record<string, unknown>): Record<string, unknown>;
  readonly widget_manager: WidgetManager;
}

export interface WidgetView {
  el: HTMLElement;
  trigger(event: string): void;
  remove(): void;
}

export interface WidgetManager {
  get_model(id: string): Promise<WidgetModel>;
  /** Not in marimo, which shows widgets of anywidget's only. */
  create_view?(model: WidgetModel): Promise<WidgetView>;
  /** In Jupyter's managers the connection to the kernel; null: there is none any more. */
  readonly kernel?: Connection | null;
}

interface Signal<A> {
  connect(slot: (sender: unknown, argument: A) => void): unknown;
  disconnect(slot: (sender: unknown, argument: A) => void): unknown;
}

/** The part of Jupyter's connection to a kernel that is used here. */
export interface Connection {
  readonly status: string;
  readonly connectionStatus: string;
  readonly isDisposed: boolean;
  readonly statusChanged: Signal<unknown>;
  readonly connectionStatusChanged: Signal<unknown>;
  readonly disposed: Signal<unknown>;
  readonly iopubMessage: Signal<{ header: { msg_type: string }; content: { restart?: boolean } }>;
  /** Which thread of the kernel hears comms. JupyterLab has it, from 4.4 on. */
  commsOverSubshells?: string;
  requestCommInfo(content: { target_name: string }): Promise<{ content: { comms?: Record<string, unknown> } }>;
}

/** What a part is given: its own model, the model's channel, and the style sheet that goes with the code. */
export interface Mount {
  el: HTMLElement;
  model: WidgetModel;
  channel: WidgetModel;
  css: string;
}
