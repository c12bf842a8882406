// Links to a moment: `#facade-nb=x/words+12`, and `&design=…` where a page shows several designs.

const KEY = "facade-nb";

export interface Moment {
  moment: string;
  design: string;
}

/** The fragment that leads to a moment of a design. */
export function fragmentOf({ moment, design }: Moment): string {
  return `#${KEY}=${moment}&design=${encodeURIComponent(design)}`;
}

/** The moment that a link or an address leads to; undefined where it leads to none. */
export function momentIn(address: string): Moment | undefined {
  const fragment = address.split("#").at(-1) ?? "";
  if (!address.includes("#") || !fragment.startsWith(`${KEY}=`)) return undefined;
  const [moment = "", ...rest] = fragment.slice(KEY.length + 1).split("&");
  const design = rest.find((part) => part.startsWith("design="))?.slice(7) ?? "";
  try {
    return { moment: decodeURIComponent(moment), design: decodeURIComponent(design) };
  } catch {
    return undefined; // a stray % in an address that somebody typed
  }
}

/** Call back for a link to a moment that is clicked anywhere in the page, and for the page's own address. */
export function watchMoments(go: (moment: Moment) => boolean, signal: AbortSignal): void {
  const arrive = () => {
    const moment = momentIn(location.href);
    if (moment) go(moment);
  };
  window.addEventListener("hashchange", arrive, { signal });
  document.addEventListener(
    "click",
    (event) => {
      const link = event.target instanceof Element ? event.target.closest("a[href]") : null;
      const moment = link && momentIn(link.getAttribute("href") ?? "");
      // The notebook would look for a heading of that name.
      if (moment && go(moment)) {
        event.preventDefault();
        event.stopPropagation();
      }
    },
    { capture: true, signal },
  );
}
