// One picture turns into another that shows the same more finely: little by little, so that nothing is seen to pop.

import { h } from "../shared/dom.ts";

const LASTS = 260; // milliseconds

export interface Fading {
  /** Remember what is shown. */
  keep(): void;
  /** Turn from what was kept into what is shown now; `done` is called at the end, unless it is stopped. */
  begin(done: () => void): void;
  stop(): void;
}

export function fading(paper: CanvasRenderingContext2D | null): Fading {
  const [before, after] = [0, 1].map(() => h("canvas", {}).getContext("2d", { alpha: false }));
  let frame = 0;
  const copy = (to: CanvasRenderingContext2D | null | undefined) => {
    if (!to || !paper) return;
    Object.assign(to.canvas, { width: paper.canvas.width, height: paper.canvas.height });
    to.drawImage(paper.canvas, 0, 0);
  };
  const stop = () => {
    cancelAnimationFrame(frame);
    frame = 0;
  };
  return {
    keep: () => copy(before),
    begin(done) {
      stop();
      if (!paper || !before || !after) return done();
      copy(after);
      const began = performance.now();
      const step = () => {
        const share = Math.min(1, (performance.now() - began) / LASTS);
        paper.drawImage(after.canvas, 0, 0);
        paper.globalAlpha = 1 - share;
        if (share < 1) paper.drawImage(before.canvas, 0, 0);
        paper.globalAlpha = 1;
        if (share < 1) frame = requestAnimationFrame(step);
        else done();
      };
      step();
    },
    stop,
  };
}
