// SkipMask: how many layers are passed over.
#include "fit.glsl"
#include "mask.glsl"

int skip_mask(State now, vec4 head) {
  int tile = int(head.SkipMask_m);
  float value = mask(tile, fit(now, tile, vec4(0.0, 0.0, 1.0, 1.0)));
  if (value > 0.02 && value < 0.98) margin = 0.0;  // in the mask's soft edge
  return int(value >= 0.5 ? head.SkipMask_l1 : head.SkipMask_l0);
}
