import { expect, test } from "vitest";
import { drawMarks, isMarked } from "../../src/building/marks.ts";
import { ANGLE, distanceOf, FIRST, type Look, middleOf, placeOf, rayOf } from "../../src/building/orbit.ts";
import { met, seenBy } from "../../src/building/seen.ts";
import type { Pixels, Vector } from "../../src/building/types.ts";
import { matrixOf } from "../../src/pipeline/camera.ts";
import { frustumOf } from "../../src/town/frame.ts";
import type { Place } from "../../src/town/types.ts";

const BOX = [0, 0, -4, 10, 6, 0.5];
const LOOK: Look = { turn: 30, rise: 10, distance: 12, target: [5, 3, 0] };
const PIXELS: Pixels = [120, 80];

/** Two triangles of a rectangle that looks to the south. */
function wall(left: number, bottom: number, right: number, top: number, z: number): number[] {
  const corner = (x: number, y: number) => [x, y, z];
  const [a, b, c, d] = [corner(left, bottom), corner(right, bottom), corner(right, top), corner(left, top)];
  return [...a, ...b, ...c, ...a, ...c, ...d];
}
const CORNERS = new Float32Array([...wall(0, 0, 10, 6, 0), ...wall(4, 2, 6, 4, 0.5)]);
const SHAPES = Int32Array.of(-1, -1, 0, 0);
const cameraOf = (place: Place, pixels: Pixels) => matrixOf(frustumOf(place, pixels));

test("the eye looks at the target from where it is told to stand", () => {
  const [x, y, z, yaw, pitch, angle] = placeOf(LOOK, BOX, 1.5);
  expect(Math.hypot(x - 5, y - 3, z)).toBeCloseTo(12, 9);
  expect(Math.atan2(x - 5, z) * (180 / Math.PI)).toBeCloseTo(30, 9);
  expect([yaw, pitch, angle]).toEqual([-30, -10, ANGLE]);
  const { eye, ray } = rayOf([x, y, z, yaw, pitch, angle], PIXELS, 0.5, 0.5);
  const middle = eye.map((at, k) => at + 12 * (ray[k] as number));
  for (const [k, at] of [5, 3, 0].entries()) expect(middle[k]).toBeCloseTo(at, 9);
});

test("the eye is never in the ground, and looks at its target all the same", () => {
  const place = placeOf({ ...LOOK, rise: -15, distance: 40 }, BOX, 1.5);
  expect(place[1]).toBeGreaterThan(0);
  const { eye, ray } = rayOf(place, PIXELS, 0.5, 0.5);
  const far = -((eye[2] as number) - 0) / (ray[2] as number);
  expect(eye[1] + far * (ray[1] as number)).toBeCloseTo(3, 6);
});

test("at first all of the building is seen, in wide and in narrow views", () => {
  for (const aspect of [0.5, 1, 1.6, 3]) {
    const look: Look = { ...FIRST, distance: 0, target: null };
    const pixels: Pixels = [Math.round(300 * aspect), 300];
    const camera = cameraOf(placeOf(look, BOX, aspect), pixels);
    const reach: number[] = [];
    for (let k = 0; k < 8; k += 1) {
      const [x, y, z] = [0, 1, 2].map((axis) => BOX[k & (1 << axis) ? axis + 3 : axis] as number) as Vector;
      const row = (r: number) => [x, y, z, 1].reduce((sum, at, c) => sum + at * (camera[4 * r + c] as number), 0);
      reach.push(Math.abs(row(0) / row(3)), Math.abs(row(1) / row(3)));
    }
    expect(Math.max(...reach)).toBeLessThan(1);
    expect(Math.max(...reach)).toBeGreaterThan(0.7);
  }
  expect(distanceOf({ ...FIRST, distance: 0, target: null }, BOX, 1.5)).toBe(
    distanceOf({ turn: 90, rise: 40, distance: 0, target: null }, BOX, 1.5),
  );
  expect(middleOf(BOX)).toEqual([5, 3, -1.75]);
});

test("a ray meets what its pixel shows, from all sides and close up", () => {
  for (const look of [LOOK, { ...LOOK, turn: -60, rise: 50 }, { ...LOOK, turn: 0, rise: 0, distance: 1.2 }]) {
    const place = placeOf(look, BOX, 1.5);
    const seen = seenBy(CORNERS, cameraOf(place, PIXELS), ...PIXELS);
    const found = new Set<number>();
    const wrong: unknown[] = [];
    for (let y = 0; y < PIXELS[1]; y += 1)
      for (let x = 0; x < PIXELS[0]; x += 1) {
        const { eye, ray } = rayOf(place, PIXELS, (x + 0.5) / PIXELS[0], 1 - (y + 0.5) / PIXELS[1]);
        const hit = met(CORNERS, eye, ray);
        const own = seen.triangle[y * PIXELS[0] + x] as number;
        found.add(own);
        // On the diagonal, which two triangles share, either will do.
        const of = (triangle: number) => (triangle < 0 ? "sky" : triangle < 2 ? "wall" : "window");
        const deep = 1 / (seen.near[y * PIXELS[0] + x] as number);
        if (of(own) !== of(hit?.triangle ?? -1) || (hit && Math.abs(deep - hit.far) > 1e-3))
          wrong.push([x, y, own, hit]);
      }
    expect(wrong).toEqual([]);
    expect(found.size).toBeGreaterThan(1);
  }
});

test("what is seen from behind is not there", () => {
  const place = placeOf({ ...LOOK, turn: 180 }, BOX, 1.5);
  const seen = seenBy(CORNERS, cameraOf(place, PIXELS), ...PIXELS);
  expect(seen.triangle.every((own) => own === -1)).toBe(true);
  const { eye, ray } = rayOf(place, PIXELS, 0.5, 0.5);
  expect(met(CORNERS, eye, ray)).toBeNull();
});

test("a shape that is picked has a line around what is seen of it, and a tint within", () => {
  const seen = seenBy(CORNERS, cameraOf(placeOf({ ...LOOK, turn: 0, rise: 0 }, BOX, 1.5), PIXELS), ...PIXELS);
  const image = { data: new Uint8ClampedArray(4 * PIXELS[0] * PIXELS[1]) } as ImageData;
  const none = { picked: -1, alike: new Set<number>(), lit: new Set<number>(), hovered: -1 };
  const alpha = (x: number, y: number) => image.data[4 * (y * PIXELS[0] + x) + 3];
  drawMarks(seen, SHAPES, { ...none, picked: 0 }, image, 1);
  const inside = (k: number) => SHAPES[seen.triangle[k] as number] === 0;
  const columns = Array.from({ length: PIXELS[0] }, (_, x) => x).filter((x) => inside(40 * PIXELS[0] + x));
  const [first, last] = [columns[0] as number, columns.at(-1) as number];
  expect([alpha(first - 1, 40), alpha(first, 40), alpha(60, 40), alpha(last, 40), alpha(last + 1, 40)]).toEqual([
    0, 255, 44, 255, 0,
  ]);
  drawMarks(seen, SHAPES, none, image, 1);
  expect(image.data.every((value) => value === 0)).toBe(true);
  expect([isMarked(none), isMarked({ ...none, lit: new Set([0]) })]).toEqual([false, true]);
});
