// Pixel `k` of a rule's records.
#include "fetch.glsl"

vec4 record(ivec2 rule, int k) {
  return fetch(grammar, of_grammar, vec2(rule.x + k, rule.y));
}
