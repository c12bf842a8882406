// What the camera meets at each pixel, and nothing dear: place on the façade and its size; start rule and seed; normal and
// how deep; tangent.

uniform vec3 forward;

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
  out_place = vec4(mesh_place, mesh_size);
  out_rule = mesh_rule;
  // What hangs over is seen from below, too: there it looks down.
  float side = dot(from_eye, mesh_normal) > 0.0 ? -1.0 : 1.0;
  out_facing = vec4(side * mesh_normal, dot(from_eye, forward));  // 0: there is nothing
  out_along = vec4(side * mesh_tangent, 0.0);
}
