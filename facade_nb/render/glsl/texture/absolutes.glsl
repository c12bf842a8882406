// Sum of the absolute sizes of a Split's parts, and of half a step of each.
#include "half_step.glsl"
#include "record.glsl"

vec2 absolutes(ivec2 rule, int count) {
  vec2 sum = vec2(0.0);
  for (int i = 1; i <= count; ++i) {
    float held = -record(rule, i).SplitX_sv;
    if (held > 0.0) sum += vec2(held, half_step(held));
  }
  return sum;
}
