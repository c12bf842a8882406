// SkipMask, Mat and MatAlpha: first what their tiles say, then what follows from that. The two sources of MatAlpha are read
// by the same lines, one after the other, and so is the mask of SkipMask. Relief is that of the first source.
#include "record.glsl"
#include "value.glsl"
#include "relief.glsl"
#include "mask.glsl"
#include "paint.glsl"

// What a material shows, or how many layers are passed over.
struct Shown {
  vec3 color;
  float alpha;
  int skipped;
#ifdef RELIEF
  float out_;   // how far it stands out of the wall, metres
  float shade;  // how much of the sun relief takes from it
#endif
};

// Whether a tile is asked. What asks none is told by its records alone.
bool looks(int code, vec4 head) {
  return code == OP_SKIPMASK || code == OP_MATALPHA || code == OP_MAT && int(head.Mat_m1) != 0;
}

// The second record of a material.
vec4 numbers_of(ivec2 rule, int code) {
  vec4 numbers = vec4(0.0);
  if (code == OP_MAT || code == OP_MATALPHA) numbers = record(rule, 1);
  return numbers;
}

// What asks no tile; `numbers`: its second record.
Shown plainly(vec4 head, vec4 numbers) {
#ifdef RELIEF
  return Shown(numbers.rgb, numbers.a, int(head.r) == OP_SKIP ? int(head.Skip_l) : 0, 0.0, 0.0);
#else
  return Shown(numbers.rgb, numbers.a, int(head.r) == OP_SKIP ? int(head.Skip_l) : 0);
#endif
}

Shown looked_up(State now, vec4 head, vec4 numbers) {
  Shown found = plainly(head, numbers);
  int code = int(head.r);
  bool masks = code == OP_SKIPMASK;
  int source = int(masks ? head.SkipMask_m : head.MatAlpha_m1);
  int sources = code == OP_MATALPHA ? 2 : 1;
  int first = 1;
  if (source == 0) {  // a colour with a mask does not go around twice
    source = int(head.MatAlpha_a1);
    first = 2;
  } else {
    found.alpha = 1.0;
  }
#ifdef RELIEF
  vec2 before = now.at;
  Struck hit = Struck(now.at, 0.0, 0.0, false);
  if (relieved) hit = struck;
  now.at = hit.at;
#endif
  if (masks) numbers = vec4(0.0, 0.0, 1.0, 1.0);
  for (int k = first; k <= sources; ++k) {
    if (k == 2) numbers = record(now.rule, 2);
    vec4 read = value(now, source, numbers);
    bool whole = k == 1 && !masks;
    if (whole) found.color = read.rgb;
    found.alpha *= whole || source == 0 ? read.a : mask(abs(source), read);
    source = int(head.MatAlpha_a1);
#ifdef RELIEF
    now.at = before;  // the second source stays on the wall
#endif
  }
  if (masks) {
#ifdef EDGES
    if (found.alpha > 0.02 && found.alpha < 0.98) margin = 0.0;  // in the mask's soft edge
#endif
    found.skipped = int(found.alpha >= 0.5 ? head.SkipMask_l1 : head.SkipMask_l0);
  }
#ifdef RELIEF
  if (hit.beside) found.alpha = 0.0;
  found.out_ = hit.out_;
  found.shade = hit.shade;
#endif
  return found;
}

// What a material shows comes under what there is.
void terminal(State now, vec4 head, Shown shown) {
  int usage = int(head.MatAlpha_u);
#ifdef RELIEF
  if (usage == USAGE_COLOR) shadow += (1.0 - surface.color.a) * shown.alpha * shown.shade;
  now.footprint -= asked.spread * shown.out_ / max(abs(now.ray.z), 0.15 * length(now.ray));
#endif
  paint(now, usage, shown.color, shown.alpha);
}
