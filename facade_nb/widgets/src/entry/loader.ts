// All the code that a part carries: it finds the channel its model shares with other parts, and runs the bundle that
// lies there once (see docs/widgets.md).

import type { Mount, WidgetModel } from "../shared/types.ts";

type Bundle = {
  mount(mount: Mount): () => void;
  /** Do what takes long before a view is shown, where that can be done without the kernel. */
  prepare?(channel: WidgetModel): void;
};
type Shared = { [bundles]?: Map<string, Promise<Bundle>> };

const bundles = Symbol.for("facade_nb.bundles");
const shared = globalThis as Shared;
shared[bundles] ??= new Map();
const loaded = shared[bundles];

/** The text of a file as Python packs it (widgets/shared/bundled.py): a third of it travels, and is saved. */
function unpack(packed: string): Promise<string> {
  const bytes = Uint8Array.from(atob(packed), (sign) => sign.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).text();
}

function load(packed: string): Promise<Bundle> {
  let bundle = loaded.get(packed);
  if (!bundle) {
    bundle = unpack(packed).then((source) => {
      const url = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
      return import(/* @vite-ignore */ url).finally(() => URL.revokeObjectURL(url)) as Promise<Bundle>;
    });
    loaded.set(packed, bundle);
  }
  return bundle;
}

/** The model behind a reference. While a page is restored, it may come a little later than the part. */
async function resolve(manager: WidgetModel["widget_manager"], reference: string): Promise<WidgetModel> {
  const id = reference.replace("IPY_MODEL_", "");
  for (let tries = 0; ; tries++) {
    try {
      return await manager.get_model(id);
    } catch (error) {
      if (tries === 50) throw error;
      await new Promise((done) => setTimeout(done, 100));
    }
  }
}

/** While the kernel is still at work on the cell, the page makes ready for its view. */
async function prepare(model: WidgetModel): Promise<void> {
  const channel = await resolve(model.widget_manager, model.get<string>("channel"));
  const code = await resolve(model.widget_manager, channel.get<string>("front_end"));
  const source = code.get<string>("module");
  if (source) (await load(source)).prepare?.(channel);
}

export default {
  initialize({ model }: { model: WidgetModel }) {
    prepare(model).catch(() => {}); // what is wrong is said where the view is shown
  },
  async render({ model, el }: { model: WidgetModel; el: HTMLElement }) {
    const channel = await resolve(model.widget_manager, model.get<string>("channel"));
    const code = await resolve(model.widget_manager, channel.get<string>("front_end"));
    if (!code.get("module")) {
      // Nobody has looked for a while, and the code has been put away.
      const woken = new Promise<void>((done) => code.on("change:module", done));
      try {
        if (channel.comm_live === false) throw new Error();
        channel.send({ op: "wake" });
      } catch {
        el.textContent = "There is no kernel to show this view: run the cell again.";
        return;
      }
      await woken;
    }
    const packed = code.get<string>("css");
    const bundle = await load(code.get<string>("module"));
    return bundle.mount({ model, el, channel, css: packed ? await unpack(packed) : "" });
  },
};
