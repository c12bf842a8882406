// A tile at (u, v), bilinear between the texels of one of its sizes. `wrap`: it repeats; else its edge goes on.
#include "fetch.glsl"

vec4 texel(int tile, vec2 uv, bool wrap, int level) {
#ifdef MIPS
  int column = min(level, textureSize(tile_table, 0).x - 2) + 1;
#else
  int column = 1;
#endif
  vec4 box = fetch(tile_table, ivec2(column, tile - 1));
  vec2 place = (wrap ? uv - floor(uv) : clamp(uv, vec2(0.0), vec2(1.0))) * box.zw - 0.5;
  vec2 low = floor(place);
  vec2 part = place - low;
  ivec2 first = ivec2(low);
  ivec2 second = first + 1;
  ivec2 count = ivec2(box.zw);
  if (wrap) {
    if (first.x < 0) first.x = count.x - 1;
    if (first.y < 0) first.y = count.y - 1;
    if (second.x >= count.x) second.x = 0;
    if (second.y >= count.y) second.y = 0;
  } else {
    first = max(first, ivec2(0));
    second = min(second, count - 1);
  }
  ivec2 origin = ivec2(box.xy);
  vec4 under = mix(fetch(atlas, origin + first), fetch(atlas, origin + ivec2(second.x, first.y)), part.x);
  vec4 over = mix(fetch(atlas, origin + ivec2(first.x, second.y)), fetch(atlas, origin + second), part.x);
  return mix(under, over, part.y);
}
