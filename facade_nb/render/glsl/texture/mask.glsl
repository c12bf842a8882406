// What a tile's value means as a mask: brightness of a tile that is opaque throughout, alpha of another one.
#include "fetch.glsl"

float mask(int tile, vec4 value) {
  bool opaque = fetch(tile_table, of_tile_table, vec2(0, tile - 1)).r > 0.5;
  return opaque ? (value.r + value.g + value.b) * (1.0 / 3.0) : value.a;
}
