// The player, the links, the session: what all views stand on.

import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { h } from "../../src/shared/dom.ts";
import { unpack } from "../../src/shared/packing.ts";
import { Quiz } from "../../src/shared/quiz.ts";
import { Asking } from "../../src/solver/asking.ts";
import { Links, linked, target } from "../../src/solver/links.ts";
import { fragmentOf, momentIn } from "../../src/solver/moments.ts";
import { playbar, Scale } from "../../src/solver/playbar.ts";
import { Player } from "../../src/solver/player.ts";
import { Session } from "../../src/solver/session.ts";
import { Timeline, type TimelineData } from "../../src/solver/timeline.ts";
import { FakeModel } from "../shared/fake.ts";
import { eventually } from "../shared/waiting.ts";
import { DESIGNS, pieceOf } from "./fixtures.ts";

const timelineOf = async (design: string): Promise<Timeline> =>
  new Timeline(await unpack<TimelineData>(pieceOf(design, "timeline")));

describe("a timeline", () => {
  it.each(DESIGNS)("finds every moment again: %s", async (design) => {
    const timeline = await timelineOf(design);
    for (let at = 0; at < timeline.count; at += 3) expect(timeline.locate(timeline.momentOf(at))).toBe(at);
    const words = timeline.data.stages.find((stage) => stage.axis === "x" && stage.stage === "words");
    expect(timeline.locate("x/words+999999")).toBe(words?.last);
    expect(timeline.locate("nonsense")).toBeUndefined();
  });

  it.each(DESIGNS)("has a place on the track for every position, in order: %s", async (design) => {
    const { data, count } = await timelineOf(design);
    const scale = new Scale(data.stages);
    let before = -1;
    for (let at = 0; at < count; at++) {
      const place = scale.place(at);
      expect(place).toBeGreaterThan(before);
      expect(scale.position(place)).toBe(at);
      before = place;
    }
    expect(before).toBeLessThan(1);
    expect(scale.position(0)).toBe(0);
  });
});

describe("the player", () => {
  let player: Player;
  let seen: number[];
  beforeEach(async () => {
    vi.useFakeTimers({ toFake: ["requestAnimationFrame", "cancelAnimationFrame", "performance"] });
    player = new Player(await timelineOf("residential-house"), 0);
    seen = [];
    player.watch(() => seen.push(player.position), new AbortController().signal);
  });
  afterEach(() => vi.useRealTimers());

  it("plays at its speed, event by event, and stops at the end", () => {
    player.setSpeed(64);
    player.play();
    expect(player.playing).toBe(true);
    vi.advanceTimersByTime(1000);
    expect(player.position).toBeGreaterThan(60);
    expect(player.position).toBeLessThan(68);
    vi.advanceTimersByTime(20_000);
    expect(player.position).toBe(player.timeline.last);
    expect(player.playing).toBe(false);
    expect(seen).toEqual([...seen].sort((a, b) => a - b));
  });

  it("goes on from where it is when the speed changes, and pauses at a step", () => {
    player.setSpeed(4);
    player.play();
    vi.advanceTimersByTime(2000);
    const at = player.position;
    player.setSpeed(256);
    vi.advanceTimersByTime(16);
    expect(player.position - at).toBeLessThan(10);
    player.step(-1);
    expect(player.playing).toBe(false);
  });

  it("begins again when it is played at the end", () => {
    player.go(player.timeline.last);
    player.play();
    expect(player.position).toBe(0);
  });

  it("keeps within the trace, and goes from stage to stage", () => {
    player.step(-1);
    expect(player.position).toBe(0);
    player.go(1e9);
    expect(player.position).toBe(player.timeline.last);
    const firsts = player.timeline.data.stages.map((stage) => stage.first);
    player.go(0);
    for (const first of firsts.slice(1)) {
      player.stage(1);
      expect(player.position).toBe(first);
    }
    player.step(2);
    player.stage(-1);
    expect(player.position).toBe(firsts.at(-1));
    player.stage(-1);
    expect(player.position).toBe(firsts.at(-2));
  });
});

describe("the bar of the player", () => {
  it("has a button for each stage, a mark for each event that matters, and says what is played", async () => {
    const timeline = await timelineOf("apartment-house");
    const player = new Player(timeline, 0);
    const end = new AbortController();
    const asking = new Asking();
    const session = {
      piece: (name: string) => unpack(pieceOf("apartment-house", name)),
      lessons: [],
      lesson: "",
      about: "",
    } as unknown as Session;
    const bar = playbar(session, player, asking, end.signal);
    expect(bar.querySelectorAll(".fnb-play-stage")).toHaveLength(timeline.data.stages.length);
    expect(bar.querySelectorAll(".fnb-play-mark")).toHaveLength(timeline.data.marks.length);
    const caption = bar.querySelector(".fnb-play-caption");
    await eventually(() => expect(caption?.textContent).toBe("solve was asked for Apartment house."));
    player.step(1);
    expect(caption?.textContent).toMatch(/^Horizontally, 21 m to fill/);
    // While a view asks, it says nothing, and marks nothing from where the answer is told.
    const marks = () => bar.querySelectorAll<HTMLElement>(".fnb-play-mark:not([hidden])").length;
    const from = timeline.data.marks[2]?.at ?? 0;
    asking.set(bar, from);
    expect([caption?.textContent, caption?.getAttribute("title")]).toEqual(["", null]);
    expect(marks()).toBe(2);
    asking.set(bar, null);
    expect(caption?.textContent).toMatch(/^Horizontally/);
    expect(marks()).toBe(timeline.data.marks.length);
    // A link is said to be copied where it was.
    const told: string[] = [];
    const kept = (writeText?: (text: string) => Promise<void>) =>
      vi.stubGlobal("navigator", { clipboard: writeText && { writeText } });
    const said = (expected: string) => {
      bar.querySelector<HTMLElement>("[aria-label='Copy a link to this moment']")?.click();
      return eventually(() => expect(bar.querySelector(".fnb-play-count")?.textContent).toBe(expected));
    };
    kept(async (text) => void told.push(text));
    await said("Link copied");
    expect(told[0]).toMatch(/#.+/);
    for (const refused of [() => Promise.reject(new DOMException("denied", "NotAllowedError")), undefined]) {
      kept(refused);
      player.step(1);
      player.step(-1);
      await said("The browser does not let the link be copied");
    }
    vi.unstubAllGlobals();
    const track = bar.querySelector(".fnb-play-track");
    expect(track?.getAttribute("aria-valuenow")).toBe("1");
    track?.dispatchEvent(new KeyboardEvent("keydown", { key: "End" }));
    expect(player.atEnd).toBe(true);
    end.abort();
    player.go(0);
    expect(track?.getAttribute("aria-valuenow")).toBe(String(timeline.last));
  });
});

describe("steps", () => {
  it("go to events, nodes, passes and improvements, and nowhere where there is none", async () => {
    const timeline = await timelineOf("lesson-deepening");
    const player = new Player(timeline, 0);
    const visited = (unit: "node" | "pass" | "improvement") => {
      player.go(0);
      player.setUnit(unit);
      const kinds: string[] = [];
      while (player.canStep(1)) {
        player.step(1);
        kinds.push(timeline.kindAt(player.position));
      }
      const last = player.position;
      player.step(1);
      expect(player.position).toBe(last);
      const back: string[] = [];
      while (player.canStep(-1)) {
        player.step(-1);
        back.push(timeline.kindAt(player.position));
      }
      expect(back).toEqual(kinds.slice(0, -1).reverse());
      return kinds;
    };
    const count = (kind: string) =>
      Array.from(timeline.data.kind).filter((own) => timeline.data.kinds[own] === kind).length;
    expect(visited("node")).toEqual(Array(count("NodeTaken")).fill("NodeTaken"));
    expect(visited("pass")).toEqual(Array(count("LimitRaised")).fill("LimitRaised"));
    expect(visited("improvement")).toEqual(["WaysMet", "WaysMet", "WaysMet"]); // at 1.8 and 1.55 m; and upwards
  });
});

describe("links", () => {
  const letter = target.letter("x", "the wall", 3);

  it("have one spelling, without blanks", () => {
    expect(letter).toBe("letter:x:the%20wall:3");
    expect(target.edge("x", 1, 0, [0, 2], [[0], null])).toBe("edge:x:1:0:0%2C2:0%2C*");
    for (const each of [letter, target.word("y", "P", "A B"), target.row("x", "1:0-0-0 + 1:0-1-0 = |f|")])
      expect(each).not.toMatch(/\s/);
  });

  it("light up what is hovered and what is about it, and say so once", () => {
    const links = new Links([]);
    const box = h("span", linked([letter], [target.symbol("A")]));
    const row = h("li", linked([target.row("x", "r1"), letter]));
    const other = h("span", linked([target.symbol("B")]));
    const root = h("div", {}, box, row, other);
    const end = new AbortController();
    let told = 0;
    links.watch(() => {
      told++;
      links.apply(root);
    }, end.signal);
    links.listen(root, end.signal);
    document.body.append(root);
    box.dispatchEvent(new Event("pointerover", { bubbles: true }));
    box.dispatchEvent(new Event("pointerover", { bubbles: true }));
    expect(told).toBe(1);
    expect([box, row, other].map((each) => each.hasAttribute("data-lit"))).toEqual([true, true, false]);
    root.dispatchEvent(new Event("pointerleave"));
    expect(box.hasAttribute("data-lit")).toBe(false);
    row.click();
    expect(box.hasAttribute("data-chosen")).toBe(true);
    row.click();
    expect(links.picked.size).toBe(0);
    links.hover([target.symbol("A")]);
    expect([box, row].map((each) => each.hasAttribute("data-lit"))).toEqual([true, false]);
    end.abort();
    root.remove();
  });
});

describe("a link to a moment", () => {
  it("names the moment and the design", () => {
    const moment = { moment: "x/words.2+12", design: "Apartment house" };
    expect(momentIn(`https://host/lab${fragmentOf(moment)}`)).toEqual(moment);
    expect(momentIn("#facade-nb=y/sizing+1")).toEqual({ moment: "y/sizing+1", design: "" });
    expect(momentIn("https://host/lab#Heading")).toBeUndefined();
    expect(momentIn("https://host/facade-nb=x")).toBeUndefined();
    expect(momentIn("#facade-nb=%")).toBeUndefined();
  });
});

describe("a quiz", () => {
  const quiz = (single = false) =>
    new Quiz(() => [
      {
        name: "letters",
        prompt: "?",
        hint: "look",
        single,
        truths: () =>
          new Map([
            ["a", { right: true, why: "it is" }],
            ["b", { right: false, why: "it is not" }],
            ["c", { right: true, why: "too" }],
          ]),
      },
      { name: "none", prompt: "None?", hint: "", truths: () => new Map() },
    ]);

  it("checks what was chosen, and explains it", () => {
    const one = quiz();
    one.ask(true);
    expect(one.hides).toBe(true);
    one.choose("a");
    one.choose("b");
    one.choose("b");
    one.help();
    expect(one.check()).toEqual({ right: ["a"], wrong: [], missed: ["c"] });
    expect(one.hides).toBe(false);
    expect(one.verdict("c")).toEqual({ state: "missed", why: "too" });
    expect(one.verdict("b")).toEqual({ state: "passed", why: "it is not" });
    expect(one.outcome()).toBe("1 right, 1 missed.");
    one.choose("c"); // too late
    expect(one.answer().missed).toEqual(["c"]);
    one.again();
    expect(one.verdict("c").state).toBe("open");
  });

  it("hints before it tells: by a button, or after the first answer that is wrong", () => {
    const one = quiz(true);
    one.ask(true);
    one.choose("b");
    one.check();
    expect([one.hinted, one.missed, one.done, one.verdict("b").state]).toEqual([true, true, false, "open"]);
    one.choose("a");
    expect(one.missed).toBe(false);
    one.check();
    expect([one.done, one.outcome()]).toEqual([true, "Right. it is"]);
    one.again();
    expect([one.hinted, one.missed]).toEqual([false, false]);
    one.help();
    one.choose("b");
    one.check(); // with the hint known it is told
    expect([one.done, one.outcome()]).toEqual([true, "No. it is not"]);
    one.again();
    one.choose("a");
    one.check(); // what is right needs no hint
    expect(one.done).toBe(true);
  });

  it("of one thing takes the last choice", () => {
    const one = quiz(true);
    one.ask(true);
    one.help();
    one.choose("a");
    one.choose("b");
    expect(one.check()).toEqual({ right: [], wrong: ["b"], missed: [] });
    expect(one.outcome()).toBe("No. it is not");
    expect(one.verdict("c").state).toBe("missed");
  });

  it("of one thing holds nothing as good against the reader", () => {
    const one = quiz(true);
    one.ask(true);
    one.choose("a");
    one.check();
    expect(one.outcome()).toBe("Right. it is");
    expect(one.verdict("c")).toEqual({ state: "passed", why: "too" });
  });

  it("asks another question anew", () => {
    const one = quiz();
    one.ask(true);
    one.choose("a");
    one.check();
    one.again();
    expect([one.asked, one.round]).toEqual(["letters", 1]);
    one.pose("none");
    expect([one.asked, one.prompt, one.round, one.begun]).toEqual(["none", "None?", 0, false]);
    one.check();
    expect(one.outcome()).toBe("Right: there are none.");
    one.pose("no such question");
    expect(one.asked).toBe("letters");
  });
});

describe("a session", () => {
  const channel = (traits: Record<string, unknown> = {}) =>
    new FakeModel({
      timeline: pieceOf("figure-7", "timeline"),
      words: new Uint8Array(),
      position: -1,
      picked: [],
      serial: 0,
      trouble: "",
      ...traits,
    });

  it("asks for a piece that is not there, once", async () => {
    const model = channel();
    const session = Session.of(model);
    expect(Session.of(model)).toBe(session);
    const both = Promise.all([session.piece("words"), session.piece("words")]);
    await eventually(() => expect(model.asked).toEqual([{ op: "provide", names: ["words"] }]));
    model.set({ words: pieceOf("figure-7", "words") });
    const [one, other] = await both;
    expect(one).toBe(other);
    expect((one as { events: unknown[] }).events.length).toBeGreaterThan(20);
  });

  it("says what went wrong in Python instead of waiting for ever", async () => {
    const model = channel();
    const piece = Session.of(model).piece("words");
    model.set({ trouble: "Traceback…\nZeroDivisionError: division by zero" });
    await expect(piece).rejects.toThrow("ZeroDivisionError");
  });

  it("tells Python where the player rests, and goes where Python says", async () => {
    const model = channel({ position: 5 });
    const end = new AbortController();
    const session = Session.of(model);
    session.hold(() => {}, end.signal);
    const { player } = await session.load();
    expect(player.position).toBe(5);
    player.go(8);
    player.go(9);
    await eventually(() => expect(model.get("position")).toBe(9));
    model.set({ position: -1 });
    await eventually(() => expect(player.atEnd).toBe(true));
    end.abort();
  });

  it("loads another trace when one comes, and leaves nothing behind in the end", async () => {
    const model = channel();
    const end = new AbortController();
    const session = Session.of(model);
    let reloads = 0;
    session.hold(() => reloads++, end.signal);
    const { player } = await session.load();
    model.set({ timeline: pieceOf("residential-house", "timeline"), serial: 1 });
    expect(reloads).toBe(1);
    const next = await session.load();
    expect(next.player).not.toBe(player);
    expect(next.timeline.data.name).toBe("Residential house");
    end.abort();
    expect(model.listening).toBe(0);
    expect(model.sent.map((message) => [message.op, message.here])).toEqual([
      ["view", true],
      ["view", false],
    ]);
  });
});
