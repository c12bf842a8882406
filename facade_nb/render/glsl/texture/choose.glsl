// Rand and RandUni: one part by the random number of the scope, or of a corner on the seed stack (l from the top; a
// stack that is too short gives its oldest one). Rand stops at the first sum above the number; RandUni goes straight
// to its part.
#include "record.glsl"
#include "corner.glsl"
#include "random_number.glsl"

void choose(inout State now, vec4 head, bool evenly) {
  int count = int(head.Rand_n);
  int level = min(int(head.Rand_l), now.seeds);
  float number = random_number(level > 0 ? seed_stack[now.seeds - level] : corner(now));
  if (evenly) {
    int part = int(floor(number * float(count)));
    vec4 two = record(now.rule, 1 + part / 2);
    now.rule = ivec2((part & 1) == 0 ? two.xy : two.zw);
    return;
  }
  vec4 part = vec4(0.0);
  for (int i = 1; i <= count; ++i) {
    part = record(now.rule, i);
    if (number < part.Rand_sum) break;
  }
  now.rule = ivec2(part.Rand_R);
}
