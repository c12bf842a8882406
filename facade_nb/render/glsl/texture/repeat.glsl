// Repeat: equal parts of about the size v; the slack is there because v is a 16-bit float.
#include "near.glsl"

void repeat(inout State now, vec4 head, bool along_y) {
  float low = along_y ? now.scope.y : now.scope.x;
  float size = (along_y ? now.scope.w : now.scope.z) - low;
  float count = max(ceil(size / head.RepeatX_v - 0.001), 1.0);
  float width = size / count;
  float at = clamp((along_y ? now.at.y : now.at.x) - low, 0.0, size * BELOW_ONE);
  float part = min(floor(at / width), count - 1.0);
  if (count > 1.0) near(at - part * width, width);
  vec2 span = vec2(low + part * width, low + (part + 1.0) * width);
  if (along_y) now.scope.yw = span;
  else now.scope.xz = span;
  now.rule = ivec2(head.RepeatX_R);
}
