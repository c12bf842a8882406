import { h, setText, setTraits } from "../shared/dom.ts";
import type { WidgetModel, WidgetView } from "../shared/types.ts";
import type { Context } from "./common.ts";

const FIELD = 32;
const ASPECT = 1.3;

type Orbit = WidgetModel & { obj: { update(): void } };
type Mesh = WidgetModel & { obj: { geometry: { boundingSphere: unknown; boundingBox: unknown } } };

/**
 * The 3D view: a pythreejs renderer that Python makes when it is first asked for. It is shown here at the size of its
 * container; orbiting and picking are its own.
 */
export function massing({ store }: Context, model: WidgetModel, signal: AbortSignal): HTMLElement {
  const wait = h("p", { class: "fnb-empty" }, "Building the 3D view…");
  const el = h(
    "div",
    { class: "fnb-massing", "aria-label": "3D view: drag to orbit, scroll to zoom, click to pick" },
    wait,
  );
  const tag = h("span", { class: "fnb-tag", hidden: true }, "Last good layout");
  store.watch(["status"], () => {
    tag.hidden = !store.get("status").stale;
  });
  let view: WidgetView | null = null;
  let renderer: WidgetModel | null = null;

  const resize = () => {
    const { clientWidth: width, clientHeight: height } = el;
    if (!renderer || !width || !height) return;
    const size = { _width: Math.floor(width), _height: Math.floor(height) };
    if (renderer.get("_width") === size._width && renderer.get("_height") === size._height) return;
    setTraits(renderer, size);
    const camera = renderer.get<WidgetModel>("camera");
    const aspect = size._width / size._height;
    // Python stands the camera for ASPECT; in a narrower view the angle opens so that the façade's width stays in it.
    const slope = Math.tan((FIELD * Math.PI) / 360) * Math.max(1, ASPECT / aspect);
    setTraits(camera, { aspect, fov: (Math.atan(slope) * 360) / Math.PI });
    // The browser's own business: Python need not know, and is not told.
  };
  // three.js keeps the bounds of a geometry it has once measured, for culling and for picking.
  const measureAnew = () => {
    const [mesh] = renderer?.get<WidgetModel>("scene").get<Mesh[]>("children") ?? [];
    if (!mesh) return;
    const forget = () => {
      mesh.obj.geometry.boundingSphere = null;
      mesh.obj.geometry.boundingBox = null;
    };
    mesh.on("childchange change:geometry", forget);
    signal.addEventListener("abort", () => mesh.off("childchange change:geometry", forget));
  };
  // pythreejs sets a target without turning the camera towards it.
  const aim = () => {
    const [orbit] = renderer?.get<Orbit[]>("controls") ?? [];
    if (!orbit) return;
    const turn = () => orbit.obj.update();
    turn();
    orbit.on("change:target", turn);
    signal.addEventListener("abort", () => orbit.off("change:target", turn));
  };
  const show = async () => {
    const reference = model.get<string | null>("renderer");
    if (!reference || view || signal.aborted) return;
    const manager = model.widget_manager;
    renderer = await manager.get_model(reference.replace("IPY_MODEL_", ""));
    const made = await manager.create_view?.(renderer);
    if (!made) return;
    if (signal.aborted) {
      made.remove();
      return;
    }
    view = made;
    el.replaceChildren(made.el, tag);
    made.trigger("displayed");
    resize();
    aim();
    measureAnew();
  };

  keepDragsFromPicking(el, signal);

  const observer = new ResizeObserver(resize);
  observer.observe(el);
  const changed = () => void show();
  model.on("change:renderer", changed);
  signal.addEventListener("abort", () => {
    observer.disconnect();
    model.off("change:renderer", changed);
    // Gives the WebGL context back to pythreejs's pool.
    view?.remove();
  });
  void show();
  const ask = (here: boolean) => store.kernel.tell({ op: "renderer", client: store.client, here }, model);
  const tell = () => {
    if (store.kernel.presence === "gone") release(renderer);
    if (view) return;
    ask(true);
    if (!model.widget_manager.create_view)
      setText(wait, "The 3D view needs Jupyter: it cannot be shown in this application.");
    else if (store.kernel.presence === "gone") setText(wait, "The kernel has gone before the 3D view was built.");
  };
  if (model.widget_manager.create_view) signal.addEventListener("abort", () => ask(false));
  store.kernel.watch(tell, signal);
  tell();
  return el;
}

/** pythreejs tells Python of every turn: when its kernel has gone, it can be looked around all the same. */
function release(renderer: WidgetModel | null): void {
  if (!renderer) return;
  const [camera, controls] = [renderer.get<WidgetModel>("camera"), renderer.get<WidgetModel[]>("controls")];
  for (const own of [renderer, camera, ...controls]) own.comm_live = false;
}

/** The picker listens for clicks, and an orbit ends with one: swallow those. */
function keepDragsFromPicking(el: HTMLElement, signal: AbortSignal): void {
  let from = { x: 0, y: 0 };
  el.addEventListener(
    "pointerdown",
    (event) => {
      from = { x: event.clientX, y: event.clientY };
    },
    { capture: true, signal },
  );
  el.addEventListener(
    "click",
    (event) => {
      if (Math.hypot(event.clientX - from.x, event.clientY - from.y) > 4) event.stopPropagation();
    },
    { capture: true, signal },
  );
}
