// Icons on a 16 by 16 grid, drawn with the text's colour.

import { svg } from "./dom.ts";

const PATHS = {
  undo: "M6 3 2.5 6.5 6 10M3 6.5h6.5a3.75 3.75 0 0 1 0 7.5H6",
  redo: "M10 3l3.5 3.5L10 10m3-3.5H6.5a3.75 3.75 0 0 0 0 7.5H10",
  open: "M2 12.5v-9h4l1.5 2H14v7zM2 6.5h12",
  save: "M8 2.5v7.5M4.8 7.2 8 10.4l3.2-3.2M2.5 10.5v3h11v-3",
  plus: "M8 3.5v9M3.5 8h9",
  close: "M4 4l8 8M12 4l-8 8",
  up: "M4 9.5 8 5.5l4 4",
  down: "M4 6.5l4 4 4-4",
  eye: "M1.5 8S4 3.8 8 3.8 14.5 8 14.5 8 12 12.2 8 12.2 1.5 8 1.5 8zM8 6.2a1.8 1.8 0 1 0 0 3.6 1.8 1.8 0 0 0 0-3.6z",
  hidden:
    "M2 2.5l12 11M6 4.2C6.6 4 7.3 3.8 8 3.8c4 0 6.5 4.2 6.5 4.2a12 12 0 0 1-2 2.4M4 5.5A11 11 0 0 0 1.5 8S4 12.2 8 12.2c1 0 1.900-.3 2.700-.6",
  grip: "M6 4v.01M10 4v.01M6 8v.01M10 8v.01M6 12v.01M10 12v.01",
  opaque: "M3 3h10v10H3zM3 8l5-5M3 13 13 3M8 13l5-5",
  attached:
    "M6.8 9.200 9.200 6.800M7.200 4.700l1.400-1.400a2.900 2.900 0 0 1 4.100 4.100l-1.400 1.400M8.800 11.300l-1.400 1.400a2.900 2.900 0 0 1-4.100-4.100l1.400-1.400",
  unoccludable: "M8 1.800 13 3.800v4c0 3.200-2.200 5.400-5 6.400-2.800-1-5-3.200-5-6.400v-4z",
  transparent: "M3 3h2M7 3h2M11 3h2v2M13 7v2M13 11v2h-2M9 13H7M5 13H3v-2M3 9V7M3 5V3",
  left: "M2.500 2.500v11M5 5.500h6v5H5z",
  center: "M8 2.500v3M8 10.500v3M4.500 5.500h7v5h-7z",
  play: "M5 3.200v9.600l7.500-4.800z",
  pause: "M5.500 3.500v9M10.500 3.500v9",
  back: "M10.500 3.500 6 8l4.500 4.500",
  forward: "M5.500 3.500 10 8l-4.500 4.500",
  stageBack: "M12 3.500 7.500 8l4.500 4.500M4.500 3.500v9",
  stageForward: "M4 3.500 8.500 8 4 12.500M11.500 3.500v9",
  link: "M6.800 9.200 9.200 6.800M7.200 4.700l1.400-1.400a2.900 2.900 0 0 1 4.100 4.100l-1.400 1.400M8.800 11.300l-1.400 1.400a2.900 2.900 0 0 1-4.100-4.100l1.400-1.400",
  code: "M5.500 4.500 2 8l3.500 3.500M10.500 4.500 14 8l-3.500 3.500M9.200 3 6.800 13",
  ask: "M5.800 6.200a2.200 2.200 0 1 1 3.300 1.900c-.700.400-1.100.900-1.100 1.700M8 12.500v.01",
  unplugged:
    "M2 14l2.500-2.500M14 2l-2.500 2.500M4 8.500l3.500 3.500-1.200 1.200a2.400 2.400 0 0 1-3.500-3.500zM12 7.500 8.500 4l1.200-1.200a2.400 2.400 0 0 1 3.500 3.500zM6.500 6.800 8 8.200",
  solo: "M8 2.500a5.500 5.500 0 1 0 0 11 5.500 5.500 0 0 0 0-11zM8 6.500a1.500 1.500 0 1 0 0 3 1.500 1.500 0 0 0 0-3z",
  copy: "M5.500 5.500h8v8h-8zM3 10.500h-.500v-8h8V3",
  reset: "M3.500 3v3.500H7M3.700 6.300A5 5 0 1 1 3.200 9",
  right: "M13.500 2.500v11M5 5.500h6v5H5z",
} as const;

export type IconName = keyof typeof PATHS;

export function icon(name: IconName): SVGSVGElement {
  return svg(
    "svg",
    { viewBox: "0 0 16 16", class: "fnb-icon", "aria-hidden": "true" },
    svg("path", { d: PATHS[name] }),
  );
}

export function setIcon(element: Element, name: IconName): void {
  const path = element.querySelector("path");
  if (path && path.getAttribute("d") !== PATHS[name]) path.setAttribute("d", PATHS[name]);
}
