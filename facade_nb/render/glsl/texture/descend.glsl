// Goes down through splits, repeats and choices to an operator that is none of these. The value is its first record;
// zero where a scope is empty or the pixel has taken too many steps, which shows nothing.
#include "record.glsl"
#include "corner.glsl"
#include "divide.glsl"
#include "choose.glsl"

vec4 descend(inout State now, inout int taken) {
  vec4 head = vec4(0.0);
  while (taken < MAX_STEPS) {
    int code = 0;
    while (taken < MAX_STEPS) {
      taken += 1;
      head = now.scope.z > now.scope.x && now.scope.w > now.scope.y ? record(now.rule, 0) : vec4(99.0, 0.0, 0.0, 0.0);
      code = int(head.r);
      if (code > OP_SPLITY) break;
      divide(now, head, code);
    }
    if (code > OP_RANDSTACK) break;
    choose(now, head, code);
  }
  return head;
}
