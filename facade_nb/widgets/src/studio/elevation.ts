import { h, mark, setText, svg } from "../shared/dom.ts";
import { type Box, boxOf, type LiveDrawing, neighbour, redraw, shapeAt } from "../shared/drawing.ts";
import { button, formatNumber } from "../shared/fields.ts";
import { type MakePart, resolveIn, tint } from "./common.ts";
import { edge } from "./edge.ts";
import { invitation } from "./invitation.ts";
import { belongs, type Pointed, watchLinks } from "./links.ts";
import {
  dimensionsOf,
  gridOf,
  groupsOf,
  legendOf,
  lettersOf,
  NEEDS_MARKS,
  rectOf,
  type Sheet,
  transparentOf,
  VIEWS,
  type ViewOption,
} from "./marks.ts";
import { naiveView } from "./naive.ts";
import { bandsOf } from "./places.ts";
import { popover } from "./popover.ts";
import { fullScreen } from "./screen.ts";
import { type Camera, clear, fitted, navigate } from "./viewport.ts";

/** Pixels that chains of dimensions take at the left, and what stands over the foot: the groups' names, the slider. */
const CHAINS = 30;
const LEGEND = 22;
const SLIDER = 44;
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
  const picks = svg("g", { class: "fnb-outlines" });
  const lit = svg("g", { class: "fnb-outlines" });
  const under = svg("g");
  const over = svg("g", { class: "fnb-marks" });
  const naive = naiveView(() => {
    ask("naive", naive.on);
    place();
  });
  overlay.append(under, picks, lit, hover, over, naive.flaws);
  const sheet = h("div", { class: "fnb-sheet" }, overlay as unknown as HTMLElement);
  const tag = h("span", { class: "fnb-tag", hidden: true }, "Last good layout");
  const empty = h("p", { class: "fnb-empty fnb-stage-note", hidden: true });
  const tools = h("div", {
    class: "fnb-stage-tools",
    role: "toolbar",
    "aria-label": "View of the façade",
    "data-local": true,
    "data-beside": true,
  });
  const legend = h("div", { class: "fnb-mark-legend", role: "note", "aria-label": "Groups", hidden: true });
  const stage = h(
    "div",
    { class: "fnb-paper", tabindex: 0, role: "group", "aria-label": "Elevation: arrow keys go from shape to shape" },
    sheet,
    tag,
    tools,
    legend,
    naive.el,
    empty,
    invitation(context),
  );
  mark(naive.el, "data-local", true);
  mark(naive.el, "data-beside", true);
  const el = h("div", { class: "fnb-elevation" }, stage);

  const ids = `fnb-${Math.random().toString(36).slice(2)}`;
  let drawing: LiveDrawing | null = null;
  /** As it was zoomed and moved; null: fitted to the stage. */
  let free: Camera | null = null;
  const on = new Set<ViewOption>(["holes", "survey"]);
  const wanted = new Set<string>();
  const ask = (what: string, want: boolean) => {
    if (want === wanted.has(what)) return;
    if (want) wanted.add(what);
    else wanted.delete(what);
    store.ask({ op: "want", what, on: want });
  };
  /** While an edge is dragged: how large a metre is and where the façade's corner stands, so that both stay. */
  let held: Camera | null = null;
  /** How large the drawing was made when it was last made sharp. */
  let sharp = 1;

  const extra = () => {
    const named = on.has("groups") || on.has("grid");
    return {
      side: on.has("dimensions") ? CHAINS : 0,
      foot: naive.on ? Math.max(SLIDER, naive.el.offsetHeight + 16) : named ? LEGEND : 0,
    };
  };
  /** How large the stage is. It is looked up when it has changed: to ask it after each change would lay out the page. */
  let room = { width: 0, height: 0 };
  const camera = (): Camera | null => {
    if (!drawing || !room.width || !room.height) return null;
    if (free) return free;
    return held ? clear(held, room, drawing) : fitted(room, drawing, extra());
  };
  /** Show the drawing where the camera says; rough: only moved and stretched, so that no frame is missed. */
  const place = (rough = false) => {
    const at = camera();
    if (!drawing || !at) return;
    const scale = at.metre / drawing.scale;
    const [left, top] = [at.left - drawing.origin.x * scale, at.bottom - drawing.origin.y * scale];
    if (!rough) {
      sharp = scale;
      sheet.style.width = `${drawing.width * scale}px`;
      sheet.style.height = `${drawing.height * scale}px`;
      for (const handle of handles) handle.place(drawing, scale);
      showMarks();
    }
    const stretched = scale === sharp ? "" : ` scale(${scale / sharp})`;
    sheet.style.transform = `translate(${left}px, ${top}px)${stretched}`;
    mark(stage, "data-free", free !== null);
  };
  const settle = (then: () => void) => {
    mark(sheet, "data-settling", true);
    then();
    setTimeout(() => mark(sheet, "data-settling", false), 220);
  };
  const fit = () =>
    settle(() => {
      free = null;
      place();
    });

  const handles = (["width", "height"] as const).map((side) =>
    edge(context, side, {
      hold: () => {
        held = camera();
        return held?.metre ?? 1;
      },
      release: () => {
        held = null;
        settle(place);
      },
    }),
  );
  sheet.append(...handles.map((handle) => handle.el));

  const sheetOf = (): Sheet | null => {
    const { solved } = store.get("status");
    return drawing && solved ? { drawing, canvas: solved, scale: sharp } : null;
  };
  /** Draw what is switched on over the façade. Letters keep their size on the screen, so a zoom draws them anew. */
  const showMarks = () => {
    const own = sheetOf();
    const marks = store.get("marks");
    const { layers, groups } = store.get("design");
    const show = (option: ViewOption, draw: (sheet: Sheet) => SVGElement[]) => (own && on.has(option) ? draw(own) : []);
    under.replaceChildren(...show("groups", () => groupsOf(shapes(), layers, groups)));
    over.replaceChildren(
      ...show("grid", (sheet) => gridOf(sheet, marks, groups)),
      ...show("transparent", (sheet) => transparentOf(sheet, marks)),
      ...show("letters", (sheet) => lettersOf(sheet, shapes(), (symbol) => tint(store, symbol))),
      ...show("dimensions", (sheet) => dimensionsOf(sheet, marks)),
      ...show("survey", surveyed),
    );
    mark(stage, "data-holes", String(on.has("holes")));
    const used = groups.filter((group) => layers.some(({ x, y }) => x.group === group || y.group === group));
    legend.replaceChildren(...(on.has("groups") || on.has("grid") ? legendOf(groups, used) : []));
    legend.hidden = legend.childElementCount === 0;
    naive.show(own, store.get("naive"));
  };
  const surveyed = (sheet: Sheet) =>
    (store.get("survey").openings ?? []).map((rect) => {
      const opening = rectOf(sheet, rect);
      opening.setAttribute("class", "fnb-mark-survey");
      return opening;
    });

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
    const some = layer !== "" || x !== "" || y !== "";
    picks.replaceChildren(
      ...(some ? shapes() : [])
        .filter(alike)
        .map((el) => outline(boxOf(el), el.dataset.shape === String(shape) ? "fnb-pick" : "fnb-alike")),
    );
  };

  let shownText: string | null = null;
  const show = () => {
    const text = store.get("svg");
    if (text === shownText) return;
    shownText = text;
    if (text) {
      // Two drawings on one page must not share ids: one of them may be hidden, and its patterns with it.
      const next = redraw(drawing, text.replaceAll(store.prefix, ids));
      if (!drawing) sheet.prepend(next.svg);
      else if (drawing.svg !== next.svg) drawing.svg.replaceWith(next.svg);
      drawing = next;
      mark(overlay, "viewBox", `0 0 ${next.width} ${next.height}`);
    } else {
      drawing?.svg.remove();
      drawing = null;
    }
    hover.setAttribute("visibility", "hidden");
    sheet.hidden = !drawing;
    place();
    showPicks();
  };
  store.watch(["svg"], show, "first");

  store.watch(["selection"], showPicks, "first");

  const say = () => {
    const { stale, message, busy, solved } = store.get("status");
    mark(stage, "data-stale", stale);
    tag.hidden = !stale;
    empty.hidden = store.get("svg") !== "";
    setText(empty, message || (busy ? "Solving…" : "Nothing to show yet."));
    if (solved)
      mark(stage, "aria-description", `${formatNumber(solved.width)} by ${formatNumber(solved.height)} metres`);
  };
  store.watch(["status", "drafts"], say, "first");

  const pick = (element: Element | null) => {
    const shape = element?.getAttribute("data-shape");
    store.ask(shape === null || shape === undefined ? { op: "select" } : { op: "select", shape: Number(shape) });
  };
  // Beside the façade, too: there nothing is picked.
  stage.addEventListener("click", (event) => {
    if (event.target instanceof Element && event.target.closest(".fnb-edge, [data-beside]")) return;
    pick(shapeAt(event.target));
  });
  const { zoom } = navigate(stage, signal, {
    camera,
    move: (to, rough) => {
      free = to;
      place(rough);
    },
    fit,
    taken: (target) => shapeAt(target) !== null,
  });
  const switches = (Object.keys(VIEWS) as ViewOption[]).map((option) => {
    const box = h("input", { type: "checkbox", checked: on.has(option), "data-option": option });
    box.addEventListener("change", () => {
      if (box.checked) on.add(option);
      else on.delete(option);
      ask(
        "marks",
        NEEDS_MARKS.some((each) => on.has(each)),
      );
      place();
    });
    const row = h("label", { class: "fnb-switch" }, box, VIEWS[option]);
    if (option === "survey")
      store.watch(["survey"], () => {
        const { building, score } = store.get("survey");
        row.hidden = !building;
        mark(row, "title", `Openings of building ${building}: mean intersection over union ${score}`);
      });
    return row;
  });
  const compared = h("input", { type: "checkbox", "data-option": "naive" });
  compared.addEventListener("change", () => naive.turn(compared.checked));
  switches.push(h("label", { class: "fnb-switch fnb-switch-apart" }, compared, "Words side by side"));
  const views = popover("What is shown", "tune", h("div", { class: "fnb-switches" }, ...switches), signal, {
    local: true,
  });
  tools.append(
    views.el,
    button("Zoom out (−)", "minus", () => settle(() => zoom(0.8))),
    button("Zoom in (+)", "plus", () => settle(() => zoom(1.25))),
    button("Fit the façade into the view (0)", "fit", fit),
    fullScreen(context),
  );
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

  const resolve = resolveIn(store);
  /** Where the letters of a place of a text stand, whether they draw something or not. */
  const bands = (pointed: Pointed) => {
    const own = sheetOf();
    if (!own || pointed.layer || pointed.places.length === 0) return [];
    const { width, height } = own.canvas;
    return bandsOf(store, pointed.places).map(({ axis, start, end }) => {
      const band = rectOf(own, axis === "x" ? [start, 0, end, height] : [0, start, width, end]);
      band.setAttribute("class", "fnb-lit-band");
      return band;
    });
  };
  watchLinks(
    store.prefix,
    (pointed, from) => {
      const here = from !== null && sheet.contains(from);
      const marked = here ? [] : shapes().filter((el) => belongs(el.dataset, pointed, resolve));
      lit.replaceChildren(...(here ? [] : bands(pointed)), ...marked.map((el) => outline(boxOf(el), "fnb-lit")));
    },
    signal,
  );
  store.watch(["marks", "naive", "survey"], showMarks, "first");
  // Groups and letters have their colours from the design, which is told after the picture.
  store.watch(["design"], showMarks);

  const observer = new ResizeObserver(() => {
    room = { width: stage.clientWidth, height: stage.clientHeight };
    place();
  });
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
