// Which size of a tile fits the pixel: the last whose texels are not larger, where the tile shrinks least.
// `repeats`: how often the tile stands in a metre, across and up.
#include "fetch.glsl"

int level(State now, int tile, vec2 repeats) {
#ifdef MIPS
  vec2 texels = repeats * fetch(tile_table, ivec2(1, tile - 1)).zw * now.footprint;
  return int(floor(log2(max(min(texels.x, texels.y), 1.0))));
#else
  return 0;
#endif
}
