// What turns, as the sun sees it.
#include "standing.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 place;
layout(location = 2) in vec2 size;
layout(location = 3) in vec2 start;
layout(location = 5) in vec3 normal;
layout(location = 6) in vec3 tangent;

uniform mat4 from_world;
uniform vec3 towards;

out vec2 mesh_place;
flat out vec2 mesh_size;
flat out vec2 mesh_start;
flat out int mesh_turns;

void main() {
  Standing own = standing(position, place - 0.5 * size, normal, tangent, towards, vec3(1.0, 0.0, 0.0));
  // What stands upright does not shade itself: it would, on one side, with teeth, for the camera sees it turned otherwise.
  // What is slim is narrower than its quad: it stands nearer, so that its shadow begins at its feet.
  vec3 behind = tangent.y > 0.5 ? (size.x < 1.2 ? 0.3 : 0.5) * size.x * towards : vec3(0.0);
  gl_Position = from_world * vec4(own.position - behind, 1.0);
  mesh_place = place;
  mesh_size = size;
  mesh_start = start;
  mesh_turns = turns(normal) ? 1 : 0;
}
