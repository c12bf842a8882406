// Where what opens over the page stands: in what is seen of it.

type Anchor = Pick<Element, "getBoundingClientRect">;

interface Seen {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

const EDGE = 4;

/** What is seen of the page around an element: a host's scrolling panels cut off what goes beyond them. */
function seenAround(el: Element): Seen {
  const seen = { left: 0, top: 0, right: window.innerWidth, bottom: window.innerHeight };
  const outer = el.closest(".fnb") ?? el;
  for (let at = outer.parentElement; at; at = at.parentElement) {
    if (!/auto|scroll|hidden|clip/.test(getComputedStyle(at).overflowY)) continue;
    const box = at.getBoundingClientRect();
    if (box.height < 120) continue; // it is as high as what is in it
    seen.left = Math.max(seen.left, box.left);
    seen.top = Math.max(seen.top, box.top);
    seen.right = Math.min(seen.right, box.right);
    seen.bottom = Math.min(seen.bottom, box.bottom);
  }
  return seen;
}

/** Put a list where all of it can be seen: under its anchor, or above it where there is more room. */
export function placeUnder(anchor: Anchor, popup: HTMLElement): void {
  const seen = seenAround(popup);
  const box = anchor.getBoundingClientRect();
  const below = seen.bottom - box.bottom;
  const above = box.top - seen.top;
  popup.style.maxHeight = `${Math.max(120, Math.min(320, Math.max(above, below) - 12))}px`;
  put(popup, seen, ({ height }) => ({
    left: box.left,
    top: below >= height + 8 || below >= above ? box.bottom + 2 : box.top - height - 2,
  }));
}

/** Put a card to the left of its anchor, as high as there is room. */
export function placeBeside(anchor: Anchor, popup: HTMLElement): void {
  const seen = seenAround(popup);
  const box = anchor.getBoundingClientRect();
  popup.style.maxHeight = `${Math.max(160, seen.bottom - seen.top - 2 * EDGE)}px`;
  put(popup, seen, ({ width, height }) => ({
    left: box.left - width - 6,
    top: Math.max(seen.top + EDGE, Math.min(box.top - 40, seen.bottom - height - EDGE)),
  }));
}

function put(popup: HTMLElement, seen: Seen, where: (own: DOMRect) => { left: number; top: number }): void {
  popup.style.position = "fixed";
  // What stands fixed within a transformed element stands relative to it: measure, and move by what is wrong.
  popup.style.left = popup.style.top = "0px";
  const zero = popup.getBoundingClientRect();
  const { left, top } = where(zero);
  const most = seen.right - zero.width - 2 * EDGE;
  popup.style.left = `${Math.max(seen.left + EDGE, Math.min(left, most)) - zero.left}px`;
  popup.style.top = `${top - zero.top}px`;
}
