// SkipMask, Mat and MatAlpha. The value is how many layers are passed over. The two sources of MatAlpha are read
// by the same lines, one after the other, and so is the mask of SkipMask.
#include "record.glsl"
#include "value.glsl"
#include "mask.glsl"
#include "paint.glsl"

int terminal(State now, vec4 head) {
  int code = int(head.r);
  bool masks = code == OP_SKIPMASK;
  int source = int(masks ? head.SkipMask_m : head.MatAlpha_m1);
  int sources = code == OP_MATALPHA ? 2 : 1;
  vec4 shown = vec4(0.0);
  float alpha = 1.0;
  int first = 1;
  if (source == 0) {  // a colour with a mask does not go around twice
    shown = record(now.rule, 1);
    alpha = shown.a;
    source = int(head.MatAlpha_a1);
    first = 2;
  }
  for (int k = first; k <= sources; ++k) {
    vec4 numbers = masks ? vec4(0.0, 0.0, 1.0, 1.0) : record(now.rule, k);
    vec4 found = value(now, source, numbers);
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
  paint(now, int(head.MatAlpha_u), shown.rgb, alpha);
  return 0;
}
