// A square around each street lamp, seen from above, as wide as its light goes; of other things nothing.
#include "lamp.glsl"

layout(location = 0) in vec3 position;  // the middle of the lamp
layout(location = 1) in vec2 place;
layout(location = 2) in vec2 size;
layout(location = 5) in vec3 normal;  // how far it is to walls (lamplight.py)

uniform mat4 from_world;  // to clip space

out vec2 way;  // east and north of the lamp, metres
flat out ivec3 walls;

const float FAR = 64.0;  // metres

void main() {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  way = FAR * sign(place - 0.5 * size);
  walls = walls_of(normal);
  if (is_lamp(size, normal)) gl_Position = from_world * vec4(position + vec3(way.x, 0.0, -way.y), 1.0);
}
