// The part (left, bottom, right, top) of a tile, stretched over the scope.
#include "level.glsl"
#include "texel.glsl"

vec4 fit(State now, int tile, vec4 part) {
  vec2 extent = now.scope.zw - now.scope.xy;
  vec2 place = clamp((now.at - now.scope.xy) / extent, vec2(0.0), vec2(1.0));
  vec2 shown = part.zw - part.xy;
  return texel(tile, part.xy + place * shown, false, level(tile, abs(shown) / extent));
}
