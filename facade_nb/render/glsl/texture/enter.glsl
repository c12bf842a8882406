// Comes to the rule of `now`: the value is its first record. END where the pixel has taken too many steps; NOTHING where
// there is nothing to be seen: in an empty scope, and for normals and specular values if colour alone is asked for.
#include "record.glsl"

const int OP_END = 0;
const int OP_NOTHING = 99;
const vec4 END = vec4(0.0);
const vec4 NOTHING = vec4(99.0, 0.0, 0.0, 0.0);

vec4 enter(State now, inout int taken) {
  taken += 1;
  vec4 head = NOTHING;
  if (now.scope.z > now.scope.x && now.scope.w > now.scope.y) head = record(now.rule, 0);
#ifdef COLOR_ONLY
  bool material = int(head.r) == OP_MAT || int(head.r) == OP_MATALPHA;
  if (material && int(head.Mat_u) != USAGE_COLOR) head = NOTHING;
#endif
  return taken > MAX_STEPS ? END : head;
}
