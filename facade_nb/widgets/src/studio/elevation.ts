import { h, mark, setText, svg } from "../shared/dom.ts";
import { type Box, boxOf, type Drawing, neighbour, parseDrawing, shapeAt } from "../shared/drawing.ts";
import { formatNumber } from "../shared/fields.ts";
import type { MakePart } from "./common.ts";
import { edge } from "./edge.ts";
import { inspector } from "./inspector.ts";

const PADDING = 14;
const ARROWS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** The elevation, with picking and with edges that resize the canvas. */
export const elevation: MakePart = (context) => {
  const { store, signal } = context;
  const overlay = svg("svg", { class: "fnb-overlay", "aria-hidden": "true" });
  const hover = svg("rect", { class: "fnb-hover", visibility: "hidden" });
  const picks = svg("g");
  overlay.append(picks, hover);
  const sheet = h("div", { class: "fnb-sheet" }, overlay as unknown as HTMLElement);
  const tag = h("span", { class: "fnb-tag", hidden: true }, "Last good layout");
  const empty = h("p", { class: "fnb-empty fnb-stage-note", hidden: true });
  const stage = h(
    "div",
    { class: "fnb-paper", tabindex: 0, role: "group", "aria-label": "Elevation: arrow keys go from shape to shape" },
    sheet,
    tag,
    empty,
  );
  const el = h("div", { class: "fnb-elevation" }, stage, inspector(context));

  const ids = `fnb-${Math.random().toString(36).slice(2)}`;
  let drawing: Drawing | null = null;
  /** While an edge is dragged: how large a metre is and where the façade's corner stands, so that both stay. */
  let held: { metre: number; left: number; bottom: number } | null = null;
  let placed = { left: 0, top: 0, scale: 1 };

  const corner = () => ({
    metre: (drawing?.scale ?? 1) * placed.scale,
    left: placed.left + (drawing?.origin.x ?? 0) * placed.scale,
    bottom: placed.top + (drawing?.origin.y ?? 0) * placed.scale,
  });
  const place = () => {
    const [width, height] = [stage.clientWidth, stage.clientHeight];
    if (!drawing || !width || !height) return;
    if (held) {
      const scale = held.metre / drawing.scale;
      placed = { left: held.left - drawing.origin.x * scale, top: held.bottom - drawing.origin.y * scale, scale };
    } else {
      const scale = Math.min((width - 2 * PADDING) / drawing.width, (height - 2 * PADDING) / drawing.height);
      placed = { left: (width - drawing.width * scale) / 2, top: (height - drawing.height * scale) / 2, scale };
    }
    sheet.style.width = `${drawing.width * placed.scale}px`;
    sheet.style.height = `${drawing.height * placed.scale}px`;
    sheet.style.transform = `translate(${placed.left}px, ${placed.top}px)`;
    for (const handle of handles) handle.place(drawing, placed.scale);
  };

  const handles = (["width", "height"] as const).map((side) =>
    edge(context, side, {
      hold: () => {
        held = corner();
        return held.metre;
      },
      release: () => {
        held = null;
        mark(sheet, "data-settling", true);
        place();
        setTimeout(() => mark(sheet, "data-settling", false), 220);
      },
    }),
  );
  sheet.append(...handles.map((handle) => handle.el));

  const shapes = () => (drawing ? [...drawing.svg.querySelectorAll<SVGGElement>("[data-shape]")] : []);
  const showPicks = () => {
    const { shape, layer, x, y, more } = store.get("selection");
    const pairs = layer !== "" && x !== "" && y !== "" ? [[x, y], ...more] : [];
    const alike = (el: SVGGElement) =>
      pairs.length > 0
        ? el.dataset.layer === layer && pairs.some((pair) => el.dataset.x === pair[0] && el.dataset.y === pair[1])
        : (layer !== "" && el.dataset.layer === layer) ||
          (x !== "" && el.dataset.x === x) ||
          (y !== "" && el.dataset.y === y);
    picks.replaceChildren(
      ...shapes()
        .filter(alike)
        .map((el) => outline(boxOf(el), el.dataset.shape === String(shape) ? "fnb-pick" : "fnb-alike")),
    );
  };

  let shownText: string | null = null;
  store.watch(["svg"], () => {
    const text = store.get("svg");
    if (text === shownText) return;
    shownText = text;
    if (text) {
      // Two drawings on one page must not share ids: one of them may be hidden, and its patterns with it.
      const next = parseDrawing(text.replaceAll(store.prefix, ids));
      if (drawing) drawing.svg.replaceWith(next.svg);
      else sheet.prepend(next.svg);
      drawing = next;
      overlay.setAttribute("viewBox", `0 0 ${next.width} ${next.height}`);
    } else {
      drawing?.svg.remove();
      drawing = null;
    }
    hover.setAttribute("visibility", "hidden");
    sheet.hidden = !drawing;
    place();
    showPicks();
  });

  store.watch(["selection"], showPicks);

  store.watch(["status", "drafts"], () => {
    const { stale, message, busy, solved } = store.get("status");
    mark(stage, "data-stale", stale);
    tag.hidden = !stale;
    empty.hidden = store.get("svg") !== "";
    setText(empty, message || (busy ? "Solving…" : "Nothing to show yet."));
    if (solved)
      mark(stage, "aria-description", `${formatNumber(solved.width)} by ${formatNumber(solved.height)} metres`);
  });

  const pick = (element: Element | null) => {
    const shape = element?.getAttribute("data-shape");
    store.ask(shape === null || shape === undefined ? { op: "select" } : { op: "select", shape: Number(shape) });
  };
  sheet.addEventListener("click", (event) => {
    if (event.target instanceof Element && event.target.closest(".fnb-edge")) return;
    pick(shapeAt(event.target));
  });
  sheet.addEventListener("pointerover", (event) => {
    const shape = shapeAt(event.target);
    if (shape) setBox(hover, boxOf(shape));
    hover.setAttribute("visibility", shape ? "visible" : "hidden");
  });
  sheet.addEventListener("pointerleave", () => hover.setAttribute("visibility", "hidden"));
  stage.addEventListener("keydown", (event) => {
    const arrow = ARROWS[event.key];
    if (!arrow || event.target !== stage) return;
    event.preventDefault();
    const all = shapes();
    const { shape } = store.get("selection");
    const from = all.find((el) => el.dataset.shape === String(shape)) ?? null;
    const next = neighbour(all, from, arrow[0], arrow[1]);
    if (next) pick(next);
  });

  const observer = new ResizeObserver(place);
  observer.observe(stage);
  signal.addEventListener("abort", () => observer.disconnect());
  return el;
};

function outline(box: Box, className: string): SVGRectElement {
  return setBox(svg("rect", { class: className }), box);
}

function setBox(rect: SVGRectElement, box: Box): SVGRectElement {
  for (const [name, value] of Object.entries(box)) rect.setAttribute(name, String(value));
  return rect;
}
