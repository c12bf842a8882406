// The random number, from 0 to below 1, of a corner in steps.
#include "fetch.glsl"
#include "mixed.glsl"

float random_number(uvec2 corner) {
  uint place = mixed(mixed(corner.x) ^ corner.y);
  return fetch(noise, vec2(1.0 / 256.0), vec2((place >> 16u) & 255u, place >> 24u)).r;
}
