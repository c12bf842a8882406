import { focused, h, mark } from "../shared/dom.ts";
import type { Field } from "../shared/fields.ts";
import type { ParameterState } from "../shared/types.ts";

/** What a geometry begins with that is a mesh file, and how that choice is called. */
const FILE = "file:";
const FROM_FILE = "mesh file…";

const FITS: ParameterState[] = [
  ["file", "name of a mesh: .glb, .gltf, .obj, .off, .ply or .stl"],
  ["fit", "fill the cell, or keep the mesh's proportions", "fill", "keep"],
];

interface Call {
  name: string;
  told: Record<string, string>;
}

/** Name and parameters of `name(key=value, …)`, or of `file:NAME(fit=keep)`. */
export function readCall(text: string): Call {
  if (text.startsWith(FILE)) {
    const [, file = "", fit] = /^(.*?)(?:\(\s*fit\s*=\s*(\w*)\s*\)\s*)?$/su.exec(text.slice(FILE.length)) ?? [];
    return { name: FILE, told: { ...(file.trim() && { file: file.trim() }), ...(fit && { fit }) } };
  }
  const [, name = text, inside = ""] = /^\s*([^()=,]*?)\s*(?:\((.*)\)\s*)?$/su.exec(text) ?? [];
  const told: Record<string, string> = {};
  for (const piece of inside.split(",")) {
    const at = piece.indexOf("=");
    if (at > 0) told[piece.slice(0, at).trim()] = piece.slice(at + 1).trim();
  }
  return { name, told };
}

/** The text of a name with parameters; what is empty is left to the geometry. */
export function writeCall({ name, told }: Call): string {
  if (name === FILE) {
    const fit = told.fit && told.fit !== "fill" ? `(fit=${told.fit})` : "";
    return `${FILE}${told.file ?? ""}${fit}`;
  }
  const pieces = Object.entries(told).filter(([, value]) => value !== "");
  return pieces.length === 0 ? name : `${name}(${pieces.map(([key, value]) => `${key}=${value}`).join(", ")})`;
}

interface Options {
  label: string;
  value: () => string;
  names: () => string[];
  parameters: (name: string) => ParameterState[];
  set: (to: string) => void;
}

/** A geometry to choose, with a field for each of its parameters; an empty one is left to the geometry. */
export function geometryField({ label, value, names, parameters, set }: Options): Field {
  const select = h("select", { class: "fnb-select", "aria-label": label });
  const box = h("div", { class: "fnb-parameters" });
  let fields: { key: string; input: HTMLInputElement | HTMLSelectElement }[] = [];
  let shown = "";
  select.addEventListener("change", () => set(select.value));

  const build = (name: string) => {
    fields = (name === FILE ? FITS : parameters(name)).map(([own, hint, ...words]) => {
      const labels = { class: "fnb-parameter", "aria-label": `${own}, ${label}` };
      const input = words.length
        ? h("select", labels, ...["", ...words].map((word) => h("option", { value: word }, word || "auto")))
        : h("input", { ...labels, type: "text", placeholder: "auto", spellcheck: "false", autocomplete: "off" });
      mark(input, "title", hint);
      input.addEventListener("change", () => {
        const call = readCall(value());
        set(writeCall({ name: call.name, told: { ...call.told, [own]: input.value.trim() } }));
      });
      return { key: own, input };
    });
    box.replaceChildren(...fields.map(({ key, input }) => h("label", {}, h("span", {}, key), input)));
    box.hidden = fields.length === 0;
  };

  return {
    el: h("div", { class: "fnb-geometry" }, select, box),
    update() {
      const { name, told } = readCall(value());
      const known = names();
      const all = name === FILE || known.includes(name) ? known : [name, ...known];
      const key = JSON.stringify(all);
      if (select.dataset.key !== key) {
        select.dataset.key = key;
        select.replaceChildren(
          ...all.map((own) => h("option", { value: own }, own)),
          h("option", { value: FILE }, FROM_FILE),
        );
      }
      select.value = name;
      const kind = JSON.stringify([name, parameters(name).map(([own]) => own)]);
      if (kind !== shown) build(name);
      shown = kind;
      for (const { key: own, input } of fields) if (focused(input) !== input) input.value = told[own] ?? "";
    },
  };
}
