// The row that is looked at is in sight, whenever its list gets its size.

/**
 * What scrolls a list, and nothing around it, until a row of it is seen; where it is seen already, it stays. A list that is
 * not on the page yet, or has no style yet, has nowhere to scroll to: the row is looked for again when the list or the row
 * changes size. `head` is how many pixels at the top of the list something stands over it.
 */
export function revealer(
  list: HTMLElement,
  signal: AbortSignal,
  head: () => number = () => 0,
): (row: Element | null | undefined) => void {
  let row: Element | null = null;
  const look = () => {
    if (!row?.isConnected) return;
    const [outer, inner, above] = [list.getBoundingClientRect(), row.getBoundingClientRect(), head()];
    const end = outer.top + list.clientHeight;
    if (inner.top < outer.top + above) list.scrollTop += inner.top - outer.top - above;
    else if (inner.bottom > end) list.scrollTop += inner.bottom - end;
  };
  const sizes = new ResizeObserver(look);
  sizes.observe(list);
  signal.addEventListener("abort", () => sizes.disconnect(), { once: true });
  return (next) => {
    if (row && row !== next) sizes.unobserve(row);
    if (next && row !== next) sizes.observe(next);
    row = next ?? null;
    look();
  };
}
