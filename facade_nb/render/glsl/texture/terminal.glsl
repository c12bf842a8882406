// SkipMask, Mat and MatAlpha. The value is how many layers are passed over. The two sources of MatAlpha are read
// by the same lines, one after the other, and so is the mask of SkipMask.
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
#ifdef RELIEF
  bool beside = false;
  float out_ = 0.0;
  float shade = 0.0;
#endif
  for (int k = 1; k <= sources; ++k) {
    vec4 numbers = masks ? vec4(0.0, 0.0, 1.0, 1.0) : record(now.rule, k);
#ifdef RELIEF
    vec2 before = now.at;
    if (source != 0 && !masks) {
      Struck hit = strike(now, source, numbers);
      now.at = hit.at;
      beside = beside || hit.beside;
      if (k == 1) {
        out_ = hit.out_;
        shade = hit.shade;
      }
    }
#endif
    vec4 found = value(now, source, numbers);
#ifdef RELIEF
    now.at = before;
#endif
    bool whole = k == 1 && !masks;
    if (whole) shown = found;
    alpha *= whole || source == 0 ? found.a : mask(abs(source), found);
    source = int(head.MatAlpha_a1);
  }
  if (masks) {
#ifdef EDGES
    if (alpha > 0.02 && alpha < 0.98) margin = 0.0;  // in the mask's soft edge
#endif
    return int(alpha >= 0.5 ? head.SkipMask_l1 : head.SkipMask_l0);
  }
#ifdef RELIEF
  if (beside) alpha = 0.0;
  if (int(head.MatAlpha_u) == USAGE_COLOR) shadow += (1.0 - surface.color.a) * alpha * shade;
  now.footprint -= asked.spread * out_ / max(abs(now.ray.z), 0.15 * length(now.ray));
#endif
  paint(now, int(head.MatAlpha_u), shown.rgb, alpha);
  return 0;
}
