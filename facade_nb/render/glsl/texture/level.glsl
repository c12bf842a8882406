// Which size of a tile fits the pixel: the one whose texels are about as large, where the tile shrinks least. `repeats`:
// how often the tile stands in a metre, across and up.
#include "fetch.glsl"

int level(int tile, vec2 repeats) {
#ifdef MIPS
  vec2 texels = repeats * fetch(tile_table, ivec2(1, tile - 1)).zw * asked.footprint;
  return int(floor(log2(max(min(texels.x, texels.y), 1.0)) + 0.5));
#else
  return 0;
#endif
}
