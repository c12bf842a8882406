// Live views on a page without a kernel: what Jupyter's widget managers do with a saved state, from plain files.
//
// A page is opened from a folder, where a browser lets no script fetch a file and load no module. So all is a classic script:
// this one, and one for each state, which hands itself over by `facadeNbState`. A state is loaded when a view of its
// comes near the screen. Until a view is there, and without scripts, its place holds the picture that was saved with it.

import * as base from "@jupyter-widgets/base";
import { type IManagerState, ManagerBase } from "@jupyter-widgets/base-manager";
import "./amd.ts";
import "anywidget";
import { modules } from "./amd.ts";
import "@jupyter-widgets/base/css/index.css";
import "@lumino/widgets/style/index.css";
import { Widget } from "@lumino/widgets";

const NEAR = "600px"; // before a view is on the screen, its state is read

class SavedManager extends ManagerBase {
  protected loadClass(name: string, module: string): Promise<typeof base.WidgetModel | typeof base.WidgetView> {
    const own = module === "@jupyter-widgets/base" ? base : modules.get(module);
    const found = (own as Record<string, typeof base.WidgetModel> | undefined)?.[name];
    return found ? Promise.resolve(found) : Promise.reject(new Error(`there is no ${name} of ${module} here`));
  }

  // There is no kernel: nothing is ever created or asked for there.
  protected _get_comm_info(): Promise<Record<string, never>> {
    return Promise.resolve({});
  }

  protected _create_comm(): Promise<never> {
    return Promise.reject(new Error("there is no kernel"));
  }
}

type Hand = (name: string, content: object) => void;

const managers = new Map<string, Promise<SavedManager>>();
const files = new Map<string, Promise<object>>();
const awaited = new Map<string, (content: object) => void>();

(globalThis as { facadeNbState?: Hand }).facadeNbState = (name, content) => awaited.get(name)?.(content);

/** What a file hands over; it is read once. */
function contentOf(source: string, name: string): Promise<object> {
  let read = files.get(source);
  if (!read) {
    read = new Promise((resolve, reject) => {
      awaited.set(name, resolve);
      const script = document.createElement("script");
      script.src = source;
      script.onerror = () => reject(new Error(`${source} can't be read`));
      document.head.append(script);
    });
    files.set(source, read);
  }
  return read;
}

/** A state, with the front end's code put back into it: that lies in a file which pages share. */
async function stateOf(source: string, name: string): Promise<IManagerState> {
  const state = (await contentOf(source, name)) as IManagerState;
  for (const model of Object.values(state.state) as { state: object; code?: string }[])
    if (model.code)
      Object.assign(model.state, await contentOf(source.replace(`${name}.js`, `${model.code}.js`), model.code));
  return state;
}

/** The manager of a state, whose file is read once. */
function managerOf(source: string, name: string): Promise<SavedManager> {
  let made = managers.get(source);
  if (!made) {
    made = stateOf(source, name).then(async (state) => {
      const manager = new SavedManager();
      await manager.set_state(state);
      return manager;
    });
    managers.set(source, made);
  }
  return made;
}

/** Show a view in its place; the picture goes once it is there. */
async function show(place: HTMLElement): Promise<void> {
  const { source = "", state = "", model = "" } = place.dataset;
  const manager = await managerOf(source, state);
  const view = await manager.create_view((await manager.get_model(model)) as base.DOMWidgetModel);
  const root = document.createElement("div");
  root.className = "fnb-live-view";
  place.prepend(root);
  Widget.attach(view.luminoWidget, root);
  place.dataset.live = "shown";
}

function fail(place: HTMLElement, error: unknown): void {
  place.dataset.live = "failed";
  console.error("facade_nb: a view can't be shown:", error);
}

function begin(): void {
  const observer = new IntersectionObserver(
    (entries) => {
      for (const { isIntersecting, target } of entries) {
        if (!isIntersecting) continue;
        observer.unobserve(target);
        show(target as HTMLElement).catch((error) => fail(target as HTMLElement, error));
      }
    },
    { rootMargin: NEAR },
  );
  for (const place of document.querySelectorAll(".fnb-live")) observer.observe(place);
}

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", begin);
else begin();
