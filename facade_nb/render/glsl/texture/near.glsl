// Notes how near the pixel is to the ends of its part: `at` metres from the lower one, of `extent` metres.
#include "globals.glsl"

void near(State now, float at, float extent) {
#ifdef EDGES
  margin = min(margin, min(at, extent - at) * abs(now.ray.z) / (max(now.footprint, 1e-9) * length(now.ray)));
#endif
}
