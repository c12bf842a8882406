// Goes down through splits, repeats and choices to an operator that is none of these. The value is its first record;
// NOTHING where a scope is empty or the pixel has taken too many steps.
#include "record.glsl"
#include "divide.glsl"
#include "choose.glsl"

const vec4 NOTHING = vec4(99.0, 0.0, 0.0, 0.0);

vec4 descend(inout State now, inout int taken) {
  vec4 head = NOTHING;
  while (taken < MAX_STEPS) {
    int code = 0;
    while (taken < MAX_STEPS) {
      taken += 1;
      bool empty = !(now.scope.z > now.scope.x && now.scope.w > now.scope.y);
      head = empty ? NOTHING : record(now.rule, 0);
      code = int(head.r);
      if (code > OP_SPLITY) break;
      divide(now, head, code);
    }
    if (code > OP_RANDSTACK) break;
    choose(now, head, code);
  }
  return int(head.r) > OP_RANDSTACK ? head : NOTHING;
}
