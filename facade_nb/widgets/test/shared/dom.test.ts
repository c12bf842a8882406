import { describe, expect, it } from "vitest";
import { h, keyed } from "../../src/shared/dom.ts";
import { boxOf, neighbour, parseDrawing } from "../../src/shared/drawing.ts";
import { faultLine } from "../../src/shared/fields.ts";
import { themeOf } from "../../src/shared/theme.ts";

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="140" height="80" data-scale="20" data-origin="10 70">
  <g data-shape="0"><rect class="cell" x="10" y="40" width="60" height="30"/></g>
  <g data-shape="1"><rect class="cell" x="70" y="40" width="60" height="30"/></g>
  <g data-shape="2"><rect class="cell" x="10" y="10" width="60" height="30"/></g>
</svg>`;

describe("elements", () => {
  it("take text as text", () => {
    const el = h("p", { title: '"><img src=x>' }, "<img src=x>");
    expect(el.children).toHaveLength(0);
    expect(el.textContent).toBe("<img src=x>");
    expect(faultLine({ place: "x", message: "<b>", line: null, column: null, excerpt: "" }).innerHTML).not.toContain(
      "<b>",
    );
  });

  it("that take keys keep them from the notebook", () => {
    for (const el of [h("button"), h("input"), h("select"), h("textarea"), h("div", { tabindex: 0 })])
      expect(el.getAttribute("data-lm-suppress-shortcuts")).toBe("true");
    expect(h("div").hasAttribute("data-lm-suppress-shortcuts")).toBe(false);
  });
});

describe("keyed rows", () => {
  const list = h("div");
  document.body.append(list);
  const show = keyed<string>(
    list,
    (item) => item,
    (item) => ({ el: h("div", { tabindex: 0 }, item), update() {} }),
  );
  const shown = () => [...list.children].map((child) => child.textContent).join("");

  it("follow the items and keep their elements and the focus", () => {
    show(["a", "b", "c"]);
    const b = list.children[1] as HTMLElement;
    b.focus();
    show(["c", "b", "d", "a"]);
    expect(shown()).toBe("cbda");
    expect(list.children[1]).toBe(b);
    expect(document.activeElement).toBe(b);
    show(["b"]);
    expect(shown()).toBe("b");
    show([]);
    expect(shown()).toBe("");
  });
});

describe("the drawing", () => {
  const drawing = parseDrawing(SVG);
  const shapes = [...drawing.svg.querySelectorAll("[data-shape]")];

  it("is measured", () => {
    expect(drawing).toMatchObject({ width: 140, height: 80, scale: 20, origin: { x: 10, y: 70 } });
    expect(boxOf(shapes[1] as Element)).toEqual({ x: 70, y: 40, width: 60, height: 30 });
  });

  it("is refused where it is not what we draw", () => {
    expect(() => parseDrawing("<p>no</p>")).toThrow("readable");
    expect(() => parseDrawing("<svg")).toThrow("readable");
  });

  it("has neighbours", () => {
    const at = (i: number) => shapes[i] as Element;
    expect(neighbour(shapes, null, 1, 0)).toBe(at(0));
    expect(neighbour(shapes, at(0), 1, 0)).toBe(at(1));
    expect(neighbour(shapes, at(0), 0, -1)).toBe(at(2));
    expect(neighbour(shapes, at(0), 0, 1)).toBeNull();
  });
});

describe("the theme", () => {
  it("is what JupyterLab says, else what the background looks like", () => {
    const inner = h("div");
    const outer = h("div", { style: "background-color: rgb(20, 20, 20)" }, inner);
    document.body.append(outer);
    expect(themeOf(inner)).toBe("dark");
    outer.setAttribute("data-jp-theme-light", "true");
    expect(themeOf(inner)).toBe("light");
  });
});
