// One texel; counted where a bench asks for it. `share`: 1 / size of the texture. It samples the texel's middle, which all
// cards give as it is. llvmpipe's texelFetch takes twice the instructions, for it looks up a level's size for each pixel.
#include "globals.glsl"

vec4 fetch(highp sampler2D source, vec2 share, vec2 place) {
#ifdef COUNT_FETCHES
  fetches += 1;
#endif
  return textureLod(source, (place + 0.5) * share, 0.0);
}
