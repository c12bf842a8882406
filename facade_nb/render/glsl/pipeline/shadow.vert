// A mesh as the sun sees it.

layout(location = 0) in vec3 position;

uniform mat4 from_world;

void main() { gl_Position = from_world * vec4(position, 1.0); }
