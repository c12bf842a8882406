// What is drawn in a frame, in one go: first all that changes the page, then all that asks where things stand or scrolls
// them. So the browser lays the page out once a frame, however many views there are.

const drawing = new Set<() => void>();
const settling = new Set<() => void>();
let due = false;
let running = false;

/** Draw in the next frame; asked for several times, it is done once. */
export function inFrame(draw: () => void): void {
  drawing.add(draw);
  ask();
}

/** What reads or scrolls the page: after all that is drawn in this frame, or in the next where none is being drawn. */
export function afterDrawing(settle: () => void): void {
  settling.add(settle);
  if (!running) ask();
}

/** Do not draw after all. */
export function cancelFrame(callback: () => void): void {
  drawing.delete(callback);
  settling.delete(callback);
}

function ask(): void {
  if (due) return;
  due = true;
  requestAnimationFrame(run);
}

function run(): void {
  due = false;
  running = true;
  try {
    drain(drawing);
    drain(settling);
  } finally {
    running = false;
    if (drawing.size || settling.size) ask();
  }
}

/** One that fails must not keep the others from being drawn. */
function drain(callbacks: Set<() => void>): void {
  const all = [...callbacks];
  callbacks.clear();
  for (const callback of all) {
    try {
      callback();
    } catch (error) {
      reportError(error);
    }
  }
}
