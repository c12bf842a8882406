// A vertex of a mesh that carries its façade (the texture paper's 4 and 6). What goes on is that of one corner of a triangle:
// where on the façade a pixel lies follows from its ray. Cards differ in how exactly they interpolate along large triangles.

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 place;
layout(location = 2) in vec2 size;
layout(location = 3) in vec2 start;
layout(location = 4) in vec2 seed;
layout(location = 5) in vec3 normal;
layout(location = 6) in vec3 tangent;

uniform mat4 from_world;  // to clip space
uniform vec3 eye;

flat out vec3 mesh_corner;  // from the eye
flat out vec2 mesh_place;   // of that corner
flat out vec2 mesh_size;
flat out vec4 mesh_rule;
flat out vec3 mesh_normal;
flat out vec3 mesh_tangent;

void main() {
  gl_Position = from_world * vec4(position, 1.0);
  mesh_corner = position - eye;
  mesh_place = place;
  mesh_size = size;
  mesh_rule = vec4(start, seed);
  mesh_normal = normal;
  mesh_tangent = tangent;
}
