// Things of which there is one for a channel.

import type { WidgetModel } from "./types.ts";

/** The one `S` of a channel, made when first asked for. */
export function oneFor<S>(make: (channel: WidgetModel) => S): (channel: WidgetModel) => S {
  const made = new WeakMap<WidgetModel, S>();
  return (channel) => {
    let found = made.get(channel);
    if (!found) {
      found = make(channel);
      made.set(channel, found);
    }
    return found;
  };
}
