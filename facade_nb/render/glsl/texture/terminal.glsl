// SkipMask, Mat and MatAlpha. The value is how many layers are passed over. The two sources of MatAlpha are read
// by the same lines, one after the other, and so is the mask of SkipMask. Relief is that of the first source.
#include "record.glsl"
#include "value.glsl"
#include "relief.glsl"
#include "mask.glsl"
#include "paint.glsl"

int terminal(State now, vec4 head) {
  int code = int(head.r);
  bool masks = code == OP_SKIPMASK;
  int source = int(masks ? head.SkipMask_m : head.MatAlpha_m1);
  int sources = code == OP_MATALPHA ? 2 : 1;
  vec4 shown = vec4(0.0);
  float alpha = 1.0;
  vec4 numbers = masks ? vec4(0.0, 0.0, 1.0, 1.0) : record(now.rule, 1);
#ifdef RELIEF
  vec2 before = now.at;
  Struck hit = Struck(now.at, 0.0, 0.0, false);
  if (relieved) hit = struck;
  now.at = hit.at;
#endif
  int first = 1;
  if (source == 0) {  // a colour with a mask does not go around twice
    shown = numbers;
    alpha = shown.a;
    source = int(head.MatAlpha_a1);
    first = 2;
  }
  for (int k = first; k <= sources; ++k) {
    if (k == 2) numbers = record(now.rule, 2);
    vec4 found = value(now, source, numbers);
    bool whole = k == 1 && !masks;
    if (whole) shown = found;
    alpha *= whole || source == 0 ? found.a : mask(abs(source), found);
    source = int(head.MatAlpha_a1);
#ifdef RELIEF
    now.at = before;  // the second source stays on the wall
#endif
  }
  if (masks) {
#ifdef EDGES
    if (alpha > 0.02 && alpha < 0.98) margin = 0.0;  // in the mask's soft edge
#endif
    return int(alpha >= 0.5 ? head.SkipMask_l1 : head.SkipMask_l0);
  }
#ifdef RELIEF
  if (hit.beside) alpha = 0.0;
  if (int(head.MatAlpha_u) == USAGE_COLOR) shadow += (1.0 - surface.color.a) * alpha * hit.shade;
  now.footprint -= asked.spread * hit.out_ / max(abs(now.ray.z), 0.15 * length(now.ray));
#endif
  paint(now, int(head.MatAlpha_u), shown.rgb, alpha);
  return 0;
}
