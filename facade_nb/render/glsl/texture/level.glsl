// Which size of a tile fits the pixel, which is an ellipse where it is seen slantwise: texels are to be no larger than its
// small axis, but no smaller than a third of the large one. One sample cannot see all of a longer ellipse.
// `repeats`: how often the tile stands in a metre, across and up.
#include "fetch.glsl"

int level(State now, int tile, vec2 repeats) {
#ifdef MIPS
  vec2 texels = repeats * fetch(tile_table, of_tile_table, vec2(1, tile - 1)).zw * now.footprint;  // were it seen straight on
  vec2 slope = clamp(now.ray.xy / max(abs(now.ray.z), 1e-30), -1000.0, 1000.0);
  vec2 own = texels * texels * (1.0 + slope * slope);
  float both = texels.x * texels.y * slope.x * slope.y;
  float mean = 0.5 * (own.x + own.y);
  float part = 0.5 * (own.x - own.y);
  float apart = sqrt(part * part + both * both);
  float small = mean - apart;  // squares of the axes
  float large = mean + apart;
#ifdef EDGES
  if (large > 16.0 * max(small, 1.0)) margin = 0.0;
#endif
  float square = max(max(small, large * 0.11111111), 1.0);
  return ((floatBitsToInt(square) >> 23) - 127) >> 1;  // half the exponent: how often it can be halved
#else
  return 0;
#endif
}
