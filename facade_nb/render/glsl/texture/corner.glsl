// The scope's lower left corner plus the seed, in steps of 1/64 m: rounded, so that round numbers lie inside a step.
#include "globals.glsl"

uvec2 corner(State now) {
  vec2 steps = floor(now.scope.xy * 64.0 + float(now.shift) * asked.rest + 0.5);
  return uvec2(ivec2(steps)) + uint(now.shift) * asked.seed;
}
