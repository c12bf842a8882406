// A square around the light of each street lamp, as wide as it reaches; of other things nothing. From within that, and from
// close by, it is the whole picture.

#include "lamp.glsl"

layout(location = 0) in vec3 position;  // the middle of the lamp
layout(location = 1) in vec2 place;
layout(location = 2) in vec2 size;
layout(location = 5) in vec3 normal;  // how far it is to walls (lamplight.py)

uniform mat4 from_world;  // to clip space
uniform vec3 eye;
uniform vec3 across;
uniform vec3 upward;

flat out vec3 lantern;  // from the eye
flat out ivec3 walls;

const float LIGHT = 3.95;  // metres above its foot
const float REACH = 13.0;  // metres

void main() {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  lantern = vec3(0.0);
  walls = walls_of(normal);
  if (!is_lamp(size, normal)) return;
  vec2 corner = sign(place - 0.5 * size);
  lantern = position + vec3(0.0, LIGHT - 0.5 * LAMP.y, 0.0) - eye;
  float far = length(lantern);
  if (far < 1.7 * REACH) {
    gl_Position = vec4(corner, 0.0, 1.0);
    return;
  }
  vec3 right = normalize(cross(lantern, upward));
  vec3 up = normalize(cross(right, lantern));
  gl_Position = from_world * vec4(eye + lantern + 1.3 * REACH * (corner.x * right + corner.y * up), 1.0);
}
