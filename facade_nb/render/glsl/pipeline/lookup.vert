// One triangle that covers the picture; and what a map of depth says of the light that it is drawn from.

uniform mat4 from_world;  // to the map's clip space; its last axis runs away from the light

flat out vec3 light_to;     // unit vector towards the light
flat out vec3 light_scale;  // what a metre is in the map: across, up, deep; as shares

vec3 row(int k) { return vec3(from_world[0][k], from_world[1][k], from_world[2][k]); }

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
  light_scale = 0.5 * vec3(length(row(0)), length(row(1)), length(row(2)));
  light_to = -normalize(row(2));
}
