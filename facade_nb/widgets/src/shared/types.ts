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
  solved: number[];
}

export interface CounterState {
  name: string;
  min: number;
  max: number | null;
  value: number | null;
  solved: number | null;
}

export interface DesignState {
  name: string;
  canvas: { width: number; height: number };
  layers: LayerState[];
  patterns: PatternState[];
  symbols: SymbolState[];
  counters: CounterState[];
  groups: string[];
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
  missing: string[];
}

export interface Cell {
  rect: [number, number, number, number];
  kind: string;
  geometry: string;
  material: string;
  offset: number;
  thickness: number;
  own: string[];
}

export interface SelectionState {
  shape: number | null;
  layer: string;
  x: string;
  y: string;
  cell: Cell | null;
}

export interface State extends StageState {
  design: DesignState;
  status: StatusState;
  drafts: DraftState[];
  selection: SelectionState;
  svg: string;
  theme: "light" | "dark";
  gallery: string[];
  catalogue: { geometries: string[]; materials: string[] };
  trouble: string;
  ack: { client?: string; seq?: number };
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
);

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
