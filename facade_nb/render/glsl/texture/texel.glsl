// A tile at (u, v), bilinear between the texels of one of its sizes. `wrap`: it repeats; else its edge goes on.
#include "fetch.glsl"

vec4 texel(int tile, vec2 uv, bool wrap, int level) {
#ifdef MIPS
  float column = float(min(level, tile_levels - 1) + 1);
#else
  float column = 1.0;
#endif
  vec4 box = fetch(tile_table, of_tile_table, vec2(column, tile - 1));
  vec2 place = (wrap ? uv - floor(uv) : clamp(uv, vec2(0.0), vec2(1.0))) * box.zw - 0.5;
  vec2 first = floor(place);
  vec2 second = first + 1.0;
  vec2 part = place - first;
  vec2 last = box.zw - 1.0;
  if (wrap) {
    first = mix(first, last, lessThan(first, vec2(0.0)));
    second = mix(second, vec2(0.0), greaterThan(second, last));
  } else {
    first = max(first, vec2(0.0));
    second = min(second, last);
  }
  first += box.xy;
  second += box.xy;
  vec4 under = mix(fetch(atlas, of_atlas, first), fetch(atlas, of_atlas, vec2(second.x, first.y)), part.x);
  vec4 over = mix(fetch(atlas, of_atlas, vec2(first.x, second.y)), fetch(atlas, of_atlas, second), part.x);
  return mix(under, over, part.y);
}
