// Red, green, blue and alpha of a source: 0 a constant, above 0 a part (left, bottom, right, top) of a tile, stretched
// over the scope, below 0 a tile that repeats over the façade.
#include "level.glsl"
#include "texel.glsl"

vec4 value(State now, int source, vec4 numbers) {
  if (source == 0) return numbers;
  bool wrap = source < 0;
  vec2 uv = numbers.xy + now.at * numbers.zw;
  vec2 repeats = abs(numbers.zw);
  if (!wrap) {
    vec2 extent = now.scope.zw - now.scope.xy;
    vec2 shown = numbers.zw - numbers.xy;
    uv = numbers.xy + clamp((now.at - now.scope.xy) / extent, vec2(0.0), vec2(1.0)) * shown;
    repeats = abs(shown) / extent;
  }
  int tile = abs(source);
  return texel(tile, uv, wrap, level(now, tile, repeats));
}
