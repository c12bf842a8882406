// Rand and RandUni take one part by the random number of the scope, or of a corner on the seed stack (l from the top; a
// stack that is too short gives its oldest one). Rand stops at the first sum above the number; RandUni goes straight to
// its part.
#include "record.glsl"
#include "corner.glsl"
#include "random_number.glsl"

void choose(inout State now, vec4 head) {
  uvec2 place = corner(now);
  int level = now.seeds - min(int(head.Rand_l), now.seeds);
  for (int i = 0; i < MAX_SEEDS; ++i) if (i == level && i < now.seeds) place = seed_stack[i];
  float number = random_number(place);
  bool evenly = int(head.r) == OP_RANDUNI;
  int first = 1;
  int count = int(head.Rand_n);
  if (evenly) {
    number = floor(number * float(count));
    first = 1 + int(number) / 2;
    count = first;
  }
  vec4 part = vec4(0.0);
  for (int i = first; i <= count; ++i) {  // not do-while: llvmpipe reads on for pixels that have left one
    part = record(now.rule, i);
    if (number < part.Rand_sum) break;
  }
  now.rule = ivec2(!evenly ? part.Rand_R : (int(number) & 1) == 0 ? part.xy : part.zw);
}
