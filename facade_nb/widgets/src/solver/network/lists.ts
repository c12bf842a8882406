// What stands beside the network: the columns that leave the node that is looked at, and the question's choices.

import { h, keyed, mark, type Row, setText } from "../../shared/dom.ts";
import { formatNumber } from "../../shared/fields.ts";
import { type LetterNote, nameOf as letterName } from "../letters.ts";
import { linked, target } from "../links.ts";
import { rowsNamed } from "../weights.ts";
import { metres, type Numbers, type Standing, sum } from "./numbers.ts";
import type { Arc, Scene } from "./scene.ts";
import { restOf, type Subject } from "./story.ts";

const MOST = 40;

/** An edge that leaves a node, with what the search has told of it. */
export interface Leaving {
  arc: Arc;
  numbers: Numbers | null;
  standing: Standing;
}

/** What the words mean that edges and nodes are called by. */
export const MEANINGS: Record<Standing, string> = {
  permitted: "no constraint is against it",
  waiting: "permitted and weighed; it waits for its turn",
  expanded: "its turn has come: the edges of the node it leads to were made",
  pruned: "permitted, but not followed: its bound is too high, or another path has come to the same node for no more",
  forbidden: "a constraint is against it",
};
const RANK: Record<Standing, number> = { expanded: 0, waiting: 1, permitted: 2, pruned: 3, forbidden: 4 };

/** A column as it stands in the alignment: an element of each word, ε where it is empty. */
export function columnText(subject: Subject, column: readonly (readonly number[] | null)[], to: readonly number[]) {
  return h(
    "span",
    { class: "fnb-net-column" },
    ...column.map((letters, b) => {
      if (letters === null) return h("span", { class: "fnb-net-element" }, "∗");
      if (!letters.length) return h("span", { class: "fnb-net-element fnb-muted" }, "ε");
      const cut = ((to[b] ?? 0) & 1) === 1;
      const names = letters.map((n) => name(subject.bands[b]?.letters[n])).join("");
      const short = names.length > 9 ? `${names.slice(0, 8)}…` : names;
      return h("span", { class: "fnb-net-element", title: names }, short + (cut ? "…" : ""));
    }),
  );
}

const name = (letter: LetterNote | undefined): string => (letter ? letterName(letter) : "");

/** The columns that leave a node, those that may come next first. From step to step most of them stay. */
export class LeavingList {
  private readonly at = h("code");
  private readonly count = h("span", { class: "fnb-muted" });
  private readonly sums = h("p", { class: "fnb-net-sums" });
  private readonly list = h("ul");
  private readonly more = h("p", { class: "fnb-muted" });
  readonly el = h(
    "div",
    { class: "fnb-net-leaving" },
    h("h4", {}, "At ", this.at, this.count),
    this.sums,
    this.list,
    this.more,
  );
  private subject: Subject | null = null;
  private readonly rows = keyed<Leaving>(this.list, nameOf, (own) => this.row(own));

  show(subject: Subject, places: readonly number[], arcs: readonly Leaving[], node: Numbers | null): void {
    if (subject !== this.subject) this.rows([]); // another network's columns have the same names, but other letters
    this.subject = subject;
    const ranked = arcs.toSorted((a, b) => RANK[a.standing] - RANK[b.standing]);
    const permitted = ranked.filter(({ standing }) => standing !== "forbidden");
    const forbidden = ranked.filter(({ standing }) => standing === "forbidden");
    const shown = [...permitted.slice(0, MOST), ...forbidden.slice(0, MOST)];
    const rests = subject.bands.map((band, b) => restOf(band, places[b] ?? 0));
    setText(this.at, rests.map((rest) => (rest.length > 14 ? `${rest.slice(0, 13)}…` : rest)).join(" / "));
    const many = (standing: Standing) => arcs.filter((own) => own.standing === standing).length;
    const parts = (["expanded", "waiting", "pruned"] as const).flatMap((own) =>
      many(own) ? [`${many(own)} ${own}`] : [],
    );
    const among = parts.length ? ` (${parts.join(", ")})` : "";
    setText(
      this.count,
      ` ${permitted.length} edge${permitted.length === 1 ? "" : "s"} permitted${among}, ${forbidden.length} forbidden`,
    );
    setText(this.sums, node ? `g + h = f: ${sum(node)} m${node.standing === "waiting" ? ", waiting" : ""}` : "");
    setText(this.more, arcs.length > shown.length ? `… ${arcs.length - shown.length} more` : "");
    this.rows(shown);
  }

  private row({ arc, numbers, standing }: Leaving): Row<Leaving> {
    const subject = this.subject as Subject;
    const layers = subject.path?.layers ?? subject.layers ?? [];
    const el = h(
      "li",
      {
        class: "fnb-net-edge",
        tabindex: 0,
        "data-constraint": standing === "forbidden" ? arc.constraint : null,
        "data-standing": standing,
        ...linked([arc.key]),
      },
      columnText(subject, arc.column, arc.to),
      h("span", { class: "fnb-net-omega" }, arc.omega === null ? "" : `ω ${formatNumber(arc.omega, 2)}`),
      numbers &&
        h(
          "span",
          {
            class: "fnb-net-numbers",
            title: "g + h = f, metres: laid with it, still to come at least, at least in all",
          },
          numbers.f === null ? `g ${metres(numbers.g)}` : sum(numbers),
        ),
      (standing === "expanded" || standing === "waiting" || standing === "pruned") &&
        h("span", { class: "fnb-net-standing", title: MEANINGS[standing] }, standing),
      h(
        "span",
        { class: "fnb-net-why" },
        numbers?.why || (standing === "forbidden" ? `✕ ${rowsNamed(arc.text, layers)}` : arc.text),
      ),
    );
    return { el, update: ({ arc: { kind } }) => mark(el, "data-path", kind === "path") };
  }
}

const nameOf = ({ arc, numbers, standing }: Leaving): string =>
  [arc.key, arc.to.join(), arc.constraint, arc.text, arc.omega, standing, numbers?.g, numbers?.f, numbers?.why].join(
    "|",
  );

/** The letters of a network's words that some targets light, as band:number. */
export function litLetters(subject: Subject, keys: ReadonlySet<string>): Set<string> {
  const found = new Set<string>();
  if (!keys.size) return found;
  const layers = subject.path?.layers ?? subject.layers ?? [];
  for (const [b, band] of subject.bands.entries())
    for (const [n, letter] of band.letters.entries()) {
      const own = [
        target.symbol(letter.symbol),
        ...band.rows.map((row) => target.letter(subject.axis, layers[row] ?? "", n)),
      ];
      if (own.some((key) => keys.has(key))) found.add(`${b}:${n}`);
    }
  return found;
}

/** What the words mean, where they are first used. */
export function meanings(): HTMLElement {
  const words = Object.entries(MEANINGS).flatMap(([word, meaning]) => [h("dt", {}, word), h("dd", {}, meaning)]);
  const numbers = [
    h("dt", {}, "g + h = f"),
    h("dd", {}, "J of what is laid; what is still to come at least; what an alignment that goes on so costs at least"),
  ];
  return h(
    "details",
    { class: "fnb-net-meanings" },
    h("summary", {}, "What permitted, waiting, expanded, pruned, forbidden and g + h = f mean"),
    h("dl", {}, ...words, ...numbers),
  );
}

/** What a node is, in a line. */
export function nodeSentence(scene: Scene, places: readonly number[]): string {
  const rests = scene.subject.bands.map((band, b) => restOf(band, places[b] ?? 0)).join(" / ");
  const own = scene.nodes.get([places[scene.pair[0]] ?? 0, places[scene.pair[1]] ?? 0].join());
  const numbers = own?.numbers ? `: g + h = f, ${sum(own.numbers)} m, ${own.numbers.standing}` : "";
  return `${rests}${numbers}${own && own.taken > 1 ? ` (${own.taken} times)` : ""}`;
}

/** What an arc is, in a line. */
export function arcSentence(subject: Subject, arc: Arc): string {
  const names = columnText(subject, arc.column, arc.to).textContent ?? "";
  const omega = arc.omega === null ? "" : `, ω = ${formatNumber(arc.omega)} m`;
  return `${[...names].join(" ")}${omega}${arc.constraint ? `: ${arc.text}` : ""}`;
}
