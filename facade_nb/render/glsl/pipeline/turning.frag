// What the camera meets of what turns to it: as gbuffer.frag, but where it is open. Passes of their own draw it, for a
// software renderer would have walls pay for that too.
#include "open.glsl"

uniform vec3 forward;

in vec3 from_eye;
in vec2 mesh_place;
flat in vec2 mesh_size;
flat in vec4 mesh_rule;
flat in vec3 mesh_normal;
flat in vec3 mesh_tangent;
flat in int mesh_turns;

layout(location = 0) out highp vec4 out_place;
layout(location = 1) out highp vec4 out_rule;
layout(location = 2) out highp vec4 out_facing;
layout(location = 3) out highp vec4 out_along;

void main() {
  vec2 covers = fwidth(mesh_place);
  if (mesh_turns == 1 && open(ivec2(mesh_rule.xy), mesh_place, mesh_size, max(covers.x, covers.y), 0.5)) discard;
  out_place = vec4(mesh_place, mesh_size);
  out_rule = mesh_rule;
  out_facing = vec4(mesh_normal, dot(from_eye, forward));  // 0: there is nothing
  out_along = vec4(mesh_tangent, 0.0);
}
