// A vertex of a mesh that carries its façade (the texture paper's 4 and 6). All but the place is the same at each corner of
// a triangle.

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 place;
layout(location = 2) in vec2 size;
layout(location = 3) in vec2 start;
layout(location = 4) in vec2 seed;
layout(location = 5) in vec3 normal;
layout(location = 6) in vec3 tangent;

uniform mat4 from_world;  // to clip space
uniform vec3 eye;
uniform vec3 forward;

out vec3 from_eye;
out vec2 mesh_place;
flat out vec2 mesh_size;
flat out vec4 mesh_rule;
flat out vec3 mesh_normal;
flat out vec3 mesh_tangent;

void main() {
  gl_Position = from_world * vec4(position, 1.0);
  from_eye = position - eye;
  mesh_place = place;
  mesh_size = size;
  mesh_rule = vec4(start, seed);
  mesh_normal = normal;
  mesh_tangent = tangent;
}
