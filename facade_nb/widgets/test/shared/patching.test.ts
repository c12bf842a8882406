import { expect, test } from "vitest";
import { parseDrawing, redraw } from "../../src/shared/drawing.ts";

const ROOT = (width: number, name = "Shop") =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="9" aria-label="${name}" data-scale="2" data-origin="1 8">`;
const shape = (n: number, layer: string, number: string, x: number, said = "wall") =>
  `<g data-shape="${n}" data-layer="${layer}" data-x="A" data-y="P" data-number="${number}"><title>${said}</title>` +
  `<rect class="cell" x="${x}" y="1" width="2" height="3" fill="none"/><use href="#p-${n % 2}" x="${x}" y="1"/></g>`;
const text = (...pieces: string[]) => pieces.join("\n");

test("a drawing follows its text: what stays keeps its element, and the page shows what the text says", () => {
  const texts = [
    text(
      ...[ROOT(20), "<defs>", '<g id="p-0"><path d="M0 0"/></g>', "</defs>"],
      ...["<g>", shape(0, "walls", "1 1", 1), shape(1, "walls", "2 1", 3), '<path class="shadow" d="M1 1"/>', "</g>"],
      ...["<g>", shape(2, "shop", "1 1", 4), "</g>", '<path d="M0 8"/>', "</svg>"],
    ),
    // sizes alone; another name, with what XML has to escape
    text(
      ...[ROOT(21.5, "A &amp; &quot;B&quot;"), "<defs>", '<g id="p-0"><path d="M0 1"/></g>', "</defs>"],
      ...["<g>", shape(0, "walls", "1 1", 1), shape(1, "walls", "2 1", 3.5), '<path class="shadow" d="M1 2"/>', "</g>"],
      ...["<g>", shape(2, "shop", "1 1", 4.5), "</g>", '<path d="M0 8.5"/>', "</svg>"],
    ),
    // a layer comes in between, a shape goes, a definition comes, a shape says something else, and there is no shadow
    text(
      ...[ROOT(21.5), "<defs>", '<g id="p-1"><path d="M2 2"/></g>', '<g id="p-0"><path d="M0 1"/></g>', "</defs>"],
      ...["<g>", shape(0, "walls", "1 1", 1, "a &lt;door&gt;"), "</g>"],
      ...["<g>", shape(1, "sills", "1 1", 2), shape(2, "sills", "2 1", 3), "</g>"],
      ...["<g>", shape(3, "shop", "1 1", 4.5), "</g>", '<path d="M0 8.5"/>', "</svg>"],
    ),
    // all in another order
    text(
      ...[ROOT(21.5), "<defs>", '<g id="p-0"><path d="M0 1"/></g>', '<g id="p-1"><path d="M2 2"/></g>', "</defs>"],
      ...["<g>", shape(0, "shop", "1 1", 4.5), "</g>"],
      ...["<g>", shape(1, "walls", "2 1", 3), shape(2, "walls", "1 1", 1), "</g>", '<path d="M0 8.5"/>', "</svg>"],
    ),
  ];
  const live = redraw(null, texts[0] as string);
  const { svg } = live;
  const shop = svg.querySelector('[data-layer="shop"]');
  for (const own of [...texts, texts[1] as string, texts[0] as string]) {
    const drawn = redraw(live, own);
    expect(drawn.svg).toBe(svg);
    const anew = parseDrawing(own.replaceAll("\n", ""));
    expect(svg.outerHTML).toBe(anew.svg.outerHTML);
    expect([drawn.width, drawn.origin]).toEqual([anew.width, anew.origin]);
  }
  expect(shop).toBe(svg.querySelector('[data-layer="shop"]'));
});

test("a text that is not in pieces is drawn anew", () => {
  const whole = `${ROOT(20)}<g>${shape(0, "walls", "1 1", 1)}</g></svg>`;
  const live = redraw(null, whole);
  expect(redraw(live, whole).svg).not.toBe(live.svg);
});
