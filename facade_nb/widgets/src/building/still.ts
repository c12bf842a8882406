// The last picture: kept with the widget, so that a saved notebook shows it, and while a new one is on its way.

import { h } from "../shared/dom.ts";
import type { Kernel } from "../shared/kernel.ts";
import { type Bytes, byteLength, bytesOf } from "../shared/packing.ts";
import type { WidgetModel } from "../shared/types.ts";

const WIDE = 720; // pixels across of it
const QUALITY = 0.82;
const PAUSE = 700; // milliseconds after which the picture at rest is kept
const MOST = 120_000; // bytes

export interface Kept {
  el: HTMLImageElement;
  readonly shown: boolean;
  show(): void;
  hide(): void;
  /** Keep what the canvas shows, if it stays. */
  keep(): void;
  end(): void;
}

export function keptPicture(canvas: HTMLCanvasElement, model: WidgetModel, kernel: Kernel): Kept {
  const el = h("img", {
    class: "fnb-building-still",
    alt: "The façade as a building, as it was seen last",
    hidden: true,
  });
  let address = "";
  let timer = 0;
  const show = () => {
    const bytes = model.get<Bytes | null>("still");
    if (!byteLength(bytes) || !bytes) return;
    URL.revokeObjectURL(address);
    address = URL.createObjectURL(new Blob([bytesOf(bytes)], { type: "image/jpeg" }));
    el.src = address;
    el.hidden = false;
  };
  const take = async () => {
    const width = Math.min(WIDE, canvas.width);
    const small = document.createElement("canvas");
    small.width = width;
    small.height = Math.max(1, Math.round((width * canvas.height) / canvas.width));
    const paper = small.getContext("2d");
    if (!paper) return;
    paper.imageSmoothingQuality = "high";
    paper.drawImage(canvas, 0, 0, small.width, small.height);
    const blob = await new Promise<Blob | null>((done) => small.toBlob(done, "image/jpeg", QUALITY));
    if (!blob || blob.size > MOST) return;
    model.set("still", new DataView(await blob.arrayBuffer()));
    kernel.save(model);
  };
  show();
  return {
    el,
    get shown() {
      return !el.hidden;
    },
    show,
    hide() {
      el.hidden = true;
    },
    keep() {
      clearTimeout(timer);
      timer = window.setTimeout(() => void take(), PAUSE);
    },
    end() {
      clearTimeout(timer);
      URL.revokeObjectURL(address);
    },
  };
}
