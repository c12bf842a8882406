// What the camera meets at each pixel, and nothing dear: place on the façade and its size; start rule and seed; normal and
// how deep; tangent.

#ifdef EXACT
#include "view.glsl"
#else
uniform vec3 forward;
#endif

in vec3 from_eye;
in vec2 mesh_place;
flat in vec2 mesh_size;
flat in vec4 mesh_rule;
flat in vec3 mesh_normal;
flat in vec3 mesh_tangent;

#ifdef BEHIND
uniform highp sampler2D passed;  // up to where all is seen through, metres
#endif

layout(location = 0) out highp vec4 out_place;
layout(location = 1) out highp vec4 out_rule;
layout(location = 2) out highp vec4 out_facing;
layout(location = 3) out highp vec4 out_along;

void main() {
#ifdef BEHIND
  if (dot(from_eye, forward) <= texelFetch(passed, ivec2(gl_FragCoord.xy), 0).r * 1.00002 + 1e-4) discard;
#endif
  vec2 at = mesh_place;
  float depth = dot(from_eye, forward);
#ifdef EXACT
  // Rasterizers put corners on a net of a part of a pixel, some on one of sixteen. Both below are off by the same share, so
  // the façade's corner is not, and where the ray meets its plane is not either.
  vec3 up = cross(mesh_normal, mesh_tangent);
  vec3 corner = from_eye - mesh_place.x * mesh_tangent - mesh_place.y * up - start_at(gl_FragCoord.xy);
  vec3 ray = ray_at(gl_FragCoord.xy);
  depth = dot(corner, mesh_normal) / min(dot(ray, mesh_normal), -1e-9);
  vec3 on = depth * ray - corner;
  at = vec2(dot(on, mesh_tangent), dot(on, up));
#endif
  out_place = vec4(at, mesh_size);
  out_rule = mesh_rule;
  out_facing = vec4(mesh_normal, depth);  // 0: there is nothing
  out_along = vec4(mesh_tangent, 0.0);
}
