// Notes how near the pixel is to the ends of its part: `at` metres from the lower one, of `extent` metres.
#include "globals.glsl"

void near(float at, float extent) {
#ifdef EDGES
  margin = min(margin, min(at, extent - at) / max(asked.footprint, 1e-9));
#endif
}
