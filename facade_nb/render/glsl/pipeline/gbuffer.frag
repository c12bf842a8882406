// What the camera meets at each pixel, and nothing dear: place on the façade and its size; start rule and seed; normal and
// how deep; tangent.

#include "view.glsl"

flat in vec3 mesh_corner;
flat in vec2 mesh_place;
flat in vec2 mesh_size;
flat in vec4 mesh_rule;
flat in vec3 mesh_normal;
flat in vec3 mesh_tangent;

layout(location = 0) out highp vec4 out_place;
layout(location = 1) out highp vec4 out_rule;
layout(location = 2) out highp vec4 out_facing;
layout(location = 3) out highp vec4 out_along;

void main() {
  vec3 ray = ray_at(gl_FragCoord.xy);
  float against = dot(ray, mesh_normal);  // below 0: it is seen from its front
  float depth = dot(mesh_corner, mesh_normal) / min(against, -1e-9);
  vec3 off = depth * ray - mesh_corner;
  vec2 place = mesh_place + vec2(dot(off, mesh_tangent), dot(off, cross(mesh_normal, mesh_tangent)));
  out_place = vec4(place, mesh_size);
  out_rule = mesh_rule;
  out_facing = vec4(mesh_normal, depth);  // 0: there is nothing
  out_along = vec4(mesh_tangent, 0.0);
}
