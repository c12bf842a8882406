// What a pixel of a picture holds.
#include "evaluate.glsl"

uniform int grammar_width;

layout(location = 0) out highp vec4 out_color;
layout(location = 1) out highp vec4 out_normal;
layout(location = 2) out highp vec4 out_specular;
layout(location = 3) out highp ivec4 out_rule;   // number of the rule's first record, row by row; -1: none. Fetches. Margin. Shadow

void put(Surface found) {
  out_color = found.color;
  out_normal = found.normal;
  out_specular = found.specular;
  out_rule = ivec4(found.rule.x < 0 ? -1 : found.rule.y * grammar_width + found.rule.x, 0, 0, 0);
#ifdef COUNT_FETCHES
  out_rule.y = fetches;
#endif
  out_rule.z = floatBitsToInt(margin);
#ifdef RELIEF
  out_rule.w = floatBitsToInt(shadow);
#endif
}
