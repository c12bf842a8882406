// How far the nearest street lamp is, 1 where its light ends. It is a depth: of several lamps the nearest stays. Behind a wall
// each metre counts for four.
#include "around_lamp.glsl"

in vec2 way;

const float FAR = 64.0;  // metres

void main() {
  float apart = length(way);
  gl_FragDepth = min((apart + 3.0 * max(apart - wall_along(way) - 1.0, 0.0)) / FAR, 1.0);
}
