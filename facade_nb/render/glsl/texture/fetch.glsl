// One texel; counted where a bench asks for it.
#include "globals.glsl"

vec4 fetch(highp sampler2D source, ivec2 place) {
#ifdef COUNT_FETCHES
  fetches += 1;
#endif
  return texelFetch(source, place, 0);
}
