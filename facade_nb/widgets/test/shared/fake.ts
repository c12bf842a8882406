// A widget model as the parts see it, without a manager: traits, events, and what was sent.

import type { State, WidgetManager, WidgetModel } from "../../src/shared/types.ts";

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

export function fakeState(): State {
  return {
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
    selection: { shape: null, layer: "", x: "", y: "", cell: null },
    svg: "",
    theme: "light",
    gallery: [],
    catalogue: { geometries: [], materials: [] },
    trouble: "",
    ack: {},
  };
}
