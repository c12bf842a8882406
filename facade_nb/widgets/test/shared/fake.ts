// A widget model as the parts see it, without a manager: traits, events, and what was sent.

import { emptyStage } from "../../src/shared/stage.ts";
import type { Connection, State, WidgetManager, WidgetModel } from "../../src/shared/types.ts";

type Listener = (...args: unknown[]) => void;

export class FakeModel implements WidgetModel {
  readonly model_id = "m1";
  comm_live = true;
  readonly widget_manager = {} as WidgetManager;
  readonly sent: Record<string, unknown>[] = [];
  private readonly listeners = new Map<string, Set<Listener>>();

  constructor(private readonly traits: Record<string, unknown>) {}

  get<T>(name: string): T {
    return this.traits[name] as T;
  }
  set(name: string | Record<string, unknown>, value?: unknown): void {
    const values = typeof name === "string" ? { [name]: value } : name;
    Object.assign(this.traits, values);
    for (const name of Object.keys(values)) this.emit(`change:${name}`);
  }
  save_changes(): void {}
  send(content: unknown): void {
    this.sent.push(content as Record<string, unknown>);
  }
  on(names: string, callback: Listener): void {
    for (const name of names.split(" ")) {
      if (!this.listeners.has(name)) this.listeners.set(name, new Set());
      this.listeners.get(name)?.add(callback);
    }
  }
  off(names: string, callback: Listener): void {
    for (const name of names.split(" ")) this.listeners.get(name)?.delete(callback);
  }
  emit(name: string, ...args: unknown[]): void {
    for (const listener of [...(this.listeners.get(name) ?? [])]) listener(...args);
  }
  get listening(): number {
    return [...this.listeners.values()].reduce((sum, set) => sum + set.size, 0);
  }
  /** What was asked for, without the counting of views. */
  get asked(): Record<string, unknown>[] {
    return this.sent.filter((message) => message.op !== "view");
  }
}

class Signal<A> {
  private readonly slots = new Set<(sender: unknown, argument: A) => void>();
  connect(slot: (sender: unknown, argument: A) => void): void {
    this.slots.add(slot);
  }
  disconnect(slot: (sender: unknown, argument: A) => void): void {
    this.slots.delete(slot);
  }
  emit(argument: A): void {
    for (const slot of [...this.slots]) slot(null, argument);
  }
  get size(): number {
    return this.slots.size;
  }
}

/** The connection that Jupyter has to its kernel. */
export class FakeConnection implements Connection {
  status = "idle";
  connectionStatus = "connected";
  isDisposed = false;
  commsOverSubshells = "perCommTarget";
  comms: Record<string, unknown> = { m1: {} };
  readonly statusChanged = new Signal<unknown>();
  readonly connectionStatusChanged = new Signal<unknown>();
  readonly disposed = new Signal<unknown>();
  readonly iopubMessage = new Signal<{ header: { msg_type: string }; content: { restart?: boolean } }>();
  requestCommInfo() {
    return Promise.resolve({ content: { comms: this.comms } });
  }
  turn(values: Partial<Pick<FakeConnection, "status" | "connectionStatus" | "isDisposed">>): void {
    Object.assign(this, values);
    this.statusChanged.emit(null);
    this.connectionStatusChanged.emit(null);
  }
  say(restart: boolean): void {
    this.iopubMessage.emit({ header: { msg_type: "shutdown_reply" }, content: { restart } });
  }
}

export function fakeState(): State {
  return {
    ...emptyStage(),
    design: {
      name: "House",
      canvas: { width: 6, height: 3 },
      layers: [],
      patterns: [{ name: "Bx", text: "A(BA)^k", hidden: [], letters: ["A", "B"], axes: "x" }],
      symbols: [],
      counters: [],
      groups: ["default"],
    },
    status: {
      busy: false,
      stale: false,
      message: "",
      blame: { patterns: [], symbols: [], counters: [] },
      suggestions: [],
      canUndo: false,
      canRedo: false,
      milliseconds: 3,
      trouble: "",
      solved: null,
    },
    drafts: [],
    selection: { shape: null, layer: "", x: "", y: "", number: null, more: [], cell: null, pairs: null },
    svg: "",
    theme: "light",
    gallery: [],
    catalogue: { geometries: [], materials: [], swatches: {} },
    trouble: "",
    ack: {},
  };
}
