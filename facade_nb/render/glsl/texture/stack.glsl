// RandStack: puts the scope's lower left corner on the seed stack.
#include "corner.glsl"

void stack(inout State now, vec4 head) {
  uvec2 place = corner(now);
  for (int i = 0; i < MAX_SEEDS; ++i) if (i == now.seeds) seed_stack[i] = place;
  now.seeds += 1;
  now.rule = ivec2(head.RandStack_R);
}
